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
#include "ground.h"
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
/* More than what counts as the same time (m, HAIR of sweep.c). */
#define TIED 2e-9
/* Shapes of less reach (m) are left to the cache, for it has to be much more than the lengths here; and of more, for
 * APART (ground.c). */
#define SMALL 1e-3
#define LARGE 8.0

/* Square of how far the query's segment, centred at p, comes from that of the place. */
static double away2(const tahr__vicinity *v, const tahr__query *query, tahr_vec3 p)
{
    double x = p.x - v->at.x, y = p.y - v->at.y, z = d_max(fabs(p.z - v->at.z) + query->half - v->half, 0);
    return (x * x + y * y) + z * z;
}

/* The same at this fraction of the motion, if that is farther than at its start. */
static inline double farthest2(const tahr__query *query, double until)
{
    const tahr__vicinity *v = &query->cache->vicinity;
    return d_max(away2(v, query, query->start), away2(v, query, v_mad(query->start, query->motion, until)));
}

/* m: what is farther than this from the place is not met by who comes so far from it. */
static double need(double far2, double reach)
{
    return sqrt(far2) + reach + SPARE;
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
    const tahr__lanes_query q = tahr__lanes_at(v->at, v->half, reach_of(query) + LOOK);
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

static inline uint32_t way_of(const tahr__query *query)
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
    if (query->cache->recent[1] != v->stood) tahr__ground_know(query);
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

/* Is this not met up to this fraction of the motion? */
static int is_passed(const tahr__query *query, const tahr__prim *prim, double until)
{
    const double t = plane_earliest(query, prim, until);
    return t > until || edges_earliest(query, prim, until, t) > until;
}

/* Is nothing met, up to this fraction of the motion, that was within `most` of the place? over: but for what is not above
 * the floor. Returns how many have been asked, now the first of found; -1: one of them may be met. */
static int passes(const tahr__query *query, double most, int over, double until, tahr__lanes_found *found)
{
    const uint32_t count = pick(query, most, over, found);
    int kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (over && ground_side(query, found[i].index) >= TAHR__BELOW) continue;
        if (!is_passed(query, tahr__formed(query, found[i].index), until)) return -1;
        found[kept++] = found[i];
    }
    return kept;
}

int tahr__vicinity_is_clear(const tahr__query *query, uint32_t way)
{
    tahr__lanes_found found[TAHR__CACHE_MOST];
    return passes(query, need(farthest2(query, 1), reach_of(query)), way == TAHR__OVER, 1, found) >= 0;
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
    if (!tahr__ground_meets(query, &floor)) return 0;
    const double until = tied(query, floor.t);
    if (passes(query, need(farthest2(query, until), reach_of(query)), 1, until, found) < 0) return 0;
    tell(query, &floor, hit);
    return 1;
}

int tahr__vicinity_walks(const tahr__query *body, const tahr__query *foot, tahr_hit *hit)
{
    tahr__lanes_found found[TAHR__CACHE_MOST];
    tahr__found floor;
    const double reach = d_max(reach_of(body), reach_of(foot)), most = need(farthest2(body, 1), reach) + DOWNWARD;
    const int near = passes(body, most, 1, 1, found);
    if (near < 0) return TAHR__BARRED;
    if (!tahr__ground_meets(foot, &floor)) return TAHR__UNCLEAR;
    const double until = tied(foot, floor.t);
    if (need(farthest2(foot, until), reach) > most) return TAHR__UNCLEAR;
    for (int i = 0; i < near; i++) {
        if (!is_passed(foot, tahr__formed(foot, found[i].index), until)) return TAHR__BARRED;
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
    cache->vicinity.known = 0;
    tahr__ground_forget(world, cache);
}
