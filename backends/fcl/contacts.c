/* SPDX-License-Identifier: MIT
 * contacts.c: the contacts slot. */
#include "scene.h"

#include "../common/one_way.h"
#include "../common/touches.h"

/* What is asked besides the query. */
typedef struct question {
    tahr_vec3 up;
    uint32_t flags, reserved;
} question;

static int is_there(const tahr__fcl_query *q, const question *asked, const tahr__near *near,
                    const tahr_contact *contact, uint32_t body_flags)
{
    if (!tahr__one_way_is(body_flags)) return 1;
    return !(asked->flags & TAHR_CONTACTS_DROP) &&
           tahr__one_way_touches(asked->up, near->normal, contact->surface_normal, near->distance, q->margin);
}

static void visit(tahr__fcl_query *q, uint32_t part, const question *asked, tahr__touches *touches)
{
    const tahr__surface *surface = &tahr__fcl_query_body(q, part)->surface;
    tahr_contact contact;
    tahr__piece piece;
    tahr__near near;

    if (!tahr__fcl_query_piece(q, part, &piece)) return;
    q->context->narrow_tests++;
    tahr__fcl_measure(q, part, &piece, v_make(0, 0, 0), &near);
    if (near.distance > q->margin) return;
    tahr__contact_of(surface, &contact);
    if (!tahr__fcl_felt(q, part, &piece, near.normal, &near, &contact.surface_normal)) return;
    if (!is_there(q, asked, &near, &contact, surface->flags)) return;
    contact.distance = near.distance;
    contact.normal = near.normal;
    contact.point = v_add(q->origin, near.point);
    contact.feature = tahr__fcl_feature(q, part, &piece, near.normal);
    tahr__touches_keep(touches, &contact);
}

tahr_status tahr__fcl_contacts(void *self, tahr_query_context *context, const tahr_contact_query *query,
                               tahr_contact *contacts, uint32_t capacity, uint32_t *count)
{
    tahr__touches touches = {contacts, capacity, 0, 0, 0};
    const question asked = {query->up, query->flags, 0};
    const tahr__shape_source source = {&query->shape, query->up, query->orientation, NULL};
    tahr__fcl_query q;
    tahr_status status;

    *count = 0;
    q.scene = self;
    q.margin = query->margin;
    q.origin = query->position;
    q.motion = v_make(0, 0, 0);
    q.filter = tahr__filter_of_contacts(query);
    if (!(query->margin >= 0)) return TAHR_E_ARGUMENT;
    status = tahr__fcl_query_shape(&q, &source);
    if (status < 0) return status;
    status = tahr__fcl_query_begin(&q, context, q.shape.radius + q.margin);
    for (uint32_t i = 0; status >= 0 && i < q.count; i++)
        visit(&q, i, &asked, &touches);
    tahr__fcl_query_end(&q);
    if (status < 0) return status;
    *count = touches.count;
    return touches.lost ? TAHR_TRUNCATED : TAHR_OK;
}
