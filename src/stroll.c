/* SPDX-License-Identifier: MIT
 * stroll.c: a walk from a face that holds to one that holds, with nothing in its way. See short_way.h. */
#include "answer.h"
#include "floor.h"
#include "foot.h"
#include "path.h"
#include "short_way.h"
#include "turning.h"

int tahr__may_go_short_way(const tahr_world *world, const tahr_config *config, const tahr__limits *limits)
{
    return !world_is_planar(world) && !world->has && !limits->feel && !limits->in_plane && limits->usual &&
           config->short_ways && !config->keep_level_speed && config->floor_probe == TAHR_FLOOR_PROBE_WHOLE &&
           limits->shape.type == TAHR_SHAPE_CAPSULE;
}

/* Does it walk on a face that is all there is to know of its floor? */
static int begins_on_face(const tahr_mover *mover, const tahr_state *s)
{
    const tahr_floor *f = &s->floor;
    const uint32_t face = TAHR_FLOOR_BLOCKING | TAHR_FLOOR_WALKABLE | TAHR_FLOOR_FACE;
    return s->floor_revision == mover->world->revision && vec_equal(s->floor_position, s->position) &&
           (f->flags & ~(uint32_t)TAHR_FLOOR_SLOPE) == face && dot(f->normal, f->surface_normal) >= TAHR__ON_FACE &&
           (dot(f->surface_normal, s->up) > TAHR__GENTLE || (f->flags & TAHR_FLOOR_SLOPE)) &&
           is_against_gravity(&mover->limits.pull, s->up);
}

/* The motion of a step up or down the face, which keeps the speed along it; zero: none, or it comes to rest. */
static vec3 motion_of(const tahr_mover *mover, const tahr_input *input, double dt, const tahr_state *s, vec3 *velocity)
{
    const vec3 up = s->up, n = s->floor.surface_normal, wish = reject(input->move, up);
    const double size = length(wish);
    const tahr__law law = tahr__law_of_wish(&mover->config, wish, size, mover->limits.speed * min_of(size, 1), 1);
    const tahr__motion m = tahr__law_advance(&law, reject(s->velocity, up), dt);
    *velocity = m.velocity;
    if (m.stop_time >= 0) {
        return vec(0, 0, 0);
    }
    const double rise = -dot(n, m.displacement) / dot(n, up);
    return rise == 0 ? m.displacement : tahr__lift(m.displacement, up, rise, rise);
}

/* Is what was met under the end a face that holds, well inside of the foot's rim, in the band of clearance? */
static int ends_on_face(const tahr_mover *mover, const tahr_state *s, vec3 position, const tahr_hit *hit,
                        double clearance)
{
    const tahr_config *c = &mover->config;
    const tahr__limits *limits = &mover->limits;
    const vec3 offset = reject(sub(hit->point, position), s->up);
    const double up = dot(hit->surface_normal, s->up);
    const double limit = max_of(max_of(limits->walkable, limits->walkable_hysteresis), 1e-4);
    return hit->blocking && hit->walkable_rule == TAHR_WALKABLE_DEFAULT && up >= limit &&
           dot(hit->normal, hit->surface_normal) > TAHR__ON_FACE &&
           limits->shape.radius + c->skin - length(offset) >= c->edge_tolerance &&
           (hit->fraction > 0 || hit->distance >= c->skin) && clearance >= c->skin - 1e-6 &&
           clearance <= c->floor_max * c->skin;
}

static void write_floor(tahr_floor *f, const tahr_hit *hit, double clearance)
{
    const uint32_t slope = floor_still_slope(f, hit);
    *f = (tahr_floor){.normal = hit->normal,
                      .surface_normal = hit->surface_normal,
                      .point = hit->point,
                      .distance = clearance,
                      .flags = TAHR_FLOOR_BLOCKING | TAHR_FLOOR_WALKABLE | TAHR_FLOOR_FACE | slope,
                      .body = hit->body,
                      .feature = hit->feature,
                      .surface = hit->surface};
}

int tahr__stroll(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state, tahr_report *report)
{
    const tahr_config *c = &mover->config;
    const tahr__foot *foot = &mover->limits.foot;
    if (dt <= TAHR__SHORTEST || !begins_on_face(mover, state)) {
        return 0;
    }
    vec3 velocity, motion = motion_of(mover, input, dt, state, &velocity);
    if (length_squared(motion) == 0) {
        return 0;
    }
    const vec3 position = add_scaled(state->position, motion, 1);
    const double range = foot_range(c, c->snap_distance);
    const tahr_walk walk = {.shape = &mover->limits.shape,
                            .foot = &foot->shape,
                            .position = state->position,
                            .motion = motion,
                            .foot_position = add_scaled(position, state->up, foot->offset),
                            .foot_motion = scale(state->up, -range),
                            .up = state->up,
                            .margin = c->skin,
                            .mask = c->mask};
    tahr_query_context context = {.cache = mover->cache};
    tahr_hit hit;
    uint32_t known = 0;
    tahr_status status = mover->world->backend->walk(mover->world->self, &context, &walk, &hit, &known);
    if (status != TAHR_OK || !known || !hit_is_flawless(&hit)) {
        return 0;
    }
    const double clearance = hit.fraction * range + c->skin;
    if (!ends_on_face(mover, state, position, &hit, clearance) || vec_equal(position, state->position) ||
        goes_astray(mover, position)) {
        return 0;
    }
    write_floor(&state->floor, &hit, clearance);
    state->position = state->floor_position = position;
    state->velocity = velocity;
    state->floor_revision = mover->world->revision;
    tahr__clean_state(state, state);
    tahr__report_short_way(report, 2, &context);
    return 1;
}
