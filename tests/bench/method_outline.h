/* SPDX-License-Identifier: MIT
 * method_outline.h: the outline of a planar level: what its triangles are drawn out of, for engines of two dimensions.
 */
#ifndef TAHR_BENCH_METHOD_OUTLINE_H
#define TAHR_BENCH_METHOD_OUTLINE_H

#include "method.h"

/* One line: points[2 * first] and on, x and y; in front on its right hand. loop: its last point is joined to the first. */
typedef struct method_line {
    uint32_t first, count;
    int loop;
} method_line;

typedef struct method_outline {
    double *points;
    method_line *lines;
    uint32_t point_count, line_count;
} method_outline;

/* Returns 0 without memory for it. Free it afterwards in any case. */
int method_outline_make(method_outline *outline, const method_level *level);
void method_outline_free(method_outline *outline);

#endif
