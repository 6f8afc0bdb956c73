/* SPDX-License-Identifier: MIT
 * vicinity.c: what a sweep may leave out, because of how far it was from a place near by.
 *
 * The distance to anything changes by no more than the way that is gone. So when all that the cache holds has been
 * measured at one place, what was farther from there than the reach of a shape and its way from there is not met: no
 * query in free air, and of a room its corners are asked only near them. A floor is always near, but what lies in its
 * plane or below it cannot be met by who stays above; it is left out of the measure, and a foot that comes down on it
 * meets the triangle under it. Nothing here decides anything but what is asked: every answer has the bits of one from
 * the whole cache (no_vicinity). */
#include "form.h"
#include "plane.h"

/* Farther off (m) than the reach of the shape nothing is listed: a dozen steps of a runner, about as far as a gathered box
 * leaves room for; and what all of the world is farther from than this is not told, for the distances of lanes are right
 * within TAHR__LANE_SLACK only near by. */
#define LOOK 1.2
#define FARTHEST 16.0
/* Who has come less far (m) from the place is not helped by another one; and longer motions are spanned by none. */
#define DRIFT 0.04
#define LONGEST 0.5
/* Taken off what is known, against rounding and arrival (TAHR__ARRIVED) (m). */
#define SPARE 1e-6
/* Heights (m) that are rounding: of the product of two places within 8 m, eight units in the last place. A triangle
 * at least FLAT wide between such corners leans by less than half of TAHR__PARALLEL, so that a motion along the floor
 * does not approach it. */
#define LEVEL 4e-15
#define FLAT 0.02
/* So much lower than the floor (m) is not met before it, nor at the same time but for rounding (HAIR of sweep.c). */
#define LOWER 1e-6
/* More than what counts as the same time (m, HAIR of sweep.c). */
#define TIED 2e-9
/* A triangle of the floor that is farther than this (m) from the contact of a foot of reach r is met later, by the square
 * of it over 2 r: 2.5e-9 m at least, where 1e-9 m counts as the same time. */
#define APART 2e-4
/* Shapes of less reach (m) are left to the cache, for it has to be much more than the lengths here; and of more, for
 * APART. */
#define SMALL 1e-3
#define LARGE 8.0
/* Around a place on the floor other triangles are looked for as far as this (m). */
#define SPOT 0.5
/* Queries in a row that must have asked little before it is tried, and each time it was of no use twice as many. */
enum { CALM = 2, CALM_MOST = 32 };

static double reach_of(const tahr__query *query)
{
    return query->radius + query->margin;
}

/* How high the lower end of the query's segment is over the floor, times the length of its normal. */
static double height_over(const tahr__level *l, const tahr__query *query)
{
    return v_dot(l->normal, v_sub(query->start, l->at)) - query->half * l->normal.z;
}

/* Square of how far the query's segment, centred at p, comes from that of the place. */
static double away2(const tahr__vicinity *v, const tahr__query *query, tahr_vec3 p)
{
    double x = p.x - v->at.x, y = p.y - v->at.y, z = d_max(fabs(p.z - v->at.z) + query->half - v->half, 0);
    return (x * x + y * y) + z * z;
}

/* m: what is farther than this from the place is not met up to this fraction of the motion. */
static double need(const tahr__query *query, double until)
{
    const tahr__vicinity *v = &query->cache->vicinity;
    double begin = away2(v, query, query->start), end = away2(v, query, v_mad(query->start, query->motion, until));
    return sqrt(d_max(begin, end)) + reach_of(query) + SPARE;
}

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

enum { ABOVE, IN_IT, BELOW };

/* The inside of a box or hull concerns only who enters it with the core. */
static int is_under(const tahr__query *query, const tahr__level *l, const tahr__prim *prim)
{
    const tahr_bounds box = tahr__prim_bounds(query, prim);
    tahr_vec3 n = l->normal, top = v_make(n.x > 0 ? box.max.x : box.min.x, n.y > 0 ? box.max.y : box.min.y, box.max.z);
    return !(prim->kind & (TAHR__ONE_WAY | TAHR__SENSOR)) && v_dot(n, v_sub(top, l->at)) <= 2 * TAHR__SLACK * l->length;
}

/* Where a gathered triangle is to the floor. ABOVE: or what cannot be told. */
static int side_of(const tahr__query *query, const tahr__level *l, const tahr__prim *prim)
{
    const uint32_t other = TAHR__PLANELESS | TAHR__ONE_WAY | TAHR__SENSOR;
    tahr_vec3 v[3];
    if (prim->item & TAHR__ITEM_SOLID) return is_under(query, l, prim) ? BELOW : ABOVE;
    if (prim->kind & other) return ABOVE;
    corners_of(query, prim, v);
    double h[3];
    for (int i = 0; i < 3; i++)
        h[i] = v_dot(l->normal, v_sub(v[i], l->at)) / l->length;
    double highest = d_max(h[0], d_max(h[1], h[2]));
    if (highest <= -LOWER) return BELOW;
    return highest <= LEVEL && is_flat(v, d_min(h[0], d_min(h[1], h[2]))) ? IN_IT : ABOVE;
}

