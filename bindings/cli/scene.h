/* SPDX-License-Identifier: MIT
 * scene.h: the level that the options name, and a world of it. */
#ifndef TAHR_CLI_SCENE_H
#define TAHR_CLI_SCENE_H

#include "level.h"
#include "options.h"

/* The bundled one where none is named. 0, or -1 after a message; to be closed either way. */
int scene_load(struct level *level, const struct options *options);

/* A world of it on the backend asked for. 0, or -1 after a message. */
int scene_open(const struct level *level, const struct options *options, tahr_world **world);

/* 64 bits of everything that a world is opened with: equal levels on equal backends have equal ones. */
uint64_t scene_hash(const struct level *level);

#endif
