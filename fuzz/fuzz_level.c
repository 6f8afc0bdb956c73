/* SPDX-License-Identifier: MIT
 * fuzz_level.c: level files that the shell reads through Assimp: refused with a message, or a level that a world can be
 * opened on. OBJ is made of words, not of raw bytes: what is tried is what this shell makes of Assimp's answers, not
 * Assimp. */
#include "bytes.h"
#include "opened.h"
#include "scratch.h"
#include "target.h"

#include <math.h>
#include <string.h>
#include <tahr/native.h>

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
        tahr_world_close(opened(&level, tahr_backend_v1_native(), NULL));
        level_close(&level);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    bytes b = {data, data + size};
    read_obj(&b);
    return 0;
}
