/* SPDX-License-Identifier: MIT
 * fuzz_map.c: maps of Tiled, any bytes: refused with a message, or a level that a world of space or of the plane can be
 * opened on, and walked in. */
#include "../bindings/cli/side.h"
#include "bytes.h"
#include "opened.h"
#include "scratch.h"
#include "target.h"

#include <math.h>
#include <string.h>
#include <tahr/box2d.h>
#include <tahr/native.h>

enum { MOST_STEPS = 12 };

/* Somebody goes to the right from where the level begins. */
static void walk(tahr_world *world, const struct side *side)
{
    tahr_config config;
    tahr_mover *mover = NULL;
    tahr_state state;
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PLATFORMER);
    side_config(&config);
    tahr_vec3 start = side_start(side, &config);
    if (tahr_mover_create(world, &config, &mover) == TAHR_OK && tahr_state_init(&state, &config, &start) == TAHR_OK) {
        for (int i = 0; i < MOST_STEPS; i++) {
            tahr_input input = {.struct_size = sizeof input, .move = {1, 0, 0}, .jump = i % 8 == 5};
            tahr_status status = tahr_mover_step(mover, &input, 1.0 / 30, &state, NULL);
            FUZZ_CHECK(status >= 0, "%s", tahr_status_name(status));
            FUZZ_CHECK(isfinite(state.position.x + state.position.y), "position");
        }
    }
    tahr_mover_destroy(mover);
}

/* The same map in the plane and drawn out into space; tiles joined or not, and by either Box2D, as its size decides. */
static void read_map(const bytes *b)
{
    const struct side_options options = {.separate = bytes_left(b) % 2};
#ifdef TAHR_HAVE_BOX2D
    const tahr_box2d_desc engine = {.struct_size = sizeof engine, .engine = bytes_left(b) / 2 % 2 ? 2 : 3};
    const tahr_backend *flat = tahr_backend_v1_box2d();
#else
    const tahr_native_desc engine = {.struct_size = sizeof engine};
    const tahr_backend *flat = NULL;
#endif
    for (int planar = 0; planar < 2; planar++) {
        struct side side;
        struct level level;
        const char *path = scratch_file(b->at, bytes_left(b), "tmj");
        scratch_quiet();
        int status = side_load(&side, path, &options);
        scratch_loud();
        if (status < 0) return;
        side_build(&level, &side, "fuzz", planar);
        tahr_world *world = NULL;
        if (!planar) world = opened(&level, tahr_backend_v1_native(), NULL);
        if (planar && flat) world = opened(&level, flat, &engine);
        if (world) walk(world, level.side);
        side_is_solid(level.side, level.side->start.x, level.side->start.y);
        tahr_world_close(world);
        level_close(&level);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const bytes b = {data, data + size};
    read_map(&b);
    return 0;
}
