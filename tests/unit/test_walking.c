/* SPDX-License-Identifier: MIT
 * test_walking.c: speeds and distances against the closed forms, query counts, walls, slopes, ledges. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fake_world.h"

static const double rates[] = {10, 30, 60, 144, 1000};
enum { RATES = 5 };

static void flat(fake_world *w)
{
    fake_world_init(w);
    fake_add_plane(w, fake_vec(0, 0, 1), 0);
}

static void distance_after_acceleration_is_the_closed_form(void **unused)
{
    (void)unused;
    for (int i = 0; i < RATES; i++) {
        fake_world w;
        rig r;
        flat(&w);
        rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
        rig_settle(&r);
        r.input.move = fake_vec(0.6, 0.8, 0);
        rig_steps(&r, (int)rates[i], 1 / rates[i]);
        double distance = 6 - 36 / (2 * 20.48);
        assert_near(r.state.position.x, 0.6 * distance, 1e-9);
        assert_near(r.state.position.y, 0.8 * distance, 1e-9);
        assert_near(r.state.velocity.x, 3.6, 1e-9);
        rig_close(&r);
    }
}

static void half_a_stick_is_half_the_speed(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
    rig_settle(&r);
    r.input.move = fake_vec(0.5, 0, 3); /* the part along up is ignored */
    rig_steps(&r, 60, 1.0 / 60);
    assert_near(r.state.velocity.x, 3, 1e-12);
    assert_near(r.state.velocity.z, 0, 0);
    rig_close(&r);
}

static void braking_stops_when_and_where_the_closed_form_says(void **unused)
{
    const double truth = log1p(16 * 6 / 20.48) / 16, place = 6 / 16.0 - 20.48 / 16 * truth;
    (void)unused;
    for (int i = 0; i < RATES; i++) {
        fake_world w;
        rig r;
        double dt = 1 / rates[i], at = -1;
        int stops = 0;
        flat(&w);
        rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
        rig_settle(&r);
        r.state.velocity = fake_vec(6, 0, 0);
        for (int k = 0; k < (int)rates[i]; k++) {
            rig_step(&r, dt);
            const tahr_event *e = rig_event(&r, TAHR_EVENT_STOPPED);
            if (e) {
                stops++;
                at = k * dt + e->time;
                assert_near(e->position.x, place, 1e-9 * place);
            }
        }
        assert_int_equal(stops, 1);
        assert_near(at, truth, 1e-9 * truth);
        assert_near(r.state.position.x, place, 1e-9 * place);
        assert_true(r.state.velocity.x == 0);
        rig_close(&r);
    }
}

static void flat_ground_costs_two_sweeps_walking_one_standing_none_cached(void **unused)
{
    fake_world w;
    rig r;
    tahr_config c = fake_config();
    (void)unused;
    flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
    rig_settle(&r);
    for (int i = 0; i < 30; i++) {
        w.sweeps = w.contact_queries = 0;
        rig_step(&r, 1.0 / 60);
        assert_int_equal(r.report.sweeps + r.report.contact_queries + r.report.rays, 0);
        assert_int_equal(w.sweeps + w.contact_queries, 0);
        assert_true(r.report.flags & TAHR_REPORT_CACHED_FLOOR);
    }
    r.input.move = fake_vec(1, 0, 0);
    for (int i = 0; i < 30; i++) {
        w.sweeps = w.contact_queries = 0;
        rig_step(&r, 1.0 / 60);
        assert_int_equal(r.report.sweeps, 2);
        assert_int_equal(r.report.contact_queries + r.report.rays, 0);
        assert_int_equal(w.sweeps, 2);
        assert_int_equal(w.contact_queries, 0);
    }
    rig_close(&r);
    c.cached_floor = 0;
    rig_open(&r, &w, &c, fake_vec(0, 0, 1));
    rig_settle(&r);
    for (int i = 0; i < 30; i++) {
        rig_step(&r, 1.0 / 60);
        assert_int_equal(r.report.sweeps, 1);
        assert_int_equal(r.report.contact_queries + r.report.rays, 0);
    }
    rig_close(&r);
}

