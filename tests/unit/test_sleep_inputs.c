/* SPDX-License-Identifier: MIT
 * test_sleep_inputs.c: with all that an input may ask for, among bodies that move now and then, in water and on edges: a
 * mover that sleeps goes the same way as one that never does. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "stage.h"

enum { LIFT = 1, BELT, POOL, SENSOR, CRATE, WALL, BODIES };

static void open_room(rig *r, uint32_t preset, uint32_t sleep)
{
    tahr_config c;
    tahr_body_desc bodies[BODIES] = {stage_ground(),
                                     stage_box(fake_vec(0, 0, 0.1), fake_vec(2, 2, 0.1)),
                                     stage_box(fake_vec(6, 0, 0.1), fake_vec(2, 2, 0.1)),
                                     stage_box(fake_vec(0, 8, 2), fake_vec(5, 3, 2)),
                                     stage_box(fake_vec(-6, 0, 1), fake_vec(1, 1, 1)),
                                     stage_box(fake_vec(-6, -6, 0.5), fake_vec(0.5, 0.5, 0.5)),
                                     stage_box(fake_vec(4, -6, 1.2), fake_vec(2, 0.5, 1.2))};
    bodies[BELT].surface_velocity = fake_vec(-0.5, 0, 0);
    bodies[POOL].flags = TAHR_BODY_FLUID;
    bodies[SENSOR].flags |= TAHR_BODY_SENSOR;
    bodies[CRATE].mass = 20;
    assert_int_equal(tahr_config_init(&c, sizeof c, (int32_t)preset), TAHR_OK);
    c.sleep = sleep;
    c.coyote_time = c.jump_buffer = c.wall_coyote_time = c.lift_momentum = 0.1;
    c.wall_jump_speed = 4;
    c.wall_slide_speed = 2;
    c.air_jumps = 1;
    c.ledge_grab = 0.3;
    c.corner_correction = 0.1;
    rig_open_bodies(r, bodies, BODIES, &c, fake_vec(0, 0, 1.5));
}

/* Half of the time nothing; else one or several of all that can be asked for. */
static tahr_input next_input(oracle_random *dice)
{
    static const uint32_t modes[] = {TAHR_MODE_NONE, TAHR_MODE_WALKING, TAHR_MODE_FALLING, TAHR_MODE_SWIMMING,
                                     TAHR_MODE_FLYING};
    tahr_input in = {.struct_size = sizeof in};
    double what = oracle_uniform(dice, 0, 1);
    if (what < 0.5) {
        return in;
    }
    in.move = what < 0.9 ? dice_vec(dice, -1, 1) : in.move;
    in.jump = oracle_uniform(dice, 0, 1) < 0.3;
    in.crouch = oracle_uniform(dice, 0, 1) < 0.3;
    for (uint32_t flag = TAHR_INPUT_GRAVITY; flag <= TAHR_INPUT_DRIVE_LEVEL; flag <<= 1) {
        in.flags |= oracle_uniform(dice, 0, 1) < 0.12 ? flag : 0;
    }
    in.flags &= in.flags & TAHR_INPUT_LAUNCH ? ~0u : ~(uint32_t)(TAHR_INPUT_LAUNCH_LEVEL | TAHR_INPUT_LAUNCH_UP);
    in.flags &= in.flags & TAHR_INPUT_DRIVE ? ~0u : ~(uint32_t)(TAHR_INPUT_DRIVE_ADD | TAHR_INPUT_DRIVE_LEVEL);
    in.gravity = fake_vec(oracle_uniform(dice, 0, 1) < 0.5 ? 0 : 3, 0, -9);
    in.facing = dice_direction(dice);
    in.mode = modes[(int)oracle_uniform(dice, 0, 5) % 5];
    in.radius = oracle_uniform(dice, 0.2, 0.4);
    in.half_height = in.radius + oracle_uniform(dice, 0, 0.6);
    in.launch = in.drive = dice_vec(dice, -2, 2);
    in.impulse = dice_vec(dice, -50, 50);
    return in;
}

