/* SPDX-License-Identifier: MIT
 * footing.c: a walk over the inside of one triangle, in air that is known to be clear: from five lines of memory.
 *
 * Where the walk goes no farther from the place that was measured than everything above the floor was from it, less
 * what the shape reaches, nothing of that is met; what lies in the floor or below it is not met by who stays above; and
 * of the floor there is one triangle alone where the foot comes down. What is nearest of all is behind fences
 * (fence.h). That is what vicinity.c finds out at length, and here it is only asked whether it still holds. What is
 * left is to say when the point of the foot comes to a plane: plane_earliest, tahr__probe_face and tahr__fill_hit, the
 * same operations in the same order, where none of their exceptions can happen. */
#include "footing.h"

#include "fence.h"
#include "ground.h"

/* As in vicinity.c, against rounding and arrival (m), twice: for planes that are one but for rounding. */
#define SPARE 2e-6
/* Places that are one but for rounding (m). */
#define SAME 1e-9
/* Of a foot that goes less far (m) it is not said that it goes straight down. */
#define LEAST_WAY 1e-4

/* A walk in the frame of the cache, whose foot goes straight down from where the body ends: all of both is between an
 * upright segment at the start of the body and one at its end, which is longer by the way of the foot. */
typedef struct local_walk {
    tahr_vec3 from, way, to, foot, down;
    double half, reach, foot_radius, foot_reach;
    double most; /* of both reaches */
} local_walk;

/* Half the axis of a round shape; < 0: it is not one. */
static inline double half_of(const tahr_shape *shape)
{
    if (shape->type == TAHR_SHAPE_CAPSULE) return d_max(shape->half_height - shape->radius, 0);
    return shape->type == TAHR_SHAPE_SPHERE ? 0 : -1;
}

/* Is it in the cell of the frame? By a difference, which is rounded: less is said than tahr__frame_holds does. */
static inline int is_in_cell(tahr_vec3 p)
{
    return p.x >= 0 && p.x < TAHR__CELL && p.y >= 0 && p.y < TAHR__CELL && p.z >= 0 && p.z < TAHR__CELL;
}

static inline int is_plumb(const local_walk *w)
{
    return w->down.z < -LEAST_WAY && fabs(w->foot.x - w->to.x) + fabs(w->down.x) <= SAME &&
           fabs(w->foot.y - w->to.y) + fabs(w->down.y) <= SAME;
}

/* 0: it is not a walk that concerns this cache. */
static inline int read_walk(const tahr__cache *cache, const tahr_walk *walk, local_walk *w)
{
    const tahr__footing *f = &cache->footing;
    const tahr_vec3 p = v_sub(walk->position, f->origin);
    if (f->steep) return 0;
    if (!is_in_cell(p) || !tahr__same_vec(&f->up, &walk->up) || walk->mask != cache->mask) return 0;
    w->half = half_of(walk->shape);
    w->reach = walk->shape->radius + walk->margin;
    w->foot_radius = walk->foot->radius;
    w->foot_reach = w->foot_radius + walk->margin;
    w->most = d_max(w->reach, w->foot_reach);
    if (w->half < 0 || half_of(walk->foot) != 0) return 0;
    if (!(w->reach > TAHR__SMALL && w->foot_reach > TAHR__SMALL && w->most < TAHR__LARGE)) return 0;
    w->from = p;
    w->way = walk->motion;
    w->foot = v_sub(walk->foot_position, f->origin);
    w->down = walk->foot_motion;
    if (f->turned) {
        const tahr__mat *turn = &cache->frame.turn;
        w->from = m_apply(turn, w->from);
        w->way = m_apply(turn, w->way);
        w->foot = m_apply(turn, w->foot);
        w->down = m_apply(turn, w->down);
    }
    w->to = v_add(w->from, w->way);
    return is_plumb(w);
}

