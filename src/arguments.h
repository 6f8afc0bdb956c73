/* SPDX-License-Identifier: MIT
 * arguments.h: the checks of what a step is given. */
#ifndef TAHR_ARGUMENTS_H
#define TAHR_ARGUMENTS_H

#include <string.h>

#include "core.h"

/* Does the state remember nothing, from radius on? Then all of that is in order. */
static inline int state_is_blank(const tahr_mover *mover, const tahr_state *s)
{
    const size_t from = offsetof(tahr_state, base);
    const tahr_shape *shape = &mover->config.shape;
    return memcmp(&s->radius, &shape->radius, 2 * sizeof s->radius) == 0 && /* and half_height, in both */
           memcmp((const char *)s + from, (const char *)&tahr__blank + from, sizeof *s - from) == 0;
}

/* Is everything else in order too, and as simple as it almost always is? What is not gets the whole check, which names
 * it. A sum is finite only if all its terms are, and a comparison with a NaN is false. */
static inline int arguments_are_usual(const tahr_mover *mover, const tahr_input *in, double dt, const tahr_state *s,
                                      const tahr_report *report)
{
    const tahr_floor *f = &s->floor;
    const vec3 n = f->normal, m = f->surface_normal, p = f->point, at = s->floor_position;
    const tahr_quat q = s->orientation;
    double turn = (q.x * q.x + q.y * q.y) + (q.z * q.z + q.w * q.w), up = length_squared(s->up);
    double floor = ((n.x + n.y) + (n.z + m.x)) + ((m.y + m.z) + (p.x + p.y)) + ((p.z + at.x) + (at.y + at.z)) +
                   ((f->distance + f->perch_distance) + s->jump_hold);
    uint32_t odd = (in->struct_size ^ (uint32_t)sizeof *in) | in->flags | in->reserved | in->crouch;
    odd |= report ? report->struct_size ^ (uint32_t)sizeof *report : 0u;
    odd |= s->flags & ~(uint32_t)((TAHR_STATE_CRUSHED << 1) - 1);
    return odd == 0 && s->mode <= TAHR_MODE_CUSTOM && mover->config.shape.type != TAHR_SHAPE_BOX && dt >= 0 &&
           dt <= mover->config.max_dt && length_squared(in->move) <= 1e12 && length_squared(s->position) <= 4e14 &&
           length_squared(s->velocity) <= 1e10 && turn > 1 - 1e-6 && turn < 1 + 1e-6 && up > 1 - 1e-9 &&
           up < 1 + 1e-9 && is_finite(floor);
}

/* TAHR_OK, or the first thing that is wrong, which the log has been told. report may be NULL. */
tahr_status tahr__check_arguments(const tahr_mover *mover, const tahr_input *input, double dt, const tahr_state *state,
                                  const tahr_report *report);

#endif
