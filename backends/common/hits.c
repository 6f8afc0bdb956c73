/* SPDX-License-Identifier: MIT
 * hits.c: the order of what a sweep met. */
#include "hits.h"

#include <string.h>

/* The way (m) on which surfaces are met at once: ten times what the core distance is off by. */
#define HAIR 1e-8

void tahr__hits_begin(tahr__hits *hits, double motion_length)
{
    hits->hair = motion_length > 0 ? HAIR / motion_length : 0;
    hits->sensor_count = hits->lost = hits->found = hits->reserved = 0;
}

void tahr__hit_of(const tahr__surface *surface, tahr_hit *hit)
{
    memset(hit, 0, sizeof *hit);
    hit->sensor = (surface->flags & TAHR_BODY_SENSOR) != 0;
    hit->blocking = !hit->sensor;
    hit->walkable_rule = surface->walkable_rule;
    hit->walkable_angle = surface->walkable_angle;
    hit->surface = surface->surface;
    hit->body = surface->id;
}

/* Of sensors: depth is no order, for it is another one at every place. */
static int answered_before(const tahr_hit *a, const tahr_hit *b)
{
    if (a->fraction != b->fraction) return a->fraction < b->fraction;
    return a->body != b->body ? a->body < b->body : a->feature < b->feature;
}

int tahr__hit_before(const tahr_hit *a, const tahr_hit *b)
{
    if (a->start_overlap != b->start_overlap) return a->start_overlap > b->start_overlap;
    if (a->start_overlap && a->depth != b->depth) return a->depth > b->depth;
    return answered_before(a, b);
}

static void keep_sensor(tahr__hits *s, const tahr_hit *hit)
{
    uint32_t i = 0;

    while (i < s->sensor_count && s->sensors[i].body != hit->body)
        i++;
    if (i < s->sensor_count) {
        if (tahr__hit_before(hit, &s->sensors[i])) s->sensors[i] = *hit;
    } else if (i < TAHR__MAX_SENSORS) {
        s->sensors[s->sensor_count++] = *hit;
    } else {
        uint32_t last = 0;
        for (i = 1; i < TAHR__MAX_SENSORS; i++) {
            if (answered_before(&s->sensors[last], &s->sensors[i])) last = i;
        }
        if (answered_before(hit, &s->sensors[last])) s->sensors[last] = *hit;
        s->lost = 1;
    }
}

/* Which of two surfaces that are met at once comes first is rounding: the lower name does, at the earlier time. */
static void keep_tie(tahr__hits *s, const tahr_hit *hit)
{
    double first = d_min(hit->fraction, s->best.fraction);
    tahr_hit other = *hit;

    other.fraction = s->best.fraction = first;
    if (tahr__hit_before(&other, &s->best)) s->best = other;
}

void tahr__hits_keep(tahr__hits *s, const tahr_hit *hit)
{
    if (hit->sensor) {
        keep_sensor(s, hit);
    } else if (s->found && !hit->start_overlap && !s->best.start_overlap &&
               fabs(hit->fraction - s->best.fraction) <= s->hair) {
        keep_tie(s, hit);
    } else if (!s->found || tahr__hit_before(hit, &s->best)) {
        s->best = *hit;
        s->found = 1;
    }
}

double tahr__hits_limit(const tahr__hits *s)
{
    if (!s->found) return 1;
    return s->best.start_overlap ? -1 : d_min(1, s->best.fraction + s->hair + 1e-12);
}

tahr_status tahr__hits_write(const tahr__hits *s, tahr_hit *out, uint32_t capacity, uint32_t *count)
{
    uint32_t room = s->found && capacity > 0 ? capacity - 1 : capacity;
    int lost = s->lost && capacity > 1;

    *count = 0;
    for (uint32_t i = 0; i < s->sensor_count; i++) {
        tahr_hit hit = s->sensors[i];
        uint32_t at = *count;
        if (s->found && hit.fraction > s->best.fraction) continue;
        lost |= at == room;
        if (at == room && (room == 0 || !answered_before(&hit, &out[room - 1]))) continue;
        if (at == room)
            at = room - 1;
        else
            ++*count;
        for (; at > 0 && answered_before(&hit, &out[at - 1]); at--)
            out[at] = out[at - 1];
        out[at] = hit;
    }
    if (s->found && capacity > 0) out[(*count)++] = s->best;
    return lost ? TAHR_TRUNCATED : TAHR_OK;
}
