/* SPDX-License-Identifier: MIT
 * test_planar_wrong.c: what leaves the plane of a world of two dimensions is named before anything is asked, or does
 * not count; positions along z never do. The backend is native over deep boxes, told to say that it is planar, and
 * counts. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <tahr/native.h>
#ifdef TAHR_HAVE_BOX2D
#include <tahr/box2d.h>
#endif

#include "layers.h"

static int asked;

/* As backend.h wants it of a planar backend. */
static tahr_status in_plane(tahr_vec3 up, tahr_vec3 motion)
{
    asked++;
    return up.z != 0 || motion.z != 0 ? TAHR_E_UNSUPPORTED : TAHR_OK;
}

static tahr_status strict_sweep(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                                uint32_t capacity, uint32_t *count)
{
    tahr_status status = in_plane(query->up, query->motion);
    return status < 0 ? status : tahr_backend_v1_native()->sweep(self, context, query, hits, capacity, count);
}

static tahr_status strict_contacts(void *self, tahr_query_context *context, const tahr_contact_query *query,
                                   tahr_contact *contacts, uint32_t capacity, uint32_t *count)
{
    tahr_status status = in_plane(query->up, (tahr_vec3){0, 0, 0});
    return status < 0 ? status : tahr_backend_v1_native()->contacts(self, context, query, contacts, capacity, count);
}

static tahr_status strict_ray(void *self, tahr_query_context *context, const tahr_ray *ray, tahr_hit *hit,
                              uint32_t *count)
{
    tahr_status status = in_plane((tahr_vec3){0, 1, 0}, ray->motion);
    return status < 0 ? status : tahr_backend_v1_native()->ray(self, context, ray, hit, count);
}

static const tahr_backend *strict_backend(void)
{
    static tahr_backend b;
    b = *tahr_backend_v1_native();
    b.capabilities |= TAHR_CAP_PLANAR;
    b.name = "strict";
    b.sweep = strict_sweep;
    b.contacts = strict_contacts;
    b.ray = strict_ray;
    return &b;
}

enum { GROUND, LIFT, ROUND, POOL, BODIES };

/* A ground, a lift at x = 5, a ball that may be rolled at x = 12, water at x = -8; all 10 m deep to both sides. */
static void open_yard(rig *r, const tahr_backend *backend, uint32_t shape)
{
    tahr_body_desc b[BODIES];
    tahr_config c;
    memset(b, 0, sizeof b);
    for (int i = 0; i < BODIES; i++) {
        tahr_body_desc_init(&b[i], sizeof b[i], i == ROUND ? TAHR_BODY_SPHERE : TAHR_BODY_BOX);
    }
    b[GROUND].half_extents = (tahr_vec3){20, 1, 10};
    b[GROUND].pose.position.y = -1;
    b[LIFT].half_extents = (tahr_vec3){1, 0.1, 10};
    b[LIFT].pose.position = (tahr_vec3){5, 0.2, 0};
    b[LIFT].flags = TAHR_BODY_MOVABLE;
    b[ROUND].radius = 1;
    b[ROUND].pose.position = (tahr_vec3){12, 1, 0};
    b[ROUND].flags = TAHR_BODY_MOVABLE;
    b[POOL].half_extents = (tahr_vec3){1, 1, 10};
    b[POOL].pose.position = (tahr_vec3){-8, 1, 0};
    b[POOL].flags = TAHR_BODY_FLUID;
    tahr_config_init(&c, sizeof c, TAHR_PRESET_PLATFORMER);
    if (shape == TAHR_SHAPE_BOX) {
        c.shape = (tahr_shape){.type = TAHR_SHAPE_BOX, .half_height = 0.9, .half_x = 0.3, .half_y = 0.1};
    }
    rig_open_bodies_on(r, backend, b, BODIES, &c, (tahr_vec3){0, 0.95, 0});
    rig_settle(r);
    r->log.text[0] = 0;
    asked = 0;
}

static const tahr_vec3 OUT = {0, 0, 1}, SLANTED = {0, 0.8, 0.6};

static void up(tahr_state *s)
{
    s->up = OUT;
    s->orientation = (tahr_quat){0, 0, 0, 1};
}

static void up_a_little(tahr_state *s)
{
    s->up.z = 1e-10;
}

static void floor_normal(tahr_state *s)
{
    s->floor.normal = SLANTED;
}

static void surface_normal(tahr_state *s)
{
    s->floor.surface_normal = SLANTED;
}

/* Looks for its edge where it hangs. */
static void hanging(tahr_state *s)
{
    s->mode = TAHR_MODE_HANGING;
    s->floor = (tahr_floor){.normal = OUT, .body = GROUND};
}

