/* SPDX-License-Identifier: MIT
 * onward.c: the last straight piece of a slice and the floor under its end in one look. */
#include "onward.h"

#include "answer.h"
#include "foot.h"

int tahr__go_onward(tahr__step *step, vec3 motion, tahr_hit *below)
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
    uint32_t known = 0;
    if (step->queries + 2 > TAHR_MAX_QUERIES_PER_STEP || vec_equal(to, step->state.floor_position)) {
        return 0;
    }
    tahr_status status = world->backend->walk(world->self, &step->context, &walk, below, &known);
    if (status != TAHR_OK || !known || !below->blocking || !hit_is_flawless(below)) {
        return 0;
    }
    step->state.position = to;
    step->queries += 2;
    step->report.sweeps += 2;
    return 1;
}
