/* SPDX-License-Identifier: MIT
 * picture_side.c: the ground of a level of two dimensions: what is solid, what can be stood on from above, water, what
 * moves, places that are watched. */
#include "picture.h"
#include "side.h"

#include <math.h>

static const double solid[3] = {0.80, 0.78, 0.74}, edge[3] = {0.25, 0.25, 0.28}, plank[3] = {0.55, 0.33, 0.10},
                    water[3] = {0.66, 0.81, 0.89}, moving[3] = {0.70, 0.86, 0.70}, dark[3] = {0.15, 0.40, 0.15},
                    zone[3] = {0.55, 0.45, 0.75}, belt[3] = {0.80, 0.35, 0.20};

/* Points, of lines that can be stood on from above only, of the other end of a mover's way, of places. */
static const double plank_dashes[2] = {6, 3}, goal_dashes[2] = {4, 3}, dots[2] = {1.5, 2.5};

static void set_colour(cairo_t *cairo, const double colour[3])
{
    cairo_set_source_rgb(cairo, colour[0], colour[1], colour[2]);
}

/* The line of a piece; of a path that another piece began where `goes_on`. */
static void add_line(cairo_t *cairo, const struct axes *axes, const struct side_piece *piece, int goes_on)
{
    for (size_t i = goes_on ? 1 : 0; i < piece->count; i++) {
        double x = axes_x(axes, piece->points[i].x), y = axes_y(axes, piece->points[i].y);
        i == 0 ? cairo_move_to(cairo, x, y) : cairo_line_to(cairo, x, y);
    }
}

static void add_path(cairo_t *cairo, const struct axes *axes, const struct side_piece *piece, struct side_point shift)
{
    struct side_point corners[4];
    const struct side_point *points = piece->points;
    size_t count = piece->count;
    if (piece->form == SIDE_CIRCLE) {
        double radius = piece->radius * axes->width / (axes->x1 - axes->x0);
        cairo_new_sub_path(cairo); /* the way round that outlines go, or it would be a hole in what it overlaps */
        cairo_arc_negative(cairo, axes_x(axes, points[0].x), axes_y(axes, points[0].y), radius, 6.283185307179586, 0);
        return;
    }
    if (piece->form == SIDE_BOX) {
        side_corners(piece, corners);
        points = corners;
        count = 4;
    }
    for (size_t i = 0; i < count; i++) {
        double x = axes_x(axes, points[i].x + shift.x), y = axes_y(axes, points[i].y + shift.y);
        i == 0 ? cairo_move_to(cairo, x, y) : cairo_line_to(cairo, x, y);
    }
    if (piece->form != SIDE_LINE) {
        cairo_close_path(cairo);
    }
}

/* What encloses something solid. */
static int is_filled(const struct side_piece *piece)
{
    return piece->kind == SIDE_SOLID && !piece->moves && (piece->form != SIDE_LINE || piece->part != 0);
}

/* Under the fill, which covers their inner half: where pieces overlap or touch, only the outline of all is left. */
static void draw_edges(cairo_t *cairo, const struct axes *axes, const struct side *side)
{
    const struct side_point still = {0, 0};
    for (size_t i = 0; i < side->count; i++) {
        if (is_filled(&side->pieces[i])) {
            add_path(cairo, axes, &side->pieces[i], still);
        }
    }
    set_colour(cairo, edge);
    cairo_set_line_width(cairo, 2.4);
    cairo_stroke(cairo);
}

/* Everything solid in one path: an outline round a hole runs the other way, and the hole stays empty. */
static void fill_solids(cairo_t *cairo, const struct axes *axes, const struct side *side)
{
    const struct side_point still = {0, 0};
    int goes_on = 0;
    for (size_t i = 0; i < side->count; i++) {
        const struct side_piece *piece = &side->pieces[i];
        if (piece->kind == SIDE_SOLID && !piece->moves && piece->form != SIDE_LINE) {
            add_path(cairo, axes, piece, still);
        } else if (piece->kind == SIDE_SOLID && piece->part != 0) {
            add_line(cairo, axes, piece, goes_on);
            goes_on = piece->part == 1;
        }
    }
    cairo_set_fill_rule(cairo, CAIRO_FILL_RULE_WINDING);
    set_colour(cairo, solid);
    cairo_fill(cairo);
}

