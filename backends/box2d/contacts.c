/* SPDX-License-Identifier: MIT
 * contacts.c: the contacts slot. */
#include "../common/one_way.h"
#include "../common/touches.h"
#include "scene.h"

typedef struct collection {
    const tahr__b2_probe *probe;
    tahr__touches touches;
    uint32_t flags, reserved;
} collection;

static int is_there(const collection *c, const tahr__b2_piece *piece, const tahr__flat_near *near, tahr__vec2 face)
{
    if (!tahr__one_way_is(piece->owner.flags)) return 1;
    return !(c->flags & TAHR_CONTACTS_DROP) &&
           tahr__one_way_touches(tahr__b2_lift(c->probe->up, 0), tahr__b2_lift(near->normal, 0), tahr__b2_lift(face, 0),
                                 near->distance, c->probe->margin);
}

static void visit(void *user, tahr__b2_piece *piece)
{
    collection *c = user;
    const tahr__b2_probe *p = c->probe;
    tahr_contact contact;
    tahr__flat_near near;
    tahr__vec2 face;

    p->context->narrow_tests++;
    tahr__flat_measure(&p->shape, f_make(0, 0), &piece->flat, 0, &near);
    if (near.distance > p->margin || !tahr__b2_in_front(piece, &near)) return;
    tahr__b2_leave(p, piece, &near);
    face = tahr__b2_face(piece, &near, near.normal);
    if (!is_there(c, piece, &near, face)) return;
    tahr__contact_of(&piece->owner, &contact);
    if (!contact.sensor && !near.crosses && tahr__b2_is_seam(p, piece, &near, near.normal, &face)) return;
    contact.distance = near.distance;
    contact.normal = tahr__b2_lift(near.normal, 0);
    contact.surface_normal = tahr__b2_lift(face, 0);
    contact.point = v_make(p->origin.x + near.point.x, p->origin.y + near.point.y, p->origin.z);
    contact.feature = tahr__b2_feature(piece, &near);
    tahr__touches_keep(&c->touches, &contact);
}

tahr_status tahr__b2_contacts(void *self, tahr_query_context *context, const tahr_contact_query *query,
                              tahr_contact *contacts, uint32_t capacity, uint32_t *count)
{
    tahr__b2_probe probe = {.scene = self,
                            .context = context,
                            .margin = query->margin,
                            .origin = query->position,
                            .filter = tahr__filter_of_contacts(query)};
    collection c = {&probe, {contacts, capacity, 0, 0, 0}, query->flags, 0};
    tahr_status status = tahr__b2_probe_shape(&probe, &query->shape, query->up);

    *count = 0;
    if (status >= 0) status = tahr__b2_probe_check(&probe, v_make(0, 0, 0));
    if (status < 0) return status;
    tahr__b2_each(&probe, visit, &c);
    *count = c.touches.count;
    return c.touches.lost ? TAHR_TRUNCATED : TAHR_OK;
}
