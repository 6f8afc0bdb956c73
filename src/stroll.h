/* SPDX-License-Identifier: MIT
 * stroll.h: a walk from a face that holds to one that holds, with nothing in its way. See short_way.h. */
#ifndef TAHR_STROLL_H
#define TAHR_STROLL_H

#include "answer.h"
#include "floor.h"
#include "ready.h"
#include "short_way.h"

/* Does it walk, upright, on a face that is all there is to know of its floor? */
static inline int begins_on_face(const tahr_mover *mover, const tahr_state *s)
{
    const tahr_floor *f = &s->floor;
    const uint64_t other = (s->floor_revision ^ mover->world->revision) |
                           ((f->flags & ~(uint32_t)TAHR_FLOOR_SLOPE) ^ TAHR__READY_FACE) |
                           other_bits(&s->floor_position, &s->position) | other_bits(&s->up, &mover->pace.held.up);
    return other == 0 && dot(f->normal, f->surface_normal) >= TAHR__ON_FACE &&
           (dot(f->surface_normal, s->up) > TAHR__GENTLE || (f->flags & TAHR_FLOOR_SLOPE));
}

/* How the input's wish is approached. */
static inline void learn_law(tahr_mover *mover, const tahr_input *input, double dt)
{
    tahr__pace *pace = &mover->pace;
    const tahr_config *c = &mover->config;
    tahr__asked *asked = &pace->asked;
    if (other_bits(&asked->move, &input->move)) {
        const vec3 wish = reject(input->move, pace->held.up);
        const double size = length(wish), speed = mover->limits.speed * min_of(size, 1);
        pace->law = tahr__law_of_wish(c, &pace->law.decay, wish, size, speed, 1);
        asked->move = input->move;
        pace->wishes = (uint16_t)law_wishes(&pace->law);
    }
    decay_learn(&pace->law.decay, pace->law.turn_friction, dt);
}

/* dot(v, up), and what is across. That of +z (upright) is a part of it: what else the sums hold are products with zero,
 * which change at most the sign of a zero, and no answer hangs on that. */
static inline double along_up(const tahr__pace *pace, int upright, vec3 v)
{
    return upright ? v.z : dot(v, pace->held.up);
}

static inline vec3 across_up(const tahr__pace *pace, int upright, vec3 v)
{
    return upright ? vec(v.x, v.y, 0) : reject(v, pace->held.up);
}

static inline tahr__motion advance(const tahr__pace *pace, int upright, vec3 v, double dt)
{
    return upright ? law_advance_level(&pace->law, pace->wishes, v.x, v.y, dt)
                   : law_advance(&pace->law, pace->wishes, reject(v, pace->held.up), dt);
}

/* A step up or down a face, which keeps the speed along it. */
static inline vec3 along_face(const tahr__pace *pace, int upright, vec3 level, vec3 n)
{
    const double against = upright ? n.x * level.x + n.y * level.y : dot(n, level), steep = along_up(pace, upright, n);
    if (against == 0 && steep > 0) {
        return level;
    }
    const double rise = -against / steep;
    return rise == 0 ? level : tahr__lift(level, pace->held.up, rise, rise);
}

/* Is that the face that it began on, which needs no second look? Number by number: so they were written, and what was
 * written in parts is waited for when it is read as a whole. */
static inline int is_held(const tahr__held *held, const tahr_hit *hit)
{
    return (other_bits(&hit->normal, &held->normal) | other_bits(&hit->surface_normal, &held->surface_normal)) == 0;
}

/* A face that holds, with normals that need not be made exact? */
static inline int is_good_face(const tahr__pace *pace, int upright, const tahr_hit *hit)
{
    return normal_is_exact(hit->normal) && normal_is_exact(hit->surface_normal) &&
           along_up(pace, upright, hit->surface_normal) >= pace->level &&
           dot(hit->normal, hit->surface_normal) > TAHR__ON_FACE;
}

/* Is what was met under the end of the walk, on a face that holds, well inside of the foot's rim, in the band of
 * clearance, and is nothing about it that hit_is_flawless (answer.h) would not let pass? The point is not far out: it
 * is no farther from the character across up than the rim; nor is the clearance below the band, as the fraction is not
 * below zero. */