static void draw_outline(cairo_t *cairo, const struct axes *axes, const struct side_piece *piece)
{
    const struct side_point still = {0, 0};
    add_path(cairo, axes, piece, still);
    if (piece->kind == SIDE_WATER) {
        cairo_set_source_rgba(cairo, 0.25, 0.60, 0.80, 0.35);
        cairo_fill(cairo);
    } else if (piece->kind == SIDE_ONE_WAY) {
        set_colour(cairo, plank);
        cairo_set_line_width(cairo, 2);
        cairo_set_dash(cairo, plank_dashes, 2, 0);
        cairo_stroke(cairo);
    } else if (is_filled(piece) && piece->belt == 0) {
        cairo_new_path(cairo); /* its edge is there */
    } else if (piece->kind == SIDE_SOLID) {
        set_colour(cairo, piece->belt != 0 ? belt : edge);
        cairo_set_line_width(cairo, piece->belt != 0 ? 2.4 : 1.1);
        cairo_stroke(cairo);
    } else {
        set_colour(cairo, zone);
        cairo_set_line_width(cairo, 1);
        cairo_set_dash(cairo, dots, 2, 0);
        cairo_stroke(cairo);
    }
    cairo_set_dash(cairo, NULL, 0, 0);
}

static void draw_arrow(cairo_t *cairo, double x0, double y0, double x1, double y1)
{
    const double length = hypot(x1 - x0, y1 - y0), head = 6;
    if (length < head) {
        return;
    }
    double ux = (x1 - x0) / length, uy = (y1 - y0) / length;
    cairo_move_to(cairo, x0, y0);
    cairo_line_to(cairo, x1, y1);
    cairo_line_to(cairo, x1 - head * ux + head / 2 * uy, y1 - head * uy - head / 2 * ux);
    cairo_move_to(cairo, x1, y1);
    cairo_line_to(cairo, x1 - head * ux - head / 2 * uy, y1 - head * uy + head / 2 * ux);
    cairo_set_line_width(cairo, 1.2);
    cairo_stroke(cairo);
}

/* Where it is at the start, the other end of its way, and an arrow between them. */
static void draw_mover(cairo_t *cairo, const struct axes *axes, const struct side_piece *piece)
{
    const struct side_point still = {0, 0}, low = piece->points[0], high = piece->points[1];
    double x = (low.x + high.x) / 2, y = (low.y + high.y) / 2;
    add_path(cairo, axes, piece, still);
    set_colour(cairo, moving);
    cairo_fill_preserve(cairo);
    set_colour(cairo, piece->kind == SIDE_ONE_WAY ? plank : dark);
    cairo_set_line_width(cairo, 1.4);
    cairo_set_dash(cairo, plank_dashes, piece->kind == SIDE_ONE_WAY ? 2 : 0, 0);
    cairo_stroke(cairo);
    add_path(cairo, axes, piece, piece->swing);
    set_colour(cairo, dark);
    cairo_set_line_width(cairo, 0.8);
    cairo_set_dash(cairo, goal_dashes, 2, 0);
    cairo_stroke(cairo);
    cairo_set_dash(cairo, NULL, 0, 0);
    draw_arrow(cairo, axes_x(axes, x), axes_y(axes, y), axes_x(axes, x + piece->swing.x),
               axes_y(axes, y + piece->swing.y));
}

/* A row of small arrows where a surface moves. */
static void draw_belt(cairo_t *cairo, const struct axes *axes, const struct side_piece *piece)
{
    double low = piece->points[0].x, high = low, top = piece->points[0].y;
    for (size_t i = 1; i < piece->count; i++) {
        low = fmin(low, piece->points[i].x);
        high = fmax(high, piece->points[i].x);
        top = fmax(top, piece->points[i].y);
    }
    set_colour(cairo, belt);
    for (double x = low + 0.3; x + 1 <= high; x += 1.6) {
        double from = piece->belt > 0 ? x : x + 1, y = axes_y(axes, top) + 7;
        draw_arrow(cairo, axes_x(axes, from), y, axes_x(axes, piece->belt > 0 ? x + 1 : x), y);
    }
}

