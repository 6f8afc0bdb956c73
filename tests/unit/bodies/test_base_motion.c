/* SPDX-License-Identifier: MIT
 * test_base_motion.c: carrying by moving bodies, against the exact poses of a point that is fixed to them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "stage.h"

/* Rides a path of poses and stays where the exact motion takes it, standing. */
static double ride(rig *r, tahr_pose (*path)(double t), double seconds, double dt)
{
    double worst = 0;
    tahr_pose start = {{0, 0, -0.25}, STAGE_LEVEL};
    tahr_vec3 first = stage_foot(r);
    int steps = (int)(seconds / dt + 0.5);
    for (int i = 1; i <= steps; i++) {
        tahr_pose pose = path(i * dt);
        stage_step(r, 0, pose, dt);
        assert_int_equal(r->state.mode, TAHR_MODE_WALKING);
        worst = fmax(worst, stage_distance(stage_foot(r), stage_carried(&start, &pose, first)));
    }
    return worst;
}

static tahr_pose turntable(double t)
{
    tahr_pose p = {{0, 0, -0.25}, stage_yaw(t)};
    return p;
}

static tahr_pose lift(double t)
{
    tahr_pose p = {{0, 0, -0.25 + 3 * sin(2 * t)}, STAGE_LEVEL};
    return p;
}

/* Sinks at up to 20 m/s2, twice as fast as anything falls. */
static tahr_pose plunge(double t)
{
    tahr_pose p = {{0, 0, -0.25 - 10 * t * t}, STAGE_LEVEL};
    return p;
}

static tahr_pose shuttle(double t)
{
    tahr_pose p = {{2 * sin(1.5707963267948966 * t), 0, -0.25}, STAGE_LEVEL};
    return p;
}

static tahr_pose diagonal(double t)
{
    tahr_pose p = {{4 * t, 3 * t, -0.25 - 5 * t}, STAGE_LEVEL};
    return p;
}

static tahr_pose everything(double t)
{
    tahr_pose p = {{3 * sin(t), 2 * t, -0.25 + sin(3 * t)}, stage_yaw(2 * t)};
    return p;
}

static void standing_on_a_moving_base_is_going_with_it_exactly(void **unused)
{
    tahr_pose (*const paths[])(double) = {turntable, lift, plunge, shuttle, diagonal, everything};
    tahr_config configs[4] = {rig_config(), rig_config(), rig_config()};
    (void)unused;
    configs[1].shape = (tahr_shape){.type = TAHR_SHAPE_BOX, .half_height = 0.8, .half_x = 0.3, .half_y = 0.2};
    configs[2].shape = (tahr_shape){.type = TAHR_SHAPE_SPHERE, .radius = 0.4, .half_height = 0.4};
    assert_int_equal(tahr_config_init(&configs[3], sizeof configs[3], TAHR_PRESET_UNREAL), TAHR_OK);
    for (size_t k = 0; k < sizeof paths / sizeof paths[0]; k++) {
        for (int i = 0; i < RIG_RATES; i++) {
            for (int c = 0; c < 4; c++) {
                rig r;
                stage_stand_on_slab(&r, &configs[c], 2, 1);
                assert_true(ride(&r, paths[k], 3, 1 / rig_rates[i]) < 1e-9);
                rig_close(&r);
            }
        }
    }
}

static void a_moving_base_costs_one_sweep_more(void **unused)
{
    rig r;
    (void)unused;
    stage_stand_on_slab(&r, NULL, 2, 1);
    for (int n = 1; n < 60; n++) {
        r.input.move = fake_vec(n < 30 ? 0 : 0.1, 0, 0);
        stage_step(&r, 0, everything(n / 60.0), 1.0 / 60);
        assert_int_equal(r.report.sweeps, n < 30 ? 1 : 3);
        assert_int_equal(r.report.contact_queries + r.report.rays, 0);
    }
    rig_close(&r);
}