static void falling_free_costs_one_sweep(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 100));
    for (int i = 0; i < 100; i++) {
        rig_step(&r, 1.0 / 60);
        assert_int_equal(r.report.sweeps, 1);
        assert_int_equal(r.report.contact_queries + r.report.rays, 0);
    }
    rig_close(&r);
}

static void idle_character_does_not_move_by_one_bit(void **unused)
{
    (void)unused;
    for (int cached = 0; cached < 2; cached++) {
        for (int degrees = 0; degrees <= 45; degrees += 9) {
            fake_world w;
            rig r;
            tahr_config c = fake_config();
            c.cached_floor = (uint32_t)cached;
            fake_world_init(&w);
            fake_add_slope(&w, degrees);
            rig_open(&r, &w, &c, fake_vec(0, 0, 1.5));
            rig_settle(&r);
            tahr_state rest = r.state;
            for (int i = 0; i < 200; i++) {
                rig_step(&r, i % 2 ? 1.0 / 60 : 0.25);
                assert_memory_equal(&r.state, &rest, sizeof rest);
            }
            rig_close(&r);
        }
    }
}

static void course(fake_world *w)
{
    flat(w);
    fake_add_box(w, fake_vec(2, -3, 0), fake_vec(6, 3, 0.3));
    fake_add_box(w, fake_vec(3, -2, 0.3), fake_vec(6, 2, 0.6));
    fake_add_box(w, fake_vec(-4, -6, 0), fake_vec(-3, 6, 3));
    fake_add_box(w, fake_vec(-6, 3, 0), fake_vec(6, 4, 2));
    fake_add_box(w, fake_vec(-2, -5, 2), fake_vec(2, -3, 2.4));
    fake_add_plane(w, fake_vec(0, 0.6, 0.8), -4.8);
}

static uint32_t next_random(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(*state >> 33);
}

/* Half of the time idle, so that caches matter. */
static void wander(tahr_input *input, uint64_t *seed)
{
    uint32_t dice = next_random(seed) % 8;
    if (next_random(seed) % 12 == 0) {
        double a = (double)(next_random(seed) % 6283) / 1000;
        input->move = dice < 4 ? fake_vec(0, 0, 0) : fake_vec(cos(a), sin(a), 0);
        input->jump = dice == 7;
    }
}

static void cached_floor_on_equals_off_bit_for_bit(void **unused)
{
    fake_world w;
    rig on, off;
    tahr_config c = fake_config();
    uint64_t seed = 4;
    uint32_t saved = 0;
    (void)unused;
    course(&w);
    rig_open(&on, &w, &c, fake_vec(0, 0, 1));
    c.cached_floor = 0;
    rig_open(&off, &w, &c, fake_vec(0, 0, 1));
    for (int i = 0; i < 6000; i++) {
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
        uint64_t seed = 8;
        course(&w);
        rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
        for (int i = 0; i < 6000; i++) {
            wander(&r.input, &seed);
            tahr_state before = r.state;
            rig_step(&r, dts[d]);
            double gap = fake_clearance(&w, &r.config.shape, r.state.position);
            if (gap < 0.01 - 1e-5) {
                print_error("dt %g step %d: clearance %g at %.17g %.17g %.17g, before %.17g %.17g %.17g velocity %g %g "
                            "%g move %g %g jump %u mode %u\n",
                            dts[d], i, gap, r.state.position.x, r.state.position.y, r.state.position.z,
                            before.position.x, before.position.y, before.position.z, before.velocity.x, before.velocity.y,
                            before.velocity.z, r.input.move.x, r.input.move.y, r.input.jump, before.mode);
                fail();
            }
            assert_true(r.report.sweeps + r.report.contact_queries + r.report.rays <= TAHR_MAX_QUERIES_PER_STEP);
        }
        rig_close(&r);
    }
}

