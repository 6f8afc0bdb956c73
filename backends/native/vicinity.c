/* SPDX-License-Identifier: MIT
 * vicinity.c: what a sweep may leave out, because of how far it was from a place near by.
 *
 * The distance to anything changes by no more than the way that is gone. So when all that the cache holds has been
 * measured at one place, what was farther from there than the reach of a shape and its way from there is not met: no
 * query in free air, and of a room its corners are asked only near them. A floor is always near, but what lies in its
 * plane or below it cannot be met by who stays above; it is left out then, and a foot that comes down on it meets the
 * triangle under it. Nothing here decides anything but what is asked: every answer has the bits of one from the whole
 * cache (no_vicinity). */
#include "form.h"
#include "plane.h"

/* Farther off (m) than the reach of the shape boxes say enough; and what all of the world is farther from than FARTHEST
 * is not told, for the distances of lanes are right within TAHR__LANE_SLACK only near by. */
#define LOOK 0.4
#define FARTHEST 16.0
/* A foot that comes down from a walk goes no farther (m), mostly. */
#define DOWNWARD 0.02
/* Who has come farther (m) from the place looks around anew: a runner after two steps or three. */
#define DRIFT 0.12
/* Longer motions (m) are spanned by no place. */
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
/* A triangle of the floor that is farther than this (m) from the contact of a foot of reach r is met later, by the
 * square of it over 2 r: 2.5e-9 m at least, where 1e-9 m counts as the same time. */
#define APART 2e-4
/* Shapes of less reach (m) are left to the cache, for it has to be much more than the lengths here; and of more, for
 * APART. */
#define SMALL 1e-3
#define LARGE 8.0
/* And by so much (m) one may reach over the edge of another: rounding. */
#define HEM 1e-6
/* Around a place on the floor other triangles are looked for as far as this (m). */
#define SPOT 0.35
/* A spot (m) that the next steps leave is not worth finding: so many feet are then left to what is near, twice as many
 * each time. */
#define NARROW 0.04
enum { FEWEST = 1, MOST = 8 };

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

/* The same at this fraction of the motion, if that is farther than at its start. */
static double farthest2(const tahr__query *query, double until)
{
    const tahr__vicinity *v = &query->cache->vicinity;
    return d_max(away2(v, query, query->start), away2(v, query, v_mad(query->start, query->motion, until)));
}

