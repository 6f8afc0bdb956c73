/* SPDX-License-Identifier: MIT
 * rides.c: the part of the playground that moves, and the places for what is more than walking. */
#include "rides.h"

#include "sketch.h"

/* A lift that rises out of the ground beside a tower of 3 m; a platform that goes to and fro, and one that turns. */
static void add_movers(struct level *level)
{
    level_add_mover(level, &(struct level_mover){.half_extents = {1.5, 1.5, 1.6},
                                                 .center = {-26.5, 25, -1.55},
                                                 .swing = {0, 0, 2.97},
                                                 .period = 8,
                                                 .pause = 1.5});
    sketch_block(level, -24.98, -21, 23.5, 26.5, 0, 3);
    sketch_block(level, -21, -20.4, 23.5, 26.5, 0, 0.6);
    level_add_mover(
        level,
        &(struct level_mover){
            .half_extents = {1.5, 1.5, 0.15}, .center = {-17, 31, 0.2}, .swing = {9, 0, 0}, .period = 9, .pause = 1});
    level_add_mover(level,
                    &(struct level_mover){.half_extents = {2.5, 2.5, 0.15}, .center = {-13, 25, 0.2}, .turns = 0.1});
}

/* Two walls that close to 0.4 m and open again. */
static void add_press(struct level *level)
{
    sketch_block(level, -5.5, -5, 22.5, 25.5, 0, 2.5);
    level_add_mover(level, &(struct level_mover){.half_extents = {0.5, 1.5, 1.25},
                                                 .center = {-1.5, 24, 1.26},
                                                 .swing = {-2.6, 0, 0},
                                                 .period = 7,
                                                 .pause = 1});
}

/* Water of 2.8 m, with a way out over a beach at one end and over an edge at the others. */
static void add_pool(struct level *level)
{
    struct sketch sketch = {0};
    const double bed = -POOL_DEPTH, beach = 7;
    const tahr_vec3 a = {POOL_X0, POOL_Y0, bed}, b = {POOL_X1 - beach, POOL_Y0, bed},
                    c = {POOL_X1 - beach, POOL_Y1, bed}, d = {POOL_X0, POOL_Y1, bed}, e = {POOL_X1, POOL_Y0, 0},
                    f = {POOL_X1, POOL_Y1, 0};
    const tahr_vec3 top_a = {POOL_X0, POOL_Y0, 0}, top_b = {POOL_X1 - beach, POOL_Y0, 0},
                    top_c = {POOL_X1 - beach, POOL_Y1, 0}, top_d = {POOL_X0, POOL_Y1, 0};
    sketch_quad(&sketch, a, b, c, d);
    sketch_quad(&sketch, b, e, f, c);
    sketch_quad(&sketch, a, b, top_b, top_a);
    sketch_quad(&sketch, d, c, top_c, top_d);
    sketch_quad(&sketch, a, d, top_d, top_a);
    sketch_triangle(&sketch, b, e, top_b);
    sketch_triangle(&sketch, c, f, top_c);
    sketch_finish(&sketch, level);
    level_add_pool(level,
                   (tahr_vec3){(POOL_X0 + POOL_X1) / 2, (POOL_Y0 + POOL_Y1) / 2, (POOL_SURFACE - POOL_DEPTH) / 2},
                   (tahr_vec3){(POOL_X1 - POOL_X0) / 2, (POOL_Y1 - POOL_Y0) / 2, (POOL_DEPTH + POOL_SURFACE) / 2});
}

/* A slab at 1.3 m over the ground, on walls at two sides: only for who crouches. */
static void add_crawl(struct level *level)
{
    sketch_block(level, 14, 19, 27.5, 31, 1.3, 1.6);
    sketch_block(level, 14, 19, 27.5, 27.7, 0, 1.3);
    sketch_block(level, 14, 19, 30.8, 31, 0, 1.3);
}

/* Two walls to climb between by jumping from one to the other, with a platform at the top of one. */
static void add_shaft(struct level *level)
{
    sketch_block(level, 21.7, 22, 26, 30, 0, 5);
    sketch_block(level, 23.6, 26, 26, 30, 0, 4);
}

void rides_add(struct level *level)
{
    add_movers(level);
    add_press(level);
    add_pool(level);
    level_add_belt(level, (tahr_vec3){17, 23.5, 0.05}, (tahr_vec3){4, 1.5, 0.05}, (tahr_vec3){2, 0, 0});
    add_crawl(level);
    add_shaft(level);
}

void playground_feel(tahr_config *config)
{
    config->coyote_time = 0.1;
    config->jump_buffer = 0.15;
    config->wall_slide_speed = 2;
    config->wall_jump_speed = 3.5;
    config->wall_coyote_time = 0.1;
    config->ledge_grab = 0.4;
    config->corner_correction = 0.1;
    config->lift_momentum = 0.1;
}
