/* SPDX-License-Identifier: MIT
 * options.c: the options of `tahr run`, read strictly: every message names the option and the value. */
#include "options.h"

#include "argument.h"
#include "say.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <tahr/config.h>

#define TOUR_SECONDS 65 /* it waits for a shuttle and a lift on the way */

enum {
    OPTION_LEVEL = 256,
    OPTION_UP,
    OPTION_CHARACTERS,
    OPTION_CROWD,
    OPTION_THREADS,
    OPTION_SECONDS,
    OPTION_RATE,
    OPTION_SEED,
    OPTION_PRESET,
    OPTION_BACKEND,
    OPTION_ROUTE,
    OPTION_CSV,
    OPTION_PLOT,
    OPTION_TRACE,
    OPTION_CHECK,
    OPTION_JSON,
    OPTION_2D,
    OPTION_TOUR,
    OPTION_PIXELS,
    OPTION_TILES,
    OPTION_SHAPE,
    OPTION_LCM,
    OPTION_LCM_RATE,
    OPTION_LCM_PREFIX,
    OPTION_FAST,
    OPTION_HELP
};

static const struct option known[] = {{"level", required_argument, NULL, OPTION_LEVEL},
                                      {"up", required_argument, NULL, OPTION_UP},
                                      {"characters", required_argument, NULL, OPTION_CHARACTERS},
                                      {"crowd", no_argument, NULL, OPTION_CROWD},
                                      {"threads", required_argument, NULL, OPTION_THREADS},
                                      {"seconds", required_argument, NULL, OPTION_SECONDS},
                                      {"rate", required_argument, NULL, OPTION_RATE},
                                      {"seed", required_argument, NULL, OPTION_SEED},
                                      {"preset", required_argument, NULL, OPTION_PRESET},
                                      {"backend", required_argument, NULL, OPTION_BACKEND},
                                      {"route", required_argument, NULL, OPTION_ROUTE},
                                      {"csv", required_argument, NULL, OPTION_CSV},
                                      {"plot", required_argument, NULL, OPTION_PLOT},
                                      {"trace", required_argument, NULL, OPTION_TRACE},
                                      {"check", required_argument, NULL, OPTION_CHECK},
                                      {"json", no_argument, NULL, OPTION_JSON},
                                      {"2d", no_argument, NULL, OPTION_2D},
                                      {"tour", no_argument, NULL, OPTION_TOUR},
                                      {"pixels-per-metre", required_argument, NULL, OPTION_PIXELS},
                                      {"tiles", required_argument, NULL, OPTION_TILES},
                                      {"shape", required_argument, NULL, OPTION_SHAPE},
                                      {"lcm", required_argument, NULL, OPTION_LCM},
                                      {"lcm-rate", required_argument, NULL, OPTION_LCM_RATE},
                                      {"lcm-prefix", required_argument, NULL, OPTION_LCM_PREFIX},
                                      {"fast", no_argument, NULL, OPTION_FAST},
                                      {"help", no_argument, NULL, OPTION_HELP},
                                      {NULL, 0, NULL, 0}};

