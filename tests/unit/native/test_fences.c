/* SPDX-License-Identifier: MIT
 * test_fences.c: a fence has all of a primitive behind it and the place before it, and who is told to be off it is. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "native/fence.h"
#include "dice.h"

enum { ROUNDS = 40000 };

typedef struct one {
    tahr__facet facet;
    tahr_bounds box;
    float block[TAHR__LANE_ROWS * TAHR__LANES];
    tahr__lanes lanes;
} one;

/* Of 1 cm to 10 m, level, upright or slanted; one in eight without planes, as those are that are too thin. */
static int make(one *o, oracle_random *seed)
{
    tahr__facet *f = &o->facet;
    const double size = pow(10, oracle_uniform(seed, -2, 1));
    const tahr_vec3 at = dice_vec(seed, -2, 2);
    const uint32_t kind = oracle_below(seed, 4);
    const tahr_vec3 squash = kind == 0 ? v_make(1, 1, 0) : kind == 1 ? v_make(0, 1, 1) : v_make(1, 1, 1);
    const int planes = oracle_below(seed, 8) != 0;
    for (int k = 0; k < 3; k++) {
        const tahr_vec3 d = v_scale(dice_vec(seed, -1, 1), size);
        f->v[k] = v_add(at, v_make(d.x * squash.x, d.y * squash.y, d.z * squash.z));
    }
    tahr__facet_finish(f);
    o->box = (tahr_bounds){v_min(f->v[0], v_min(f->v[1], f->v[2])), v_max(f->v[0], v_max(f->v[1], f->v[2]))};
    memset(o->block, 0, sizeof o->block);
    tahr__lanes_put(o->block, 0, &o->box, planes ? f : NULL);
    tahr__lanes_end(o->block, 1);
    o->lanes = (tahr__lanes){o->block, 1};
    return planes;
}

/* Along the fence, of the lower or upper end of an upright segment: its nearer one. */
static double off(const tahr__fences *f, tahr_vec3 p, double half)
{
    const tahr_vec3 n = v_make(f->x[0], f->y[0], f->z[0]);
    return v_dot(n, p) - fabs(n.z) * half - f->far[0];
}

/* A triangle is behind a plane, if its corners are; and a segment before it is as far from it at least. */
static void a_fence_parts_the_primitive_from_the_place(void **state)
{
    oracle_random seed = {5};
    int fences = 0;
    (void)state;
    for (int r = 0; r < ROUNDS; r++) {
        one o;
        tahr__fences f;
        const int planes = make(&o, &seed);
        const tahr_vec3 place = dice_vec(&seed, -3, 3);
        const double half = oracle_below(&seed, 3) ? oracle_uniform(&seed, 0, 1) : 0;
        const tahr__lanes_query at = tahr__lanes_at(place, half, 0);
        tahr__fences_clear(&f);
        if (!tahr__fences_put(&f, 0, &o.lanes, 0, &at)) continue;
        const tahr_vec3 n = v_make(f.x[0], f.y[0], f.z[0]);
        fences++;
        assert_true(fabs(v_length(n) - 1) < 2e-6);
        for (int k = 0; k < 3; k++)
            assert_true(v_dot(n, o.facet.v[k]) <= f.far[0] + 0.5 * TAHR__LANE_SLACK);
        assert_true(off(&f, place, half) > 0);
        if (!planes) { /* of a box its nearest point decides, and none is farther */
            const tahr_vec3 lowest = v_sub(o.box.min, v_make(place.x, place.y, place.z + half)),
                            highest = v_sub(v_make(place.x, place.y, place.z - half), o.box.max),
                            gap = v_max(v_max(lowest, highest), v_make(0, 0, 0));
            assert_true(fabs(off(&f, place, half) - v_length(gap)) < 1e-5);
        }
    }
    assert_true(fences > ROUNDS / 2);
}

/* Right over the inside of a level triangle the fence is as far as its plane. */
static void over_a_face_the_fence_is_its_plane(void **state)
{
    oracle_random seed = {9};
    (void)state;
    for (int r = 0; r < 1000; r++) {
        one o;
        tahr__fences f;
        const double z = oracle_uniform(&seed, -1, 1), height = oracle_uniform(&seed, 0.1, 2), half = 0.5;
        o.facet.v[0] = v_make(-2, -2, z);
        o.facet.v[1] = v_make(3, -2, z);
        o.facet.v[2] = v_make(-2, 3, z);
        tahr__facet_finish(&o.facet);
        o.box = (tahr_bounds){v_make(-2, -2, z), v_make(3, 3, z)};
        tahr__lanes_put(o.block, 0, &o.box, &o.facet);
        tahr__lanes_end(o.block, 1);
        o.lanes = (tahr__lanes){o.block, 1};
        const tahr_vec3 place = v_make(-1, -1, z + half + height);
        const tahr__lanes_query at = tahr__lanes_at(place, half, 0);
        tahr__fences_clear(&f);
        assert_true(tahr__fences_put(&f, 0, &o.lanes, 0, &at));
        assert_true(fabs(off(&f, place, half) - height) < 2e-6);
    }
}

/* What holds, and which does not, go by the same distance, of which this is the sum in double. */
static void who_is_told_to_be_off_is_off(void **state)
{
    oracle_random seed = {77};
    int held = 0, failed = 0;
    (void)state;
    for (int r = 0; r < ROUNDS; r++) {
        one o;
        tahr__fences f;
        make(&o, &seed);
        const tahr_vec3 place = dice_vec(&seed, -3, 3), p = v_add(place, dice_vec(&seed, -0.5, 0.5));
        const double half = oracle_uniform(&seed, 0, 1), reach = oracle_uniform(&seed, 0.05, 1);
        const tahr__lanes_query at = tahr__lanes_at(place, half, 0);
        tahr__fences_clear(&f);
        if (!tahr__fences_put(&f, 0, &o.lanes, 0, &at)) continue;
        const tahr_vec3 low = v_make(p.x, p.y, p.z - half);
        const int holds = tahr__fences_hold(&f, low, p.z + half, reach);
        const uint32_t fails = tahr__fences_fail(&f, low, p.z + half, reach);
        assert_int_equal(fails, !holds);
        if (holds) assert_true(off(&f, p, half) > reach);
        if (!holds) assert_true(off(&f, p, half) < reach + 2 * TAHR__LANE_SLACK);
        held += holds;
        failed += !holds;
    }
    assert_true(held > 1000 && failed > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_fence_parts_the_primitive_from_the_place),
        cmocka_unit_test(over_a_face_the_fence_is_its_plane),
        cmocka_unit_test(who_is_told_to_be_off_is_off),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
