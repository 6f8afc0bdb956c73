/* SPDX-License-Identifier: MIT
 * test_planar.c: worlds of two dimensions: who may enter, what they may answer, and that nobody leaves the plane. The
 * backend is native over extruded outlines, told to say that it is planar. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <tahr/native.h>

#include "dice.h"
#include "layers.h"

/* The lie of the backend: 1 normals, 2 surface normals leave the plane by so much. */
static int lie;
static const double TILT = 1e-9;

static void flatten(tahr_vec3 *normal, tahr_vec3 *surface_normal)
{
    normal->z = lie == 1 ? TILT : 0;
    surface_normal->z = lie == 2 ? TILT : 0;
}

static tahr_status flat_sweep(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                              uint32_t capacity, uint32_t *count)
{
    tahr_status status = tahr_backend_v1_native()->sweep(self, context, query, hits, capacity, count);
    for (uint32_t i = 0; i < *count; i++) {
        flatten(&hits[i].normal, &hits[i].surface_normal);
    }
    return status;
}

static tahr_status flat_contacts(void *self, tahr_query_context *context, const tahr_contact_query *query,
                                 tahr_contact *contacts, uint32_t capacity, uint32_t *count)
{
    tahr_status status = tahr_backend_v1_native()->contacts(self, context, query, contacts, capacity, count);
    for (uint32_t i = 0; i < *count; i++) {
        flatten(&contacts[i].normal, &contacts[i].surface_normal);
    }
    return status;
}

static tahr_status flat_ray(void *self, tahr_query_context *context, const tahr_ray *ray, tahr_hit *hit,
                            uint32_t *count)
{
    tahr_status status = tahr_backend_v1_native()->ray(self, context, ray, hit, count);
    if (*count) {
        flatten(&hit->normal, &hit->surface_normal);
    }
    return status;
}

static tahr_backend flat_backend(void)
{
    tahr_backend b = *tahr_backend_v1_native();
    b.capabilities |= TAHR_CAP_PLANAR;
    b.name = "flat";
    b.sweep = flat_sweep;
    b.contacts = flat_contacts;
    b.ray = flat_ray;
    return b;
}

/* A ground, a slope, a wall, one-way platforms. */
static void open_flat(layers *l, rig *r, const tahr_backend *backend, const tahr_config *config)
{
    lie = 0;
    layers_begin(l, 1);
    l->backend = backend;
    layers_add(l, LAYER_BOX, -10, 10, 0, 0);
    layers_add(l, LAYER_BOX, 8, 10, 6, 0);
    layers_add(l, LAYER_BLOCKS, -10, -9, 3, 0);
    layers_add(l, LAYER_TILES, -4, 2, 1.5, TAHR_BODY_ONE_WAY);
    layers_slope(l, (tahr_vec3){3, 0, 0}, (tahr_vec3){6, 2, 0}, 0);
    layers_open(l, r, config, 0, 0.3);
}

static void movers_that_leave_the_plane_are_refused(void **unused)
{
    (void)unused;
    static layers l;
    rig r;
    tahr_backend backend = flat_backend();
    open_flat(&l, &r, &backend, NULL);
    const struct {
        tahr_vec3 plane, gravity;
        const char *field;
    } cases[] = {{{0, 0, 0}, {0, -9.81, 0}, "plane"},
                 {{0, 1, 0}, {0, 0, 0}, "plane"},
                 {{0, 0.6, 0.8}, {0, -9.81, 0}, "plane"},
                 {{0, 0, 1}, {0, -9.81, 0.1}, "gravity"},
                 {{0, 0, -1}, {0, 0, -9.81}, "gravity"},
                 {{0, 0, 1}, {0, -9.81, 0}, NULL},
                 {{0, 0, -1}, {3, 5, 0}, NULL}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        tahr_mover *mover = NULL;
        tahr_config c = r.config;
        c.plane = cases[i].plane;
        c.gravity = cases[i].gravity;
        r.log.text[0] = 0;
        tahr_status status = tahr_mover_create(r.world, &c, &mover);
        if (cases[i].field) {
            assert_int_equal(status, TAHR_E_UNSUPPORTED);
            assert_null(mover);
            assert_non_null(strstr(r.log.text, cases[i].field));
        } else {
            assert_int_equal(status, TAHR_OK);
            tahr_mover_destroy(mover);
        }
    }
    rig_close(&r);
}

/* By a billionth already: planar backends have no third component to round. */
static void normals_out_of_the_plane_are_named(void **unused)
{
    (void)unused;
    static layers l;
    rig r;
    tahr_backend backend = flat_backend();
    open_flat(&l, &r, &backend, NULL);
    rig_settle(&r);
    for (lie = 1; lie <= 2; lie++) {
        const char *field = lie == 1 ? " normal.z" : "surface_normal.z";
        tahr_state before = r.state, state = r.state;
        r.input.move = (tahr_vec3){1, 0, 0};
        r.log.text[0] = 0;
        assert_int_equal(tahr_mover_step(r.mover, &r.input, 0.1, &state, NULL), TAHR_E_BACKEND);
        assert_memory_equal(&state, &before, sizeof state);
        assert_non_null(strstr(r.log.text, field));

        tahr_contact contacts[8];
        tahr_hit hit;
        uint32_t count;
        tahr_contact_query near = {.shape = r.config.shape,
                                   .position = state.position,
                                   .up = state.up,
                                   .orientation = state.orientation,
                                   .margin = 0.1,
                                   .mask = 0xFFFFFFFFu,
                                   .ignore_body = TAHR_NO_BODY};
        r.log.text[0] = 0;
        assert_int_equal(tahr_world_contacts(r.world, &near, contacts, 8, &count), TAHR_E_BACKEND);
        assert_non_null(strstr(r.log.text, field));
        tahr_ray ray = {state.position, {0, -5, 0}, 0xFFFFFFFFu, TAHR_NO_BODY};
        r.log.text[0] = 0;
        assert_int_equal(tahr_world_ray(r.world, &ray, &hit, &count), TAHR_E_BACKEND);
        assert_non_null(strstr(r.log.text, field));
    }
    lie = 0;
    rig_close(&r);
}

