/* SPDX-License-Identifier: MIT
 * movement.c: whole movement with every setting: by exact slides, by closed forms on the plane and by windows elsewhere;
 * costs, but those of slides, by wanderers on the same level. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "open_ground.h"
#include "run.h"
#include "slides.h"
#include "walk.h"
#include "window.h"

static const char *const LEVELS[] = {"slides", "plane", "playground", "dungeon", "tiles_2d"};
enum { LEVEL_COUNT = sizeof LEVELS / sizeof LEVELS[0] };

/* What all settings of a level share. */
typedef struct place {
    bench_world level;
    chart_windows *windows; /* NULL on the plane: closed forms */
    scene_solid *solid;
} place;

static int is_plane(const char *name)
{
    return strcmp(name, "plane") == 0;
}

static int is_slides(const char *name)
{
    return strcmp(name, "slides") == 0;
}

/* On the plane nothing differs but how time is cut. */
static int is_measured(const char *level, const chart_setting *s)
{
    static const char *const curves[] = {"precise", "stepped", "unreal", "max_substep; stepped; 10 Hz",
                                         "max_substeps; stepped; 10 Hz"};
    if (is_slides(level)) return chart_slides_concern(s);
    for (size_t i = 0; i < sizeof curves / sizeof curves[0]; i++) {
        if (strcmp(s->curve, curves[i]) == 0) return 1;
    }
    return !is_plane(level);
}

static int score(const place *p, const chart_setting *setting, chart_row *row, char *why)
{
    return p->windows ? chart_windows_score(p->windows, setting, row, why)
                      : chart_open_ground_score(&p->level, setting, row, why);
}

static int place_make(place *p, const char *name, uint32_t windows, char *why)
{
    memset(p, 0, sizeof *p);
    p->level.name = name;
    if (is_slides(name)) return 1; /* worlds of their own */
    chart_level_make(&p->level, name);
    if (p->level.missing[0]) {
        snprintf(why, 256, "%s", p->level.missing);
        return 0;
    }
    int two_sided = (p->level.one.flags & TAHR_BODY_TWO_SIDED) != 0;
    if (p->level.mesh.triangle_count) p->solid = scene_solid_open(&p->level.mesh, two_sided);
    if (p->level.mesh.triangle_count && !p->solid) {
        snprintf(why, 256, "out of memory");
        return 0;
    }
    if (is_plane(name)) return 1;
    p->windows = chart_windows_make(&p->level, windows, why);
    return p->windows != NULL;
}

static void place_free(place *p)
{
    chart_windows_free(p->windows);
    scene_solid_close(p->solid);
    bench_world_free(&p->level);
}

/* Errors and costs. */
static int fill(const chart_run *run, const place *p, const chart_setting *setting, chart_row *row, char *why)
{
    chart_pace pace;
    chart_walk walk = {.level = &p->level,
                       .setting = setting,
                       .solid = p->solid,
                       .walkers = run->budget->walkers,
                       .seconds = run->budget->walk_seconds * (setting->slow ? run->budget->slow : 1)};
    if (is_slides(p->level.name)) return chart_slides_measure(setting, run->budget->slide_stride, row, why);
    if (!chart_walk_run(&walk, &pace, why) || !score(p, setting, row, why)) return 0;
    chart_walk_fill(row, &pace, setting->rate);
    return 1;
}

static void measure(chart_run *run, const place *p, const chart_setting *setting)
{
    char why[256] = "";
    chart_row row;
    chart_row_clear(&row);
    row.scene = p->level.name;
    row.curve = setting->curve;
    row.setting = setting->name;
    row.role = setting->role;
    row.value = setting->value;
    if (is_slides(row.scene) && strcmp(setting->curve, "skin") == 0) { /* here the path does not change with it */
        row.scene = "bare slides";
        row.role = CHART_KNOB;
    }
    if (fill(run, p, setting, &row, why)) {
        chart_run_write(run, &row);
    } else {
        chart_run_fail(run, setting->name, why);
    }
}

/* How far the reference itself is to be trusted. */
static void measure_doubt(chart_run *run, const place *p)
{
    char why[256] = "";
    chart_setting setting;
    chart_row row;
    chart_row_clear(&row);
    chart_setting_default(&p->level, &setting);
    row.scene = p->level.name;
    row.curve = row.setting = "reference at 960 Hz";
    row.role = "reference";
    row.reference = "exact at 1920 Hz";
    if (chart_windows_doubt(p->windows, &setting, &row, why)) {
        chart_run_write(run, &row);
    } else {
        chart_run_fail(run, row.setting, why);
    }
}

/* The names of settings do not depend on the level's geometry: counting needs none. */
static void measure_level(chart_run *run, const char *name)
{
    char why[256] = "";
    place p = {.level = {.planar = strcmp(name, "tiles_2d") == 0}};
    int ok = run->counting || place_make(&p, name, run->budget->windows, why);
    if (!ok) chart_run_skip(run, name, why);
    const chart_setting *settings;
    uint32_t count = chart_settings_make(&p.level, &settings);
    if (p.windows) measure_doubt(run, &p);
    for (uint32_t i = 0; i < count; i++) {
        if (!is_measured(name, &settings[i])) continue;
        if (chart_run_next(run, name, settings[i].name) && ok) measure(run, &p, &settings[i]);
    }
    if (!run->counting) place_free(&p);
}

void chart_movement(chart_run *run)
{
    for (int i = 0; i < LEVEL_COUNT; i++) {
        measure_level(run, LEVELS[i]);
    }
}
