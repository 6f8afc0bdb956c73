/* SPDX-License-Identifier: MIT
 * test_course.c: what holds in every step of a wanderer on a course of stairs, walls, a corner, a ceiling and a
 * slope. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "rig.h"

static void course(fake_world *w)
{
    fake_world_flat(w);
    fake_add_box(w, fake_vec(2, -3, 0), fake_vec(6, 3, 0.3));
    fake_add_box(w, fake_vec(3, -2, 0.3), fake_vec(6, 2, 0.6));
    fake_add_box(w, fake_vec(-4, -6, 0), fake_vec(-3, 6, 3));
    fake_add_box(w, fake_vec(-6, 3, 0), fake_vec(6, 4, 2));
    fake_add_box(w, fake_vec(-2, -5, 2), fake_vec(2, -3, 2.4));
    fake_add_plane(w, fake_vec(0, 0.6, 0.8), -4.8);
}

/* Half of the time idle, so that caches matter. */
static void wander(tahr_input *input, oracle_random *seed)
{
    uint32_t dice = oracle_below(seed, 8);
    if (oracle_below(seed, 12) == 0) {
        double a = oracle_uniform(seed, 0, 6.2831853);
        input->move = dice < 4 ? fake_vec(0, 0, 0) : fake_vec(cos(a), sin(a), 0);
        input->jump = dice == 7;
    }
}

/* Every few seconds back from the open plane to where there is something to meet. */
static void bring_back(rig *r, int step, int every)
{
    if (step % every == 0) {
        tahr_vec3 at = {0, 0, 1};
        assert_int_equal(tahr_state_init(&r->state, &r->config, &at), TAHR_OK);
    }
}

static void cached_floor_on_equals_off_bit_for_bit(void **unused)
{
    fake_world w;
    rig on, off;
    tahr_config c = rig_config();
    oracle_random seed = {4};
    uint32_t saved = 0;
    (void)unused;
    course(&w);
    rig_open(&on, &w, &c, fake_vec(0, 0, 1));
    c.cached_floor = 0;
    rig_open(&off, &w, &c, fake_vec(0, 0, 1));
    for (int i = 0; i < 6000; i++) {
        bring_back(&on, i, 240);
        bring_back(&off, i, 240);
        wander(&on.input, &seed);
        off.input = on.input;
        rig_step(&on, 1.0 / 60);
        rig_step(&off, 1.0 / 60);
        saved += (on.report.flags & TAHR_REPORT_CACHED_FLOOR) != 0;
        if (memcmp(&on.state, &off.state, sizeof on.state) != 0) {
            fail_msg("step %d: states differ, at %.17g %.17g %.17g and %.17g %.17g %.17g", i, on.state.position.x,
                     on.state.position.y, on.state.position.z, off.state.position.x, off.state.position.y,
                     off.state.position.z);
        }
    }
    assert_true(saved > 100);
    rig_close(&on);
    rig_close(&off);
}

static void start_free_stays_free_by_the_skin(void **unused)
{
    const double dts[] = {0.1, 1.0 / 30, 1.0 / 60, 1.0 / 144};
    (void)unused;
    for (int d = 0; d < 4; d++) {
        fake_world w;
        rig r;
        oracle_random seed = {8};
        uint32_t touching = 0;
        course(&w);
        fake_world above = w; /* all but the plane */
        above.solids[0] = above.solids[--above.count];
        rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
        for (int i = 0; i < 6000; i++) {
            bring_back(&r, i, (int)(4 / dts[d]));
            wander(&r.input, &seed);
            tahr_state before = r.state;
            rig_step(&r, dts[d]);
            double gap = fake_clearance(&w, &r.config.shape, r.state.position);
            touching += fake_clearance(&above, &r.config.shape, r.state.position) < 0.01 + 1e-5;
            if (gap < 0.01 - 1e-5) {
                print_error("dt %g step %d: clearance %g at %.17g %.17g %.17g, before %.17g %.17g %.17g velocity %g %g "
                            "%g move %g %g jump %u mode %u\n",
                            dts[d], i, gap, r.state.position.x, r.state.position.y, r.state.position.z,
                            before.position.x, before.position.y, before.position.z, before.velocity.x,
                            before.velocity.y, before.velocity.z, r.input.move.x, r.input.move.y, r.input.jump,
                            before.mode);
                fail();
            }
            assert_true(r.report.sweeps + r.report.contact_queries + r.report.rays <= TAHR_MAX_QUERIES_PER_STEP);
        }
        assert_true(touching > 200); /* else nothing was tested */
        rig_close(&r);
    }
}

