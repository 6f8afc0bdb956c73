/* SPDX-License-Identifier: MIT
 * info.h: `tahr info`: what this shell was built with. */
#ifndef TAHR_CLI_INFO_H
#define TAHR_CLI_INFO_H

/* Returns an exit code. */
int info_command(int argc, char **argv);

#endif
