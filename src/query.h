/* SPDX-License-Identifier: MIT
 * query.h: the questions of a step. What is asked is counted and capped; answers come checked (answer.h). */
#ifndef TAHR_QUERY_H
#define TAHR_QUERY_H

#include "core.h"

/* Sweeps `shape` of this character from `from` by `motion`, keeping `margin`. [out] hit: blocking 0 or 1, always filled
 * in. When the step has failed or used up its queries the answer is "blocked at fraction 0". One sweep. */
void tahr__sweep(tahr__step *step, const tahr_shape *shape, vec3 from, vec3 motion, double margin, uint32_t flags,
                 tahr_hit *hit);

/* Of a sweep that is not asked, because it is known that it blocks at once: counts as one of those that a step may ask,
 * so that the cap is reached where it is with config.barred_steps 0, and as saved by that shortcut. */
void tahr__sweep_barred(tahr__step *step);

/* The sensors that the character's shape passes on a motion or is inside of, the first contact with each, ordered by
 * (start_overlap, fraction, body): what start_overlap says it was inside of at the start. Returns the count. One sweep,
 * on top of those that a step may ask. */
uint32_t tahr__sensors(tahr__step *step, vec3 from, vec3 motion, uint32_t ignore_body, tahr_hit *hits,
                       uint32_t capacity);

/* Everything within margin of the character's shape at `position`, without sensors. Returns the count, at most
 * capacity. One contact query. */
uint32_t tahr__contacts(tahr__step *step, vec3 position, double margin, tahr_contact *contacts, uint32_t capacity);

/* The same for another shape of the character. */
uint32_t tahr__contacts_of(tahr__step *step, const tahr_shape *shape, vec3 position, double margin,
                           tahr_contact *contacts, uint32_t capacity);

/* The first thing between origin and origin + motion. One ray. */
void tahr__ray(tahr__step *step, vec3 origin, vec3 motion, tahr_hit *hit);

/* How deep the character's shape is in a fluid at `position`; all zero where there is none, and where there cannot be
 * any in this world (then no query). One fluid query. */
tahr_fluid tahr__fluid(tahr__step *step, vec3 position);

/* May there be a fluid anywhere in this world? */
static inline int step_has_fluids(const tahr__step *step)
{
    return (step->world->has & TAHR__HAS_FLUIDS) != 0;
}

/* Does the backend sweep such a shape? */
int tahr__can_sweep(const tahr_world *world, const tahr_shape *shape);
/* Says why not. Returns TAHR_E_UNSUPPORTED. */
tahr_status tahr__cannot_sweep(const tahr_world *world, const char *function, const tahr_shape *shape);

/* Tells the backend where this step is expected to ask. No query. */
void tahr__announce(tahr__step *step, const tahr_prepare *announcement);

#endif
