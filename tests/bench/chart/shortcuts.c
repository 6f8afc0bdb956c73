/* SPDX-License-Identifier: MIT
 * shortcuts.c: what each shortcut buys: the same walk with it and without it, in turns, so that the machine's noise
 * meets both alike; of each the best of the rounds. One that promises the same bits is held to it. What a budget of
 * error buys is measured with the crowds, what tolerances buy with whole movement. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "run.h"
#include "scenes.h"
#include "walk.h"

enum { ROUNDS = 3 };

static void no_cache(chart_setting *s, tahr_native_desc *native)
{
    (void)s;
    native->no_cache = 1;
}

static void no_simd(chart_setting *s, tahr_native_desc *native)
{
    (void)s;
    native->no_simd = 1;
}

static void no_margin(chart_setting *s, tahr_native_desc *native)
{
    (void)s;
    native->cache_margin = 1e-3; /* 0 is the default of 1 m */
}

static void no_sleep(chart_setting *s, tahr_native_desc *native)
{
    (void)native;
    s->config.sleep = 0;
}

static void no_cached_floor(chart_setting *s, tahr_native_desc *native)
{
    (void)native;
    s->config.sleep = 0; /* which hides it where nobody moves */
    s->config.cached_floor = 0;
}

static void awake(chart_setting *s, tahr_native_desc *native)
{
    (void)native;
    s->config.sleep = 0;
}

static void no_short_ways(chart_setting *s, tahr_native_desc *native)
{
    (void)native;
    s->config.short_ways = 0;
}

static void no_vicinity(chart_setting *s, tahr_native_desc *native)
{
    (void)s;
    native->no_vicinity = 1;
}

static void no_barred_steps(chart_setting *s, tahr_native_desc *native)
{
    (void)native;
    s->config.barred_steps = 0;
}

static void no_capsule_ends(chart_setting *s, tahr_native_desc *native)
{
    (void)s;
    native->no_capsule_ends = 1;
}

static void no_fields(chart_setting *s, tahr_native_desc *native)
{
    (void)s;
    native->no_fields = 1;
}

/* with: what is set on both sides, NULL: the defaults. exact: promises the same bits. buys_memory: in the world, and a
 * shorter opening. counts: bits, of the TAHR_SHORTCUT_* whose savings it makes. */
typedef struct shortcut {
    const char *name;
    void (*with)(chart_setting *setting, tahr_native_desc *native);
    void (*without)(chart_setting *setting, tahr_native_desc *native);
    int idle, exact, buys_memory;
    uint32_t counts;
} shortcut;

enum {
    SLEEP = 1 << TAHR_SHORTCUT_SLEEP,
    CACHED_FLOOR = 1 << TAHR_SHORTCUT_CACHED_FLOOR,
    BARRED_STEP = 1 << TAHR_SHORTCUT_BARRED_STEP,
    CLEAR_AIR = 1 << TAHR_SHORTCUT_CLEAR_AIR,
    KNOWN_FLOOR = 1 << TAHR_SHORTCUT_KNOWN_FLOOR,
    CACHE = 1 << TAHR_SHORTCUT_CACHE,
    CAPSULE_END = 1 << TAHR_SHORTCUT_CAPSULE_END
};

static const shortcut SHORTCUTS[] = {
    {"cache (no_cache)", NULL, no_cache, 0, 1, 0, CACHE},
    {"margin of the cache (cache_margin)", NULL, no_margin, 0, 1, 0, CACHE},
    {"SIMD (no_simd)", NULL, no_simd, 0, 1, 0, 0},
    {"short ways (short_ways)", NULL, no_short_ways, 0, 1, 0, CLEAR_AIR | KNOWN_FLOOR},
    {"what is near (no_vicinity)", NULL, no_vicinity, 0, 1, 0, CLEAR_AIR | KNOWN_FLOOR},
    {"ends of the capsule (no_capsule_ends)", NULL, no_capsule_ends, 0, 1, 0, CAPSULE_END},
    {"steps that are barred (barred_steps)", NULL, no_barred_steps, 0, 1, 0, BARRED_STEP},
    {"sleep", NULL, no_sleep, 0, 1, 0, SLEEP},
    {"cached_floor", awake, no_cached_floor, 0, 1, 0, CACHED_FLOOR},
    {"sleep", NULL, no_sleep, 1, 1, 0, SLEEP},
    {"cached_floor (awake)", awake, no_cached_floor, 1, 1, 0, CACHED_FLOOR},
    {"cache (no_cache; awake)", awake, no_cache, 1, 1, 0, CACHE},
};
enum { SHORTCUT_COUNT = sizeof SHORTCUTS / sizeof SHORTCUTS[0] };

