/* SPDX-License-Identifier: MIT
 * derived.c: contacts for users who have only a sweep.
 *
 * A sweep that goes nowhere tells the deepest overlap. Out of it by as much, another one tells what is still overlapped,
 * and so on: corners and wedges are found surface by surface. What is near is felt for with short sweeps all around
 * (TAHR_CALLBACKS_PROBE). Every place is told by its plane, so distances are exact only of flat surfaces. */
#include "callbacks.h"

#include "vec.h"

/* Overlaps that are looked for; of a room's corner there are three, and one more is a wedge. */
enum { OVERLAPS = 4, DIRECTIONS = TAHR__MOST_PROBES - OVERLAPS };

/* Contact normals this near to each other are one surface's: what a float is off by, ten times. */
static const double SAME = 1e-6;

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

/* distance: of the moved shape. */
static void note(felt *f, const tahr_hit *hit, double distance)
{
    f->contacts[f->count++] = (tahr_contact){.distance = distance - dot(hit->normal, f->moved),
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

static tahr_status feel_overlaps(felt *f)
{
    const vec3 nowhere = {0, 0, 0};
    for (int i = 0; i < OVERLAPS; i++) {
        tahr_hit hit;
        uint32_t found = 0;
        f->sweep.motion = nowhere;
        tahr_status status = tahr__sweep_solids(f->user, f->context, &f->sweep, &hit, &found);
        if (status < 0 || !found || !hit.start_overlap || hit.sensor || is_known(f, hit.normal)) {
            return status;
        }
        note(f, &hit, -hit.depth);
        if (!is_sound(&hit)) {
            return TAHR_OK;
        }
        f->moved = add_scaled(f->moved, hit.normal, hit.depth);
        f->sweep.position = add_scaled(f->sweep.position, hit.normal, hit.depth);
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

/* As far as it takes to meet a plane at the margin, 36.2 degrees aside: 1 / cos is 1.24. */
static tahr_status feel_around(felt *f, const tahr_contact_query *q)
{
    double way = 1.25 * q->margin;
    f->sweep.flags = TAHR_SWEEP_LEAVE_OVERLAP;
    for (int i = 0; i < DIRECTIONS; i++) {
        tahr_hit hit;
        uint32_t found = 0;
        vec3 along = direction(q, i);
        f->sweep.motion = scale(along, way);
        tahr_status status = tahr__sweep_solids(f->user, f->context, &f->sweep, &hit, &found);
        if (status < 0) {
            return status;
        }
        if (!found || !hit.blocking || hit.unknown || hit.start_overlap || is_known(f, hit.normal)) {
            continue;
        }
        double gap = -hit.fraction * way * dot(along, hit.normal);
        if (!(gap - dot(hit.normal, f->moved) > q->margin)) {
            note(f, &hit, gap);
        }
    }
    return TAHR_OK;
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
    tahr_status status = feel_overlaps(&f);
    if (status >= 0 && query->margin > 0 && (user->flags & TAHR_CALLBACKS_PROBE)) {
        status = feel_around(&f, query);
    }
    sort(&f);
    *count = 0;
    for (uint32_t i = 0; i < f.count && i < capacity && status >= 0; i++) {
        out[(*count)++] = f.contacts[i];
    }
    return status < 0 ? status : (f.count > capacity ? TAHR_TRUNCATED : TAHR_OK);
}
