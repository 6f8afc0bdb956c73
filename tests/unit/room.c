/* SPDX-License-Identifier: MIT
 * room.c: see room.h. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "room.h"

enum { LIFT = 1, BELT, POOL, SENSOR, CRATE, WALL, BODIES };
enum { CYCLE = 900, MOVING = 90, BACK = 600 }; /* steps */

void room_open(rig *r, uint32_t preset, uint32_t sleep)
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

tahr_input room_input(oracle_random *dice)
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

static void poses_after(int n, tahr_body_pose poses[3])
{
    const tahr_quat level = {0, 0, 0, 1};
    int k = n % CYCLE;
    double part = k < MOVING ? (double)k / MOVING : 1, up = k < BACK ? part : 0;
    poses[0] = (tahr_body_pose){LIFT, 0, {{0, 0, 0.1 + up}, level}};
    poses[1] = (tahr_body_pose){SENSOR, 0, {{-6 + 5 * part, 0, 1}, level}};
    poses[2] = (tahr_body_pose){CRATE, 0, {{-6 + n / CYCLE % 2, -6, 0.5}, level}};
}

void room_move(rig *r, int n)
{
    tahr_body_pose poses[3];
    poses_after(n, poses);
    poses[2].flags = TAHR_POSE_TELEPORT;
    if (n % CYCLE <= MOVING + 1) { /* the last one brings them to rest */
        assert_int_equal(tahr_world_move(r->world, poses, n % CYCLE ? 2 : 3, 1.0 / 60), TAHR_OK);
    } else if (n % CYCLE == BACK) {
        assert_int_equal(tahr_world_set(r->world, poses, 1), TAHR_OK);
    }
}

void room_put(rig *r, int n)
{
    tahr_body_pose poses[3];
    poses_after(n, poses);
    assert_int_equal(tahr_world_set(r->world, poses, 3), TAHR_OK);
}

void room_carry(rig *r, int n)
{
    if (n % 600 == 0) {
        r->state.position = fake_vec(n / 600 % 3 * 3, n / 600 % 2 * 8, 4);
        r->state.mode = TAHR_MODE_FALLING;
    }
}

void room_step(rig *r)
{
    r->report = (tahr_report){.struct_size = sizeof r->report, .events = r->events, .event_capacity = RIG_EVENTS};
    r->status = tahr_mover_step(r->mover, &r->input, 1.0 / 60, &r->state, &r->report);
    if (r->status < 0) {
        fail_msg("%s: %s", tahr_status_name(r->status), r->log.text);
    }
}
