/* SPDX-License-Identifier: MIT
 * cone.c: projection onto all touched planes at once. Clipping against one plane after the other drifts in gutters and
 * ping-pongs in corners; the nearest point of the whole intersection does neither. */
#include "cone.h"

/* A candidate may violate a plane by this part of the size of the problem: rounding of the solves below. */
static const double FEASIBLE = 1e-12;

/* Two planes meet in a usable line if |n x n'|^2 exceeds this (0.06 degrees): below they are one plane for rounding. */
static const double CREASE = 1e-6;

/* Of two that face each other and go through the origin the line is as good as their cross product, whose rounding is
 * 1e-16: the edges of a gap that is exactly as wide as who falls through it. */
static const double FACING = 1e-14;

/* And below this (6 degrees) it is better: what pushes against each other cancels out but for rounding. */
static const double NARROW = 1e-2;

static int feasible(const tahr__plane *planes, uint32_t count, vec3 x, double slack)
{
    for (uint32_t i = 0; i < count; i++) {
        if (dot(planes[i].normal, x) < planes[i].offset - slack) {
            return 0;
        }
    }
    return 1;
}

static vec3 on_one(const tahr__plane *a, vec3 u)
{
    return add_scaled(u, a->normal, a->offset - dot(a->normal, u));
}

/* Nearest point of the line in both planes. */
static int on_two(const tahr__plane *a, const tahr__plane *b, vec3 u, vec3 *x)
{
    double g = dot(a->normal, b->normal);
    double det = length_squared(cross(a->normal, b->normal));
    const int through = g < 0 && a->offset == 0 && b->offset == 0;
    if (det < (through ? FACING : CREASE)) {
        return 0;
    }
    double ra = a->offset - dot(a->normal, u);
    double rb = b->offset - dot(b->normal, u);
    double la = (ra - g * rb) / det;
    double lb = (rb - g * ra) / det;
    *x = add_scaled(add_scaled(u, a->normal, la), b->normal, lb);
    if (through && det < NARROW) {
        const vec3 line = cross(a->normal, b->normal);
        *x = scale(line, dot(line, u) / det);
    }
    return la >= 0 && lb >= 0; /* Kuhn-Tucker: planes only push */
}

/* The common point of three planes. */
static int on_three(const tahr__plane *a, const tahr__plane *b, const tahr__plane *c, vec3 *x)
{
    vec3 bc = cross(b->normal, c->normal);
    double det = dot(a->normal, bc);
    if (det * det < CREASE * CREASE) {
        return 0;
    }
    vec3 sum = scale(bc, a->offset);
    sum = add_scaled(sum, cross(c->normal, a->normal), b->offset);
    sum = add_scaled(sum, cross(a->normal, b->normal), c->offset);
    *x = scale(sum, 1.0 / det);
    return 1;
}

static void consider(vec3 candidate, vec3 u, vec3 *best, double *best_distance)
{
    double distance = length_squared(sub(candidate, u));
    if (distance < *best_distance) {
        *best_distance = distance;
        *best = candidate;
    }
}

static int enumerate(const tahr__plane *planes, uint32_t count, vec3 u, double slack, vec3 *best)
{
    double best_distance = INFINITY;
    vec3 x;
    for (uint32_t i = 0; i < count; i++) {
        if (dot(planes[i].normal, u) < planes[i].offset) {
            x = on_one(&planes[i], u);
            if (feasible(planes, count, x, slack)) {
                consider(x, u, best, &best_distance);
            }
        }
    }
    if (best_distance < INFINITY) { /* at most one single plane is the answer, and nothing beats it */
        return 1;
    }
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t j = i + 1; j < count; j++) {
            if (on_two(&planes[i], &planes[j], u, &x) && feasible(planes, count, x, slack)) {
                consider(x, u, best, &best_distance);
            }
        }
    }
    if (best_distance < INFINITY) {
        return 1;
    }
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t j = i + 1; j < count; j++) {
            for (uint32_t k = j + 1; k < count; k++) {
                if (on_three(&planes[i], &planes[j], &planes[k], &x) && feasible(planes, count, x, slack)) {
                    consider(x, u, best, &best_distance);
                }
            }
        }
    }
    return best_distance < INFINITY;
}

