/* SPDX-License-Identifier: MIT
 * picture.h: a picture under way, and what was done in it: paths and marks over a ground that others draw. */
#ifndef TAHR_CLI_PICTURE_H
#define TAHR_CLI_PICTURE_H

#include "axes.h"
#include "plot.h"

enum { MAX_STRIPS = 6 };

/* A level of two dimensions may be so long that it is drawn in strips over each other. */
struct picture {
    const struct plot *plot;
    cairo_t *cairo;
    struct axes maps[MAX_STRIPS], profile;
    size_t strip_count;
    double width, height;
    uint32_t path_count; /* drawn */
};

enum { SHAPE_UP, SHAPE_DOWN, SHAPE_DOT, SHAPE_SQUARE, SHAPE_CROSS, SHAPE_RING };

/* A kind of mark. */
struct kind {
    uint32_t type;
    int shape;
    double size; /* points */
    double colour[3];
    const char *name;
};

/* The index-th kind, or NULL after the last. Later kinds are drawn over earlier ones. */
const struct kind *picture_kind(size_t index);
void picture_symbol(cairo_t *cairo, const struct kind *kind, double x, double y, double size);

/* Colour, width and dashes of a path in this mode. */
void picture_style(const struct picture *picture, uint32_t mode);

/* Paths, marks and starts: in a map by place, in the profile by time. */
void picture_data(const struct picture *picture, const struct axes *axes);

/* The ground of a level of two dimensions, and its share of the legend. */
void picture_side(const struct picture *picture, const struct axes *axes);
/* Over the paths. */
void picture_side_labels(const struct picture *picture, const struct axes *axes);

/* One patch of the legend; returns where the next line goes. */
double picture_patch(const struct picture *picture, double x, double y, const double colour[3], const char *text);
double picture_side_legend(const struct picture *picture, double x, double y);

#endif
