/* SPDX-License-Identifier: MIT
 * bench_crowd.c: makes the characters that are timed. */
#include "bench_crowd.h"

#include <stdio.h>
#include <stdlib.h>

void bench_crowd_free(bench_crowd *c)
{
    for (uint32_t i = 0; c->movers && i < c->count; i++) {
        tahr_mover_destroy(c->movers[i]);
    }
    free(c->movers);
    free(c->states);
    free(c->wanderers);
}

int bench_crowd_make(bench_crowd *c, bench_opened *opened, const bench_world *world, char *error)
{
    c->movers = calloc(c->count, sizeof *c->movers);
    c->states = calloc(c->count, sizeof *c->states);
    c->wanderers = calloc(c->count, sizeof *c->wanderers);
    if (!c->movers || !c->states || !c->wanderers) {
        snprintf(error, 256, "out of memory");
        return 0;
    }
    bench_world_config(world, &c->config);
    for (uint32_t i = 0; i < c->count; i++) {
        tahr_status status = tahr_mover_create(opened->world, &c->config, &c->movers[i]);
        if (status < 0 || !scene_wander_spawn(opened->world, &c->config, &world->spawn, &c->seed, &c->states[i])) {
            snprintf(error, 256, "character %u: %s", i, status < 0 ? tahr_status_name(status) : "no place to start at");
            return 0;
        }
        scene_wander_start(&c->wanderers[i], 1, i);
    }
    return 1;
}

int bench_crowd_is_lost(const bench_crowd *c, const bench_world *world, uint32_t character)
{
    const tahr_vec3 at = c->states[character].position;
    return world->planar ? at.y < world->spawn.min.y - 10 : at.z < world->spawn.min.z - 10;
}