/* Does the body stay over the floor, which it may go along? way_of (vicinity.c) without a root. */
static inline int stays_over(const tahr__footing *f, const local_walk *w)
{
    const double height = v_dot(f->cross, v_sub(w->from, f->on)) - w->half * f->cross.z,
                 change = v_dot(f->cross, w->way);
    if (height < (w->reach - 0.5 * TAHR__ARRIVED) * f->length) return 0;
    if (change >= 0 || height + change >= (w->reach + SPARE) * f->length) return 1;
    const double slope = 0.5 * TAHR__PARALLEL * f->length;
    return change * change <= slope * slope * v_dot(w->way, w->way);
}

/* Where the foot is stopped by the plane. */
typedef struct landing {
    double t, gap;
    tahr_vec3 centre, point; /* of the foot; on the floor */
} landing;

/* 0: it is not, or not plainly. */
static inline int comes_down(const tahr__footing *f, const local_walk *w, landing *out)
{
    const double first = v_dot(f->cross, v_sub(w->foot, f->on)), rate = -v_dot(f->cross, w->down);
    const double reach = w->foot_reach * f->length, gap = first - (w->foot_reach + 0.5 * TAHR__ARRIVED) * f->length;
    if (!(first >= reach && first - rate < reach && rate > 0 && gap <= rate)) return 0;
    out->t = gap <= 0 ? 0 : gap / rate;
    out->centre = v_mad(w->foot, w->down, out->t);
    const double height = v_dot(f->cross, v_sub(out->centre, f->on)) * f->inverse;
    out->point = v_mad(out->centre, v_scale(f->cross, f->inverse), -height);
    out->gap = height - w->foot_radius;
    return height - w->foot_reach <= TAHR__ARRIVED && height >= w->foot_radius && height > SPARE;
}

/* An upright segment. */
typedef struct upright {
    double x, y, low, high;
} upright;

/* Of the body at its start. */
static inline upright start_of(const local_walk *w)
{
    return (upright){w->from.x, w->from.y, w->from.z - w->half, w->from.z + w->half};
}

/* Of the body at its end and all of the foot. */
static inline upright end_of(const local_walk *w, const landing *end)
{
    return (upright){w->to.x, w->to.y, d_min(w->to.z - w->half, end->centre.z), d_max(w->to.z + w->half, w->foot.z)};
}

/* Is all of it in what has been gathered? */
static inline int is_gathered(const tahr__cache *cache, const upright *a, const upright *b, double reach)
{
    const tahr_bounds *in = &cache->local;
    const double more = reach + 10 * TAHR__SLACK;
    return d_min(a->x, b->x) - more >= in->min.x && d_max(a->x, b->x) + more <= in->max.x &&
           d_min(a->y, b->y) - more >= in->min.y && d_max(a->y, b->y) + more <= in->max.y &&
           d_min(a->low, b->low) - more >= in->min.z && d_max(a->high, b->high) + more <= in->max.z;
}

/* Square of how far one comes from that of the place. */
static inline double away2(const tahr__footing *f, const upright *u)
{
    const double x = u->x - f->at.x, y = u->y - f->at.y,
                 z = d_max(d_max(u->high - f->at.z, f->at.z - u->low) - f->half, 0);
    return (x * x + y * y) + z * z;
}

static inline int is_fenced_off(const tahr__cache *cache, const upright *u, double reach)
{
    return tahr__fences_hold(&cache->fences, v_make(u->x, u->y, u->low), u->high, reach);
}

static inline void fill(const tahr__cache *cache, const landing *end, tahr_hit *hit)
{
    const tahr__footing *f = &cache->footing;
    const tahr_vec3 point = f->turned ? m_unapply(&cache->frame.turn, end->point) : end->point;
    hit->blocking = 1;
    hit->start_overlap = hit->unknown = hit->sensor = 0;
    hit->fraction = end->t;
    hit->distance = end->gap;
    hit->depth = 0;
    hit->normal = hit->surface_normal = f->normal;
    hit->point = v_add(f->origin, point);
    hit->walkable_angle = f->walkable_angle;
    hit->walkable_rule = f->walkable_rule;
    hit->surface = f->surface;
    hit->body = f->body;
    hit->feature = f->feature;
}

