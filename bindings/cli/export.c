/* SPDX-License-Identifier: MIT
 * export.c: `tahr level`: the bundled level as a Wavefront OBJ, for who wants to walk it in another engine. */
#include "export.h"

#include "level.h"
#include "say.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

/* Y up, as most programs expect of such files, and `tahr run --level` too. */
static void write_level(FILE *file, const struct level *level)
{
    fputs(
        "# Tahr's bundled playground: meshes and boxes that stand still; no water, round pillars or things that move.\n"
        "# Metres, Y up, faces counter-clockwise.\n",
        file);
    for (size_t i = 0; i < 3 * level->triangle_count; i++) {
        const tahr_vec3 *c = &level->corners[i];
        /* Nine digits tell all floats apart; + 0.0: no minus zero. */
        fprintf(file, "v %.9g %.9g %.9g\n", c->x + 0.0, c->z + 0.0, 0.0 - c->y);
    }
    for (size_t i = 0; i < level->triangle_count; i++)
        fprintf(file, "f %zu %zu %zu\n", 3 * i + 1, 3 * i + 2, 3 * i + 3);
}

int export_command(int argc, char **argv)
{
    struct level level;
    if (argc != 2 || argv[1][0] == '-') {
        say_error("usage: tahr level FILE.obj");
        return EXIT_USAGE;
    }
    FILE *file = fopen(argv[1], "wb");
    if (!file) {
        say_error("'%s': cannot write: %s", argv[1], strerror(errno));
        return EXIT_USAGE;
    }
    level_playground(&level);
    write_level(file, &level);
    int failed = ferror(file);
    failed |= fclose(file) != 0;
    if (failed) {
        say_error("'%s': cannot write: %s", argv[1], strerror(errno));
        level_close(&level);
        return EXIT_CHECK_FAILED;
    }
    printf("%s: %zu triangles\n", argv[1], level.triangle_count);
    level_close(&level);
    return EXIT_GOOD;
}
