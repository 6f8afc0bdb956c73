/* SPDX-License-Identifier: MIT
 * piece.c: convex pieces: making them, measuring them, walking up to them. What faces they show is in piece_face.c. */
#include "piece.h"

#include "core_box.h"
#include "graze.h"

/* What rounding makes of the difference of two places some metres from the start of the query, and more. */
#define ROUNDING 1e-14
/* Nearer than this the direction between the nearest points is rounding: the way out is taken instead. */
#define TOUCHING 1e-10
/* Arrived (m). */
#define ARRIVED 1e-9
/* By iteration (m): a tangent leads no deeper than this, and where it seems to, a triangle was crossed. */
#define CROSSED 1e-6
/* Tangents converge quadratically, and halve the rest where the motion grazes: 30 halvings of a metre are 1e-9 m. */
enum { MAX_TANGENTS = 64 };

void tahr__placement_make(tahr_vec3 position, const tahr__mat *turn, const tahr__start *start, tahr__placement *frame)
{
    frame->base = v_scale(v_sub(position, start->origin), start->scale);
    frame->turn = *turn;
    frame->scale = start->scale;
    frame->turned = turn->row[0].x != 1 || turn->row[1].y != 1 || turn->row[2].z != 1;
    frame->reserved = 0;
}

static tahr_vec3 place(const tahr__placement *frame, tahr_vec3 local)
{
    local = v_scale(local, frame->scale);
    return v_add(frame->base, frame->turned ? m_apply(&frame->turn, local) : local);
}

static tahr_vec3 column(const tahr__placement *frame, int i, double length)
{
    length *= frame->scale;
    tahr_vec3 along = v_make(i == 0 ? length : 0, i == 1 ? length : 0, i == 2 ? length : 0);
    return frame->turned ? m_apply(&frame->turn, along) : along;
}

static void begin(tahr__piece *piece, uint32_t kind, const tahr__placement *frame)
{
    piece->kind = kind;
    piece->two_sided = piece->triangle = piece->is_cell = 0;
    piece->frame = frame;
    piece->mesh = NULL;
    piece->solid.axis_count = 0;
    piece->radius = 0;
}

void tahr__piece_triangle(const tahr__placement *frame, const tahr__mesh *mesh, uint32_t triangle, tahr__piece *piece)
{
    begin(piece, TAHR__TRIANGLE, frame);
    piece->mesh = mesh;
    piece->triangle = triangle;
    for (int i = 0; i < 3; i++)
        piece->facet.v[i] = place(frame, mesh->vertices[mesh->triangles[triangle].vertex[i]]);
    tahr__facet_finish(&piece->facet);
}

void tahr__piece_box(const tahr__placement *frame, tahr_vec3 middle, tahr_vec3 half, tahr__piece *piece)
{
    begin(piece, TAHR__BOX, frame);
    piece->middle = place(frame, middle);
    piece->half = v_scale(half, frame->scale);
    piece->solid.axis_count = 3;
    for (int i = 0; i < 3; i++)
        piece->solid.axis[i] = column(frame, i, v_get(half, i));
}

void tahr__piece_round(const tahr__placement *frame, double radius, double reach, tahr__piece *piece)
{
    begin(piece, TAHR__ROUND, frame);
    piece->middle = frame->base;
    piece->radius = radius * frame->scale;
    piece->solid.axis_count = reach > 0 ? 1 : 0;
    piece->solid.axis[0] = column(frame, 2, reach);
    /* A triangle that shrank to a segment or a point. */
    piece->facet.v[0] = v_sub(piece->middle, piece->solid.axis[0]);
    piece->facet.v[1] = piece->facet.v[2] = v_add(piece->middle, piece->solid.axis[0]);
    tahr__facet_finish(&piece->facet);
}

void tahr__piece_swept(const tahr__placement *frame, uint32_t kind, double radius, double reach, tahr__piece *piece)
{
    begin(piece, TAHR__CONVEX, frame);
    piece->convex =
        (tahr__convex_side){.convex = {.kind = kind, .centre = frame->base, .radius = radius * frame->scale}};
    piece->convex.convex.axis[0] = column(frame, 2, reach);
}

void tahr__piece_ellipsoid(const tahr__placement *frame, tahr_vec3 half, tahr__piece *piece)
{
    begin(piece, TAHR__CONVEX, frame);
    piece->convex = (tahr__convex_side){.convex = {.kind = TAHR__CONVEX_ELLIPSOID, .centre = frame->base}};
    for (int i = 0; i < 3; i++)
        piece->convex.convex.axis[i] = column(frame, i, v_get(half, i));
}

