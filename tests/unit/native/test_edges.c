/* SPDX-License-Identifier: MIT
 * test_edges.c: the native backend's edges: those inside a surface are never felt, real ones say which face they
 * are. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "native_world.h"
#include "rig.h"

static double ridge_rise;

static double ridge(double x, double y)
{
    (void)y;
    return x < 2 ? 0 : (x - 2) * ridge_rise;
}

static double slope(double x, double y)
{
    return 0.37 * x + 0.21 * y;
}

/* Walks a plane that is made of triangles, projecting each motion on the plane: never blocked, never closer. */
static void walk_plane(double (*height)(double, double), tahr_vec3 normal)
{
    fixture f;
    static native_grid grid;
    tahr_body_desc body = native_grid_body(&grid, 8, 0.5, height);
    body.pose.position = v_make(100.0 / 3, -7.0 / 3, 0.1);
    native_open(&f, &body, 1, 1);
    normal = v_unit(normal);
    tahr_shape shape = fixture_shape(TAHR_SHAPE_CAPSULE, 0.3, 0.9);
    oracle_random r = {4};
    tahr_vec3 o = body.pose.position, p = v_make(o.x + 2, o.y + 2, o.z + 4);
    fixture_announce(&f, p, 5);
    tahr_sweep q = fixture_sweep(shape, p, v_make(0, 0, -4), 0.01);
    tahr_hit h = fixture_hit(&f, &q);
    assert_int_equal(h.blocking, 1);
    p.z -= 4 * h.fraction;
    for (int n = 0; n < 100000; n++) {
        tahr_vec3 m = dice_vec(&r, -0.1, 0.1);
        if (fabs(p.x - o.x - 2) > 0.9) m.x = (p.x > o.x + 2 ? -1 : 1) * fabs(m.x);
        if (fabs(p.y - o.y - 2) > 0.9) m.y = (p.y > o.y + 2 ? -1 : 1) * fabs(m.y);
        m = v_sub(m, v_scale(normal, v_dot(m, normal)));
        if (n % 4 == 0) fixture_announce(&f, p, 2);
        q.position = p;
        q.motion = m;
        h = fixture_hit(&f, &q);
        if (h.blocking) fail_msg("step %d blocked at %g, normal %g %g", n, h.fraction, h.normal.x, h.normal.y);
        p = v_add(p, m);
    }
    double foot = p.z - 0.6 - o.z;
    double clearance = normal.z * foot + normal.x * (p.x - o.x) + normal.y * (p.y - o.y) - 0.3;
    assert_true(fabs(clearance - 0.01) < 1e-9);
    native_close(&f);
}

static void a_walker_neither_sticks_nor_creeps(void **state)
{
    (void)state;
    walk_plane(NULL, v_make(0, 0, 1));
    walk_plane(slope, v_make(-0.37, -0.21, 1));
}

/* Over points of edges and corners, where the nearest point is on the edge of two triangles or more: rounding must not
 * make a bump of what is flat. */
static void edges_of_a_flat_surface_are_not_felt(void **state)
{
    (void)state;
    const tahr_vec3 normal = v_unit(v_make(-0.37, -0.21, 1));
    fixture f;
    static native_grid grid;
    oracle_random r = {6};
    tahr_body_desc body = native_grid_body(&grid, 8, 0.5, slope);
    body.pose.position = v_make(100.0 / 3, -7.0 / 3, 0.1);
    native_open(&f, &body, 1, 0);
    for (int n = 0; n < 3000; n++) {
        double x = 0.5 * (2 + oracle_below(&r, 5)), y = 0.5 * (2 + oracle_below(&r, 5)), t = oracle_uniform(&r, 0, 0.5);
        if (n % 4 == 1) x += t;         /* an edge along x */
        if (n % 4 == 2) y += t;         /* along y */
        if (n % 4 == 3) x += t, y += t; /* a diagonal */
        tahr_vec3 foot = v_add(body.pose.position, v_make(x, y, slope(x, y)));
        tahr_vec3 at = v_mad(foot, normal, 0.3 + (n % 3 ? 0.01 : 0.0099));
        tahr_vec3 m = dice_vec(&r, -0.1, 0.1);
        m = v_sub(m, v_scale(normal, v_dot(m, normal)));
        tahr_sweep q = fixture_sweep(fixture_shape(TAHR_SHAPE_SPHERE, 0.3, 0.3), at, m, 0.01);
        tahr_hit h = fixture_hit(&f, &q);
        if (h.blocking) fail_msg("sweep %d blocked at %g", n, h.fraction);
    }
    native_close(&f);
}

