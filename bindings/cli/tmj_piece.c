/* SPDX-License-Identifier: MIT
 * tmj_piece.c: shapes of tiles and objects become pieces of a level; those of tiles are joined first. */
#include "say.h"
#include "tmj.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static struct side_point to_metres(const struct tmj *tmj, struct outline_point p)
{
    return (struct side_point){p.x / tmj->pixels_per_metre, p.y / tmj->pixels_per_metre};
}

/* From now on y is up. */
static void turn_up(const struct tmj *tmj, struct tmj_shape *shape)
{
    for (size_t i = 0; i < shape->count; i++) {
        shape->points[i].y = tmj->bottom - shape->points[i].y;
    }
}

static void reverse(struct tmj_shape *shape)
{
    for (size_t i = 0; i < shape->count / 2; i++) {
        struct outline_point p = shape->points[i];
        shape->points[i] = shape->points[shape->count - 1 - i];
        shape->points[shape->count - 1 - i] = p;
    }
}

static double area_of(const struct tmj_shape *shape)
{
    double area = 0;
    for (size_t i = 0; i < shape->count; i++) {
        struct outline_point a = shape->points[i], b = shape->points[(i + 1) % shape->count];
        area += (a.x * b.y - a.y * b.x) / 2;
    }
    return area;
}

/* Polygons counter-clockwise; lines that block from above run to the left, so that their front is up. */
static int put_in_order(struct tmj *tmj, struct tmj_shape *shape)
{
    turn_up(tmj, shape);
    if (shape->form == TMJ_POLYGON) {
        double area = area_of(shape);
        if (!(fabs(area) > 1e-6)) {
            return tmj_complain(tmj, "a polygon without area");
        }
        if (area < 0) {
            reverse(shape);
        }
    }
    if (shape->form == TMJ_LINE && shape->points[0].x < shape->points[shape->count - 1].x) {
        reverse(shape);
    }
    return 0;
}

/* Whether a polygon is an upright rectangle, counter-clockwise (the other way round it is a hole); *box are its
 * corners. */
static int is_box(const struct outline_point *points, size_t count, struct outline_point box[2])
{
    if (count != 4 || (points[1].x - points[0].x) * (points[2].y - points[1].y) <
                          (points[1].y - points[0].y) * (points[2].x - points[1].x)) {
        return 0;
    }
    box[0] = box[1] = points[0];
    for (size_t i = 0; i < 4; i++) {
        struct outline_point a = points[i], b = points[(i + 1) % 4];
        int level = fabs(a.y - b.y) < 0.5 / OUTLINE_GRID, upright = fabs(a.x - b.x) < 0.5 / OUTLINE_GRID;
        if (level == upright) {
            return 0;
        }
        box[0] = (struct outline_point){fmin(box[0].x, a.x), fmin(box[0].y, a.y)};
        box[1] = (struct outline_point){fmax(box[1].x, a.x), fmax(box[1].y, a.y)};
    }
    return 1;
}

static enum side_kind kind_of(const struct tmj_shape *shape)
{
    switch (shape->traits.kind) {
    case TMJ_ONE_WAY: return SIDE_ONE_WAY;
    case TMJ_WATER: return SIDE_WATER;
    case TMJ_SENSOR: return SIDE_SENSOR;
    case TMJ_GOAL: return SIDE_GOAL;
    default: return SIDE_SOLID;
    }
}

/* One piece of points in pixels, y up. */
static struct side_piece *add_piece(struct tmj *tmj, struct side_piece piece, const struct outline_point *points,
                                    size_t count)
{
    struct outline_point box[2];
    if (piece.form == SIDE_LOOP && is_box(points, count, box)) {
        piece.form = SIDE_BOX;
        points = box;
        count = 2;
    }
    piece.points = memory_new(count, sizeof *piece.points);
    piece.count = count;
    for (size_t i = 0; i < count; i++) {
        piece.points[i] = to_metres(tmj, points[i]);
    }
    struct side_piece *own = side_add(tmj->side, &piece);
    free(piece.points);
    tmj->shaped++;
    return own;
}