static void bodies_that_move_elsewhere_cost_no_query(void **unused)
{
    rig r;
    tahr_body_desc bodies[2] = {stage_ground(), stage_box(fake_vec(20, 0, 1), fake_vec(1, 1, 1))};
    (void)unused;
    rig_open_bodies(&r, bodies, 2, NULL, fake_vec(0, 0, 1));
    rig_settle(&r);
    for (int n = 1; n < 60; n++) {
        r.input.move = fake_vec(n < 30 ? 0 : 0.1, 0, 0);
        stage_step(&r, 1, (tahr_pose){{20, 4 * sin(n / 60.0), 1}, STAGE_LEVEL}, 1.0 / 60);
        assert_int_equal(r.report.sweeps, n < 30 ? 0 : 2);
        assert_int_equal(r.report.contact_queries + r.report.rays, 0);
    }
    rig_close(&r);
}

static void what_is_placed_while_others_move_is_noticed(void **unused)
{
    rig r;
    tahr_body_desc bodies[3] = {stage_ground(), stage_box(fake_vec(20, 0, 1), fake_vec(1, 1, 1)),
                                stage_box(fake_vec(30, 0, 1), fake_vec(1, 1, 1))};
    tahr_body_pose put = {2, 0, {{1.2, 0, 1}, STAGE_LEVEL}};
    (void)unused;
    for (int jumps = 0; jumps < 2; jumps++) {
        rig_open_bodies(&r, bodies, 3, NULL, fake_vec(0, 0, 1));
        rig_settle(&r);
        stage_step(&r, 1, (tahr_pose){{20, 1, 1}, STAGE_LEVEL}, 1.0 / 60);
        tahr_body_pose poses[2] = {{1, 0, {{20, 2, 1}, STAGE_LEVEL}}, put};
        poses[1].flags = TAHR_POSE_TELEPORT;
        assert_int_equal(tahr_world_move(r.world, poses, jumps ? 2 : 1, 1.0 / 60), TAHR_OK);
        if (!jumps) {
            assert_int_equal(tahr_world_set(r.world, &put, 1), TAHR_OK);
        }
        rig_step(&r, 1.0 / 60);
        assert_non_null(rig_event(&r, TAHR_EVENT_DEPENETRATED));
        assert_near(r.state.position.x, 0.2 - 0.35 - 0.01, 1e-5); /* out of it by the short way */
        rig_close(&r);
    }
}

/* A seesaw of up to 20 degrees. The foot stays over its point of the plank, at the height of a foot that is round: a
 * sphere on a slope touches beside its lowest point, r (1 / cos - 1) = 22 mm higher up; the band of the clearance is 15
 * mm. */
static void a_base_that_tilts_keeps_who_stands_on_it(void **unused)
{
    (void)unused;
    for (int i = 1; i < RIG_RATES; i++) {
        rig r;
        double dt = 1 / rig_rates[i];
        tahr_pose start = {{0, 0, -0.25}, STAGE_LEVEL};
        stage_stand_on_slab(&r, NULL, 3, 0);
        tahr_vec3 first = stage_foot(&r);
        for (int n = 1; n * dt < 4; n++) {
            double angle = 0.35 * sin(2 * n * dt);
            tahr_pose pose = {{0, 0, -0.25}, {0, sin(angle / 2), 0, cos(angle / 2)}};
            stage_step(&r, 0, pose, dt);
            assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
            assert_false(r.report.flags & TAHR_REPORT_CRUSHED);
            /* Upright over a point that also leans sideways as the plank turns: by what it stands off it, at most. */
            assert_true(stage_distance(stage_foot(&r), stage_carried(&start, &pose, first)) < 0.045);
        }
        rig_close(&r);
    }
}