void tahr__piece_hull(const tahr__placement *frame, const tahr__hull *hull, tahr__piece *piece)
{
    begin(piece, TAHR__CONVEX, frame);
    piece->convex = (tahr__convex_side){.convex = {.kind = TAHR__CONVEX_POINTS,
                                                   .count = hull->count,
                                                   .centre = frame->base,
                                                   .points = hull->vertices,
                                                   .turn = frame->turned ? &frame->turn : NULL,
                                                   .scale = frame->scale},
                                        .planes = &hull->planes};
}

void tahr__piece_half_space(const tahr__placement *frame, tahr_vec3 normal, double offset, tahr__piece *piece)
{
    begin(piece, TAHR__HALF_SPACE, frame);
    piece->solid.axis[0] = m_apply(&frame->turn, normal);
    piece->middle = place(frame, v_scale(normal, offset));
}

/* Corners of a box by bit: +x 1, +y 2, +z 4. Two triangles per face. */
static const unsigned char box_triangles[12][3] = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                                                   {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};

static void box_to_box(const tahr__core *core, tahr_vec3 centre, const tahr__piece *piece, tahr__witness *best)
{
    tahr_vec3 corner[8];

    for (int i = 0; i < 8; i++) {
        corner[i] = v_mad(piece->middle, piece->solid.axis[0], i & 1 ? 1 : -1);
        corner[i] = v_mad(corner[i], piece->solid.axis[1], i & 2 ? 1 : -1);
        corner[i] = v_mad(corner[i], piece->solid.axis[2], i & 4 ? 1 : -1);
    }
    for (int i = 0; i < 12; i++) {
        tahr__facet f = {.v = {corner[box_triangles[i][0]], corner[box_triangles[i][1]], corner[box_triangles[i][2]]}};
        tahr__witness w = {0};
        tahr__facet_finish(&f);
        tahr__facet_distance(core, centre, &f, &w);
        if (i == 0 || w.distance < best->distance) *best = w;
    }
}

/* Two axes that meet along a line, or a point on an axis: out sideways, by any direction across. */
static tahr_vec3 across(const tahr__core *core, const tahr__core *solid)
{
    tahr_vec3 along = core->axis_count > 0 ? core->axis[0] : solid->axis[0];

    if (core->axis_count + solid->axis_count == 0) return v_make(0, 0, 1);
    return v_unit(v_cross(fabs(along.x) <= fabs(along.z) ? v_make(1, 0, 0) : v_make(0, 0, 1), along));
}

/* Depth of the cores in each other, or a negative number. */
static double solid_depth(const tahr__core *core, tahr_vec3 centre, const tahr__piece *piece, double distance,
                          tahr_vec3 *normal)
{
    if (distance > TOUCHING && (piece->kind == TAHR__ROUND || core->axis_count < 3)) return -1;
    double depth = tahr__core_leave_solid(core, centre, &piece->solid, piece->middle, normal);
    if (depth >= 0 || distance > TOUCHING) return depth;
    /* They touch: the axis that almost separates them is the way, if there is any. */
    if (depth < -2 * TOUCHING) *normal = across(core, &piece->solid);
    return 0;
}

/* One without neighbours may be left past its edges. */
static uint32_t ways_out(const tahr__piece *piece)
{
    const tahr__triangle *t = &piece->mesh->triangles[piece->triangle];
    int alone = 1;

    for (int i = 0; i < 3; i++)
        alone &= t->ring[i] == piece->triangle;
    return !piece->two_sided ? 1u : alone ? 7u : 3u;
}

static double triangle_depth(const tahr__core *core, tahr_vec3 centre, const tahr__piece *piece, tahr_vec3 *normal)
{
    return tahr__core_leave_triangle(core, centre, piece->facet.v, ways_out(piece), normal);
}

/* Is there no way to leave, for a box that does not cross the triangle? */
static int only_touches(const tahr__core *core, tahr_vec3 centre, const tahr__piece *piece, tahr__witness *w)
{
    double distance = w->distance;

    if (core->axis_count < 3 || !tahr__box_touches(core, centre, &piece->facet, w)) return 0;
    w->distance = distance;
    return 1;
}