static const char *const LEVELS[] = {"playground", "dungeon"};
enum { LEVEL_COUNT = sizeof LEVELS / sizeof LEVELS[0] };

/* Buys nothing but on ground that is one. */
static const shortcut FIELDS = {"field of heights (no_fields)", NULL, no_fields, 0, 1, 1, 0};
enum { HILLS = 100000 };

/* side 0: with the shortcut, 1: without. */
static void make_setting(const bench_world *level, const shortcut *s, int side, chart_setting *setting)
{
    tahr_native_desc native = {.struct_size = sizeof native};
    chart_setting_default(level, setting);
    if (s->with) s->with(setting, &native);
    if (side) s->without(setting, &native);
    memcpy(&setting->options, &native, sizeof native);
}

static void keep_best(chart_pace *best, const chart_pace *pace)
{
    best->ns_p50 = fmin(best->ns_p50, pace->ns_p50);
    best->ns_p99 = fmin(best->ns_p99, pace->ns_p99);
    best->ns_mean = fmin(best->ns_mean, pace->ns_mean);
}

static double saved_by(const shortcut *s, const chart_pace *pace)
{
    double saved = 0;
    for (uint32_t i = 0; i < TAHR_SHORTCUT_COUNT; i++) {
        saved += s->counts >> i & 1 ? pace->saved[i] : 0;
    }
    return s->counts ? saved : NAN;
}

static void write_sides(chart_run *run, const bench_world *level, const shortcut *s, const char *scene,
                        const chart_pace pace[2])
{
    for (int side = 0; side < 2; side++) {
        chart_row row;
        chart_row_clear(&row);
        chart_walk_fill(&row, &pace[side], 60);
        row.scene = scene;
        if (s->buys_memory) {
            row.bytes = (double)pace[side].bytes / level->mesh.triangle_count;
            row.build_seconds = pace[side].build_seconds;
        }
        row.saved = saved_by(s, &pace[side]);
        row.curve = s->name;
        row.setting = side ? "off" : "on";
        row.role = side ? CHART_OFF : CHART_DEFAULT;
        row.reference = pace[0].hash == pace[1].hash ? "same bits" : "other bits";
        if (s->exact && pace[0].hash != pace[1].hash) {
            row.failed++;
            snprintf(row.why, sizeof row.why, "promises the same bits");
        }
        chart_run_write(run, &row);
    }
}

static void measure(chart_run *run, const bench_world *level, const shortcut *s, const char *scene)
{
    char why[256] = "";
    chart_pace pace[2];
    for (int round = 0; round < ROUNDS; round++) {
        for (int side = 0; side < 2; side++) {
            chart_setting setting;
            chart_pace one;
            make_setting(level, s, side, &setting);
            chart_walk walk = {.level = level,
                               .setting = &setting,
                               .walkers = run->budget->walkers,
                               .seconds = run->budget->walk_seconds / 2,
                               .idle = s->idle};
            if (!chart_walk_run(&walk, &one, why)) {
                chart_run_fail(run, s->name, why);
                return;
            }
            if (round == 0) pace[side] = one;
            keep_best(&pace[side], &one);
        }
    }
    write_sides(run, level, s, scene, pace);
}

static void measure_level(chart_run *run, const char *name)
{
    bench_world level = {.name = name};
    if (!run->counting) chart_level_make(&level, name);
    if (level.missing[0]) chart_run_skip(run, name, level.missing);
    for (int i = 0; i < SHORTCUT_COUNT; i++) {
        char scene[64];
        snprintf(scene, sizeof scene, "%s %s", SHORTCUTS[i].idle ? "standing in" : "walking in", name);
        if (chart_run_next(run, scene, SHORTCUTS[i].name) && !level.missing[0]) {
            measure(run, &level, &SHORTCUTS[i], scene);
        }
    }
    if (!run->counting) bench_world_free(&level);
}

static void measure_fields(chart_run *run)
{
    const uint32_t most = run->budget->max_triangles;
    bench_world level;
    if (!chart_run_next(run, "walking in hills", FIELDS.name)) return;
    if (chart_hills_make(&level, most < HILLS ? most : HILLS, 0)) {
        measure(run, &level, &FIELDS, "walking in hills");
    } else {
        chart_run_fail(run, FIELDS.name, "out of memory");
    }
    bench_world_free(&level);
}

void chart_shortcuts(chart_run *run)
{
    for (int i = 0; i < LEVEL_COUNT; i++) {
        measure_level(run, LEVELS[i]);
    }
    measure_fields(run);
}
