/* SPDX-License-Identifier: MIT
 * test_core_distance.c: exact distances of points, segments and boxes to triangles against brute force. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "common/core.h"
#include "oracle.h"

static tahr_vec3 to_vec(const double v[3])
{
    return v_make(v[0], v[1], v[2]);
}

static double coordinate(oracle_random *r, int lattice, double scale)
{
    double x = oracle_uniform(r, -scale, scale);
    return lattice ? floor(x * 2 / scale) * scale / 2 : x;
}

static void random_core(oracle_random *r, int kind, int lattice, oracle_core *core)
{
    core->axis_count = kind == 0 ? 0 : kind == 1 ? 1 : 3;
    for (int k = 0; k < 3; k++)
        core->centre[k] = coordinate(r, lattice, 2);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            core->axis[i][k] = 0;
        core->axis[i][kind == 1 ? 2 : i] = lattice ? 0.5 : oracle_uniform(r, 0.1, 1);
    }
    if (kind == 1 && !lattice) {
        for (int k = 0; k < 3; k++)
            core->axis[0][k] = oracle_uniform(r, -1, 1);
    }
}

static tahr__core to_core(const oracle_core *o)
{
    tahr__core core;
    core.axis_count = o->axis_count;
    for (int i = 0; i < 3; i++)
        core.axis[i] = to_vec(o->axis[i]);
    return core;
}

/* Whole families of random pairs; lattice ones coincide exactly in about half of all coordinates. */
static void compare(int kind, int lattice, double size, int trials, double tolerance)
{
    static const double still[3] = {0, 0, 0};
    oracle_random r = {(uint64_t)(kind * 10 + lattice) + (uint64_t)size};
    for (int n = 0; n < trials; n++) {
        oracle_core o;
        double tri[3][3];
        random_core(&r, kind, lattice, &o);
        for (int i = 0; i < 9; i++)
            tri[i / 3][i % 3] = coordinate(&r, lattice, size);
        if (n % 7 == 0) {
            for (int k = 0; k < 3; k++)
                tri[2][k] = tri[1][k]; /* a segment */
        }
        tahr__core core = to_core(&o);
        tahr_vec3 v[3] = {to_vec(tri[0]), to_vec(tri[1]), to_vec(tri[2])};
        tahr__witness w;
        tahr__core_distance(&core, to_vec(o.centre), v, &w);
        double truth = (double)oracle_distance(&o, still, 0, tri);
        if (fabs(w.distance - truth) > tolerance) {
            fail_msg("kind %d lattice %d size %g trial %d: %.17g, truth %.17g", kind, lattice, size, n, w.distance,
                     truth);
        }
        if (w.distance > 1e-6) {
            assert_true(fabs(v_length(w.normal) - 1) < 1e-9);
            /* The support of the core toward the point lies in the plane through the nearest core point. */
            double ahead = v_dot(w.normal, v_sub(to_vec(o.centre), w.point)) - tahr__core_extent(&core, w.normal);
            assert_true(fabs(ahead - w.distance) <= 1e-9 * (1 + size));
        }
    }
}

static void distance_is_exact(void **state)
{
    (void)state;
    for (int kind = 0; kind < 3; kind++) {
        for (int lattice = 0; lattice < 2; lattice++) {
            compare(kind, lattice, 2, kind == 2 ? 1500 : 6000, 1e-13);
            compare(kind, lattice, 1e4, kind == 2 ? 500 : 2000, 1e-10);
        }
    }
}

static void distance_to_slivers_is_exact(void **state)
{
    (void)state;
    oracle_random r = {5};
    for (int n = 0; n < 3000; n++) {
        oracle_core o;
        double tri[3][3];
        static const double still[3] = {0, 0, 0};
        random_core(&r, n % 3, 0, &o);
        for (int i = 0; i < 9; i++)
            tri[i / 3][i % 3] = coordinate(&r, 0, 2);
        double along = oracle_uniform(&r, 0, 1);
        for (int k = 0; k < 3; k++) {
            tri[2][k] = tri[0][k] + along * (tri[1][k] - tri[0][k]) + oracle_uniform(&r, -1e-6, 1e-6);
        }
        tahr__core core = to_core(&o);
        tahr_vec3 v[3] = {to_vec(tri[0]), to_vec(tri[1]), to_vec(tri[2])};
        tahr__witness w;
        tahr__core_distance(&core, to_vec(o.centre), v, &w);
        /* A sliver as thin as this is its edges; the oracle squares its condition and is good to 1e-9 there. */
        assert_true(fabs(w.distance - (double)oracle_distance(&o, still, 0, tri)) < 1e-8);
    }
}

