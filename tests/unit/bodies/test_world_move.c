/* SPDX-License-Identifier: MIT
 * test_world_move.c: moving bodies: what is refused, what is remembered, and that a rollback repeats. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "stage.h"

static const tahr_quat LEVEL = {0, 0, 0, 1};

/* The ground (0), two platforms (1, 2). */
static void open_stage(rig *r)
{
    tahr_body_desc bodies[3] = {stage_ground(), stage_box(fake_vec(0, 0, 0.5), fake_vec(3, 3, 0.5)),
                                stage_box(fake_vec(10, 0, 0.5), fake_vec(1, 1, 0.5))};
    bodies[2].surface_velocity = fake_vec(1, 0, 0);
    bodies[2].mass = 7;
    rig_open_bodies(r, bodies, 3, NULL, fake_vec(0, 0, 2));
}

static void expect_refused(rig *r, const tahr_body_pose *poses, uint32_t count, double dt, tahr_status status,
                           const char *said)
{
    uint64_t revision = tahr_world_revision(r->world);
    tahr_body_motion before, after;
    assert_int_equal(tahr_world_body(r->world, 1, &before), TAHR_OK);
    r->log.text[0] = 0;
    assert_int_equal(tahr_world_move(r->world, poses, count, dt), status);
    if (!strstr(r->log.text, said) || !strstr(r->log.text, "tahr_world_move")) {
        fail_msg("\"%s\" does not say \"%s\"", r->log.text, said);
    }
    assert_true(tahr_world_revision(r->world) == revision);
    assert_int_equal(tahr_world_body(r->world, 1, &after), TAHR_OK);
    assert_memory_equal(&before, &after, sizeof before);
}

static void wrong_motions_are_refused_and_change_nothing(void **unused)
{
    const double bad_dt[] = {0, -1, NAN, INFINITY, 10.5};
    rig r;
    tahr_body_pose poses[2] = {{1, 0, {{1, 0, 0.5}, LEVEL}}, {2, 0, {{10, 0, 1.5}, LEVEL}}};
    (void)unused;
    open_stage(&r);
    for (int i = 0; i < 5; i++) {
        expect_refused(&r, poses, 2, bad_dt[i], TAHR_E_ARGUMENT, "dt");
    }
    expect_refused(&r, NULL, 1, 0.1, TAHR_E_NULL, "poses");
    poses[1].body = 3;
    expect_refused(&r, poses, 2, 0.1, TAHR_E_NOT_FOUND, "poses[1].body");
    poses[1].body = 0; /* not movable */
    expect_refused(&r, poses, 2, 0.1, TAHR_E_ARGUMENT, "poses[1].body");
    poses[1].body = 2;
    poses[1].flags = 2;
    expect_refused(&r, poses, 2, 0.1, TAHR_E_ARGUMENT, "poses[1].flags");
    poses[1].flags = 0;
    poses[1].pose.orientation.w = 1.1;
    expect_refused(&r, poses, 2, 0.1, TAHR_E_ARGUMENT, "poses[1].pose.orientation");
    poses[1].pose.orientation.w = 1;
    poses[1].pose.position.y = NAN;
    expect_refused(&r, poses, 2, 0.1, TAHR_E_ARGUMENT, "poses[1].pose.position");
    assert_int_equal(tahr_world_move(NULL, NULL, 0, 0.1), TAHR_E_NULL);
    rig_close(&r);
}