/* The lift and the sensor go somewhere else for a while, the crate jumps. */
static void move_bodies(rig *r, int n)
{
    const tahr_quat level = {0, 0, 0, 1};
    double up = n % 900 < 90 ? n % 900 / 90.0 : 1;
    tahr_body_pose poses[3] = {{LIFT, 0, {{0, 0, 0.1 + up}, level}},
                               {SENSOR, 0, {{-6 + 5 * up, 0, 1}, level}},
                               {CRATE, TAHR_POSE_TELEPORT, {{-6 + n % 1800 / 900, -6, 0.5}, level}}};
    if (n % 900 <= 91) {
        assert_int_equal(tahr_world_move(r->world, poses, n % 900 ? 2 : 3, 1.0 / 60), TAHR_OK);
    } else if (n % 900 == 600) {
        poses[0].pose.position.z = 0.1;
        assert_int_equal(tahr_world_set(r->world, poses, 1), TAHR_OK);
    }
}

/* Without a trace: with one every step is computed. */
static void step(rig *r)
{
    r->report = (tahr_report){.struct_size = sizeof r->report, .events = r->events, .event_capacity = RIG_EVENTS};
    r->status = tahr_mover_step(r->mover, &r->input, 1.0 / 60, &r->state, &r->report);
    if (r->status < 0) {
        fail_msg("%s: %s", tahr_status_name(r->status), r->log.text);
    }
}

static void asleep_and_awake_go_the_same_way(uint32_t preset, uint64_t seed)
{
    enum { STEPS = 9000 };
    oracle_random dice = {seed};
    rig on, off;
    int asleep = 0, left = 0, modes[TAHR_MODE_CUSTOM + 1] = {0};
    open_room(&on, preset, 1);
    open_room(&off, preset, 0);
    for (int n = 0; n < STEPS; n++) {
        if (left-- == 0) {
            left = (int)oracle_uniform(&dice, 1, 120);
            on.input = off.input = next_input(&dice);
        }
        if (n % 600 == 0) { /* back to where there is something to do */
            on.state.position = off.state.position = fake_vec(n / 600 % 3 * 3, n / 600 % 2 * 8, 4);
            on.state.mode = off.state.mode = TAHR_MODE_FALLING;
        }
        move_bodies(&on, n);
        move_bodies(&off, n);
        step(&on);
        step(&off);
        if (memcmp(&on.state, &off.state, sizeof on.state) != 0) {
            fail_msg("seed %d, step %d: the states differ", (int)seed, n);
        }
        assert_int_equal(on.status, off.status);
        assert_int_equal(on.report.flags & ~(uint32_t)TAHR_REPORT_ASLEEP, off.report.flags);
        assert_int_equal(on.report.event_count, off.report.event_count);
        assert_memory_equal(on.events, off.events, on.report.event_count * sizeof on.events[0]);
        asleep += (on.report.flags & TAHR_REPORT_ASLEEP) != 0;
        modes[on.state.mode]++;
    }
    print_message("    %d of %d steps asleep\n", asleep, STEPS);
    assert_true(asleep > STEPS / 20); /* and it was worth it */
    assert_true(modes[TAHR_MODE_WALKING] && modes[TAHR_MODE_FALLING] && modes[TAHR_MODE_SWIMMING]);
    rig_close(&on);
    rig_close(&off);
}

static void whatever_is_asked_for_a_sleeper_goes_the_same_way(void **unused)
{
    (void)unused;
    for (uint64_t seed = 1; seed <= 3; seed++) {
        asleep_and_awake_go_the_same_way(TAHR_PRESET_PRECISE, seed);
        asleep_and_awake_go_the_same_way(TAHR_PRESET_UNREAL, seed + 10);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(whatever_is_asked_for_a_sleeper_goes_the_same_way)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