static void wall(tahr_state *s)
{
    s->wall_normal = OUT;
}

static void base(tahr_state *s)
{
    s->base.velocity.z = 1;
}

static void a_state_that_leaves_the_plane_is_named_before_anything_is_asked(void **unused)
{
    (void)unused;
    const struct {
        void (*spoil)(tahr_state *);
        const char *field;
    } cases[] = {{up, "state.up"},
                 {up_a_little, "state.up"},
                 {floor_normal, "state.floor.normal"},
                 {surface_normal, "state.floor.surface_normal"},
                 {hanging, "state.floor.normal"},
                 {wall, "state.wall_normal"},
                 {base, "state.base.velocity"}};
    for (size_t i = 0; i < 2 * sizeof cases / sizeof cases[0]; i++) {
        rig r;
        char said[80];
        open_yard(&r, strict_backend(), i % 2 ? TAHR_SHAPE_CAPSULE : TAHR_SHAPE_BOX);
        cases[i / 2].spoil(&r.state);
        r.input.move = (tahr_vec3){1, 0, 0};
        const tahr_state before = r.state;
        const tahr_report report = r.report;
        assert_int_equal(tahr_mover_step(r.mover, &r.input, 0.1, &r.state, &r.report), TAHR_E_ARGUMENT);
        snprintf(said, sizeof said, "%s must have no z", cases[i / 2].field);
        assert_non_null(strstr(r.log.text, said));
        assert_memory_equal(&r.state, &before, sizeof before);
        assert_memory_equal(&r.report, &report, sizeof report);
        assert_int_equal(asked, 0);
        rig_close(&r);
    }
}

static void direct_questions_that_leave_the_plane_are_named(void **unused)
{
    (void)unused;
    rig r;
    tahr_hit hit;
    tahr_contact contact;
    tahr_fluid fluid;
    uint32_t count = 99;
    open_yard(&r, strict_backend(), TAHR_SHAPE_CAPSULE);
    tahr_sweep sweep = {.shape = r.config.shape, .position = {0, 2, 0}, .up = {0, 1, 0}, .motion = {0, -3, 1e-12}};
    sweep.orientation = r.state.orientation;
    sweep.mask = 0xFFFFFFFFu;
    sweep.ignore_body = TAHR_NO_BODY;
    assert_int_equal(tahr_world_sweep(r.world, &sweep, &hit, 1, &count), TAHR_E_ARGUMENT);
    assert_non_null(strstr(r.log.text, "tahr_world_sweep: motion must have no z"));
    sweep.motion.z = 0;
    sweep.up = OUT;
    assert_int_equal(tahr_world_sweep(r.world, &sweep, &hit, 1, &count), TAHR_E_ARGUMENT);
    assert_non_null(strstr(r.log.text, "tahr_world_sweep: up must have no z"));
    tahr_contact_query near = {.shape = r.config.shape, .up = OUT, .orientation = {0, 0, 0, 1}, .mask = 0xFFFFFFFFu};
    assert_int_equal(tahr_world_contacts(r.world, &near, &contact, 1, &count), TAHR_E_ARGUMENT);
    assert_non_null(strstr(r.log.text, "tahr_world_contacts: up must have no z"));
    const tahr_ray ray = {{0, 2, 0}, {0, -3, 1}, 0xFFFFFFFFu, TAHR_NO_BODY};
    assert_int_equal(tahr_world_ray(r.world, &ray, &hit, &count), TAHR_E_ARGUMENT);
    assert_non_null(strstr(r.log.text, "tahr_world_ray: motion must have no z"));
    const tahr_fluid_query wet = {.up = OUT, .radius = 0.3, .half_height = 0.9, .mask = 0xFFFFFFFFu};
    assert_int_equal(tahr_world_fluid(r.world, &wet, &fluid), TAHR_E_ARGUMENT);
    assert_non_null(strstr(r.log.text, "tahr_world_fluid: up must have no z"));
    assert_int_equal(asked, 0);
    assert_int_equal(count, 99);
    rig_close(&r);
}

