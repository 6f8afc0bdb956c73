/* SPDX-License-Identifier: MIT
 * flat.c: signed distance of two convex shapes in the plane: by the axis that separates them best where a face is
 * nearest, by pairs of corner and edge elsewhere. Exact up to rounding. */
#include "flat.h"

/* Nearer than this (m) the direction between the nearest points is rounding: the best axis is taken instead. */
#define TOUCHING 1e-10
/* Corners of the shape that are this close (m) to being the nearest to a face are so too: its side is parallel. */
#define PARALLEL 1e-10
/* Contact normals this close to a face's are the face's: what is left of rounding at the end of a flat surface. */
#define SNAP 1e-7

static tahr__vec2 next_corner(const tahr__flat *p, int face)
{
    return p->corner[face + 1 < p->count ? face + 1 : 0];
}

tahr__vec2 tahr__flat_normal(const tahr__flat *piece, int face)
{
    return f_unit(f_right(f_sub(next_corner(piece, face), piece->corner[face])));
}

double tahr__flat_length(const tahr__flat *piece, int face)
{
    return f_length(f_sub(next_corner(piece, face), piece->corner[face]));
}

double tahr__flat_height(const tahr__flat_shape *shape, tahr__vec2 centre, const tahr__flat *piece, int face,
                         double range[2])
{
    tahr__vec2 from = f_sub(centre, piece->corner[face]), n = tahr__flat_normal(piece, face);
    double height[4], least = 0;

    for (int i = 0; i < shape->count; i++) {
        height[i] = f_dot(n, f_add(from, shape->corner[i]));
        if (i == 0 || height[i] < least) least = height[i];
    }
    range[0] = INFINITY;
    range[1] = -INFINITY;
    for (int i = 0; i < shape->count; i++) {
        tahr__vec2 at = f_add(from, shape->corner[i]);
        double along = n.x * at.y - n.y * at.x; /* on the edge's direction, which is left of its normal */
        if (height[i] > least + PARALLEL) continue;
        if (along < range[0]) range[0] = along;
        if (along > range[1]) range[1] = along;
    }
    return least;
}

int tahr__flat_facing(const tahr__flat *piece, tahr__vec2 direction)
{
    int best = 0;
    double most = -INFINITY;

    for (int i = 0; i < tahr__flat_face_count(piece); i++) {
        double along = f_dot(tahr__flat_normal(piece, i), direction);
        if (along <= most) continue;
        most = along;
        best = i;
    }
    return best;
}

/* The axis that separates best, or overlaps least. */
typedef struct axis {
    double separation;
    tahr__vec2 normal; /* from the piece to the shape */
    int face;          /* of the piece, or -1 */
    double range[2];
} axis;

static void best_face(const tahr__flat_shape *shape, tahr__vec2 centre, const tahr__flat *piece, int faces,
                      unsigned closed, axis *best)
{
    for (int i = 0; i < faces; i++) {
        double range[2], height;
        if (i < 32 && closed >> i & 1) continue;
        height = tahr__flat_height(shape, centre, piece, i, range);
        if (height <= best->separation) continue;
        best->separation = height;
        best->normal = tahr__flat_normal(piece, i);
        best->face = i;
        best->range[0] = range[0];
        best->range[1] = range[1];
    }
}

static void try_axis(const tahr__flat_shape *shape, tahr__vec2 centre, const tahr__flat *piece, tahr__vec2 n,
                     axis *best)
{
    double low = INFINITY, high = -INFINITY;

    for (int i = 0; i < shape->count; i++) {
        double h = f_dot(n, f_add(centre, shape->corner[i]));
        if (h < low) low = h;
    }
    for (int i = 0; i < piece->count; i++) {
        double h = f_dot(n, piece->corner[i]);
        if (h > high) high = h;
    }
    if (low - high <= best->separation) return;
    best->separation = low - high;
    best->normal = n;
    best->face = -1;
}

/* Two corners have two sides, one has none. */
static int side_count(const tahr__flat_shape *shape)
{
    return shape->count > 1 ? shape->count : 0;
}

