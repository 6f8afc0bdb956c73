/* SPDX-License-Identifier: MIT
 * fake_world.c: exact sweeps of upright shapes against half-spaces and boxes. A box against a capsule is a sphere
 * against the box made longer by the capsule's core; the squared distance along a motion is piecewise quadratic. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fake_world.h"

typedef tahr_vec3 v3;

v3 fake_vec(double x, double y, double z)
{
    v3 v = {x, y, z};
    return v;
}

static double dot3(v3 a, v3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

v3 fake_turn(tahr_quat q, v3 v)
{
    double xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z, xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z;
    double wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
    return fake_vec((1 - 2 * (yy + zz)) * v.x + 2 * (xy - wz) * v.y + 2 * (xz + wy) * v.z,
                    2 * (xy + wz) * v.x + (1 - 2 * (xx + zz)) * v.y + 2 * (yz - wx) * v.z,
                    2 * (xz - wy) * v.x + 2 * (yz + wx) * v.y + (1 - 2 * (xx + yy)) * v.z);
}

v3 fake_turn_back(tahr_quat q, v3 v)
{
    tahr_quat c = {-q.x, -q.y, -q.z, q.w};
    return fake_turn(c, v);
}

void fake_world_init(fake_world *world)
{
    memset(world, 0, sizeof *world);
    world->frame.w = 1;
}

void fake_world_flat(fake_world *world)
{
    fake_world_init(world);
    fake_add_plane(world, fake_vec(0, 0, 1), 0);
}

static fake_solid *add_solid(fake_world *world, int kind)
{
    assert_true(world->count < FAKE_SOLIDS);
    fake_solid *s = &world->solids[world->count++];
    s->kind = kind;
    return s;
}

fake_solid *fake_add_plane(fake_world *world, v3 normal, double offset)
{
    fake_solid *s = add_solid(world, FAKE_HALF_SPACE);
    s->normal = normal;
    s->offset = offset;
    return s;
}

fake_solid *fake_add_box(fake_world *world, v3 min, v3 max)
{
    fake_solid *s = add_solid(world, FAKE_BOX);
    s->min = min;
    s->max = max;
    return s;
}

fake_solid *fake_add_slope(fake_world *world, double degrees)
{
    double a = degrees * acos(-1.0) / 180;
    return fake_add_plane(world, fake_vec(-sin(a), 0, cos(a)), 0);
}

/* A query in the own frame: a core box (half sizes) rounded by radius. */
typedef struct probe {
    v3 at, motion, up, x, y;
    tahr_shape shape;
} probe;

typedef struct answer {
    double distance;
    v3 normal;
} answer;

static double reach(const probe *p, v3 n)
{
    const tahr_shape *s = &p->shape;
    if (s->type == TAHR_SHAPE_BOX) {
        return s->half_height * fabs(dot3(n, p->up)) + s->half_x * fabs(dot3(n, p->x)) +
               s->half_y * fabs(dot3(n, p->y));
    }
    return s->radius + (s->half_height - s->radius) * fabs(dot3(n, p->up));
}

/* The solid box grown by the core of the shape. */
static void grown(const fake_solid *s, const probe *p, double low[3], double high[3])
{
    int box = p->shape.type == TAHR_SHAPE_BOX;
    v3 core = {box ? p->shape.half_x : 0, box ? p->shape.half_y : 0, p->shape.half_height - p->shape.radius};
    assert_true(p->shape.type == TAHR_SHAPE_SPHERE || fabs(p->up.z) > 1 - 1e-9);
    low[0] = s->min.x - core.x, low[1] = s->min.y - core.y, low[2] = s->min.z - core.z;
    high[0] = s->max.x + core.x, high[1] = s->max.y + core.y, high[2] = s->max.z + core.z;
}

static answer box_distance(const double low[3], const double high[3], double radius, v3 at)
{
    double p[3] = {at.x, at.y, at.z}, out[3], n[3] = {0, 0, 0}, d2 = 0, inside = -INFINITY;
    int face = 0;
    for (int i = 0; i < 3; i++) {
        out[i] = p[i] < low[i] ? p[i] - low[i] : (p[i] > high[i] ? p[i] - high[i] : 0);
        d2 += out[i] * out[i];
        double d = fmax(low[i] - p[i], p[i] - high[i]);
        if (d > inside) {
            inside = d;
            face = i;
        }
    }
    double d = sqrt(d2);
    if (d > 0) {
        answer a = {d - radius, {out[0] / d, out[1] / d, out[2] / d}};
        return a;
    }
    n[face] = p[face] - low[face] < high[face] - p[face] ? -1 : 1;
    answer a = {inside - radius, {n[0], n[1], n[2]}};
    return a;
}

static answer distance_to(const fake_solid *s, const probe *p, v3 at)
{
    if (s->kind == FAKE_HALF_SPACE) {
        answer a = {dot3(s->normal, at) - s->offset - reach(p, s->normal), s->normal};
        return a;
    }
    double low[3], high[3];
    grown(s, p, low, high);
    return box_distance(low, high, p->shape.radius, at);
}

