/* SPDX-License-Identifier: MIT
 * piece_query.c: queries about convex pieces: their numbers checked and brought to their unit, and what contacts and
 * rays make of the pieces. Sweeps are in piece_sweep.c. */
#include "piece_query.h"

#include "hits.h"
#include "one_way.h"
#include "touches.h"

/* m: what is farther or larger is an error of the caller, and would overflow in an engine's products of products. */
#define LARGEST 1e8
/* Boxes grow by this (m): far more than the rounding of coordinates at 1e7 m, far less than anything it would cost. */
#define SLACK 1e-5

static int is_usual(double x)
{
    return x >= -LARGEST && x <= LARGEST;
}

static int is_usual_vec(tahr_vec3 v)
{
    return is_usual(v.x) && is_usual(v.y) && is_usual(v.z);
}

/* The box of the shape on its motion, grown by radius and margin. Returns 0 if it is too large. */
static int set_box(tahr__piece_query *q)
{
    double reach = q->shape.radius + q->margin + SLACK * q->start.scale, metres = 1 / q->start.scale;
    tahr_vec3 zero = v_make(0, 0, 0);
    tahr_bounds own = {zero, zero};

    for (int i = 0; i < 3; i++) {
        tahr_vec3 n = v_make(i == 0, i == 1, i == 2);
        own.max = v_mad(own.max, n, tahr__shape_extent(&q->shape, n));
        own.min = v_mad(own.min, n, -tahr__shape_extent(&q->shape, v_scale(n, -1)));
    }
    own.min = v_sub(own.min, v_make(reach, reach, reach));
    own.max = v_add(own.max, v_make(reach, reach, reach));
    q->box.min = v_scale(v_add(v_min(zero, q->motion), own.min), metres);
    q->box.max = v_scale(v_add(v_max(zero, q->motion), own.max), metres);
    return is_usual_vec(v_scale(own.min, metres)) && is_usual_vec(v_scale(own.max, metres));
}

tahr_status tahr__piece_query_begin(tahr__piece_query *q, tahr_vec3 origin, const tahr__shape_source *shape)
{
    tahr_status status = TAHR_OK;

    q->start = (tahr__start){origin, shape ? shape->scale : 1};
    q->frame_body = NULL;
    q->begun = 0;
    if (shape)
        status = tahr__shape_make(shape, &q->shape);
    else
        tahr__shape_point(&q->shape);
    if (status < 0) return status;
    if (!(q->start.scale > 0) || !is_usual_vec(origin) || !is_usual_vec(q->motion) || !(q->margin >= 0))
        return TAHR_E_ARGUMENT;
    q->margin *= q->start.scale;
    q->motion_length = v_length(q->motion) * q->start.scale;
    q->motion = v_scale(q->motion, q->start.scale);
    if (!set_box(q)) return TAHR_E_ARGUMENT;
    q->begun = 1;
    if (q->finder->begin) status = q->finder->begin(q);
    if (status >= 0) q->finder->rewind(q);
    return status;
}

void tahr__piece_query_end(tahr__piece_query *q)
{
    if (q->begun && q->finder->end) q->finder->end(q);
}

int tahr__piece_query_next(tahr__piece_query *q, tahr__piece_found *found)
{
    while (q->finder->next(q, &found->name)) {
        if (!q->finder->make(q, found)) continue;
        q->context->narrow_tests++;
        return 1;
    }
    return 0;
}

void tahr__piece_enter(tahr__piece_query *q, const tahr__scene_body *body, tahr__piece_found *found)
{
    if (q->frame_body != body) tahr__placement_make(body->pose.position, &body->turn, &q->start, &q->frame);
    q->frame_body = body;
    found->surface = &body->surface;
}

void tahr__piece_of_body(tahr__piece_query *q, const tahr__scene_body *body, uint32_t triangle,
                         tahr__piece_found *found)
{
    tahr__piece_enter(q, body, found);
    tahr__scene_piece(body, &q->frame, triangle, &found->piece);
}

void tahr__piece_query_measure(tahr__piece_query *q, const tahr__piece_found *found, tahr__near *near)
{
    const tahr__motion motion = tahr__piece_query_motion(q);

    if (q->finder->measure)
        q->finder->measure(q, found, near);
    else
        tahr__piece_measure_far(&motion, &found->piece, 0, near);
}

int tahr__piece_query_felt(const tahr__piece_query *q, const tahr__piece_found *found, tahr_vec3 direction,
                           tahr__near *near, tahr_vec3 *face)
{
    if (!tahr__piece_in_front(&found->piece, near)) return 0;
    if (q->finder->felt && !q->finder->felt(q, found, near)) return 0;
    return tahr__piece_face(&found->piece, direction, near, face);
}

uint32_t tahr__piece_query_feature(const tahr__piece_query *q, const tahr__piece_found *found, tahr_vec3 normal)
{
    return q->finder->feature ? q->finder->feature(q, found, normal) : tahr__piece_feature(&found->piece, normal);
}

