/* SPDX-License-Identifier: MIT
 * test_lanes.c: the float cull leaves out nothing that is within reach, and keeps the same at every width. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "native/lanes.h"
#include "dice.h"

enum { COUNT = 61, BLOCKS = (COUNT + TAHR__LANES - 1) / TAHR__LANES, ROOM = BLOCKS * TAHR__LANES };

typedef struct scene {
    tahr__facet facets[COUNT];
    float blocks[BLOCKS * TAHR__LANE_ROWS * TAHR__LANES];
    tahr__lanes lanes;
} scene;

/* Flat, upright and slanted triangles of 1 cm to 10 m, one in eight of them long and thin. */
static void make(scene *s, oracle_random *seed)
{
    for (uint32_t i = 0; i < COUNT; i++) {
        tahr__facet *f = &s->facets[i];
        double size = pow(10, oracle_uniform(seed, -2, 1));
        tahr_vec3 at = dice_vec(seed, -2, 2), squash = v_make(1, 1, 1);
        uint32_t kind = oracle_below(seed, 4), thin = oracle_below(seed, 8) == 0;
        squash = kind == 0 ? v_make(1, 1, 0) : kind == 1 ? v_make(0, 1, 1) : squash;
        for (int k = 0; k < 3; k++) {
            tahr_vec3 d = v_scale(dice_vec(seed, -1, 1), size);
            if (thin && k == 2) d = v_scale(v_add(d, v_scale(v_sub(f->v[1], f->v[0]), 50)), 0.02);
            f->v[k] = v_add(thin && k == 2 ? f->v[0] : at, v_make(d.x * squash.x, d.y * squash.y, d.z * squash.z));
        }
        tahr__facet_finish(f);
        tahr_bounds box = {v_min(f->v[0], v_min(f->v[1], f->v[2])), v_max(f->v[0], v_max(f->v[1], f->v[2]))};
        tahr__lanes_put(s->blocks, i, &box, oracle_below(seed, 20) ? f : NULL);
    }
    tahr__lanes_end(s->blocks, COUNT);
    s->lanes = (tahr__lanes){s->blocks, COUNT};
}

typedef struct motion {
    tahr_vec3 start, by;
    double half, reach;
} motion;

static motion random_motion(oracle_random *seed)
{
    motion m = {dice_vec(seed, -2, 2), dice_vec(seed, -0.4, 0.4), oracle_uniform(seed, 0, 0.9),
                oracle_uniform(seed, 0.05, 0.5)};
    if (oracle_below(seed, 3) == 0) m.half = 0;
    if (oracle_below(seed, 3) == 0) m.by = v_make(0, 0, -oracle_uniform(seed, 0, 0.5));
    if (oracle_below(seed, 3) == 0) m.by.z = 0;
    return m;
}

static tahr__lanes_query query_of(const motion *m)
{
    tahr_vec3 end = v_add(m->start, m->by), half = v_make(0, 0, m->half);
    tahr_vec3 low = v_sub(v_min(m->start, end), half), high = v_add(v_max(m->start, end), half);
    tahr__lanes_query q = {.lo = {d_down(low.x), d_down(low.y), d_down(low.z)},
                           .hi = {d_up(high.x), d_up(high.y), d_up(high.z)},
                           .limit = d_up(m->reach * m->reach * (1 + 1e-5)),
                           .start = {(float)m->start.x, (float)m->start.y, (float)m->start.z},
                           .motion = {(float)m->by.x, (float)m->by.y, (float)m->by.z},
                           .half = (float)m->half,
                           .reach = (float)(m->reach + TAHR__LANE_SLACK),
                           .lowest = d_down(low.z)};
    return q;
}

static double distance(const motion *m, const tahr__facet *f, double t)
{
    tahr__core core = {.axis_count = m->half > 0 ? 1 : 0, .axis = {{0, 0, m->half}}};
    tahr__witness w;
    tahr__facet_distance(&core, v_mad(m->start, m->by, t), f, &w);
    return w.distance;
}

/* Not nearer than reach at any time before `until`. */
static void assert_out_of_reach(const motion *m, const tahr__facet *f, double until)
{
    for (int i = 0; i <= 100; i++) {
        double d = distance(m, f, until * i / 100);
        if (d < m->reach)
            fail_msg("left out at %g of %g, %.9g m away with a reach of %.9g", i / 100.0, until, d, m->reach);
    }
}