/* First t in (0, 1] at which the squared distance to the grown box falls to r^2; INFINITY: never. The start is
 * outside. */
static double box_entry(const double low[3], const double high[3], double r, v3 at, v3 motion)
{
    double p[3] = {at.x, at.y, at.z}, u[3] = {motion.x, motion.y, motion.z};
    double cuts[8] = {0, 1};
    int n = 2;
    for (int i = 0; i < 3; i++) {
        for (int side = 0; side < 2 && u[i] != 0; side++) {
            double t = ((side ? high[i] : low[i]) - p[i]) / u[i];
            if (t > 0 && t < 1) {
                cuts[n++] = t;
            }
        }
    }
    for (int i = 1; i < n; i++) {
        for (int j = i; j > 0 && cuts[j] < cuts[j - 1]; j--) {
            double swap = cuts[j];
            cuts[j] = cuts[j - 1], cuts[j - 1] = swap;
        }
    }
    for (int c = 0; c + 1 < n; c++) {
        double middle = 0.5 * (cuts[c] + cuts[c + 1]), qa = 0, qb = 0, qc = -r * r;
        for (int i = 0; i < 3; i++) {
            double m = p[i] + u[i] * middle;
            double off = m < low[i] ? p[i] - low[i] : (m > high[i] ? p[i] - high[i] : 0);
            if (m < low[i] || m > high[i]) {
                qa += u[i] * u[i], qb += u[i] * off, qc += off * off;
            }
        }
        double disc = qb * qb - qa * qc;
        if (r == 0 && qa == 0) {
            return cuts[c]; /* inside the sharp box during this piece */
        }
        if (qa > 0 && disc >= 0 && qb < 0) {
            double t = qc / (-qb + sqrt(disc)); /* the smaller root without cancellation */
            /* Rounding may put the root of a start just outside before 0, or between two pieces. */
            if ((c == 0 || t >= cuts[c] - 1e-12) && t <= cuts[c + 1]) {
                return t < 0 ? 0 : t;
            }
        }
    }
    return INFINITY;
}

static double entry(const fake_solid *s, const probe *p, double margin)
{
    if (s->kind == FAKE_HALF_SPACE) {
        double gap = dot3(s->normal, p->at) - s->offset - reach(p, s->normal) - margin;
        double rate = -dot3(s->normal, p->motion);
        return rate > 0 && gap <= rate ? fmax(gap / rate, 0) : INFINITY;
    }
    double low[3], high[3];
    grown(s, p, low, high);
    return box_entry(low, high, p->shape.radius + margin, p->at, p->motion);
}

/* The face of a solid at a contact normal: that which opposes `against` most among those the normal leans on. */
static uint32_t face_of(const fake_solid *s, v3 normal, v3 against, v3 *face)
{
    double n[3] = {normal.x, normal.y, normal.z}, best = INFINITY;
    uint32_t index = 0;
    *face = normal;
    if (s->kind == FAKE_HALF_SPACE) {
        return 0;
    }
    for (uint32_t i = 0; i < 3; i++) {
        double f[3] = {0, 0, 0};
        f[i] = n[i] > 0 ? 1 : -1;
        v3 candidate = {f[0], f[1], f[2]};
        if (fabs(n[i]) > 1e-9 && dot3(candidate, against) < best) {
            best = dot3(candidate, against);
            *face = candidate;
            index = 2 * i + (n[i] > 0);
        }
    }
    return index;
}

/* The point on the solid nearest to the shape placed at `at`. */
static v3 touch_point(const fake_solid *s, const probe *p, v3 at, answer a)
{
    if (s->kind == FAKE_BOX) {
        double core = p->shape.half_height - p->shape.radius;
        v3 q = {fmin(fmax(at.x, s->min.x), s->max.x), fmin(fmax(at.y, s->min.y), s->max.y), 0};
        q.z = a.normal.z > 0 ? s->max.z : (a.normal.z < 0 ? s->min.z : fmin(fmax(at.z - core, s->min.z), s->max.z));
        return q;
    }
    double side = dot3(a.normal, p->up) > 0 ? -1 : (dot3(a.normal, p->up) < 0 ? 1 : 0);
    double core = p->shape.half_height - p->shape.radius, down = p->shape.radius + a.distance;
    if (p->shape.type == TAHR_SHAPE_BOX) {
        down = a.distance;
        core = p->shape.half_height;
        double sx = dot3(a.normal, p->x), sy = dot3(a.normal, p->y);
        double hx = sx > 1e-9 ? -p->shape.half_x : (sx < -1e-9 ? p->shape.half_x : 0);
        double hy = sy > 1e-9 ? -p->shape.half_y : (sy < -1e-9 ? p->shape.half_y : 0);
        at = fake_vec(at.x + p->x.x * hx + p->y.x * hy, at.y + p->x.y * hx + p->y.y * hy,
                      at.z + p->x.z * hx + p->y.z * hy);
    }
    return fake_vec(at.x + side * core * p->up.x - down * a.normal.x, at.y + side * core * p->up.y - down * a.normal.y,
                    at.z + side * core * p->up.z - down * a.normal.z);
}

