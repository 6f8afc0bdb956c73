/* SPDX-License-Identifier: MIT
 * open_ground.c: steps that are compared with the closed forms of a setting's own numbers: speeding up from rest,
 * braking from the greatest speed, and a jump until it lands (where then is the skin's matter). */
#include "open_ground.h"

#include <math.h>
#include <stdio.h>

#include "forms.h"

enum { SAMPLES = 10, TASKS = 3 };
enum { SPEED_UP, BRAKE, JUMP };

static const double SAMPLE_RATE = 10; /* Hz */

/* NAN: nothing is known; of a jump from the landing on. */
static double expected(const tahr_config *c, int task, double t)
{
    if (task == SPEED_UP) return (double)form_capped(0, c->acceleration, c->max_speed, t).way;
    if (task == BRAKE) return (double)form_brake(c->max_speed, c->braking_deceleration, c->braking_drag, t).way;
    if (t >= form_landing_time(c->jump_speed, -c->gravity.z, 0)) return NAN;
    return (double)form_thrown(c->jump_speed, -c->gravity.z, t).way;
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

int chart_open_ground_score(const bench_world *plane, const chart_setting *setting, chart_row *row, char *why)
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
