/* SPDX-License-Identifier: MIT
 * gjk.c: the only file that calls libccd: does the shape, swept from its start over a part of its motion and grown by
 * radius and margin, overlap a convex piece? Sweeping is a Minkowski sum with a segment, so the swept shape is convex,
 * and its support is the shape's plus the motion where that leads along the direction. */
#include "scene.h"

#include <ccd/ccd.h>

/* libccd's default is ULONG_MAX; random, lattice, far and huge inputs need at most some thirty. */
enum { MAX_ITERATIONS = 100 };

typedef struct swept {
    const tahr__core *core;
    double radius;
    tahr_vec3 motion;
    unsigned *calls;
} swept;

typedef struct corners {
    const tahr_vec3 *corner;
    int count;
} corners;

static void support_swept(const void *object, const ccd_vec3_t *dir, ccd_vec3_t *out)
{
    const swept *s = object;
    tahr_vec3 d = v_make(dir->v[0], dir->v[1], dir->v[2]), p = v_make(0, 0, 0);
    double length = v_length(d);

    ++*s->calls;
    for (int i = 0; i < s->core->axis_count; i++)
        p = v_mad(p, s->core->axis[i], v_dot(s->core->axis[i], d) < 0 ? -1 : 1);
    if (length > 0) p = v_mad(p, d, s->radius / length);
    if (v_dot(s->motion, d) > 0) p = v_add(p, s->motion);
    ccdVec3Set(out, p.x, p.y, p.z);
}

static void support_corners(const void *object, const ccd_vec3_t *dir, ccd_vec3_t *out)
{
    const corners *c = object;
    tahr_vec3 d = v_make(dir->v[0], dir->v[1], dir->v[2]);
    int best = 0;

    for (int i = 1; i < c->count; i++) {
        if (v_dot(c->corner[i], d) > v_dot(c->corner[best], d)) best = i;
    }
    ccdVec3Set(out, c->corner[best].x, c->corner[best].y, c->corner[best].z);
}

/* Toward the piece: a start that saves an iteration or two over libccd's fixed x axis, and is as deterministic. */
static void first_direction(const void *object1, const void *object2, ccd_vec3_t *dir)
{
    const corners *c = object2;

    (void)object1;
    ccdVec3Set(dir, c->corner[0].x, c->corner[0].y, c->corner[0].z);
    if (v_dot(c->corner[0], c->corner[0]) < 1e-12) ccdVec3Set(dir, 1, 0, 0);
}

int tahr__ccd_swept_overlap(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, double fraction)
{
    unsigned calls = 0;
    swept s = {&probe->core, probe->radius + probe->margin + piece->radius, v_scale(probe->motion, fraction), &calls};
    corners c = {piece->corner, piece->corner_count};
    ccd_t ccd;
    int overlap;

    CCD_INIT(&ccd);
    ccd.first_dir = first_direction;
    ccd.support1 = support_swept;
    ccd.support2 = support_corners;
    ccd.max_iterations = MAX_ITERATIONS;
    overlap = ccdGJKIntersect(&s, &c, &ccd);
    probe->context->narrow_iterations += calls;
    /* One support before the loop and one in each turn: libccd itself calls giving up "no overlap". */
    return !overlap && calls > MAX_ITERATIONS ? -1 : overlap;
}
