/* SPDX-License-Identifier: MIT
 * axes.c: a rectangle of the picture with axes, ticks and units, and text. */
#include "axes.h"

#include <math.h>
#include <stdio.h>

#define TICK_DISTANCE 70.0 /* points, at least */

double axes_x(const struct axes *axes, double x)
{
    return axes->left + (x - axes->x0) / (axes->x1 - axes->x0) * axes->width;
}

double axes_y(const struct axes *axes, double y)
{
    return axes->top + axes->height - (y - axes->y0) / (axes->y1 - axes->y0) * axes->height;
}

/* 1, 2 or 5 times a power of ten, so that ticks are about `distance` apart. */
static double tick_step(double span, double length, double distance)
{
    double rough = span / fmax(length / distance, 1), power = pow(10, floor(log10(rough)));
    double factor = rough / power;
    return power * (factor <= 1 ? 1 : factor <= 2 ? 2 : factor <= 5 ? 5 : 10);
}

void text_at(cairo_t *cairo, double x, double y, double size, double align, const char *text)
{
    cairo_text_extents_t extents;
    cairo_set_font_size(cairo, size);
    cairo_text_extents(cairo, text, &extents);
    cairo_move_to(cairo, x - align * extents.x_advance, y);
    cairo_show_text(cairo, text);
}

void text_on_map(cairo_t *cairo, double x, double y, double size, const char *text)
{
    cairo_text_extents_t extents;
    cairo_set_font_size(cairo, size);
    cairo_text_extents(cairo, text, &extents);
    cairo_move_to(cairo, x - extents.x_advance / 2, y);
    cairo_text_path(cairo, text);
    cairo_set_source_rgba(cairo, 1, 1, 1, 0.85);
    cairo_set_line_width(cairo, 2.6);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke_preserve(cairo);
    cairo_set_source_rgb(cairo, 0.16, 0.18, 0.22);
    cairo_fill(cairo);
}

static void number_at(cairo_t *cairo, double x, double y, double align, double value, double step)
{
    char text[32];
    int digits = step >= 1 ? 0 : (int)ceil(-log10(step) - 1e-9);
    snprintf(text, sizeof text, "%.*f", digits, fabs(value) < step * 1e-6 ? 0 : value);
    text_at(cairo, x, y, 11, align, text);
}

void axes_grid(const struct axes *axes)
{
    double step_x = tick_step(axes->x1 - axes->x0, axes->width, TICK_DISTANCE);
    double step_y = tick_step(axes->y1 - axes->y0, axes->height, TICK_DISTANCE / 2);
    cairo_set_source_rgba(axes->cairo, 0.2, 0.25, 0.35, 0.13);
    cairo_set_line_width(axes->cairo, 0.6);
    for (double x = ceil(axes->x0 / step_x) * step_x; x <= axes->x1; x += step_x) {
        cairo_move_to(axes->cairo, axes_x(axes, x), axes->top);
        cairo_rel_line_to(axes->cairo, 0, axes->height);
    }
    for (double y = ceil(axes->y0 / step_y) * step_y; y <= axes->y1; y += step_y) {
        cairo_move_to(axes->cairo, axes->left, axes_y(axes, y));
        cairo_rel_line_to(axes->cairo, axes->width, 0);
    }
    cairo_stroke(axes->cairo);
}

void axes_frame(const struct axes *axes)
{
    cairo_t *cairo = axes->cairo;
    double step_x = tick_step(axes->x1 - axes->x0, axes->width, TICK_DISTANCE);
    double step_y = tick_step(axes->y1 - axes->y0, axes->height, TICK_DISTANCE / 2);
    double bottom = axes->top + axes->height;
    cairo_set_source_rgb(cairo, 0.25, 0.28, 0.33);
    cairo_set_line_width(cairo, 1);
    cairo_rectangle(cairo, axes->left, axes->top, axes->width, axes->height);
    cairo_stroke(cairo);
    for (double x = ceil(axes->x0 / step_x) * step_x; x <= axes->x1 + step_x * 1e-9; x += step_x) {
        cairo_move_to(cairo, axes_x(axes, x), bottom);
        cairo_rel_line_to(cairo, 0, 4);
        cairo_stroke(cairo);
        number_at(cairo, axes_x(axes, x), bottom + 16, 0.5, x, step_x);
    }
    for (double y = ceil(axes->y0 / step_y) * step_y; y <= axes->y1 + step_y * 1e-9; y += step_y) {
        cairo_move_to(cairo, axes->left, axes_y(axes, y));
        cairo_rel_line_to(cairo, -4, 0);
        cairo_stroke(cairo);
        number_at(cairo, axes->left - 7, axes_y(axes, y) + 4, 1, y, step_y);
    }
    text_at(cairo, axes->left + axes->width / 2, bottom + 33, 12, 0.5, axes->x_name);
    cairo_save(cairo);
    cairo_translate(cairo, axes->left - 44, axes->top + axes->height / 2);
    cairo_rotate(cairo, -1.5707963267948966);
    text_at(cairo, 0, 0, 12, 0.5, axes->y_name);
    cairo_restore(cairo);
}
