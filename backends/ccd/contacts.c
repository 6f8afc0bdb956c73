/* SPDX-License-Identifier: MIT
 * contacts.c: the contacts slot, by the distance. */
#include "../common/touches.h"
#include "scene.h"

/* What is asked besides the probe. */
typedef struct question {
    tahr_vec3 up;
    uint32_t flags;
    uint32_t reserved;
} question;

static int is_there(const tahr__ccd_probe *probe, const question *q, uint32_t body_flags, const tahr__ccd_near *near,
                    tahr_vec3 face)
{
    if (!tahr__one_way_is(body_flags)) return 1;
    return !(q->flags & TAHR_CONTACTS_DROP) &&
           tahr__one_way_touches(q->up, near->normal, face, near->distance, probe->margin);
}

static void visit(const tahr__ccd_probe *probe, const question *q, const tahr__ccd_piece *piece, tahr__touches *touches)
{
    const tahr__surface *surface = &piece->body->surface;
    tahr_contact contact;
    tahr__ccd_near near;

    probe->context->narrow_tests++;
    tahr__ccd_measure_far(probe, piece, v_make(0, 0, 0), &near);
    if (near.distance > probe->margin || !tahr__ccd_in_front(piece, &near)) return;
    tahr__contact_of(surface, &contact);
    if (!tahr__ccd_face(probe, piece, near.normal, &near, &contact.surface_normal)) return;
    if (!is_there(probe, q, surface->flags, &near, contact.surface_normal)) return;
    contact.distance = near.distance / probe->unit;
    contact.normal = near.normal;
    contact.point = tahr__ccd_world(probe, near.point);
    contact.feature = tahr__ccd_feature(piece, &near);
    tahr__touches_keep(touches, &contact);
}

tahr_status tahr__ccd_contacts(void *self, tahr_query_context *context, const tahr_contact_query *query,
                               tahr_contact *contacts, uint32_t capacity, uint32_t *count)
{
    tahr__ccd_probe probe = {.scene = self,
                             .context = context,
                             .margin = query->margin,
                             .origin = query->position,
                             .filter = tahr__filter_of_contacts(query)};
    const question q = {query->up, query->flags, 0};
    tahr__touches touches = {contacts, capacity, 0, 0, 0};
    tahr__ccd_walk walk;
    tahr__ccd_piece piece;
    tahr_status status = tahr__ccd_probe_shape(&probe, &query->shape, query->up, query->orientation);

    *count = 0;
    if (status < 0) return status;
    tahr__ccd_walk_begin(&walk, &probe, v_make(0, 0, 0), probe.radius + probe.margin);
    while (tahr__ccd_walk_next(&walk, &piece))
        visit(&probe, &q, &piece, &touches);
    *count = touches.count;
    return touches.lost ? TAHR_TRUNCATED : TAHR_OK;
}
