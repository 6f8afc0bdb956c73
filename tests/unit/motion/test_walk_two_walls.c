/* SPDX-License-Identifier: MIT
 * test_walk_two_walls.c: the loops of the unreal preset: ramps, walls, steps, ledges, falls and landings. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "floor.h"
#include "native_world.h"
#include "parity.h"
#include "rig.h"
#include "step_up.h"

static const double rates[] = {10, 30, 60, 240};
enum { RATES = 4 };

static rig stand_unreal(fake_world *w, const tahr_config *config, tahr_vec3 at)
{
    rig r;
    tahr_config c = config ? *config : parity_config();
    rig_stand(&r, w, &c, at);
    return r;
}

static void level_speed_is_kept_up_a_ramp_or_the_speed_along_it(void **unused)
{
    const double slope = tan(acos(-1.0) / 6);
    (void)unused;
    for (int i = 0; i < RATES; i++) {
        for (uint32_t keep = 0; keep < 2; keep++) {
            fake_world w;
            tahr_config c = parity_config();
            c.keep_level_speed = keep;
            fake_world_init(&w);
            fake_add_slope(&w, 30);
            rig r = stand_unreal(&w, &c, fake_vec(0, 0, 1.1));
            r.input.move = fake_vec(1, 0, 0);
            rig_steps(&r, (int)rates[i], 1 / rates[i]);
            tahr_vec3 from = r.state.position;
            rig_steps(&r, (int)rates[i], 1 / rates[i]);
            double along = r.state.position.x - from.x, expected = keep ? 6 : 6 * sqrt(0.75);
            assert_near(along, expected, 1e-6);
            assert_near(r.state.position.z - from.z, along * slope, 0.01); /* within the hover band of 5 mm */
            assert_near(r.state.velocity.z, 0, 0);
            assert_near(r.state.velocity.x, 6, 1e-6);
            rig_close(&r);
        }
    }
}

static void the_joint_solver_keeps_the_level_speed_too_if_asked(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        tahr_config c = rig_config();
        c.keep_level_speed = 1;
        fake_world_init(&w);
        fake_add_slope(&w, 30);
        rig r = stand_unreal(&w, &c, fake_vec(0, 0, 1.1));
        r.state.velocity = fake_vec(0, 6, 0);
        r.input.move = fake_vec(0.6, 0.8, 0);
        rig_steps(&r, (int)(2 * rig_rates[i]), 1 / rig_rates[i]);
        tahr_vec3 from = r.state.position;
        rig_steps(&r, (int)rig_rates[i], 1 / rig_rates[i]);
        assert_near(r.state.position.x - from.x, 3.6, 1e-6); /* what turned out of the first heading decays with
                                                              * e^(-16) */
        assert_near(r.state.position.y - from.y, 4.8, 1e-6);
        rig_close(&r);
    }
}

static void slopes_too_steep_are_walls(void **unused)
{
    (void)unused;
    for (int i = 0; i < RATES; i++) {
        fake_world w;
        fake_world_flat(&w);
        fake_solid *slope = fake_add_slope(&w, 50);
        slope->offset = -2 * sin(50 * acos(-1.0) / 180); /* begins at x = 2 */
        rig r = stand_unreal(&w, NULL, fake_vec(0, 0, 1));
        double ground = r.state.position.z;
        r.input.move = fake_vec(1, 0, 0);
        for (int k = 0; k < (int)(3 * rates[i]); k++) {
            rig_step(&r, 1 / rates[i]);
            assert_true(r.state.position.z < ground + 0.01);
        }
        assert_true(r.state.position.x > 1 && r.state.position.x < 2);
        assert_near(r.state.velocity.x, 0, 0.02); /* what creeps on into the pull-back */
        rig_close(&r);
    }
}

