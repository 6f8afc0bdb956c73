/* SPDX-License-Identifier: MIT
 * replay.h: `tahr replay`: a recorded run, repeated, played or proven. */
#ifndef TAHR_CLI_REPLAY_H
#define TAHR_CLI_REPLAY_H

void replay_help(void);

/* Returns an exit code. */
int replay_command(int argc, char **argv);

#endif
