/* SPDX-License-Identifier: MIT
 * levels.c: the files that the shell brings along; the build compiles them in. */
#include "levels.h"

#include "say.h"

#include <stdio.h>
#include <string.h>

extern const char level_side_tmj[], level_tour_json[];

static const struct {
    const char *name, *text, *about;
} levels[] = {
    [LEVEL_SIDE] = {"side.tmj", level_side_tmj, "the level of `tahr run --2d`, to be opened with Tiled"},
    [LEVEL_TOUR] = {"tour.json", level_tour_json, "the route of `tahr run --2d --tour` through it"},
};

const char *level_text(int level)
{
    return levels[level].text;
}

int level_command(int argc, char **argv)
{
    const size_t count = sizeof levels / sizeof *levels;
    if (argc < 2) {
        puts("usage: tahr level NAME >FILE\n");
        for (size_t i = 0; i < count; i++) {
            printf("  %-12s %s\n", levels[i].name, levels[i].about);
        }
        return EXIT_GOOD;
    }
    for (size_t i = 0; i < count; i++) {
        if (strcmp(levels[i].name, argv[1]) == 0) {
            fputs(levels[i].text, stdout);
            return EXIT_GOOD;
        }
    }
    say_error("level '%s': expected %s or %s", argv[1], levels[LEVEL_SIDE].name, levels[LEVEL_TOUR].name);
    return EXIT_USAGE;
}