/* The plane of what stopped the last foot, toward the character. */
static void find_floor(const tahr__query *query)
{
    tahr__vicinity *v = &query->cache->vicinity;
    uint32_t i = query->cache->recent[1];
    if (i >= query->cache->count) return;
    const tahr__prim *p = &tahr__cache_prims(query->world, query->cache)[i];
    if (p->kind & (TAHR__PLANELESS | TAHR__ONE_WAY | TAHR__SENSOR | TAHR__UNFORMED)) return;
    const tahr__facet *f = &p->facet;
    v->floor = (tahr__level){f->cross.z < 0 ? v_scale(f->cross, -1) : f->cross, f->v[0], f->length};
}

/* Is a floor known, and the character above it? */
static int is_above(const tahr__query *query)
{
    const tahr__level *l = &query->cache->vicinity.floor;
    return l->normal.z > 0 && height_over(l, query) >= (reach_of(query) - 0.5 * TAHR__ARRIVED) * l->length;
}

/* m from the query's segment to where nothing has been gathered. */
static double border(const tahr__query *query)
{
    const tahr_bounds *box = &query->cache->local;
    tahr_vec3 a = v_sub(v_sub(query->start, query->extent), box->min);
    tahr_vec3 b = v_sub(box->max, v_add(query->start, query->extent));
    tahr_vec3 least = v_min(a, b);
    return d_min(least.x, d_min(least.y, least.z));
}

double tahr__outside_of_all(const tahr__native *world, tahr_vec3 position)
{
    const tahr__bvh *tree = &world->fixed.tree;
    if (world->gather || world->no_vicinity) return 0;
    if (world->fixed.count == 0) return FARTHEST;
    const tahr__bvh_node *root = &tree->nodes[0];
    double gap2 = 0;
    for (int axis = 0; axis < 3; axis++) {
        double x = v_get(position, axis) - v_get(tree->centre, axis),
               gap = d_max(root->lo[axis] - x, x - root->hi[axis]);
        gap2 += gap > 0 ? gap * gap : 0;
    }
    return d_min(sqrt(gap2) * (1 - 1e-9), FARTHEST);
}

/* m from the query's segment to everything that is static, at most. */
static double outside_of_all(const tahr__query *query)
{
    const tahr_vec3 at = v_add(query->frame->origin, tahr__frame_to_world(query->frame, query->start));
    return d_max(tahr__outside_of_all(query->world, at) - query->half - SPARE, 0);
}

/* All within reach of an upright segment at p, with a distance that is not more than theirs. */
static uint32_t near_to(const tahr__query *query, tahr_vec3 p, double half, double reach, tahr__lanes_found *found)
{
    double more = reach + TAHR__LANE_SLACK;
    tahr__lanes_query q = {.lo = {d_down(p.x), d_down(p.y), d_down(p.z - half)},
                           .hi = {d_up(p.x), d_up(p.y), d_up(p.z + half)},
                           .limit = d_up(more * more * (1 + 1e-5)),
                           .start = {(float)p.x, (float)p.y, (float)p.z},
                           .half = (float)half,
                           .reach = (float)more,
                           .lowest = d_down(p.z - half)};
    tahr__lanes lanes = tahr__cache_lanes(query->cache);
    return query->world->lanes->near(&lanes, &q, found);
}

/* Lists one more; of too many the farthest is what has to stay clear of. */
static void list(tahr__vicinity *v, uint32_t index, double far)
{
    uint32_t at = v->count;
    if (at == TAHR__VICINITY_MOST) {
        double last = v->far[at - 1];
        v->clear = d_min(v->clear, d_max(last, far));
        if (far >= last) return;
        at--;
    } else {
        v->count++;
    }
    for (; at > 0 && v->far[at - 1] > far; at--) {
        v->far[at] = v->far[at - 1];
        v->near[at] = v->near[at - 1];
    }
    v->far[at] = far;
    v->near[at] = index;
}

