/* SPDX-License-Identifier: MIT
 * derived.c: contacts for users who have only a sweep.
 *
 * A sweep that goes nowhere tells the deepest overlap. Out of it by as much, another one tells what is still
 * overlapped, and so on: corners and wedges are found surface by surface. What is near is felt for with short sweeps
 * all around (TAHR_CALLBACKS_PROBE). Every place is told by its plane, so distances are exact only of flat surfaces. */
#include "callbacks.h"

#include "vec.h"

/* Of the overlaps of a room's corner there are three, and one more is a wedge; each of the directions may be turned
 * aside twice. */
enum { DIRECTIONS = (TAHR__MOST_PROBES - TAHR__MOST_OVERLAPS) / 3 };

/* Contact normals this near to each other are one surface's: what a float is off by, ten times. */
static const double SAME = 1e-6;

/* Of the margin: what is kept from a surface that is felt along, so that rounding is no overlap. */
static const double OFF = 0.01;

typedef struct felt {
    const tahr_callbacks *user;
    tahr_query_context *context;
    tahr_sweep sweep; /* from where the overlaps known so far end */
    vec3 moved;       /* that is, this far from the query's place */
    tahr_contact contacts[TAHR__MOST_PROBES];
    uint32_t count;
} felt;

static int is_known(const felt *f, vec3 normal)
{
    for (uint32_t i = 0; i < f->count; i++) {
        vec3 d = sub(f->contacts[i].normal, normal);
        if (length_squared(d) < SAME * SAME) {
            return 1;
        }
    }
    return 0;
}

/* distance: of the shape where the query has it. */
static void note(felt *f, const tahr_hit *hit, double distance)
{
    f->contacts[f->count++] = (tahr_contact){.distance = distance,
                                             .normal = hit->normal,
                                             .surface_normal = hit->surface_normal,
                                             .point = hit->point,
                                             .walkable_angle = hit->walkable_angle,
                                             .walkable_rule = hit->walkable_rule,
                                             .surface = hit->surface,
                                             .body = hit->body,
                                             .feature = hit->feature};
}

/* Whatever is wrong with an answer is handed on as it is: the caller names the field. */
static int is_sound(const tahr_hit *hit)
{
    return is_finite(hit->depth) && vec_is_finite(hit->normal) && length_squared(hit->normal) < 4;
}

/* off: how much farther out than just out. */
static tahr_status feel_overlaps(felt *f, double off)
{
    const vec3 nowhere = {0, 0, 0};
    for (int i = 0; i < TAHR__MOST_OVERLAPS; i++) {
        tahr_hit hit;
        uint32_t found = 0;
        f->sweep.motion = nowhere;
        tahr_status status = tahr__sweep_solids(f->user, f->context, &f->sweep, &hit, &found);
        if (status < 0 || !found || !hit.start_overlap || hit.sensor || is_known(f, hit.normal)) {
            return status;
        }
        note(f, &hit, -hit.depth - dot(hit.normal, f->moved));
        if (!is_sound(&hit)) {
            return TAHR_OK;
        }
        f->moved = add_scaled(f->moved, hit.normal, hit.depth + off);
        f->sweep.position = add_scaled(f->sweep.position, hit.normal, hit.depth + off);
    }
    return TAHR_OK;
}

/* Along the axes of the shape and between them: every direction is within 36.2 degrees of one of these (worst at
 * (1, 0.732, 0)). */
static vec3 direction(const tahr_contact_query *q, int i)
{
    const double third = 0.5773502691896258; /* 1 / sqrt 3 */
    vec3 side = unit(cross(q->up, q->up.x * q->up.x > 0.5 ? vec(0, 1, 0) : vec(1, 0, 0))), front = cross(q->up, side);
    if (i < 6) {
        vec3 axis = i < 2 ? q->up : (i < 4 ? side : front);
        return scale(axis, i % 2 ? 1 : -1);
    }
    vec3 d = add_scaled(scale(q->up, i & 1 ? third : -third), side, i & 2 ? third : -third);
    return add_scaled(d, front, i & 4 ? third : -third);
}

/* One short sweep from a place that lies `off` from the query's. Returns its status; hit->blocking: it met
 * something. */
