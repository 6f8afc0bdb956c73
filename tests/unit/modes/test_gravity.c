/* SPDX-License-Identifier: MIT
 * test_gravity.c: gravity that is none, turns, flips, and points at a planet; and no direction of it is special. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "native_world.h"
#include "rig.h"

static const double G = 9.81, SKIN = 0.01, H = 0.9, PI = 3.14159265358979323846;

static tahr_vec3 times(tahr_vec3 v, double s)
{
    return fake_vec(v.x * s, v.y * s, v.z * s);
}

static double dot3(tahr_vec3 a, tahr_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static void without_gravity_it_floats_straight_on_and_then_falls(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        int n = (int)rig_rates[i];
        fake_world_flat(&w);
        rig_open(&r, &w, NULL, fake_vec(0, 0, 3));
        r.state.velocity = fake_vec(0.5, 0, 1);
        r.input.flags = TAHR_INPUT_GRAVITY;
        rig_steps(&r, n, 1 / rig_rates[i]);
        assert_near(r.state.position.x, 0.5, 1e-9);
        assert_near(r.state.position.z, 4, 1e-9);
        assert_near(r.state.up.z, 1, 0);
        r.input.gravity = fake_vec(0, 0, -2);
        rig_steps(&r, n, 1 / rig_rates[i]);
        assert_near(r.state.position.z, 4, 1e-9); /* 1 s up and down again: v t - g t^2 / 2 */
        rig_close(&r);
    }
}

static void who_stands_goes_on_standing_without_gravity(void **unused)
{
    (void)unused;
    fake_world w;
    rig r;
    fake_world_flat(&w);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
    tahr_state before = r.state;
    r.input.flags = TAHR_INPUT_GRAVITY;
    rig_steps(&r, 30, 1.0 / 60);
    assert_memory_equal(&before, &r.state, sizeof before);
    rig_close(&r);
}

/* The foot has no room to turn in on a floor: turns about the centre, and falls to the new floor. */
static void gravity_that_turns_over_drops_who_stands_to_the_ceiling(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        double dt = 1 / rig_rates[i], at = -1;
        fake_world_flat(&w);
        fake_add_plane(&w, fake_vec(0, 0, -1), -6);
        rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
        double way = 6 - SKIN - H - r.state.position.z;
        r.input.flags = TAHR_INPUT_GRAVITY;
        r.input.gravity = fake_vec(0, 0, G);
        for (int k = 0; k < 2 * (int)rig_rates[i]; k++) {
            rig_step(&r, dt);
            assert_int_equal(r.report.flags & TAHR_REPORT_UP_REFUSED, 0);
            const tahr_event *e = rig_event(&r, TAHR_EVENT_LANDED);
            at = e ? k * dt + e->time : at;
        }
        assert_near(at, sqrt(2 * way / G), 1e-6);
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        assert_near(r.state.up.z, -1, 0);
        assert_near(r.state.position.z, 6 - SKIN - H, 0.5 * SKIN + 1e-6);
        rig_close(&r);
    }
}

static void gravity_that_turns_aside_drops_who_stands_to_the_wall(void **unused)
{
    const tahr_vec3 down[] = {{1, 0, 0},      {-1, 0, 0},   {0, 1, 0}, {0, -1, 0},
                              {0.8, 0, -0.6}, {0.6, 0.8, 0}}; /* the last but one leaves the floor too steep */
    (void)unused;
    for (int i = 0; i < 6; i++) {
        fake_world w;
        rig r;
        fake_world_flat(&w);
        fake_add_plane(&w, times(down[i], -1), -8); /* 8 m away along down */
        rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
        r.input.flags = TAHR_INPUT_GRAVITY;
        r.input.gravity = times(down[i], G);
        rig_steps(&r, 300, 1.0 / 60);
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        assert_near(dot3(r.state.up, down[i]), -1, 1e-12);
        assert_near(dot3(r.state.position, down[i]), 8 - H - SKIN, 0.5 * SKIN + 1e-6);
        rig_close(&r);
    }
}