static void way_out_of_a_triangle_is_out_and_shortest(void **state)
{
    (void)state;
    oracle_random r = {9};
    static const double still[3] = {0, 0, 0};
    int crossing = 0;
    for (int n = 0; n < 4000; n++) {
        oracle_core o;
        double tri[3][3];
        random_core(&r, 1 + n % 2, 0, &o);
        for (int k = 0; k < 3; k++)
            o.centre[k] *= 0.2;
        for (int i = 0; i < 9; i++)
            tri[i / 3][i % 3] = coordinate(&r, 0, 2);
        tahr__core core = to_core(&o);
        tahr_vec3 v[3] = {to_vec(tri[0]), to_vec(tri[1]), to_vec(tri[2])}, n_out;
        tahr__witness w;
        tahr__core_distance(&core, to_vec(o.centre), v, &w);
        if (w.distance > 0) continue;
        crossing++;
        double depth = tahr__core_leave_triangle(&core, to_vec(o.centre), v, 7, &n_out);
        oracle_core out = o, less = o;
        double moved[3] = {n_out.x * (depth + 1e-9), n_out.y * (depth + 1e-9), n_out.z * (depth + 1e-9)};
        for (int k = 0; k < 3; k++) {
            out.centre[k] += moved[k];
            less.centre[k] += moved[k] * 0.99;
        }
        assert_true(oracle_distance(&out, still, 0, tri) > 0);
        assert_true(oracle_distance(&less, still, 0, tri) < 1e-12L);
        /* No other direction is shorter. */
        for (int i = 0; i < 20; i++) {
            double x = oracle_uniform(&r, -1, 1), y = oracle_uniform(&r, -1, 1), z = oracle_uniform(&r, -1, 1);
            tahr_vec3 u = v_unit(v_make(x, y, z));
            oracle_core other = o;
            other.centre[0] += u.x * depth * 0.999;
            other.centre[1] += u.y * depth * 0.999;
            other.centre[2] += u.z * depth * 0.999;
            assert_true(oracle_distance(&other, still, 0, tri) < 1e-9L);
        }
    }
    assert_true(crossing > 300);
}

static void way_out_of_a_box_is_its_nearest_face(void **state)
{
    (void)state;
    tahr__core point = {0, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}}, box = {3, {{1, 0, 0}, {0, 2, 0}, {0, 0, 3}}},
               rod = {1, {{0, 0, 0.5}}};
    tahr_vec3 n;
    assert_true(fabs(tahr__core_leave_solid(&point, v_make(0.75, 0, 0), &box, v_make(0, 0, 0), &n) - 0.25) < 1e-15);
    assert_true(n.x == 1 && n.y == 0 && n.z == 0);
    assert_true(fabs(tahr__core_leave_solid(&rod, v_make(0, 0, -3.25), &box, v_make(0, 0, 0), &n) - 0.25) < 1e-15);
    assert_true(n.x == 0 && n.y == 0 && n.z == -1);
    assert_true(tahr__core_leave_solid(&rod, v_make(0, 0, -3.75), &box, v_make(0, 0, 0), &n) < 0);
}

/* Its side in the plane of the triangle's end, exactly and but for rounding: only the side keeps them apart. */
static void what_a_box_only_touches_is_met_by_what_keeps_them_apart(void **state)
{
    (void)state;
    tahr__core box = {3, {{0.35, 0, 0}, {0, 0.35, 0}, {0, 0, 0.9}}};
    tahr__facet f = {.v = {{0, -1, 0}, {0, 1, 0}, {-2, 0, 0}}};
    tahr__witness w = {0};
    tahr__facet_finish(&f);
    for (int k = -2; k <= 2; k++) {
        for (int i = -4; i <= 4; i++) {
            tahr_vec3 centre = v_make(0.35 + k * 5.6e-17, 0.01 * i, 0.2 * i);
            assert_int_equal(tahr__box_touches(&box, centre, &f, &w), 1);
            assert_true(w.normal.x == 1 && w.normal.y == 0 && w.normal.z == 0);
            assert_int_equal(w.feature, TAHR__EDGE);
            assert_true(fabs(w.point.x) < 1e-12 && fabs(w.point.z) < 1e-12);
            assert_true(fabs(w.point.y - centre.y) < 0.35 + 1e-12);
        }
        /* On its top as well: that comes first. */
        assert_int_equal(tahr__box_touches(&box, v_make(0.35 + k * 5.6e-17, 0, 0.9), &f, &w), 1);
        assert_true(w.normal.x == 0 && w.normal.y == 0 && w.normal.z == 1);
    }
    assert_int_equal(tahr__box_touches(&box, v_make(0.35 - 1e-10, 0, 0.2), &f, &w), 0);
    assert_int_equal(tahr__box_touches(&box, v_make(0.1, 0, -0.2), &f, &w), 0);
}

