/* SPDX-License-Identifier: MIT
 * native_world.c: see native_world.h. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "native_world.h"

void native_open(fixture *f, const tahr_body_desc *bodies, uint32_t count, int with_cache)
{
    tahr_native_desc options = fixture_options();
    fixture_init(f);
    assert_int_equal(fixture_open(f, bodies, count, &options, with_cache), TAHR_OK);
}

void native_close(fixture *f)
{
    fixture_close(f);
    assert_int_equal(f->bytes, 0);
}

tahr_body_desc native_grid_body(native_grid *grid, uint32_t cells, double cell, double (*height)(double x, double y))
{
    assert_true(cells <= NATIVE_CELLS);
    fixture_grid(cells, cell, height, grid->vertices, grid->indices);
    return fixture_mesh(grid->vertices, (cells + 1) * (cells + 1), grid->indices, 2 * cells * cells);
}

tahr_body_desc native_box(tahr_vec3 at, tahr_vec3 half_extents)
{
    tahr_body_desc body = fixture_body(TAHR_BODY_BOX);
    body.pose.position = at;
    body.half_extents = half_extents;
    return body;
}

static double hills(double x, double y)
{
    return 0.2 * sin(x * 1.3) * cos(y * 0.9) + 0.1 * sin(3 * x);
}

void native_hills(native_grid *grid, tahr_body_desc bodies[NATIVE_HILLS])
{
    bodies[0] = native_grid_body(grid, NATIVE_CELLS, 0.5, hills);
    bodies[1] = native_box(v_make(4, 5, 0.6), v_make(1, 0.5, 0.7));
    bodies[1].pose.orientation = (tahr_quat){0, 0, 0.6, 0.8};
    bodies[2] = fixture_body(TAHR_BODY_SPHERE);
    bodies[2].radius = 0.8;
    bodies[2].pose.position = v_make(7, 6, 0.5);
    bodies[3] = fixture_body(TAHR_BODY_CAPSULE);
    bodies[3].radius = 0.4;
    bodies[3].half_height = 1.5;
    bodies[3].flags = TAHR_BODY_MOVABLE;
    bodies[3].pose.position = v_make(5, 8, 0.5);
    bodies[3].pose.orientation = (tahr_quat){0.6, 0, 0, 0.8};
    bodies[4] = bodies[1];
    bodies[4].flags = TAHR_BODY_MOVABLE;
    bodies[4].pose.position = v_make(8, 3, 0.4);
    bodies[5] = bodies[2];
    bodies[5].flags = TAHR_BODY_SENSOR;
    bodies[5].pose.position = v_make(6, 4, 0.3);
}

tahr_shape native_shape(int kind)
{
    if (kind == 0) return fixture_shape(TAHR_SHAPE_SPHERE, 0.3, 0.3);
    if (kind == 1) return fixture_shape(TAHR_SHAPE_CAPSULE, 0.3, 0.9);
    return fixture_shape(TAHR_SHAPE_BOX, 0.25, 0.6);
}
