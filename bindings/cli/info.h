/* SPDX-License-Identifier: MIT
 * info.h: `tahr info`: what this shell was built with. */
#ifndef TAHR_CLI_INFO_H
#define TAHR_CLI_INFO_H

/* The help of `tahr info`. */
void info_help(void);

/* Returns an exit code. */
int info_command(int argc, char **argv);

#endif
