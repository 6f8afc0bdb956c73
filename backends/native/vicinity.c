/* SPDX-License-Identifier: MIT
 * vicinity.c: what a sweep may leave out, because of how far it was from a place near by.
 *
 * The distance to anything changes by no more than the way that is gone. So when all that the cache holds has been
 * measured at one place, what was farther from there than the reach of a shape and its way from there is not met: no
 * query in free air, and of a room its corners are asked only near them. A floor is always near, but what lies in its
 * plane or below it cannot be met by who stays above; it is left out then, and a foot that comes down on it meets the
 * triangle under it. Nothing here decides anything but what is asked: every answer has the bits of one from the whole
 * cache (no_vicinity). */
#include "fence.h"
#include "footing.h"
#include "form.h"
#include "ground.h"
#include "plane.h"

/* Farther off (m) than the reach of the shape boxes say enough; and what all of the world is farther from than FARTHEST
 * is not told, for the distances of lanes are right within TAHR__LANE_SLACK only near by. */
#define LOOK 0.4
#define FARTHEST 16.0
/* So far (m) beyond the reach it is looked for what is nearest of all that is above the floor. */
#define ROUND 0.45
#define WIDE_ROUND 2.0
enum { FEW = 16 };
/* Longer motions (m) are spanned by no place. */
#define LONGEST 0.5
/* Taken off what is known, against rounding and arrival (TAHR__ARRIVED) (m). */
#define SPARE 1e-6
/* More than what counts as the same time (m, HAIR of sweep.c). */
#define TIED 2e-9

/* Square of how far the query's segment, centred at p, comes from that of the place. */
static double away2(const tahr__query *query, tahr_vec3 p)
{
    const tahr__footing *f = &query->cache->footing;
    double x = p.x - f->at.x, y = p.y - f->at.y, z = d_max(fabs(p.z - f->at.z) + query->half - f->half, 0);
    return (x * x + y * y) + z * z;
}

/* The same at this fraction of the motion, if that is farther than at its start. */
static inline double farthest2(const tahr__query *query, double until)
{
    return d_max(away2(query, query->start), away2(query, v_mad(query->start, query->motion, until)));
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
    tahr__footing *f = &query->cache->footing;
    f->at = query->start;
    f->clear = 0;
    if (query->half > 0)
        f->half = query->half;
    else
        f->at.z += f->half;
    query->cache->vicinity.known = 1;
    const tahr__lanes lanes = tahr__cache_lanes(query->world, query->cache);
    const tahr__lanes_query q = tahr__lanes_at(f->at, f->half, reach_of(query) + LOOK);
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
    return whole & plain & (reach_of(query) > TAHR__SMALL) & (reach_of(query) < TAHR__LARGE);
}