void options_help(void)
{
    fputs(
        "usage: tahr run [options]\n"
        "\n"
        "Drives characters through a level and reports how they fared.\n"
        "\n"
        "  --level FILE       OBJ, glTF or what else Assimp reads; maps of voxels (.bt, .ot: Z up, backend fcl);\n"
        "                     without it the bundled playground.\n"
        "                     With --2d: a map of Tiled (.tmj); without it the bundled side-scroller\n"
        "  --2d               two dimensions, seen from the side: x to the right, y up\n"
        "  --up y|z           which axis of the file points up (y); shown and written is always Z up: (x, -z, y)\n"
        "  --characters N     1 to 100000 wandering characters (16)\n"
        "  --crowd            the characters are obstacles of each other; without it they pass through each other\n"
        "  --threads T        1 to 256 threads that step them; changes no result, and times are then means of a step\n"
        "  --seconds S        simulated time (10; 65 with --tour)\n"
        "  --rate HZ          steps per second, 1 to 100000 (60)\n"
        "  --seed K           of spawn points and headings (1)\n"
        "  --preset NAME      settings of the characters: precise, unreal, platformer (precise;\n"
        "                     with --2d platformer)\n"
        "  --shape NAME       of the characters: capsule, box (flat feet), sphere (capsule)\n"
        "  --backend NAME     collision engine, one of",
        stdout);
    for (size_t i = 0; backend_choice_at(i) != NULL; i++) {
        printf("%s %s", i ? "," : "", backend_choice_at(i)->name);
    }
    fputs(
        " (native);\n"
        "                     or the path of a shared object with one in it: ./libtahr_mine.so\n"
        "  --route FILE       one character with timed inputs instead of wandering, as JSON:\n"
        "                     {\"start\": [x, y, z], \"inputs\": [{\"time\": 0, \"move\": [1, 0, 0], \"jump\": "
        "true}, ...]}\n"
        "                     or the list alone. An entry holds until the next one; what it does not name is off.\n"
        "                     move: direction, length 0 to 1; jump, crouch; facing: direction; start: centre of the\n"
        "                     capsule; once, when the entry begins: launch: velocity to add; mode: its name.\n"
        "                     drop: through the platform stood on. Instead of time: after: seconds since the entry\n"
        "                     before began; at_x, at_y: when the centre passes there. With --2d z may be left out\n"
        "  --tour             with --2d and no --level: the bundled route through everything in the bundled level\n"
        "  --pixels-per-metre P  of a --2d level (its property pixels_per_metre, or one tile's height)\n"
        "  --tiles MODE       of a --2d level: joined: neighbouring tiles become one outline; separate: one body each\n"
        "                     (joined)\n"
        "  --csv FILE         one row per character and step\n"
        "  --plot FILE        .svg or .png: the level from above with the paths, and the heights below\n"
        "  --trace FILE       the whole run, for `tahr replay FILE`: what a bug report needs, in one file\n"
        "  --lcm URL          publishes what happens: udpm://ADDRESS:PORT?ttl=N as fast as it does in truth, to be\n"
        "                     watched (`tahr listen`); file:///PATH as fast as it goes (for `tahr replay --verify`)\n"
        "  --lcm-rate HZ      at most so many states of a character per simulated second (all)\n"
        "  --lcm-prefix P     before the names of the channels\n"
        "  --fast             to a network too as fast as it goes\n"
        "  --check MODE       all, sampled (every 16th step) or off: independent look for tunnelling (from 5 Hz up)\n"
        "                     and overlaps\n"
        "  --json             the summary as one JSON object\n"
        "\n"
        "Exit code: 0 all well, 1 a check failed or the run could not go on, 2 wrong usage.\n",
        stdout);
}

static int read_preset(const char *text, int32_t *preset)
{
    char wanted[200] = "known are:";
    for (int32_t id = 1; strcmp(tahr_preset_name(id), "?") != 0; id++) {
        size_t used = strlen(wanted);
        if (strcmp(tahr_preset_name(id), text) == 0) {
            *preset = id;
            return 0;
        }
        snprintf(wanted + used, sizeof wanted - used, "%s %s", id > 1 ? "," : "", tahr_preset_name(id));
    }
    return argument_refuse("preset", text, wanted);
}

static int read_backend(const char *text, struct options *o)
{
    char wanted[200] = "known are:";
    if (backend_is_path(text)) {
        backend_unload(&o->loaded);
        o->backend = &o->loaded.choice;
        return backend_load(&o->loaded, text);
    }
    o->backend = backend_choice_find(text);
    if (o->backend != NULL) {
        return 0;
    }
    for (size_t i = 0; backend_choice_at(i) != NULL; i++) {
        size_t used = strlen(wanted);
        snprintf(wanted + used, sizeof wanted - used, "%s %s", i ? "," : "", backend_choice_at(i)->name);
    }
    const size_t used = strlen(wanted);
    snprintf(wanted + used, sizeof wanted - used, "; or the path of a shared object, with a / or ending in .so");
    return argument_refuse("backend", text, wanted);
}

static int read_shape(const char *text, uint32_t *shape)
{
    static const char *const names[] = {
        [TAHR_SHAPE_SPHERE] = "sphere", [TAHR_SHAPE_CAPSULE] = "capsule", [TAHR_SHAPE_BOX] = "box"};
    for (uint32_t i = TAHR_SHAPE_SPHERE; i <= TAHR_SHAPE_BOX; i++) {
        if (strcmp(names[i], text) == 0) {
            *shape = i;
            return 0;
        }
    }
    return argument_refuse("shape", text, "expected capsule, box or sphere");
}

static int read_tiles(const char *text, int *separate)
{
    *separate = strcmp(text, "separate") == 0;
    return *separate || strcmp(text, "joined") == 0 ? 0 : argument_refuse("tiles", text, "expected joined or separate");
}

static int read_check(const char *text, enum check_mode *mode)
{
    static const char *const names[] = {[CHECK_OFF] = "off", [CHECK_SAMPLED] = "sampled", [CHECK_ALL] = "all"};
    for (int i = CHECK_OFF; i <= CHECK_ALL; i++) {
        if (strcmp(names[i], text) == 0) {
            *mode = (enum check_mode)i;
            return 0;
        }
    }
    return argument_refuse("check", text, "expected all, sampled or off");
}

