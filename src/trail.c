/* SPDX-License-Identifier: MIT
 * trail.c: where the character has been in this step. */
#include "trail.h"

#include "answer.h"

void tahr__trail_begin(tahr__trail *trail, tahr__step *step)
{
    const tahr_state *s = &step->state;
    trail->count = trail->timed = trail->resolved = trail->held = trail->spans = trail->asked = 0;
    trail->current = s->mode == TAHR_MODE_WALKING && s->floor_revision == step->world->revision &&
                     vec_equal(s->floor_position, s->position);
    trail->swept = trail->clear = 0;
    trail->slice = 0;
    trail->at = s->position;
    trail->up = s->up;
    trail->orientation = s->orientation;
    trail->radius = s->radius;
    trail->half_height = s->half_height;
    step->trail = trail;
}

void tahr__trail_swept(tahr__trail *trail, const tahr_sweep *sweep, int clear)
{
    trail->swept = 1;
    trail->clear = clear != 0;
    trail->sweep_from = sweep->position;
    trail->sweep_motion = sweep->motion;
}

/* Does the last sweep cover the way to `to`? A nanometre aside or beyond is rounding. */
static int is_proven(const tahr__trail *trail, vec3 to)
{
    vec3 way = sub(to, trail->at);
    double size2 = length_squared(trail->sweep_motion);
    if (!trail->swept || !trail->clear || size2 == 0 || !vec_equal(trail->sweep_from, trail->at)) {
        return 0;
    }
    double part = clamp(dot(way, trail->sweep_motion) / size2, 0, 1);
    return length_squared(add_scaled(way, trail->sweep_motion, -part)) < 1e-18;
}

void tahr__trail_reach(tahr__step *step)
{
    tahr__trail *trail = step->trail;
    vec3 to = step->state.position;
    if (vec_equal(trail->at, to)) {
        return;
    }
    if (trail->count == TAHR__LEGS) { /* the last leg takes the rest in */
        trail->count--;
        trail->timed = trail->timed < trail->count ? trail->timed : trail->count;
        trail->at = trail->legs[trail->count].from;
        trail->swept = 0;
    }
    tahr__leg *leg = &trail->legs[trail->count++];
    leg->from = trail->at;
    leg->to = to;
    leg->begin = leg->end = 0;
    leg->clear = (uint32_t)is_proven(trail, to);
    leg->ignore_body = step->ignore_body;
    leg->pace = TAHR__PACE_EVEN;
    trail->at = to;
    trail->swept = 0;
}

/* Ways so short that their squares are 0 take no time. */
static double part_of(double gone, double all)
{
    return all > 0 ? gone / all : 1;
}

void tahr__trail_stamp(tahr__step *step, double begin, double end)
{
    tahr__trail *trail = step->trail;
    tahr__trail_reach(step);
    double all = 0, gone = 0;
    if (trail->timed > 0) { /* what came before a stamp took its time */
        begin = min_of(max_of(begin, trail->legs[trail->timed - 1].end), end);
    }
    for (uint32_t i = trail->timed; i < trail->count; i++) {
        all += length(sub(trail->legs[i].to, trail->legs[i].from));
    }
    for (uint32_t i = trail->timed; i < trail->count; i++) {
        tahr__leg *leg = &trail->legs[i];
        leg->begin = begin + (end - begin) * part_of(gone, all);
        gone += length(sub(leg->to, leg->from));
        leg->end = begin + (end - begin) * part_of(gone, all);
    }
    trail->timed = trail->count;
}

static double stretch_time(const tahr__stretch *s, double part)
{
    if (part <= 0 || part >= 1) {
        return s->start + (part <= 0 ? 0 : s->duration);
    }
    return s->start + tahr__law_time(&s->law, s->velocity, s->duration, s->whole, part);
}

