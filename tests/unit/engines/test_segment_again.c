/* SPDX-License-Identifier: MIT
 * test_segment_again.c: what a segment was nearest to between the ends of it is found again by a third of the work: the
 * same bits as by all of it, or nothing is said. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "common/core.h"
#include "dice.h"
#include "oracle.h"

/* A segment that is nearest to an edge or corner of a triangle, unless the rest of it is nearer. */
typedef struct pair {
    tahr__core core;
    tahr_vec3 centre;
    tahr__facet facet;
    uint32_t feature;
} pair;

/* Between 10^low and 10^high, each power of ten as often. */
static double power(oracle_random *r, double low, double high)
{
    return pow(10, oracle_uniform(r, low, high));
}

/* A part of a length; now and then next to either end of it. */
static double part(oracle_random *r)
{
    const double near = power(r, -6, -1);
    switch (oracle_below(r, 4)) {
    case 0: return near;
    case 1: return 1 - near;
    default: return oracle_uniform(r, 0, 1);
    }
}

/* From a place to another that lies behind the plane across n, often by little. */
static tahr_vec3 behind(oracle_random *r, tahr_vec3 n)
{
    const tahr_vec3 side = dice_direction(r);
    const tahr_vec3 level = v_mad(side, n, -v_dot(side, n));
    return v_scale(v_mad(level, n, -power(r, -7, 0)), power(r, -4, 0.5));
}

/* All of it somewhere; with what decides whether it may be told again often as little as can be. */
static void make(pair *p, oracle_random *r)
{
    const int is_edge = (int)oracle_below(r, 2);
    const uint32_t i = oracle_below(r, 3);
    const tahr_vec3 at = dice_vec(r, -3, 3);
    const tahr_vec3 along = oracle_below(r, 2) ? v_make(0, 0, 1) : dice_direction(r);
    const double half = power(r, -5, 0.3), s = part(r), away = power(r, -16, 1.3);
    tahr_vec3 edge = dice_direction(r), n;
    if (is_edge && oracle_below(r, 2)) edge = v_mad(along, edge, power(r, -8, 0));
    n = is_edge ? v_cross(along, edge) : v_cross(along, dice_direction(r));
    n = v_scale(n, 1 / v_length(n));
    p->core.axis_count = 1;
    p->core.axis[0] = v_scale(along, half);
    p->centre = v_mad(v_mad(at, n, away), along, half * (1 - 2 * s));
    if (is_edge) {
        const double t = part(r), length = power(r, -4, 1);
        p->facet.v[i] = v_mad(at, edge, -t * length);
        p->facet.v[(i + 1) % 3] = v_mad(at, edge, (1 - t) * length);
        p->feature = TAHR__EDGE + i;
    } else {
        p->facet.v[i] = at;
        p->facet.v[(i + 1) % 3] = v_add(at, behind(r, n));
        p->feature = TAHR__CORNER + i;
    }
    p->facet.v[(i + 2) % 3] = v_add(at, behind(r, n));
    tahr__facet_finish(&p->facet);
}

/* 1: it was told again, and is so to the last bit. */
static int asks_again(const pair *p, tahr_vec3 centre, uint32_t feature)
{
    tahr__witness again, all;
    memset(&again, 0, sizeof again);
    memset(&all, 0, sizeof all);
    again.feature = feature;
    again.beside = 1;
    const tahr__witness asked = again;
    tahr__facet_distance(&p->core, centre, &p->facet, &all);
    if (!tahr__segment_again(&p->core, centre, &p->facet, &again)) {
        assert_memory_equal(&again, &asked, sizeof again);
        return 0;
    }
    assert_int_equal(all.feature, feature);
    assert_memory_equal(&again, &all, sizeof all);
    return 1;
}

static void what_is_told_again_is_what_is_found(void **unused)
{
    enum { PAIRS = 2000000 };
    oracle_random r = {77};
    uint32_t edges = 0, corners = 0;
    pair p;
    (void)unused;
    for (int n = 0; n < PAIRS; n++) {
        make(&p, &r);
        const int told = asks_again(&p, p.centre, p.feature);
        edges += (uint32_t)(told && p.feature < TAHR__CORNER);
        corners += (uint32_t)(told && p.feature >= TAHR__CORNER);
        /* What it was not found at: nothing is taken for granted. */
        asks_again(&p, p.centre, oracle_below(&r, 7));
    }
    assert_true(edges > PAIRS / 50 && corners > PAIRS / 50);
}

/* An edge that hardly slants against the segment, and ends soon: its corner is as near but for rounding, since along
 * the segment it goes along. */
static void make_slanted(pair *p, oracle_random *r)
{
    const uint32_t i = oracle_below(r, 3);
    const double slant = power(r, -3, -2), angle = oracle_uniform(r, 0, 0.5), away = power(r, -4, 0);
    const tahr_vec3 at = dice_vec(r, -3, 3), along = v_make(0, 0, 1);
    const tahr_vec3 edge = v_make(slant * (1 - angle), slant * angle, 1);
    const tahr_vec3 across = v_cross(along, edge), n = v_scale(across, 1 / v_length(across));
    const double length = power(r, -3, 0), before = away * power(r, -4, 0);
    p->core.axis_count = 1;
    p->core.axis[0] = v_scale(along, 0.5);
    p->centre = v_mad(v_mad(at, n, away), along, oracle_uniform(r, -0.3, 0.3));
    p->facet.v[i] = v_mad(at, edge, -before);
    p->facet.v[(i + 1) % 3] = v_mad(at, edge, length - before);
    p->facet.v[(i + 2) % 3] = v_mad(v_mad(at, edge, oracle_uniform(r, 0, 1)), n, -1);
    p->feature = TAHR__EDGE + i;
    tahr__facet_finish(&p->facet);
}

static void an_edge_that_ends_soon_along_the_segment_is_told_again_as_it_is(void **unused)
{
    oracle_random r = {78};
    uint32_t told = 0;
    pair p;
    (void)unused;
    for (int n = 0; n < 1000000; n++) {
        make_slanted(&p, &r);
        told += (uint32_t)asks_again(&p, p.centre, p.feature);
    }
    assert_true(told > 5000);
}

/* What it is for: a way past an edge in the open. */
static void a_way_past_an_edge_in_the_open_is_told_again_all_along(void **unused)
{
    pair p = {.core = {.axis_count = 1, .axis = {{0, 0, 0.5}}},
              .facet = {.v = {{-1, 0, 0.3}, {1, 0, 0.1}, {0, 2, 0.2}}}};
    (void)unused;
    tahr__facet_finish(&p.facet);
    for (int n = 0; n <= 100; n++) {
        const tahr_vec3 centre = v_make(0.005 * n - 0.25, -0.3 - 0.001 * n, 0.002 * n);
        assert_true(asks_again(&p, centre, TAHR__EDGE));
    }
    /* Below and past its ends, and in front of the face. */
    assert_false(asks_again(&p, v_make(0, -0.3, 1.5), TAHR__EDGE));
    assert_false(asks_again(&p, v_make(-1.5, -0.3, 0), TAHR__EDGE));
    assert_false(asks_again(&p, v_make(0, 0.5, 0.2), TAHR__EDGE));
    assert_false(asks_again(&p, v_make(0, 0.5, 0.9), TAHR__FACE));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_told_again_is_what_is_found),
        cmocka_unit_test(an_edge_that_ends_soon_along_the_segment_is_told_again_as_it_is),
        cmocka_unit_test(a_way_past_an_edge_in_the_open_is_told_again_all_along)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
