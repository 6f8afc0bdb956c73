/* SPDX-License-Identifier: MIT
 * test_convex.c: distance and way out of convex shapes against closed forms, the faces of hulls against Euler, and the
 * tree of bodies against a list. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "common/body_tree.h"
#include "common/convex.h"
#include "common/core.h"
#include "common/hull_planes.h"
#include "dice.h"
#include "fake_host.h"
#include "fake_world.h"

static oracle_random dice;

static double uniform(double low, double high)
{
    return oracle_uniform(&dice, low, high);
}

static tahr__convex round_solid(uint32_t kind, double radius, double half)
{
    tahr__convex c = {.kind = kind, .radius = radius, .scale = 1};
    c.axis[0] = v_make(0, 0, half);
    if (kind == TAHR__CONVEX_ELLIPSOID) {
        c.axis[0] = v_make(radius, 0, 0);
        c.axis[1] = v_make(0, radius, 0);
        c.axis[2] = v_make(0, 0, half);
    }
    return c;
}

static tahr__convex point_at(tahr_vec3 p)
{
    tahr__convex c = {.kind = TAHR__CONVEX_SUM, .centre = p, .scale = 1};
    return c;
}

/* The certificate holds, and the witness points are where the distance says. */
static void assert_gap(const tahr__gap *g, double expected, double near)
{
    assert_true(g->lower <= expected + 1e-12 && g->distance >= expected - 1e-12);
    assert_true(g->distance - g->lower <= near);
    assert_true(fabs(v_length(v_sub(g->on_a, g->on_b)) - expected) < 1e-9);
    assert_true(fabs(v_length(g->normal) - 1) < 1e-12);
    assert_int_equal(g->given_up, 0);
}

static void distance_of_a_point_has_the_closed_form_of_every_round_solid(void **state)
{
    const tahr_vec3 none = {0, 0, 0};
    (void)state;
    dice.state = 1;
    for (int i = 0; i < 2000; i++) {
        double r = uniform(0.1, 1), h = uniform(0.1, 1), x = uniform(0, 3), z = uniform(-3, 3), angle = uniform(0, 6);
        tahr__convex p = point_at(v_make(x * cos(angle), x * sin(angle), z)), b;
        tahr__gap g;
        b = round_solid(TAHR__CONVEX_CYLINDER, r, h);
        double out = d_max(0, x - r), over = d_max(0, fabs(z) - h), expected = sqrt(out * out + over * over);
        tahr__convex_distance(&p, &b, none, &g);
        if (expected > 1e-6) assert_gap(&g, expected, 1e-9);
        if (expected == 0) assert_true(g.distance < 1e-9);
        /* A ball is an ellipsoid whose distance is known. */
        b = round_solid(TAHR__CONVEX_ELLIPSOID, r, r);
        expected = sqrt(x * x + z * z) - r;
        tahr__convex_distance(&p, &b, none, &g);
        if (expected > 1e-6) assert_gap(&g, expected, 1e-9);
        if (expected < 0) assert_true(g.distance == 0);
        /* Above the apex, along the axis. */
        b = round_solid(TAHR__CONVEX_CONE, r, h);
        p = point_at(v_make(0, 0, h + 1));
        tahr__convex_distance(&p, &b, none, &g);
        assert_gap(&g, 1, 1e-9);
        /* Straight out from the middle of the side. */
        double slant = sqrt(r * r + 4 * h * h);
        p = point_at(v_make(0.5 * r + 2 * h / slant, 0, r / slant));
        tahr__convex_distance(&p, &b, none, &g);
        assert_gap(&g, 1, 1e-9);
    }
}

