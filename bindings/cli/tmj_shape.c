/* SPDX-License-Identifier: MIT
 * tmj_shape.c: the shapes of Tiled's objects: rectangles, polygons, lines, ellipses, points. */
#include "say.h"
#include "tmj.h"
#include "wander.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ELLIPSE_CORNERS 48 /* of an ellipse that is no circle: off by 0.2 % of its size */

/* Farther than this no level reaches; corners then still fit into whole numbers whose products do. */
static const double place_range[2] = {-4e6, 4e6};
static const double size_range[2] = {0, 4e6};

static int read_points(struct tmj *tmj, const json_t *object, const char *key, size_t least, struct tmj_shape *shape)
{
    const json_t *list = tmj_list(tmj, object, key);
    int failed = list == NULL;
    if (!failed && json_array_size(list) < least) {
        failed = tmj_complain(tmj, "%s: expected at least %zu points, not %zu", key, least, json_array_size(list));
    }
    if (failed) {
        return -1;
    }
    shape->count = json_array_size(list);
    shape->points = memory_new(shape->count, sizeof *shape->points);
    for (size_t i = 0; i < shape->count && !failed; i++) {
        size_t before = tmj_enter(tmj, ".%s[%zu]", key, i);
        failed = tmj_number(tmj, json_array_get(list, i), "x", place_range, &shape->points[i].x) != 0 ||
                 tmj_number(tmj, json_array_get(list, i), "y", place_range, &shape->points[i].y) != 0;
        tmj_leave(tmj, before);
    }
    return failed ? -1 : 0;
}

static void make_rectangle(struct tmj_shape *shape, double width, double height)
{
    const struct outline_point corners[4] = {{0, 0}, {width, 0}, {width, height}, {0, height}};
    shape->form = TMJ_POLYGON;
    shape->count = 4;
    shape->points = memory_new(4, sizeof *shape->points);
    memcpy(shape->points, corners, sizeof corners);
}

static void make_ellipse(struct tmj_shape *shape, double width, double height)
{
    int circle = width == height;
    shape->form = circle ? TMJ_CIRCLE : TMJ_POLYGON;
    shape->radius = width / 2;
    shape->count = circle ? 1 : ELLIPSE_CORNERS;
    shape->points = memory_new(shape->count, sizeof *shape->points);
    for (size_t i = 0; i < shape->count; i++) {
        tahr_vec3 way = circle ? (tahr_vec3){0} : unit_vector((double)i / ELLIPSE_CORNERS);
        shape->points[i] = (struct outline_point){width / 2 * (1 + way.x), height / 2 * (1 + way.y)};
    }
}

static int read_form(struct tmj *tmj, const json_t *object, struct tmj_shape *shape)
{
    double width = 0, height = 0;
    if (json_object_get(object, "polygon") != NULL) {
        shape->form = TMJ_POLYGON;
        return read_points(tmj, object, "polygon", 3, shape);
    }
    if (json_object_get(object, "polyline") != NULL) {
        shape->form = TMJ_LINE;
        return read_points(tmj, object, "polyline", 2, shape);
    }
    if (json_is_true(json_object_get(object, "point")) || json_object_get(object, "text") != NULL) {
        shape->form = json_object_get(object, "text") != NULL ? TMJ_TEXT : TMJ_POINT;
        shape->count = 1;
        shape->points = memory_new(1, sizeof *shape->points);
        return 0;
    }
    if (json_is_true(json_object_get(object, "capsule"))) {
        return tmj_complain(tmj, "a capsule; expected a rectangle, polygon, polyline, ellipse or point");
    }
    if (tmj_number(tmj, object, "width", size_range, &width) != 0 ||
        tmj_number(tmj, object, "height", size_range, &height) != 0) {
        return -1;
    }
    if (width <= 0 || height <= 0) {
        return tmj_complain(tmj, "%g by %g pixels: expected a size above 0", width, height);
    }
    if (json_is_true(json_object_get(object, "ellipse"))) {
        make_ellipse(shape, width, height);
    } else {
        make_rectangle(shape, width, height);
    }
    return 0;
}

int tmj_shape(struct tmj *tmj, const json_t *object, struct tmj_shape *shape)
{
    double x = 0, y = 0, degrees = 0;
    const double turn_range[2] = {-1e6, 1e6};
    *shape = (struct tmj_shape){.traits = shape->traits, .name = json_string_value(json_object_get(object, "name"))};
    if (!json_is_object(object)) {
        return tmj_complain(tmj, "expected an object");
    }
    if (json_object_get(object, "template") != NULL) {
        return tmj_complain(tmj, "template: templates are not read; expected the object itself (Detach in Tiled)");
    }
    if (tmj_number(tmj, object, "x", place_range, &x) != 0 || tmj_number(tmj, object, "y", place_range, &y) != 0 ||
        (json_object_get(object, "rotation") != NULL &&
         tmj_number(tmj, object, "rotation", turn_range, &degrees) != 0) ||
        tmj_traits(tmj, object, &shape->traits) != 0 || read_form(tmj, object, shape) != 0) {
        tmj_shape_free(shape);
        return -1;
    }
    tmj_shape_turn(shape, degrees);
    tmj_shape_move(shape, x, y);
    return 0;
}

void tmj_shape_free(struct tmj_shape *shape)
{
    free(shape->points);
    shape->points = NULL;
    shape->count = 0;
}

struct tmj_shape tmj_shape_copy(const struct tmj_shape *shape)
{
    struct tmj_shape copy = *shape;
    copy.points = memory_new(shape->count, sizeof *copy.points);
    memcpy(copy.points, shape->points, shape->count * sizeof *copy.points);
    return copy;
}

void tmj_shape_move(struct tmj_shape *shape, double x, double y)
{
    for (size_t i = 0; i < shape->count; i++) {
        shape->points[i].x += x;
        shape->points[i].y += y;
    }
}

void tmj_shape_scale(struct tmj_shape *shape, double x, double y)
{
    for (size_t i = 0; i < shape->count; i++) {
        shape->points[i].x *= x;
        shape->points[i].y *= y;
    }
    shape->radius *= (fabs(x) + fabs(y)) / 2;
}

void tmj_shape_turn(struct tmj_shape *shape, double degrees)
{
    double turn = degrees / 360 - floor(degrees / 360);
    if (turn <= 0 || turn >= 1) {
        return;
    }
    tahr_vec3 way = unit_vector(turn); /* y is down: what turns from x to y turns clockwise as seen */
    for (size_t i = 0; i < shape->count; i++) {
        struct outline_point p = shape->points[i];
        shape->points[i] = (struct outline_point){p.x * way.x - p.y * way.y, p.x * way.y + p.y * way.x};
    }
}