/* Whatever is asked for, also out of the plane: z keeps its bits, and the frame of the shape stays in the plane. */
static void nobody_leaves_the_plane(void **unused)
{
    (void)unused;
    tahr_backend backend = flat_backend();
    for (int k = 0; k < 3; k++) {
        static layers l;
        rig r;
        oracle_random dice = {91};
        tahr_config c;
        tahr_config_init(&c, sizeof c, TAHR_PRESET_PLATFORMER);
        c.ledge_grab = 0.3;
        c.air_jumps = 1;
        if (k == 1) {
            c.shape = (tahr_shape){.type = TAHR_SHAPE_BOX, .half_height = 0.9, .half_x = 0.3, .half_y = 0.1};
        } else if (k == 2) {
            c.shape = (tahr_shape){.type = TAHR_SHAPE_SPHERE, .radius = 0.4, .half_height = 0.4};
        }
        open_flat(&l, &r, &backend, &c);
        r.state.position.z = 1.0 / 3;
        for (int i = 0; i < 4000; i++) {
            if (oracle_below(&dice, 10) == 0) {
                memset(&r.input, 0, sizeof r.input);
                r.input.struct_size = sizeof r.input;
                r.input.move = dice_vec(&dice, -1, 1);
                r.input.facing = dice_vec(&dice, -1, 1);
                r.input.launch = dice_vec(&dice, -4, 4);
                r.input.jump = oracle_below(&dice, 2);
                r.input.crouch = k < 2 && oracle_below(&dice, 4) == 0;
                r.input.flags = TAHR_INPUT_FACING | (oracle_below(&dice, 4) ? 0u : (uint32_t)TAHR_INPUT_DROP) |
                                (oracle_below(&dice, 20) ? 0u : (uint32_t)TAHR_INPUT_LAUNCH);
            }
            rig_step(&r, oracle_uniform(&dice, 0.001, 0.05));
            r.input.flags &= ~(uint32_t)TAHR_INPUT_LAUNCH;
            assert_true(r.state.position.z == 1.0 / 3 && r.state.velocity.z == 0 && r.state.up.z == 0);
            tahr_quat q = r.state.orientation;
            double x_out = 2 * (q.x * q.z - q.w * q.y); /* z of where local x points */
            assert_true(fabs(x_out) < 1e-14);
        }
        rig_close(&r);
    }
}

/* Facing the other way is at once, and a box keeps the width that it has in the plane: 0.4 m, in a shaft of 0.5 m.
 * Gravity upside down too. */
static void a_box_never_turns_through_the_third_dimension(void **unused)
{
    (void)unused;
    static layers l;
    rig r;
    layers_begin(&l, 1);
    layers_add(&l, LAYER_BOX, -5, 5, 0, 0);
    for (int side = -1; side <= 1; side += 2) {
        tahr_body_desc *b = &l.bodies[l.count++];
        tahr_body_desc_init(b, sizeof *b, TAHR_BODY_BOX);
        b->pose.position = (tahr_vec3){side * 1.25, 5, 0};
        b->half_extents = (tahr_vec3){1, 5, 5};
    }
    tahr_config c = layers_config(&l, TAHR_PRESET_PLATFORMER);
    c.shape = (tahr_shape){.type = TAHR_SHAPE_BOX, .half_height = 0.9, .half_x = 0.2, .half_y = 0.8};
    layers_open(&l, &r, &c, 0, 0.02);
    rig_settle(&r);
    for (int i = 0; i < 12; i++) {
        double side = i % 2 ? 1 : -1;
        r.input.flags = TAHR_INPUT_FACING | (i >= 6 ? (uint32_t)TAHR_INPUT_GRAVITY : 0u);
        r.input.gravity = (tahr_vec3){0, 9.81, 0};
        r.input.facing = (tahr_vec3){side, 0.5, 0.3};
        rig_step(&r, 1.0 / 60);
        tahr_quat q = r.state.orientation;
        assert_near(1 - 2 * (q.y * q.y + q.z * q.z), side, 1e-12); /* x of where local x points */
        assert_near(layers_x(&l, r.state.position), 0, 1e-12);
        assert_null(rig_event(&r, TAHR_EVENT_DEPENETRATED));
        assert_int_equal(r.report.flags & (TAHR_REPORT_UP_REFUSED | TAHR_REPORT_CRUSHED), 0);
    }
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(movers_that_leave_the_plane_are_refused),
        cmocka_unit_test(normals_out_of_the_plane_are_named),
        cmocka_unit_test(nobody_leaves_the_plane),
        cmocka_unit_test(a_box_never_turns_through_the_third_dimension),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
