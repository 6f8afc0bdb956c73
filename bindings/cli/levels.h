/* SPDX-License-Identifier: MIT
 * levels.h: the files that the shell brings along. */
#ifndef TAHR_CLI_LEVELS_H
#define TAHR_CLI_LEVELS_H

enum { LEVEL_SIDE, LEVEL_TILES, LEVEL_TOUR };

/* The text of one of them, as it lies in bindings/cli/levels. */
const char *level_text(int level);

/* The help of `tahr level`: what there is. */
void level_help(void);

/* `tahr level [NAME]`: lists them, or writes one to standard output. Returns an exit code. */
int level_command(int argc, char **argv);

#endif
