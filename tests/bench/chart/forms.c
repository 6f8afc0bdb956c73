/* SPDX-License-Identifier: MIT
 * forms.c: the closed forms of a setting's own numbers, and the steps that are compared with them. Along x, from 0:
 * speeding up  v = a t, at most V;                    x = a t^2 / 2, beyond t = V / a at V
 * braking      v' = -b - k v from V;                  x = (V + b / k) (1 - e^-kt) / k - b t / k, until v = 0
 * a jump       z = v t + g t^2 / 2, until it lands (where then is the skin's matter). */
#include "forms.h"

#include <math.h>
#include <stdio.h>

enum { SAMPLES = 10, TASKS = 3 };
enum { SPEED_UP, BRAKE, JUMP };

static const double SAMPLE_RATE = 10; /* Hz */

static double sped_up(const tahr_config *c, double t)
{
    double a = c->acceleration, v = c->max_speed, until = v / a;
    return t < until ? a * t * t / 2 : a * until * until / 2 + v * (t - until);
}

static double braked(const tahr_config *c, double t)
{
    double b = c->braking_deceleration, k = c->braking_drag, v = c->max_speed;
    double stop = k > 0 ? log(1 + k * v / b) / k : v / b;
    t = fmin(t, stop);
    return k > 0 ? (v + b / k) * (1 - exp(-k * t)) / k - b * t / k : v * t - b * t * t / 2;
}

/* NAN from the landing on. */
static double jumped(const tahr_config *c, double t)
{
    double v = c->jump_speed, g = c->gravity.z;
    return t < -2 * v / g ? v * t + g * t * t / 2 : NAN;
}

static double expected(const tahr_config *c, int task, double t)
{
    return task == SPEED_UP ? sped_up(c, t) : task == BRAKE ? braked(c, t) : jumped(c, t);
}

/* Stands at the origin, for as long as it takes to stand still. */
static int stand(tahr_mover *mover, const tahr_config *config, tahr_state *state)
{
    tahr_vec3 place = {0, 0, config->shape.half_height + 1.25 * config->skin};
    tahr_input input = {.struct_size = sizeof input};
    tahr_state_init(state, config, &place);
    for (int i = 0; i < 60; i++) {
        if (tahr_mover_step(mover, &input, 1.0 / 60, state, NULL) < 0) return 0;
    }
    return state->mode == TAHR_MODE_WALKING;
}

/* Adds the errors of one task; returns how many, or -1 where a step failed. */
static int run_task(tahr_mover *mover, const chart_setting *s, int task, const tahr_state *start, double *errors)
{
    const tahr_config *c = &s->config;
    tahr_state state = *start;
    tahr_input input = {.struct_size = sizeof input, .move = {task == SPEED_UP, 0, 0}, .jump = task == JUMP};
    int steps = (int)(s->rate / SAMPLE_RATE + 0.5), count = 0;
    if (task == BRAKE) state.velocity.x = c->max_speed;
    for (int i = 1; i <= SAMPLES; i++) {
        for (int k = 0; k < steps; k++) {
            if (tahr_mover_step(mover, &input, 1 / s->rate, &state, NULL) < 0) return -1;
        }
        double want = expected(c, task, i / SAMPLE_RATE);
        double got = task == JUMP ? state.position.z - start->position.z : state.position.x;
        if (!isnan(want)) errors[count++] = fabs(got - want);
    }
    return count;
}

int chart_forms_score(const bench_world *plane, const chart_setting *setting, chart_row *row, char *why)
{
    double errors[TASKS * SAMPLES];
    tahr_world *world = NULL;
    tahr_mover *mover = NULL;
    tahr_state start;
    int count = 0, added = 0;
    tahr_status status = chart_setting_open(setting, plane, &world);
    if (status >= 0) status = tahr_mover_create(world, &setting->config, &mover);
    int ok = status >= 0 && stand(mover, &setting->config, &start);
    for (int task = 0; ok && task < TASKS; task++) {
        added = run_task(mover, setting, task, &start, errors + count);
        ok = added >= 0;
        count += added;
    }
    if (ok) {
        chart_row_errors(row, errors, (uint32_t)count);
        row->reference = "closed forms";
    } else {
        snprintf(why, 256, "%s", status < 0 ? tahr_status_name(status) : "a step failed, or nothing to stand on");
    }
    tahr_mover_destroy(mover);
    tahr_world_close(world);
    return ok;
}
