/* SPDX-License-Identifier: MIT
 * outputs.h: files that a run will write. */
#ifndef TAHR_CLI_OUTPUTS_H
#define TAHR_CLI_OUTPUTS_H

#include <stdio.h>

/* Finds out before a long run whether a file can be written, and leaves it as it was. path may be NULL.
 * 0, or -1 after a message that names the option and the path. */
int output_probe(const char *option, const char *path);

/* Opens for writing; NULL after a message. */
FILE *output_open(const char *option, const char *path);

/* Closes; 0, or -1 after a message if something could not be written. */
int output_close(FILE *file, const char *option, const char *path);

#endif
