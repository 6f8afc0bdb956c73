/* SPDX-License-Identifier: MIT
 * onward.c: the last straight piece of a slice and the floor under its end in one look. */
#include "onward.h"

#include "answer.h"
#include "floor.h"
#include "foot.h"

static int look(tahr__step *step, vec3 motion, tahr_hit *below)
{
    const tahr_config *c = step->config;
    const tahr__foot *foot = &step->limits->foot;
    const vec3 up = step->state.up, to = add_scaled(step->state.position, motion, 1);
    const tahr_world *world = step->world;
    const tahr_walk walk = {.shape = &step->limits->shape,
                            .foot = &foot->shape,
                            .position = step->state.position,
                            .motion = motion,
                            .foot_position = add_scaled(to, up, foot->offset),
                            .foot_motion = scale(up, -foot_range(c, c->snap_distance)),
                            .up = up,
                            .margin = c->skin,
                            .mask = c->mask};
    uint32_t known = TAHR_WALK_UNKNOWN;
    if (step->queries + 2 > TAHR_MAX_QUERIES_PER_STEP || vec_equal(to, step->state.floor_position)) {
        return 0;
    }
    tahr_status status = world->backend->walk(world->self, &step->context, &walk, below, &known);
    if (status != TAHR_OK || known != TAHR_WALK_KNOWN || !below->blocking || !hit_is_flawless(below)) {
        return 0;
    }
    step->state.position = to;
    step->queries += 2;
    step->report.sweeps += 2;
    return 1;
}

/* From the inside of a face that holds; where it is more than that, there is more around than one look tells. */
static int is_plain(const tahr_floor *f)
{
    const uint32_t face = TAHR_FLOOR_BLOCKING | TAHR_FLOOR_WALKABLE | TAHR_FLOOR_FACE;
    return (f->flags & ~(uint32_t)TAHR_FLOOR_SLOPE) == face && dot(f->normal, f->surface_normal) >= TAHR__ON_FACE;
}

int tahr__go_onward(tahr__step *step, vec3 motion, tahr_hit *below)
{
    return is_plain(&step->state.floor) && backoff_tries(step->onward) &&
           backoff_note(step->onward, look(step, motion, below));
}
