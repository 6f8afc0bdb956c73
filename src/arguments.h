/* SPDX-License-Identifier: MIT
 * arguments.h: the checks of what a step is given. */
#ifndef TAHR_ARGUMENTS_H
#define TAHR_ARGUMENTS_H

#include <string.h>

#include "core.h"
#include "shape.h"
#include "words.h"

/* Does the state remember nothing, from radius on? Then all of that is in order. */
static inline tahr__words other_memory(const tahr_state *s, const tahr__bare *bare)
{
    static const tahr_state blank = TAHR__BLANK; /* known here: most of it is zero, and need not be read */
    const size_t at = offsetof(tahr_state, radius), rest = at + sizeof *bare;
    _Static_assert(offsetof(tahr_state, base.pose.position.y) == offsetof(tahr_state, radius) + sizeof(tahr__bare),
                   "so much of a state is bare");
    return words_or(other_words(&s->radius, bare, sizeof *bare),
                    other_words((const char *)s + rest, (const char *)&blank + rest, sizeof *s - rest));
}

static inline int state_is_blank(const tahr_mover *mover, const tahr_state *s)
{
    return words_are_zero(other_memory(s, &mover->pace.bare));
}

/* Is everything else in order too, and as simple as it almost always is? What is not gets the whole check, which names
 * it. Sums of squares hide nothing, and a comparison with a NaN is false. */
static inline int arguments_are_usual(const tahr_mover *mover, const tahr_input *in, double dt, const tahr_state *s,
                                      const tahr_report *report)
{
    const tahr_floor *f = &s->floor;
    const tahr_quat q = s->orientation;
    double turn = (q.x * q.x + q.y * q.y) + (q.z * q.z + q.w * q.w);
    double lean = other_bits(&s->up, &mover->pace.held.up) ? length_squared(s->up) - 1 : 0;
    double places = (length_squared(s->position) + length_squared(s->floor_position)) + length_squared(f->point);
    places += f->distance * f->distance + f->perch_distance * f->perch_distance;
    double speeds = length_squared(s->velocity) + length_squared(in->move);
    speeds += in->flags ? length_squared(in->facing) : 0;
    double normals = length_squared(f->normal) + length_squared(f->surface_normal);
    uint32_t odd = (in->struct_size ^ (uint32_t)sizeof *in) | (in->flags & ~(uint32_t)TAHR_INPUT_FACING) |
                   in->reserved | in->crouch;
    odd |= mover->pace.special | (report ? report->struct_size ^ (uint32_t)sizeof *report : 0u);
    odd |= s->flags & ~(uint32_t)((TAHR_STATE_CRUSHED << 1) - 1);
    double off = (turn - 1) * (turn - 1) + lean * lean; /* of the units from unit length, squared */
    normals -= f->flags ? 2 : 0;                        /* zero where there is no floor */
    return odd == 0 && s->mode <= TAHR_MODE_CUSTOM && dt >= 0 && dt <= mover->pace.max_dt && places <= 4e14 &&
           speeds <= 1e10 && off + normals * normals <= 1e-18 && s->jump_hold == 0;
}

/* TAHR_OK, or the first thing that is wrong, which the log has been told. report may be NULL. */
tahr_status tahr__check_arguments(const tahr_mover *mover, const tahr_input *input, double dt, const tahr_state *state,
                                  const tahr_report *report);

#endif
