/* SPDX-License-Identifier: MIT
 * footing.c: a walk over the inside of one triangle, in air that is known to be clear: from five lines of memory.
 *
 * Where the walk goes no farther from the place that was measured than everything above the floor was from it, less
 * what the shape reaches, nothing of that is met; what lies in the floor or below it is not met by who stays above; and
 * of the floor there is one triangle alone where the foot comes down. That is what vicinity.c finds out at length, and
 * here it is only asked whether it still holds. What is left is to say when the point of the foot comes to a plane:
 * plane_earliest, tahr__probe_face and tahr__fill_hit, the same operations in the same order, where none of their
 * exceptions can happen. */
#include "scene.h"

/* As in vicinity.c: against rounding and arrival (m), twice, for planes that are one but for rounding; and shapes of
 * less and more reach are left to it. */
#define SPARE 2e-6
#define SMALL 1e-3
#define LARGE 8.0
/* Side of a cell (m, frame.c). */
#define CELL 4.0
/* Of the foot's way it comes down this part at least, squared: far from what probe.c takes for along a face, even where
 * the exact normal is off the triangle's by what it allows (2.6 degrees). */
#define STEEP2 0.04

/* A walk in the frame of the cache. */
typedef struct local_walk {
    tahr_vec3 from, way, to, foot, down;
    double half, reach, foot_radius, foot_reach;
} local_walk;

static inline tahr_vec3 turned(const tahr__cache *cache, tahr_vec3 v)
{
    return cache->footing.turned ? m_apply(&cache->frame.turn, v) : v;
}

/* Half the axis of a round shape; < 0: it is not one. */
static inline double half_of(const tahr_shape *shape)
{
    if (shape->type == TAHR_SHAPE_SPHERE) return 0;
    return shape->type == TAHR_SHAPE_CAPSULE ? d_max(shape->half_height - shape->radius, 0) : -1;
}

/* Is it in the cell of the frame? By a difference, which is rounded: less is said than tahr__frame_holds does. */
static inline int is_in_cell(tahr_vec3 p)
{
    return (p.x >= 0) & (p.x < CELL) & (p.y >= 0) & (p.y < CELL) & (p.z >= 0) & (p.z < CELL);
}

/* 0: it is not a walk that concerns this cache. */
static inline int read_walk(const tahr__cache *cache, const tahr_walk *walk, local_walk *w)
{
    const tahr__footing *f = &cache->footing;
    const tahr_vec3 p = v_sub(walk->position, f->origin);
    const double least = d_min(walk->shape->radius, walk->foot->radius) + walk->margin;
    w->half = half_of(walk->shape);
    w->reach = walk->shape->radius + walk->margin;
    w->foot_radius = walk->foot->radius;
    w->foot_reach = walk->foot->radius + walk->margin;
    if (!is_in_cell(p) || !tahr__same_vec(&f->up, &walk->up) || walk->mask != cache->mask) return 0;
    if (w->half < 0 || half_of(walk->foot) != 0 || !(least > SMALL && d_max(w->reach, w->foot_reach) < LARGE)) return 0;
    w->from = turned(cache, p);
    w->way = turned(cache, walk->motion);
    w->to = v_add(w->from, w->way);
    w->foot = turned(cache, v_sub(walk->foot_position, f->origin));
    w->down = turned(cache, walk->foot_motion);
    return 1;
}

/* Does the body stay over the floor, which it may go along? way_of (vicinity.c) without a root. */
static inline int stays_over(const tahr__footing *f, const local_walk *w)
{
    const double height = v_dot(f->cross, v_sub(w->from, f->on)) - w->half * f->cross.z;
    const double change = v_dot(f->cross, w->way), slope = 0.5 * TAHR__PARALLEL * f->length;
    if (height < (w->reach - 0.5 * TAHR__ARRIVED) * f->length) return 0;
    return change >= 0 || change * change <= slope * slope * v_dot(w->way, w->way) ||
           height + change >= (w->reach + SPARE) * f->length;
}

