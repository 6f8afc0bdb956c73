/* SPDX-License-Identifier: MIT
 * one_way.c: one-way bodies on the way of a sweep. */
#include "one_way.h"

#include "hits.h"

int tahr__one_way_met(tahr__one_way_sweep *s, const tahr__one_way_meeting *m)
{
    int asks = (s->flags & TAHR_SWEEP_DROP) || (m->fraction == 0 && m->start < 0);
    int edge = tahr__one_way_edge(m->normal, m->face);
    double below = -s->low - v_dot(m->point, s->up);

    if (s->flags & TAHR_SWEEP_WHOLE) return 1;
    if (tahr__one_way_blocks(s->up, m->normal, m->start, s->margin, s->flags) &&
        (!edge || tahr__one_way_edge_holds(s->up, s->motion, below, s->margin, (int)s->sunk))) {
        if (!tahr__approaches(s->motion, s->motion_length, m->normal)) return 0;
        s->edged |= (uint32_t)edge;
        return 1;
    }
    s->sinks |= (uint32_t)(asks && tahr__one_way_sinks(s->up, m->normal, m->start, s->margin, (int)m->inside));
    return 0;
}