/* What is not said by distances and fences. */
static uint32_t look_closer(const tahr__native *world, tahr_query_context *context, const tahr_walk *walk,
                            const local_walk *w, const landing *end)
{
    const tahr__cache *cache = context->cache;
    const tahr__footing *f = &cache->footing;
    const upright first = start_of(w), last = end_of(w, end);
    const double from2 = away2(f, &first), far2 = d_max(from2, away2(f, &last)), room = f->clear - w->most - SPARE;
    const int near = room > 0 && far2 <= room * room, drifted = from2 > TAHR__DRIFT * TAHR__DRIFT;
    if (!near && drifted) return TAHR__UNCLEAR;
    tahr__doubt doubt = {.body_start = w->from,
                         .body_motion = w->way,
                         .foot_start = w->foot,
                         .foot_motion = w->down,
                         .half = w->half,
                         .until = end->t,
                         .most = sqrt(far2) + w->most + SPARE};
    if (near) {
        doubt.fences = tahr__fences_fail(&cache->fences, v_make(first.x, first.y, first.low), first.high, w->most) |
                       tahr__fences_fail(&cache->fences, v_make(last.x, last.y, last.low), last.high, w->most);
    }
    if (tahr__doubt_settle(world, context, walk, &doubt)) return TAHR__LANDED;
    return drifted ? TAHR__UNCLEAR : TAHR__BARRED;
}

/* Of the body at its start, and at its end with the foot: nothing is met between them, if nothing is at either. */
static inline int is_clear(const tahr__cache *cache, const local_walk *w, const upright *first, const upright *last)
{
    const tahr__footing *f = &cache->footing;
    const double far2 = d_max(away2(f, first), away2(f, last)), room = f->clear - w->most - SPARE;
    if (!(room > 0 && far2 <= room * room)) return 0;
    return !f->fenced || (is_fenced_off(cache, first, w->most) && is_fenced_off(cache, last, w->most));
}

/* Onto another triangle of the same floor, of which all else that is known holds as well. Far from the place that was
 * measured, where something is near, it is left to who measures anew and finds the triangle in one go: of two steps
 * that find out one half each neither is a short one. */
static int goes_over(const tahr__native *world, tahr_query_context *context, const local_walk *w, landing *end)
{
    const tahr__cache *cache = context->cache;
    const upright first = start_of(w);
    tahr__query query;
    if (cache->footing.fenced && away2(&cache->footing, &first) > TAHR__DRIFT * TAHR__DRIFT) return 0;
    ask_in_cache(&query, world, context);
    return tahr__ground_find(&query, end->point) && !cache->footing.steep && comes_down(&cache->footing, w, end) &&
           ground_is_at_spot(cache, end->point);
}

uint32_t tahr__footing_walk(const tahr__native *world, tahr_query_context *context, const tahr_walk *walk,
                            tahr_hit *hit)
{
    tahr__cache *cache = context->cache;
    const tahr__footing *f = &cache->footing;
    local_walk w;
    landing end;
    if (!(f->clear > 0) || !read_walk(cache, walk, &w) || !stays_over(f, &w) || !comes_down(f, &w, &end) ||
        (!ground_is_at_spot(cache, end.point) && !goes_over(world, context, &w, &end))) {
        return TAHR__UNCLEAR;
    }
    const upright first = start_of(&w), last = end_of(&w, &end);
    if (!is_gathered(cache, &first, &last, w.most)) return TAHR__UNCLEAR;
    if (!is_clear(cache, &w, &first, &last)) {
        const uint32_t way = look_closer(world, context, walk, &w, &end);
        if (way != TAHR__LANDED) return way;
    }
    fill(cache, &end, hit);
    cache->recent[1] = f->under;
    context->narrow_tests++;
    context->narrow_iterations++;
    return TAHR__LANDED;
}
