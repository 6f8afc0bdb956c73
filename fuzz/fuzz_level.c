/* SPDX-License-Identifier: MIT
 * fuzz_level.c: level files of the shell: the first byte chooses the format, the rest is the file. Refused with a
 * message, or a level that a world can be opened on. OBJ is made of words, not of raw bytes: what is tried is what this
 * shell makes of Assimp's answers, not Assimp. */
#include "../bindings/cli/side.h"
#include "bytes.h"
#include "scratch.h"
#include "target.h"

#include <math.h>
#include <string.h>
#include <tahr/box2d.h>
#include <tahr/native.h>

enum { MOST_STEPS = 12 };

/* What is in the arrays of a body is what it says that it holds. */
static void check_body(const tahr_body_desc *b, unsigned number)
{
    for (uint32_t k = 0; b->type == TAHR_BODY_MESH && k < 3 * b->triangle_count; k++)
        FUZZ_CHECK(b->indices[k] < b->vertex_count, "body %u: index %u of %u", number, b->indices[k], b->vertex_count);
    for (uint32_t k = 0; b->vertices && k < 3 * b->vertex_count; k++)
        FUZZ_CHECK(isfinite(b->vertices[k]), "body %u: vertex %u", number, k / 3);
}

/* Whatever was read is a world, or is refused with a status. */
static tahr_world *open_level(const struct level *level, const tahr_backend *backend, const void *options)
{
    tahr_world_desc desc;
    tahr_world *world = NULL;
    for (size_t i = 0; i < level->body_count; i++)
        check_body(&level->bodies[i], (unsigned)i);
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = level->bodies;
    desc.body_count = (uint32_t)level->body_count;
    desc.options = options;
    return tahr_world_open(backend, &desc, &world) == TAHR_OK ? world : NULL;
}

/* Numbers and words of OBJ files, good and bad. */
static size_t write_obj(bytes *b, char *text, size_t room)
{
    static const char *const numbers[] = {"0",   "1",     "-1",    "2.5", "1e3",   "nan",
                                          "inf", "-1e30", "1e-40", "0.1", "1e400", "x"};
    static const char *const corners[] = {"1",  "2", "3", "4",   "5",    "-1",          "-2",
                                          "-3", "0", "9", "1/1", "2//2", "99999999999", "-99"};
    size_t size = 0;
    while (bytes_left(b) > 0 && size + 120 < room) {
        uint32_t how = bytes_u8(b);
        if (how < 110) {
            const char *x = numbers[bytes_below(b, how < 80 ? 5 : 12)];
            const char *y = numbers[bytes_below(b, 5)];
            const char *z = numbers[bytes_below(b, 5)];
            size += (size_t)snprintf(text + size, room - size, "v %s %s %s\n", x, y, z);
        } else if (how < 220) {
            size += (size_t)snprintf(text + size, room - size, "f");
            for (uint32_t i = 0; i < how % 6; i++)
                size += (size_t)snprintf(text + size, room - size, " %s", corners[bytes_below(b, how < 190 ? 5 : 14)]);
            size += (size_t)snprintf(text + size, room - size, "\n");
        } else {
            static const char *const others[] = {"o a\n", "g b\n",   "usemtl c\n", "# d\n",
                                                 "\n",    "l 1 2\n", "p 1\n",      "s off\n"};
            size += (size_t)snprintf(text + size, room - size, "%s", others[how % 8]);
        }
    }
    return size;
}

static void read_obj(bytes *b)
{
    static char text[16384];
    struct level level;
    memset(&level, 0, sizeof level);
    char up = bytes_u8(b) % 2 ? 'y' : 'z';
    size_t size = write_obj(b, text, sizeof text);
    const char *path = scratch_file((const uint8_t *)text, size, "obj");
    scratch_quiet();
    int status = level_load(&level, path, up);
    scratch_loud();
    if (status == 0) {
        FUZZ_CHECK(isfinite(level.bounds.min.x + level.bounds.max.z), "bounds");
        tahr_world_close(open_level(&level, tahr_backend_v1_native(), NULL));
        level_close(&level);
    }
}

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
        if (!planar) world = open_level(&level, tahr_backend_v1_native(), NULL);
        if (planar && flat) world = open_level(&level, flat, &engine);
        if (world) walk(world, level.side);
        side_is_solid(level.side, level.side->start.x, level.side->start.y);
        tahr_world_close(world);
        level_close(&level);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    bytes b = {data, data + size};
    if (size == 0) return 0;
    if (data[0] == '{') { /* a map begins like this, and nothing else does */
        read_map(&b);
        return 0;
    }
    bytes_u8(&b);
    read_obj(&b);
    return 0;
}