void picture_side(const struct picture *picture, const struct axes *axes)
{
    const struct side *side = picture->plot->level->side;
    cairo_t *cairo = picture->cairo;
    cairo_save(cairo);
    cairo_rectangle(cairo, axes->left, axes->top, axes->width, axes->height);
    cairo_set_source_rgb(cairo, 0.97, 0.98, 1);
    cairo_fill_preserve(cairo);
    cairo_clip(cairo);
    for (size_t i = 0; i < side->count; i++) {
        if (side->pieces[i].kind == SIDE_WATER) {
            draw_outline(cairo, axes, &side->pieces[i]);
        }
    }
    draw_edges(cairo, axes, side);
    fill_solids(cairo, axes, side);
    axes_grid(axes);
    for (size_t i = 0; i < side->count; i++) {
        const struct side_piece *piece = &side->pieces[i];
        if (!piece->moves && piece->kind != SIDE_WATER) {
            draw_outline(cairo, axes, piece);
        }
        if (piece->belt != 0 && !piece->moves) {
            draw_belt(cairo, axes, piece);
        }
    }
    for (size_t i = 0; i < side->count; i++) {
        if (side->pieces[i].moves) {
            draw_mover(cairo, axes, &side->pieces[i]);
        }
    }
    cairo_restore(cairo);
}

void picture_side_labels(const struct picture *picture, const struct axes *axes)
{
    const struct side *side = picture->plot->level->side;
    cairo_t *cairo = picture->cairo;
    cairo_save(cairo);
    cairo_rectangle(cairo, axes->left, axes->top, axes->width, axes->height);
    cairo_clip(cairo);
    for (size_t i = 0; i < side->label_count; i++) {
        const struct side_label *label = &side->labels[i];
        text_on_map(cairo, axes_x(axes, label->at.x), axes_y(axes, label->at.y), 10, label->text);
    }
    cairo_restore(cairo);
}

static int has_kind(const struct side *side, enum side_kind kind)
{
    for (size_t i = 0; i < side->count; i++) {
        if (side->pieces[i].kind == kind) {
            return 1;
        }
    }
    return 0;
}

/* A line of the legend, drawn as it is in the map. Returns where the next one goes. */
static double legend_line(const struct picture *picture, double x, double y, const double dashes[2], const char *text)
{
    cairo_t *cairo = picture->cairo;
    int is_plank = dashes == plank_dashes;
    if (is_plank) {
        cairo_move_to(cairo, x, y - 4);
        cairo_rel_line_to(cairo, 26, 0);
    } else {
        cairo_rectangle(cairo, x + 4, y - 11, 18, 12);
    }
    set_colour(cairo, is_plank ? plank : dashes == dots ? zone : dark);
    cairo_set_line_width(cairo, is_plank ? 2 : 1);
    cairo_set_dash(cairo, dashes, 2, 0);
    cairo_stroke(cairo);
    cairo_set_dash(cairo, NULL, 0, 0);
    cairo_set_source_rgb(cairo, 0.16, 0.18, 0.22);
    text_at(cairo, x + 34, y, 12, 0, text);
    return y + 20;
}

double picture_side_legend(const struct picture *picture, double x, double y)
{
    const struct side *side = picture->plot->level->side;
    int movers = picture->plot->level->mover_count > 0, belts = 0;
    for (size_t i = 0; i < side->count; i++) {
        belts |= side->pieces[i].belt != 0;
    }
    y = picture_patch(picture, x, y, solid, "solid");
    y = has_kind(side, SIDE_ONE_WAY) ? legend_line(picture, x, y, plank_dashes, "one-way, from above") : y;
    y = has_kind(side, SIDE_WATER) ? picture_patch(picture, x, y, water, "water") : y;
    if (movers) {
        y = picture_patch(picture, x, y, moving, "moving, at the start");
        y = legend_line(picture, x, y, goal_dashes, "and at the other end");
    }
    y = belts ? picture_patch(picture, x, y, belt, "moving surface") : y;
    return has_kind(side, SIDE_SENSOR) ? legend_line(picture, x, y, dots, "watched place") : y;
}
