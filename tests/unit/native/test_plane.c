/* SPDX-License-Identifier: MIT
 * test_plane.c: what planes, edges and corners of a triangle say of a motion before anything is measured is never too
 * late, and mostly enough. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "native/plane.h"

enum { TIMES = 200 };

/* Flat, upright and slanted triangles of 1 cm to 10 m, some of them long and thin. */
static void make_triangle(oracle_random *seed, tahr__prim *prim)
{
    const double size = pow(10, oracle_uniform(seed, -1.5, 1));
    const uint32_t kind = oracle_below(seed, 4), thin = oracle_below(seed, 8) == 0;
    const tahr_vec3 squash = kind == 0 ? v_make(1, 1, 0) : kind == 1 ? v_make(0, 1, 1) : v_make(1, 1, 1);
    const tahr_vec3 at = dice_vec(seed, -1, 1);
    tahr__facet *f = &prim->facet;
    for (int k = 0; k < 3; k++) {
        tahr_vec3 d = v_scale(dice_vec(seed, -1, 1), size);
        if (thin && k == 2) d = v_scale(v_sub(f->v[1], f->v[0]), oracle_uniform(seed, 0, 1.2));
        f->v[k] = v_add(thin && k == 2 ? f->v[0] : at, v_make(d.x * squash.x, d.y * squash.y, d.z * squash.z));
    }
    if (thin) f->v[2] = v_add(f->v[2], v_make(0, 1e-3, 0));
    tahr__facet_finish(f);
    prim->kind = TAHR__TWO_SIDED;
}

/* A point, an upright segment, or a box, that goes some way: down, level, or any. */
static void make_query(oracle_random *seed, int axes, tahr__query *query)
{
    const uint32_t way = oracle_below(seed, 3);
    query->core.axis_count = axes;
    query->half = axes == 1 ? oracle_uniform(seed, 0.05, 0.9) : 0;
    query->core.axis[0] = axes == 3 ? v_make(oracle_uniform(seed, 0.1, 0.5), 0, 0) : v_make(0, 0, query->half);
    query->core.axis[1] = v_make(0, oracle_uniform(seed, 0.1, 0.5), 0);
    query->core.axis[2] = v_make(0, 0, oracle_uniform(seed, 0.1, 0.5));
    query->radius = axes == 3 ? 0 : oracle_uniform(seed, 0.05, 0.5);
    query->margin = axes == 3 ? 0.05 : oracle_uniform(seed, 0, 0.05);
    query->start = dice_vec(seed, -1.5, 1.5);
    query->motion = dice_vec(seed, -0.4, 0.4);
    if (way == 0) query->motion = v_make(0, 0, -oracle_uniform(seed, 0.01, 0.5));
    if (way == 1) query->motion.z = 0;
    query->motion_length = v_length(query->motion);
}

static double distance(const tahr__query *query, const tahr__prim *prim, double t)
{
    tahr__witness w;
    tahr__facet_distance(&query->core, v_mad(query->start, query->motion, t), &prim->facet, &w);
    return w.distance;
}

/* The distance is convex in time: what has not come within reach at many times has come no nearer between them than the
 * ways from and to them let. */
static void nothing_is_left_out_that_comes_within_reach(void **unused)
{
    oracle_random seed = {91};
    uint32_t never = 0, later = 0, at_once = 0;
    (void)unused;
    for (int run = 0; run < 60000; run++) {
        tahr__prim prim = {.kind = 0};
        tahr__query query = {.flags = 0};
        make_triangle(&seed, &prim);
        make_query(&seed, run % 8 == 0 ? 3 : run % 2, &query);
        const double plane = plane_earliest(&query, &prim, 1);
        const double t = plane > 1 ? plane : edges_earliest(&query, &prim, 1, plane), until = d_min(t, 1);
        const double reach = query.radius + query.margin;
        assert_true(t >= plane);
        never += t > 1;
        later += t > 0 && t <= 1;
        at_once += t == 0;
        for (int i = 0; t > 0 && i < TIMES; i++) {
            const double at = until * i / TIMES, d = distance(&query, &prim, at);
            if (d < reach) fail_msg("run %d: within %g m at %g of %g, and reaches %g", run, d, at, t, reach);
            i += (int)((d - reach) * TIMES / (2 * until * query.motion_length)); /* not so soon */
        }
    }
    print_message("    %u never, %u later, %u at once\n", never, later, at_once);
    assert_true(never > 30000 && later > 500 && at_once > 1000);
}

/* It would be sound to leave out nothing: nearly all of what stays beyond reach by a centimetre must be. */
static void what_stays_beyond_reach_is_left_out(void **unused)
{
    oracle_random seed = {92};
    uint32_t beyond = 0, left_out = 0;
    (void)unused;
    for (int run = 0; run < 20000; run++) {
        tahr__prim prim = {.kind = 0};
        tahr__query query = {.flags = 0};
        make_triangle(&seed, &prim);
        make_query(&seed, run % 2, &query);
        double least = distance(&query, &prim, 0);
        if (least - query.motion_length > query.radius + query.margin) continue; /* nothing would come near */
        for (int i = 1; i <= TIMES; i++)
            least = d_min(least, distance(&query, &prim, 1.0 * i / TIMES));
        if (least < query.radius + query.margin + 0.01) continue;
        const double plane = plane_earliest(&query, &prim, 1);
        beyond++;
        left_out += plane > 1 || edges_earliest(&query, &prim, 1, plane) > 1;
    }
    print_message("    %u of %u that stay beyond reach are left out\n", left_out, beyond);
    assert_true(beyond > 300 && left_out > 0.8 * beyond);
}

/* A leaning wall goes on from its top edge, which is level: beside that edge a segment that is taller is as near by
 * some point between its ends, and level is the way there. A centimetre more than the reach, going along it. */
static void a_segment_beside_an_edge_is_as_near_as_the_edge_is_level(void **unused)
{
    tahr__prim prim = {.kind = TAHR__TWO_SIDED};
    tahr__query query = {.flags = 0};
    (void)unused;
    prim.facet.v[0] = v_make(0, -5, 1);
    prim.facet.v[1] = v_make(0, 5, 1);
    prim.facet.v[2] = v_make(-2, 0, -1);
    tahr__facet_finish(&prim.facet);
    query.core.axis_count = 1;
    query.half = 0.6;
    query.core.axis[0] = v_make(0, 0, 0.6);
    query.radius = 0.35;
    query.margin = 0.01;
    query.motion = v_make(0, 0.2, 0);
    query.motion_length = 0.2;
    query.start = v_make(0.37, 0, 1);
    assert_true(plane_earliest(&query, &prim, 1) == 0); /* its lower end is nearer to the plane than that */
    assert_true(edges_earliest(&query, &prim, 1, 0) > 1);
    query.start.x = 0.355;
    assert_true(edges_earliest(&query, &prim, 1, 0) == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_is_left_out_that_comes_within_reach),
        cmocka_unit_test(what_stays_beyond_reach_is_left_out),
        cmocka_unit_test(a_segment_beside_an_edge_is_as_near_as_the_edge_is_level),
    };
    return cmocka_run_group_tests_name("native planes", tests, NULL, NULL);
}
