/* SPDX-License-Identifier: MIT
 * play.h: `tahr replay LOG`: a log of LCM, published again as it was recorded. */
#ifndef TAHR_CLI_LCM_PLAY_H
#define TAHR_CLI_LCM_PLAY_H

/* url: NULL: LCM's default. glob: of channels, NULL: all. speed: times as fast; 0: as fast as it goes. Returns an exit
 * code. */
int play_log(const char *path, const char *url, const char *glob, double speed);

#endif