static void best_side(const tahr__flat_shape *shape, tahr__vec2 centre, const tahr__flat *piece, axis *best)
{
    for (int i = 0; i < side_count(shape); i++) {
        tahr__vec2 a = shape->corner[i], b = shape->corner[i + 1 < shape->count ? i + 1 : 0];
        try_axis(shape, centre, piece, f_unit(f_right(f_sub(a, b))), best); /* inward: out of the piece's way */
    }
}

/* Nothing across separates two segments on one line, or two points. */
static double separation_along(const tahr__flat_shape *shape, tahr__vec2 centre, const tahr__flat *piece)
{
    axis best = {.separation = -INFINITY};
    tahr__vec2 d = piece->count == 2 ? f_sub(piece->corner[1], piece->corner[0]) : f_make(0, 0);

    if (shape->count > 2 || piece->count > 2) return -INFINITY;
    if (piece->count == 1 && shape->count == 2) d = f_sub(shape->corner[1], shape->corner[0]);
    if (!(f_dot(d, d) > 0)) d = f_sub(centre, piece->corner[0]);
    if (!(f_dot(d, d) > 0)) return 0;
    d = f_unit(d);
    try_axis(shape, centre, piece, d, &best);
    try_axis(shape, centre, piece, f_make(-d.x, -d.y), &best);
    return best.separation;
}

/* Nearest point to p of the segment a b; *t: 0 at a, 1 at b. */
static tahr__vec2 nearest_on(tahr__vec2 p, tahr__vec2 a, tahr__vec2 b, double *t)
{
    tahr__vec2 d = f_sub(b, a);
    double much = f_dot(f_sub(p, a), d), whole = f_dot(d, d);

    *t = much <= 0 || !(whole > 0) ? 0 : much >= whole ? 1 : much / whole;
    return *t == 1 ? b : f_mad(a, d, *t);
}

typedef struct pair {
    double square;
    tahr__vec2 away; /* from the piece to the shape */
    tahr__vec2 point;
    int part;
} pair;

static void keep_pair(pair *best, tahr__vec2 on_shape, tahr__vec2 on_piece, int part)
{
    tahr__vec2 away = f_sub(on_shape, on_piece);
    double square = f_dot(away, away);

    if (square >= best->square) return;
    best->square = square;
    best->away = away;
    best->point = on_piece;
    best->part = part;
}

static void nearest_pair(const tahr__flat_shape *shape, tahr__vec2 centre, const tahr__flat *piece, pair *best)
{
    int edges = piece->count > 2 ? piece->count : piece->count - 1,
        sides = side_count(shape) > 2 ? 4 : shape->count - 1;
    double t;

    *best = (pair){.square = INFINITY};
    for (int i = 0; i < shape->count; i++) {
        tahr__vec2 p = f_add(centre, shape->corner[i]);
        for (int e = 0; e < edges; e++) {
            tahr__vec2 q = nearest_on(p, piece->corner[e], next_corner(piece, e), &t);
            int last = e + 1 < piece->count ? e + 1 : 0;
            keep_pair(best, p, q, t == 0 ? TAHR__FLAT_CORNER + e : t == 1 ? TAHR__FLAT_CORNER + last : e);
        }
        if (edges == 0) keep_pair(best, p, piece->corner[0], TAHR__FLAT_CORNER);
    }
    for (int i = 0; i < sides; i++) {
        tahr__vec2 a = f_add(centre, shape->corner[i]);
        tahr__vec2 b = f_add(centre, shape->corner[i + 1 < shape->count ? i + 1 : 0]);
        for (int k = 0; k < piece->count; k++)
            keep_pair(best, nearest_on(piece->corner[k], a, b, &t), piece->corner[k], TAHR__FLAT_CORNER + k);
    }
}