/* Wherever it may be asked for, it is laid into the plane: nothing fails, nobody leaves. */
static void what_is_wished_out_of_the_plane_does_not_count(void **unused)
{
    (void)unused;
    for (int k = 0; k < 9; k++) {
        rig r[2]; /* the wish with a z, and without: they go the same way */
        for (int flat = 0; flat < 2; flat++) {
            const double z = flat ? 0 : 2;
            open_yard(&r[flat], strict_backend(), k % 2 ? TAHR_SHAPE_CAPSULE : TAHR_SHAPE_BOX);
            tahr_state *s = &r[flat].state;
            tahr_input *in = &r[flat].input;
            in->move.x = 0.5;
            if (k == 0) in->move.z = z / 4;
            if (k == 1) s->velocity.z = z;
            if (k == 2) in->launch = (tahr_vec3){1, 5, z}, in->flags = TAHR_INPUT_LAUNCH;
            if (k == 3) in->impulse = (tahr_vec3){90, 300, z}, in->flags = TAHR_INPUT_IMPULSE;
            if (k == 4) in->drive = (tahr_vec3){0, 1, z}, in->flags = TAHR_INPUT_DRIVE;
            if (k == 5) in->gravity = (tahr_vec3){0, -9, z}, in->flags = TAHR_INPUT_GRAVITY;
            if (k == 6) in->facing = (tahr_vec3){-1, 0, z}, in->flags = TAHR_INPUT_FACING;
            if (k == 7) in->move.z = z / 4, s->mode = TAHR_MODE_FLYING, s->velocity.z = z;
            if (k == 8) in->gravity = (tahr_vec3){0, 0, z}, in->flags = TAHR_INPUT_GRAVITY; /* then there is none */
            for (int i = 0; i < 40; i++) {
                rig_step(&r[flat], 1.0 / 60);
                assert_true(s->position.z == 0 && s->velocity.z == 0 && s->up.z == 0);
                in->flags &= ~(uint32_t)(TAHR_INPUT_LAUNCH | TAHR_INPUT_IMPULSE);
            }
        }
        assert_memory_equal(&r[0].state, &r[1].state, sizeof r[0].state);
        rig_close(&r[0]);
        rig_close(&r[1]);
    }
}

/* Settings are refused with the mover; a place along z is handed back, also after a teleport. */
static void places_along_z_come_back_as_they_were(void **unused)
{
    (void)unused;
    rig r;
    open_yard(&r, strict_backend(), TAHR_SHAPE_CAPSULE);
    const tahr_vec3 there = {1, 2, 1.0 / 3};
    assert_int_equal(tahr_state_teleport(&r.state, &there), TAHR_OK);
    rig_settle(&r);
    assert_true(r.state.position.z == 1.0 / 3);
    assert_near(r.state.position.x, 1, 1e-12);
    rig_close(&r);
}

static tahr_pose pose_at(double x, double y, double z)
{
    return (tahr_pose){{x, y, z}, {0, 0, 0, 1}};
}

/* It goes where the lift goes in the plane, however far that goes along z meanwhile; in the air too. */
static void lifts_that_move_along_z_carry_in_the_plane_only(void **unused)
{
    (void)unused;
    for (int in_air = 0; in_air < 2; in_air++) {
        rig r;
        open_yard(&r, strict_backend(), TAHR_SHAPE_CAPSULE);
        const tahr_vec3 onto = {5, 1.3, 0};
        assert_int_equal(tahr_state_teleport(&r.state, &onto), TAHR_OK);
        rig_settle(&r);
        const tahr_vec3 at = r.state.position;
        for (int i = 1; i <= 30; i++) {
            const tahr_body_pose p = {LIFT, 0, pose_at(5 + 0.02 * i, 0.2 + 0.01 * i, 0.1 * i)};
            assert_int_equal(tahr_world_move(r.world, &p, 1, 1.0 / 60), TAHR_OK);
            r.input.jump = in_air && i == 10;
            rig_step(&r, 1.0 / 60);
            assert_true(r.state.position.z == 0 && r.state.velocity.z == 0 && r.state.base.velocity.z == 0);
        }
        if (!in_air) {
            assert_near(r.state.position.x, at.x + 0.6, 1e-9);
            assert_near(r.state.position.y, at.y + 0.3, 1e-9);
        }
        assert_true(in_air == (r.state.mode == TAHR_MODE_FALLING));
        rig_close(&r);
    }
}

static void bodies_that_turn_out_of_the_plane_are_named_and_stay(void **unused)
{
    (void)unused;
    rig r;
    open_yard(&r, strict_backend(), TAHR_SHAPE_CAPSULE);
    for (uint32_t body = LIFT; body <= ROUND; body++) {
        tahr_body_pose p[2] = {{LIFT, 0, pose_at(6, 0.2, 0)}, {body, 0, pose_at(12, 1, 0)}};
        p[1].pose.orientation = (tahr_quat){0, 0.6, 0, 0.8};
        const uint64_t revision = tahr_world_revision(r.world);
        for (int set = 0; set < 2; set++) {
            r.log.text[0] = 0;
            assert_int_equal(set ? tahr_world_set(r.world, p, 2) : tahr_world_move(r.world, p, 2, 0.1),
                             TAHR_E_ARGUMENT);
            assert_non_null(strstr(r.log.text, "poses[1].pose.orientation turns out of the plane"));
            assert_true(tahr_world_revision(r.world) == revision);
        }
        p[1].pose.orientation = (tahr_quat){0, 0, 0.6, 0.8};
        assert_int_equal(tahr_world_move(r.world, p, 2, 0.1), TAHR_OK);
    }
    rig_close(&r);
}