static void a_motion_is_told_until_the_next_one(void **unused)
{
    rig r;
    tahr_body_motion m;
    (void)unused;
    open_stage(&r);
    /* 0.3 rad about (1, 2, 2) / 3, and (0.3, -0.6, 1.2) m, in 0.25 s */
    const double s = sin(0.15) / 3, c = cos(0.15);
    tahr_body_pose pose = {2, 0, {{10.3, -0.6, 1.7}, {s, 2 * s, 2 * s, c}}};
    assert_int_equal(tahr_world_move(r.world, &pose, 1, 0.25), TAHR_OK);
    assert_int_equal(tahr_world_body(r.world, 2, &m), TAHR_OK);
    assert_near(m.velocity.x, 1.2, 1e-12);
    assert_near(m.velocity.y, -2.4, 1e-12);
    assert_near(m.velocity.z, 4.8, 1e-12);
    assert_near(m.angular_velocity.x, 0.4, 1e-12);
    assert_near(m.angular_velocity.y, 0.8, 1e-12);
    assert_near(m.angular_velocity.z, 0.8, 1e-12);
    assert_near(m.mass, 7, 0);
    tahr_vec3 belt = fake_turn(pose.pose.orientation, fake_vec(1, 0, 0));
    assert_true(stage_distance(belt, m.surface_velocity) < 1e-12);
    assert_int_equal(m.teleported, 0);
    pose.flags = TAHR_POSE_TELEPORT;
    pose.pose = (tahr_pose){{20, 0, 0.5}, LEVEL};
    assert_int_equal(tahr_world_move(r.world, &pose, 1, 0.25), TAHR_OK);
    assert_int_equal(tahr_world_body(r.world, 2, &m), TAHR_OK);
    assert_int_equal(m.teleported, 1);
    assert_near(m.velocity.x, 0, 0);
    assert_int_equal(tahr_world_move(r.world, NULL, 0, 0.25), TAHR_OK);
    assert_int_equal(tahr_world_body(r.world, 2, &m), TAHR_OK);
    assert_int_equal(m.teleported, 0);
    assert_near(m.pose.position.x, 20, 0);
    assert_int_equal(tahr_world_body(r.world, 3, &m), TAHR_E_NOT_FOUND);
    assert_int_equal(tahr_world_body(r.world, 2, NULL), TAHR_E_NULL);
    assert_int_equal(tahr_world_body(NULL, 2, &m), TAHR_E_NULL);
    rig_close(&r);
}

static void half_a_turn_nearly_is_the_fastest_that_can_be_told(void **unused)
{
    const double angles[] = {1e-9, 1e-4, 0.5, 1.5707963267948966, 3.0};
    (void)unused;
    for (int k = 0; k < 5; k++) {
        rig r;
        tahr_body_motion m;
        open_stage(&r);
        tahr_body_pose pose = {1, 0, {{0, 0, 0.5}, stage_yaw(-angles[k])}};
        assert_int_equal(tahr_world_move(r.world, &pose, 1, 0.5), TAHR_OK);
        assert_int_equal(tahr_world_body(r.world, 1, &m), TAHR_OK);
        assert_near(m.angular_velocity.z, -2 * angles[k], 4e-16 + 1e-15 * angles[k]);
        rig_close(&r);
    }
}

static void the_revision_is_one_of_poses_and_motions(void **unused)
{
    rig r;
    tahr_body_pose a = {1, 0, {{0, 0, 0.5}, LEVEL}}, b = {1, 0, {{1, 0, 0.5}, LEVEL}},
                   c = {2, 0, {{11, 0, 0.5}, LEVEL}};
    tahr_body_pose both[2] = {b, c}, swapped[3] = {c, a, b};
    (void)unused;
    open_stage(&r);
    uint64_t first = tahr_world_revision(r.world);
    assert_int_equal(tahr_world_move(r.world, &b, 1, 0.1), TAHR_OK);
    uint64_t moved = tahr_world_revision(r.world);
    assert_true(moved != first);
    assert_int_equal(tahr_world_move(r.world, &b, 1, 0.1), TAHR_OK); /* stays: comes to rest */
    uint64_t rests = tahr_world_revision(r.world);
    assert_true(rests != moved && rests != first);
    assert_int_equal(tahr_world_set(r.world, &a, 1), TAHR_OK);
    assert_true(tahr_world_revision(r.world) == first);
    assert_int_equal(tahr_world_move(r.world, &b, 1, 0.2), TAHR_OK); /* more slowly */
    assert_true(tahr_world_revision(r.world) != moved);
    assert_int_equal(tahr_world_set(r.world, &a, 1), TAHR_OK);
    assert_int_equal(tahr_world_move(r.world, both, 2, 0.1), TAHR_OK);
    uint64_t two = tahr_world_revision(r.world);
    c.pose.position.x = 10;
    assert_int_equal(tahr_world_set(r.world, &a, 1), TAHR_OK);
    assert_int_equal(tahr_world_set(r.world, &c, 1), TAHR_OK);
    assert_int_equal(tahr_world_move(r.world, swapped, 3, 0.1), TAHR_OK); /* another order, and one named twice */
    assert_true(tahr_world_revision(r.world) == two);
    assert_int_equal(tahr_world_set(r.world, &a, 1), TAHR_OK);
    assert_int_equal(tahr_world_set(r.world, &c, 1), TAHR_OK);
    assert_true(tahr_world_revision(r.world) == first);
    rig_close(&r);
}