static int read_up(const char *text, char *up)
{
    if (strcmp(text, "y") != 0 && strcmp(text, "z") != 0) {
        return argument_refuse("up", text, "expected y or z");
    }
    *up = text[0];
    return 0;
}

static int read_option(struct options *o, int option, const char *value)
{
    uint64_t whole = o->characters;
    int failed = 0;
    switch (option) {
    case OPTION_LEVEL: o->level = value; return 0;
    case OPTION_UP: return read_up(value, &o->up);
    case OPTION_CHARACTERS:
        failed = argument_whole("characters", value, 1, 100000, &whole);
        o->characters = (uint32_t)whole;
        return failed;
    case OPTION_CROWD: o->crowd = 1; return 0;
    case OPTION_THREADS:
        whole = 0;
        failed = argument_whole("threads", value, 1, 256, &whole);
        o->threads = (uint32_t)whole;
        return failed;
    case OPTION_SECONDS: return argument_number("seconds", value, 1e-6, 1e6, &o->seconds);
    case OPTION_RATE: return argument_number("rate", value, 1, 1e5, &o->rate);
    case OPTION_SEED: return argument_whole("seed", value, 0, INT64_MAX, &o->seed);
    case OPTION_PRESET: return read_preset(value, &o->preset);
    case OPTION_BACKEND: return read_backend(value, o);
    case OPTION_ROUTE: o->route = value; return 0;
    case OPTION_CSV: o->csv = value; return 0;
    case OPTION_PLOT: o->plot = value; return 0;
    case OPTION_TRACE: o->trace = value; return 0;
    case OPTION_CHECK: return read_check(value, &o->check);
    case OPTION_2D: o->side = 1; return 0;
    case OPTION_TOUR: o->tour = 1; return 0;
    case OPTION_PIXELS: return argument_number("pixels-per-metre", value, 1e-3, 1e6, &o->pixels_per_metre);
    case OPTION_TILES: return read_tiles(value, &o->separate_tiles);
    case OPTION_SHAPE: return read_shape(value, &o->shape);
    case OPTION_LCM: o->lcm = value; return 0;
    case OPTION_LCM_RATE: return argument_number("lcm-rate", value, 1e-3, 1e5, &o->lcm_rate);
    case OPTION_LCM_PREFIX: o->lcm_prefix = value; return 0;
    case OPTION_FAST: o->fast = 1; return 0;
    default: o->json = 1; return 0;
    }
}

/* What belongs to two dimensions, and what does not. */
static int check_side(struct options *o, const char given[OPTION_HELP + 1])
{
    static const struct {
        int option;
        const char *name;
    } only[] = {{OPTION_TOUR, "tour"}, {OPTION_PIXELS, "pixels-per-metre"}, {OPTION_TILES, "tiles"}};
    for (size_t i = 0; i < sizeof only / sizeof *only && !o->side; i++) {
        if (given[only[i].option]) {
            say_error("--%s: only with --2d", only[i].name);
            return -1;
        }
    }
    if (!o->side && (backend_table(o->backend)->capabilities & TAHR_CAP_PLANAR)) {
        say_error("--backend %s: has two dimensions; expected --2d with it", o->backend->name);
        return -1;
    }
    if (!o->side && o->preset == TAHR_PRESET_PLATFORMER) {
        say_error("--preset platformer: moves in a plane, where y is up; expected --2d with it");
        return -1;
    }
    const char *ending = o->level != NULL ? strrchr(o->level, '.') : NULL;
    if (!o->side && ending != NULL && strcmp(ending, ".tmj") == 0) {
        say_error("--level '%s': is a map of two dimensions; expected --2d with it", o->level);
        return -1;
    }
    if (o->side && given[OPTION_UP]) {
        say_error("--up %c: not with --2d, where y is up", o->up);
        return -1;
    }
    if (o->tour && (o->level != NULL || o->route != NULL)) {
        say_error("--tour: is a route through the bundled level; expected neither --level nor --route with it");
        return -1;
    }
    o->seconds = o->tour && !given[OPTION_SECONDS] ? TOUR_SECONDS : o->seconds;
    if (o->side && !given[OPTION_PRESET]) {
        o->preset = TAHR_PRESET_PLATFORMER;
    }
    return 0;
}