/* A gentle ramp is near with the edge that it shares with the floor before it is with its face. */
static void meet_ramp(double rise)
{
    fixture f;
    static native_grid grid;
    ridge_rise = rise;
    tahr_body_desc body = native_grid_body(&grid, 8, 0.5, ridge);
    native_open(&f, &body, 1, 0);
    tahr_shape shape = fixture_shape(TAHR_SHAPE_CAPSULE, 0.3, 0.9);
    double s = sqrt(1 + rise * rise);
    for (int n = 0; n < 200; n++) {
        double gap = 0.01 * (n + 1) / 200.0, y = 1.7 + n * 0.003;
        tahr_sweep q = fixture_sweep(shape, v_make(1, y, 0.9 + gap), v_make(1.5, 0, 0), 0.01);
        tahr_hit h = fixture_hit(&f, &q);
        assert_int_equal(h.blocking, 1);
        double x = 1 + 1.5 * h.fraction - 2, z = 0.3 + gap;
        double clearance = (-rise * x + z) / s - 0.3;
        /* Where the ramp's face is as near as the margin asks, or, if the floor is nearer still, where it is that
         * near. */
        assert_true(clearance <= 0.01 + 1e-9 && clearance >= gap - 1e-8);
        assert_true(fabs(h.normal.x + rise / s) < 1e-6 && fabs(h.surface_normal.x + rise / s) < 1e-6);
    }
    native_close(&f);
}

static void a_ramp_is_met_when_standing_closer_than_the_margin(void **state)
{
    (void)state;
    meet_ramp(0.5);
    meet_ramp(0.1);
    meet_ramp(0.02);
}

static void edges_report_the_face_that_opposes(void **state)
{
    (void)state;
    fixture f;
    tahr_body_desc body = native_box(v_make(0, 0, 0), v_make(1, 1, 0.5));
    native_open(&f, &body, 1, 0);
    /* The lower cap meets the upper edge of the box from the side: riser; from above: tread. */
    tahr_sweep q = fixture_sweep(fixture_shape(TAHR_SHAPE_CAPSULE, 0.3, 0.9), v_make(-3, 0, 1.3), v_make(3, 0, 0), 0.0);
    tahr_hit h = fixture_hit(&f, &q);
    assert_true(h.blocking && h.normal.x < -0.5 && h.normal.z > 0.5);
    assert_true(h.surface_normal.x == -1 && h.surface_normal.z == 0);
    q.position = v_make(-1.1, 0, 3);
    q.motion = v_make(0, 0, -3);
    h = fixture_hit(&f, &q);
    assert_true(h.blocking && h.normal.x < 0 && h.surface_normal.z == 1);
    assert_true(h.feature == 5 || h.feature == 0);
    native_close(&f);
}

/* Two tables whose edges are exactly a character and its skin on either side apart, and a character whose lower sphere
 * has its centre `up` above them, somewhere in the room that is left there (up * up / 0.36 m), pushing to the side. The
 * normals of both edges lean by up / 0.36: no motion is along both, and yet nothing is in the way down. */
static void who_is_as_wide_as_a_gap_falls_through_it(void **unused)
{
    static const double pushes[] = {0, 1, -0.01}, rates[] = {60, 240};
    const double half_width = 0.35 + 0.01;
    tahr_body_desc tables[2] = {native_box(v_make(0, 1.16, -5), v_make(5, 0.8, 5)),
                                native_box(v_make(0, -1.16, -5), v_make(5, 0.8, 5))};
    (void)unused;
    for (int n = 0; n < 49 * 5 * 3 * 2; n++) {
        double up = 1e-9 * pow(10, n % 49 / 6.0), side = 0.25 * (n / 49 % 5 - 2) * up * up / half_width;
        double rate = rates[n / (49 * 15)], start = up + 0.55;
        rig r;
        rig_open_bodies(&r, tables, 2, NULL, v_make(0.3, side, start));
        r.input.move = v_make(-0.04, pushes[n / (49 * 5) % 3], 0);
        for (int i = 0; i < rate; i++)
            rig_step(&r, 1 / rate);
        double fallen = start - r.state.position.z;
        if (!(fallen > 1)) fail_msg("from %g above, %g aside: fell %g m in a second", up, side, fallen);
        rig_close(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_walker_neither_sticks_nor_creeps),
        cmocka_unit_test(edges_of_a_flat_surface_are_not_felt),
        cmocka_unit_test(a_ramp_is_met_when_standing_closer_than_the_margin),
        cmocka_unit_test(edges_report_the_face_that_opposes),
        cmocka_unit_test(who_is_as_wide_as_a_gap_falls_through_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
