/* SPDX-License-Identifier: MIT
 * lanes.c: filling the lanes, the cull four at a time and its scalar twin, and which to take. All do the same IEEE
 * operations in the same order, so they keep the same primitives. */
#include "lanes.h"


#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#endif

/* A box that is far from everything, for unused lanes. */
#define NOWHERE 1e30f
/* Coordinates (m) up to which planes are right within TAHR__LANE_SLACK. */
#define RANGE 32.0
/* A fraction that no motion has. */
#define NEVER 2.0f

/* Down one lane. */
static void put_vec(float *to, tahr_vec3 v)
{
    to[0] = (float)v.x;
    to[TAHR__LANES] = (float)v.y;
    to[2 * TAHR__LANES] = (float)v.z;
}

static int in_range(tahr_vec3 v)
{
    return fabs(v.x) <= RANGE && fabs(v.y) <= RANGE && fabs(v.z) <= RANGE;
}

static void put_planes(float *to, const tahr__facet *f)
{
    const tahr_vec3 *v = f->v, normal = v_scale(f->cross, tahr__lanes_scale(v_dot(f->cross, f->cross)));
    put_vec(to, normal);
    to[(TAHR__LANE_OFFSET - TAHR__LANE_NORMAL) * TAHR__LANES] = (float)v_dot(normal, v[0]);
    to += (TAHR__LANE_EDGE - TAHR__LANE_NORMAL) * TAHR__LANES;
    for (int i = 0; i < 3; i++, to += 4 * TAHR__LANES) {
        tahr_vec3 e = v_sub(v[i < 2 ? i + 1 : 0], v[i]),
                  out = v_scale(v_cross(e, normal), tahr__lanes_scale(v_dot(e, e)));
        put_vec(to, out);
        to[3 * TAHR__LANES] = (float)v_dot(out, v[i]);
    }
}

void tahr__lanes_put(float *blocks, uint32_t i, const tahr_bounds *box, const tahr__facet *facet)
{
    put_vec(blocks + tahr__lane(i, TAHR__LANE_LOW), v_make(d_down(box->min.x), d_down(box->min.y), d_down(box->min.z)));
    put_vec(blocks + tahr__lane(i, TAHR__LANE_HIGH), v_make(d_up(box->max.x), d_up(box->max.y), d_up(box->max.z)));
    if (facet && v_dot(facet->cross, facet->cross) > TAHR__LANE_AREA2 && in_range(facet->v[0]) &&
        in_range(facet->v[1]) && in_range(facet->v[2])) {
        put_planes(blocks + tahr__lane(i, TAHR__LANE_NORMAL), facet);
        return;
    }
    for (uint32_t row = TAHR__LANE_NORMAL; row < TAHR__LANE_ROWS; row++)
        blocks[tahr__lane(i, row)] = 0;
}

void tahr__lanes_end(float *blocks, uint32_t count)
{
    for (; count % TAHR__LANES != 0; count++) {
        float *at = blocks + tahr__lane(count, 0);
        for (uint32_t row = 0; row < TAHR__LANE_ROWS; row++)
            at[row * TAHR__LANES] = row < TAHR__LANE_NORMAL ? NOWHERE : 0;
    }
}

static float larger_1(float a, float b)
{
    return a > b ? a : b;
}

static float box_distance(const tahr__lanes *lanes, uint32_t i, const float lo[3], const float hi[3])
{
    float square[3];
    for (uint32_t a = 0; a < 3; a++) {
        float under = lanes->blocks[tahr__lane(i, TAHR__LANE_LOW + a)] - hi[a];
        float over = lo[a] - lanes->blocks[tahr__lane(i, TAHR__LANE_HIGH + a)];
        float gap = larger_1(larger_1(under, over), 0);
        square[a] = gap * gap;
    }
    return (square[0] + square[1]) + square[2];
}

/* Where a segment is to a triangle: h above its plane, o beyond its farthest edge, and how fast both change. */
typedef struct beside {
    float h, o, h_rate, o_rate;
} beside;

/* By the plane and the farthest edge: seen along that edge the triangle is a ray, and the nearest point of the segment
 * lies h above its line and o beyond its end. The plane through that end across the way to the point separates them,
 * and the distance to it changes evenly. */