/* What single options cannot see. */
static int check_together(struct options *o, const char given[OPTION_HELP + 1])
{
    const int characters_given = given[OPTION_CHARACTERS], up_given = given[OPTION_UP];
    size_t length = o->plot != NULL ? strlen(o->plot) : 0;
    if (o->plot != NULL &&
        (length < 5 || (strcmp(o->plot + length - 4, ".svg") != 0 && strcmp(o->plot + length - 4, ".png") != 0))) {
        return argument_refuse("plot", o->plot, "expected a name that ends in .svg or .png");
    }
    if (check_side(o, given) != 0) {
        return -1;
    }
    if ((o->route != NULL || o->tour) && characters_given && o->characters != 1) {
        say_error("--characters %u: a --route or --tour drives one character", o->characters);
        return -1;
    }
    if (o->trace != NULL && (o->threads > 0 || o->crowd)) {
        say_error("--trace '%s': not with --%s; a trace knows one character at a time", o->trace,
                  o->crowd ? "crowd" : "threads");
        return -1;
    }
    if (o->level == NULL && up_given) {
        say_error("--up %c: only for a --level; the playground is Z up", o->up);
        return -1;
    }
    if (o->lcm == NULL && (o->lcm_rate > 0 || o->lcm_prefix != NULL || o->fast)) {
        say_error("--%s: only with --lcm URL", o->lcm_rate > 0 ? "lcm-rate" : o->fast ? "fast" : "lcm-prefix");
        return -1;
    }
    if (o->csv != NULL && o->plot != NULL && strcmp(o->csv, o->plot) == 0) {
        say_error("--csv and --plot both write '%s'", o->csv);
        return -1;
    }
    const char *other = o->csv != NULL && o->trace != NULL && strcmp(o->csv, o->trace) == 0     ? "csv"
                        : o->plot != NULL && o->trace != NULL && strcmp(o->plot, o->trace) == 0 ? "plot"
                                                                                                : NULL;
    if (other != NULL) {
        say_error("--%s and --trace both write '%s'", other, o->trace);
        return -1;
    }
    if (o->seconds * o->rate < 0.5 || o->seconds * o->rate > 4e9) {
        say_error("--seconds %g at --rate %g: that is %.3g steps; expected 1 to 4e9", o->seconds, o->rate,
                  o->seconds * o->rate);
        return -1;
    }
    o->characters = o->route != NULL || o->tour ? 1 : o->characters;
    return 0;
}

int options_parse(struct options *options, int argc, char **argv)
{
    char given[OPTION_HELP + 1] = {0}; /* by option */
    int option;
    *options = (struct options){.up = 'y',
                                .characters = 16,
                                .seconds = 10,
                                .rate = 60,
                                .seed = 1,
                                .preset = TAHR_PRESET_PRECISE,
                                .backend = backend_choice_at(0),
                                .check = CHECK_SAMPLED};
    while ((option = argument_next(argc, argv, known)) != -1) {
        if (option == '?') {
            return -1;
        }
        if (option == OPTION_HELP) {
            options_help();
            return 1;
        }
        if (read_option(options, option, optarg) != 0) {
            return -1;
        }
        given[option] = 1;
    }
    if (optind < argc) {
        say_error("unexpected argument '%s'; a level is given with --level FILE", argv[optind]);
        return -1;
    }
    options->backend_given = given[OPTION_BACKEND];
    return check_together(options, given);
}

/* The option of a level that an argument names, or NULL. */
static const struct option *option_of_level(const char *argument)
{
    static const int own[] = {OPTION_LEVEL, OPTION_UP, OPTION_BACKEND, OPTION_2D, OPTION_PIXELS, OPTION_TILES};
    if (strncmp(argument, "--", 2) != 0) {
        return NULL;
    }
    const size_t length = strcspn(argument + 2, "=");
    for (size_t i = 0; known[i].name != NULL; i++) {
        for (size_t k = 0; k < sizeof own / sizeof *own; k++) {
            if (known[i].val == own[k] && strlen(known[i].name) == length &&
                strncmp(argument + 2, known[i].name, length) == 0) {
                return &known[i];
            }
        }
    }
    return NULL;
}

int options_of_level(int *argc, char **argv, char **of_level)
{
    int kept = 1, taken = 1;
    of_level[0] = argv[0];
    for (int i = 1; i < *argc; i++) {
        const struct option *option = option_of_level(argv[i]);
        if (option == NULL) {
            argv[kept++] = argv[i];
            continue;
        }
        of_level[taken++] = argv[i];
        if (option->has_arg == required_argument && strchr(argv[i], '=') == NULL && i + 1 < *argc) {
            of_level[taken++] = argv[++i];
        }
    }
    argv[kept] = of_level[taken] = NULL;
    *argc = kept;
    return taken;
}

void options_close(struct options *options)
{
    backend_unload(&options->loaded);
}