static int add_shape(struct tmj *tmj, const struct tmj_shape *shape)
{
    static const enum side_form forms[] = {
        [TMJ_POLYGON] = SIDE_LOOP, [TMJ_LINE] = SIDE_LINE, [TMJ_CIRCLE] = SIDE_CIRCLE};
    struct side_piece piece = {.kind = kind_of(shape),
                               .form = forms[shape->form],
                               .radius = shape->radius / tmj->pixels_per_metre,
                               .belt = shape->traits.belt,
                               .both = shape->form == TMJ_LINE && shape->traits.kind != TMJ_ONE_WAY,
                               .name = (char *)(uintptr_t)shape->name};
    struct side_piece *own = add_piece(tmj, piece, shape->points, shape->count);
    if ((own->kind == SIDE_WATER || own->kind == SIDE_SENSOR || own->kind == SIDE_GOAL) && own->form != SIDE_BOX) {
        return tmj_complain(tmj, "water, sensors and goals: expected an upright rectangle");
    }
    if (own->kind == SIDE_ONE_WAY && own->form == SIDE_CIRCLE) {
        return tmj_complain(tmj, "one_way: expected a rectangle, polygon or polyline");
    }
    if (!shape->traits.mover) {
        return 0;
    }
    if (own->form != SIDE_BOX || (own->kind != SIDE_SOLID && own->kind != SIDE_ONE_WAY)) {
        return tmj_complain(tmj, "mover: expected an upright rectangle, solid or one_way");
    }
    own->moves = 1;
    own->swing = to_metres(tmj, (struct outline_point){shape->traits.swing_x, -shape->traits.swing_y});
    own->period = shape->traits.period > 0 ? shape->traits.period : 4;
    own->pause = shape->traits.pause;
    return 2 * own->pause < own->period ? 0
                                        : tmj_complain(tmj, "pause %g s: expected less than half of the period of %g s",
                                                       own->pause, own->period);
}

static uint32_t tag_of(struct tmj *tmj, double belt)
{
    uint32_t tag = 0;
    while (tag < tmj->belt_count && tmj->belts[tag] != belt) {
        tag++;
    }
    if (tag == tmj->belt_count) {
        if (tag == sizeof tmj->belts / sizeof *tmj->belts) {
            return UINT32_MAX;
        }
        tmj->belts[tmj->belt_count++] = belt;
    }
    return tag;
}

static void keep_water(struct tmj *tmj, const struct outline_point box[2])
{
    tmj->boxes = memory_grow(tmj->boxes, &tmj->box_capacity, 2 * tmj->box_count + 2, sizeof *tmj->boxes);
    memcpy(tmj->boxes + 2 * tmj->box_count++, box, 2 * sizeof *box);
}

int tmj_tile_piece(struct tmj *tmj, struct tmj_shape *shape)
{
    struct outline_point box[2];
    enum tmj_kind kind = shape->traits.kind;
    if (shape->form >= TMJ_POINT || kind == TMJ_DECORATION || kind == TMJ_START) {
        return 0;
    }
    if (put_in_order(tmj, shape) != 0) {
        return -1;
    }
    if (tmj->separate || shape->form == TMJ_CIRCLE || kind == TMJ_SENSOR || kind == TMJ_GOAL || shape->traits.mover) {
        return add_shape(tmj, shape);
    }
    if (kind == TMJ_WATER) {
        if (!is_box(shape->points, shape->count, box)) {
            return tmj_complain(tmj, "water: expected an upright rectangle");
        }
        keep_water(tmj, box);
        return 0;
    }
    uint32_t tag = tag_of(tmj, shape->traits.belt);
    if (tag == UINT32_MAX) {
        return tmj_complain(tmj, "belt %g: more than 64 speeds of tiles", shape->traits.belt);
    }
    if (shape->form == TMJ_LINE && kind != TMJ_ONE_WAY) {
        return add_shape(tmj, shape);
    }
    struct outline *outline = shape->form == TMJ_LINE ? &tmj->lines : kind == TMJ_ONE_WAY ? &tmj->planks : &tmj->solids;
    outline_add(outline, shape->points, shape->count, shape->form == TMJ_POLYGON, tag);
    return 0;
}

static void add_label(struct tmj *tmj, const struct tmj_shape *shape)
{
    struct side *side = tmj->side;
    if (shape->name != NULL && *shape->name != '\0') {
        side->labels = memory_grow(side->labels, &side->label_capacity, side->label_count + 1, sizeof *side->labels);
        side->labels[side->label_count++] =
            (struct side_label){memory_text(shape->name), to_metres(tmj, shape->points[0])};
    }
}

