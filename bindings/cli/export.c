/* SPDX-License-Identifier: MIT
 * export.c: the bundled playground as a Wavefront OBJ, for who wants to walk it in another engine. */
#include "export.h"

#include "level.h"

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

void export_playground(FILE *file)
{
    struct level level;
    level_playground(&level);
    write_level(file, &level);
    level_close(&level);
}