static probe probe_of(const fake_world *w, const tahr_shape *shape, v3 at, v3 up, tahr_quat q)
{
    probe p = {fake_turn_back(w->frame, at), {0, 0, 0}, fake_turn_back(w->frame, up), {1, 0, 0}, {0, 1, 0}, *shape};
    p.x = fake_turn_back(w->frame, fake_turn(q, p.x));
    p.y = fake_turn_back(w->frame, fake_turn(q, p.y));
    return p;
}

static void fill_hit(const fake_world *w, uint32_t i, const probe *p, double t, tahr_hit *hit)
{
    const fake_solid *s = &w->solids[i];
    v3 at = fake_vec(p->at.x + p->motion.x * t, p->at.y + p->motion.y * t, p->at.z + p->motion.z * t), face;
    answer a = distance_to(s, p, at);
    memset(hit, 0, sizeof *hit);
    hit->blocking = 1;
    hit->fraction = t;
    hit->distance = a.distance;
    hit->feature = face_of(s, a.normal, p->motion, &face);
    hit->normal = fake_turn(w->frame, a.normal);
    hit->surface_normal = fake_turn(w->frame, face);
    hit->point = fake_turn(w->frame, touch_point(s, p, at, a));
    hit->walkable_rule = s->walkable_rule;
    hit->walkable_angle = s->walkable_angle;
    hit->surface = s->surface;
    hit->body = i;
    if (a.distance < 0) {
        hit->start_overlap = t == 0;
        hit->depth = -a.distance;
    }
}

static int is_asked(uint32_t body, uint32_t named, uint32_t flags)
{
    return (body == named) == ((flags & TAHR_SWEEP_ONLY_BODY) != 0);
}

tahr_status fake_sweep(void *user, const tahr_sweep *query, tahr_hit *hit)
{
    fake_world *w = user;
    probe p = probe_of(w, &query->shape, query->position, query->up, query->orientation);
    double first = INFINITY, deepest = 0;
    p.motion = fake_turn_back(w->frame, query->motion);
    w->sweeps++;
    if (w->on_sweep) {
        w->on_sweep(w);
    }
    for (uint32_t i = 0; i < w->count; i++) {
        if (!is_asked(i, query->ignore_body, query->flags)) {
            continue;
        }
        answer a = distance_to(&w->solids[i], &p, p.at);
        int approaches = dot3(a.normal, p.motion) < 0;
        if (a.distance < 0) {
            if (-a.distance > deepest && (approaches || !(query->flags & TAHR_SWEEP_LEAVE_OVERLAP))) {
                deepest = -a.distance;
                fill_hit(w, i, &p, 0, hit);
            }
            continue;
        }
        double t = a.distance <= query->margin ? (approaches ? 0 : INFINITY) : entry(&w->solids[i], &p, query->margin);
        if (deepest == 0 && t <= 1 && t < first) {
            first = t;
            fill_hit(w, i, &p, t, hit);
            hit->start_overlap = 0;
            hit->depth = 0;
        }
    }
    return TAHR_OK;
}

tahr_status fake_contacts(void *user, const tahr_contact_query *query, tahr_contact *contacts, uint32_t capacity,
                          uint32_t *count)
{
    fake_world *w = user;
    probe p = probe_of(w, &query->shape, query->position, query->up, query->orientation);
    tahr_contact all[FAKE_SOLIDS];
    uint32_t n = 0;
    w->contact_queries++;
    for (uint32_t i = 0; i < w->count; i++) {
        tahr_hit hit;
        answer a = distance_to(&w->solids[i], &p, p.at);
        if (a.distance > query->margin || !is_asked(i, query->ignore_body, 0)) {
            continue;
        }
        p.motion = fake_vec(-a.normal.x, -a.normal.y, -a.normal.z);
        fill_hit(w, i, &p, 0, &hit);
        tahr_contact c = {.distance = a.distance,
                          .normal = hit.normal,
                          .surface_normal = hit.surface_normal,
                          .point = hit.point,
                          .walkable_angle = hit.walkable_angle,
                          .walkable_rule = hit.walkable_rule,
                          .surface = hit.surface,
                          .body = i,
                          .feature = hit.feature};
        uint32_t at = n++;
        for (; at > 0 && all[at - 1].distance > c.distance; at--) {
            all[at] = all[at - 1];
        }
        all[at] = c;
    }
    *count = n < capacity ? n : capacity;
    memcpy(contacts, all, *count * sizeof all[0]);
    return n > capacity ? TAHR_TRUNCATED : TAHR_OK;
}

tahr_callbacks fake_callbacks(fake_world *world)
{
    tahr_callbacks c = {.struct_size = sizeof c, .user = world, .sweep = fake_sweep, .contacts = fake_contacts};
    return c;
}

double fake_clearance(const fake_world *world, const tahr_shape *shape, v3 at)
{
    probe p = {at, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, *shape};
    double least = INFINITY;
    for (uint32_t i = 0; i < world->count; i++) {
        least = fmin(least, distance_to(&world->solids[i], &p, at).distance);
    }
    return least;
}
