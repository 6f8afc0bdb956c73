/* SPDX-License-Identifier: MIT
 * argument.h: the values of options, read strictly: every message names the option, the value and what was expected. */
#ifndef TAHR_CLI_ARGUMENT_H
#define TAHR_CLI_ARGUMENT_H

#include <getopt.h>
#include <stdint.h>

/* Says that --option has a wrong value, and what was wanted. -1. */
int argument_refuse(const char *option, const char *value, const char *wanted);

/* 0, or -1 after a message. */
int argument_number(const char *option, const char *text, double low, double high, double *value);
int argument_whole(const char *option, const char *text, uint64_t low, uint64_t high, uint64_t *value);

/* The next option of a command line that starts with the name of its command; -1 at the end; '?' after a message about
 * one that is not known or lacks its value. What is no option is moved to the end, from optind on. */
int argument_next(int argc, char **argv, const struct option *known);

#endif