static void look_around(const tahr__query *query)
{
    tahr__vicinity *v = &query->cache->vicinity;
    tahr__prim *prims = tahr__cache_prims(query->world, query->cache);
    tahr__lanes_found found[TAHR__CACHE_MOST];
    v->at = query->start;
    v->half = query->half;
    v->count = 0;
    v->clear = d_max(d_min(border(query), reach_of(query) + LOOK), outside_of_all(query));
    v->alone = 0;
    v->under = TAHR__NONE;
    v->stood = query->cache->recent[1];
    find_floor(query);
    v->over = (uint32_t)is_above(query);
    if (v->clear <= 0) return;
    uint32_t count = near_to(query, v->at, v->half, v->clear, found);
    for (uint32_t i = 0; i < count; i++) {
        double far = d_max(found[i].time - TAHR__LANE_SLACK, 0);
        if (far >= v->clear || (v->over && side_of(query, &v->floor, &prims[found[i].index]) != ABOVE)) continue;
        list(v, found[i].index, far);
    }
}

/* Is everything that a query may meet in the cache, and all of that to be asked? */
static int serves(const tahr__query *query)
{
    const tahr__cache *c = query->cache;
    const tahr__native *world = query->world;
    if (!c || !c->gathered || world->no_vicinity) return 0;
    int whole = (c->overflow == 0) & (c->plain == 1) & (c->revision == world->revision) & (world->movable.count == 0);
    int plain = (query->mask == c->mask) & (query->ignore_body == TAHR_NO_BODY) & (query->core.axis_count < 2) &
                (query->sensors != TAHR__SENSORS_ONLY) & !(query->flags & TAHR_SWEEP_ONLY_BODY);
    return whole & plain & (reach_of(query) > SMALL) & (reach_of(query) < LARGE);
}

/* Is there nothing that need be measured up to this fraction of the motion? */
static int is_clear(const tahr__query *query, double until)
{
    const tahr__vicinity *v = &query->cache->vicinity;
    double far = need(query, until);
    if (far > v->clear) return 0;
    for (uint32_t i = 0; i < v->count && v->far[i] < far; i++) {
        tahr__prim *prim = &tahr__cache_prims(query->world, query->cache)[v->near[i]];
        if (prim->kind & TAHR__UNFORMED) tahr__form_rest(query->world, query->frame, prim);
        double t = plane_earliest(query, prim, until);
        if (t <= until && edges_earliest(query, prim, until, t) <= until) return 0;
    }
    return 1;
}

/* Where a motion leads. UNKNOWN: all that the cache has is to be asked. CLEAR: only what is listed may be met. DOWN: the
 * floor too, and it is not known whether something else. */
enum { UNKNOWN, CLEAR, DOWN };

static int way_of(const tahr__query *query)
{
    const tahr__vicinity *v = &query->cache->vicinity;
    const tahr__level *l = &v->floor;
    if (v->clear <= 0) return UNKNOWN;
    if (!v->over) return need(query, 1) <= v->clear ? CLEAR : UNKNOWN;
    double height = height_over(l, query), change = v_dot(l->normal, query->motion), reach = reach_of(query);
    if (height < (reach - 0.5 * TAHR__ARRIVED) * l->length) return UNKNOWN;
    int down = change < -0.5 * TAHR__PARALLEL * query->motion_length * l->length &&
               height + change < (reach + SPARE) * l->length;
    if (down) return DOWN;
    return need(query, 1) <= v->clear ? CLEAR : UNKNOWN;
}

/* Has a foot found a floor that was not known at the place? */
static int has_landed(const tahr__query *query)
{
    const tahr__vicinity *v = &query->cache->vicinity;
    return !v->over && query->cache->recent[1] < query->cache->count && query->cache->recent[1] != v->stood;
}

/* May a look around here be of more help? */
static int is_stale(const tahr__query *query)
{
    const tahr__vicinity *v = &query->cache->vicinity;
    if (query->motion_length > LONGEST && outside_of_all(query) <= query->motion_length) return 0;
    return v->clear <= 0 || has_landed(query) || away2(v, query, query->start) > DRIFT * DRIFT;
}

/* Where the lower end of the query's segment comes down on the floor. */
static tahr_vec3 place_on(const tahr__level *l, const tahr__query *query)
{
    double above = height_over(l, query) - reach_of(query) * l->length;
    tahr_vec3 low = v_mad(query->start, query->motion, d_max(above, 0) / -v_dot(l->normal, query->motion));
    low.z -= query->half;
    return v_mad(low, l->normal, -v_dot(l->normal, v_sub(low, l->at)) / (l->length * l->length));
}

static int is_listed(const tahr__vicinity *v, uint32_t index)
{
    for (uint32_t i = 0; i < v->count; i++) {
        if (v->near[i] == index) return 1;
    }
    return 0;
}

/* m from a place on the floor to a triangle that the lanes found `far` from it, at most: exactly, where that is next to
 * nothing, as it is of all that are too large for lanes. */