static void distance_of_triangles_to_a_box_is_that_of_the_exact_core(void **state)
{
    tahr__convex box = {.kind = TAHR__CONVEX_SUM, .count = 3, .scale = 1};
    tahr__core core = {.axis_count = 3};
    int apart = 0;
    (void)state;
    dice.state = 2;
    for (int i = 0; i < 3000; i++) {
        tahr_vec3 v[3] = {dice_vec(&dice, -2, 2), dice_vec(&dice, -2, 2), dice_vec(&dice, -2, 2)};
        tahr__convex triangle = {.kind = TAHR__CONVEX_POINTS, .count = 3, .points = v, .scale = 1};
        tahr__witness w;
        tahr__gap g;
        box.axis[0] = core.axis[0] = v_make(uniform(0.1, 1), 0, 0);
        box.axis[1] = core.axis[1] = v_make(0, uniform(0.1, 1), 0);
        box.axis[2] = core.axis[2] = v_make(0, 0, uniform(0.1, 1));
        tahr__core_distance(&core, v_make(0, 0, 0), v, &w);
        tahr__convex_distance(&box, &triangle, v_make(0, 0, 0), &g);
        if (w.distance < 1e-6) {
            assert_true(g.distance < 1e-5);
            continue;
        }
        apart++;
        assert_gap(&g, w.distance, 1e-9);
        tahr_vec3 on_b = v_scale(v[0], g.weight[0]);
        on_b = v_mad(v_mad(on_b, v[1], g.weight[1]), v[2], g.weight[2]);
        assert_true(v_length(v_sub(on_b, g.on_b)) < 1e-12);
    }
    assert_true(apart > 1000);
}

static void clearance_ends_early_and_is_never_wrong(void **state)
{
    uint32_t early = 0, cheaper = 0;
    (void)state;
    dice.state = 3;
    for (int i = 0; i < 2000; i++) {
        tahr__convex a = round_solid(TAHR__CONVEX_CYLINDER, uniform(0.1, 0.5), uniform(0.1, 0.9));
        tahr__convex b = round_solid(TAHR__CONVEX_ELLIPSOID, uniform(0.1, 0.5), uniform(0.1, 0.9));
        tahr__clearance enough = {dice_vec(&dice, -1, 1), uniform(0, 0.1)};
        tahr__gap whole, g, end;
        a.centre = dice_vec(&dice, -2, 2);
        tahr__convex_distance(&a, &b, v_make(0, 0, 0), &whole);
        tahr__convex_clear(&a, &b, v_make(0, 0, 0), &enough, &g);
        assert_true(g.lower <= whole.distance + 1e-12);
        early += g.clear;
        cheaper += g.iterations < whole.iterations;
        if (!g.clear) continue;
        a.centre = v_add(a.centre, enough.motion);
        tahr__convex_distance(&a, &b, v_make(0, 0, 0), &end);
        assert_true(whole.distance > enough.reach && end.distance > enough.reach);
    }
    assert_true(early > 500 && cheaper > 500);
}

/* Coaxial solids of revolution leave each other along the axis or across it, whichever is nearer. */
static void way_out_of_a_cylinder_has_its_closed_form(void **state)
{
    (void)state;
    dice.state = 4;
    for (int i = 0; i < 300; i++) {
        tahr__convex a = round_solid(TAHR__CONVEX_CYLINDER, uniform(0.1, 0.5), uniform(0.1, 0.9));
        tahr__convex b = round_solid(TAHR__CONVEX_CYLINDER, uniform(0.1, 0.5), uniform(0.1, 0.9));
        double x = uniform(0, a.radius + b.radius), z = uniform(0, a.axis[0].z + b.axis[0].z);
        double across = a.radius + b.radius - x, along = a.axis[0].z + b.axis[0].z - z;
        tahr_vec3 normal, guess = {0, 0, 1};
        a.centre = v_make(x, 0, z);
        double depth = tahr__convex_leave(&a, &b, &guess, 1, 0.5, &normal);
        assert_true(fabs(depth - d_min(across, along)) < 1e-9);
        if (fabs(across - along) > 1e-3) assert_true((across < along ? normal.x : normal.z) > 1 - 1e-6);
    }
}

