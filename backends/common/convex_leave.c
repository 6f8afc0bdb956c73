/* SPDX-License-Identifier: MIT
 * convex_leave.c: the way out of an overlap of two convex shapes, without EPA: nothing is built from points of the
 * difference inside of the overlap, where that is random for shapes that touch.
 *
 * The way along a direction n is exact: the extents of the two shapes along it. It is made shorter by a fall: moved out
 * along n, with some air between them, and back again until they nearly touch, the two face each other across some
 * normal m, and the way along m is not longer. What stays is a direction that its own contact faces: a face of the
 * difference, or the nearest point of a round part. */
#include "convex.h"

/* Of size: the air that is left, so that the direction between the nearest points is no rounding. */
#define AIR 1e-3
/* Of size: as near to that as a way back goes. */
#define ARRIVED 1e-9
/* Of size: shorter by less is not shorter. */
#define GAIN 1e-10
/* Cosine from which on two starts are one. */
#define SAME_START 0.9
enum { STARTS = 4, MAX_FALLS = 24, MAX_TANGENTS = 32 };

typedef struct start {
    tahr_vec3 normal;
    double way;
} start;

/* The best few, shortest first, no two of them alike. */
static void keep_start(start *best, int *count, const start *s)
{
    int at;
    for (at = 0; at < *count; at++) {
        if (v_dot(best[at].normal, s->normal) < SAME_START) continue;
        if (best[at].way <= s->way) return;
        for (int i = at; i + 1 < *count; i++)
            best[i] = best[i + 1];
        --*count;
        break;
    }
    for (at = *count; at > 0 && s->way < best[at - 1].way; at--) {
        if (at < STARTS) best[at] = best[at - 1];
    }
    if (at < STARTS) best[at] = *s;
    if (*count < STARTS) ++*count;
}

static void try_both(const tahr__convex *a, const tahr__convex *b, tahr_vec3 n, start *best, int *count)
{
    for (int sign = 1; sign >= -1; sign -= 2) {
        start s = {.normal = v_scale(n, sign)};
        s.way = tahr__convex_way(a, b, s.normal);
        keep_start(best, count, &s);
    }
}

/* The normal across which a, coming back along n from where it is clear of b, faces b. Returns 0 if none is found. */
static int faces(const tahr__convex *a, const tahr__convex *b, const start *from, double size, tahr_vec3 *normal)
{
    double air = AIR * size, s = from->way + 2 * air;
    tahr__gap gap = {.normal = from->normal};
    for (int i = 0; i < MAX_TANGENTS; i++) {
        tahr__convex moved = *a;
        moved.centre = v_mad(a->centre, from->normal, s);
        tahr__convex_distance(&moved, b, gap.normal, &gap);
        if (!(gap.lower > 0)) return 0;
        double left = gap.lower - air, speed = v_dot(gap.normal, from->normal);
        *normal = gap.normal;
        if (left <= ARRIVED * size || !(speed > 0)) return 1;
        s -= left / speed;
    }
    return 1;
}

static void fall(const tahr__convex *a, const tahr__convex *b, double size, start *s)
{
    for (int i = 0; i < MAX_FALLS; i++) {
        start next;
        if (!faces(a, b, s, size, &next.normal)) return;
        next.way = tahr__convex_way(a, b, next.normal);
        if (!(next.way < s->way - GAIN * size)) return;
        *s = next;
    }
}

double tahr__convex_leave(const tahr__convex *a, const tahr__convex *b, const tahr_vec3 *guesses, uint32_t count,
                          double size, tahr_vec3 *normal)
{
    start best[STARTS] = {{{0, 0, 0}, 0}};
    int kept = 0;
    for (uint32_t i = 0; i < count; i++)
        try_both(a, b, guesses[i], best, &kept);
    /* A cube's faces, edges and corners. */
    for (int i = 1; i < 14; i++) {
        int k = i + 13;
        tahr_vec3 n = v_make(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
        try_both(a, b, v_unit(n), best, &kept);
    }
    for (int i = 0; i < kept; i++) {
        fall(a, b, size, &best[i]);
        if (best[i].way < best[0].way) best[0] = best[i];
    }
    *normal = best[0].normal;
    return best[0].way;
}
