/* SPDX-License-Identifier: MIT
 * stroll.c: a walk from a face that holds to one that holds, with nothing in its way. See short_way.h. */
#include "answer.h"
#include "floor.h"
#include "foot.h"
#include "path.h"
#include "shape.h"
#include "short_way.h"
#include "turning.h"

int tahr__may_go_short_way(const tahr_world *world, const tahr_config *config, const tahr__limits *limits)
{
    return world->backend->walk && !world_is_planar(world) && !world->has && !limits->feel && !limits->in_plane && limits->usual &&
           config->short_ways && !config->keep_level_speed && config->floor_probe == TAHR_FLOOR_PROBE_WHOLE &&
           limits->shape.type == TAHR_SHAPE_CAPSULE;
}

tahr__pace tahr__pace_of(const tahr_config *c, const tahr__limits *limits)
{
    const tahr__decay unknown = {0, 0};
    tahr__pace pace = {.up = limits->pull.size > 0 ? clean(limits->pull.up) : vec(0, 0, 1),
                       .max_dt = c->max_dt,
                       .special = limits->in_plane || !shape_is_round(&limits->shape),
                       .mask = c->mask,
                       .foot = limits->foot.offset,
                       .range = foot_range(c, c->snap_distance),
                       .skin = c->skin,
                       .most = c->floor_max * c->skin,
                       .rim = limits->shape.radius + c->skin,
                       .tolerance = c->edge_tolerance,
                       .level = max_of(max_of(limits->walkable, limits->walkable_hysteresis), 1e-4),
                       .law = tahr__law_of_wish(c, &unknown, vec(0, 0, 0), 0, 0, 1)};
    return pace;
}

/* Does it walk, upright, on a face that is all there is to know of its floor? */
static inline int begins_on_face(const tahr_mover *mover, const tahr_state *s)
{
    const tahr_floor *f = &s->floor;
    const uint32_t face = TAHR_FLOOR_BLOCKING | TAHR_FLOOR_WALKABLE | TAHR_FLOOR_FACE;
    const uint64_t other = (s->floor_revision ^ mover->world->revision) | ((f->flags & ~(uint32_t)TAHR_FLOOR_SLOPE) ^ face) |
                           other_bits(&s->floor_position, &s->position) | other_bits(&s->up, &mover->pace.up);
    return other == 0 && dot(f->normal, f->surface_normal) >= TAHR__ON_FACE &&
           (dot(f->surface_normal, s->up) > TAHR__GENTLE || (f->flags & TAHR_FLOOR_SLOPE));
}

/* How the input's wish is approached; up is that of the pace. */
static inline const tahr__law *law_of(tahr_mover *mover, const tahr_input *input, double dt, vec3 up)
{
    tahr__pace *pace = &mover->pace;
    const tahr_config *c = &mover->config;
    if (other_bits(&pace->move, &input->move)) {
        const vec3 wish = reject(input->move, up);
        const double size = length(wish), asked = mover->limits.speed * min_of(size, 1);
        pace->law = tahr__law_of_wish(c, &pace->law.decay, wish, size, asked, 1);
        pace->move = input->move;
        pace->wishes = (uint32_t)law_wishes(&pace->law);
    }
    decay_learn(&pace->law.decay, pace->law.turn_friction, dt);
    return &pace->law;
}

/* A step up or down a face, which keeps the speed along it. */
static inline vec3 along_face(vec3 level, vec3 n, vec3 up)
{
    const double against = dot(n, level), steep = dot(n, up);
    if (against == 0 && steep > 0) {
        return level;
    }
    const double rise = -against / steep;
    return rise == 0 ? level : tahr__lift(level, up, rise, rise);
}

/* Is what was met under the end a face that holds, well inside of the foot's rim, in the band of clearance? */
static inline int ends_on_face(const tahr__pace *pace, vec3 position, const tahr_hit *hit, double clearance)
{
    const vec3 offset = reject(sub(hit->point, position), pace->up);
    return hit->blocking && hit->walkable_rule == TAHR_WALKABLE_DEFAULT &&
           dot(hit->surface_normal, pace->up) >= pace->level &&
           dot(hit->normal, hit->surface_normal) > TAHR__ON_FACE && pace->rim - length(offset) >= pace->tolerance &&
           (hit->fraction > 0 || hit->distance >= pace->skin) && clearance >= pace->skin - 1e-6 &&
           clearance <= pace->most;
}

/* As tahr__clean_state does; up is clean, and what else there is of the floor stays. */
static inline void write_end(tahr_state *s, vec3 position, vec3 velocity, const tahr_hit *hit, double clearance)
{
    tahr_floor *f = &s->floor;
    const tahr_quat q = s->orientation;
    f->flags = (uint32_t)(TAHR_FLOOR_BLOCKING | TAHR_FLOOR_WALKABLE | TAHR_FLOOR_FACE) | floor_still_slope(f, hit);
    f->normal = clean(hit->normal);
    f->surface_normal = clean(hit->surface_normal);
    f->point = clean(hit->point);
    f->distance = clearance;
    f->perch_distance = 0;
    f->body = hit->body;
    f->feature = hit->feature;
    f->surface = hit->surface;
    s->position = s->floor_position = clean(position);
    s->velocity = clean(velocity);
    s->orientation = (tahr_quat){q.x + 0.0, q.y + 0.0, q.z + 0.0, q.w + 0.0};
    s->jump_hold = 0;
}

int tahr__stroll(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state, tahr_report *report)
{
    const tahr__pace *pace = &mover->pace;
    if (dt <= TAHR__SHORTEST || !begins_on_face(mover, state)) {
        return 0;
    }
    const vec3 up = state->up;
    const tahr__law *law = law_of(mover, input, dt, up);
    const tahr__motion m = law_advance(law, pace->wishes != 0, reject(state->velocity, up), dt);
    if (m.stop_time >= 0) {
        return 0;
    }
    const vec3 motion = along_face(m.displacement, state->floor.surface_normal, up);
    const vec3 position = add_scaled(state->position, motion, 1);
    if (vec_equal(position, state->position)) {
        return 0;
    }
    const tahr_walk walk = {.shape = &mover->limits.shape,
                            .foot = &mover->limits.foot.shape,
                            .position = state->position,
                            .motion = motion,
                            .foot_position = add_scaled(position, up, pace->foot),
                            .foot_motion = scale(up, -pace->range),
                            .up = up,
                            .margin = pace->skin,
                            .mask = pace->mask};
    tahr_query_context context = {.cache = mover->cache};
    tahr_hit hit;
    uint32_t known = 0;
    tahr_status status = mover->world->backend->walk(mover->world->self, &context, &walk, &hit, &known);
    if (status != TAHR_OK || !known || !hit_is_flawless(&hit)) {
        return 0;
    }
    const double clearance = hit.fraction * pace->range + pace->skin;
    if (!ends_on_face(pace, position, &hit, clearance) || goes_astray(mover, position)) {
        return 0;
    }
    write_end(state, position, m.velocity, &hit, clearance);
    tahr__report_short_way(report, 2, &context);
    return 1;
}
