/* SPDX-License-Identifier: MIT
 * neighbours.c: half-spaces as obstacles: what a sweep and a contact query answer of them, in closed form.
 *
 * A shape touches a half-space with its support point, wherever it is: distance, time of impact and depth are one
 * support function and one division. So other characters cost a step no query. */
#include "neighbours.h"

#include <string.h>

#include "move.h"
#include "plane.h"
#include "query.h"
#include "support.h"
#include "trail.h"

/* m; who is deeper in another character at the begin of a step is pushed out. Less is rounding of where they are. */
static const double TOUCHING = 1e-7;

/* m from a shape at a place to the surface; once it is beyond the plane in front of that, to the plane: negative. */
static double distance_to(const tahr__neighbours *n, const tahr__neighbour *plane, const tahr__solid *solid, vec3 at)
{
    vec3 down = scale(plane->normal, -1);
    double d = dot(plane->normal, sub(at, n->anchor)) - tahr__support(solid, down) - plane->offset;
    return d < plane->behind ? d - plane->behind : d;
}

static void fill(tahr_hit *hit, const tahr__neighbours *n, const tahr__neighbour *plane)
{
    memset(hit, 0, sizeof *hit);
    hit->blocking = 1;
    hit->normal = hit->surface_normal = plane->normal;
    hit->walkable_rule = n->walkable_rule;
    hit->body = plane->body;
}

/* Does the answer so far come before a hit at this fraction, or in an overlap of this depth? What the world says goes
 * first where they are equal: its bodies have the smaller numbers. */
static int stays(const tahr_hit *hit, uint32_t count, double fraction, double depth)
{
    if (count == 0) {
        return 0;
    }
    if (hit->start_overlap || depth > 0) {
        return hit->start_overlap && hit->depth >= depth;
    }
    return hit->fraction <= fraction;
}

/* One half-space. d: distance at the start. */
static void meet(const tahr__neighbours *n, const tahr__neighbour *plane, const tahr_sweep *q, double d, tahr_hit *hit,
                 uint32_t *count)
{
    const double closing = -dot(plane->normal, q->motion), margin = max_of(q->margin, plane->behind);
    const int overlaps = d < -TOUCHING;
    double fraction = 0;
    if (overlaps ? closing <= 0 && (q->flags & TAHR_SWEEP_LEAVE_OVERLAP) : closing <= 0) {
        return;
    }
    if (d > margin) {
        if (d - margin > closing) {
            return;
        }
        fraction = min_of((d - margin) / closing, 1);
    }
    if (stays(hit, *count, fraction, overlaps ? -d : 0)) {
        return;
    }
    const tahr__solid solid = {&q->shape, q->up, q->orientation};
    const vec3 down = scale(plane->normal, -1);
    fill(hit, n, plane);
    hit->start_overlap = (uint32_t)overlaps;
    hit->fraction = fraction;
    hit->distance = min_of(d, margin);
    hit->depth = overlaps ? -d : 0;
    hit->point = add(add_scaled(q->position, q->motion, fraction),
                     add_scaled(tahr__support_point(&solid, down), down, hit->distance));
    *count = 1;
}

void tahr__neighbours_sweep(const tahr__neighbours *n, const tahr_sweep *q, tahr_hit *hit, uint32_t *count)
{
    const tahr__solid solid = {&q->shape, q->up, q->orientation};
    if (q->flags & (TAHR_SWEEP_ONLY_BODY | TAHR_SWEEP_SENSORS)) {
        return;
    }
    for (uint32_t i = 0; i < n->count; i++) {
        const tahr__neighbour *plane = &n->planes[i];
        if (plane->body != q->ignore_body) {
            meet(n, plane, q, distance_to(n, plane, &solid, q->position), hit, count);
        }
    }
}

static int is_before(const tahr_contact *a, const tahr_contact *b)
{
    if (a->distance != b->distance) {
        return a->distance < b->distance;
    }
    return a->body != b->body ? a->body < b->body : a->feature < b->feature;
}

