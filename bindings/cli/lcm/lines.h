/* SPDX-License-Identifier: MIT
 * lines.h: one message as a line: in words, or as a JSON object. */
#ifndef TAHR_CLI_LCM_LINES_H
#define TAHR_CLI_LCM_LINES_H

#include "message.h"

#include <stdio.h>

void line_words(FILE *to, const char *channel, const struct message *message);

/* Every field by its name in the .lcm files. Hashes are texts of 16 digits (JSON's numbers hold 53 bits), as are the
 * bytes of snapshots and configs, two digits each; numbers that are not finite are null. */
void line_json(FILE *to, const char *channel, const struct message *message);

#endif