/* Where the foot is stopped by the plane; 0: not, or not plainly. */
static inline int comes_down(const tahr__footing *f, const local_walk *w, tahr__found *found)
{
    const double first = v_dot(f->cross, v_sub(w->foot, f->on)), rate = -v_dot(f->cross, w->down);
    const double gap = first - (w->foot_reach + 0.5 * TAHR__ARRIVED) * f->length;
    if (gap < -0.5 * TAHR__ARRIVED * f->length || !(first - rate < w->foot_reach * f->length)) return 0;
    if (!(rate > 0) || rate * rate < STEEP2 * (f->length * f->length) * v_dot(w->down, w->down) || gap > rate) return 0;
    found->t = gap <= 0 ? 0 : gap / rate;
    const tahr_vec3 centre = v_mad(w->foot, w->down, found->t), unit = v_scale(f->cross, f->inverse);
    const double height = v_dot(f->cross, v_sub(centre, f->on)) * f->inverse;
    found->point = v_mad(centre, unit, -height);
    found->gap = height - w->foot_radius;
    return height - w->foot_reach <= TAHR__ARRIVED && height >= w->foot_radius && height > SPARE;
}

/* Squares of how far an upright segment comes from that of the place. */
static inline double away2(const tahr__footing *f, tahr_vec3 p, double half)
{
    double x = p.x - f->at.x, y = p.y - f->at.y, z = d_max(fabs(p.z - f->at.z) + half - f->half, 0);
    return (x * x + y * y) + z * z;
}

/* Is all of it in what has been gathered, and as near to the place as nothing else is? Of what is convex the ends say
 * enough. */
static inline int is_in_clear(const tahr__cache *cache, const local_walk *w, tahr_vec3 end)
{
    const tahr__footing *f = &cache->footing;
    const double reach = d_max(w->reach, w->foot_reach), room = f->clear - reach - SPARE,
                 more = reach + 10 * TAHR__SLACK;
    const tahr_vec3 low = v_min(v_min(w->from, w->to), v_min(w->foot, end)),
                    high = v_max(v_max(w->from, w->to), v_max(w->foot, end));
    const tahr_bounds box = {v_make(low.x - more, low.y - more, low.z - (w->half + more)),
                             v_make(high.x + more, high.y + more, high.z + (w->half + more))};
    const double far2 = d_max(d_max(away2(f, w->from, w->half), away2(f, w->to, w->half)),
                              d_max(away2(f, w->foot, 0), away2(f, end, 0)));
    return room > 0 && far2 <= room * room && box_inside(&box, &cache->local);
}

static inline int is_inside(const tahr__footing *f, tahr_vec3 place)
{
    const tahr_vec3 off = v_sub(place, f->spot);
    return f->inside > 0 && v_dot(off, off) <= f->inside * f->inside;
}

static inline void fill(const tahr__cache *cache, const tahr__found *found, tahr_hit *hit)
{
    const tahr__footing *f = &cache->footing;
    const tahr_vec3 point = f->turned ? m_unapply(&cache->frame.turn, found->point) : found->point;
    hit->blocking = 1;
    hit->start_overlap = hit->unknown = hit->sensor = 0;
    hit->fraction = found->t;
    hit->distance = found->gap;
    hit->depth = 0;
    hit->normal = hit->surface_normal = f->normal;
    hit->point = v_add(f->origin, point);
    hit->walkable_angle = f->walkable_angle;
    hit->walkable_rule = f->walkable_rule;
    hit->surface = f->surface;
    hit->body = f->body;
    hit->feature = f->feature;
}

int tahr__footing_holds(tahr_query_context *context, const tahr_walk *walk, tahr_hit *hit)
{
    tahr__cache *cache = context->cache;
    const tahr__footing *f = &cache->footing;
    local_walk w;
    tahr__found found;
    if (!(f->clear > 0) || !read_walk(cache, walk, &w) || !stays_over(f, &w) || !comes_down(f, &w, &found) ||
        !is_inside(f, found.point) || !is_in_clear(cache, &w, v_mad(w.foot, w.down, found.t))) {
        return 0;
    }
    fill(cache, &found, hit);
    cache->recent[1] = f->under;
    context->narrow_tests++;
    context->narrow_iterations++;
    return 1;
}
