/* SPDX-License-Identifier: MIT
 * axes.h: a rectangle of the picture with axes, ticks and units, and text. */
#ifndef TAHR_CLI_AXES_H
#define TAHR_CLI_AXES_H

#include <cairo.h>

/* Values x0..x1 from left to right and y0..y1 from bottom to top of a rectangle, in points of the picture. */
struct axes {
    cairo_t *cairo;
    double left, top, width, height;
    double x0, x1, y0, y1;
    const char *x_name, *y_name; /* with unit */
};

double axes_x(const struct axes *axes, double x);
double axes_y(const struct axes *axes, double y);

/* Faint grid lines; to be drawn before the data. */
void axes_grid(const struct axes *axes);

/* Frame, ticks, numbers and names; to be drawn after the data. */
void axes_frame(const struct axes *axes);

/* Text at (x, y); align 0 starts there, 0.5 is centred, 1 ends there. */
void text_at(cairo_t *cairo, double x, double y, double size, double align, const char *text);

/* The same on a white halo, to be read on any ground. */
void text_on_map(cairo_t *cairo, double x, double y, double size, const char *text);

#endif