/* One symmetric 3 x 3 solve by cofactors; m = xx, xy, xz, yy, yz, zz. */
static vec3 solve_symmetric(const double m[6], vec3 r)
{
    double c0 = m[3] * m[5] - m[4] * m[4];
    double c1 = m[2] * m[4] - m[1] * m[5];
    double c2 = m[1] * m[4] - m[2] * m[3];
    double det = m[0] * c0 + m[1] * c1 + m[2] * c2;
    double c3 = m[0] * m[5] - m[2] * m[2];
    double c4 = m[1] * m[2] - m[0] * m[4];
    double c5 = m[0] * m[3] - m[1] * m[1];
    return scale(vec(c0 * r.x + c1 * r.y + c2 * r.z, c1 * r.x + c3 * r.y + c4 * r.z, c2 * r.x + c4 * r.y + c5 * r.z),
                 1.0 / det);
}

/* Minimises the sum of squared violations, with a trace of |x - u|^2 to make the answer unique. Each round solves for
 * the set that is violated now; the set settles in a few rounds, 16 is a cap. */
static vec3 least_squares(const tahr__plane *planes, uint32_t count, vec3 u)
{
    const double ridge = 1e-6; /* pulls toward u a million times weaker than a plane pushes */
    vec3 x = u;
    for (int round = 0; round < 16; round++) {
        double m[6] = {ridge, 0, 0, ridge, 0, ridge};
        vec3 r = scale(u, ridge);
        for (uint32_t i = 0; i < count; i++) {
            vec3 n = planes[i].normal;
            if (dot(n, x) < planes[i].offset) {
                m[0] += n.x * n.x, m[1] += n.x * n.y, m[2] += n.x * n.z;
                m[3] += n.y * n.y, m[4] += n.y * n.z, m[5] += n.z * n.z;
                r = add_scaled(r, n, planes[i].offset);
            }
        }
        vec3 next = solve_symmetric(m, r);
        if (vec_equal(next, x)) {
            break;
        }
        /* Half steps once it oscillates between two sets. */
        x = round < 8 ? next : scale(add(x, next), 0.5);
    }
    return x;
}

int tahr__project(const tahr__plane *planes, uint32_t count, vec3 u, vec3 *x)
{
    if (feasible(planes, count, u, 0)) {
        *x = u;
        return 1;
    }
    if (count == 1) {
        *x = on_one(planes, u);
        return 1;
    }
    double size = length(u);
    for (uint32_t i = 0; i < count; i++) {
        size = max_of(size, planes[i].offset);
    }
    if (enumerate(planes, count, u, FEASIBLE * size, x)) {
        return 1;
    }
    int is_cone = 1;
    for (uint32_t i = 0; i < count; i++) {
        is_cone = is_cone && planes[i].offset == 0;
    }
    if (is_cone) { /* the apex is always in a cone */
        *x = vec(0, 0, 0);
        return 1;
    }
    *x = least_squares(planes, count, u);
    return 0;
}

static int sorted_before(const tahr__plane *a, const tahr__plane *b)
{
    return a->body != b->body ? a->body < b->body : a->feature < b->feature;
}

void tahr__planes_add(tahr__plane *planes, uint32_t *count, const tahr__plane *plane)
{
    for (uint32_t i = 0; i < *count; i++) {
        int same_feature = planes[i].body == plane->body && planes[i].feature == plane->feature;
        int parallel = dot(planes[i].normal, plane->normal) > 1 - 1e-6;
        if (same_feature || (parallel && plane->offset >= planes[i].offset)) {
            for (uint32_t j = i; j + 1 < *count; j++) {
                planes[j] = planes[j + 1];
            }
            *count -= 1;
            i--;
        } else if (parallel) {
            return;
        }
    }
    if (*count == TAHR__MAX_PLANES) {
        return;
    }
    uint32_t at = *count;
    while (at > 0 && sorted_before(plane, &planes[at - 1])) {
        planes[at] = planes[at - 1];
        at--;
    }
    planes[at] = *plane;
    *count += 1;
}