static beside beside_of(const tahr__lanes *lanes, uint32_t i, const tahr__lanes_query *q)
{
    const float *s = q->start, *m = q->motion, *at = lanes->blocks + tahr__lane(i, TAHR__LANE_NORMAL);
    float x = at[0], y = at[TAHR__LANES], z = at[2 * TAHR__LANES];
    float height = ((x * s[0] + y * s[1]) + z * s[2]) - at[3 * TAHR__LANES];
    beside b = {.h = larger_1(larger_1(-height, height) - larger_1(-z, z) * q->half, 0)};
    b.h_rate = (x * m[0] + y * m[1]) + z * m[2];
    int below = lanes->blocks[tahr__lane(i, TAHR__LANE_HIGH + 2)] <= q->lowest;
    b.h_rate = height < 0 ? -b.h_rate : b.h_rate;
    for (int k = 0; k < 3; k++) {
        at = lanes->blocks + tahr__lane(i, TAHR__LANE_EDGE + 4 * (uint32_t)k);
        x = at[0], y = at[TAHR__LANES], z = at[2 * TAHR__LANES];
        float out = ((x * s[0] + y * s[1]) + z * s[2]) - at[3 * TAHR__LANES];
        out = out - (below ? z : larger_1(-z, z)) * q->half;
        float rate = (x * m[0] + y * m[1]) + z * m[2];
        b.o_rate = out > b.o ? rate : b.o_rate;
        b.o = larger_1(out, b.o);
    }
    return b;
}

/* Returns the time before which it is out of reach; NEVER. */
static float time_within(const beside *b, float reach)
{
    float away2 = b->h * b->h + b->o * b->o, gap = away2 - reach * sqrtf(away2);
    float closing = -(b->h * b->h_rate + b->o * b->o_rate);
    if (!(gap > 0)) return 0;
    return gap <= closing ? gap / closing : NEVER;
}

static uint32_t cull_1(const tahr__lanes *lanes, const tahr__lanes_query *query, tahr__lanes_found *found)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < lanes->count; i++) {
        if (!(box_distance(lanes, i, query->lo, query->hi) <= query->limit)) continue;
        const beside b = beside_of(lanes, i, query);
        if (!(b.h <= query->reach) && !(b.h + b.h_rate <= query->reach)) continue; /* its plane alone says so */
        float time = time_within(&b, query->reach);
        if (time <= 1) found[kept++] = (tahr__lanes_found){time, i};
    }
    return kept;
}

static uint32_t near_1(const tahr__lanes *lanes, const tahr__lanes_query *query, tahr__lanes_found *found)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < lanes->count; i++) {
        float box2 = box_distance(lanes, i, query->lo, query->hi);
        if (!(box2 <= query->limit)) continue;
        const beside b = beside_of(lanes, i, query);
        float away = sqrtf(larger_1(b.h * b.h + b.o * b.o, box2));
        if (away <= query->reach) found[kept++] = (tahr__lanes_found){away, i};
    }
    return kept;
}

static void measure_1(const tahr__lanes *lanes, const tahr__lanes_query *query, float *far)
{
    for (uint32_t i = 0; i < (lanes->count + TAHR__LANES - 1) / TAHR__LANES * TAHR__LANES; i++) {
        float away2 = box_distance(lanes, i, query->lo, query->hi);
        if (away2 <= query->limit) {
            const beside b = beside_of(lanes, i, query);
            away2 = larger_1(b.h * b.h + b.o * b.o, away2);
        }
        far[i] = sqrtf(away2);
    }
}

static uint32_t pick_1(const float *far, const float *lift, uint32_t count, float most, tahr__lanes_found *found)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        const float away = lift ? far[i] + lift[i] : far[i];
        if (away <= most) found[kept++] = (tahr__lanes_found){away, i};
    }
    return kept;
}

#if defined(__GNUC__)

#include "../common/lane_4.h"

#include "lanes_which.h"

#include "lanes_kernel.h"

#endif

const tahr__lanes_way *tahr__lanes_of(uint32_t way)
{
    static const tahr__lanes_way one = {cull_1, near_1, measure_1, pick_1, "scalar"};
#if defined(__GNUC__)
    static const tahr__lanes_way four = {lanes_cull, lanes_near, lanes_measure, lanes_pick, "four lanes"};
    if (way == TAHR__LANES_FOUR) return &four;
#endif
    if (way == TAHR__LANES_AVX512) return tahr__lanes_of_avx512();
    if (way == TAHR__LANES_AVX2) return tahr__lanes_of_avx2();
    return way == TAHR__LANES_SCALAR ? &one : NULL;
}

const tahr__lanes_way *tahr__lanes_best(uint32_t no_simd)
{
    for (uint32_t i = no_simd ? 0 : TAHR__LANES_WAYS - 1; i > TAHR__LANES_SCALAR; i--) {
        const tahr__lanes_way *way = tahr__lanes_of(i);
        if (way) return way;
    }
    return tahr__lanes_of(TAHR__LANES_SCALAR);
}