/* May a look around here be of more help? */
static int is_stale(const tahr__query *query)
{
    if (query->motion_length > LONGEST && outside_of_all(query) <= query->motion_length) return 0;
    return !query->cache->vicinity.known || away2(query, query->start) > TAHR__DRIFT * TAHR__DRIFT;
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

int tahr__vicinity_ends(const tahr__query *query)
{
    return (serves(query) || query->cache->level != TAHR_NO_BODY) && !spans(query);
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

/* Is nothing met, up to this fraction of the motion, that was within `most` of the place? over: but for what is not
 * above the floor. Returns how many have been asked, now the first of found; -1: one of them may be met. */
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
    query->cache->recent[1] = query->cache->footing.under;
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

/* Of a query only what plane.h reads of it, and tahr__ground_see. */
static void ask_of(tahr__query *query, const tahr__native *world, tahr_query_context *context, tahr_vec3 start,
                   tahr_vec3 motion)
{
    ask_in_cache(query, world, context);
    query->start = start;
    query->motion = motion;
    query->motion_length = v_length(motion);
}

static int settle_all(const tahr__query *body, const tahr__query *foot, const tahr__doubt *doubt)
{
    tahr__lanes_found found[TAHR__CACHE_MOST];
    const int near = passes(body, doubt->most, 1, 1, found);
    const double until = tied(foot, doubt->until);
    for (int i = 0; i < near; i++) {
        if (!is_passed(foot, tahr__formed(foot, found[i].index), until)) return 0;
    }
    return near >= 0;
}

static int settle_fences(const tahr__query *body, const tahr__query *foot, const tahr__doubt *doubt)
{
    const tahr__fences *fences = &body->cache->fences;
    const float *far = tahr__cache_far(body->cache), most = most_of(doubt->most);
    const double until = tied(foot, doubt->until);
    for (uint32_t i = 0; i < TAHR__FENCES; i++) {
        if (!(doubt->fences >> i & 1) || far[fences->of[i]] > most) continue;
        const tahr__prim *prim = tahr__formed(body, fences->of[i]);
        if (!is_passed(body, prim, 1) || !is_passed(foot, prim, until)) return 0;
    }
    return 1;
}

int tahr__doubt_settle(const tahr__native *world, tahr_query_context *context, const tahr_walk *walk,
                       const tahr__doubt *doubt)
{
    tahr__query body, foot;
    ask_of(&body, world, context, doubt->body_start, doubt->body_motion);
    ask_of(&foot, world, context, doubt->foot_start, doubt->foot_motion);
    body.half = doubt->half;
    body.core.axis_count = doubt->half > 0;
    foot.half = foot.core.axis_count = 0;
    body.radius = walk->shape->radius;
    foot.radius = walk->foot->radius;
    body.margin = foot.margin = walk->margin;
    return doubt->fences ? settle_fences(&body, &foot, doubt) : settle_all(&body, &foot, doubt);
}

/* The nearest of those above the floor, nearest first; what is left over is no nearer than `rest`. */
typedef struct nearest {
    tahr__lanes_found found[TAHR__FENCES];
    uint32_t count;
    double rest;
} nearest;

static void put_nearest(nearest *n, const tahr__lanes_found *one)
{
    uint32_t i = n->count;
    if (i == TAHR__FENCES) {
        n->rest = d_min(n->rest, d_max(one->time, n->found[i - 1].time));
        if (one->time >= n->found[i - 1].time) return;
        i--;
    } else {
        n->count++;
    }
    for (; i > 0 && n->found[i - 1].time > one->time; i--)
        n->found[i] = n->found[i - 1];
    n->found[i] = *one;
}

/* Those no farther than this from the place. */
static void find_nearest(const tahr__query *query, double most, nearest *near)
{
    tahr__lanes_found found[TAHR__CACHE_MOST];
    const uint32_t count = pick(query, most, 1, found);
    near->count = 0;
    near->rest = most_of(most);
    for (uint32_t i = 0; i < count; i++) {
        if (ground_side(query, found[i].index) < TAHR__BELOW) put_nearest(near, &found[i]);
    }
}

/* How far all is that is above the floor, but for what is nearest, which is fenced off; once a look. */
static void clear_around(const tahr__query *query)
{
    tahr__cache *cache = query->cache;
    tahr__footing *f = &cache->footing;
    nearest near;
    if (f->clear > 0) return;
    find_nearest(query, reach_of(query) + ROUND, &near);
    if (near.count == 0 && cache->count <= FEW) find_nearest(query, reach_of(query) + WIDE_ROUND, &near);
    f->fenced = near.count > 0;
    if (f->fenced) {
        const tahr__lanes lanes = tahr__cache_lanes(query->world, cache);
        const tahr__lanes_query at = tahr__lanes_at(f->at, f->half, 0);
        tahr__fences_clear(&cache->fences);
        for (uint32_t i = 0; i < near.count; i++) {
            const tahr__lanes_found *one = &near.found[i];
            if (!tahr__fences_put(&cache->fences, i, &lanes, one->index, &at)) near.rest = d_min(near.rest, one->time);
        }
    }
    f->clear = d_max((near.rest - TAHR__LANE_SLACK) * (1 - 4e-6), SPARE);
}

int tahr__vicinity_learn(const tahr__query *body, const tahr__query *foot)
{
    const int was_clear = body->cache->footing.clear > 0;
    int finds;
    if (!tahr__ground_knows(foot, &finds)) return 0;
    clear_around(body);
    return finds || !was_clear;
}

double tahr__vicinity_room(const tahr__query *query)
{
    const float *far = tahr__cache_far(query->cache);
    const tahr_bounds *box = &query->cache->local;
    const tahr_vec3 low = v_sub(v_sub(query->start, query->extent), box->min);
    const tahr_vec3 edge = v_min(low, v_sub(box->max, v_add(query->start, query->extent)));
    float least = (float)FARTHEST;
    for (uint32_t i = 0; i < query->cache->count; i++)
        least = far[i] < least ? far[i] : least;
    const double far_off = (least - TAHR__LANE_SLACK) * (1 - 4e-6) - sqrt(away2(query, query->start));
    return d_min(far_off, d_min(edge.x, d_min(edge.y, edge.z))) - reach_of(query) - 2 * SPARE;
}

void tahr__vicinity_forget(const tahr__native *world, tahr__cache *cache)
{
    cache->vicinity.known = 0;
    cache->footing.origin = cache->frame.origin;
    cache->footing.up = cache->frame.up;
    cache->footing.turned = cache->frame.turned;
    tahr__ground_forget(world, cache);
}
