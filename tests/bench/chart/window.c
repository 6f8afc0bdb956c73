/* SPDX-License-Identifier: MIT
 * window.c: starts, references and their comparison. References are kept: many settings share one. */
#include "window.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SAMPLES = 10, MAX_REFERENCES = 24, APART = 30 };

static const double SAMPLE_RATE = 10; /* Hz */
static const double SETTLE_RATE = 240, SETTLE_SECONDS = 0.5;
static const double UNDECIDED = 1e-3; /* m */

typedef struct wish {
    tahr_vec3 position, move;
    uint32_t jump;
} wish;

typedef struct path {
    tahr_vec3 at[SAMPLES];
} path;

typedef struct reference {
    tahr_config config; /* whose it is */
    double rate;        /* Hz */
    tahr_state *starts;
    path *paths;
    double *doubts; /* m, from itself at half its rate, in the order of the windows */
    uint32_t decided;
} reference;

struct chart_windows {
    const bench_world *level;
    wish *wishes;
    uint32_t count;
    reference references[MAX_REFERENCES];
    uint32_t reference_count, oldest;
};

static void reference_free(reference *r)
{
    free(r->starts);
    free(r->paths);
    free(r->doubts);
    memset(r, 0, sizeof *r);
}

void chart_windows_free(chart_windows *w)
{
    if (!w) return;
    for (uint32_t i = 0; i < w->reference_count; i++) {
        reference_free(&w->references[i]);
    }
    free(w->wishes);
    free(w);
}

/* Where wanderers are every half second, and where each of them then wants to go; one of three jumps. */
static int collect(chart_windows *w, tahr_world *world, tahr_mover *mover, const tahr_config *config)
{
    uint64_t seed = 29;
    tahr_state state;
    scene_wanderer wanderer;
    for (uint32_t i = 0; i < w->count; i++) {
        const tahr_input *input = NULL;
        if (i % 8 == 0 && !scene_wander_spawn(world, config, &w->level->spawn, &seed, &state)) return 0;
        if (i % 8 == 0) scene_wander_start(&wanderer, 31, i);
        for (int k = 0; k < APART; k++) {
            input = bench_world_wish(w->level, &wanderer, 1.0 / 60);
            if (tahr_mover_step(mover, input, 1.0 / 60, &state, NULL) < 0) return 0;
        }
        /* The whole speed: what becomes of a part of it is a matter of definition. */
        double length = sqrt(input->move.x * input->move.x + input->move.y * input->move.y);
        tahr_vec3 move = {input->move.x / length, input->move.y / length, 0};
        w->wishes[i] = (wish){state.position, move, i % 3 == 2};
    }
    return 1;
}

chart_windows *chart_windows_make(const bench_world *level, uint32_t count, char *why)
{
    chart_setting setting, exact;
    tahr_world *world = NULL;
    tahr_mover *mover = NULL;
    chart_windows *w = calloc(1, sizeof *w);
    if (w) *w = (chart_windows){.level = level, .count = count, .wishes = calloc(count, sizeof *w->wishes)};
    chart_setting_default(level, &setting);
    chart_setting_reference(&setting, &exact);
    int ok = w && w->wishes && chart_setting_open(&exact, level, &world) >= 0 &&
             tahr_mover_create(world, &exact.config, &mover) >= 0 && collect(w, world, mover, &exact.config);
    tahr_mover_destroy(mover);
    tahr_world_close(world);
    if (!ok) {
        snprintf(why, 256, "no windows: out of memory, or nowhere to start");
        chart_windows_free(w);
        return NULL;
    }
    return w;
}

/* At rest, as the reference comes to rest where the window begins. */
static int settle(const chart_windows *w, tahr_mover *mover, const tahr_config *config, tahr_state *starts)
{
    tahr_input input = {.struct_size = sizeof input};
    for (uint32_t i = 0; i < w->count; i++) {
        tahr_state_init(&starts[i], config, &w->wishes[i].position);
        for (int k = 0; k < (int)(SETTLE_SECONDS * SETTLE_RATE); k++) {
            if (tahr_mover_step(mover, &input, 1 / SETTLE_RATE, &starts[i], NULL) < 0) return 0;
        }
    }
    return 1;
}

static int follow(const wish *w, tahr_mover *mover, double rate, const tahr_state *start, path *out)
{
    tahr_state state = *start;
    tahr_input input = {.struct_size = sizeof input, .move = w->move, .jump = w->jump};
    int steps = (int)(rate / SAMPLE_RATE + 0.5);
    for (int i = 0; i < SAMPLES; i++) {
        for (int k = 0; k < steps; k++) {
            if (tahr_mover_step(mover, &input, 1 / rate, &state, NULL) < 0) return 0;
        }
        out->at[i] = state.position;
    }
    return 1;
}

