/* SPDX-License-Identifier: MIT
 * test_energy.c: whatever the methods, nothing that stands still makes a character faster: its speed never passes the
 * larger of what was asked for and what it was, but for what gravity adds to a fall. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "parity.h"
#include "rig.h"

enum { BLOCKS = 24, METHODS = 128, RATES = 4 };

/* Each bit another method. No air control: steering in a fall adds speed by right. */
static tahr_config config_of(uint32_t bits)
{
    tahr_config c = bits & 1 ? parity_config() : rig_config();
    c.integrator = bits & 2 ? TAHR_INTEGRATOR_STEPPED : TAHR_INTEGRATOR_EXACT;
    c.slide_solver = bits & 4 ? TAHR_SLIDE_TWO_WALLS : TAHR_SLIDE_JOINT;
    c.step_rule = bits & 8 ? TAHR_STEP_BY_CONTACT : TAHR_STEP_BY_TREAD;
    c.floor_probe = bits & 16 ? TAHR_FLOOR_PROBE_SHRUNK : TAHR_FLOOR_PROBE_WHOLE;
    c.separation = bits & 32 ? TAHR_SEPARATION_PULL_BACK : TAHR_SEPARATION_MARGIN;
    c.depenetration = bits & 64 ? TAHR_DEPENETRATION_SINGLE : TAHR_DEPENETRATION_JOINT;
    c.air_control = 0;
    return c;
}

/* Ground and turned blocks, half of them about as high as a step, a quarter tilted; with an override the low ones can
 * be walked on up to 75 degrees. Some overlap each other. */
static void make_yard(tahr_body_desc *bodies, oracle_random *random, int override)
{
    for (int i = 0; i < BLOCKS; i++) {
        tahr_body_desc *b = &bodies[i];
        double a = oracle_uniform(random, 0, 3), tilt = i % 4 == 3 ? oracle_uniform(random, 0, 1.2) : 0;
        assert_int_equal(tahr_body_desc_init(b, sizeof *b, TAHR_BODY_BOX), TAHR_OK);
        b->half_extents = dice_vec(random, 0.3, 1.5);
        b->pose.position = dice_vec(random, -4, 4);
        b->pose.position.z = b->half_extents.z * (i % 2 ? -0.8 : 1) + (i % 2 ? 0.2 : -0.1);
        b->pose.orientation = (tahr_quat){sin(tilt / 2) * cos(a / 2), sin(tilt / 2) * sin(a / 2),
                                          cos(tilt / 2) * sin(a / 2), cos(tilt / 2) * cos(a / 2)};
        if (override && i % 2) {
            b->walkable_rule = TAHR_WALKABLE_INCREASE;
            b->walkable_angle = 1.3;
        }
    }
    bodies[0].half_extents = fake_vec(2000, 2000, 1);
    bodies[0].pose.position = fake_vec(0, 0, -1);
    bodies[0].pose.orientation = (tahr_quat){0, 0, 0, 1};
}

/* What happened, so that the test cannot pass because nothing did. */
typedef struct tally {
    double way; /* m */
    uint32_t slides, steps_up, falls;
} tally;

static void check_step(rig *r, double dt, tally *t)
{
    const tahr_state before = r->state;
    rig_step(r, dt);
    const tahr_state *s = &r->state;
    int walks = before.mode == TAHR_MODE_WALKING && s->mode == TAHR_MODE_WALKING;
    double most = fmax(length(before.velocity), r->config.max_speed) + (walks ? 0 : -r->config.gravity.z * dt);
    if (length(s->velocity) > most + 1e-9) {
        fail_msg("at %g s, %g Hz: (%g %g %g) m/s became (%g %g %g)", r->time, 1 / dt, before.velocity.x,
                 before.velocity.y, before.velocity.z, s->velocity.x, s->velocity.y, s->velocity.z);
    }
    assert_int_equal(r->report.flags & TAHR_REPORT_QUERY_CAP, 0);
    t->way += hypot(s->position.x - before.position.x, s->position.y - before.position.y);
    t->slides += r->report.slides;
    t->steps_up += rig_event(r, TAHR_EVENT_STEPPED_UP) != NULL;
    t->falls += before.mode == TAHR_MODE_WALKING && s->mode == TAHR_MODE_FALLING;
}

/* 6 s, a new heading every half second. */
static void wander(uint32_t bits, double rate, uint32_t seed, tally *t)
{
    tahr_body_desc bodies[BLOCKS];
    oracle_random random = {seed};
    tahr_config c = config_of(bits);
    double next = 0;
    rig r;
    make_yard(bodies, &random, seed % 2);
    rig_open_bodies(&r, bodies, BLOCKS, &c, fake_vec(0, 0, 4));
    for (int k = 0; k < (int)(6 * rate); k++) {
        tahr_vec3 at = r.state.position;
        if (r.time >= next) {
            double a = oracle_uniform(&random, -3.2, 3.2);
            int home = fabs(at.x) > 5 || fabs(at.y) > 5;
            r.input.move = home ? fake_vec(-at.x, -at.y, 0) : fake_vec(cos(a), sin(a), 0);
            next += 0.5;
        }
        check_step(&r, 1 / rate, t);
    }
    rig_close(&r);
}

static void sliding_and_stepping_make_nobody_faster(void **unused)
{
    static const double rates[RATES] = {10, 30, 60, 300};
    uint32_t falls = 0;
    (void)unused;
    for (uint32_t bits = 0; bits < METHODS; bits++) {
        tally t = {0, 0, 0, 0};
        for (uint32_t i = 0; i < RATES; i++) {
            wander(bits, rates[i], 2 * (RATES * bits + i) + 5, &t);
            wander(bits, rates[i], 2 * (RATES * bits + i) + 6, &t);
        }
        assert_true(t.way > 80 && t.slides > 200 && t.steps_up > 5);
        falls += t.falls;
    }
    assert_true(falls > METHODS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(sliding_and_stepping_make_nobody_faster)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