static void what_is_left_out_is_out_of_reach(void **unused)
{
    static scene s;
    oracle_random seed = {31};
    uint32_t left_out = 0, kept = 0, later = 0;
    (void)unused;
    for (int run = 0; run < 3000; run++) {
        if (run % 20 == 0) make(&s, &seed);
        motion m = random_motion(&seed);
        tahr__lanes_query q = query_of(&m);
        tahr__lanes_found found[COUNT];
        uint32_t count = tahr__lanes_of(TAHR__LANES_SCALAR)->cull(&s.lanes, &q, found), next = 0;
        for (uint32_t i = 0; i < COUNT; i++) {
            int is_found = next < count && found[next].index == i;
            double until = is_found ? found[next].time : 1;
            next += (uint32_t)is_found;
            kept += (uint32_t)is_found;
            left_out += (uint32_t)!is_found;
            later += is_found && until > 0;
            if (until > 0) assert_out_of_reach(&m, &s.facets[i], until);
        }
        assert_int_equal(next, count);
    }
    print_message("    %u left out, %u kept, of these %u for later\n", left_out, kept, later);
    assert_true(kept > 4000 && later > 500 && left_out > 10 * kept);
}

/* It would be sound to keep everything: most of what is kept must come near. */
static void what_is_kept_comes_near(void **unused)
{
    static scene s;
    oracle_random seed = {77};
    uint32_t near = 0, kept = 0;
    (void)unused;
    for (int run = 0; run < 600; run++) {
        if (run % 20 == 0) make(&s, &seed);
        motion m = random_motion(&seed);
        tahr__lanes_query q = query_of(&m);
        tahr__lanes_found found[COUNT];
        uint32_t count = tahr__lanes_of(TAHR__LANES_SCALAR)->cull(&s.lanes, &q, found);
        for (uint32_t k = 0; k < count; k++) {
            double least = 1e9;
            for (int i = 0; i <= 50; i++)
                least = d_min(least, distance(&m, &s.facets[found[k].index], i / 50.0));
            near += least < m.reach + 1e-3;
            kept++;
        }
    }
    print_message("    %u of %u kept come within reach\n", near, kept);
    assert_true(near > 0.7 * kept);
}

/* Of a segment at rest: what is left out is farther than asked for, and no distance that is told is more than it is. */
static void what_is_near_is_no_nearer_than_told(void **unused)
{
    static scene s;
    oracle_random seed = {43};
    uint32_t left_out = 0, kept = 0, close = 0;
    (void)unused;
    for (int run = 0; run < 3000; run++) {
        if (run % 20 == 0) make(&s, &seed);
        motion m = random_motion(&seed);
        m.by = v_make(0, 0, 0);
        tahr__lanes_query q = query_of(&m);
        tahr__lanes_found found[COUNT];
        uint32_t count = tahr__lanes_of(TAHR__LANES_SCALAR)->near(&s.lanes, &q, found), next = 0;
        for (uint32_t i = 0; i < COUNT; i++) {
            int is_found = next < count && found[next].index == i;
            double away = distance(&m, &s.facets[i], 0);
            if (is_found) {
                double told = found[next].time;
                assert_true(told - TAHR__LANE_SLACK <= away);
                close += told > 0.5 * away;
                kept++;
                next++;
            } else {
                assert_true(away > m.reach);
                left_out++;
            }
        }
        assert_int_equal(next, count);
    }
    print_message("    %u left out, %u kept, %u of them told half as far as they are, or farther\n", left_out, kept,
                  close);
    assert_true(kept > 3000 && left_out > 10 * kept && close > 0.6 * kept);
}

/* The distances of all are no more than they are, and of what is within the limit as near tells them; and none but
 * those of no more than what is asked for are picked. */