static void walls_are_slid_along_and_corners_stop(void **unused)
{
    const double h = sqrt(0.5);
    (void)unused;
    for (int i = 0; i < RATES; i++) {
        fake_world w;
        fake_world_flat(&w);
        fake_add_plane(&w, fake_vec(-1, 0, 0), -2);
        rig r = stand_unreal(&w, NULL, fake_vec(0, 0, 1));
        r.input.move = fake_vec(h, h, 0);
        rig_steps(&r, (int)(2 * rates[i]), 1 / rates[i]);
        assert_true(r.state.position.x < 2 - 0.34 && r.state.position.x > 2 - 0.34 - 0.07);
        double speed = r.state.velocity.y;
        assert_true(speed > 0.5 * 6 * h && speed <= 6); /* bumps into the wall brake, what is along it goes on */
        fake_add_plane(&w, fake_vec(0, -1, 0), -(r.state.position.y + 2));
        assert_int_equal(tahr_world_touch(r.world), TAHR_OK);
        rig_steps(&r, (int)(3 * rates[i]), 1 / rates[i]);
        tahr_vec3 corner = r.state.position;
        rig_steps(&r, (int)rates[i], 1 / rates[i]);
        assert_near(r.state.position.x, corner.x, 1e-3);
        assert_near(r.state.position.y, corner.y, 1e-3);
        rig_close(&r);
    }
}

static void a_refused_step_leaves_every_bit(void **unused)
{
    parity_scene scene = {.count = 0};
    oracle_random dice = {11};
    parity p;
    int refused = 0, taken = 0;
    (void)unused;
    parity_plane(&scene, 0, 0, 1, 0);
    parity_box(&scene, fake_vec(36, -300, -10), fake_vec(80, 20, 46));
    parity_box(&scene, fake_vec(70, -300, -10), fake_vec(300, 300, 60));
    parity_box(&scene, fake_vec(-300, 36, -10), fake_vec(30, 80, 30));
    parity_box(&scene, fake_vec(-300, -300, 190), fake_vec(-40, 300, 250));
    parity_open(&p, &scene, PARITY_FAKE, NULL, 0, 0, 90.15);
    for (int i = 0; i < 2000; i++) {
        tahr_floor floor;
        tahr__swept obstacle;
        int found;
        parity_put(&p, oracle_uniform(&dice, -60, 0), oracle_uniform(&dice, -60, 0), 90.15);
        p.step.state.mode = TAHR_MODE_WALKING;
        tahr__find_floor(&p.step, p.config.snap_distance, NULL, &floor);
        tahr__keep_floor(&p.step, &floor);
        vec3 d = dice_direction(&dice), level = scale(unit(vec(d.x, d.y, 0)), oracle_uniform(&dice, 0.01, 0.9));
        tahr__move_updated(&p.step, level, 0, &obstacle);
        const tahr_state before = p.step.state;
        const tahr_report report = p.step.report;
        if (tahr__step_up_by_contact(&p.step, level, &obstacle, &found)) {
            taken++;
            continue;
        }
        refused += obstacle.hit.blocking != 0;
        assert_memory_equal(&p.step.state, &before, sizeof before);
        assert_int_equal(p.step.report.event_count, report.event_count);
        assert_int_equal(p.step.report.slides, report.slides);
        assert_true(p.step.report.step_offset == report.step_offset);
        assert_int_equal(p.step.just_teleported, 0);
    }
    print_message("%d refused, %d taken\n", refused, taken);
    assert_true(refused > 100 && taken > 100);
    parity_close(&p);
}

static double walk_into_block(double height, uint32_t flags, double hz)
{
    tahr_body_desc bodies[2];
    rig r;
    const tahr_config c = parity_config();
    bodies[0] = native_box(fake_vec(0, 0, -1), fake_vec(20, 20, 1));
    bodies[1] = native_box(fake_vec(11, 0, 0.5 * height), fake_vec(10, 5, 0.5 * height));
    bodies[1].flags = flags;
    rig_open_bodies(&r, bodies, 2, &c, fake_vec(0, 0, 1));
    rig_settle(&r);
    double ground = r.state.position.z;
    r.input.move = fake_vec(1, 0, 0);
    rig_steps(&r, (int)hz, 1 / hz);
    double rise = r.state.position.z - ground;
    rig_close(&r);
    return rise;
}