static void gravity_that_flips_every_step_overlaps_nothing(void **unused)
{
    const double rates[] = {10, 60, 1000};
    (void)unused;
    for (int i = 0; i < 6; i++) {
        fake_world w;
        rig r;
        fake_world_flat(&w);
        fake_add_plane(&w, fake_vec(0, 0, -1), -4);
        fake_add_box(&w, fake_vec(1, -2, 0), fake_vec(2, 2, 0.5));
        fake_add_box(&w, fake_vec(-2, -2, 2.1), fake_vec(-1, 2, 2.2));
        rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
        r.input.flags = TAHR_INPUT_GRAVITY;
        for (int k = 0; k < 2000; k++) {
            r.input.gravity = fake_vec(0, 0, k % 2 ? G : -G);
            r.input.move = fake_vec(k % 400 < 200 ? 1 : -1, 0, 0);
            r.input.jump = i >= 3 && k % 7 == 0;
            rig_step(&r, 1 / rates[i % 3]);
            assert_true(fake_clearance(&w, &r.config.shape, r.state.position) > -1e-9);
            assert_int_equal(r.report.flags & TAHR_REPORT_CRUSHED, 0);
        }
        rig_close(&r);
    }
}

static void gravity_too_strong_or_not_a_number_is_refused(void **unused)
{
    const double bad[] = {1e5, -1e30, NAN, INFINITY};
    (void)unused;
    fake_world w;
    rig r;
    fake_world_flat(&w);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
    for (int i = 0; i < 4; i++) {
        tahr_state before = r.state;
        r.input.flags = TAHR_INPUT_GRAVITY;
        r.input.gravity = fake_vec(0, bad[i], 0);
        assert_int_equal(tahr_mover_step(r.mover, &r.input, 0.01, &r.state, NULL), TAHR_E_ARGUMENT);
        assert_non_null(strstr(r.log.text, "input.gravity"));
        assert_memory_equal(&before, &r.state, sizeof before);
    }
    rig_close(&r);
}

/* Around a planet at 6 m/s, wishing on along the velocity. Every step moves the foot, which up turns about, by d = 6 dt
 * along the tangent at its begin: a lap is 2 pi (radius + gap) / d steps, but for terms of (d / radius)^2 from the
 * tangent, and for two steps in which up, which follows the centre, falls behind the foot at the start. */
static void go_around(double radius, double rate, int coasts)
{
    const double dt = 1 / rate, d = 6 * dt;
    tahr_body_desc planet = fixture_body(TAHR_BODY_SPHERE);
    tahr_config c = rig_config();
    rig r;
    double angle = 0;
    int steps = 0;
    planet.radius = radius;
    c.braking_deceleration = coasts ? 0 : c.braking_deceleration;
    c.braking_drag = coasts ? 0 : c.braking_drag;
    rig_open_bodies(&r, &planet, 1, &c, fake_vec(0, 0, radius + 1));
    rig_settle(&r);
    r.state.velocity = fake_vec(6, 0, 0);
    r.input.flags = TAHR_INPUT_GRAVITY;
    while (angle < 2 * PI && steps < 1000000) {
        tahr_vec3 at = r.state.position;
        double before = angle;
        r.input.gravity = times(at, -G / sqrt(dot3(at, at)));
        if (!coasts) { /* longer than 1, so that its part along the new up costs nothing */
            r.input.move = r.state.velocity;
        }
        rig_step(&r, dt);
        steps++;
        angle = atan2(r.state.position.x, r.state.position.z);
        angle += angle < before - PI ? 2 * PI * ceil((before - PI - angle) / (2 * PI)) : 0;
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        assert_int_equal(r.report.flags & TAHR_REPORT_UP_REFUSED, 0);
        assert_near(sqrt(dot3(r.state.velocity, r.state.velocity)), 6, 1e-9);
        assert_near(r.state.position.y, 0, 1e-6);
        double gap = sqrt(dot3(r.state.position, r.state.position)) - radius - H;
        assert_true(gap > 0 && gap < 1.5 * SKIN + d * d / (2 * radius) + 0.01);
    }
    const double lap = 2 * PI * (radius + SKIN) / d, curved = d * d / (radius * radius);
    assert_true(steps >= lap * (1 - curved) - 2);
    assert_true(steps <= lap * (1 + curved) * (1 + 0.5 * SKIN / radius) + 2);
    rig_close(&r);
}

