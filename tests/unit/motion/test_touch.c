/* SPDX-License-Identifier: MIT
 * test_touch.c: who touches a floor as nearly as rounding allows overlaps it by less than a ten millionth of a
 * metre. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>

#include <cmocka.h>

#include "rig.h"

/* m: how deep the character is in the floor, less than what counts as an overlap. */
static const double DEPTH = 5e-8;

/* The floor z = 0, and across the way, at x = 0.5, a sensor as thin as nothing that feels the middle of a shape. */
typedef struct hall {
    uint32_t sweeps;
} hall;

static tahr_status sweep_floor(void *user, const tahr_sweep *q, tahr_hit *hit)
{
    hall *h = user;
    double gap = q->position.z - q->shape.half_height, drop = -q->motion.z;
    int leaves = (q->flags & TAHR_SWEEP_LEAVE_OVERLAP) && drop <= 0;
    h->sweeps++;
    hit->normal = fake_vec(0, 0, 1);
    if (gap < 0) {
        hit->start_overlap = !leaves;
        hit->depth = leaves ? 0 : -gap;
    } else if (drop > 0 && gap - q->margin <= drop) {
        hit->blocking = 1;
        hit->fraction = gap > q->margin ? (gap - q->margin) / drop : 0;
    }
    return TAHR_OK;
}

static tahr_status feel_gate(void *user, const tahr_sweep *q, tahr_hit *hits, uint32_t capacity, uint32_t *count)
{
    double part = q->motion.x != 0 ? (0.5 - q->position.x) / q->motion.x : -1;
    (void)user, (void)capacity;
    *count = part >= 0 && part <= 1;
    if (*count) {
        hits[0].fraction = part;
        hits[0].body = 7;
    }
    return TAHR_OK;
}

/* Flies 1 m along the floor within a step, out of that overlap; the report of it is r's. */
static void fly_along(rig *r, hall *h, int has_gate)
{
    tahr_callbacks c = {
        .struct_size = sizeof c, .user = h, .sweep = sweep_floor, .sensors = has_gate ? feel_gate : NULL};
    tahr_config config = rig_config();
    rig_open_callbacks(r, &c, &config, fake_vec(0, 0, config.shape.half_height - DEPTH));
    r->state.mode = TAHR_MODE_FLYING;
    r->state.velocity = fake_vec(config.fly_speed, 0, 0);
    r->input.move = fake_vec(1, 0, 0);
    h->sweeps = 0;
    rig_step(r, 1 / config.fly_speed);
    assert_near(r->state.position.x, 1, 1e-9);
}

static void a_sensor_behind_a_touch_is_heard(void **unused)
{
    rig r;
    hall h = {0};
    (void)unused;
    fly_along(&r, &h, 1);
    const tahr_event *begin = rig_event(&r, TAHR_EVENT_OVERLAP_BEGIN);
    assert_non_null(begin);
    assert_int_equal(begin->body, 7);
    rig_close(&r);
}

static void every_sweep_of_a_touch_is_counted(void **unused)
{
    rig r;
    hall h = {0};
    (void)unused;
    fly_along(&r, &h, 0);
    assert_true(h.sweeps >= 2); /* the first, and the one that leaves */
    assert_int_equal(r.report.sweeps, h.sweeps);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sensor_behind_a_touch_is_heard),
        cmocka_unit_test(every_sweep_of_a_touch_is_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