static void steps_are_climbed_up_to_the_step_height_unless_they_refuse(void **unused)
{
    (void)unused;
    for (int i = 0; i < RATES; i++) {
        assert_near(walk_into_block(0.2, 0, rates[i]), 0.2, 0.005); /* the hover band */
        assert_near(walk_into_block(0.44, 0, rates[i]), 0.44, 0.005);
        assert_near(walk_into_block(0.46, 0, rates[i]), 0, 0.005);
        assert_near(walk_into_block(0.4, TAHR_BODY_NO_STEP, rates[i]), 0, 0.005);
    }
}

/* A box of 10 cm that is passed at 6 m/s: in at its face less the radius, out at the other one and the radius. */
static void sensors_on_the_way_are_met_at_their_time(void **unused)
{
    (void)unused;
    for (int i = 0; i < RATES; i++) {
        tahr_body_desc bodies[2];
        rig r;
        const tahr_config c = parity_config();
        double begin = -1, end = -1;
        bodies[0] = native_box(fake_vec(0, 0, -1), fake_vec(20, 20, 1));
        bodies[1] = native_box(fake_vec(2, 0, 1), fake_vec(0.05, 5, 1));
        bodies[1].flags = TAHR_BODY_SENSOR;
        rig_open_bodies(&r, bodies, 2, &c, fake_vec(0, 0, 1));
        rig_settle(&r);
        r.time = 0;
        r.state.velocity = fake_vec(6, 0, 0);
        r.input.move = fake_vec(1, 0, 0);
        while (end < 0 && r.time < 1) {
            double start = r.time;
            rig_step(&r, 1 / rates[i]);
            const tahr_event *in = rig_event(&r, TAHR_EVENT_OVERLAP_BEGIN),
                             *out = rig_event(&r, TAHR_EVENT_OVERLAP_END);
            begin = in ? start + in->time : begin;
            end = out ? start + out->time : end;
        }
        assert_near(begin, (2 - 0.05 - 0.34) / 6, 1e-6);
        assert_near(end, (2 + 0.05 + 0.34) / 6, 1e-6);
        rig_close(&r);
    }
}

static void nobody_walks_off_a_plateau_who_may_not(void **unused)
{
    (void)unused;
    for (int i = 0; i < RATES; i++) {
        fake_world w;
        oracle_random dice = {(uint64_t)i + 1};
        tahr_config c = parity_config();
        c.walk_off_ledges = 0;
        fake_world_init(&w);
        fake_add_box(&w, fake_vec(-2, -2, -1), fake_vec(2, 2, 0));
        rig r = stand_unreal(&w, &c, fake_vec(0, 0, 1));
        double ground = r.state.position.z, way = 0;
        for (int k = 0; k < (int)(20 * rates[i]); k++) {
            tahr_vec3 before = r.state.position;
            if (k % (int)(0.5 * rates[i]) == 0) {
                double a = oracle_uniform(&dice, 0, 2 * acos(-1.0));
                r.input.move = fake_vec(cos(a), sin(a), 0);
            }
            rig_step(&r, 1 / rates[i]);
            assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
            assert_true(r.state.position.z > ground - 0.34); /* hangs lower at the edge, but on it */
            way += hypot(r.state.position.x - before.x, r.state.position.y - before.y);
        }
        assert_true(way > 10);
        rig_close(&r);
    }
}

static void who_stands_where_the_floor_vanishes_falls_in_the_next_step(void **unused)
{
    fake_world w;
    (void)unused;
    fake_world_flat(&w);
    rig r = stand_unreal(&w, NULL, fake_vec(0, 0, 1));
    double z = r.state.position.z;
    w.count = 0;
    assert_int_equal(tahr_world_touch(r.world), TAHR_OK);
    rig_step(&r, 0.05);
    assert_int_equal(r.state.mode, TAHR_MODE_FALLING);
    const tahr_event *e = rig_event(&r, TAHR_EVENT_LEFT_GROUND);
    assert_non_null(e);
    assert_true(e->value == TAHR_LEFT_LEDGE);
    assert_near(r.state.position.z, z, 0);
    rig_step(&r, 0.05);
    assert_near(r.state.position.z, z - 0.5 * 9.8 * 0.05 * 0.05, 1e-12);
    rig_close(&r);
}