static void what_is_measured_is_no_nearer_than_told(void **unused)
{
    static scene s;
    oracle_random seed = {59};
    uint32_t picked = 0, lifted = 0;
    (void)unused;
    for (int run = 0; run < 3000; run++) {
        if (run % 20 == 0) make(&s, &seed);
        motion m = random_motion(&seed);
        m.by = v_make(0, 0, 0);
        const tahr__lanes_query q = query_of(&m);
        tahr__lanes_found near[COUNT], found[COUNT];
        float far[BLOCKS * TAHR__LANES], lift[BLOCKS * TAHR__LANES] = {0};
        tahr__lanes_of(TAHR__LANES_SCALAR)->measure(&s.lanes, &q, far);
        const uint32_t count = tahr__lanes_of(TAHR__LANES_SCALAR)->near(&s.lanes, &q, near);
        for (uint32_t i = 0; i < count; i++)
            assert_true(far[near[i].index] == near[i].time);
        for (uint32_t i = 0; i < COUNT; i++) {
            assert_true(far[i] - TAHR__LANE_SLACK <= distance(&m, &s.facets[i], 0));
            lift[i] = oracle_below(&seed, 3) == 0 ? 1e38f : 0;
        }
        for (uint32_t i = COUNT; i < BLOCKS * TAHR__LANES; i++)
            assert_true(far[i] > 1e29f);
        const uint32_t all = tahr__lanes_of(TAHR__LANES_SCALAR)->pick(far, NULL, COUNT, q.reach, found);
        const uint32_t some = tahr__lanes_of(TAHR__LANES_SCALAR)->pick(far, lift, COUNT, q.reach, near);
        uint32_t expected = 0, unlifted = 0;
        for (uint32_t i = 0; i < COUNT; i++) {
            if (!(far[i] <= q.reach)) continue;
            assert_true(found[expected].index == i && found[expected].time == far[i]);
            expected++;
            if (lift[i] > 0) continue;
            assert_int_equal(near[unlifted].index, i);
            unlifted++;
        }
        assert_int_equal(all, expected);
        assert_int_equal(some, unlifted);
        picked += all;
        lifted += all - some;
    }
    assert_true(picked > 3000 && lifted > 0.2 * picked && lifted < 0.5 * picked);
}

static void assert_same_bits(tahr__lanes_fn *one, tahr__lanes_fn *many, const tahr__lanes *lanes,
                             const tahr__lanes_query *q)
{
    tahr__lanes_found found[2][ROOM];
    const uint32_t count = one(lanes, q, found[0]);
    assert_int_equal(many(lanes, q, found[1]), count);
    assert_memory_equal(found[1], found[0], count * sizeof found[0][0]);
}

/* The same of what is measured at a place, and picked. */
static void assert_same_measures(const tahr__lanes_way *one, const tahr__lanes_way *many, const tahr__lanes *lanes,
                                 const tahr__lanes_query *q)
{
    float far[2][ROOM] = {{0}}, lift[ROOM] = {0};
    tahr__lanes_found found[2][ROOM];
    one->measure(lanes, q, far[0]);
    many->measure(lanes, q, far[1]);
    assert_memory_equal(far[0], far[1], sizeof far[0]);
    for (uint32_t i = 0; i < lanes->count; i += 3)
        lift[i] = 1e38f;
    for (int lifts = 0; lifts < 2; lifts++) {
        const uint32_t count = one->pick(far[0], lifts ? lift : NULL, lanes->count, q->reach, found[0]);
        assert_int_equal(many->pick(far[0], lifts ? lift : NULL, lanes->count, q->reach, found[1]), count);
        assert_memory_equal(found[0], found[1], count * sizeof found[0][0]);
    }
}

static void every_width_keeps_the_same_bits(void **unused)
{
    static scene s;
    oracle_random seed = {5};
    const tahr__lanes_way *one = tahr__lanes_of(TAHR__LANES_SCALAR);
    (void)unused;
    assert_ptr_equal(tahr__lanes_best(1), one);
    print_message("    up to %s\n", tahr__lanes_best(0)->name);
    for (int run = 0; run < 20000; run++) {
        if (run % 50 == 0) make(&s, &seed);
        motion m = random_motion(&seed);
        tahr__lanes_query q = query_of(&m);
        tahr__lanes lanes = {s.blocks, 1 + oracle_below(&seed, COUNT)};
        float rest[BLOCKS * TAHR__LANE_ROWS * TAHR__LANES];
        memcpy(rest, s.blocks, sizeof rest);
        tahr__lanes_end(rest, lanes.count);
        lanes.blocks = rest;
        if (run % 4 == 0) { /* exactly as far as one of them */
            float far[ROOM];
            one->measure(&lanes, &q, far);
            q.reach = far[oracle_below(&seed, lanes.count)];
        }
        for (uint32_t i = 0; i < TAHR__LANES_WAYS; i++) {
            const tahr__lanes_way *way = tahr__lanes_of(i);
            if (!way) continue;
            assert_same_bits(one->cull, way->cull, &lanes, &q);
            assert_same_bits(one->near, way->near, &lanes, &q);
            assert_same_measures(one, way, &lanes, &q);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_left_out_is_out_of_reach),
        cmocka_unit_test(what_is_kept_comes_near),
        cmocka_unit_test(what_is_near_is_no_nearer_than_told),
        cmocka_unit_test(what_is_measured_is_no_nearer_than_told),
        cmocka_unit_test(every_width_keeps_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
