/* SPDX-License-Identifier: MIT
 * gjk.c: the only file that calls libccd: does the shape, swept from its start over a part of its motion and grown by
 * radius and margin, overlap a convex piece? Sweeping is a Minkowski sum with a segment, so the swept shape is convex,
 * and its support is the shape's plus the motion where that leads along the direction. */
#include "scene.h"

#include <ccd/ccd.h>

/* MPR ends where a portal moves by less than this (m): well inside of the bracket that bisection leaves. libccd's 1e-4
 * is not. */
#define MPR_TOLERANCE 1e-9

typedef struct swept {
    const tahr__convex *shape;
    double radius;
    tahr_vec3 motion;
    uint32_t *calls;
    uint32_t most;
} swept;

/* MPR has no cap of its own. Past it the shape is told to lie against every direction, which its loops take for an end:
 * no support beyond the origin, no overlap. */
static int is_over(const swept *s)
{
    return *s->calls > s->most;
}

static void support_swept(const void *object, const ccd_vec3_t *dir, ccd_vec3_t *out)
{
    const swept *s = object;
    tahr_vec3 d = v_make(dir->v[0], dir->v[1], dir->v[2]), p;
    double length = v_length(d);

    ++*s->calls;
    p = tahr__convex_support(s->shape, d, NULL);
    if (length > 0) p = v_mad(p, d, s->radius / length);
    if (v_dot(s->motion, d) > 0) p = v_add(p, s->motion);
    if (is_over(s) && length > 0) p = v_scale(d, -1e9 / length);
    ccdVec3Set(out, p.x, p.y, p.z);
}

static void support_piece(const void *object, const ccd_vec3_t *dir, ccd_vec3_t *out)
{
    tahr_vec3 p = tahr__convex_support(object, v_make(dir->v[0], dir->v[1], dir->v[2]), NULL);
    ccdVec3Set(out, p.x, p.y, p.z);
}

static tahr_vec3 centre_of(const tahr__convex *c)
{
    tahr_vec3 sum = v_make(0, 0, 0);
    if (c->kind != TAHR__CONVEX_POINTS) return c->centre;
    for (uint32_t i = 0; i < c->count; i++)
        sum = v_mad(sum, c->points[i], c->scale / c->count);
    return v_add(c->centre, c->turn ? m_apply(c->turn, sum) : sum);
}

static void centre_swept(const void *object, ccd_vec3_t *out)
{
    const swept *s = object;
    tahr_vec3 p = v_mad(centre_of(s->shape), s->motion, 0.5);
    ccdVec3Set(out, p.x, p.y, p.z);
}

static void centre_piece(const void *object, ccd_vec3_t *out)
{
    tahr_vec3 p = centre_of(object);
    ccdVec3Set(out, p.x, p.y, p.z);
}

/* Toward the piece: a start that saves an iteration or two over libccd's fixed x axis, and is as deterministic. */
static void first_direction(const void *object1, const void *object2, ccd_vec3_t *dir)
{
    tahr_vec3 p = centre_of(object2);

    (void)object1;
    ccdVec3Set(dir, p.x, p.y, p.z);
    if (v_dot(p, p) < 1e-12) ccdVec3Set(dir, 1, 0, 0);
}

int tahr__ccd_swept_overlap(const tahr__piece_query *q, const tahr__piece *piece, double fraction)
{
    const tahr__ccd_scene *scene = tahr__ccd_scene_of(q);
    uint32_t calls = 0;
    tahr__convex_side shape, side;
    ccd_t ccd;
    int overlap;

    tahr__shape_side(&q->shape, v_make(0, 0, 0), &shape);
    tahr__piece_side(piece, &side);
    swept s = {&shape.convex, q->shape.radius + q->margin + piece->radius, v_scale(q->motion, fraction), &calls,
               scene->max_iterations};
    CCD_INIT(&ccd);
    ccd.first_dir = first_direction;
    ccd.support1 = support_swept;
    ccd.support2 = support_piece;
    ccd.center1 = centre_swept;
    ccd.center2 = centre_piece;
    ccd.max_iterations = scene->max_iterations;
    ccd.mpr_tolerance = MPR_TOLERANCE;
    overlap = (scene->boolean == TAHR_CCD_BOOLEAN_MPR ? ccdMPRIntersect : ccdGJKIntersect)(&s, &side.convex, &ccd);
    q->context->narrow_iterations += calls;
    /* libccd itself calls giving up "no overlap". */
    return calls > s.most ? -1 : overlap;
}
