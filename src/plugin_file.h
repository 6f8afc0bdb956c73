/* SPDX-License-Identifier: MIT
 * plugin_file.h: a look at a file before the system loads it. */
#ifndef TAHR_PLUGIN_FILE_H
#define TAHR_PLUGIN_FILE_H

#include <stddef.h>

/* Is it a file that may be handed to the system's loader? Returns 0, and why in text, for what that would wait for (a
 * pipe), or crash on (a shared object that is cut off). What else is wrong with a file the loader itself says. */
int tahr__plugin_file_check(const char *path, char *text, size_t room);

#endif