/* Upright triangles whose plane holds an upright segment, but for rounding: on which side of it the ends are says
 * nothing. */
static void a_segment_in_the_plane_of_a_triangle_is_as_far_as_it_is(void **state)
{
    static const double still[3] = {0, 0, 0};
    (void)state;
    oracle_random r = {8};
    int apart = 0;
    for (int n = 0; n < 20000; n++) {
        const double turn = oracle_uniform(&r, 0, 6.3), x = cos(turn), y = sin(turn);
        oracle_core o = {.axis_count = 1};
        double tri[3][3];
        for (int k = 0; k < 3; k++)
            o.centre[k] = oracle_uniform(&r, -2, 2);
        o.axis[0][2] = oracle_uniform(&r, 0.1, 1);
        for (int i = 0; i < 3; i++) {
            const double along = oracle_uniform(&r, -2, 2);
            tri[i][0] = o.centre[0] + along * x;
            tri[i][1] = o.centre[1] + along * y;
            tri[i][2] = oracle_uniform(&r, -4, 4);
        }
        tahr__core core = to_core(&o);
        tahr_vec3 v[3] = {to_vec(tri[0]), to_vec(tri[1]), to_vec(tri[2])};
        tahr__witness w;
        tahr__core_distance(&core, to_vec(o.centre), v, &w);
        const double truth = (double)oracle_distance(&o, still, 0, tri);
        assert_true(fabs(w.distance - truth) <= 1e-12);
        apart += truth > 0.01;
    }
    assert_true(apart > 5000);
}

/* Quarters, most of them exact, some off by rounding. */
static double nearly_quarter(oracle_random *r)
{
    const double x = floor(oracle_uniform(r, -4, 5)) / 4;
    return oracle_below(r, 3) ? x : x * (1 + oracle_uniform(r, -1e-15, 1e-15));
}

/* An upright segment and a triangle wholly below or above it, often in one plane, over each other, level, flat. Returns
 * 0 if it is neither. */
static int over_or_under(oracle_random *r, tahr__core *core, tahr_vec3 *centre, tahr__facet *f, tahr_vec3 *end)
{
    const double half = 0.25 * (1 + (double)oracle_below(r, 4));
    int below = 1, above = 1;
    core->axis_count = 1;
    core->axis[0] = v_make(0, 0, half);
    *centre = v_make(nearly_quarter(r), nearly_quarter(r), nearly_quarter(r));
    const double shift = oracle_below(r, 2) ? half : -half;
    for (int i = 0; i < 3; i++) {
        f->v[i] = v_make(nearly_quarter(r), nearly_quarter(r), nearly_quarter(r) + shift);
        below &= f->v[i].z <= centre->z - half;
        above &= f->v[i].z >= centre->z + half;
    }
    tahr__facet_finish(f);
    *end = v_make(centre->x, centre->y, centre->z + (below ? -half : half));
    return below | above;
}

static void the_end_of_an_upright_segment_is_all_of_it_over_and_under_a_triangle(void **state)
{
    (void)state;
    oracle_random r = {5};
    int met = 0;
    for (int n = 0; n < 2000000; n++) {
        tahr__core core;
        tahr_vec3 centre, end;
        tahr__facet f;
        tahr__witness whole, one = {0};
        if (!over_or_under(&r, &core, &centre, &f, &end)) continue;
        tahr__point_facet(end, &f, &one);
        tahr__facet_distance(&core, centre, &f, &whole);
        if (one.distance <= 1e-9) { /* which part of them touches is rounding */
            assert_true(whole.distance <= 2e-9);
            continue;
        }
        assert_memory_equal(&one.distance, &whole.distance, sizeof one.distance);
        assert_memory_equal(&one.point, &whole.point, sizeof one.point);
        assert_memory_equal(&one.normal, &whole.normal, sizeof one.normal);
        assert_true(one.feature == whole.feature && one.beside == whole.beside);
        met++;
    }
    assert_true(met > 200000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distance_is_exact),
        cmocka_unit_test(distance_to_slivers_is_exact),
        cmocka_unit_test(way_out_of_a_triangle_is_out_and_shortest),
        cmocka_unit_test(way_out_of_a_box_is_its_nearest_face),
        cmocka_unit_test(a_segment_in_the_plane_of_a_triangle_is_as_far_as_it_is),
        cmocka_unit_test(the_end_of_an_upright_segment_is_all_of_it_over_and_under_a_triangle),
        cmocka_unit_test(what_a_box_only_touches_is_met_by_what_keeps_them_apart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
