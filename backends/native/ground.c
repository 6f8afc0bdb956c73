/* SPDX-License-Identifier: MIT
 * ground.c: the floor that the last foot was stopped by, and the one triangle of it that is under the character.
 *
 * What lies in the plane of the floor or below it cannot be met by who stays above; and a foot that comes down on it
 * meets the triangle under it, and nothing else of the floor before it or at the same time, if that triangle is there
 * alone. */
#include "ground.h"

#include "form.h"
#include "level.h"
#include "plane.h"

/* Heights (m) that are rounding: of the product of two places within 8 m, eight units in the last place. A triangle
 * at least FLAT wide between such corners leans by less than half of TAHR__PARALLEL, so that a motion along the floor
 * does not approach it. */
#define LEVEL 4e-15
#define FLAT 0.02
/* So much lower than the floor (m) is not met before it, nor at the same time but for rounding (HAIR of sweep.c). */
#define LOWER 1e-6
/* A triangle of the floor that is farther than this (m) from the contact of a foot of reach r is met later, by the
 * square of it over 2 r: 2.5e-9 m at least, where 1e-9 m counts as the same time. */
#define APART 2e-4
/* And by so much (m) one may reach over the edge of another: rounding. */
#define HEM 1e-6
/* Around a place on the floor other triangles are looked for as far as this (m). */
#define SPOT 0.35
#define WIDEST 1.4
/* A spot (m) that the next steps leave is not worth finding: so many feet are then left to what is near, twice as many
 * each time. */
#define NARROW 0.04
enum { FEWEST = 1, MOST = 8 };

/* Of a gathered triangle, local. */
static void corners_of(const tahr__query *query, const tahr__prim *prim, tahr_vec3 v[3])
{
    if (!(prim->kind & TAHR__UNFORMED)) {
        memcpy(v, prim->facet.v, sizeof prim->facet.v);
        return;
    }
    const tahr__body *body = &query->world->bodies[prim->body];
    tahr__map map = tahr__map_make(query->frame, body);
    if (body->type == TAHR_BODY_HEIGHTS) {
        tahr__heights_triangle(&body->heights, prim->item, v);
        for (int i = 0; i < 3; i++)
            v[i] = tahr__map_point(&map, v[i]);
    } else {
        tahr__map_triangle(&map, body, prim->item, v);
    }
}

/* Is a triangle in the plane, but for rounding, and wide enough to say so? */
static int is_flat(const tahr_vec3 v[3], double lowest)
{
    tahr_vec3 a = v_sub(v[1], v[0]), b = v_sub(v[2], v[1]), c = v_sub(v[0], v[2]), x = v_cross(a, b);
    double longest2 = d_max(v_dot(a, a), d_max(v_dot(b, b), v_dot(c, c)));
    return lowest >= -LEVEL && v_dot(x, x) > FLAT * FLAT * longest2;
}

/* The inside of a box or hull concerns only who enters it with the core. */
static int is_under(const tahr__query *query, const tahr__level *l, const tahr__prim *prim)
{
    const tahr_bounds box = tahr__prim_bounds(query, prim);
    tahr_vec3 n = l->normal, top = v_make(n.x > 0 ? box.max.x : box.min.x, n.y > 0 ? box.max.y : box.min.y, box.max.z);
    return !(prim->kind & (TAHR__ONE_WAY | TAHR__SENSOR)) && v_dot(n, v_sub(top, l->at)) <= 2 * TAHR__SLACK * l->length;
}

static float side_of(const tahr__query *query, const tahr__level *l, const tahr__prim *prim)
{
    const uint32_t other = TAHR__PLANELESS | TAHR__ONE_WAY | TAHR__SENSOR;
    tahr_vec3 v[3];
    if (prim->item & TAHR__ITEM_SOLID) return is_under(query, l, prim) ? TAHR__BELOW : TAHR__ABOVE;
    if (prim->kind & other) return TAHR__ABOVE;
    corners_of(query, prim, v);
    double h[3];
    for (int i = 0; i < 3; i++)
        h[i] = v_dot(l->normal, v_sub(v[i], l->at)) / l->length;
    double highest = d_max(h[0], d_max(h[1], h[2]));
    if (highest <= -LOWER) return TAHR__BELOW;
    return highest <= LEVEL && is_flat(v, d_min(h[0], d_min(h[1], h[2]))) ? TAHR__IN_IT : TAHR__ABOVE;
}

/* What its box tells without its corners: TAHR__UNSEEN, if it does not. What stands over the floor by more than HIGH
 * (m) is ABOVE; what is wholly below it by more than the rounding of boxes is BELOW. */
#define HIGH 0.05
#define BOXED 1e-4
static float side_by_box(const tahr__query *query, const tahr__level *l, uint32_t index)
{
    const float *blocks = tahr__cache_blocks(query->world, query->cache);
    const float *low = blocks + tahr__lane(index, TAHR__LANE_LOW), *high = blocks + tahr__lane(index, TAHR__LANE_HIGH);
    const tahr_vec3 n = l->normal, top = v_make(low[0], low[TAHR__LANES], high[2 * TAHR__LANES]),
                    width = v_make((double)high[0] - low[0], (double)high[TAHR__LANES] - low[TAHR__LANES], 0);
    const double height = v_dot(n, v_sub(top, l->at)), lean = fabs(n.x) * width.x + fabs(n.y) * width.y;
    if (height > lean + HIGH * l->length) return TAHR__ABOVE;
    return height + lean < -BOXED * l->length ? TAHR__BELOW : TAHR__UNSEEN;
}