static void landings_tell_when_and_how_fast(void **unused)
{
    (void)unused;
    for (int i = 0; i < RATES; i++) {
        fake_world w;
        rig r;
        const tahr_config c = parity_config();
        fake_world_flat(&w);
        rig_open(&r, &w, &c, fake_vec(0, 0, 0.88 + 3));
        const tahr_event *e = NULL;
        while (!e && r.time < 2) {
            rig_step(&r, 1 / rates[i]);
            e = rig_event(&r, TAHR_EVENT_LANDED);
        }
        assert_non_null(e);
        double h = 1 / rates[i], end = sqrt(2 * 3 / 9.8);
        assert_near(r.time - h + e->time, end, 0.06 * h + 0.002); /* a chord is up to 5 % ahead, a pull-back 1 cm */
        assert_true(e->value <= 9.8 * (end + h) && e->value >= 9.8 * (end - 0.002)); /* speed at the end of its slice */
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        rig_steps(&r, 4, h);
        assert_near(r.state.position.z, 0.88 + 0.0215, 1e-6);
        rig_close(&r);
    }
}

/* Into a 60 degree slope with all the input there is. */
static void steering_does_not_push_up_a_slope(void **unused)
{
    (void)unused;
    for (int i = 0; i < RATES; i++) {
        fake_world w;
        rig r;
        tahr_config c = parity_config();
        c.air_control = 1;
        fake_world_init(&w);
        fake_add_slope(&w, 60);
        rig_open(&r, &w, &c, fake_vec(0, 0, 2));
        r.input.move = fake_vec(1, 0, 0);
        double highest = r.state.position.z;
        for (int k = 0; k < (int)(2 * rates[i]); k++) {
            rig_step(&r, 1 / rates[i]);
            assert_true(r.state.position.z <= highest + 1e-9);
            assert_int_equal(r.state.mode, TAHR_MODE_FALLING);
            highest = r.state.position.z;
        }
        assert_true(r.state.position.z < -1);
        rig_close(&r);
    }
}

/* A gutter of two slopes of 60 degrees, neither of which can be stood on. */
static void ditches_end_a_fall(void **unused)
{
    const double s = sqrt(0.75);
    (void)unused;
    for (int i = 0; i < RATES; i++) {
        fake_world w;
        rig r;
        const tahr_config c = parity_config();
        fake_world_init(&w);
        fake_add_plane(&w, fake_vec(-s, 0, 0.5), 0);
        fake_add_plane(&w, fake_vec(s, 0, 0.5), 0);
        rig_open(&r, &w, &c, fake_vec(0.05, 0, 3));
        int landings = 0;
        for (int k = 0; k < (int)(3 * rates[i]); k++) {
            rig_step(&r, 1 / rates[i]);
            landings += rig_event(&r, TAHR_EVENT_LANDED) != NULL;
        }
        double bottom = 0.54 + 0.34 / 0.5; /* both touched: the centre of the lower cap lies r / sin 30 over the
                                            * crease */
        assert_true(landings > 0);
        assert_near(r.state.position.z, bottom, 0.03); /* the pull-back of the last motions */
        assert_near(r.state.position.x, 0, 0.03);
        rig_close(&r);
    }
}

static void a_long_step_is_cut_into_slices_and_says_so(void **unused)
{
    fake_world w;
    (void)unused;
    fake_world_flat(&w);
    rig r = stand_unreal(&w, NULL, fake_vec(0, 0, 1));
    r.input.move = fake_vec(1, 0, 0);
    rig_step(&r, 0.05);
    assert_int_equal(r.report.slices, 1);
    rig_step(&r, 0.051);
    assert_int_equal(r.report.slices, 2);
    rig_step(&r, 1);
    assert_int_equal(r.report.slices, 8);
    assert_near(r.report.time_lost, 0, 0);
    rig_close(&r);
}

