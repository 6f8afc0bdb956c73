/* SPDX-License-Identifier: MIT
 * one_way.c: bodies that are stood on from above and passed from everywhere else. */
#include "../common/one_way.h"

#include "scene.h"

int tahr__ccd_is_one_way(const tahr__ccd_body *body)
{
    return (body->flags & (TAHR_BODY_ONE_WAY | TAHR_BODY_SENSOR)) == TAHR_BODY_ONE_WAY;
}

/* Signed distance at the start; only a drop asks how far beyond the margin it was. */
static double began(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, const tahr__ccd_near *near,
                    double fraction)
{
    tahr__ccd_near start;

    if (fraction == 0) return near->distance;
    if (!(probe->flags & TAHR_SWEEP_DROP)) return probe->margin;
    tahr__ccd_measure(probe, piece, v_make(0, 0, 0), &start);
    return start.distance;
}

static int edge_holds(const tahr__ccd_probe *probe, const tahr__ccd_near *near)
{
    double reach = tahr__core_extent(&probe->core, probe->up) + probe->radius;

    return tahr__one_way_edge_holds(probe->up, probe->motion, -reach - v_dot(near->point, probe->up), probe->margin,
                                    (int)probe->sinks);
}

int tahr__ccd_one_way_blocks(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, const tahr__ccd_near *near,
                             tahr_vec3 face, double fraction, tahr__ccd_one_way *out)
{
    double start, margin = probe->margin;
    int drops = (probe->flags & TAHR_SWEEP_DROP) != 0;

    out->edge = out->sinks = 0;
    if (!tahr__ccd_is_one_way(piece->body) || probe->flags & TAHR_SWEEP_WHOLE) return 1;
    start = began(probe, piece, near, fraction);
    out->edge = tahr__one_way_edge(near->normal, face);
    if (tahr__one_way_blocks(probe->up, near->normal, start, margin, probe->flags) &&
        (!out->edge || edge_holds(probe, near))) {
        return v_dot(probe->motion, near->normal) < -TAHR__CCD_PARALLEL * probe->motion_length;
    }
    int inside = near->distance + probe->radius + piece->radius <= 0;
    out->sinks =
        (drops || (fraction == 0 && start < 0)) && tahr__one_way_sinks(probe->up, near->normal, start, margin, inside);
    return 0;
}
