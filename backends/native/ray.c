/* SPDX-License-Identifier: MIT
 * ray.c: the ray slot. Triangles by sheared edge functions (Woop, Benthin, Wald 2013, "Watertight ray/triangle
 * intersection"): two triangles that share an edge compute it with exactly opposite signs, so nothing slips between. */
#include "../common/one_way.h"
#include "scene.h"

#include <string.h>

typedef struct ray_state {
    tahr__search search;
    tahr__found best;
    uint32_t found;
    int axis[3];     /* the motion's largest component last */
    double shear[2]; /* of the other two against it */
} ray_state;

static void set_axes(ray_state *s, tahr_vec3 motion)
{
    tahr_vec3 a = v_abs(motion);
    int z = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    s->axis[0] = (z + 1) % 3;
    s->axis[1] = (z + 2) % 3;
    s->axis[2] = z;
    s->shear[0] = v_get(motion, s->axis[0]) / v_get(motion, z);
    s->shear[1] = v_get(motion, s->axis[1]) / v_get(motion, z);
}

/* Fraction at which the ray meets the triangle, or a negative number. */
static double meet(const ray_state *s, const tahr_vec3 v[3])
{
    double x[3], y[3], z[3], edge[3];
    const tahr__query *query = s->search.query;
    for (int i = 0; i < 3; i++) {
        tahr_vec3 r = v_sub(v[i], query->start);
        z[i] = v_get(r, s->axis[2]);
        x[i] = v_get(r, s->axis[0]) - s->shear[0] * z[i];
        y[i] = v_get(r, s->axis[1]) - s->shear[1] * z[i];
    }
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        edge[i] = x[k] * y[j] - y[k] * x[j];
    }
    int inside = (edge[0] >= 0 && edge[1] >= 0 && edge[2] >= 0) || (edge[0] <= 0 && edge[1] <= 0 && edge[2] <= 0);
    double sum = edge[0] + edge[1] + edge[2];
    if (!inside || sum == 0) return -1;
    double depth = (edge[0] * z[0] + edge[1] * z[1] + edge[2] * z[2]) / sum;
    return depth / v_get(query->motion, s->axis[2]);
}

static int probe_triangle(const ray_state *s, const tahr__prim *prim, tahr__found *f)
{
    const tahr__query *query = s->search.query;
    double t = meet(s, prim->facet.v);
    if (!(t >= 0 && t <= 1)) return 0;
    tahr_vec3 n = prim->facet.cross;
    double along = v_dot(n, query->motion);
    if (along == 0 || (along > 0 && !(prim->kind & TAHR__TWO_SIDED))) return 0;
    tahr__witness w;
    tahr__contact_normals normals;
    normals.measure = 0;
    memset(&w, 0, sizeof w);
    w.feature = TAHR__FACE;
    w.normal = v_scale(n, (along > 0 ? -1 : 1) / prim->facet.length);
    if (tahr__resolve(query, prim, query->start, &w, query->motion, &normals) != TAHR__ACCEPTED) return 0;
    f->t = t;
    f->gap = 0;
    f->normal = f->face = normals.normal;
    f->point = v_mad(query->start, query->motion, t);
    f->overlap = f->unknown = f->edge = 0;
    f->body = prim->body;
    f->item = prim->item;
    f->kind = prim->kind;
    f->surface = prim->surface;
    f->walkable_rule = prim->walkable_rule;
    f->walkable_angle = prim->walkable_angle;
    f->feature = prim->feature;
    return 1;
}

static void visit(tahr__search *search, const tahr__prim *prim)
{
    ray_state *s = (ray_state *)search;
    const tahr__query *query = search->query;
    tahr__found f;
    if (prim->item & TAHR__ITEM_SOLID) return;
    if (prim->item & TAHR__ITEM_ROUND) {
        /* A ray is the sweep of a point. One that starts inside leaves without a hit. */
        tahr__ask ask = {0, s->found ? s->best.t : 1.0, NULL};
        if (tahr__probe_sweep(query, prim, &ask, &f) != TAHR__BLOCKED || f.overlap) return;
    } else {
        query->context->narrow_tests++;
        if (!probe_triangle(s, prim, &f)) return;
    }
    if (prim->kind & TAHR__ONE_WAY && -v_dot(f.normal, query->motion) < TAHR__ONE_WAY_TOP * query->motion_length)
        return;
    if (s->found && !tahr__found_before(&f, &s->best)) return;
    s->best = f;
    s->found = 1;
    search->box = tahr__query_box(query, f.t);
    search->narrowed = 1;
}

tahr_status tahr__native_ray(void *self, tahr_query_context *context, const tahr_ray *ray, tahr_hit *hit,
                             uint32_t *count)
{
    tahr__query query;
    ray_state s;
    tahr_status failed = TAHR_OK;
    const tahr__cache *cache = context->cache;
    tahr_vec3 up = cache && cache->announced ? cache->frame.up : v_make(0, 0, 1);
    *count = 0;
    tahr__query_begin(&query, self, context, ray->origin, up);
    query.motion = query.frame->turned ? m_apply(&query.frame->turn, ray->motion) : ray->motion;
    query.motion_length = v_length(query.motion);
    if (!(query.motion_length > 0)) return TAHR_OK;
    query.mask = ray->mask;
    query.ignore_body = ray->ignore_body;
    s.search.query = &query;
    s.search.box = tahr__query_box(&query, 1.0);
    s.search.reach = 0;
    s.search.narrowed = s.search.order = 0;
    s.search.visit = visit;
    s.found = 0;
    set_axes(&s, query.motion);
    query.failed = &failed;
    tahr__search_run(&s.search);
    if (failed < 0) return failed;
    if (!s.found) return TAHR_OK;
    tahr__fill_hit(&query, &s.best, hit);
    hit->distance = 0;
    *count = 1;
    return TAHR_OK;
}