float tahr__ground_see(const tahr__query *query, uint32_t index)
{
    float *side = &tahr__cache_lift(query->world, query->cache)[index];
    const tahr__prim *prim = &tahr__cache_prims(query->world, query->cache)[index];
    const tahr__level *floor = &query->cache->vicinity.floor;
    const uint32_t other = TAHR__PLANELESS | TAHR__ONE_WAY | TAHR__SENSOR;
    const float boxed = prim->kind & other ? TAHR__UNSEEN : side_by_box(query, floor, index);
    return *side = boxed != TAHR__UNSEEN ? boxed : side_of(query, floor, prim);
}

/* All are to be looked at again. */
static void forget_sides(const tahr__native *world, tahr__cache *cache)
{
    memset(tahr__cache_lift(world, cache), 0,
           (cache->count + TAHR__LANES - 1) / TAHR__LANES * TAHR__LANES * sizeof(float));
}

static void forget_spot(tahr__cache *cache)
{
    cache->vicinity.alone = cache->footing.inside = cache->footing.clear = 0;
    cache->footing.under = TAHR__NONE;
}

void tahr__ground_know(const tahr__query *query)
{
    tahr__vicinity *v = &query->cache->vicinity;
    const uint32_t i = query->cache->recent[1];
    v->stood = i;
    if (i >= query->cache->count || (v->floor.length > 0 && ground_side(query, i) == TAHR__IN_IT)) return;
    const tahr__prim *p = &tahr__cache_prims(query->world, query->cache)[i];
    if (p->kind & (TAHR__PLANELESS | TAHR__ONE_WAY | TAHR__SENSOR | TAHR__UNFORMED)) return;
    const tahr__facet *f = &p->facet;
    v->floor = (tahr__level){f->cross.z < 0 ? v_scale(f->cross, -1) : f->cross, f->v[0], f->length};
    forget_spot(query->cache);
    forget_sides(query->world, query->cache);
}

/* Where the lower end of the query's segment comes down on the floor. */
static tahr_vec3 place_on(const tahr__level *l, const tahr__query *query)
{
    double above = height_over(l, query) - reach_of(query) * l->length;
    tahr_vec3 low = v_mad(query->start, query->motion, d_max(above, 0) / -v_dot(l->normal, query->motion));
    low.z -= query->half;
    return v_mad(low, l->normal, -v_dot(l->normal, v_sub(low, l->at)) / (l->length * l->length));
}

/* Is this triangle of the floor the one at the place? Those too large for lanes seem to be at many places. */
static int is_at(const tahr__query *query, uint32_t index, tahr_vec3 place)
{
    const tahr__prim *prim = tahr__formed(query, index);
    tahr__witness w;
    if (prim->kind & TAHR__PLANELESS) return 0;
    tahr__point_facet(place, &prim->facet, &w);
    return w.feature == TAHR__FACE;
}

/* The planes through the edges of the triangle under the spot, across it, and how far inside (times their length) one
 * has to be. */
static void know_edges(tahr__vicinity *v, const tahr__facet *f)
{
    for (int i = 0; i < 3; i++) {
        const tahr_vec3 e = v_sub(f->v[i < 2 ? i + 1 : 0], f->v[i]), out = v_cross(e, f->cross);
        v->across[i] = out;
        v->border[i] = v_dot(out, f->v[i]);
        v->hem[i] = (APART + HEM) * v_length(e) * f->length;
    }
}

/* Is all of a triangle beyond one of these, but for rounding? */
static int is_beside(const tahr__query *query, uint32_t index)
{
    const tahr__vicinity *v = &query->cache->vicinity;
    tahr_vec3 corner[3];
    corners_of(query, &tahr__cache_prims(query->world, query->cache)[index], corner);
    for (int i = 0; i < 3; i++) {
        const double least = v->border[i] - v->hem[i] * (HEM / (APART + HEM));
        int beyond = 1;
        for (int k = 0; k < 3; k++)
            beyond &= v_dot(v->across[i], corner[k]) >= least;
        if (beyond) return 1;
    }
    return 0;
}

/* A triangle whose normal goes up by less, or is off its exact one by more (its cosine), is asked at length: far from
 * what probe.c takes for along a face, and a little less than it allows between the two. */
#define STEEP 0.2
#define ALIKE 0.9991

