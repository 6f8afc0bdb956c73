/* SPDX-License-Identifier: MIT
 * spawn.h: places on a level where characters can stand. */
#ifndef TAHR_CLI_SPAWN_H
#define TAHR_CLI_SPAWN_H

#include "level.h"

/* Finds `count` places (centres of the shape) on walkable ground, spread over the level, the same for the same seed.
 * If the level has fewer, places are used again. 0, or -1 after a message. */
int spawn_find(tahr_world *world, const struct level *level, const tahr_config *config, uint64_t seed,
               tahr_vec3 *places, uint32_t count);

#endif