static void walks_around_a_planet_at_its_speed(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        for (int coasts = 0; coasts < 2; coasts++) {
            go_around(5, rig_rates[i], coasts);
            go_around(20, rig_rates[i], coasts);
        }
    }
}

static void jumps_around_a_planet_land_on_it(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        rig r;
        tahr_body_desc planet = fixture_body(TAHR_BODY_SPHERE);
        int landings = 0;
        planet.radius = 20;
        rig_open_bodies(&r, &planet, 1, NULL, fake_vec(0, 0, 21));
        rig_settle(&r);
        r.input.flags = TAHR_INPUT_GRAVITY;
        r.input.move = fake_vec(1, 0, 0);
        for (int k = 0; k < 12 * (int)rig_rates[i]; k++) {
            tahr_vec3 at = r.state.position;
            double size = sqrt(dot3(at, at));
            r.input.gravity = times(at, -G / size);
            r.input.move = fake_vec(at.z, 0.2 * at.y, -at.x);
            r.input.jump = k % (3 * (int)rig_rates[i]) == 0;
            rig_step(&r, 1 / rig_rates[i]);
            landings += rig_event(&r, TAHR_EVENT_LANDED) != NULL;
            size = sqrt(dot3(r.state.position, r.state.position));
            /* At 6 m/s around, 9.81 - 6^2 / 20.9 of gravity is left to stop 4.2 m/s; a tenth for its direction, which
             * is that at the begin of a step. */
            assert_true(size > 20 + H + SKIN - 0.02);
            assert_true(size < 20 + H + 2 * SKIN + 1.1 * 4.2 * 4.2 / (2 * (G - 36 / (20 + H))));
        }
        assert_int_equal(landings, 4);
        rig_close(&r);
    }
}

/* Among boxes, with a direction and strength that change at random, and none at times. */
static void gravity_thrown_about_at_random_overlaps_nothing(void **unused)
{
    static native_grid grid;
    tahr_body_desc bodies[NATIVE_HILLS];
    (void)unused;
    native_hills(&grid, bodies);
    for (uint64_t seed = 1; seed < 5; seed++) {
        oracle_random dice = {seed};
        rig r;
        rig_open_bodies(&r, bodies, NATIVE_HILLS, NULL, fake_vec(6, 6, 3));
        r.input.flags = TAHR_INPUT_GRAVITY;
        for (int k = 0; k < 2000; k++) {
            if (oracle_below(&dice, 5) == 0) {
                r.input.gravity = times(dice_direction(&dice), oracle_below(&dice, 4) ? G : 0);
                r.input.move = dice_vec(&dice, -1, 1);
            }
            if (k % 200 == 0) { /* it falls out of the world before long */
                assert_int_equal(tahr_state_teleport(&r.state, &(tahr_vec3){6, 6, 3}), TAHR_OK);
                r.state.velocity = fake_vec(0, 0, 0);
            }
            rig_step(&r, 1.0 / 60);
            tahr_contact_query q = {.shape = r.config.shape,
                                    .position = r.state.position,
                                    .up = r.state.up,
                                    .orientation = r.state.orientation,
                                    .mask = ~0u,
                                    .ignore_body = TAHR_NO_BODY};
            tahr_contact contact = {0};
            uint32_t count = 0;
            assert_true(tahr_world_contacts(r.world, &q, &contact, 1, &count) >= 0);
            assert_true(count == 0 || contact.sensor || contact.distance > -1e-5);
        }
        rig_close(&r);
    }
}

/* A floor with a step, a ramp and a wall, seen in a turned frame. */
static void furnish(tahr_body_desc bodies[4], tahr_quat q)
{
    const tahr_vec3 at[] = {{0, 0, -0.5}, {2.5, 0, 0.1}, {6, 0, -0.2}, {-3, 0, 1}};
    const tahr_vec3 half[] = {{4, 4, 0.5}, {0.5, 4, 0.1}, {3, 4, 0.5}, {0.2, 4, 1}};
    for (int i = 0; i < 4; i++) {
        tahr_quat own = {0, i == 2 ? -sin(0.15) : 0, 0, i == 2 ? cos(0.15) : 1}; /* the ramp: 0.3 rad */
        bodies[i] = native_box(fake_turn(q, at[i]), half[i]);
        bodies[i].pose.orientation = (tahr_quat){q.w * own.x + q.x * own.w + q.y * own.z - q.z * own.y,
                                                 q.w * own.y - q.x * own.z + q.y * own.w + q.z * own.x,
                                                 q.w * own.z + q.x * own.y - q.y * own.x + q.z * own.w,
                                                 q.w * own.w - q.x * own.x - q.y * own.y - q.z * own.z};
    }
}