/* The largest distance between two paths at the same times; NAN counts as farthest. */
static double apart(const path *a, const path *b)
{
    double most = 0;
    for (int i = 0; i < SAMPLES; i++) {
        double x = a->at[i].x - b->at[i].x, y = a->at[i].y - b->at[i].y, z = a->at[i].z - b->at[i].z;
        double d = sqrt(x * x + y * y + z * z);
        if (!(d <= most)) most = d;
    }
    return most;
}

static int compute(const chart_windows *w, tahr_mover *mover, reference *r)
{
    if (!settle(w, mover, &r->config, r->starts)) return 0;
    for (uint32_t i = 0; i < w->count; i++) {
        path half;
        if (!follow(&w->wishes[i], mover, r->rate, &r->starts[i], &r->paths[i])) return 0;
        if (!follow(&w->wishes[i], mover, r->rate / 2, &r->starts[i], &half)) return 0;
        r->doubts[i] = apart(&half, &r->paths[i]);
        r->decided += r->doubts[i] <= UNDECIDED;
    }
    return 1;
}

/* The reference of a setting, found or made. NULL: it cannot be. */
static const reference *reference_of(chart_windows *w, const chart_setting *setting)
{
    chart_setting exact;
    chart_setting_reference(setting, &exact);
    for (uint32_t i = 0; i < w->reference_count; i++) {
        if (memcmp(&w->references[i].config, &exact.config, sizeof exact.config) == 0) return &w->references[i];
    }
    int full = w->reference_count == MAX_REFERENCES;
    reference *r = &w->references[full ? w->oldest++ % MAX_REFERENCES : w->reference_count++];
    reference_free(r);
    *r = (reference){.config = exact.config,
                     .rate = exact.rate,
                     .starts = calloc(w->count, sizeof *r->starts),
                     .paths = calloc(w->count, sizeof *r->paths),
                     .doubts = calloc(w->count, sizeof *r->doubts)};
    tahr_world *world = NULL;
    tahr_mover *mover = NULL;
    int ok = r->starts && r->paths && r->doubts && chart_setting_open(&exact, w->level, &world) >= 0 &&
             tahr_mover_create(world, &exact.config, &mover) >= 0 && compute(w, mover, r);
    tahr_mover_destroy(mover);
    tahr_world_close(world);
    if (!ok) memset(&r->config, 0, sizeof r->config); /* found by nobody */
    return ok ? r : NULL;
}

/* One error for each window that the reference decides. */
static uint32_t compare(const chart_windows *w, tahr_mover *mover, double rate, const reference *r, double *errors)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < w->count; i++) {
        path p;
        if (r->doubts[i] > UNDECIDED) continue;
        errors[count++] = follow(&w->wishes[i], mover, rate, &r->starts[i], &p) ? apart(&p, &r->paths[i]) : HUGE_VAL;
    }
    return count;
}

int chart_windows_score(chart_windows *w, const chart_setting *setting, chart_row *row, char *why)
{
    const reference *r = reference_of(w, setting);
    tahr_world *world = NULL;
    tahr_mover *mover = NULL;
    double *errors = calloc(w->count, sizeof *errors);
    tahr_status status = TAHR_E_MEMORY;
    if (r && errors) status = chart_setting_open(setting, w->level, &world);
    if (status >= 0) status = tahr_mover_create(world, &setting->config, &mover);
    if (status >= 0) {
        chart_row_errors(row, errors, compare(w, mover, setting->rate, r, errors));
        row->reference =
            setting->config.integrator == TAHR_INTEGRATOR_STEPPED ? "stepped at 7680 Hz" : "exact at 1920 Hz";
    } else {
        snprintf(why, 256, "%s", r ? tahr_status_name(status) : "no reference");
    }
    tahr_mover_destroy(mover);
    tahr_world_close(world);
    free(errors);
    return status >= 0;
}

int chart_windows_doubt(chart_windows *w, const chart_setting *setting, chart_row *row, char *why)
{
    const reference *r = reference_of(w, setting);
    double *errors = calloc(w->count, sizeof *errors);
    uint32_t count = 0;
    for (uint32_t i = 0; r && errors && i < w->count; i++) {
        if (r->doubts[i] <= UNDECIDED) errors[count++] = r->doubts[i];
    }
    if (r && errors) {
        chart_row_errors(row, errors, count);
        row->samples = w->count;
        row->failed = w->count - count;
        if (count < w->count)
            snprintf(row->why, sizeof row->why, "%u of %u windows undecided", w->count - count, w->count);
    } else {
        snprintf(why, 256, "no reference");
    }
    free(errors);
    return r && errors;
}
