/* SPDX-License-Identifier: MIT
 * solid_query.c: one body against one query, and who of several is answered. */
#include "solid.h"

static void fill(tahr_hit *hit, const tahr_body_desc *b, uint32_t id, const tahr__solid_near *near)
{
    hit->blocking = 1;
    hit->distance = near->distance;
    hit->normal = near->normal;
    hit->point = v_add(b->pose.position, near->point);
    hit->walkable_rule = b->walkable_rule;
    hit->walkable_angle = b->walkable_angle;
    hit->surface = b->surface;
    hit->body = id;
}

int tahr__solid_sweep(const tahr_body_desc *b, uint32_t id, const tahr_sweep *q, tahr_hit *hit)
{
    const tahr_vec3 start = v_sub(q->position, b->pose.position);
    tahr__solid shape, body;
    tahr__solid_near near;
    tahr__solid_verdict verdict = TAHR__SOLID_HIT;

    *hit = (tahr_hit){0};
    if (!tahr__solid_of_shape(&q->shape, q->up, q->orientation, &shape) || !tahr__solid_of_body(b, &body)) return 0;
    /* A cheap miss: the spheres around both never come so near. */
    if (v_length(start) > v_length(q->motion) + q->margin + tahr__solid_reach(&shape) + tahr__solid_reach(&body))
        return 0;
    tahr__solid_measure(&shape, &body, start, &near);
    hit->start_overlap = near.distance < 0;
    hit->depth = d_max(0, -near.distance);
    if (!hit->start_overlap || q->flags & TAHR_SWEEP_LEAVE_OVERLAP)
        verdict = tahr__solid_advance(&shape, &body, start, q->motion, q->margin, &hit->fraction, &near);
    hit->unknown = verdict == TAHR__SOLID_UNKNOWN;
    fill(hit, b, id, &near);
    hit->surface_normal = tahr__solid_face(&body, &near, v_scale(q->motion, -1), &hit->feature);
    return verdict != TAHR__SOLID_FREE;
}

int tahr__solid_contact(const tahr_body_desc *b, uint32_t id, const tahr_contact_query *q, tahr_contact *c)
{
    tahr__solid shape, body;
    tahr__solid_near near;

    *c = (tahr_contact){
        .walkable_angle = b->walkable_angle, .walkable_rule = b->walkable_rule, .surface = b->surface, .body = id};
    if (!tahr__solid_of_shape(&q->shape, q->up, q->orientation, &shape) || !tahr__solid_of_body(b, &body)) return 0;
    tahr__solid_measure(&shape, &body, v_sub(q->position, b->pose.position), &near);
    c->distance = near.distance;
    c->normal = near.normal;
    c->point = v_add(b->pose.position, near.point);
    c->surface_normal = tahr__solid_face(&body, &near, near.normal, &c->feature);
    return near.distance <= q->margin;
}

/* A point that moves. From inside nothing is met. */
int tahr__solid_ray(const tahr_body_desc *b, uint32_t id, const tahr_ray *q, tahr_hit *hit)
{
    const tahr_vec3 start = v_sub(q->origin, b->pose.position), back = v_scale(q->motion, -1);
    const tahr__solid point = {{0, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}}, 0};
    tahr__solid body;
    tahr__solid_near near;

    *hit = (tahr_hit){0};
    if (!tahr__solid_of_body(b, &body)) return 0;
    tahr__solid_measure(&point, &body, start, &near);
    if (near.distance <= 0) return 0;
    if (tahr__solid_advance(&point, &body, start, q->motion, 0, &hit->fraction, &near) != TAHR__SOLID_HIT) return 0;
    fill(hit, b, id, &near);
    /* So near to a face the direction between the nearest points is rounding; the face's own is not. */
    hit->normal = hit->surface_normal = tahr__solid_face(&body, &near, back, &hit->feature);
    near.normal = hit->normal;
    tahr__solid_face(&body, &near, back, &hit->feature);
    hit->distance = 0;
    return v_dot(hit->normal, q->motion) < 0;
}

int tahr__solid_before(const tahr_hit *a, const tahr_hit *b)
{
    if (a->start_overlap != b->start_overlap) return a->start_overlap > b->start_overlap;
    if (a->start_overlap && a->depth != b->depth) return a->depth > b->depth;
    return a->fraction != b->fraction ? a->fraction < b->fraction : a->body < b->body;
}

int tahr__solid_insert(const tahr_contact *contact, tahr_contact *contacts, uint32_t capacity, uint32_t *count)
{
    const int lost = *count == capacity;
    uint32_t at = *count;

    while (at > 0 && (contact->distance < contacts[at - 1].distance ||
                      (contact->distance == contacts[at - 1].distance && contact->body < contacts[at - 1].body)))
        at--;
    if (at == capacity) return 0;
    *count += !lost;
    for (uint32_t i = *count - 1; i > at; i--)
        contacts[i] = contacts[i - 1];
    contacts[at] = *contact;
    return !lost;
}
