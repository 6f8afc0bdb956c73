/* SPDX-License-Identifier: MIT
 * scene_solid.c: triangles in the columns of a grid, looked at one by one. */
#include "scene_solid.h"

#include <math.h>
#include <stdlib.h>

struct scene_solid {
    const scene_mesh *mesh;
    double low[2], cell;
    uint32_t size[2];
    int two_sided;
    uint32_t *first, *items; /* items[first[c]..first[c + 1]] lie over column c */
};

typedef struct triangle {
    tahr_vec3 corner[3], normal; /* normal is not of unit length */
} triangle;

typedef struct span {
    uint32_t low[2], high[2];
} span;

static tahr_vec3 minus(tahr_vec3 a, tahr_vec3 b)
{
    return (tahr_vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}

static tahr_vec3 along(tahr_vec3 a, tahr_vec3 b, double t)
{
    return (tahr_vec3){a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
}

static double dot(tahr_vec3 a, tahr_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static tahr_vec3 cross(tahr_vec3 a, tahr_vec3 b)
{
    return (tahr_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static triangle get(const scene_mesh *mesh, uint32_t index)
{
    triangle t;
    for (int k = 0; k < 3; k++) {
        const double *v = mesh->vertices + 3 * (size_t)mesh->indices[3 * (size_t)index + (size_t)k];
        t.corner[k] = (tahr_vec3){v[0], v[1], v[2]};
    }
    t.normal = cross(minus(t.corner[1], t.corner[0]), minus(t.corner[2], t.corner[0]));
    return t;
}

static span columns(const scene_solid *s, const tahr_vec3 *points, int count, double reach)
{
    span r = {{s->size[0] - 1, s->size[1] - 1}, {0, 0}};
    for (int i = 0; i < count; i++) {
        const double p[2] = {points[i].x, points[i].y};
        for (int k = 0; k < 2; k++) {
            double top = (double)s->size[k] - 1, a = floor((p[k] - reach - s->low[k]) / s->cell);
            double b = floor((p[k] + reach - s->low[k]) / s->cell);
            uint32_t low = (uint32_t)fmin(fmax(a, 0), top), high = (uint32_t)fmin(fmax(b, 0), top);
            r.low[k] = low < r.low[k] ? low : r.low[k];
            r.high[k] = high > r.high[k] ? high : r.high[k];
        }
    }
    return r;
}

/* Counts (items NULL) or writes the columns of every triangle; cursor has one entry per column. */
static void fill(scene_solid *s, uint32_t *cursor)
{
    for (uint32_t i = 0; i < s->mesh->triangle_count; i++) {
        triangle t = get(s->mesh, i);
        span r = columns(s, t.corner, 3, 0);
        for (uint32_t y = r.low[1]; y <= r.high[1]; y++) {
            for (uint32_t x = r.low[0]; x <= r.high[0]; x++) {
                uint32_t *at = &cursor[y * s->size[0] + x];
                if (s->items) {
                    s->items[*at] = i;
                }
                ++*at;
            }
        }
    }
}

static void size_grid(scene_solid *s)
{
    double high[2] = {-HUGE_VAL, -HUGE_VAL};
    s->low[0] = s->low[1] = HUGE_VAL;
    s->cell = 1;
    for (uint32_t i = 0; i < s->mesh->vertex_count; i++) {
        for (int k = 0; k < 2; k++) {
            double x = s->mesh->vertices[3 * (size_t)i + (size_t)k];
            s->low[k] = fmin(s->low[k], x);
            high[k] = fmax(high[k], x);
        }
    }
    /* No more columns than a few for every triangle: a small mesh may be wide. */
    double wide[2] = {high[0] - s->low[0], high[1] - s->low[1]}, most = 1024 + 16.0 * s->mesh->triangle_count;
    s->cell = fmax(s->cell, fmax(sqrt(wide[0] * wide[1] / most), fmax(wide[0], wide[1]) / most));
    for (int k = 0; k < 2; k++) {
        s->size[k] = (uint32_t)(wide[k] / s->cell) + 1;
    }
}

scene_solid *scene_solid_open(const scene_mesh *mesh, int two_sided)
{
    scene_solid *s = calloc(1, sizeof *s);
    if (!s) {
        return NULL;
    }
    s->mesh = mesh;
    s->two_sided = two_sided;
    size_grid(s);
    size_t count = (size_t)s->size[0] * (size_t)s->size[1];
    uint32_t *cursor = calloc(count, sizeof *cursor);
    s->first = calloc(count + 1, sizeof *s->first);
    if (cursor && s->first) {
        fill(s, cursor);
        for (size_t c = 0; c < count; c++) {
            s->first[c + 1] = s->first[c] + cursor[c];
            cursor[c] = s->first[c];
        }
        s->items = calloc((size_t)s->first[count] + 1, sizeof *s->items);
    }
    if (s->items) {
        fill(s, cursor);
    }
    free(cursor);
    if (!s->items) {
        scene_solid_close(s);
        return NULL;
    }
    return s;
}

void scene_solid_close(scene_solid *s)
{
    if (s) {
        free(s->first);
        free(s->items);
        free(s);
    }
}

/* Whether the line through a along d passes inside the triangle; its plane is met at *t. Edges belong to it. */
static int pierces(const triangle *t, tahr_vec3 a, tahr_vec3 d, double *at)
{
    double slope = dot(t->normal, d), sides[3];
    if (slope == 0) {
        return 0;
    }
    *at = dot(t->normal, minus(t->corner[0], a)) / slope;
    tahr_vec3 p = along(a, (tahr_vec3){a.x + d.x, a.y + d.y, a.z + d.z}, *at);
    for (int k = 0; k < 3; k++) {
        tahr_vec3 edge = minus(t->corner[(k + 1) % 3], t->corner[k]);
        sides[k] = dot(t->normal, cross(edge, minus(p, t->corner[k])));
    }
    return sides[0] >= 0 && sides[1] >= 0 && sides[2] >= 0;
}

/* Nearest point of the triangle's plane to p, if it is inside. */
static double above(const triangle *t, tahr_vec3 p)
{
    double at;
    return pierces(t, p, t->normal, &at) ? fabs(at) * sqrt(dot(t->normal, t->normal)) : HUGE_VAL;
}

static double to_segment(tahr_vec3 p, tahr_vec3 a, tahr_vec3 b)
{
    tahr_vec3 d = minus(b, a);
    double size = dot(d, d), t = size > 0 ? fmin(fmax(dot(minus(p, a), d) / size, 0), 1) : 0;
    tahr_vec3 r = minus(p, along(a, b, t));
    return sqrt(dot(r, r));
}

/* Two segments: where their lines are nearest if that is inside both, else at one of the four ends. */
static double between(tahr_vec3 a, tahr_vec3 b, tahr_vec3 c, tahr_vec3 d)
{
    double best = fmin(fmin(to_segment(a, c, d), to_segment(b, c, d)), fmin(to_segment(c, a, b), to_segment(d, a, b)));
    tahr_vec3 u = minus(b, a), v = minus(d, c), n = cross(u, v), r = minus(c, a);
    double size = dot(n, n);
    if (size > 0) {
        double s = dot(cross(r, v), n) / size, t = dot(cross(r, u), n) / size;
        if (s >= 0 && s <= 1 && t >= 0 && t <= 1) {
            best = fmin(best, fabs(dot(r, n)) / sqrt(size));
        }
    }
    return best;
}

static double distance(const triangle *t, tahr_vec3 a, tahr_vec3 b)
{
    double at;
    tahr_vec3 d = minus(b, a);
    if (dot(d, d) > 0 && pierces(t, a, d, &at) && at >= 0 && at <= 1) {
        return 0;
    }
    double best = fmin(above(t, a), above(t, b));
    for (int k = 0; k < 3; k++) {
        best = fmin(best, between(a, b, t->corner[k], t->corner[(k + 1) % 3]));
    }
    return best;
}

/* Whether one range of numbers is more than reach away from another. */
static int beyond(double a, double b, const double corners[3], double reach)
{
    double low = fmin(fmin(corners[0], corners[1]), corners[2]), high = fmax(fmax(corners[0], corners[1]), corners[2]);
    return high < fmin(a, b) - reach || low > fmax(a, b) + reach;
}

/* Most triangles are farther than limit from the segment a b along some axis, or by their plane. */
static int apart(const triangle *t, tahr_vec3 a, tahr_vec3 b, double limit)
{
    const tahr_vec3 *c = t->corner;
    double from = dot(t->normal, minus(a, c[0])), to = dot(t->normal, minus(b, c[0]));
    double near = fmin(fabs(from), fabs(to)), reach = limit * (1 + 1e-9);
    if (from * to > 0 && near * near > reach * reach * dot(t->normal, t->normal)) {
        return 1;
    }
    return beyond(a.x, b.x, (const double[]){c[0].x, c[1].x, c[2].x}, reach) ||
           beyond(a.y, b.y, (const double[]){c[0].y, c[1].y, c[2].y}, reach) ||
           beyond(a.z, b.z, (const double[]){c[0].z, c[1].z, c[2].z}, reach);
}

double scene_solid_distance(const scene_solid *s, tahr_vec3 a, tahr_vec3 b, double limit, uint32_t *index)
{
    tahr_vec3 ends[2] = {a, b}, middle = along(a, b, 0.5);
    span r = columns(s, ends, 2, limit);
    double best = limit;
    for (uint32_t y = r.low[1]; y <= r.high[1]; y++) {
        const uint32_t *row = s->first + (size_t)y * s->size[0];
        for (uint32_t i = row[r.low[0]]; i < row[r.high[0] + 1]; i++) {
            triangle t = get(s->mesh, s->items[i]);
            int faces = s->two_sided || dot(t.normal, minus(middle, t.corner[0])) > 0;
            if (!faces || apart(&t, a, b, best)) {
                continue;
            }
            double d = distance(&t, a, b);
            if (d < best) {
                best = d;
                if (index) {
                    *index = s->items[i];
                }
            }
        }
    }
    return best;
}

int scene_solid_crossed(const scene_solid *s, tahr_vec3 a, tahr_vec3 b, uint32_t *index)
{
    tahr_vec3 ends[2] = {a, b}, d = minus(b, a);
    span r = columns(s, ends, 2, 0);
    for (uint32_t y = r.low[1]; y <= r.high[1]; y++) {
        const uint32_t *row = s->first + (size_t)y * s->size[0];
        for (uint32_t i = row[r.low[0]]; i < row[r.high[0] + 1]; i++) {
            triangle t = get(s->mesh, s->items[i]);
            double at;
            if ((s->two_sided || dot(t.normal, d) < 0) && pierces(&t, a, d, &at) && at >= 0 && at <= 1) {
                if (index) {
                    *index = s->items[i];
                }
                return 1;
            }
        }
    }
    return 0;
}