static void measure_half_space(const tahr__shape *shape, tahr_vec3 centre, const tahr__piece *piece, tahr__near *near)
{
    tahr_vec3 n = piece->solid.axis[0];
    double height = v_dot(n, v_sub(centre, piece->middle));

    if (piece->two_sided && height < 0) n = v_scale(n, -1);
    near->normal = n;
    near->part = TAHR__FACE;
    near->distance =
        (piece->two_sided ? fabs(height) : height) - tahr__shape_extent(shape, v_scale(n, -1)) - shape->radius;
    near->point = v_mad(centre, piece->solid.axis[0], -height);
}

void tahr__piece_side(const tahr__piece *piece, tahr__convex_side *side)
{
    if (piece->kind == TAHR__CONVEX) {
        *side = piece->convex;
        return;
    }
    *side = (tahr__convex_side){.radius = piece->radius};
    if (piece->kind == TAHR__TRIANGLE) {
        side->convex = (tahr__convex){.kind = TAHR__CONVEX_POINTS, .count = 3, .points = piece->facet.v, .scale = 1};
        side->ways_out = ways_out(piece);
        return;
    }
    side->convex = (tahr__convex){.count = (uint32_t)piece->solid.axis_count, .centre = piece->middle};
    for (int i = 0; i < piece->solid.axis_count; i++)
        side->convex.axis[i] = piece->solid.axis[i];
}

void tahr__shape_side(const tahr__shape *shape, tahr_vec3 centre, tahr__convex_side *side)
{
    *side = (tahr__convex_side){.radius = shape->radius};
    if (shape->is_convex) *side = shape->convex;
    for (int i = 0; i < shape->core.axis_count && !shape->is_convex; i++)
        side->convex.axis[side->convex.count++] = shape->core.axis[i];
    side->convex.centre = v_add(side->convex.centre, centre);
}

/* Of cores that have left each other: of two flat faces some point that both hold. */
static tahr_vec3 touching_point(const tahr__shape *shape, tahr_vec3 centre, const tahr__piece *piece, double depth,
                                tahr_vec3 normal)
{
    tahr__convex_side own, other;
    tahr__gap gap;

    tahr__shape_side(shape, centre, &own);
    tahr__piece_side(piece, &other);
    tahr__convex_touch(&own.convex, &other.convex, depth, normal, &gap);
    return gap.on_b;
}

static void measure_convex(const tahr__shape *shape, tahr_vec3 centre, const tahr__piece *piece,
                           const tahr__clearance *enough, tahr__near *near)
{
    tahr__convex_side own, other;

    tahr__shape_side(shape, centre, &own);
    tahr__piece_side(piece, &other);
    tahr__convex_measure(&own, &other, enough, near);
}

static void measure_core(const tahr__shape *shape, tahr_vec3 centre, const tahr__piece *piece, tahr__near *near)
{
    const tahr__core *core = &shape->core;
    tahr__witness w = {0};
    tahr_vec3 way_out = v_make(0, 0, 1);
    double depth = -1;

    if (piece->kind == TAHR__BOX && core->axis_count < 3)
        tahr__core_box(core, centre,
                       &(tahr__box){piece->middle, piece->half, piece->frame->turned ? &piece->frame->turn : NULL}, &w);
    else if (piece->kind == TAHR__BOX)
        box_to_box(core, centre, piece, &w);
    else
        tahr__facet_distance(core, centre, &piece->facet, &w);
    if (piece->kind != TAHR__TRIANGLE)
        depth = solid_depth(core, centre, piece, w.distance, &way_out);
    else if (w.distance <= TOUCHING && !only_touches(core, centre, piece, &w))
        depth = triangle_depth(core, centre, piece, &way_out);
    near->point = w.point;
    near->part = depth >= 0 ? TAHR__FACE : w.feature;
    near->normal = depth >= 0 ? way_out : w.normal;
    if (depth < 0 && w.distance > 0) near->lean = ROUNDING / w.distance;
    near->distance = (depth >= 0 ? -depth : w.distance) - shape->radius - piece->radius;
    if (depth >= 0) near->point = touching_point(shape, centre, piece, depth, near->normal);
    near->point = v_mad(near->point, near->normal, piece->radius);
}

