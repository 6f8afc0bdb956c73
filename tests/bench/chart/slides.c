/* SPDX-License-Identifier: MIT
 * slides.c: flies every stored slide with a setting, as tests/accuracy/test_slide_truth.c does: no gravity, drag or
 * steps, and every step begins with the velocity that is wanted. The error of a slide is the largest of its path. */
#include "slides.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "truth_file.h"
#include "run.h"

enum { MAX_SLIDES = 256, MAX_STEPS = 1 << 20 };

typedef struct trial {
    const chart_setting *setting;
    int bare; /* the slides without a skin */
    double errors[MAX_SLIDES], queries, tests, iterations, seconds, deepest;
    float *times;
    uint32_t slides, steps, failed, stride, seen;
    char *why;
    int ok;
} trial;

int chart_slides_concern(const chart_setting *s)
{
    static const char *const curves[] = {"precise", "max_slides", "path_tolerance", "skin", "native", "ccd advance",
                                         "fcl descend"};
    for (size_t i = 0; i < sizeof curves / sizeof curves[0]; i++) {
        if (strcmp(s->curve, curves[i]) == 0) return 1;
    }
    return 0;
}

static tahr_config config_of(const trial *t, const truth_slide *slide)
{
    tahr_config c = t->setting->config;
    c.shape = slide->shape;
    c.skin = t->bare ? c.skin : slide->margin;
    c.step_height = 0;
    c.acceleration = c.turn_friction = c.fly_drag = 0;
    c.crouched_half_height = slide->shape.half_height;
    return c;
}

static tahr_status open_slide(const chart_setting *s, const truth_slide *slide, tahr_world **world)
{
    tahr_world_desc desc;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = slide->descs;
    desc.body_count = slide->scene.body_count;
    desc.options = s->options.words[0] ? &s->options : NULL;
    return tahr_world_open(s->get(), &desc, world);
}

static void note(trial *t, const tahr_report *r, double seconds)
{
    t->queries += r->sweeps + r->contact_queries + r->rays;
    t->tests += (double)r->triangle_tests;
    t->iterations += (double)r->narrow_iterations;
    t->seconds += seconds;
    t->times[t->steps++] = (float)(1e9 * seconds);
}

static tahr_status fly(trial *t, const truth_slide *slide, const tahr_config *config, tahr_mover *mover)
{
    const score_path_desc desc = {.reference = &slide->path, .scene = &slide->scene, .reach = 0.1};
    tahr_input input = {.struct_size = sizeof input, .flags = TAHR_INPUT_DRIVE, .drive = slide->wish};
    tahr_state state;
    score_path path = {0};
    uint32_t steps = (uint32_t)(slide->duration * t->setting->rate);
    tahr_status status = tahr_state_init(&state, config, &slide->position);
    state.mode = TAHR_MODE_FLYING;
    state.velocity = slide->wish;
    score_step s = score_step_of(&state, &config->shape, 0, TAHR_OK, NULL);
    score_path_start(&path, &desc, &s);
    for (uint32_t i = 1; status >= 0 && i <= steps && t->steps < MAX_STEPS; i++) {
        tahr_report report = {.struct_size = sizeof report};
        double before = chart_monotonic();
        status = tahr_mover_step(mover, &input, 1 / t->setting->rate, &state, &report);
        note(t, &report, chart_monotonic() - before);
        s = score_step_of(&state, &config->shape, i / t->setting->rate, status, &report);
        score_path_add(&path, &s);
    }
    t->errors[t->slides++] = path.error.max;
    t->failed += path.failed_steps;
    if (!t->bare) t->deepest = fmax(t->deepest, path.deepest);
    score_path_free(&path);
    return status;
}

static void try_slide(void *user, const truth_slide *slide)
{
    trial *t = user;
    tahr_world *world = NULL;
    tahr_mover *mover = NULL;
    if (!t->ok || (slide->margin <= 0) != t->bare || t->slides == MAX_SLIDES) return;
    if (t->seen++ % t->stride) return;
    tahr_config config = config_of(t, slide);
    tahr_status status = open_slide(t->setting, slide, &world);
    if (status >= 0) status = tahr_mover_create(world, &config, &mover);
    if (status >= 0) status = fly(t, slide, &config, mover);
    if (status < 0) snprintf(t->why, 256, "%s: %s", slide->name, tahr_status_name(status));
    t->ok = status >= 0;
    tahr_mover_destroy(mover);
    tahr_world_close(world);
}

static int by_value(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static void fill(chart_row *row, trial *t)
{
    double cost = chart_clock_cost(), n = t->steps;
    qsort(t->times, t->steps, sizeof t->times[0], by_value);
    row->reference = t->bare ? "exact slides along bare walls" : "exact slides";
    row->samples = t->steps;
    row->failed = t->failed;
    if (t->failed) snprintf(row->why, sizeof row->why, "%u steps stuck; crushed; unknown or capped", t->failed);
    chart_row_errors(row, t->errors, t->slides);
    row->penetration = t->bare ? NAN : t->deepest;
    row->rate = t->setting->rate;
    row->ns_p50 = fmax(1, t->times[t->steps / 2] - cost);
    row->ns_p99 = fmax(1, t->times[t->steps - 1 - t->steps / 100] - cost);
    row->ns_mean = fmax(1, 1e9 * t->seconds / n - cost);
    row->ns_second = row->ns_mean * row->rate;
    row->queries = t->queries / n;
    row->tests = t->tests / n;
    row->iterations = t->iterations / n;
}

int chart_slides_measure(const chart_setting *setting, uint32_t stride, chart_row *row, char *why)
{
    trial *t = calloc(1, sizeof *t);
    int ok = t != NULL;
    if (ok) {
        *t = (trial){.setting = setting, .stride = stride, .why = why, .ok = 1};
        t->bare = strcmp(setting->curve, "skin") == 0;
        t->times = malloc(MAX_STEPS * sizeof *t->times);
        ok = t->times != NULL;
    }
    snprintf(why, 256, "out of memory, or no slides");
    if (ok) truth_each_slide(try_slide, t);
    ok = ok && t->ok && t->steps > 0;
    if (ok) fill(row, t);
    if (t) free(t->times);
    free(t);
    return ok;
}