static tahr_status feel(felt *f, const tahr_contact_query *q, vec3 off, vec3 motion, tahr_hit *hit)
{
    uint32_t found = 0;
    f->sweep.position = add(q->position, off);
    f->sweep.motion = motion;
    tahr_status status = tahr__sweep_solids(f->user, f->context, &f->sweep, hit, &found);
    hit->blocking &= status >= 0 && found && !hit->unknown && !hit->start_overlap && is_sound(hit);
    if (hit->blocking && !is_known(f, hit->normal)) {
        double gap = -hit->fraction * dot(motion, hit->normal), distance = gap - dot(hit->normal, off);
        if (!(distance > q->margin)) {
            note(f, hit, distance);
        }
    }
    return status;
}

/* The way along all that it has met: a plane, or the crease of two. */
static vec3 deflected(vec3 motion, const vec3 met[2], int count)
{
    vec3 crease = count == 2 ? cross(met[0], met[1]) : met[0];
    if (count == 1) {
        return reject(motion, met[0]);
    }
    double l2 = length_squared(crease);
    return l2 > 0 ? scale(crease, dot(crease, motion) / l2) : vec(0, 0, 0);
}

/* As far as it takes to meet a plane at the margin, 36.2 degrees aside: 1 / cos is 1.24. What is met first hides what
 * is behind it: the rest of the way goes along it, and again along two. */
static tahr_status feel_along(felt *f, const tahr_contact_query *q, vec3 begin, vec3 way)
{
    vec3 met[2], off = begin, motion = way;
    tahr_status status = TAHR_OK;
    double left = 1;
    for (int k = 0; k < 3 && status >= 0; k++) {
        tahr_hit hit;
        status = feel(f, q, off, motion, &hit);
        if (status < 0 || !hit.blocking || k == 2) {
            break;
        }
        met[k] = hit.normal;
        off = add_scaled(add_scaled(off, motion, hit.fraction), hit.normal, OFF * q->margin);
        left *= 1 - hit.fraction;
        motion = deflected(scale(way, left), met, k + 1);
    }
    return status;
}

static tahr_status feel_around(felt *f, const tahr_contact_query *q)
{
    const vec3 begin = f->moved;
    tahr_status status = TAHR_OK;
    f->sweep.flags = TAHR_SWEEP_LEAVE_OVERLAP;
    for (int i = 0; i < DIRECTIONS && status >= 0; i++) {
        status = feel_along(f, q, begin, scale(direction(q, i), 1.25 * q->margin));
    }
    return status;
}

static int is_before(const tahr_contact *a, const tahr_contact *b)
{
    if (a->distance != b->distance) {
        return a->distance < b->distance;
    }
    return a->body != b->body ? a->body < b->body : a->feature < b->feature;
}

static void sort(felt *f)
{
    for (uint32_t i = 1; i < f->count; i++) {
        const tahr_contact c = f->contacts[i];
        uint32_t at = i;
        for (; at > 0 && is_before(&c, &f->contacts[at - 1]); at--) {
            f->contacts[at] = f->contacts[at - 1];
        }
        f->contacts[at] = c;
    }
}

tahr_status tahr__derive_contacts(const tahr_callbacks *user, tahr_query_context *context,
                                  const tahr_contact_query *query, tahr_contact *out, uint32_t capacity,
                                  uint32_t *count)
{
    felt f = {.user = user,
              .context = context,
              .sweep = {.shape = query->shape,
                        .position = query->position,
                        .up = query->up,
                        .orientation = query->orientation,
                        .mask = query->mask,
                        .ignore_body = query->ignore_body}};
    int probes = query->margin > 0 && (user->flags & TAHR_CALLBACKS_PROBE);
    tahr_status status = feel_overlaps(&f, probes ? OFF * query->margin : 0);
    if (status >= 0 && probes) {
        status = feel_around(&f, query);
    }
    sort(&f);
    *count = 0;
    for (uint32_t i = 0; i < f.count && i < capacity && status >= 0; i++) {
        out[(*count)++] = f.contacts[i];
    }
    return status < 0 ? status : (f.count > capacity ? TAHR_TRUNCATED : TAHR_OK);
}