/* The platforms' poses at a tick: one turns and rises, the other sweeps across it. */
static void poses_at(int tick, tahr_body_pose poses[2])
{
    double t = tick / 60.0;
    poses[0] = (tahr_body_pose){1, 0, {{sin(t), 0, 0.5 + 0.5 * sin(3 * t)}, stage_yaw(t)}};
    poses[1] = (tahr_body_pose){2, 0, {{6 * cos(2 * t), 0.4, 1.6}, LEVEL}};
}

static void tick(rig *r, int n)
{
    tahr_body_pose poses[2];
    poses_at(n, poses);
    assert_int_equal(tahr_world_move(r->world, poses, 2, 1.0 / 60), TAHR_OK);
    r->input.move = fake_vec(n / 40 % 2 ? 0.15 : -0.15, n / 60 % 2 ? 0.1 : -0.1, 0);
    r->input.jump = n % 120 < 5;
    rig_step(r, 1.0 / 60);
}

static void a_rollback_repeats_every_bit(void **unused)
{
    enum { TICKS = 600, BACK = 37 };
    static tahr_state states[TICKS + 1];
    rig r;
    int carried = 0, hits = 0;
    (void)unused;
    open_stage(&r);
    rig_settle(&r);
    states[0] = r.state;
    for (int n = 1; n <= TICKS; n++) {
        tick(&r, n);
        states[n] = r.state;
        carried += r.state.base.body == 1;
        hits += rig_event(&r, TAHR_EVENT_HIT) != NULL;
        if (n % 50 == 0) {
            tahr_body_pose poses[2];
            int from = n - BACK;
            poses_at(from, poses);
            assert_int_equal(tahr_world_set(r.world, poses, 2), TAHR_OK);
            r.state = states[from];
            for (int k = from + 1; k <= n; k++) {
                tick(&r, k);
                assert_memory_equal(&r.state, &states[k], sizeof r.state);
            }
        }
    }
    assert_true(carried > 60 && hits > 10); /* it was worth repeating */
    rig_close(&r);
}

/* Pressed by a box that stands in it from the begin on: what is done then depends on the scene, not on what was moved
 * in it before. */