/* m to what is nearest, at most a bit more than the skin. */
static double clearance(const rig *r)
{
    tahr_contact nearest;
    uint32_t count = 0;
    const tahr_contact_query q = {.shape = r->config.shape,
                                  .position = r->state.position,
                                  .up = r->state.up,
                                  .orientation = r->state.orientation,
                                  .margin = 1.1 * r->config.skin,
                                  .mask = r->config.mask,
                                  .ignore_body = TAHR_NO_BODY,
                                  .flags = TAHR_CONTACTS_SOLID};
    assert_true(tahr_world_contacts(r->world, &q, &nearest, 1, &count) >= 0);
    return count > 0 ? nearest.distance : q.margin;
}

/* Past the end of a slab that tilts the upright shape turns, seen from the slab: held where they meet, not by its
 * middle, it comes no nearer. */
static void who_falls_past_the_end_of_what_tilts_comes_no_nearer(void **unused)
{
    const double dt = 1.0 / 60;
    int falls_past = 0;
    (void)unused;
    for (int i = 0; i < 200; i++) {
        rig r;
        const double spin = 0.2 * (i % 10 - 4.5), height = 0.1 * (i / 10);
        const tahr_body_desc slab = stage_box(fake_vec(0, 0, -0.5), fake_vec(6, 6, 0.5));
        rig_open_bodies(&r, &slab, 1, NULL, fake_vec(6.4, 0, height));
        r.input.move = fake_vec(-1, 0, 0);
        for (int n = 1; n < 60; n++) {
            const double half = spin * n * dt / 2;
            const tahr_body_pose moved = {0, 0, {slab.pose.position, {0, sin(half), 0, cos(half)}}};
            assert_int_equal(tahr_world_move(r.world, &moved, 1, dt), TAHR_OK);
            const double before = clearance(&r);
            rig_step(&r, dt);
            const double now = clearance(&r), owed = fmin(before, r.config.skin);
            falls_past += now < 1.05 * r.config.skin && r.state.mode == TAHR_MODE_FALLING;
            if (now < owed - 1e-5) {
                fail_msg("spin %g, from %g m, step %d: %g m instead of %g", spin, height, n, now, owed);
            }
        }
        rig_close(&r);
    }
    assert_true(falls_past > 1000);
}

static void up_may_be_any_direction(void **unused)
{
    rig r;
    tahr_config c = rig_config();
    tahr_body_desc slab = stage_box(fake_vec(-0.25, 0, 0), fake_vec(0.25, 5, 5));
    (void)unused;
    c.gravity = fake_vec(-9.81, 0, 0);
    rig_open_bodies(&r, &slab, 1, &c, fake_vec(1, 0.5, 1));
    rig_settle(&r);
    tahr_pose start = {{-0.25, 0, 0}, STAGE_LEVEL};
    tahr_vec3 first = fake_vec(r.state.position.x - 0.9, r.state.position.y, r.state.position.z);
    for (int n = 1; n <= 180; n++) { /* turns about x, which is up; rises, and goes sideways */
        double t = n / 60.0;
        tahr_pose pose = {{-0.25 + sin(t), t, 2 * t}, {sin(t), 0, 0, cos(t)}};
        stage_step(&r, 0, pose, 1.0 / 60);
        tahr_vec3 now = fake_vec(r.state.position.x - 0.9, r.state.position.y, r.state.position.z);
        assert_true(stage_distance(now, stage_carried(&start, &pose, first)) < 1e-9);
    }
    rig_close(&r);
}

static void ten_minutes_on_a_turntable_do_not_drift(void **unused)
{
    rig r;
    (void)unused;
    stage_stand_on_slab(&r, NULL, 4, 0);
    assert_true(ride(&r, turntable, 600, 1.0 / 60) < 1e-9);
    rig_close(&r);
}

static void the_orientation_turns_with_the_base_if_asked(void **unused)
{
    (void)unused;
    for (int turns = 0; turns < 2; turns++) {
        rig r;
        tahr_config c = rig_config();
        c.turn_with_base = (uint32_t)turns;
        stage_stand_on_slab(&r, &c, 2, 0);
        ride(&r, turntable, 1, 1.0 / 60);
        tahr_quat q = stage_yaw(turns ? 1 : 0);
        assert_near(r.state.orientation.z, q.z, 1e-12);
        assert_near(r.state.orientation.w, q.w, 1e-12);
        rig_close(&r);
    }
}

