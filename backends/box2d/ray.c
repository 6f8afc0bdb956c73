/* SPDX-License-Identifier: MIT
 * ray.c: the ray slot: the segment against the lines through the faces, one division each; round bodies by a quadratic
 * equation. */
#include "../common/hits.h"
#include "../common/one_way.h"
#include "scene.h"

typedef struct search {
    const tahr__b2_probe *probe;
    tahr_hit *hit;
    uint32_t found;
} search;

/* Part of the segment inside of a convex ring grown by nothing: where it enters and through which face. */
typedef struct entry {
    double fraction;
    tahr__vec2 normal;
    int face;
} entry;

/* Of a ring with an inside: clipped by every face. A point on a face that leads inside enters it. */
static int enter_ring(const tahr__flat *f, tahr__vec2 motion, entry *e)
{
    double from = -INFINITY, to = INFINITY;

    for (int i = 0; i < f->count; i++) {
        tahr__vec2 n = tahr__flat_normal(f, i);
        double height = -f_dot(n, f->corner[i]) - f->radius, speed = -f_dot(n, motion);
        if (speed == 0 && height > 0) return 0;
        if (speed > 0 && height / speed > from) {
            from = height / speed;
            e->normal = n;
            e->face = i;
        }
        if (speed < 0) to = d_min(to, height / speed);
    }
    e->fraction = from;
    return from >= 0 && from <= to;
}

static int enter_segment(const tahr__flat *f, tahr__vec2 motion, entry *e)
{
    tahr__vec2 n = tahr__flat_normal(f, 0), along = f_make(-n.y, n.x);
    double height = -f_dot(n, f->corner[0]), speed = -f_dot(n, motion), at;

    if (speed < 0 && !f->one_sided) {
        n = f_make(-n.x, -n.y);
        height = -height;
        speed = -speed;
    }
    if (!(speed > 0)) return 0;
    e->fraction = height / speed;
    at = f_dot(along, f_sub(f_make(motion.x * e->fraction, motion.y * e->fraction), f->corner[0]));
    e->normal = n;
    e->face = 0;
    return e->fraction >= 0 && at >= 0 && at <= tahr__flat_length(f, 0);
}

/* Of a disc: the closest approach first, so that nothing cancels from afar. */
static int enter_disc(tahr__vec2 centre, double radius, tahr__vec2 motion, entry *e)
{
    double square = f_dot(motion, motion), nearest, left;
    tahr__vec2 miss;

    if (!(square > 0)) return 0;
    nearest = f_dot(centre, motion) / square;
    miss = f_sub(f_make(motion.x * nearest, motion.y * nearest), centre);
    left = radius * radius - f_dot(miss, miss);
    if (left < 0) return 0;
    e->fraction = nearest - sqrt(left / square);
    e->normal = f_sub(f_make(motion.x * e->fraction, motion.y * e->fraction), centre);
    if (!(f_dot(e->normal, e->normal) > 0)) return 0;
    e->normal = f_unit(e->normal);
    return e->fraction >= 0;
}

/* Of a ring with a radius: the first of its corners' discs and its faces, moved outward. */
static int enter_rounded(const tahr__flat *f, tahr__vec2 motion, entry *first)
{
    int met = 0;

    first->fraction = INFINITY;
    for (int i = 0; i < f->count; i++) {
        entry e;
        if (!enter_disc(f->corner[i], f->radius, motion, &e) || e.fraction >= first->fraction) continue;
        *first = e;
        first->face = tahr__flat_facing(f, e.normal);
        met = 1;
    }
    for (int i = 0; i < tahr__flat_face_count(f); i++) {
        tahr__vec2 out = tahr__flat_normal(f, i);
        tahr__flat side;
        entry e;
        side.count = 2; /* not cleared: it is large */
        side.one_sided = 1;
        side.corner[0] = f_mad(f->corner[i], out, f->radius);
        side.corner[1] = f_mad(f->corner[i + 1 < f->count ? i + 1 : 0], out, f->radius);
        if (!enter_segment(&side, motion, &e) || e.fraction >= first->fraction) continue;
        *first = e;
        first->face = i;
        met = 1;
    }
    return met;
}

static int enter(const tahr__flat *f, tahr__vec2 motion, entry *e)
{
    if (f->radius > 0) {
        static const tahr__flat_shape dot = {1, 0, {{0, 0}}};
        tahr__flat_near near;
        tahr__flat_measure(&dot, f_make(0, 0), f, 0, &near);
        return near.distance > 0 && enter_rounded(f, motion, e); /* from inside nothing is hit */
    }
    return f->count == 2 ? enter_segment(f, motion, e) : f->count > 2 && enter_ring(f, motion, e);
}

static void visit(void *user, tahr__b2_piece *piece)
{
    search *s = user;
    const tahr__b2_probe *p = s->probe;
    tahr__flat_near near = {0};
    tahr_hit hit;
    entry e;

    p->context->narrow_tests++;
    if (!enter(&piece->flat, p->motion, &e) || !(e.fraction <= 1) || f_dot(e.normal, p->motion) >= 0) return;
    if (piece->owner.flags & TAHR_BODY_ONE_WAY && -f_dot(e.normal, p->motion) < TAHR__ONE_WAY_TOP * p->motion_length) {
        return;
    }
    near.normal = e.normal;
    near.part = e.face;
    tahr__hit_of(&piece->owner, &hit);
    hit.fraction = e.fraction;
    hit.normal = hit.surface_normal = tahr__b2_lift(e.normal, 0);
    hit.point = v_make(p->origin.x + p->motion.x * e.fraction, p->origin.y + p->motion.y * e.fraction, p->origin.z);
    hit.feature = tahr__b2_feature(piece, &near);
    if (s->found && !tahr__hit_before(&hit, s->hit)) return;
    *s->hit = hit;
    s->found = 1;
}

tahr_status tahr__b2_ray(void *self, tahr_query_context *context, const tahr_ray *query, tahr_hit *hit, uint32_t *count)
{
    tahr__b2_probe probe = {.scene = self,
                            .context = context,
                            .shape = {1, 0, {{0, 0}}},
                            .origin = query->origin,
                            .motion = {query->motion.x, query->motion.y},
                            .filter = tahr__filter_of_ray(query)};
    search s = {&probe, hit, 0};
    tahr_status status;

    *count = 0;
    probe.motion_length = f_length(probe.motion);
    status = tahr__b2_probe_check(&probe, query->motion);
    if (status < 0) return status;
    tahr__b2_each(&probe, visit, &s);
    *count = s.found;
    return TAHR_OK;
}
