/* SPDX-License-Identifier: MIT
 * levels.c: the files that the shell brings along: the build compiles them in, or they are made when asked for. */
#include "levels.h"

#include "export.h"
#include "say.h"

#include <stdio.h>
#include <string.h>

extern const unsigned char level_side_tmj[], level_side_png[], level_tour_json[];
extern const unsigned long level_side_tmj_size, level_side_png_size, level_tour_json_size;

static const struct {
    const char *name, *about;
    const unsigned char *bytes;
    const unsigned long *size;
    void (*write)(FILE *file); /* instead of bytes */
} levels[] = {
    [LEVEL_SIDE] = {"side.tmj", "the level of `tahr run --2d`, to be opened with Tiled", level_side_tmj,
                    &level_side_tmj_size, NULL},
    [LEVEL_TILES] = {"side.png", "how its tiles look there", level_side_png, &level_side_png_size, NULL},
    [LEVEL_TOUR] = {"tour.json", "the route of `tahr run --2d --tour` through it", level_tour_json,
                    &level_tour_json_size, NULL},
    {"playground.obj", "what stands still of the level of `tahr run`, for other engines", NULL, NULL,
     export_playground},
};

const char *level_text(int level)
{
    return (const char *)levels[level].bytes;
}

enum { LEVELS = sizeof levels / sizeof *levels };

void level_help(void)
{
    puts("usage: tahr level NAME >FILE\n");
    for (size_t i = 0; i < LEVELS; i++) {
        printf("  %-16s %s\n", levels[i].name, levels[i].about);
    }
}

int level_command(int argc, char **argv)
{
    if (argc < 2 || strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0) {
        level_help();
        return EXIT_GOOD;
    }
    if (argc > 2) {
        say_error("level: unexpected argument '%s'; expected one name", argv[2]);
        return EXIT_USAGE;
    }
    for (size_t i = 0; i < LEVELS; i++) {
        if (strcmp(levels[i].name, argv[1]) == 0) {
            if (levels[i].write) {
                levels[i].write(stdout);
            } else {
                fwrite(levels[i].bytes, 1, *levels[i].size, stdout);
            }
            return EXIT_GOOD;
        }
    }
    say_error("level '%s': expected side.tmj, side.png, tour.json or playground.obj", argv[1]);
    return EXIT_USAGE;
}