/* At a corner: the face whose normal the contact's is, up to rounding; else the corner. */
static void snap(const tahr__flat *piece, tahr__flat_near *near)
{
    int corner = near->part - TAHR__FLAT_CORNER, faces[2];

    if (piece->count < 2 || corner < 0) return;
    faces[0] = piece->count == 2 ? 0 : corner;
    faces[1] = piece->count == 2 ? 1 : corner > 0 ? corner - 1 : piece->count - 1;
    for (int i = 0; i < 2; i++) {
        tahr__vec2 n = tahr__flat_normal(piece, faces[i]), tilt = f_sub(near->normal, n);
        if (f_dot(tilt, tilt) >= SNAP * SNAP) continue;
        near->normal = n;
        near->part = faces[i];
        return;
    }
}

static void apart(const tahr__flat *piece, const pair *p, tahr__flat_near *near)
{
    near->distance = sqrt(p->square);
    near->normal = f_make(p->away.x / near->distance, p->away.y / near->distance);
    near->point = p->point;
    near->part = p->part;
    near->crosses = 0;
    if (near->part >= TAHR__FLAT_CORNER) {
        snap(piece, near);
    } else {
        if (piece->count == 2) near->part = tahr__flat_facing(piece, near->normal);
        near->normal = tahr__flat_normal(piece, near->part);
    }
}

static void crossing(const tahr__flat_shape *shape, tahr__vec2 centre, const tahr__flat *piece, unsigned closed,
                     tahr__flat_near *near)
{
    axis best = {.separation = -INFINITY, .normal = {0, 1}, .face = -1};
    double lowest = INFINITY;
    tahr__vec2 foot = centre;

    best_face(shape, centre, piece, piece->one_sided ? 1 : tahr__flat_face_count(piece), closed, &best);
    /* A closed face closes the sides of the shape that look the same way. */
    if (!closed && (piece->count != 2 || piece->lone)) best_side(shape, centre, piece, &best);
    if (!(best.separation > -INFINITY)) best.separation = 0; /* two points, or no way out is open */
    near->distance = best.separation < 0 ? best.separation : 0;
    near->normal = best.normal;
    near->part = best.face >= 0 ? best.face : tahr__flat_facing(piece, best.normal);
    near->crosses = 1;
    for (int i = 0; i < shape->count; i++) {
        tahr__vec2 p = f_add(centre, shape->corner[i]);
        if (f_dot(p, best.normal) >= lowest) continue;
        lowest = f_dot(p, best.normal);
        foot = p;
    }
    near->point = f_mad(foot, near->normal, -near->distance);
}

/* Is the nearest part a face? Then the axis says it all. */
static int over_face(const tahr__flat *piece, const axis *best, tahr__flat_near *near)
{
    double length = tahr__flat_length(piece, best->face), from, to;

    if (best->range[1] < 0 || best->range[0] > length) return 0;
    from = best->range[0] > 0 ? best->range[0] : 0;
    to = best->range[1] < length ? best->range[1] : length;
    near->distance = best->separation;
    near->normal = best->normal;
    near->point = f_mad(piece->corner[best->face], f_make(-best->normal.y, best->normal.x), 0.5 * (from + to));
    near->part = best->face;
    near->crosses = 0;
    return 1;
}

static void measure_cores(const tahr__flat_shape *shape, tahr__vec2 centre, const tahr__flat *piece, unsigned closed,
                          tahr__flat_near *near)
{
    axis best = {.separation = -INFINITY, .face = -1};
    pair p;

    best_face(shape, centre, piece, tahr__flat_face_count(piece), 0, &best);
    if (best.separation > TOUCHING && over_face(piece, &best, near)) return;
    nearest_pair(shape, centre, piece, &p);
    if (p.square > TOUCHING * TOUCHING) {
        if (best.separation <= 0) best_side(shape, centre, piece, &best);
        if (best.separation > 0 || separation_along(shape, centre, piece) > 0) {
            apart(piece, &p, near);
            return;
        }
    }
    crossing(shape, centre, piece, closed, near);
}

void tahr__flat_measure(const tahr__flat_shape *shape, tahr__vec2 centre, const tahr__flat *piece, unsigned closed,
                        tahr__flat_near *near)
{
    measure_cores(shape, centre, piece, closed, near);
    near->distance -= shape->radius + piece->radius;
    near->point = f_mad(near->point, near->normal, piece->radius);
}
