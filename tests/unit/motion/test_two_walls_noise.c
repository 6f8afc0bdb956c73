/* SPDX-License-Identifier: MIT
 * test_two_walls_noise.c: the loops of the unreal preset, and its mixtures with closed forms, over a world whose
 * answers are well-formed noise: nothing that they say makes a state that is no state. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "fake_backend.h"
#include "parity.h"
#include "rig.h"

static void open_noise(rig *r, fake_backend *b, const tahr_config *config)
{
    rig_open_backend(r, b, FAKE_BACKEND_ALL);
    tahr_mover_destroy(r->mover);
    tahr_vec3 at = fake_vec(0, 0, 1);
    r->config = *config;
    assert_int_equal(tahr_mover_create(r->world, config, &r->mover), TAHR_OK);
    assert_int_equal(tahr_state_init(&r->state, config, &at), TAHR_OK);
    b->random = 1;
}

static int is_a_number(tahr_vec3 v)
{
    return fabs(v.x) < 1e6 && fabs(v.y) < 1e6 && fabs(v.z) < 1e6;
}

static void step_through(rig *r, fake_backend *b, int i)
{
    static const double dts[] = {1.0 / 240, 1.0 / 60, 0.051, 0.1, 1};
    double dt = dts[i % 5];
    if (i % 20 == 0) {
        r->input.move = dice_direction(&b->seed);
        r->input.jump = i % 40 == 0;
        r->input.crouch = i % 60 == 0;
        r->state.velocity = scale(dice_direction(&b->seed), 6);
        r->state.position = fake_vec(0, 0, 1);
    }
    tahr_vec3 before = r->state.position;
    double speed = length(r->state.velocity);
    rig_step(r, dt);
    rig_assert_in_order(r, dt);
    assert_true(is_a_number(r->state.position) && is_a_number(r->state.velocity));
    assert_true(r->report.sweeps + r->report.contact_queries + r->report.rays <= TAHR_MAX_QUERIES_PER_STEP);
    assert_true(r->report.slices <= 2u * r->config.max_substeps);
    assert_true(r->report.time_lost <= dt * (1 + 1e-9));
    /* Its own speed, a fall and a jump; every slice a step and a snap; every query a push out of the deepest
     * overlap. */
    double pushes = r->config.max_depenetration * r->report.contact_queries;
    double most = (speed + 6 + 9.8 * dt + 4.2) * dt + r->report.slices * (4 * r->config.step_height + 0.1) + pushes;
    vec3 moved = sub(r->state.position, before);
    assert_true(hypot(moved.x, moved.y) <=
                most); /* up a face that an override makes walkable it is as far as that is steep */
}

static void noise_makes_no_state_that_is_none(void **unused)
{
    (void)unused;
    for (uint32_t mix = 0; mix < 4; mix++) {
        tahr_config c = parity_config();
        fake_backend b;
        rig r;
        uint32_t modes[2] = {0, 0}, flags = 0;
        c.integrator = mix & 1 ? TAHR_INTEGRATOR_EXACT : TAHR_INTEGRATOR_STEPPED;
        c.walk_off_ledges = mix & 2 ? 0 : 1;
        c.perch_threshold = mix & 2 ? 0.15 : 0;
        open_noise(&r, &b, &c);
        for (int i = 0; i < 20000; i++) {
            step_through(&r, &b, i);
            modes[r.state.mode == TAHR_MODE_WALKING]++;
            flags |= r.report.flags;
        }
        assert_true(modes[0] > 100 && modes[1] > 100);
        assert_true(flags & TAHR_REPORT_UNKNOWN && flags & TAHR_REPORT_CRUSHED);
        rig_close(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(noise_makes_no_state_that_is_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