/* What a walk on it reads (footing.c). */
static void know_triangle(const tahr__query *query, const tahr__prim *prim)
{
    tahr__footing *f = &query->cache->footing;
    const tahr__facet *facet = &prim->facet;
    f->cross = facet->cross.z < 0 ? v_scale(facet->cross, -1) : facet->cross;
    f->on = facet->v[0];
    f->length = facet->length;
    f->inverse = 1.0 / facet->length;
    f->steep = f->cross.z < STEEP * f->length || v_dot(query->cache->vicinity.face, f->cross) < ALIKE * f->length;
    f->normal = tahr__frame_to_world(query->frame, query->cache->vicinity.face);
    f->walkable_angle = prim->walkable_angle;
    f->walkable_rule = prim->walkable_rule;
    f->surface = prim->surface;
    f->body = prim->body;
    f->feature = prim->feature;
}

/* m from a place on the triangle to where it is no longer alone, or well inside of an edge. */
static double inside_of_edges(const tahr__vicinity *v, tahr_vec3 place)
{
    double least = v->alone;
    for (int i = 0; i < 3; i++)
        least = d_min(least, (v->border[i] - v->hem[i] - v_dot(v->across[i], place)) / v_length(v->across[i]));
    return least;
}

int tahr__ground_stand_on(const tahr__query *query, const tahr__prim *prim)
{
    tahr__vicinity *v = &query->cache->vicinity;
    tahr_vec3 face = prim->kind & TAHR__FACELESS ? tahr__heights_face(query, prim) : prim->face;
    const int behind = v_dot(face, v->floor.normal) < 0;
    if (behind && !(prim->kind & TAHR__TWO_SIDED)) return 0;
    v->face = behind ? v_scale(face, -1) : face;
    know_edges(v, &prim->facet);
    know_triangle(query, prim);
    return 1;
}

/* Finds the triangle at a place on the floor, if there is one alone, and how far around it there is none that reaches
 * beyond its edges. */
static void find_spot(const tahr__query *query, tahr_vec3 place)
{
    tahr__vicinity *v = &query->cache->vicinity;
    tahr__footing *f = &query->cache->footing;
    tahr__lanes_found found[TAHR__CACHE_MOST];
    const tahr__lanes lanes = tahr__cache_lanes(query->world, query->cache);
    const double scope = d_max(v->scope, SPOT);
    const tahr__lanes_query q = tahr__lanes_at(place, 0, scope);
    uint32_t near = query->world->lanes->near(&lanes, &q, found), count = 0, under = TAHR__NONE;
    const tahr__prim *prims = tahr__cache_prims(query->world, query->cache);
    double alone = scope;
    v->alone = query->cache->footing.inside = 0;
    for (uint32_t i = 0; i < near; i++) {
        const uint32_t index = found[i].index;
        if ((prims[index].item & TAHR__ITEM_SOLID) || ground_side(query, index) < TAHR__BELOW) continue;
        if (under == TAHR__NONE && found[i].time <= 2 * TAHR__LANE_SLACK && ground_side(query, index) == TAHR__IN_IT &&
            is_at(query, index, place)) {
            under = index;
            continue;
        }
        found[count++] = found[i];
    }
    if (under == TAHR__NONE || (under != f->under && !tahr__ground_stand_on(query, tahr__formed(query, under)))) return;
    f->under = under;
    for (uint32_t i = 0; i < count && alone > 0; i++) {
        const double far = d_max(found[i].time - TAHR__LANE_SLACK, 0);
        if (far < alone && !is_beside(query, found[i].index)) alone = far;
    }
    f->spot = place;
    v->alone = alone - APART;
    f->inside = inside_of_edges(v, place);
    v->scope = f->inside >= scope - APART ? d_min(2 * scope, WIDEST) : SPOT;
}

/* Is it worth finding one again? */
static int tries_spot(tahr__vicinity *v)
{
    if (v->rest > 0) {
        v->rest--;
        return 0;
    }
    return 1;
}

int tahr__ground_find(const tahr__query *query, tahr_vec3 place)
{
    tahr__vicinity *v = &query->cache->vicinity;
    if (query->cache->level != TAHR_NO_BODY) return tahr__level_find(query, place);
    if (!tries_spot(v)) return 0;
    find_spot(query, place);
    v->rests = v->alone >= NARROW ? FEWEST : v->rests < MOST ? 2 * v->rests : MOST;
    v->rest = v->alone >= NARROW ? 0 : v->rests;
    return ground_is_at_spot(query->cache, place);
}

int tahr__ground_knows(const tahr__query *query, int *finds)
{
    const tahr_vec3 place = place_on(&query->cache->vicinity.floor, query);
    *finds = 0;
    if (ground_is_at_spot(query->cache, place)) return 1;
    *finds = tahr__ground_find(query, place);
    return *finds;
}

int tahr__ground_meets(const tahr__query *query, tahr__found *found)
{
    int finds;
    if (!tahr__ground_knows(query, &finds)) return 0;
    const tahr__prim *floor = &tahr__cache_prims(query->world, query->cache)[query->cache->footing.under];
    const double t = plane_earliest(query, floor, 1);
    return t <= 1 && tahr__probe_face(query, floor, query->cache->vicinity.face, t, found);
}

void tahr__ground_forget(const tahr__native *world, tahr__cache *cache)
{
    forget_spot(cache);
    cache->vicinity.stood = TAHR__NONE;
    if (!world->no_cache) forget_sides(world, cache);
}