static void insert(tahr_contact *contacts, uint32_t capacity, uint32_t *count, const tahr_contact *c)
{
    uint32_t at = *count;
    if (at == capacity) {
        if (capacity == 0 || !is_before(c, &contacts[capacity - 1])) {
            return;
        }
        at--;
    } else {
        *count += 1;
    }
    for (; at > 0 && is_before(c, &contacts[at - 1]); at--) {
        contacts[at] = contacts[at - 1];
    }
    contacts[at] = *c;
}

uint32_t tahr__neighbours_contacts(const tahr__neighbours *n, const tahr_contact_query *q, tahr_contact *contacts,
                                   uint32_t capacity, uint32_t count)
{
    const tahr__solid solid = {&q->shape, q->up, q->orientation};
    for (uint32_t i = 0; i < n->count; i++) {
        const tahr__neighbour *plane = &n->planes[i];
        double d = distance_to(n, plane, &solid, q->position);
        if (d > q->margin || (q->margin == 0 && d >= -TOUCHING) || plane->body == q->ignore_body) {
            continue;
        }
        vec3 down = scale(plane->normal, -1);
        tahr_contact c;
        memset(&c, 0, sizeof c);
        c.distance = d;
        c.normal = c.surface_normal = plane->normal;
        c.point = add(q->position, add_scaled(tahr__support_point(&solid, down), down, d));
        c.walkable_rule = n->walkable_rule;
        c.body = plane->body;
        insert(contacts, capacity, &count, &c);
    }
    return count;
}

/* The shape and the way it is turned may have changed since the planes were made. */
static int overlaps_any(const tahr__step *step)
{
    const tahr__neighbours *n = step->neighbours;
    const tahr__solid solid = {&step->limits->shape, step->state.up, step->state.orientation};
    for (uint32_t i = 0; i < n->count; i++) {
        if (distance_to(n, &n->planes[i], &solid, step->state.position) < -TOUCHING) {
            return 1;
        }
    }
    return 0;
}

/* As far as the world lets it with its skin, and the neighbours without one: they notice it in the next tick. */
static void press(tahr__step *step, vec3 motion)
{
    const tahr__neighbours *n = step->neighbours;
    tahr_sweep q = {.shape = step->limits->shape,
                    .position = step->state.position,
                    .up = step->state.up,
                    .orientation = step->state.orientation,
                    .motion = motion,
                    .ignore_body = TAHR_NO_BODY,
                    .flags = TAHR_SWEEP_LEAVE_OVERLAP};
    tahr_hit world, other;
    uint32_t count = 0;
    tahr__trail_go(step);
    step->neighbours = NULL;
    tahr__sweep(step, &step->limits->shape, q.position, motion, step->config->skin, TAHR_SWEEP_LEAVE_OVERLAP, &world);
    step->neighbours = n;
    tahr__neighbours_sweep(n, &q, &other, &count);
    double fraction = world.blocking ? (world.start_overlap ? 0 : world.fraction) : 1;
    fraction = count > 0 ? min_of(fraction, other.start_overlap ? 0 : other.fraction) : fraction;
    step->state.position = add_scaled(q.position, motion, fraction);
    step->just_teleported |= fraction > 0;
}

/* Makes room for those who were pressed against it: so a push goes on through a crowd. */
static void give_way(tahr__step *step)
{
    const tahr__neighbours *n = step->neighbours;
    for (uint32_t i = 0; i < n->count && step->error >= 0; i++) {
        if (n->planes[i].give > 0) {
            press(step, along_plane(step->limits, scale(n->planes[i].normal, n->planes[i].give)));
        }
    }
}

void tahr__meet_neighbours(tahr__step *step)
{
    step->neighbours = step->around;
    if (step->state.mode == TAHR_MODE_NONE || step->dt <= 0) {
        return;
    }
    if (overlaps_any(step)) {
        tahr__depenetrate(step);
    } else {
        give_way(step);
    }
}