static void level_travel_never_exceeds_speed_times_dt(void **unused)
{
    fake_world w;
    rig r;
    uint64_t seed = 12;
    (void)unused;
    course(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
    for (int i = 0; i < 6000; i++) {
        tahr_state before = r.state;
        wander(&r.input, &seed);
        rig_step(&r, 1.0 / 60);
        if (before.mode == TAHR_MODE_WALKING && r.state.mode == TAHR_MODE_WALKING) {
            double travel = hypot(r.state.position.x - before.position.x, r.state.position.y - before.position.y);
            assert_true(travel <= 6.0 / 60 * (1 + 1e-9));
        }
    }
    rig_close(&r);
}

static void any_mover_steps_any_state_with_the_same_bits(void **unused)
{
    fake_world w;
    rig a, b;
    uint64_t seed = 2;
    (void)unused;
    course(&w);
    rig_open(&a, &w, NULL, fake_vec(0, 0, 1));
    rig_open(&b, &w, NULL, fake_vec(5, 5, 9));
    for (int i = 0; i < 2000; i++) {
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

static void speed_along_a_slope_is_the_asked_one(void **unused)
{
    (void)unused;
    for (int i = 0; i < RATES; i++) {
        for (int direction = -1; direction <= 1; direction += 2) {
            fake_world w;
            rig r;
            fake_world_init(&w);
            fake_add_slope(&w, 45);
            rig_open(&r, &w, NULL, fake_vec(0, 0, 1.5));
            rig_settle(&r);
            double x = r.state.position.x;
            r.input.move = fake_vec(direction, 0, 0);
            for (int k = 0; k < (int)rates[i]; k++) {
                rig_step(&r, 1 / rates[i]);
                assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
                assert_true(fake_clearance(&w, &r.config.shape, r.state.position) > 0.01 - 1e-8);
            }
            double along = 6 - 36 / (2 * 20.48);
            assert_near((r.state.position.x - x) * direction, along * sqrt(0.5), 1e-6);
            rig_close(&r);
        }
    }
}

static void wall_is_slid_along_without_penetration(void **unused)
{
    (void)unused;
    for (int i = 0; i < RATES; i++) {
        fake_world w;
        rig r;
        flat(&w);
        fake_add_plane(&w, fake_vec(-1, 0, 0), -2);
        rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
        rig_settle(&r);
        r.input.move = fake_vec(0.8, 0.6, 0);
        rig_steps(&r, (int)(3 * rates[i]), 1 / rates[i]);
        double gap = fake_clearance(&w, &r.config.shape, r.state.position);
        assert_near(2 - 0.35 - r.state.position.x, 0.01, 1e-8);
        assert_true(gap >= 0.01 - 1e-8);
        assert_true(r.state.velocity.x <= 1e-9);
        rig_close(&r);
    }
}

/* Only contact events may depend on the step: the steady speed along a wall is that of the wish's part along it. */
static void speed_along_a_wall_is_the_part_of_the_wish_along_it_at_every_rate(void **unused)
{
    (void)unused;
    for (int i = 0; i < RATES; i++) {
        fake_world w;
        rig r;
        flat(&w);
        fake_add_plane(&w, fake_vec(-1, 0, 0), -2);
        rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
        rig_settle(&r);
        r.input.move = fake_vec(0.8, 0.6, 0);
        rig_steps(&r, (int)(3 * rates[i]), 1 / rates[i]);
        double y = r.state.position.y;
        rig_steps(&r, (int)rates[i], 1 / rates[i]);
        assert_near(r.state.position.y - y, 3.6, 0.02 * 3.6);
        rig_close(&r);
    }
}

static void acute_corner_is_a_place_to_rest(void **unused)
{
    const double degrees[] = {5, 8, 12, 30, 60, 89};
    (void)unused;
    for (int i = 0; i < 6; i++) {
        fake_world w;
        rig r;
        double a = degrees[i] * acos(-1.0) / 360;
        flat(&w);
        fake_add_plane(&w, fake_vec(-sin(a), cos(a), 0), -3 * sin(a)); /* closing at x = 3 */
        fake_add_plane(&w, fake_vec(-sin(a), -cos(a), 0), -3 * sin(a));
        rig_open(&r, &w, NULL, fake_vec(3 - 4 - 0.36 / sin(a), 0.01, 1));
        rig_settle(&r);
        r.input.move = fake_vec(1, 0.05, 0);
        uint32_t sweeps = 0;
        for (int k = 0; k < 400; k++) {
            rig_step(&r, 1.0 / 60);
            sweeps = r.report.sweeps > sweeps ? r.report.sweeps : sweeps;
            assert_true(fake_clearance(&w, &r.config.shape, r.state.position) > 0.01 - 1e-7);
        }
        assert_near(r.state.position.x, 3 - 0.36 / sin(a), 1e-4 / sin(a));
        tahr_vec3 rest = r.state.position;
        rig_steps(&r, 60, 1.0 / 60);
        assert_near(r.state.position.x, rest.x, 1e-5);
        assert_true(sweeps <= 30);
        rig_close(&r);
    }
}

static void walking_off_a_ledge_falls_with_the_level_speed(void **unused)
{
    (void)unused;
    for (int i = 0; i < RATES; i++) {
        fake_world w;
        rig r;
        int left = 0;
        fake_world_init(&w);
        fake_add_box(&w, fake_vec(-20, -5, -1), fake_vec(0, 5, 0));
        rig_open(&r, &w, NULL, fake_vec(-4, 0, 1));
        rig_settle(&r);
        r.input.move = fake_vec(1, 0, 0);
        for (int k = 0; k < (int)(1.5 * rates[i]); k++) {
            rig_step(&r, 1 / rates[i]);
            const tahr_event *e = rig_event(&r, TAHR_EVENT_LEFT_GROUND);
            if (e) {
                left++;
                assert_true(e->position.x > 0 && e->position.x < 0.36);
            }
        }
        assert_int_equal(left, 1);
        assert_int_equal(r.state.mode, TAHR_MODE_FALLING);
        assert_near(r.state.velocity.x, 6, 1e-6);
        rig_close(&r);
    }
}

static void ledge_guard_keeps_the_character_up(void **unused)
{
    (void)unused;
    for (int i = 0; i < RATES; i++) {
        fake_world w;
        rig r;
        tahr_config c = fake_config();
        c.walk_off_ledges = 0;
        fake_world_init(&w);
        fake_add_box(&w, fake_vec(-20, -5, -1), fake_vec(0, 5, 0));
        rig_open(&r, &w, &c, fake_vec(-4, 0, 1));
        rig_settle(&r);
        r.input.move = fake_vec(0.8, 0.6, 0);
        for (int k = 0; k < (int)(4 * rates[i]); k++) {
            rig_step(&r, 1 / rates[i]);
            assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
            assert_true(r.state.position.x < 0.35 && r.state.position.y < 5.35);
        }
        assert_true(r.state.position.y > 4.5); /* it went on along the edge */
        rig_close(&r);
    }
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
        tahr_config c = fake_config();
        tahr_quat q = frames[f];
        uint64_t seed = 31;
        course(&w);
        course(&turned);
        turned.frame = q;
        double g = 9.81;
        c.gravity = fake_vec(-g * 2 * (q.x * q.z + q.w * q.y), -g * 2 * (q.y * q.z - q.w * q.x),
                             -g * (1 - 2 * (q.x * q.x + q.y * q.y)));
        double up[3] = {-c.gravity.x / g, -c.gravity.y / g, -c.gravity.z / g};
        rig_open(&a, &w, NULL, fake_vec(0, 0, 1));
        rig_open(&b, &turned, &c, fake_vec(up[0], up[1], up[2]));
        for (int i = 0; i < 240; i++) {
            tahr_vec3 m;
            wander(&a.input, &seed);
            b.input = a.input;
            m = a.input.move;
            b.input.move = fake_vec((1 - 2 * (q.y * q.y + q.z * q.z)) * m.x + 2 * (q.x * q.y - q.w * q.z) * m.y,
                                    2 * (q.x * q.y + q.w * q.z) * m.x + (1 - 2 * (q.x * q.x + q.z * q.z)) * m.y,
                                    2 * (q.x * q.z - q.w * q.y) * m.x + 2 * (q.y * q.z + q.w * q.x) * m.y);
            rig_step(&a, 1.0 / 60);
            rig_step(&b, 1.0 / 60);
            tahr_vec3 p = b.state.position, x;
            x.x = (1 - 2 * (q.y * q.y + q.z * q.z)) * p.x + 2 * (q.x * q.y + q.w * q.z) * p.y +
                  2 * (q.x * q.z - q.w * q.y) * p.z;
            x.y = 2 * (q.x * q.y - q.w * q.z) * p.x + (1 - 2 * (q.x * q.x + q.z * q.z)) * p.y +
                  2 * (q.y * q.z + q.w * q.x) * p.z;
            x.z = 2 * (q.x * q.z + q.w * q.y) * p.x + 2 * (q.y * q.z - q.w * q.x) * p.y +
                  (1 - 2 * (q.x * q.x + q.y * q.y)) * p.z;
            if (fabs(x.x - a.state.position.x) + fabs(x.y - a.state.position.y) + fabs(x.z - a.state.position.z) > 1e-9) {
                fail_msg("frame %d step %d: %.12g %.12g %.12g, turned %.12g %.12g %.12g", f, i, a.state.position.x,
                         a.state.position.y, a.state.position.z, x.x, x.y, x.z);
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
    uint64_t seed = 11;
    uint32_t events = 0, together = 0;
    (void)unused;
    course(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
    for (int i = 0; i < 4000; i++) {
        double dt = dts[i % 4];
        if (i % 40 == 0) { /* back from the open plane to where there is something to meet */
            tahr_vec3 at = {0, 0, 1};
            tahr_state_init(&r.state, &r.config, &at);
        }
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
    const struct CMUnitTest tests[] = {cmocka_unit_test(distance_after_acceleration_is_the_closed_form),
                                       cmocka_unit_test(half_a_stick_is_half_the_speed),
                                       cmocka_unit_test(braking_stops_when_and_where_the_closed_form_says),
                                       cmocka_unit_test(flat_ground_costs_two_sweeps_walking_one_standing_none_cached),
                                       cmocka_unit_test(falling_free_costs_one_sweep),
                                       cmocka_unit_test(idle_character_does_not_move_by_one_bit),
                                       cmocka_unit_test(cached_floor_on_equals_off_bit_for_bit),
                                       cmocka_unit_test(start_free_stays_free_by_the_skin),
                                       cmocka_unit_test(level_travel_never_exceeds_speed_times_dt),
                                       cmocka_unit_test(any_mover_steps_any_state_with_the_same_bits),
                                       cmocka_unit_test(speed_along_a_slope_is_the_asked_one),
                                       cmocka_unit_test(wall_is_slid_along_without_penetration),
                                       cmocka_unit_test(speed_along_a_wall_is_the_part_of_the_wish_along_it_at_every_rate),
                                       cmocka_unit_test(acute_corner_is_a_place_to_rest),
                                       cmocka_unit_test(walking_off_a_ledge_falls_with_the_level_speed),
                                       cmocka_unit_test(ledge_guard_keeps_the_character_up),
                                       cmocka_unit_test(gravity_along_any_axis_gives_the_same_path),
                                       cmocka_unit_test(events_of_a_wanderer_are_in_order)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