int tmj_object_piece(struct tmj *tmj, struct tmj_shape *shape)
{
    enum tmj_kind kind = shape->traits.kind;
    if (kind == TMJ_START) {
        if (shape->form != TMJ_POINT) {
            return tmj_complain(tmj, "start: expected a point");
        }
        turn_up(tmj, shape);
        tmj->side->start = to_metres(tmj, shape->points[0]);
        tmj->side->has_start = 1;
        return 0;
    }
    if (shape->form >= TMJ_POINT) {
        turn_up(tmj, shape);
        if (shape->form == TMJ_TEXT) {
            add_label(tmj, shape);
        }
        return 0;
    }
    int says_nothing = kind == TMJ_PLAIN && !shape->traits.mover && shape->traits.belt == 0;
    if (kind == TMJ_DECORATION || (says_nothing && shape->traits.foreign)) {
        return 0; /* what it is, only its owner knows */
    }
    return put_in_order(tmj, shape) != 0 ? -1 : add_shape(tmj, shape);
}

/* For outline_finish. */
struct joining {
    struct tmj *tmj;
    enum side_kind kind;
};

static void found_outline(void *user, const struct outline_point *points, size_t count, enum outline_end end,
                          uint32_t tag)
{
    const struct joining *joining = user;
    add_piece(joining->tmj,
              (struct side_piece){.kind = joining->kind,
                                  .form = end == OUTLINE_RING ? SIDE_LOOP : SIDE_LINE,
                                  .part = end == OUTLINE_PART   ? 1
                                          : end == OUTLINE_LAST ? 2
                                                                : 0,
                                  .belt = joining->tmj->belts[tag]},
              points, count);
}

static int in_rows(const void *left, const void *right)
{
    const struct outline_point *a = left, *b = right; /* lower left, upper right */
    const double keys[6] = {a[0].y, b[0].y, a[1].y, b[1].y, a[0].x, b[0].x};
    for (int k = 0; k < 6; k += 2) {
        if (keys[k] != keys[k + 1]) {
            return keys[k] < keys[k + 1] ? -1 : 1;
        }
    }
    return 0;
}

/* Rows of water become one box, and rows of the same width over each other too. */
static void join_water(struct tmj *tmj)
{
    struct outline_point *boxes = tmj->boxes;
    size_t rows = 0, count = 0;
    if (tmj->box_count > 0) {
        qsort(boxes, tmj->box_count, 2 * sizeof *boxes, in_rows);
    }
    for (size_t i = 0; i < tmj->box_count; i++) {
        struct outline_point *row = rows > 0 ? boxes + 2 * (rows - 1) : NULL, *box = boxes + 2 * i;
        if (row != NULL && row[0].y == box[0].y && row[1].y == box[1].y && row[1].x == box[0].x) {
            row[1].x = box[1].x;
        } else {
            memmove(boxes + 2 * rows++, box, 2 * sizeof *box);
        }
    }
    for (size_t i = 0; i < rows; i++) {
        struct outline_point *box = boxes + 2 * i;
        size_t below = 0;
        while (below < count && !(boxes[2 * below + 1].y == box[0].y && boxes[2 * below].x == box[0].x &&
                                  boxes[2 * below + 1].x == box[1].x)) {
            below++;
        }
        if (below < count) {
            boxes[2 * below + 1].y = box[1].y;
        } else {
            memmove(boxes + 2 * count++, box, 2 * sizeof *box);
        }
    }
    for (size_t i = 0; i < count; i++) {
        add_piece(tmj, (struct side_piece){.kind = SIDE_WATER, .form = SIDE_BOX}, boxes + 2 * i, 2);
    }
}

void tmj_join_tiles(struct tmj *tmj)
{
    struct joining solid = {tmj, SIDE_SOLID}, one_way = {tmj, SIDE_ONE_WAY};
    outline_finish(&tmj->solids, found_outline, &solid);
    outline_finish(&tmj->planks, found_outline, &one_way);
    outline_finish(&tmj->lines, found_outline, &one_way);
    join_water(tmj);
    free(tmj->boxes);
}
