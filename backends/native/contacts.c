/* SPDX-License-Identifier: MIT
 * contacts.c: the contacts slot: everything within the margin of a shape at rest, each feature once. */
#include "scene.h"

#include <string.h>

/* Contacts looked at for one answer. A character touches a few planes; more than this many are reported as
 * truncated. */
enum { MOST = 256 };
/* Two records of one place: neighbours that meet the shape in a shared edge, duplicates, both halves of a face. */
#define SAME 1e-9

typedef struct contacts_state {
    tahr__search search;
    double margin;
    uint32_t count, lost, drop, reserved;
    tahr__found records[MOST];
} contacts_state;

static int before(const tahr__found *a, const tahr__found *b)
{
    return a->gap != b->gap ? a->gap < b->gap : tahr__named_before(a, b);
}

static void keep(contacts_state *s, const tahr__found *f)
{
    if (s->count == MOST) {
        s->lost = 1;
        if (!before(f, &s->records[MOST - 1])) return;
        s->count--;
    }
    uint32_t k = s->count++;
    for (; k > 0 && before(f, &s->records[k - 1]); k--)
        s->records[k] = s->records[k - 1];
    s->records[k] = *f;
}

static void visit(tahr__search *search, const tahr__prim *prim)
{
    contacts_state *s = (contacts_state *)search;
    const tahr__query *query = search->query;
    tahr__found f;
    if (s->drop && prim->kind & TAHR__ONE_WAY) return;
    if (tahr__probe_touch(query, prim, s->margin, &f)) keep(s, &f);
}

static int same_place(const tahr__found *a, const tahr__found *b)
{
    uint32_t sensor = (a->kind ^ b->kind) & TAHR__SENSOR;
    tahr_vec3 n = v_sub(a->normal, b->normal), p = v_sub(a->point, b->point);
    if (sensor || v_dot(n, n) > SAME * SAME) return 0;
    /* Of one body the same plane is enough: a face that was cut into triangles is one surface. */
    return a->body == b->body || v_dot(p, p) <= SAME * SAME;
}

/* Keeps one of each; the records are in order, so equal ones are close together. */
static void merge(contacts_state *s)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < s->count; i++) {
        const tahr__found f = s->records[i];
        int twin = 0;
        for (uint32_t k = kept; k-- > 0 && !twin && f.gap - s->records[k].gap <= SAME;) {
            tahr__found *old = &s->records[k];
            if (!same_place(&f, old)) continue;
            twin = 1;
            if (f.body < old->body || (f.body == old->body && f.feature < old->feature)) *old = f;
        }
        if (!twin) s->records[kept++] = f;
    }
    s->count = kept;
}

static void fill(const tahr__query *query, const tahr__found *f, tahr_contact *c)
{
    memset(c, 0, sizeof *c);
    c->distance = f->gap;
    c->normal = tahr__frame_to_world(query->frame, f->normal);
    c->surface_normal = tahr__frame_to_world(query->frame, f->face);
    c->point = v_add(query->frame->origin, tahr__frame_to_world(query->frame, f->point));
    c->walkable_angle = f->walkable_angle;
    c->walkable_rule = f->walkable_rule;
    c->surface = f->surface;
    c->body = f->body;
    c->feature = f->feature;
    c->sensor = (f->kind & TAHR__SENSOR) != 0;
}

tahr_status tahr__native_contacts(void *self, tahr_query_context *context, const tahr_contact_query *contact_query,
                                  tahr_contact *contacts, uint32_t capacity, uint32_t *count)
{
    tahr__query query;
    contacts_state s;
    tahr_status failed = TAHR_OK;
    tahr__query_begin(&query, self, context, contact_query->position, contact_query->up);
    tahr__query_shape(&query, &contact_query->shape, contact_query->orientation);
    /* A little more, so that the cull by planes keeps what is at the margin exactly. */
    query.margin = contact_query->margin + SAME;
    query.mask = contact_query->mask;
    query.ignore_body = contact_query->ignore_body;
    query.sensors = contact_query->flags & TAHR_CONTACTS_SOLID ? TAHR__SENSORS_NONE : TAHR__SENSORS_TOO;
    s.search.query = &query;
    s.search.box = tahr__query_box(&query, 0);
    s.search.reach = query.radius + query.margin;
    s.search.narrowed = 0;
    s.search.order = TAHR__ANY_ORDER;
    s.search.visit = visit;
    s.margin = contact_query->margin;
    s.count = s.lost = 0;
    s.drop = contact_query->flags & TAHR_CONTACTS_DROP;
    query.failed = &failed;
    tahr__search_run(&s.search);
    if (failed < 0) return failed;
    merge(&s);
    uint32_t n = s.count < capacity ? s.count : capacity;
    for (uint32_t i = 0; i < n; i++)
        fill(&query, &s.records[i], &contacts[i]);
    *count = n;
    return n < s.count || s.lost ? TAHR_TRUNCATED : TAHR_OK;
}