static void who_starts_in_the_floor_gets_out(void **unused)
{
    fake_world w;
    (void)unused;
    for (int depth = 1; depth < 30; depth += 7) {
        fake_world_flat(&w);
        rig r = stand_unreal(&w, NULL, fake_vec(0, 0, 1));
        r.state.position.z = 0.88 - 0.01 * depth;
        rig_steps(&r, 120, 1.0 / 60);
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        assert_true(r.state.position.z >= 0.88 + 0.019 - 1e-6 && r.state.position.z <= 0.88 + 0.024 + 1e-6);
        rig_close(&r);
    }
}

/* Slantwise up a slope of 20 degrees along a wall, pushing 30 degrees into it: the floor is in the way of the slide
 * along the wall, and is gone up. The part of the wish along the wall speeds it up until it is as fast as asked for. */
static void walls_on_a_slope_are_walked_along_with_a_margin(void **unused)
{
    const double tilt = acos(-1.0) / 9, into = acos(-1.0) / 6;
    (void)unused;
    for (uint32_t mix = 0; mix < 8; mix++) {
        for (int side = -1; side < 2; side += 2) {
            tahr_config c = mix & 4 ? parity_config() : rig_config();
            fake_world w;
            rig r;
            c.slide_solver = TAHR_SLIDE_TWO_WALLS;
            c.separation = TAHR_SEPARATION_MARGIN;
            c.floor_probe = TAHR_FLOOR_PROBE_WHOLE;
            c.integrator = mix & 1 ? TAHR_INTEGRATOR_STEPPED : TAHR_INTEGRATOR_EXACT;
            c.step_rule = mix & 2 ? TAHR_STEP_BY_CONTACT : TAHR_STEP_BY_TREAD;
            fake_world_init(&w);
            fake_add_plane(&w, fake_vec(-sin(tilt), 0, cos(tilt)), 0);
            const tahr_vec3 along = fake_vec(sqrt(0.5), side * sqrt(0.5), 0), off = fake_vec(along.x, -along.y, 0);
            fake_add_plane(&w, off, -0.5);
            rig_stand(&r, &w, &c, fake_vec(0, 0, 1.2));
            r.input.move = add(scale(along, cos(into)), scale(off, -sin(into)));
            rig_steps(&r, 60, 1.0 / 60);
            tahr_vec3 from = r.state.position;
            rig_steps(&r, 60, 1.0 / 60);
            double way = dot(sub(r.state.position, from), along);
            assert_true(way > 6 * cos(into) && way <= 6 * (1 + 1e-9));
            rig_close(&r);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(level_speed_is_kept_up_a_ramp_or_the_speed_along_it),
        cmocka_unit_test(the_joint_solver_keeps_the_level_speed_too_if_asked),
        cmocka_unit_test(slopes_too_steep_are_walls),
        cmocka_unit_test(walls_are_slid_along_and_corners_stop),
        cmocka_unit_test(a_refused_step_leaves_every_bit),
        cmocka_unit_test(steps_are_climbed_up_to_the_step_height_unless_they_refuse),
        cmocka_unit_test(sensors_on_the_way_are_met_at_their_time),
        cmocka_unit_test(nobody_walks_off_a_plateau_who_may_not),
        cmocka_unit_test(who_stands_where_the_floor_vanishes_falls_in_the_next_step),
        cmocka_unit_test(landings_tell_when_and_how_fast),
        cmocka_unit_test(steering_does_not_push_up_a_slope),
        cmocka_unit_test(ditches_end_a_fall),
        cmocka_unit_test(a_long_step_is_cut_into_slices_and_says_so),
        cmocka_unit_test(who_starts_in_the_floor_gets_out),
        cmocka_unit_test(walls_on_a_slope_are_walked_along_with_a_margin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
