/* SPDX-License-Identifier: MIT
 * stroll.c: a walk from a face that holds to one that holds, with nothing in its way. See short_way.h. */
#include "stroll.h"

#include "foot.h"

int tahr__may_go_short_way(const tahr_world *world, const tahr_config *config, const tahr__limits *limits)
{
    return world->backend->walk && !world_is_planar(world) && !limits->in_plane && limits->usual &&
           config->short_ways && !config->keep_level_speed && config->floor_probe == TAHR_FLOOR_PROBE_WHOLE &&
           limits->shape.type == TAHR_SHAPE_CAPSULE;
}

tahr__pace tahr__pace_of(const tahr_config *c, const tahr__limits *limits)
{
    const tahr__decay unknown = {0, 0};
    const vec3 up = limits->pull.size > 0 ? clean(limits->pull.up) : vec(0, 0, 1);
    tahr__pace pace = {.asked = {.struct_size = sizeof(tahr_input), .dt = c->max_dt},
                       .bare = {.radius = limits->shape.radius,
                                .half_height = limits->shape.half_height,
                                .body = tahr__blank.base.body},
                       .held = {.orientation = {0, 0, 0, 1}, .up = up, .mode = TAHR__NOTHING_HELD},
                       .reach = scale(up, -foot_range(c, c->snap_distance)),
                       .range = foot_range(c, c->snap_distance),
                       .skin = c->skin,
                       .foot = limits->foot.offset,
                       .most = c->floor_max * c->skin,
                       .rim = limits->shape.radius + c->skin,
                       .tolerance = c->edge_tolerance,
                       .level = max_of(max_of(limits->walkable, limits->walkable_hysteresis), 1e-4),
                       .mask = c->mask,
                       .upright = up.z == 1 && up.x == 0 && up.y == 0,
                       .law = tahr__law_of_wish(c, &unknown, vec(0, 0, 0), 0, 0, 1),
                       .max_dt = c->max_dt,
                       .special = limits->in_plane || !shape_is_round(&limits->shape)};
    return pace;
}

int tahr__stays(const tahr_vec3 *from, const tahr_vec3 *to)
{
    return vec_equal(*from, *to);
}

int tahr__stroll(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state, tahr_report *report)
{
    return stroll(mover, input, dt, state, report, 0);
}