static inline int ends_on_it(const tahr__pace *pace, int upright, vec3 position, const tahr_hit *hit, double clearance)
{
    const double z = hit->point.z, most = 0.05 * TAHR__FARTHEST * TAHR__FARTHEST;
    const double away = length(across_up(pace, upright, sub(hit->point, position)));
    const double sum = (hit->distance * hit->distance + hit->walkable_angle * hit->walkable_angle) +
                       (upright ? z * z : length_squared(hit->point));
    const uint32_t odd = hit->start_overlap | hit->unknown | (hit->walkable_rule ^ (uint32_t)TAHR_WALKABLE_DEFAULT);
    return hit->blocking && odd == 0 && sum <= most && pace->rim - away >= pace->tolerance &&
           (hit->fraction > 0 || (hit->fraction == 0 && hit->distance >= pace->skin)) && hit->fraction <= 1 &&
           clearance <= pace->most;
}

/* As tahr__clean_state does; what else there is of the state is clean, or stays as it is. */
static inline void write_end(tahr_state *s, vec3 position, vec3 velocity, const tahr_hit *hit, double clearance)
{
    tahr_floor *f = &s->floor;
    f->flags = TAHR__READY_FACE | floor_still_slope(f, hit);
    f->point = clean(hit->point);
    f->distance = clearance;
    f->body = hit->body;
    f->feature = hit->feature;
    f->surface = hit->surface;
    s->position = s->floor_position = clean(position);
    s->velocity = clean(velocity);
}

/* What is as it was where it was ready and ends on the face that it began on; and remembers it. */
static inline void write_rest(tahr__pace *pace, tahr_state *s, const tahr_hit *hit, double dt)
{
    const tahr_quat q = s->orientation;
    s->floor.normal = clean(hit->normal);
    s->floor.surface_normal = clean(hit->surface_normal);
    s->floor.perch_distance = 0;
    s->orientation = (tahr_quat){q.x + 0.0, q.y + 0.0, q.z + 0.0, q.w + 0.0};
    s->jump_hold = 0;
    memcpy(&pace->held, &s->orientation, sizeof pace->held);
    pace->asked.dt = dt;
}

/* Asks for the walk, and where what was gathered ends once more from there. */
static inline int is_known(tahr_mover *mover, double dt, const tahr_state *state, const tahr_walk *walk,
                           tahr_query_context *context, tahr_hit *hit)
{
    const tahr_world *world = mover->world;
    uint32_t known = TAHR_WALK_UNKNOWN;
    tahr_status status = world->backend->walk(world->self, context, walk, hit, &known);
    if (status == TAHR_OK && known == TAHR_WALK_UNANNOUNCED && tahr__announce_early(mover, dt, state, context)) {
        known = TAHR_WALK_UNKNOWN;
        status = world->backend->walk(world->self, context, walk, hit, &known);
    }
    return status == TAHR_OK && known == TAHR_WALK_KNOWN;
}

/* m2: who goes so far, 3e-8 m, comes to another place: the last bit of the farthest one (2e7 m) is 4e-9 m. */
static const double FAR2 = 1e-15;

/* tahr__stroll. ready: as ready_to_walk says. */
static inline int stroll(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state, tahr_report *report,
                         int ready)
{
    tahr__pace *pace = &mover->pace;
    if (!ready) {
        if (dt <= TAHR__SHORTEST || !begins_on_face(mover, state)) {
            return 0;
        }
        learn_law(mover, input, dt);
    }
    const int upright = ready || pace->upright;
    const tahr__motion m = advance(pace, upright, state->velocity, dt);
    if (m.stop_time >= 0) {
        return 0;
    }
    const vec3 motion = along_face(pace, upright, m.displacement, state->floor.surface_normal);
    const vec3 position = add_scaled(state->position, motion, 1), up = pace->held.up;
    if (length_squared(motion) < FAR2 && tahr__stays(&state->position, &position)) {
        return 0;
    }
    const tahr_walk walk = {.shape = &mover->limits.shape,
                            .foot = &mover->limits.foot.shape,
                            .position = state->position,
                            .motion = motion,
                            .foot_position = add_scaled(position, up, pace->foot),
                            .foot_motion = pace->reach,
                            .up = up,
                            .margin = pace->skin,
                            .mask = pace->mask};
    tahr_query_context context = {.cache = mover->cache};
    tahr_hit hit;
    if (!is_known(mover, dt, state, &walk, &context, &hit)) {
        return 0;
    }
    const double clearance = hit.fraction * pace->range + pace->skin;
    const int same = ready && is_held(&pace->held, &hit);
    if (!(same || is_good_face(pace, upright, &hit)) || !ends_on_it(pace, upright, position, &hit, clearance) ||
        goes_astray(mover, position)) {
        return 0;
    }
    write_end(state, position, m.velocity, &hit, clearance);
    if (!same) {
        write_rest(pace, state, &hit, dt);
    }
    if (context.gathers) {
        mover->gathers = 0;
    }
    tahr__report_short_way(report, 2, TAHR_SHORTCUT_KNOWN_FLOOR, &context);
    return 1;
}

#endif
