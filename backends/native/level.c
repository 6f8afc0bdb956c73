/* SPDX-License-Identifier: MIT
 * level.c: see level.h.
 *
 * Corners of one height make triangles of one plane, which lie side by side without a gap, for a field is a grid. Where
 * nothing else has been gathered, who stays above that plane meets nothing, and a foot that comes down well inside of a
 * triangle meets that one first: all others are farther from the contact than APART (ground.c). So of thousands of
 * triangles one is formed, the one under the foot, and its name follows from where the foot is. */
#include "level.h"

#include "ground.h"

#include <string.h>

/* Farther than any two places of a cache (m). */
#define EVERYWHERE 1e6

/* Who is there at all. */
typedef struct census {
    tahr__search search;
    uint32_t field, others;
} census;

static void count_triangles(tahr__search *search, uint32_t body, const uint32_t *items, uint32_t count)
{
    census *c = (census *)search;
    (void)items;
    if (count == 0) return;
    c->others += c->field != TAHR_NO_BODY || search->query->world->bodies[body].type != TAHR_BODY_HEIGHTS;
    c->field = body;
}

static void count_other(tahr__search *search, const tahr__prim *prim)
{
    (void)prim;
    ((census *)search)->others++;
}

/* The field that is alone there, or TAHR_NO_BODY. */
static uint32_t lone_field(const tahr__query *query)
{
    census c = {.search = {.query = query,
                           .box = query->cache->local,
                           .order = TAHR__IN_BULK,
                           .visit = count_other,
                           .take = count_triangles},
                .field = TAHR_NO_BODY};
    tahr__tree_search(&c.search, &query->world->fixed);
    return c.others == 0 ? c.field : TAHR_NO_BODY;
}

/* Are they all the same number? By its bits, which is soon said of many: a zero of the other sign is another one. */
static int are_alike(const double *z, uint32_t count, double to)
{
    uint64_t other = 0, bits, same;
    memcpy(&same, &to, sizeof same);
    for (uint32_t i = 0; i < count; i++) {
        memcpy(&bits, &z[i], sizeof bits);
        other |= bits ^ same;
    }
    return other == 0;
}

/* Have all corners there the same height? Holes have none. */
static int is_level(const tahr__heights *h, const tahr_bounds *box)
{
    const tahr__heights_range r = tahr__heights_cells(h, box);
    if (r.column >= r.column_end || r.row >= r.row_end) return 0;
    const uint32_t corners = r.column_end - r.column + 1;
    const double *first = h->z + (size_t)r.row * h->columns + r.column;
    int level = *first == *first;
    for (uint32_t row = 0; level && row <= r.row_end - r.row; row++)
        level = are_alike(first + (size_t)row * h->columns, corners, *first);
    return level;
}

void tahr__level_learn(tahr__query *query)
{
    const tahr__native *world = query->world;
    tahr__cache *cache = query->cache;
    tahr__footing *f = &cache->footing;
    const uint32_t id = lone_field(query);
    if (id == TAHR_NO_BODY) return;
    const tahr__body *body = &world->bodies[id];
    const tahr__map map = tahr__map_make(query->frame, body);
    const tahr_bounds box = {v_sub(cache->local.min, map.offset), v_sub(cache->local.max, map.offset)};
    if (map.turned || (body->flags & (TAHR_BODY_ONE_WAY | TAHR_BODY_SENSOR)) || body->heights.may_be_thin) return;
    if (!is_level(&body->heights, &box)) return;
    cache->level = id;
    cache->vicinity.floor.normal = v_make(0, 0, 1);
    tahr__level_find(query, query->start);
    if (f->under == TAHR__NONE) {
        cache->level = TAHR_NO_BODY;
        return;
    }
    cache->vicinity.floor = (tahr__level){v_make(0, 0, 1), f->on, 1};
    f->at = query->start;
    f->half = 0;
    f->fenced = 0;
    f->clear = EVERYWHERE;
}

int tahr__level_find(const tahr__query *query, tahr_vec3 place)
{
    tahr__cache *cache = query->cache;
    const tahr__body *body = &query->world->bodies[cache->level];
    const tahr__heights *h = &body->heights;
    const tahr__map map = tahr__map_make(query->frame, body);
    const tahr_vec3 p = v_sub(place, map.offset);
    uint32_t column, row;
    tahr__prim prim;
    tahr_vec3 v[3];
    tahr__heights_at(h, p.x, p.y, &column, &row);
    /* Over the diagonal of the cell or below it; near it neither is well inside. */
    const double across = (p.x - h->x[column]) * (h->y[row + 1] - h->y[row]),
                 along = (p.y - h->y[row]) * (h->x[column + 1] - h->x[column]);
    const uint32_t triangle = 2 * (row * (h->columns - 1) + column) + (along > across);
    tahr__heights_triangle(h, triangle, v);
    tahr__prim_begin(body, cache->level, &prim);
    tahr__prim_heights(&map, body, triangle, v, &prim);
    if (!tahr__ground_stand_on(query, &prim)) return 0;
    cache->footing.under = TAHR__CACHE_MOST; /* it is none of those gathered */
    cache->footing.spot = place;
    cache->footing.inside = 0;
    cache->vicinity.alone = EVERYWHERE;
    return ground_is_at_spot(cache, place);
}
