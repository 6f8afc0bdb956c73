/* SPDX-License-Identifier: MIT
 * level_io.h: how Assimp opens files. */
#ifndef TAHR_CLI_LEVEL_IO_H
#define TAHR_CLI_LEVEL_IO_H

#include <assimp/cfileio.h>

/* Reading of regular files only. Assimp 5.2 guesses at names of missing material files by taking text out of the
 * level's own path; when such a guess is a directory, its default reader opens it and fails the whole import. */
struct aiFileIO level_io(void);

#endif