static void walking_on_a_moving_base_is_walking_relative_to_it(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        rig r;
        double dt = 1 / rig_rates[i];
        stage_stand_on_slab(&r, NULL, -4, 0);
        r.input.move = fake_vec(0.5, 0, 0);
        for (int k = 1; k <= (int)rig_rates[i]; k++) {
            tahr_pose pose = {{7 * k * dt, 0, -0.25 + k * dt}, STAGE_LEVEL};
            stage_step(&r, 0, pose, dt);
        }
        assert_near(r.state.position.x, -4 + 7 + 3 - 9 / (2 * 20.48), 1e-9);
        assert_near(r.state.velocity.x, 3, 1e-9);
        rig_close(&r);
    }
}

static void a_base_that_teleports_carries_nobody(void **unused)
{
    rig r;
    tahr_body_pose jump = {0, TAHR_POSE_TELEPORT, {{2, 0, -0.25}, STAGE_LEVEL}};
    (void)unused;
    stage_stand_on_slab(&r, NULL, 1, 0);
    ride(&r, turntable, 0.5, 1.0 / 60);
    tahr_vec3 before = r.state.position;
    assert_int_equal(tahr_world_move(r.world, &jump, 1, 1.0 / 60), TAHR_OK);
    rig_step(&r, 1.0 / 60);
    assert_true(stage_distance(before, r.state.position) < 1e-9);
    assert_int_equal(r.state.mode, TAHR_MODE_WALKING); /* still over it */
    jump.pose.position.x = 100;
    assert_int_equal(tahr_world_move(r.world, &jump, 1, 1.0 / 60), TAHR_OK);
    rig_step(&r, 1.0 / 60);
    assert_int_equal(r.state.mode, TAHR_MODE_FALLING);
    assert_near(r.state.velocity.x, 0, 0);
    rig_close(&r);
}

static void placing_a_base_anew_carries_nobody(void **unused)
{
    rig r;
    tahr_body_pose put = {0, 0, {{1, 0, -0.25}, STAGE_LEVEL}};
    (void)unused;
    stage_stand_on_slab(&r, NULL, 1, 0);
    ride(&r, turntable, 0.5, 1.0 / 60);
    tahr_vec3 before = r.state.position;
    assert_int_equal(tahr_world_set(r.world, &put, 1), TAHR_OK);
    rig_step(&r, 1.0 / 60);
    assert_true(stage_distance(before, r.state.position) < 1e-9);
    rig_close(&r);
}

static void a_lift_takes_a_character_down_without_a_hop_however_it_accelerates(void **unused)
{
    rig r;
    const double dt = 1.0 / 30;
    (void)unused;
    stage_stand_on_slab(&r, NULL, 0, 0);
    double height = stage_foot(&r).z;
    for (int n = 1; n <= 90; n++) { /* down 2 m a step and back up, at once */
        double z = n % 2 ? -2 : 0;
        tahr_pose pose = {{0, 0, -0.25 + z}, STAGE_LEVEL};
        stage_step(&r, 0, pose, dt);
        assert_near(stage_foot(&r).z - z, height, 1e-9);
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        assert_null(rig_event(&r, TAHR_EVENT_LEFT_GROUND));
    }
    rig_close(&r);
}

