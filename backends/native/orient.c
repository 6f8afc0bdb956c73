/* SPDX-License-Identifier: MIT
 * orient.c: see orient.h. In double where the error bound of the determinant allows a verdict, else as a sum of doubles
 * that do not overlap (Shewchuk 1997, "Adaptive precision floating-point arithmetic and fast robust geometric
 * predicates"): both the bound and the sum are his. */
#include "orient.h"

/* 24 products of three coordinates of four doubles each. */
enum { MOST = 24 * 4 };
/* (7 + 56 u) u with u = 2^-53. */
#define BOUND 7.771561172376103e-16
/* 2^27 + 1 */
#define SPLITTER 134217729.0

typedef struct expansion {
    int count;
    double part[MOST + 1]; /* smallest first */
} expansion;

static double two_sum(double a, double b, double *rest)
{
    double sum = a + b, shadow = sum - a;
    *rest = (a - (sum - shadow)) + (b - shadow);
    return sum;
}

static double high_half(double a)
{
    double c = SPLITTER * a;
    return c - (c - a);
}

static double two_product(double a, double b, double *rest)
{
    double product = a * b, ah = high_half(a), bh = high_half(b), al = a - ah, bl = b - bh;
    *rest = al * bl - (((product - ah * bh) - al * bh) - ah * bl);
    return product;
}

static void grow(expansion *e, double b)
{
    int kept = 0;
    for (int i = 0; i < e->count; i++) {
        double rest;
        b = two_sum(b, e->part[i], &rest);
        if (rest != 0) e->part[kept++] = rest;
    }
    if (b != 0) e->part[kept++] = b;
    e->count = kept;
}

static void add_product(expansion *e, double a, double b, double c)
{
    double rest, low, high = two_product(a, b, &rest), part = two_product(high, c, &low);
    grow(e, low);
    grow(e, part);
    part = two_product(rest, c, &low);
    grow(e, low);
    grow(e, part);
}

/* The determinant of the rows (p, 1), term by term: it is minus the triple product. */
static int exact(const tahr_vec3 p[4])
{
    expansion e = {0, {0}};
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) {
            for (int k = 0; k < 4; k++) {
                if (i == j || j == k || i == k) continue;
                int l = 6 - i - j - k;
                int odd = (i > j) ^ (i > k) ^ (i > l) ^ (j > k) ^ (j > l) ^ (k > l);
                add_product(&e, odd ? p[i].x : -p[i].x, p[j].y, p[k].z);
            }
        }
    }
    double last = e.count ? e.part[e.count - 1] : 0;
    return (last > 0) - (last < 0);
}

int tahr__orient(tahr_vec3 a, tahr_vec3 b, tahr_vec3 c, tahr_vec3 d)
{
    tahr_vec3 u = v_sub(b, a), v = v_sub(c, a), w = v_sub(d, a), r = v_abs(u), s = v_abs(v), t = v_abs(w);
    double volume = v_dot(v_cross(u, v), w);
    double size = (r.y * s.z + r.z * s.y) * t.x + (r.z * s.x + r.x * s.z) * t.y + (r.x * s.y + r.y * s.x) * t.z;
    if (volume > BOUND * size) return 1;
    if (volume < -BOUND * size) return -1;
    const tahr_vec3 p[4] = {a, b, c, d};
    return exact(p);
}