void tahr__trail_stamp_walk(tahr__step *step, const tahr__stretch *stretch)
{
    tahr__trail *trail = step->trail;
    tahr__trail_reach(step);
    if (trail->timed == trail->count) {
        return;
    }
    tahr__leg *last = &trail->legs[trail->count - 1];
    last->pace = TAHR__PACE_WALK;
    last->stretch = *stretch;
    last->begin = stretch_time(stretch, stretch->first);
    last->end = stretch_time(stretch, stretch->last);
    for (uint32_t i = trail->timed; i + 1 < trail->count; i++) {
        trail->legs[i].begin = trail->legs[i].end = last->begin;
    }
    trail->timed = trail->count;
}

void tahr__trail_cut(tahr__step *step, vec3 from, double part)
{
    tahr__trail *trail = step->trail;
    tahr__leg *last = trail->count > 0 ? &trail->legs[trail->count - 1] : NULL;
    if (!last || !vec_equal(last->from, from) || !vec_equal(last->to, trail->at)) {
        return;
    }
    double whole = length(sub(last->to, from));
    trail->at = last->to = step->state.position;
    trail->swept = 0;
    if (vec_equal(last->from, last->to)) {
        trail->count--;
        trail->timed = trail->timed < trail->count ? trail->timed : trail->count;
    } else if (last->pace == TAHR__PACE_WALK) {
        last->stretch.last = part;
        last->end = stretch_time(&last->stretch, part);
    } else {
        last->end = last->begin + (last->end - last->begin) * part_of(length(sub(last->to, from)), whole);
    }
}

void tahr__trail_forget(tahr__step *step, uint32_t count)
{
    tahr__trail *trail = step->trail;
    trail->count = count < trail->count ? count : trail->count;
    trail->timed = trail->timed < trail->count ? trail->timed : trail->count;
    trail->at = step->state.position;
    trail->swept = 0;
    if (trail->count > 0) { /* the last one may have taken in what is forgotten now */
        trail->legs[trail->count - 1].to = trail->at;
    }
}

/* From `from` with this velocity and a constant acceleration to `to`: the time, as a part, at which a plane is met that
 * the straight line meets at a fraction. n . v T s + (n . d - n . v T) s^2 = f n . d */
static double fall_part(const tahr__leg *leg, double fraction, vec3 normal)
{
    double rest = dot(normal, sub(leg->to, leg->from));
    double b = dot(normal, leg->velocity) * (leg->end - leg->begin);
    double a = rest - b, c = -fraction * rest;
    double root2 = b * b - 4 * a * c;
    if (!(root2 >= 0)) { /* the arc does not meet it: it bulges by less than its tolerance */
        return fraction;
    }
    double q = -0.5 * (b + (b < 0 ? -sqrt(root2) : sqrt(root2)));
    double one = a != 0 ? q / a : -1, two = q != 0 ? c / q : -1;
    int one_in = one >= 0 && one <= 1, two_in = two >= 0 && two <= 1;
    if (!one_in && !two_in) {
        return fraction;
    }
    double off_one = one > fraction ? one - fraction : fraction - one;
    double off_two = two > fraction ? two - fraction : fraction - two;
    return one_in && (!two_in || off_one <= off_two) ? one : two;
}

double tahr__leg_time(const tahr__leg *leg, double fraction, vec3 normal)
{
    if (leg->pace == TAHR__PACE_WALK) {
        const tahr__stretch *s = &leg->stretch;
        return fraction >= 1 ? leg->end : stretch_time(s, s->first + (s->last - s->first) * fraction);
    }
    double part = leg->pace == TAHR__PACE_FALL ? fall_part(leg, fraction, normal) : fraction;
    return leg->begin + (leg->end - leg->begin) * part;
}

tahr_status tahr__sensing_sweep(tahr__step *step, const tahr_sweep *q, tahr_hit *hit, uint32_t *count)
{
    tahr_hit hits[2];
    uint32_t n = 0;
    tahr_status status = answer_sweep(step->world, &step->context, q, hits, 2, &n);
    *count = status >= 0 && n > 0 && !hits[n - 1].sensor;
    if (*count) {
        *hit = hits[n - 1];
    }
    tahr__trail_swept(step->trail, q, n == *count);
    return status;
}