/* enough: of a motion, or NULL (convex.h). */
static void measure(const tahr__shape *shape, tahr_vec3 centre, const tahr__piece *piece, const tahr__clearance *enough,
                    tahr__near *near)
{
    near->rough = 0;
    near->lean = 0;
    if (piece->kind == TAHR__HALF_SPACE)
        measure_half_space(shape, centre, piece, near);
    else if (shape->is_convex || piece->kind == TAHR__CONVEX)
        measure_convex(shape, centre, piece, enough, near);
    else
        measure_core(shape, centre, piece, near);
}

void tahr__piece_measure(const tahr__shape *shape, tahr_vec3 centre, const tahr__piece *piece, tahr__near *near)
{
    measure(shape, centre, piece, NULL, near);
}

void tahr__piece_measure_far(const tahr__motion *motion, const tahr__piece *piece, double fraction, tahr__near *near)
{
    const tahr__clearance enough = {motion->motion, motion->shape->radius + piece->radius + motion->margin};

    measure(motion->shape, v_scale(motion->motion, fraction), piece, &enough, near);
}

/* What a bare core (no radius, no margin) or any convex shape arrives at it touches, and out of what it touches the way
 * may lead anywhere: of a one-sided triangle to its front, however far that is. A little earlier it is still free, and
 * the nearest points say where it came from: looks back 1e-9, 1e-8, 1e-7 m; by iteration 1e-6 to 1e-4 m. The fraction
 * stays, for it is the root of a tangent: the contact is not before it. */
static int look_back(const tahr__motion *motion, const tahr__piece *piece, double fraction, tahr__near *near)
{
    double length = v_length(motion->motion), first = near->rough ? CROSSED : ARRIVED;

    for (double back = first; back < 200 * first; back *= 10) {
        double t = d_max(0, fraction - back / length);
        tahr__piece_measure(motion->shape, v_scale(motion->motion, t), piece, near);
        if (near->distance >= motion->margin - ARRIVED) return 1;
    }
    return 0;
}

/* Does the shape only pass what it has come within the margin of? */
static int passes(const tahr__motion *motion, const tahr__piece *piece, const tahr__descent *here)
{
    double length = v_length(motion->motion);
    tahr__descent there = *here;
    tahr__near near;

    if (here->speed > TAHR__GRAZING * length) return 0;
    there.fraction = tahr__beyond(here, motion->shape->radius + piece->radius + motion->margin, length);
    ++*motion->iterations;
    tahr__piece_measure(motion->shape, v_scale(motion->motion, there.fraction), piece, &near);
    there.gap = near.distance - motion->margin;
    there.speed = -v_dot(motion->motion, near.normal);
    return tahr__grazes(here, &there, length, ARRIVED);
}

/* What a tangent led to is met there, however deep it seems. */
static tahr__verdict arrive(const tahr__motion *motion, const tahr__piece *piece, double fraction, tahr__near *near)
{
    double gap = near->distance - motion->margin;

    if (!(near->rough && gap >= -CROSSED) && !look_back(motion, piece, fraction, near)) return TAHR__UNKNOWN;
    near->distance = motion->margin;
    return TAHR__HIT;
}

/* A tangent of a convex function lies below it: a step to its root never overshoots, and one that starts late goes back
 * to the early side. */
tahr__verdict tahr__piece_advance(const tahr__motion *motion, const tahr__piece *piece, double limit, double *fraction,
                                  tahr__near *near)
{
    double t = *fraction;
    int by_tangent = t > 0 && !motion->unsure; /* t is the root of one */

    for (int i = 0; i < MAX_TANGENTS; i++) {
        tahr__piece_measure_far(motion, piece, t, near);
        double gap = near->distance - motion->margin, speed = -v_dot(motion->motion, near->normal);
        ++*motion->iterations;
        *fraction = t;
        if (gap <= ARRIVED && gap >= -ARRIVED)
            return passes(motion, piece, &(tahr__descent){gap, speed, t}) ? TAHR__FREE : TAHR__HIT;
        int bare = piece->kind == TAHR__TRIANGLE && motion->shape->radius + motion->margin <= 0;
        if (gap < 0 && (bare || (near->rough && by_tangent))) return arrive(motion, piece, t, near);
        by_tangent = gap > 0;
        if (!(speed > 0)) return gap > 0 ? TAHR__FREE : TAHR__UNKNOWN;
        t += gap / speed;
        if (t > limit) return TAHR__FREE;
        if (t < 0) t = 0;
        if (t == *fraction) return TAHR__HIT;
    }
    return TAHR__UNKNOWN;
}