tahr__verdict tahr__piece_query_advance(const tahr__piece_query *q, const tahr__piece *piece, double limit,
                                        double *fraction, tahr__near *near)
{
    const tahr__motion motion = tahr__piece_query_motion(q);
    return tahr__piece_advance(&motion, piece, limit, fraction, near);
}

/* --- Contacts --- */

static int touches_one_way(const tahr__piece_query *q, const tahr__near *near, tahr_vec3 face)
{
    return !(q->flags & TAHR_CONTACTS_DROP) &&
           tahr__one_way_touches(q->up, near->normal, face, near->distance, q->margin);
}

static void touch(tahr__piece_query *q, const tahr__piece_found *found, tahr__touches *touches)
{
    tahr_contact contact;
    tahr__near near;

    tahr__piece_query_measure(q, found, &near);
    if (near.distance > q->margin) return;
    tahr__contact_of(found->surface, &contact);
    if (!tahr__piece_query_felt(q, found, near.normal, &near, &contact.surface_normal)) return;
    if (tahr__one_way_is(found->surface->flags) && !touches_one_way(q, &near, contact.surface_normal)) return;
    contact.distance = near.distance / q->start.scale;
    contact.normal = near.normal;
    contact.point = tahr__piece_query_world(q, near.point);
    contact.feature = tahr__piece_query_feature(q, found, near.normal);
    tahr__touches_keep(touches, &contact);
}

tahr_status tahr__piece_contacts(tahr__piece_query *q, const tahr_contact_query *asked, tahr_contact *contacts,
                                 uint32_t capacity, uint32_t *count)
{
    const tahr__shape_source shape = {&asked->shape, asked->up, asked->orientation,
                                      tahr__scene_hull(q->scene, &asked->shape),
                                      q->finder->scale ? q->finder->scale(&asked->shape) : 1};
    tahr__touches touches = {contacts, capacity, 0, 0, 0};
    tahr__piece_found found;

    *count = 0;
    q->up = asked->up;
    q->motion = v_make(0, 0, 0);
    q->margin = asked->margin;
    q->filter = tahr__filter_of_contacts(asked);
    q->flags = asked->flags;
    tahr_status status = tahr__piece_query_begin(q, asked->position, &shape);
    while (status >= 0 && tahr__piece_query_next(q, &found))
        touch(q, &found, &touches);
    tahr__piece_query_end(q);
    if (status < 0) return status;
    *count = touches.count;
    return touches.lost ? TAHR_TRUNCATED : TAHR_OK;
}

/* --- Rays: a point advances by tangents of the core distance, which for a face is one exact step --- */

/* Does the piece lie in the way, by its face? */
static int is_in_the_way(tahr__piece_query *q, const tahr__piece_found *found, double limit, tahr_hit *hit)
{
    const tahr__piece *piece = &found->piece;
    double fraction = 0;
    tahr__near near;

    tahr__piece_measure(&q->shape, v_make(0, 0, 0), piece, &near);
    if (piece->kind != TAHR__TRIANGLE && !piece->two_sided && near.distance <= 0)
        return 0; /* from inside nothing is hit */
    if (tahr__piece_query_advance(q, piece, limit, &fraction, &near) != TAHR__HIT) return 0;
    tahr__hit_of(found->surface, hit);
    /* So near to a bare face or edge the direction between the nearest points is rounding: the face's own is not. */
    hit->surface_normal = near.normal;
    tahr__piece_face(piece, v_scale(q->motion, -1), &near, &hit->surface_normal);
    if (piece->two_sided && v_dot(hit->surface_normal, q->motion) > 0)
        hit->surface_normal = v_scale(hit->surface_normal, -1);
    hit->normal = near.normal = hit->surface_normal;
    if (q->finder->felt && !q->finder->felt(q, found, &near)) return 0;
    double against = -v_dot(hit->normal, q->motion);
    if (against <= 0) return 0;
    if (tahr__one_way_is(found->surface->flags) && against < TAHR__ONE_WAY_TOP * q->motion_length) return 0;
    hit->fraction = fraction;
    hit->point = tahr__piece_query_world(q, v_scale(q->motion, fraction));
    hit->feature = tahr__piece_query_feature(q, found, hit->normal);
    return 1;
}

tahr_status tahr__piece_ray(tahr__piece_query *q, const tahr_ray *ray, tahr_hit *hit, uint32_t *count)
{
    tahr__piece_found found;

    *count = 0;
    q->motion = ray->motion;
    q->margin = 0;
    q->filter = tahr__filter_of_ray(ray);
    tahr_status status = tahr__piece_query_begin(q, ray->origin, NULL);
    while (status >= 0 && tahr__piece_query_next(q, &found)) {
        double limit = *count ? d_min(1, hit->fraction * (1 + 1e-9) + 1e-12) : 1;
        tahr_hit candidate;
        if (!is_in_the_way(q, &found, limit, &candidate)) continue;
        if (*count && !tahr__hit_before(&candidate, hit)) continue;
        *hit = candidate;
        *count = 1;
    }
    tahr__piece_query_end(q);
    return status < 0 ? status : TAHR_OK;
}
