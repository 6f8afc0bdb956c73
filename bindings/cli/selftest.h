/* SPDX-License-Identifier: MIT
 * selftest.h: `tahr selftest`: does a backend keep its promises? */
#ifndef TAHR_CLI_SELFTEST_H
#define TAHR_CLI_SELFTEST_H

/* argv[0] is "selftest". Returns an exit code: 1 if a case failed. */
int selftest_command(int argc, char **argv);

void selftest_help(void);

#endif