enum { STEPS = 300 };

/* Over the step, up the ramp, back with jumps to the wall; the way in the scene's own frame. */
static void run_turned(tahr_quat q, tahr_vec3 way[STEPS], uint32_t modes[STEPS])
{
    tahr_body_desc bodies[4];
    tahr_config c = rig_config();
    tahr_native_desc options = fixture_options();
    tahr_world_desc desc;
    rig r;
    memset(&r, 0, sizeof r);
    furnish(bodies, q);
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bodies;
    desc.body_count = 4;
    desc.options = &options;
    assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &r.world), TAHR_OK);
    tahr_vec3 start = fake_turn(q, fake_vec(0, 0, 1));
    c.gravity = fake_turn(q, fake_vec(0, 0, -G));
    assert_int_equal(tahr_mover_create(r.world, &c, &r.mover), TAHR_OK);
    assert_int_equal(tahr_state_init(&r.state, &c, &start), TAHR_OK);
    r.input.struct_size = sizeof r.input;
    for (int k = 0; k < STEPS; k++) {
        r.input.move = fake_turn(q, k < 80 ? fake_vec(1, 0.1, 0) : fake_vec(-0.9, -0.3, 0));
        r.input.jump = k % 90 == 89;
        rig_step(&r, 1.0 / 60);
        way[k] = fake_turn_back(q, r.state.position);
        modes[k] = r.state.mode;
    }
    rig_close(&r);
}

/* The 26 directions to the neighbours of a cube in a grid of cubes. */
static void every_direction_of_gravity_moves_alike(void **unused)
{
    static tahr_vec3 upright[STEPS], way[STEPS];
    uint32_t modes[STEPS], same[STEPS];
    int jumps = 0;
    (void)unused;
    run_turned((tahr_quat){0, 0, 0, 1}, upright, same);
    for (int k = 1; k < STEPS; k++) {
        jumps += same[k] != same[k - 1];
    }
    assert_true(jumps >= 6 && upright[STEPS - 1].x < -2); /* it did something */
    for (int i = 0; i < 27; i++) {
        tahr_vec3 up = fake_vec(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        double size = sqrt(dot3(up, up));
        if (size > 0) {
            tahr_quat q = {-up.y / size, up.x / size, 0, 1 + up.z / size}; /* from z to up, the shortest way */
            double l = sqrt(q.x * q.x + q.y * q.y + q.w * q.w);
            q = l > 1e-9 ? (tahr_quat){q.x / l, q.y / l, 0, q.w / l} : (tahr_quat){1, 0, 0, 0};
            run_turned(q, way, modes);
            for (int k = 0; k < STEPS; k++) {
                tahr_vec3 d = fake_vec(way[k].x - upright[k].x, way[k].y - upright[k].y, way[k].z - upright[k].z);
                if (!(dot3(d, d) <= 1e-18) || modes[k] != same[k]) {
                    fail_msg("up %g %g %g, step %d: mode %u for %u, off by %g m", up.x, up.y, up.z, k, modes[k],
                             same[k], sqrt(dot3(d, d)));
                }
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(without_gravity_it_floats_straight_on_and_then_falls),
                                       cmocka_unit_test(who_stands_goes_on_standing_without_gravity),
                                       cmocka_unit_test(gravity_that_turns_over_drops_who_stands_to_the_ceiling),
                                       cmocka_unit_test(gravity_that_turns_aside_drops_who_stands_to_the_wall),
                                       cmocka_unit_test(gravity_that_flips_every_step_overlaps_nothing),
                                       cmocka_unit_test(gravity_too_strong_or_not_a_number_is_refused),
                                       cmocka_unit_test(walks_around_a_planet_at_its_speed),
                                       cmocka_unit_test(jumps_around_a_planet_land_on_it),
                                       cmocka_unit_test(gravity_thrown_about_at_random_overlaps_nothing),
                                       cmocka_unit_test(every_direction_of_gravity_moves_alike)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