static void hull_planes_are_as_many_as_the_solid_has_faces(void **state)
{
    const tahr_vec3 octahedron[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    tahr_vec3 cube[9], ball[TAHR__HULL_VERTICES];
    fake_memory memory = {.fail_once = 1};
    fake_log log;
    tahr_host host = {sizeof host, TAHR_ABI, fake_allocator(&memory), fake_log_of(&log)};
    tahr__hull_planes planes;
    const char *reason;
    (void)state;
    dice.state = 5;
    for (int i = 0; i < 8; i++)
        cube[i] = v_make(i & 1, i & 2, i & 4);
    cube[8] = v_make(0.5, 1, 2); /* inside */
    for (int i = 0; i < TAHR__HULL_VERTICES; i++)
        ball[i] = dice_direction(&dice);
    const struct {
        const tahr_vec3 *points;
        uint32_t count, faces;
    } cases[] = {{octahedron, 6, 8}, {cube, 8, 6}, {cube, 9, 6}, {ball, 4, 4}, {ball, 30, 56}, {ball, 256, 508}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_int_equal(tahr__hull_planes_build(&host, cases[i].points, cases[i].count, &planes, &reason), TAHR_OK);
        assert_int_equal(planes.count, cases[i].faces); /* points on a ball: 2 n - 4 by Euler */
        for (uint32_t k = 0; k < planes.count; k++) {
            int on = 0;
            for (uint32_t m = 0; m < cases[i].count; m++) {
                double height = v_dot(planes.normals[k], cases[i].points[m]) - planes.offsets[k];
                assert_true(height < 1e-8);
                on += height > -1e-8;
            }
            assert_true(on >= 3);
        }
        tahr__hull_planes_free(&host, &planes);
    }
    assert_int_equal(tahr__hull_planes_build(&host, ball, 3, &planes, &reason), TAHR_E_GEOMETRY);
    assert_int_equal(tahr__hull_planes_build(&host, ball, 257, &planes, &reason), TAHR_E_GEOMETRY);
    for (memory.fail_at = 1; memory.fail_at <= 3; memory.fail_at++) {
        memory.requests = 0;
        assert_int_equal(tahr__hull_planes_build(&host, cube, 8, &planes, &reason), TAHR_E_MEMORY);
    }
    assert_int_equal(memory.live_bytes, 0);
}

static tahr_bounds random_bounds(void)
{
    tahr_vec3 at = dice_vec(&dice, -50, 50), half = dice_vec(&dice, 0.1, 2);
    tahr_bounds b = {v_sub(at, half), v_add(at, half)};
    return b;
}

static int meet(const tahr_bounds *a, const tahr_bounds *b)
{
    return a->min.x <= b->max.x && b->min.x <= a->max.x && a->min.y <= b->max.y && b->min.y <= a->max.y &&
           a->min.z <= b->max.z && b->min.z <= a->max.z;
}

static void body_tree_finds_what_a_list_finds_after_bodies_moved_too(void **state)
{
    enum { BODIES = 300 };
    tahr_bounds bounds[BODIES];
    fake_memory memory = {0};
    fake_log log;
    tahr_host host = {sizeof host, TAHR_ABI, fake_allocator(&memory), fake_log_of(&log)};
    tahr__body_tree tree;
    tahr__body_walk walk;
    uint32_t body, hits = 0;
    (void)state;
    dice.state = 6;
    assert_int_equal(tahr__body_tree_open(&host, NULL, 0, &tree), TAHR_OK);
    tahr__body_walk_begin(&walk, &tree, &bounds[0], v_make(0, 0, 0));
    assert_int_equal(tahr__body_walk_next(&walk, &body), 0);
    for (int i = 0; i < BODIES; i++)
        bounds[i] = random_bounds();
    assert_int_equal(tahr__body_tree_open(&host, bounds, BODIES, &tree), TAHR_OK);
    for (int round = 0; round < 200; round++) {
        uint8_t found[BODIES] = {0};
        tahr_bounds box = random_bounds();
        box.max = v_add(box.max, v_make(30, 30, 30));
        uint32_t moved = oracle_below(&dice, BODIES);
        bounds[moved] = random_bounds();
        tahr__body_tree_set(&tree, moved, &bounds[moved]);
        tahr__body_tree_refit(&tree);
        tahr__body_walk_begin(&walk, &tree, &box, box.min);
        while (tahr__body_walk_next(&walk, &body))
            assert_int_equal(found[body]++, 0);
        for (int i = 0; i < BODIES; i++) {
            hits += (uint32_t)meet(&box, &bounds[i]);
            assert_true(found[i] || !meet(&box, &bounds[i]));
        }
    }
    assert_true(hits > 200);
    tahr__body_tree_close(&host, &tree);
    assert_int_equal(memory.live_bytes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distance_of_a_point_has_the_closed_form_of_every_round_solid),
        cmocka_unit_test(distance_of_triangles_to_a_box_is_that_of_the_exact_core),
        cmocka_unit_test(clearance_ends_early_and_is_never_wrong),
        cmocka_unit_test(way_out_of_a_cylinder_has_its_closed_form),
        cmocka_unit_test(hull_planes_are_as_many_as_the_solid_has_faces),
        cmocka_unit_test(body_tree_finds_what_a_list_finds_after_bodies_moved_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
