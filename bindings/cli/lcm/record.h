/* SPDX-License-Identifier: MIT
 * record.h: `tahr record`: what is published over LCM, kept as an ordinary LCM event log. */
#ifndef TAHR_CLI_LCM_RECORD_H
#define TAHR_CLI_LCM_RECORD_H

/* The help of `tahr record`, and the command, which returns an exit code. */
void record_help(void);
int record_command(int argc, char **argv);

#endif