static void a_rollback_over_the_first_motion_repeats_every_bit(void **unused)
{
    enum { STEPS = 20 };
    const tahr_body_pose here = {1, 0, {{1.05, 0, 2.2}, LEVEL}}, away = {1, 0, {{1.05, 0, 9}, LEVEL}};
    tahr_body_desc bodies[2] = {stage_ground(), stage_box(here.pose.position, fake_vec(1, 1, 0.5))};
    tahr_state first[STEPS], at_start;
    rig r;
    (void)unused;
    memset(&bodies[1].pose.orientation, 0, sizeof bodies[1].pose.orientation); /* says what LEVEL says */
    rig_open_bodies(&r, bodies, 2, NULL, fake_vec(0, 0, 0.9125));
    uint64_t revision = tahr_world_revision(r.world);
    at_start = r.state;
    for (int k = 0; k < STEPS; k++) {
        rig_step(&r, 1.0 / 60);
        first[k] = r.state;
    }
    assert_true(stage_distance(first[STEPS - 1].position, at_start.position) > 0.01); /* it was pressed */
    assert_int_equal(tahr_world_move(r.world, &away, 1, 0.1), TAHR_OK);
    rig_steps(&r, 3, 1.0 / 60);
    assert_int_equal(tahr_world_set(r.world, &here, 1), TAHR_OK);
    assert_true(tahr_world_revision(r.world) == revision);
    r.state = at_start;
    for (int k = 0; k < STEPS; k++) {
        rig_step(&r, 1.0 / 60);
        assert_memory_equal(&r.state, &first[k], sizeof r.state);
    }
    rig_close(&r);
}

static void a_sweep_may_ask_one_body_alone(void **unused)
{
    rig r;
    tahr_hit hit;
    uint32_t count;
    tahr_sweep q = {.shape = {TAHR_SHAPE_SPHERE, 0, 0.25, 0.25, 0, 0},
                    .position = {0, 0, 5},
                    .up = {0, 0, 1},
                    .orientation = {0, 0, 0, 1},
                    .motion = {0, 0, -10},
                    .mask = 0xFFFFFFFFu,
                    .ignore_body = 0,
                    .flags = TAHR_SWEEP_ONLY_BODY};
    (void)unused;
    open_stage(&r);
    assert_int_equal(tahr_world_sweep(r.world, &q, &hit, 1, &count), TAHR_OK);
    assert_int_equal(count, 1);
    assert_int_equal(hit.body, 0); /* through the platform, which is not asked */
    assert_near(hit.fraction, 0.475, 1e-6);
    q.ignore_body = 1;
    assert_int_equal(tahr_world_sweep(r.world, &q, &hit, 1, &count), TAHR_OK);
    assert_int_equal(hit.body, 1);
    q.ignore_body = 2;
    assert_int_equal(tahr_world_sweep(r.world, &q, &hit, 1, &count), TAHR_OK);
    assert_int_equal(count, 0);
    q.ignore_body = TAHR_NO_BODY;
    assert_int_equal(tahr_world_sweep(r.world, &q, &hit, 1, &count), TAHR_OK);
    assert_int_equal(count, 0);
    rig_close(&r);
}

static void a_motion_too_fast_for_a_state_leaves_it_valid(void **unused)
{
    rig r;
    (void)unused;
    open_stage(&r);
    rig_settle(&r);
    for (int n = 1; n <= 4; n++) { /* 1e6 m in a microsecond */
        tahr_pose pose = {{n % 2 * 1e6, 0, 0.5}, LEVEL};
        stage_step(&r, 1, pose, 1e-6);
        assert_true(isfinite(r.state.velocity.x + r.state.position.x));
    }
    r.input.jump = 1;
    stage_step(&r, 1, (tahr_pose){{1e6, 0, 0.5}, LEVEL}, 1e-6);
    stage_step(&r, 1, (tahr_pose){{0, 0, 0.5}, LEVEL}, 1e-6);
    assert_true(fabs(r.state.velocity.x) <= 1e5);
    rig_steps(&r, 10, 1.0 / 60);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(wrong_motions_are_refused_and_change_nothing),
                                       cmocka_unit_test(a_motion_is_told_until_the_next_one),
                                       cmocka_unit_test(half_a_turn_nearly_is_the_fastest_that_can_be_told),
                                       cmocka_unit_test(the_revision_is_one_of_poses_and_motions),
                                       cmocka_unit_test(a_rollback_repeats_every_bit),
                                       cmocka_unit_test(a_rollback_over_the_first_motion_repeats_every_bit),
                                       cmocka_unit_test(a_sweep_may_ask_one_body_alone),
                                       cmocka_unit_test(a_motion_too_fast_for_a_state_leaves_it_valid)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