/* What a mode of the caller's own does out of the plane. */
static tahr_status wander_off(void *user, tahr_step *step, double time, tahr_custom_next *next)
{
    const tahr_vec3 fast = {1, 0, 3}, way = {0.01, 0, 0.05}, down = {0, -2, 0.5};
    tahr_status *ray = user;
    tahr_hit hit;
    tahr_step_moved moved;
    assert_int_equal(tahr_step_set_velocity(step, &fast), TAHR_OK);
    assert_int_equal(tahr_step_sweep(step, &way, &hit), TAHR_OK);
    assert_int_equal(tahr_step_slide(step, &way, &moved), TAHR_OK);
    assert_true(moved.motion.z == 0);
    *ray = tahr_step_ray(step, &tahr_step_state(step)->position, &down, &hit);
    next->mode = TAHR_MODE_FALLING;
    next->time_left = 0.5 * time;
    return TAHR_OK;
}

static void own_modes_stay_in_the_plane(void **unused)
{
    (void)unused;
    rig r;
    tahr_status ray = TAHR_OK;
    open_yard(&r, strict_backend(), TAHR_SHAPE_CAPSULE);
    r.state.position.y += 1;
    tahr_mover_set_custom_mode(r.mover, wander_off, &ray);
    r.input.flags = TAHR_INPUT_MODE;
    r.input.mode = TAHR_MODE_CUSTOM;
    rig_step(&r, 1.0 / 60);
    assert_int_equal(ray, TAHR_E_ARGUMENT);
    assert_non_null(strstr(r.log.text, "tahr_step_ray: motion must have no z"));
    assert_true(r.state.position.z == 0 && r.state.velocity.z == 0);
    /* 0.01 m of its own, then half a step at 1 m/s */
    assert_near(r.state.position.x, 0.01 + 1.0 / 120, 1e-4);
    rig_close(&r);
}

/* Box2D has no z: a body that its user draws 50 m in front is in the way all the same. */
static void bodies_far_away_along_z_push_and_carry(void **unused)
{
    (void)unused;
#ifdef TAHR_HAVE_BOX2D
    rig r;
    const tahr_vec3 onto = {5, 1.3, 0};
    open_yard(&r, tahr_backend_v1_box2d(), TAHR_SHAPE_CAPSULE);
    for (int i = 0; i <= 100; i++) {
        const tahr_body_pose p = {ROUND, 0, pose_at(12 - 0.115 * i, 1, 50)};
        assert_int_equal(tahr_world_move(r.world, &p, 1, 1.0 / 60), TAHR_OK);
        rig_step(&r, 1.0 / 60);
    }
    /* The ball's centre has come to x = 0.5, as high as the capsule's waist, 1 m from its face. */
    assert_near(r.state.position.x, 0.5 - 1 - r.config.shape.radius - r.config.skin, 2e-3);
    assert_int_equal(tahr_state_teleport(&r.state, &onto), TAHR_OK);
    rig_settle(&r);
    for (int i = 1; i <= 10; i++) {
        const tahr_body_pose p = {LIFT, 0, pose_at(5 + 0.01 * i, 0.2, -80)};
        assert_int_equal(tahr_world_move(r.world, &p, 1, 1.0 / 60), TAHR_OK);
        rig_step(&r, 1.0 / 60);
    }
    assert_near(r.state.position.x, 5.1, 1e-9);
    assert_true(r.state.position.z == 0);
    rig_close(&r);
#else
    printf("SKIP: unit_motion_planar_wrong: bodies_far_away_along_z_push_and_carry needs the box2d backend\n");
    skip();
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_state_that_leaves_the_plane_is_named_before_anything_is_asked),
        cmocka_unit_test(direct_questions_that_leave_the_plane_are_named),
        cmocka_unit_test(what_is_wished_out_of_the_plane_does_not_count),
        cmocka_unit_test(places_along_z_come_back_as_they_were),
        cmocka_unit_test(lifts_that_move_along_z_carry_in_the_plane_only),
        cmocka_unit_test(bodies_that_turn_out_of_the_plane_are_named_and_stay),
        cmocka_unit_test(own_modes_stay_in_the_plane),
        cmocka_unit_test(bodies_far_away_along_z_push_and_carry),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
