/* SPDX-License-Identifier: MIT
 * scope.h: FScopedMovementUpdate: motions that may turn out not to have happened. Opened before them; reverted,
 * nothing of them is left but what they asked: neither where they led, nor their events, nor the sensors on the way. A
 * scope that is not reverted needs no closing. Scopes nest: the inner one is reverted or left before the outer one. */
#ifndef TAHR_SCOPE_H
#define TAHR_SCOPE_H

#include "trail.h"

/* What a motion writes. Small: every slice of walking opens one. */
typedef struct tahr__scope {
    vec3 position, velocity, floor_position;
    uint64_t floor_revision;
    tahr_floor floor;
    uint32_t state_flags, report_flags;
    uint32_t event_count, events_lost, slides, arcs, legs;
    uint32_t just_teleported;
    double step_offset, residual, ahead;
} tahr__scope;

static inline void tahr__scope_open(tahr__step *step, tahr__scope *scope)
{
    const tahr_state *s = &step->state;
    const tahr_report *r = &step->report;
    scope->position = s->position;
    scope->velocity = s->velocity;
    scope->floor_position = s->floor_position;
    scope->floor_revision = s->floor_revision;
    scope->floor = s->floor;
    scope->state_flags = s->flags;
    scope->report_flags = r->flags;
    scope->event_count = r->event_count;
    scope->events_lost = r->events_lost;
    scope->slides = r->slides;
    scope->arcs = r->arcs;
    scope->step_offset = r->step_offset;
    scope->residual = r->residual;
    scope->just_teleported = step->just_teleported;
    scope->ahead = step->ahead;
    if (step->trail) {
        tahr__trail_reach(step);
        step->trail->held = 1;
        scope->legs = step->trail->count;
    }
}

/* RevertMove: puts back what was when the scope was opened, bit for bit. What queries said of themselves (undecided,
 * capped, recorded) stays, and so does what was spent of the step's depenetration. */
void tahr__scope_revert(tahr__step *step, const tahr__scope *scope);

#endif