static void what_is_in_the_way_of_the_carried_is_reported(void **unused)
{
    rig r;
    const double dt = 1.0 / 60;
    tahr_body_desc bodies[2] = {stage_box(fake_vec(0, 0, -0.25), fake_vec(5, 5, 0.25)),
                                stage_box(fake_vec(3, 0, 1), fake_vec(0.5, 5, 1))};
    (void)unused;
    bodies[1].flags = 0;
    rig_open_bodies(&r, bodies, 2, NULL, fake_vec(1.5, 0, 1));
    rig_settle(&r);
    int lost = 0;
    for (int n = 1; n <= 60; n++) {
        tahr_pose pose = {{2 * n * dt, 0, -0.25}, STAGE_LEVEL};
        stage_step(&r, 0, pose, dt);
        lost += (r.report.flags & TAHR_REPORT_BASE_LOST) != 0;
        assert_true(r.state.position.x <= 2.5 - 0.35 - 0.01 + 1e-6);
        assert_false(r.report.flags & TAHR_REPORT_CRUSHED);
    }
    assert_in_range(lost, 40, 45); /* 0.64 m of way: 19 steps of 2/60 m are free, one is cut short */
    assert_near(r.state.position.x, 2.5 - 0.35 - 0.01, 1e-6);
    rig_close(&r);
}

static void a_body_that_may_not_carry_does_not(void **unused)
{
    rig r;
    const double dt = 1.0 / 60;
    tahr_body_desc slab = stage_box(fake_vec(0, 0, -0.25), fake_vec(5, 5, 0.25));
    (void)unused;
    slab.flags |= TAHR_BODY_NO_BASE;
    rig_open_bodies(&r, &slab, 1, NULL, fake_vec(0, 0, 1));
    rig_settle(&r);
    for (int n = 1; n <= 30; n++) {
        tahr_pose pose = {{n * dt, 0, -0.25}, STAGE_LEVEL};
        stage_step(&r, 0, pose, dt);
    }
    assert_near(r.state.position.x, 0, 1e-9);
    assert_int_equal(r.state.base.body, TAHR_NO_BODY);
    rig_close(&r);
}

static void a_character_rides_on_another(void **unused)
{
    rig r;
    const double dt = 1.0 / 60;
    tahr_body_desc bodies[2];
    (void)unused;
    bodies[0] = stage_ground();
    bodies[1] = stage_box(fake_vec(0, 0, 0.9), fake_vec(0, 0, 0));
    bodies[1].type = TAHR_BODY_CAPSULE;
    bodies[1].radius = 0.35;
    bodies[1].half_height = 0.9;
    bodies[1].flags |= TAHR_BODY_CHARACTER;
    rig_open_bodies(&r, bodies, 2, NULL, fake_vec(0, 0, 2.9));
    rig_settle(&r);
    for (int n = 1; n <= 120; n++) {
        tahr_pose pose = {{4 * n * dt, sin(n * dt), 0.9}, STAGE_LEVEL};
        stage_step(&r, 1, pose, dt);
        assert_near(r.state.position.x, 4 * n * dt, 1e-9);
        assert_near(r.state.position.y, sin(n * dt), 1e-9);
        assert_int_equal(r.state.base.body, 1);
    }
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(standing_on_a_moving_base_is_going_with_it_exactly),
        cmocka_unit_test(a_moving_base_costs_one_sweep_more),
        cmocka_unit_test(bodies_that_move_elsewhere_cost_no_query),
        cmocka_unit_test(what_is_placed_while_others_move_is_noticed),
        cmocka_unit_test(a_base_that_tilts_keeps_who_stands_on_it),
        cmocka_unit_test(who_falls_past_the_end_of_what_tilts_comes_no_nearer),
        cmocka_unit_test(up_may_be_any_direction),
        cmocka_unit_test(ten_minutes_on_a_turntable_do_not_drift),
        cmocka_unit_test(the_orientation_turns_with_the_base_if_asked),
        cmocka_unit_test(walking_on_a_moving_base_is_walking_relative_to_it),
        cmocka_unit_test(a_base_that_teleports_carries_nobody),
        cmocka_unit_test(placing_a_base_anew_carries_nobody),
        cmocka_unit_test(a_lift_takes_a_character_down_without_a_hop_however_it_accelerates),
        cmocka_unit_test(what_is_in_the_way_of_the_carried_is_reported),
        cmocka_unit_test(a_body_that_may_not_carry_does_not),
        cmocka_unit_test(a_character_rides_on_another)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
