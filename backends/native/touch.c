/* SPDX-License-Identifier: MIT
 * touch.c: the point of a contact that is a line.
 *
 * The side of an upright capsule and an upright face or edge touch along a line, and any point of it is the nearest.
 * Which of them the distance finds first is no better than another. Told is the one nearest to the middle of the shape:
 * there something pushes that pushes along the whole line, and what is touched so high still bars the way to who is
 * raised (src/step_up.c), which need not be asked then. */
#include "scene.h"

/* Cosine to up: a normal that leans by more touches at an end. Along half of a shape of 1.1 m it takes the point 6 um
 * from where the distance is least, and walls lean by the rounding of their corners in single precision. */
#define LEVEL 1e-5

/* The way up (down) along a face from a point of it, as far as it is on the face. The normal is unit and nearly
 * level. */
static tahr_vec3 along_face(const tahr__facet *f, const tahr__witness *w, double rise)
{
    const tahr_vec3 up = v_make(-w->normal.x * w->normal.z, -w->normal.y * w->normal.z, 1), n = f->cross;
    double part = 1;
    for (int i = 0; i < 3; i++) {
        tahr_vec3 inward = v_cross(n, v_sub(f->v[(i + 1) % 3], f->v[i]));
        double here = d_max(v_dot(inward, v_sub(w->point, f->v[i])), 0), change = rise * v_dot(inward, up);
        if (here + change < 0) part = d_min(part, here / -change);
    }
    return v_mad(w->point, up, part * rise);
}

/* The same along an edge; along one that is not upright nothing. */
static tahr_vec3 along_edge(const tahr__facet *f, const tahr__witness *w, double rise)
{
    const uint32_t i = w->feature - TAHR__EDGE;
    const tahr_vec3 a = f->v[i], b = f->v[(i + 1) % 3], e = v_sub(b, a);
    if (e.x * e.x + e.y * e.y > LEVEL * LEVEL * e.z * e.z) return w->point;
    const double room = rise > 0 ? d_max(a.z, b.z) - w->point.z : w->point.z - d_min(a.z, b.z);
    const double way = d_min(fabs(rise), d_max(room, 0));
    return v_mad(w->point, e, (rise > 0 ? way : -way) / e.z);
}

tahr_vec3 tahr__touch_middle(const tahr__prim *prim, const tahr__witness *w, tahr_vec3 centre)
{
    const double rise = centre.z - w->point.z;
    const uint32_t other = TAHR__ITEM_SOLID | TAHR__ITEM_ROUND;
    if ((prim->item & other) || !(w->distance > 0) || fabs(w->normal.z) > LEVEL || rise == 0) return w->point;
    if (w->feature == TAHR__FACE) return along_face(&prim->facet, w, rise);
    return w->feature < TAHR__CORNER ? along_edge(&prim->facet, w, rise) : w->point;
}