/* m: what is farther than this from the place is not met by who comes so far from it. */
static double need(double far2, double reach)
{
    return sqrt(far2) + reach + SPARE;
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

/* Where a triangle is to the floor, as what is added to its distance for who stays above: nothing while it has not been
 * looked at; next to nothing for what is ABOVE, or where it cannot be told; and what is not met is far away. */
#define UNSEEN 0.0f
#define ABOVE 1e-30f
#define BELOW 1e38f
#define IN_IT 2e38f

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

static float see_side(const tahr__query *query, uint32_t index)
{
    float *side = &tahr__cache_lift(query->world, query->cache)[index];
    const tahr__prim *prim = &tahr__cache_prims(query->world, query->cache)[index];
    return *side = side_of(query, &query->cache->vicinity.floor, prim);
}

static inline float side_at(const tahr__query *query, uint32_t index)
{
    const float side = tahr__cache_lift(query->world, query->cache)[index];
    return side != UNSEEN ? side : see_side(query, index);
}

/* All are to be looked at again. */
static void forget_sides(const tahr__native *world, tahr__cache *cache)
{
    memset(tahr__cache_lift(world, cache), 0,
           (cache->count + TAHR__LANES - 1) / TAHR__LANES * TAHR__LANES * sizeof(float));
}

/* The plane of what stopped the last foot, toward the character; as it is, if that lies in it. */
static void know_floor(const tahr__query *query)
{
    tahr__vicinity *v = &query->cache->vicinity;
    const uint32_t i = query->cache->recent[1];
    v->stood = i;
    if (i >= query->cache->count || (v->floor.length > 0 && side_at(query, i) == IN_IT)) return;
    const tahr__prim *p = &tahr__cache_prims(query->world, query->cache)[i];
    if (p->kind & (TAHR__PLANELESS | TAHR__ONE_WAY | TAHR__SENSOR | TAHR__UNFORMED)) return;
    const tahr__facet *f = &p->facet;
    v->floor = (tahr__level){f->cross.z < 0 ? v_scale(f->cross, -1) : f->cross, f->v[0], f->length};
    v->alone = 0;
    v->under = TAHR__NONE;
    forget_sides(query->world, query->cache);
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

/* Of an upright segment at p. */
static tahr__lanes_query lanes_query(tahr_vec3 p, double half, double reach)
{
    double more = reach + TAHR__LANE_SLACK;
    return (tahr__lanes_query){.lo = {d_down(p.x), d_down(p.y), d_down(p.z - half)},
                               .hi = {d_up(p.x), d_up(p.y), d_up(p.z + half)},
                               .limit = d_up(more * more * (1 + 1e-5)),
                               .start = {(float)p.x, (float)p.y, (float)p.z},
                               .half = (float)half,
                               .reach = (float)more,
                               .lowest = d_down(p.z - half)};
}

/* Measures all that the cache holds. A foot alone looks as the whole that it is the foot of. */
static void look_around(const tahr__query *query)
{
    tahr__vicinity *v = &query->cache->vicinity;
    v->at = query->start;
    if (query->half > 0)
        v->half = query->half;
    else
        v->at.z += v->half;
    v->known = 1;
    const tahr__lanes lanes = tahr__cache_lanes(query->world, query->cache);
    const tahr__lanes_query q = lanes_query(v->at, v->half, reach_of(query) + LOOK);
    query->world->lanes->measure(&lanes, &q, tahr__cache_far(query->cache));
}

/* Is all that a query concerns in the cache, and does all of that concern it? */
static int serves(const tahr__query *query)
{
    const tahr__cache *c = query->cache;
    const tahr__native *world = query->world;
    if (!c || !c->gathered || world->no_vicinity) return 0;
    int whole = (c->overflow == 0) & (c->plain == 1) & (c->revision == world->revision);
    int plain = (query->mask == c->mask) & (query->ignore_body == TAHR_NO_BODY) & (query->core.axis_count < 2) &
                (query->sensors != TAHR__SENSORS_ONLY) & !(query->flags & TAHR_SWEEP_ONLY_BODY);
    return whole & plain & (reach_of(query) > SMALL) & (reach_of(query) < LARGE);
}

/* May a look around here be of more help? */
static int is_stale(const tahr__query *query)
{
    const tahr__vicinity *v = &query->cache->vicinity;
    if (query->motion_length > LONGEST && outside_of_all(query) <= query->motion_length) return 0;
    return !v->known || away2(v, query, query->start) > DRIFT * DRIFT;
}

static uint32_t way_of(const tahr__query *query)
{
    const tahr__level *l = &query->cache->vicinity.floor;
    if (!(l->normal.z > 0)) return TAHR__AROUND;
    double height = height_over(l, query), change = v_dot(l->normal, query->motion), reach = reach_of(query);
    if (height < (reach - 0.5 * TAHR__ARRIVED) * l->length) return TAHR__AROUND;
    int down = change < -0.5 * TAHR__PARALLEL * query->motion_length * l->length &&
               height + change < (reach + SPARE) * l->length;
    return down ? TAHR__DOWN : TAHR__OVER;
}

/* Does it stay clear of all that there is? */
static int is_beyond_all(const tahr__query *query)
{
    return outside_of_all(query) > query->motion_length + reach_of(query) + SPARE;
}

static int spans(const tahr__query *query)
{
    const tahr_bounds box = tahr__query_box(query, 1);
    return tahr__cache_spans(query->cache, &box, reach_of(query));
}

uint32_t tahr__vicinity_way(const tahr__query *query)
{
    const tahr__vicinity *v = &query->cache->vicinity;
    if (!v->known || !(spans(query) || is_beyond_all(query))) return TAHR__UNKNOWN;
    if (query->cache->recent[1] != v->stood) know_floor(query);
    return way_of(query);
}

uint32_t tahr__vicinity_known(const tahr__query *query)
{
    if (!serves(query) || is_stale(query)) return TAHR__UNKNOWN;
    return tahr__vicinity_way(query);
}

uint32_t tahr__vicinity_look(const tahr__query *query)
{
    if (!serves(query)) return TAHR__UNKNOWN;
    if (is_stale(query)) look_around(query);
    return tahr__vicinity_way(query);
}

/* With the rounding of lanes. */
static float most_of(double need)
{
    return d_up((need + TAHR__LANE_SLACK) * (1 + 4e-6));
}

/* What is no farther; over: but for what is known not to be above the floor. */
static uint32_t pick(const tahr__query *query, double most, int over, tahr__lanes_found *found)
{
    tahr__cache *c = query->cache;
    const float *lift = over ? tahr__cache_lift(query->world, c) : NULL;
    return query->world->lanes->pick(tahr__cache_far(c), lift, c->count, most_of(most), found);
}

static tahr__prim *formed(const tahr__query *query, uint32_t index)
{
    tahr__prim *prim = &tahr__cache_prims(query->world, query->cache)[index];
    if (prim->kind & TAHR__UNFORMED) tahr__form_rest(query->world, query->frame, prim);
    return prim;
}

uint32_t tahr__vicinity_pick(const tahr__query *query, uint32_t way, double until, uint32_t most,
                             tahr__lanes_found *found)
{
    const uint32_t count = pick(query, need(farthest2(query, until), reach_of(query)), way == TAHR__OVER, found);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (way == TAHR__OVER && side_at(query, found[i].index) >= BELOW) continue;
        if (kept == most) return most + 1;
        formed(query, found[i].index);
        found[kept++] = (tahr__lanes_found){0, found[i].index};
    }
    return kept;
}

/* Is this not met up to this fraction of the motion? */
static int is_passed(const tahr__query *query, const tahr__prim *prim, double until)
{
    const double t = plane_earliest(query, prim, until);
    return t > until || edges_earliest(query, prim, until, t) > until;
}

int tahr__vicinity_is_clear(const tahr__query *query, uint32_t way)
{
    tahr__lanes_found found[TAHR__CACHE_MOST];
    const uint32_t count = tahr__vicinity_pick(query, way, 1, TAHR__CACHE_MOST, found);
    const tahr__prim *prims = tahr__cache_prims(query->world, query->cache);
    for (uint32_t i = 0; i < count; i++) {
        if (!is_passed(query, &prims[found[i].index], 1)) return 0;
    }
    return 1;
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
    const tahr__prim *prim = formed(query, index);
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

static int is_within_edges(const tahr__vicinity *v, tahr_vec3 place)
{
    int within = 1;
    for (int i = 0; i < 3; i++)
        within &= v_dot(v->across[i], place) <= v->border[i] - v->hem[i];
    return within;
}

/* Takes another triangle of the floor for the one under the spot. */
static int stand_on(const tahr__query *query, uint32_t index)
{
    tahr__vicinity *v = &query->cache->vicinity;
    const tahr__prim *prim = formed(query, index);
    tahr_vec3 face = prim->kind & TAHR__FACELESS ? tahr__heights_face(query, prim) : prim->face;
    const int behind = v_dot(face, v->floor.normal) < 0;
    if (behind && !(prim->kind & TAHR__TWO_SIDED)) return 0;
    v->face = behind ? v_scale(face, -1) : face;
    v->under = index;
    know_edges(v, &prim->facet);
    return 1;
}

/* Finds the triangle at a place on the floor, if there is one alone, and how far around it there is none that reaches
 * beyond its edges. */
static void find_spot(const tahr__query *query, tahr_vec3 place)
{
    tahr__vicinity *v = &query->cache->vicinity;
    tahr__lanes_found found[TAHR__CACHE_MOST];
    const tahr__lanes lanes = tahr__cache_lanes(query->world, query->cache);
    const tahr__lanes_query q = lanes_query(place, 0, SPOT);
    uint32_t near = query->world->lanes->near(&lanes, &q, found), count = 0, under = TAHR__NONE;
    const tahr__prim *prims = tahr__cache_prims(query->world, query->cache);
    double alone = SPOT;
    v->alone = 0;
    for (uint32_t i = 0; i < near; i++) {
        const uint32_t index = found[i].index;
        if ((prims[index].item & TAHR__ITEM_SOLID) || side_at(query, index) < BELOW) continue;
        if (under == TAHR__NONE && found[i].time <= 2 * TAHR__LANE_SLACK && side_at(query, index) == IN_IT &&
            is_at(query, index, place)) {
            under = index;
            continue;
        }
        found[count++] = found[i];
    }
    if (under == TAHR__NONE || (under != v->under && !stand_on(query, under))) return;
    for (uint32_t i = 0; i < count && alone > 0; i++) {
        const double far = d_max(found[i].time - TAHR__LANE_SLACK, 0);
        if (far < alone && !is_beside(query, found[i].index)) alone = far;
    }
    v->spot = place;
    v->alone = alone - APART;
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

static int is_at_spot(const tahr__vicinity *v, tahr_vec3 place)
{
    const tahr_vec3 off = v_sub(place, v->spot);
    return v->alone > 0 && v_dot(off, off) <= v->alone * v->alone && is_within_edges(v, place);
}

/* The one triangle of the floor that may be met; NULL: it is not known which. */
static const tahr__prim *floor_under(const tahr__query *query)
{
    tahr__vicinity *v = &query->cache->vicinity;
    const tahr_vec3 place = place_on(&v->floor, query);
    if (!is_at_spot(v, place)) {
        if (!tries_spot(v)) return NULL;
        find_spot(query, place);
        v->rests = v->alone >= NARROW ? FEWEST : v->rests < MOST ? 2 * v->rests : MOST;
        v->rest = v->alone >= NARROW ? 0 : v->rests;
        if (!is_at_spot(v, place)) return NULL;
    }
    return &tahr__cache_prims(query->world, query->cache)[v->under];
}

/* A foot that comes down on the floor: when, where nothing but the floor is met before. */
static int comes_down(const tahr__query *query, tahr__found *found)
{
    const tahr__prim *floor = floor_under(query);
    if (!floor) return 0;
    const double t = plane_earliest(query, floor, 1);
    return t <= 1 && tahr__probe_face(query, floor, query->cache->vicinity.face, t, found);
}

static double tied(const tahr__query *query, double t)
{
    return d_min(t + TIED / query->motion_length, 1);
}

static void tell(const tahr__query *query, const tahr__found *found, tahr_hit *hit)
{
    query->cache->recent[1] = query->cache->vicinity.under;
    tahr__fill_hit(query, found, hit);
}

int tahr__vicinity_lands(const tahr__query *query, tahr_hit *hit)
{
    tahr__lanes_found found[TAHR__CACHE_MOST];
    tahr__found floor;
    if (!comes_down(query, &floor)) return 0;
    const double until = tied(query, floor.t);
    const uint32_t count = pick(query, need(farthest2(query, until), reach_of(query)), 1, found);
    for (uint32_t i = 0; i < count; i++) {
        if (side_at(query, found[i].index) < BELOW && !is_passed(query, formed(query, found[i].index), until)) return 0;
    }
    tell(query, &floor, hit);
    return 1;
}

/* Those of the picked that are above the floor, if none of them is in the way of the body; -1: one is. */
static int passed_by(const tahr__query *body, tahr__lanes_found *found, uint32_t count)
{
    int kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (side_at(body, found[i].index) >= BELOW) continue;
        if (!is_passed(body, formed(body, found[i].index), 1)) return -1;
        found[kept++] = found[i];
    }
    return kept;
}

int tahr__vicinity_walks(const tahr__query *body, const tahr__query *foot, tahr_hit *hit)
{
    tahr__lanes_found found[TAHR__CACHE_MOST];
    tahr__found floor;
    const double reach = d_max(reach_of(body), reach_of(foot)), most = need(farthest2(body, 1), reach) + DOWNWARD;
    const int near = passed_by(body, found, pick(body, most, 1, found));
    if (near < 0) return TAHR__BARRED;
    if (!comes_down(foot, &floor)) return TAHR__UNCLEAR;
    const double until = tied(foot, floor.t);
    if (need(farthest2(foot, until), reach) > most) return TAHR__UNCLEAR;
    for (int i = 0; i < near; i++) {
        if (!is_passed(foot, formed(foot, found[i].index), until)) return TAHR__BARRED;
    }
    tell(foot, &floor, hit);
    return TAHR__LANDED;
}

double tahr__vicinity_room(const tahr__query *query)
{
    const tahr__vicinity *v = &query->cache->vicinity;
    const float *far = tahr__cache_far(query->cache);
    const tahr_bounds *box = &query->cache->local;
    const tahr_vec3 low = v_sub(v_sub(query->start, query->extent), box->min);
    const tahr_vec3 edge = v_min(low, v_sub(box->max, v_add(query->start, query->extent)));
    float least = (float)FARTHEST;
    for (uint32_t i = 0; i < query->cache->count; i++)
        least = far[i] < least ? far[i] : least;
    const double nearest = (least - TAHR__LANE_SLACK) * (1 - 4e-6) - sqrt(away2(v, query, query->start));
    return d_min(nearest, d_min(edge.x, d_min(edge.y, edge.z))) - reach_of(query) - 2 * SPARE;
}

void tahr__vicinity_forget(const tahr__native *world, tahr__cache *cache)
{
    tahr__vicinity *v = &cache->vicinity;
    v->known = 0;
    v->alone = 0;
    v->under = v->stood = TAHR__NONE;
    if (!world->no_cache) forget_sides(world, cache);
}
