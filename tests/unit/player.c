/* SPDX-License-Identifier: MIT
 * player.c: see player.h. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "player.h"

void player_begin(player *p, rig *r, double rate)
{
    memset(p, 0, sizeof *p);
    p->rig = r;
    p->rate = rate;
    p->top = r->state.position.z;
}

static void step(player *p, double dt)
{
    rig *r = p->rig;
    double begin = p->time;
    rig_step(r, dt);
    rig_assert_in_order(r, dt);
    for (uint32_t i = 0; i < r->report.event_count; i++) {
        const tahr_event *e = &r->events[i];
        assert_true(e->type < PLAYER_EVENTS);
        p->seen[e->type]++;
        p->when[e->type] = begin + e->time;
        p->last[e->type] = *e;
        p->top = fmax(p->top, e->position.z);
    }
    p->top = fmax(p->top, r->state.position.z);
    p->time += dt;
}

void player_until(player *p, double time)
{
    double dt = 1 / p->rate;
    while (time - p->time > dt * (1 + 1e-9)) {
        step(p, dt);
    }
    if (time - p->time > 1e-9) {
        step(p, time - p->time);
    }
    p->time = fmax(p->time, time);
}

void player_press(player *p, double time)
{
    p->rig->input.jump = 1;
    player_until(p, time);
}

void player_release(player *p, double time)
{
    p->rig->input.jump = 0;
    player_until(p, time);
}

void player_await(player *p, uint32_t type)
{
    uint32_t before = p->seen[type];
    while (p->seen[type] == before) {
        step(p, 1 / p->rate);
        if (p->time > 100) {
            fail_msg("no %s in 100 s", tahr_event_name(type));
        }
    }
}