static double distance_to(const tahr__query *query, tahr__prim *prim, tahr_vec3 place, double far)
{
    tahr__witness w;
    if (far > 10 * APART || (prim->kind & TAHR__PLANELESS)) return far;
    if (prim->kind & TAHR__UNFORMED) tahr__form_rest(query->world, query->frame, prim);
    tahr__point_facet(place, &prim->facet, &w);
    return w.feature == TAHR__FACE ? 0 : w.distance;
}

/* Finds the triangle at a place on the floor, if there is one alone, and how far around it there is no other. */
static void find_spot(const tahr__query *query, tahr_vec3 place)
{
    tahr__vicinity *v = &query->cache->vicinity;
    tahr__prim *prims = tahr__cache_prims(query->world, query->cache);
    tahr__lanes_found found[TAHR__CACHE_MOST];
    double first = SPOT, second = SPOT;
    uint32_t count = near_to(query, place, 0, SPOT, found), under = TAHR__NONE;
    v->alone = 0;
    for (uint32_t i = 0; i < count; i++) {
        double far = d_max(found[i].time - TAHR__LANE_SLACK, 0);
        tahr__prim *prim = &prims[found[i].index];
        if (far >= second || is_listed(v, found[i].index) || (prim->item & TAHR__ITEM_SOLID)) continue;
        far = distance_to(query, prim, place, far);
        second = d_min(second, d_max(first, far));
        if (far < first) {
            first = far;
            under = found[i].index;
        }
    }
    if (first > 0 || second <= APART) return;
    if (under != v->under) {
        tahr__prim *prim = &prims[under];
        if (side_of(query, &v->floor, prim) != IN_IT) return;
        if (prim->kind & TAHR__UNFORMED) tahr__form_rest(query->world, query->frame, prim);
        tahr_vec3 face = prim->kind & TAHR__FACELESS ? tahr__heights_face(query, prim) : prim->face;
        const int behind = v_dot(face, v->floor.normal) < 0;
        if (behind && !(prim->kind & TAHR__TWO_SIDED)) return;
        v->face = behind ? v_scale(face, -1) : face;
        v->under = under;
    }
    v->spot = place;
    v->alone = second - APART;
}

/* The one triangle of the floor that may be met; NULL: it is not known which. */
static const tahr__prim *floor_under(const tahr__query *query)
{
    tahr__vicinity *v = &query->cache->vicinity;
    tahr_vec3 place = place_on(&v->floor, query), off = v_sub(place, v->spot);
    if (v->alone <= 0 || v_dot(off, off) > v->alone * v->alone) find_spot(query, place);
    return v->alone > 0 ? &tahr__cache_prims(query->world, query->cache)[v->under] : NULL;
}

static int come_down(const tahr__query *query, tahr_hit *hit, uint32_t *count)
{
    const tahr__prim *floor = floor_under(query);
    tahr__found found;
    if (!floor) return 0;
    double t = plane_earliest(query, floor, 1);
    if (t > 1 || !tahr__probe_face(query, floor, query->cache->vicinity.face, t, &found)) return 0;
    if (!is_clear(query, d_min(t + TIED / query->motion_length, 1))) return 0;
    query->cache->recent[1] = query->cache->vicinity.under;
    tahr__fill_hit(query, &found, hit);
    *count = 1;
    return 1;
}

static int answer(const tahr__query *query, int way, tahr_hit *hit, uint32_t *count)
{
    *count = 0;
    return way == CLEAR ? is_clear(query, 1) : way == DOWN && come_down(query, hit, count);
}

int tahr__vicinity_knows(const tahr__query *query, tahr_hit *hit, uint32_t *count)
{
    return tahr__vicinity_is_calm(query) && serves(query) && answer(query, way_of(query), hit, count);
}

int tahr__vicinity_answer(const tahr__query *query, tahr_hit *hit, uint32_t *count)
{
    tahr__vicinity *v = &query->cache->vicinity;
    if (!serves(query)) return 0;
    int way = way_of(query), looks = (way == UNKNOWN || has_landed(query)) && is_stale(query);
    if (looks) {
        look_around(query);
        way = way_of(query);
    }
    if (answer(query, way, hit, count)) {
        v->needed = CALM;
        return 1;
    }
    if (way == UNKNOWN && !looks) return 0;
    v->calm = 0;
    v->needed = v->needed < CALM ? CALM : v->needed < CALM_MOST ? 2 * v->needed : CALM_MOST;
    return 0;
}

void tahr__vicinity_forget(tahr__vicinity *v, int has_floor)
{
    const uint32_t until_floor =
        has_floor || v->floor.length > 0 ? 0 : 2; /* queries of a step: the second one finds it */
    v->clear = -1;
    if (v->needed >= until_floor && v->calm > v->needed - until_floor) v->calm = v->needed - until_floor;
}
