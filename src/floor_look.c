/* SPDX-License-Identifier: MIT
 * floor_look.c: what a look at the floor sees. */
#include "floor_look.h"

#include "perch.h"

/* m: what every backend knows of a point. */
static const double SAME_POINT = 1e-9;

static contact contact_of(vec3 point, vec3 normal, vec3 face, double depth)
{
    int is_face = length_squared(cross(face, normal)) <= ON_FACE * ON_FACE;
    contact c = {
        .kind = is_face ? FACE : EDGE, .stays = 0, .point = point, .normal = normal, .face = face, .depth = depth};
    return c;
}

void tahr__look_note(const tahr__step *step, const tahr_floor *floor, double at, look *l)
{
    const tahr__inner *inner = step->inner;
    l->at = at;
    l->position = step->state.position;
    l->known = 1;
    l->perching = (floor->flags & TAHR_FLOOR_PERCHING) != 0;
    l->has_inner = inner && inner->asked && !inner->hit.start_overlap;
    l->outer = contact_of(floor->point, floor->normal, floor->surface_normal, floor->distance);
    l->outer.kind = floor->flags & TAHR_FLOOR_BLOCKING ? l->outer.kind : FREE;
    if (l->has_inner) {
        l->inner = contact_of(inner->hit.point, inner->hit.normal, inner->hit.surface_normal, inner->clearance);
        l->inner.kind = inner->hit.blocking ? l->inner.kind : FREE;
    }
}

/* Do two looks see the same point of an edge? */
static void compare(contact *now, contact *before, double moved)
{
    double off2 = length_squared(sub(now->point, before->point));
    if (now->kind != EDGE || before->kind != EDGE) {
        return;
    }
    if (off2 <= SMALL * SMALL * moved * moved || (before->stays && off2 <= SAME_POINT * SAME_POINT)) {
        now->stays = before->stays = 1;
    }
}

void tahr__looks_compare(look *now, look *before)
{
    double moved = length(sub(now->position, before->position));
    if (before->known) {
        compare(&now->outer, &before->outer, moved);
        if (now->has_inner && before->has_inner) {
            compare(&now->inner, &before->inner, moved);
        }
    }
}
