/* SPDX-License-Identifier: MIT
 * fluid.c: how much of an upright segment lies inside a convex body: the segment is clipped by it. */
#include "fluid.h"

#include "room.h"

/* Part [from, to] of a segment, as fractions of its half length from its middle: -1 is the foot, 1 the head. */
typedef struct span {
    double from, to;
} span;

static const span NOTHING = {1, -1};

static void place_body(tahr__fluid_body *b, const tahr_pose *pose)
{
    b->position = pose->position;
    b->turn = m_from_quat(pose->orientation);
}

tahr_status tahr__fluids_open(tahr__fluids *fluids, const tahr_host *host, const tahr_world_desc *desc)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < desc->body_count; i++)
        count += (desc->bodies[i].flags & TAHR_BODY_FLUID) != 0;
    if (count == 0) return TAHR_OK;
    fluids->bodies = tahr__room_get(host, count, sizeof *fluids->bodies);
    if (!fluids->bodies) return TAHR_E_MEMORY;
    for (uint32_t i = 0; i < desc->body_count; i++) {
        const tahr_body_desc *d = &desc->bodies[i];
        if (!(d->flags & TAHR_BODY_FLUID)) continue;
        tahr__fluid_body *b = &fluids->bodies[fluids->count++];
        *b = (tahr__fluid_body){.id = i,
                                .type = d->type,
                                .mask = d->mask ? d->mask : 0xFFFFFFFFu,
                                .half_extents = d->half_extents,
                                .radius = d->radius,
                                .reach = d->type == TAHR_BODY_CAPSULE ? d->half_height - d->radius : 0,
                                .current = d->surface_velocity,
                                .friction = d->fluid_friction};
        place_body(b, &d->pose);
    }
    return TAHR_OK;
}

void tahr__fluids_close(tahr__fluids *fluids, const tahr_host *host)
{
    tahr__room_put(host, fluids->bodies, fluids->count, sizeof *fluids->bodies);
    fluids->bodies = NULL;
    fluids->count = 0;
}

void tahr__fluids_place(tahr__fluids *fluids, const tahr_body_pose *poses, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t k = 0; k < fluids->count; k++) {
            if (fluids->bodies[k].id == poses[i].body) place_body(&fluids->bodies[k], &poses[i].pose);
        }
    }
}

/* Keeps of s where -half <= at + s * along <= half. */
static span clip_slab(span s, double at, double along, double half)
{
    if (along == 0) return fabs(at) <= half ? s : NOTHING;
    double a = (-half - at) / along, b = (half - at) / along;
    s.from = d_max(s.from, d_min(a, b));
    s.to = d_min(s.to, d_max(a, b));
    return s;
}

/* Keeps of s where |at + s * along| <= radius. */
static span clip_ball(span s, tahr_vec3 at, tahr_vec3 along, double radius)
{
    double a = v_dot(along, along), b = v_dot(at, along), c = v_dot(at, at) - radius * radius;
    double d = b * b - a * c;
    if (!(a > 0)) return c <= 0 ? s : NOTHING;
    if (d < 0) return NOTHING;
    double root = sqrt(d);
    s.from = d_max(s.from, (-b - root) / a);
    s.to = d_min(s.to, (-b + root) / a);
    return s;
}

static span hull(span a, span b)
{
    if (a.from > a.to) return b;
    if (b.from > b.to) return a;
    return (span){d_min(a.from, b.from), d_max(a.to, b.to)};
}

/* A capsule is two balls and a cylinder between them; what a line has of something convex is one piece. */
static span clip_capsule(span s, tahr_vec3 at, tahr_vec3 along, double radius, double reach)
{
    span low = clip_ball(s, v_make(at.x, at.y, at.z + reach), along, radius);
    span high = clip_ball(s, v_make(at.x, at.y, at.z - reach), along, radius);
    span side = clip_ball(s, v_make(at.x, at.y, 0), v_make(along.x, along.y, 0), radius);
    return hull(hull(low, high), clip_slab(side, at.z, along.z, reach));
}

/* Part of the segment middle +- half that lies in the body. */
static double part_inside(const tahr__fluid_body *b, tahr_vec3 middle, tahr_vec3 half)
{
    span s = {-1, 1};
    tahr_vec3 at = m_unapply(&b->turn, v_sub(middle, b->position)), along = m_unapply(&b->turn, half);
    if (b->type == TAHR_BODY_BOX) {
        s = clip_slab(s, at.x, along.x, b->half_extents.x);
        s = clip_slab(s, at.y, along.y, b->half_extents.y);
        s = clip_slab(s, at.z, along.z, b->half_extents.z);
    } else {
        s = clip_capsule(s, at, along, b->radius, b->reach);
    }
    return s.to > s.from ? 0.5 * (s.to - s.from) : 0;
}

void tahr__fluids_ask(const tahr__fluids *fluids, const tahr_fluid_query *query, tahr_fluid *fluid)
{
    tahr_vec3 half = v_scale(query->up, query->half_height);
    for (uint32_t i = 0; i < fluids->count; i++) {
        const tahr__fluid_body *b = &fluids->bodies[i];
        double part = b->mask & query->mask ? part_inside(b, query->position, half) : 0;
        if (part <= fluid->immersion) continue;
        fluid->immersion = d_min(part, 1);
        fluid->friction = b->friction;
        fluid->velocity = m_apply(&b->turn, b->current);
        fluid->body = b->id;
    }
}
