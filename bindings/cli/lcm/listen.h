/* SPDX-License-Identifier: MIT
 * listen.h: `tahr listen`: what characters do elsewhere, shown while they do it. */
#ifndef TAHR_CLI_LCM_LISTEN_H
#define TAHR_CLI_LCM_LISTEN_H

/* The help of `tahr listen`, and the command, which returns an exit code. */
void listen_help(void);
int listen_command(int argc, char **argv);

#endif
