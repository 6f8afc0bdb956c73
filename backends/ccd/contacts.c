/* SPDX-License-Identifier: MIT
 * contacts.c: the contacts slot, by core distance. */
#include "../common/one_way.h"
#include "scene.h"

/* Contacts with the same point (m) and normal are one: duplicates and coplanar twins that share no corner. */
#define SAME 1e-9

typedef struct collection {
    tahr_contact *out;
    uint32_t capacity, count, lost;
} collection;

static int comes_before(const tahr_contact *a, const tahr_contact *b)
{
    if (a->distance != b->distance) return a->distance < b->distance;
    return a->body != b->body ? a->body < b->body : a->feature < b->feature;
}

static int is_same(const tahr_contact *a, const tahr_contact *b)
{
    tahr_vec3 p = v_sub(a->point, b->point), n = v_sub(a->normal, b->normal);
    return a->body == b->body && v_dot(p, p) <= SAME * SAME && v_dot(n, n) <= SAME * SAME;
}

static void insert(collection *c, const tahr_contact *contact)
{
    uint32_t at;

    for (uint32_t i = 0; i < c->count; i++) {
        if (!is_same(&c->out[i], contact)) continue;
        if (!comes_before(contact, &c->out[i])) return;
        for (; i + 1 < c->count; i++)
            c->out[i] = c->out[i + 1];
        c->count--;
    }
    if (c->count == c->capacity) {
        c->lost = 1;
        if (c->capacity == 0 || !comes_before(contact, &c->out[c->count - 1])) return;
        c->count--;
    }
    for (at = c->count++; at > 0 && comes_before(contact, &c->out[at - 1]); at--)
        c->out[at] = c->out[at - 1];
    c->out[at] = *contact;
}

static void visit(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, collection *c)
{
    const tahr__ccd_body *b = piece->body;
    tahr_contact contact = {0};
    tahr__ccd_near near;

    probe->context->narrow_tests++;
    tahr__ccd_measure(probe, piece, v_make(0, 0, 0), &near);
    if (near.distance > probe->margin || !tahr__ccd_in_front(piece, &near)) return;
    if (!tahr__ccd_face(probe, piece, near.normal, &near, &contact.surface_normal)) return;
    if (tahr__ccd_is_one_way(b) && (probe->flags || tahr__one_way_edge(near.normal, contact.surface_normal) ||
                                    !tahr__one_way_blocks(probe->up, near.normal, near.distance, probe->margin, 0))) {
        return; /* dropped through, on an edge, or not from above */
    }
    contact.distance = near.distance;
    contact.normal = near.normal;
    contact.point = v_add(probe->origin, near.point);
    contact.walkable_angle = b->walkable_angle;
    contact.walkable_rule = b->walkable_rule;
    contact.surface = b->surface;
    contact.body = b->id;
    contact.feature = tahr__ccd_feature(piece, &near);
    contact.sensor = (b->flags & TAHR_BODY_SENSOR) != 0;
    insert(c, &contact);
}

tahr_status tahr__ccd_contacts(void *self, tahr_query_context *context, const tahr_contact_query *query,
                               tahr_contact *contacts, uint32_t capacity, uint32_t *count)
{
    tahr__ccd_probe probe = {.scene = self,
                             .context = context,
                             .margin = query->margin,
                             .origin = query->position,
                             .up = query->up,
                             .flags = query->flags & TAHR_CONTACTS_DROP ? TAHR_SWEEP_DROP : 0u,
                             .mask = query->mask,
                             .ignore_body = query->ignore_body,
                             .leaves_out = query->flags & TAHR_CONTACTS_SOLID ? TAHR__CCD_SENSORS : 0u};
    collection c = {contacts, capacity, 0, 0};
    tahr__ccd_walk walk;
    tahr__ccd_piece piece;

    *count = 0;
    if (!tahr__ccd_probe_shape(&probe, &query->shape, query->up, query->orientation)) return TAHR_E_UNSUPPORTED;
    if (!tahr__ccd_probe_finite(&probe)) return TAHR_E_ARGUMENT;
    tahr__ccd_walk_begin(&walk, &probe, v_make(0, 0, 0), probe.radius + probe.margin);
    while (tahr__ccd_walk_next(&walk, &piece))
        visit(&probe, &piece, &c);
    *count = c.count;
    return c.lost ? TAHR_TRUNCATED : TAHR_OK;
}
