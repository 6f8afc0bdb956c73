/* SPDX-License-Identifier: MIT
 * solid_oracle.c: see solid_oracle.h. */
#include "solid_oracle.h"

#include <math.h>

static solid_vec make(solid_real x, solid_real y, solid_real z)
{
    return (solid_vec){x, y, z};
}

static solid_vec from(tahr_vec3 v)
{
    return make(v.x, v.y, v.z);
}

static solid_vec add_scaled(solid_vec a, solid_vec b, solid_real s)
{
    return make(a.x + b.x * s, a.y + b.y * s, a.z + b.z * s);
}

static solid_real dot(solid_vec a, solid_vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static solid_vec cross(solid_vec a, solid_vec b)
{
    return make(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static solid_vec sub(solid_vec a, solid_vec b)
{
    return add_scaled(a, b, -1);
}

static solid_vec to_local(const solid *s, solid_vec d)
{
    return make(dot(s->frame[0], d), dot(s->frame[1], d), dot(s->frame[2], d));
}

void solid_place(solid *s, tahr_vec3 at, tahr_quat o)
{
    solid_real x = o.x, y = o.y, z = o.z, w = o.w, n = 2 / (x * x + y * y + z * z + w * w);
    s->at = from(at);
    s->frame[0] = make(1 - n * (y * y + z * z), n * (x * y + z * w), n * (x * z - y * w));
    s->frame[1] = make(n * (x * y - z * w), 1 - n * (x * x + z * z), n * (y * z + x * w));
    s->frame[2] = make(n * (x * z + y * w), n * (y * z - x * w), 1 - n * (x * x + y * y));
}

void solid_hull(solid *s)
{
    s->face_count = 0;
    for (int i = 0; i < s->vertex_count; i++) {
        for (int j = i + 1; j < s->vertex_count; j++) {
            for (int k = j + 1; k < s->vertex_count; k++) {
                int above = 0, below = 0;
                solid_vec n = cross(sub(s->vertices[j], s->vertices[i]), sub(s->vertices[k], s->vertices[i]));
                for (int m = 0; m < s->vertex_count; m++) {
                    solid_real height = dot(n, sub(s->vertices[m], s->vertices[i]));
                    above += m != i && m != j && m != k && height > 0;
                    below += m != i && m != j && m != k && height < 0;
                }
                if ((above && below) || s->face_count == SOLID_FACES) continue;
                int *face = s->faces[s->face_count++];
                face[0] = i;
                face[1] = above ? k : j;
                face[2] = above ? j : k;
            }
        }
    }
}

solid_real solid_extent(const solid *s, solid_vec world)
{
    solid_vec n = to_local(s, world), h = s->half;
    solid_real base = dot(s->at, world), level = sqrtl(n.x * n.x + n.y * n.y), r = s->radius, top = s->half_height;
    switch (s->type) {
    case TAHR_BODY_SPHERE: return base + r;
    case TAHR_BODY_CAPSULE: return base + r + (top - r) * fabsl(n.z);
    case TAHR_BODY_BOX: return base + h.x * fabsl(n.x) + h.y * fabsl(n.y) + h.z * fabsl(n.z);
    case TAHR_BODY_CYLINDER: return base + r * level + top * fabsl(n.z);
    case TAHR_BODY_CONE: return base + fmaxl(top * n.z, r * level - top * n.z);
    case TAHR_BODY_ELLIPSOID: {
        solid_vec m = make(h.x * n.x, h.y * n.y, h.z * n.z);
        return base + sqrtl(dot(m, m));
    }
    default: {
        solid_real most = dot(s->vertices[0], n);
        for (int i = 1; i < s->vertex_count; i++)
            most = fmaxl(most, dot(s->vertices[i], n));
        return base + most;
    }
    }
}

static solid_real segment_distance(solid_vec p, solid_vec a, solid_vec b)
{
    solid_vec e = sub(b, a), d = sub(p, a);
    solid_real t = dot(d, e) / dot(e, e);
    d = sub(d, make(0, 0, 0));
    d = add_scaled(d, e, -fminl(1, fmaxl(0, t)));
    return sqrtl(dot(d, d));
}

static solid_real triangle_distance(solid_vec p, solid_vec a, solid_vec b, solid_vec c)
{
    solid_vec n = cross(sub(b, a), sub(c, a));
    int inside = dot(cross(sub(b, a), sub(p, a)), n) >= 0 && dot(cross(sub(c, b), sub(p, b)), n) >= 0 &&
                 dot(cross(sub(a, c), sub(p, c)), n) >= 0;
    if (inside) return fabsl(dot(n, sub(p, a))) / sqrtl(dot(n, n));
    return fminl(segment_distance(p, a, b), fminl(segment_distance(p, b, c), segment_distance(p, c, a)));
}

static solid_real hull_distance(const solid *s, solid_vec p)
{
    solid_real least = 1e30L;
    int outside = 0;
    for (int i = 0; i < s->face_count; i++) {
        const int *f = s->faces[i];
        solid_vec a = s->vertices[f[0]], b = s->vertices[f[1]], c = s->vertices[f[2]];
        outside |= dot(cross(sub(b, a), sub(c, a)), sub(p, a)) > 0;
        least = fminl(least, triangle_distance(p, a, b, c));
    }
    return outside ? least : 0;
}

/* The nearest point is h2 p / (t + h2) along each axis, for the one t > 0 at which that lies on the surface. */
static solid_real ellipsoid_distance(solid_vec h, solid_vec p)
{
    const solid_real h2[3] = {h.x * h.x, h.y * h.y, h.z * h.z}, q[3] = {p.x, p.y, p.z};
    solid_real low = 0, high = sqrtl(dot(p, p)) * fmaxl(h.x, fmaxl(h.y, h.z)) + 1e-30L, sum = 0;
    for (int i = 0; i < 3; i++)
        sum += q[i] * q[i] / h2[i];
    if (sum <= 1) return 0;
    for (int k = 0; k < 200; k++) {
        solid_real t = 0.5L * (low + high);
        sum = 0;
        for (int i = 0; i < 3; i++)
            sum += h2[i] * (q[i] / (t + h2[i])) * (q[i] / (t + h2[i]));
        *(sum > 1 ? &low : &high) = t;
    }
    sum = 0;
    for (int i = 0; i < 3; i++)
        sum += (low * q[i] / (low + h2[i])) * (low * q[i] / (low + h2[i]));
    return sqrtl(sum);
}

static solid_real outside(solid_real x, solid_real half)
{
    return fmaxl(0, fabsl(x) - half);
}

solid_real solid_point_distance(const solid *s, tahr_vec3 point)
{
    solid_vec p = to_local(s, sub(from(point), s->at)), h = s->half;
    solid_real level = sqrtl(p.x * p.x + p.y * p.y), r = s->radius, top = s->half_height;
    switch (s->type) {
    case TAHR_BODY_SPHERE: return fmaxl(0, sqrtl(dot(p, p)) - r);
    case TAHR_BODY_CAPSULE: return fmaxl(0, hypotl(level, outside(p.z, top - r)) - r);
    case TAHR_BODY_BOX:
        return sqrtl(powl(outside(p.x, h.x), 2) + powl(outside(p.y, h.y), 2) + powl(outside(p.z, h.z), 2));
    case TAHR_BODY_CYLINDER: return hypotl(outside(level, r), outside(p.z, top));
    case TAHR_BODY_CONE: {
        solid_vec q = make(level, 0, p.z), rim = make(r, 0, -top), apex = make(0, 0, top), foot = make(0, 0, -top);
        int in = p.z >= -top && 2 * top * level + r * (p.z - top) <= 0;
        return in ? 0 : fminl(segment_distance(q, apex, rim), segment_distance(q, foot, rim));
    }
    case TAHR_BODY_ELLIPSOID: return ellipsoid_distance(h, p);
    case TAHR_BODY_HULL: return hull_distance(s, p);
    default: return triangle_distance(p, s->vertices[0], s->vertices[1], s->vertices[2]);
    }
}

solid_real solid_way(const solid *a, tahr_vec3 motion, const solid *b, tahr_vec3 normal)
{
    solid_vec n = from(normal);
    solid_real length = sqrtl(dot(n, n));
    n = make(n.x / length, n.y / length, n.z / length);
    return solid_extent(b, n) + solid_extent(a, make(-n.x, -n.y, -n.z)) + fmaxl(0, -dot(from(motion), n));
}

static tahr_vec3 some_way_from(tahr_vec3 n, double step, oracle_random *dice)
{
    n.x += oracle_uniform(dice, -step, step);
    n.y += oracle_uniform(dice, -step, step);
    n.z += oracle_uniform(dice, -step, step);
    double length = sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    return (tahr_vec3){n.x / length, n.y / length, n.z / length};
}

solid_real solid_least_way(const solid *a, tahr_vec3 motion, const solid *b, solid_real enough, oracle_random *dice)
{
    return solid_least_way_near(a, motion, b, (tahr_vec3){0, 0, 0}, enough, dice);
}

/* The extents meet in ridges, along which only few directions lead on: the more are tried the finer it is looked. */
solid_real solid_least_way_near(const solid *a, tahr_vec3 motion, const solid *b, tahr_vec3 best, solid_real enough,
                                oracle_random *dice)
{
    int known = best.x != 0 || best.y != 0 || best.z != 0;
    solid_real least = known ? solid_way(a, motion, b, best) : 1e30L;
    for (int i = 0; i < 60 && !known; i++) {
        tahr_vec3 n = some_way_from((tahr_vec3){0, 0, 0}, 1, dice);
        solid_real way = solid_way(a, motion, b, n);
        if (!(way < least)) continue;
        least = way;
        best = n;
    }
    for (double step = known ? 1e-3 : 0.5; step > 1e-9 && least > enough;) {
        int better = 0;
        for (int i = 0; i < 24 && !(better && i > 8); i++) {
            tahr_vec3 n = some_way_from(best, step, dice);
            solid_real way = solid_way(a, motion, b, n);
            if (!(way < least)) continue;
            least = way;
            best = n;
            better = 1;
        }
        if (!better) step *= 0.75;
    }
    return least;
}
