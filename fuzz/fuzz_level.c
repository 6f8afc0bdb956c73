/* SPDX-License-Identifier: MIT
 * fuzz_level.c: level files of the shell: the first byte chooses the format, the rest is the file. Refused with a
 * message, or a level that a world can be opened on. OBJ is made of words, not of raw bytes: what is tried is what this
 * shell makes of Assimp's answers, not Assimp. */
#include "../bindings/cli/level.h"
#if __has_include("../bindings/cli/side.h")
#include "../bindings/cli/side.h"
#endif
#include "bytes.h"
#include "scratch.h"
#include "target.h"

#include <math.h>
#include <string.h>
#include <tahr/box2d.h>
#include <tahr/native.h>

/* Whatever was read can be walked on, or is refused with a status. */
static void open_level(const struct level *level, const tahr_backend *backend)
{
    tahr_world_desc desc;
    tahr_world *world = NULL;
    if (!backend) return;
    for (size_t i = 0; i < level->body_count; i++) {
        const tahr_body_desc *b = &level->bodies[i];
        for (uint32_t k = 0; b->type == TAHR_BODY_MESH && k < 3 * b->triangle_count; k++)
            FUZZ_CHECK(b->indices[k] < b->vertex_count, "body %u: index %u of %u", (unsigned)i, b->indices[k],
                       b->vertex_count);
    }
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = level->bodies;
    desc.body_count = (uint32_t)level->body_count;
    if (tahr_world_open(backend, &desc, &world) == TAHR_OK) tahr_world_close(world);
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
        open_level(&level, tahr_backend_v1_native());
        level_close(&level);
    }
}

#ifdef TAHR_CLI_SIDE_H
static void read_map(const bytes *b)
{
    const struct side_options options = {0};
    for (int planar = 0; planar < 2; planar++) {
        struct side side;
        struct level level;
        memset(&side, 0, sizeof side);
        memset(&level, 0, sizeof level);
        const char *path = scratch_file(b->at, bytes_left(b), "tmj");
        scratch_quiet();
        int status = side_load(&side, path, &options);
        if (status == 0) side_build(&level, &side, "fuzz", planar);
        scratch_loud();
        if (status < 0) return;
#ifdef TAHR_HAVE_BOX2D
        open_level(&level, planar ? tahr_backend_v1_box2d() : tahr_backend_v1_native());
#else
        open_level(&level, planar ? NULL : tahr_backend_v1_native());
#endif
        level_close(&level);
    }
}
#endif

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    bytes b = {data, data + size};
    if (size == 0) return 0;
#ifdef TAHR_CLI_SIDE_H
    if (data[0] == '{') { /* a map begins like this, and nothing else does */
        read_map(&b);
        return 0;
    }
#endif
    bytes_u8(&b);
    read_obj(&b);
    return 0;
}
