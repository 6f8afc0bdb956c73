/* SPDX-License-Identifier: MIT
 * touches.c: the order of contacts. */
#include "touches.h"

#include <string.h>

/* Contacts with the same point (m) and normal are one: duplicates and coplanar twins that share no corner. */
#define SAME 1e-9

void tahr__contact_of(const tahr__surface *surface, tahr_contact *contact)
{
    memset(contact, 0, sizeof *contact);
    contact->sensor = (surface->flags & TAHR_BODY_SENSOR) != 0;
    contact->walkable_rule = surface->walkable_rule;
    contact->walkable_angle = surface->walkable_angle;
    contact->surface = surface->surface;
    contact->body = surface->id;
}

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

void tahr__touches_keep(tahr__touches *c, const tahr_contact *contact)
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
