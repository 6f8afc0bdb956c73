/* SPDX-License-Identifier: MIT
 * fence.c: planes between a place and the primitives nearest to it, from their lanes. */
#include "fence.h"

/* Nothing is as near as that. */
#define NOWHERE -1e30f
/* Nearer than this (m) the direction is rounding, and there is no use in a fence. */
#define NEAREST 1e-3f

static float at_of(const float *blocks, uint32_t i, uint32_t row)
{
    return blocks[tahr__lane(i, row)];
}

/* A plane from a row on: x, y, z . p = far. */
typedef struct plane {
    float x, y, z, far;
} plane;

static plane plane_of(const float *blocks, uint32_t i, uint32_t row)
{
    return (plane){at_of(blocks, i, row), at_of(blocks, i, row + 1), at_of(blocks, i, row + 2),
                   at_of(blocks, i, row + 3)};
}

static plane flipped(plane p)
{
    return (plane){-p.x, -p.y, -p.z, -p.far};
}

static float over(const plane *p, const tahr__lanes_query *q)
{
    return ((p->x * q->start[0] + p->y * q->start[1]) + p->z * q->start[2]) - p->far - fabsf(p->z) * q->half;
}

/* Of two planes, what is behind both of them is behind this one too. Returns how far it is. */
static float between(const plane *a, const plane *b, float to_a, float to_b, plane *out)
{
    const float h = to_a > 0 ? to_a : 0, o = to_b > 0 ? to_b : 0, away = sqrtf(h * h + o * o);
    if (!(away > NEAREST)) return 0;
    const float s = h / away, t = o / away;
    *out = (plane){s * a->x + t * b->x, s * a->y + t * b->y, s * a->z + t * b->z, s * a->far + t * b->far};
    return away;
}

/* By the plane of the triangle, and that through its farthest edge across it. */
static float by_planes(const float *blocks, uint32_t i, const tahr__lanes_query *q, plane *out)
{
    const plane n = plane_of(blocks, i, TAHR__LANE_NORMAL), back = flipped(n);
    const float front = over(&n, q), behind = over(&back, q);
    plane edge = plane_of(blocks, i, TAHR__LANE_EDGE);
    float out_of = over(&edge, q);
    for (uint32_t k = 1; k < 3; k++) {
        const plane other = plane_of(blocks, i, TAHR__LANE_EDGE + 4 * k);
        const float beyond = over(&other, q);
        if (beyond > out_of) edge = other, out_of = beyond;
    }
    return front > behind ? between(&n, &edge, front, out_of, out) : between(&back, &edge, behind, out_of, out);
}

/* By its box. */
static float by_box(const float *blocks, uint32_t i, const tahr__lanes_query *q, plane *out)
{
    float gap[3], side[3], away2 = 0;
    for (uint32_t a = 0; a < 3; a++) {
        const float low = at_of(blocks, i, TAHR__LANE_LOW + a), high = at_of(blocks, i, TAHR__LANE_HIGH + a);
        const float under = low - q->hi[a], above = q->lo[a] - high;
        side[a] = above > 0 ? high : low;
        gap[a] = above > 0 ? above : under > 0 ? -under : 0;
        away2 += gap[a] * gap[a];
    }
    const float away = sqrtf(away2);
    if (!(away > NEAREST)) return 0;
    const float x = gap[0] / away, y = gap[1] / away, z = gap[2] / away;
    *out = (plane){x, y, z, (x * side[0] + y * side[1]) + z * side[2]};
    return away;
}

void tahr__fences_clear(tahr__fences *fences)
{
    for (uint32_t i = 0; i < TAHR__FENCES; i++) {
        fences->x[i] = fences->y[i] = fences->z[i] = 0;
        fences->far[i] = NOWHERE;
        fences->of[i] = TAHR__NONE;
    }
}

int tahr__fences_put(tahr__fences *fences, uint32_t i, const tahr__lanes *lanes, uint32_t index,
                     const tahr__lanes_query *at)
{
    plane p;
    if (!(by_planes(lanes->blocks, index, at, &p) > 0) && !(by_box(lanes->blocks, index, at, &p) > 0)) return 0;
    fences->x[i] = p.x;
    fences->y[i] = p.y;
    fences->z[i] = p.z;
    fences->far[i] = p.far;
    fences->of[i] = index;
    return 1;
}

uint32_t tahr__fences_fail(const tahr__fences *fences, tahr_vec3 p, double top, double reach)
{
    const float x = (float)p.x, y = (float)p.y, z = (float)p.z, high = (float)top,
                most = (float)(reach + TAHR__LANE_SLACK);
    uint32_t bits = 0;
    for (int i = 0; i < TAHR__FENCES; i++)
        bits |= (uint32_t)!(tahr__fence_off(fences, i, x, y, z, high) > most) << i;
    return bits;
}