static void level_travel_never_exceeds_speed_times_dt(void **unused)
{
    fake_world w;
    rig r;
    oracle_random seed = {12};
    uint32_t fast = 0, climbed = 0;
    (void)unused;
    course(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
    for (int i = 0; i < 6000; i++) {
        bring_back(&r, i, 240);
        tahr_state before = r.state;
        wander(&r.input, &seed);
        rig_step(&r, 1.0 / 60);
        climbed += rig_event(&r, TAHR_EVENT_STEPPED_UP) != NULL;
        if (before.mode == TAHR_MODE_WALKING && r.state.mode == TAHR_MODE_WALKING) {
            double travel = hypot(r.state.position.x - before.position.x, r.state.position.y - before.position.y);
            assert_true(travel <= 6.0 / 60 * (1 + 1e-9));
            fast += travel > 5.99 / 60;
        }
    }
    assert_true(fast > 100 && climbed > 5); /* else nothing was tested */
    rig_close(&r);
}

static void any_mover_steps_any_state_with_the_same_bits(void **unused)
{
    fake_world w;
    rig a, b;
    oracle_random seed = {2};
    (void)unused;
    course(&w);
    rig_open(&a, &w, NULL, fake_vec(0, 0, 1));
    rig_open(&b, &w, NULL, fake_vec(5, 5, 9));
    for (int i = 0; i < 2000; i++) {
        bring_back(&a, i, 240);
        wander(&a.input, &seed);
        tahr_state copy = a.state;
        rig_step(&a, 1.0 / 60);
        assert_true(tahr_mover_step(b.mover, &a.input, 1.0 / 60, &copy, NULL) >= 0);
        assert_memory_equal(&copy, &a.state, sizeof copy);
        assert_true(tahr_state_hash(&copy) == tahr_state_hash(&a.state));
    }
    rig_close(&a);
    rig_close(&b);
}

static void gravity_along_any_axis_gives_the_same_path(void **unused)
{
    const tahr_quat frames[] = {{0, 0.70710678118654752, 0, 0.70710678118654752},
                                {-0.70710678118654752, 0, 0, 0.70710678118654752},
                                {1, 0, 0, 0},
                                {0.18257418583505536, 0.36514837167011072, 0.54772255750516607, 0.73029674334022143}};
    (void)unused;
    for (int f = 0; f < 4; f++) {
        fake_world w, turned;
        rig a, b;
        tahr_config c = rig_config();
        oracle_random seed = {31};
        course(&w);
        course(&turned);
        turned.frame = frames[f];
        c.gravity = fake_turn(frames[f], fake_vec(0, 0, -9.81));
        rig_open(&a, &w, NULL, fake_vec(0, 0, 1));
        rig_open(&b, &turned, &c, fake_turn(frames[f], fake_vec(0, 0, 1)));
        for (int i = 0; i < 240; i++) {
            wander(&a.input, &seed);
            b.input = a.input;
            b.input.move = fake_turn(frames[f], a.input.move);
            rig_step(&a, 1.0 / 60);
            rig_step(&b, 1.0 / 60);
            tahr_vec3 p = a.state.position, x = fake_turn_back(frames[f], b.state.position);
            if (fabs(x.x - p.x) + fabs(x.y - p.y) + fabs(x.z - p.z) > 1e-9) {
                fail_msg("frame %d step %d: %.12g %.12g %.12g, turned %.12g %.12g %.12g", f, i, p.x, p.y, p.z, x.x, x.y,
                         x.z);
            }
        }
        rig_close(&a);
        rig_close(&b);
    }
}

static void events_of_a_wanderer_are_in_order(void **unused)
{
    const double dts[] = {1.0 / 60, 0.1, 0.3, 0.7};
    fake_world w;
    rig r;
    oracle_random seed = {11};
    uint32_t events = 0, together = 0;
    (void)unused;
    course(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
    for (int i = 0; i < 4000; i++) {
        double dt = dts[i % 4];
        bring_back(&r, i, 40);
        wander(&r.input, &seed);
        rig_step(&r, dt);
        rig_assert_in_order(&r, dt);
        events += r.report.event_count;
        together += r.report.event_count > 2;
        assert_true(r.report.time_lost >= 0 && r.report.time_lost <= dt);
    }
    assert_true(events > 1000 && together > 50); /* else nothing was tested */
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(cached_floor_on_equals_off_bit_for_bit),
                                       cmocka_unit_test(start_free_stays_free_by_the_skin),
                                       cmocka_unit_test(level_travel_never_exceeds_speed_times_dt),
                                       cmocka_unit_test(any_mover_steps_any_state_with_the_same_bits),
                                       cmocka_unit_test(gravity_along_any_axis_gives_the_same_path),
                                       cmocka_unit_test(events_of_a_wanderer_are_in_order)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
