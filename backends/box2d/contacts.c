/* SPDX-License-Identifier: MIT
 * contacts.c: the contacts slot. */
#include "../common/one_way.h"
#include "scene.h"

/* Contacts with the same point (m) and normal are one: those of two segments at the corner between them. */
#define SAME 1e-9

typedef struct collection {
    const tahr__b2_probe *probe;
    tahr_contact *out;
    uint32_t capacity, count, lost, flags;
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

/* Of one-way bodies the faces that are stood on; without a motion their edges are not there. */
static int is_there(const collection *c, const tahr__b2_piece *piece, const tahr__flat_near *near, tahr__vec2 face)
{
    tahr_vec3 normal = tahr__b2_lift(near->normal, 0);

    if ((piece->owner.flags & (TAHR_BODY_ONE_WAY | TAHR_BODY_SENSOR)) != TAHR_BODY_ONE_WAY) return 1;
    return !(c->flags & TAHR_CONTACTS_DROP) && !tahr__one_way_edge(normal, tahr__b2_lift(face, 0)) &&
           tahr__one_way_blocks(tahr__b2_lift(c->probe->up, 0), normal, near->distance, c->probe->margin, 0);
}

static void visit(void *user, tahr__b2_piece *piece)
{
    collection *c = user;
    const tahr__b2_probe *p = c->probe;
    tahr_contact contact = {0};
    tahr__flat_near near;
    tahr__vec2 face;

    p->context->narrow_tests++;
    tahr__flat_measure(&p->shape, f_make(0, 0), &piece->flat, 0, &near);
    if (near.distance > p->margin || !tahr__b2_in_front(piece, &near)) return;
    tahr__b2_leave(p, piece, &near);
    face = tahr__b2_face(piece, &near, near.normal);
    if (!is_there(c, piece, &near, face)) return;
    contact.sensor = (piece->owner.flags & TAHR_BODY_SENSOR) != 0;
    if (!contact.sensor && !near.crosses && tahr__b2_is_seam(p, piece, &near, near.normal, &face)) return;
    contact.distance = near.distance;
    contact.normal = tahr__b2_lift(near.normal, 0);
    contact.surface_normal = tahr__b2_lift(face, 0);
    contact.point = v_make(p->origin.x + near.point.x, p->origin.y + near.point.y, p->origin.z);
    contact.walkable_angle = piece->owner.walkable_angle;
    contact.walkable_rule = piece->owner.walkable_rule;
    contact.surface = piece->owner.surface;
    contact.body = piece->owner.body;
    contact.feature = tahr__b2_feature(piece, &near);
    insert(c, &contact);
}

tahr_status tahr__b2_contacts(void *self, tahr_query_context *context, const tahr_contact_query *query,
                              tahr_contact *contacts, uint32_t capacity, uint32_t *count)
{
    tahr__b2_probe probe = {.scene = self,
                            .context = context,
                            .margin = query->margin,
                            .origin = query->position,
                            .mask = query->mask,
                            .ignore_body = query->ignore_body,
                            .leaves_out = query->flags & TAHR_CONTACTS_SOLID ? TAHR__B2_SENSORS : 0u};
    collection c = {&probe, contacts, capacity, 0, 0, query->flags};
    tahr_status status = tahr__b2_probe_shape(&probe, &query->shape, query->up);

    *count = 0;
    if (status >= 0) status = tahr__b2_probe_check(&probe, v_make(0, 0, 0));
    if (status < 0) return status;
    tahr__b2_each(&probe, visit, &c);
    *count = c.count;
    return c.lost ? TAHR_TRUNCATED : TAHR_OK;
}
