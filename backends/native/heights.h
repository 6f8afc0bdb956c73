/* SPDX-License-Identifier: MIT
 * heights.h: a field of heights: nothing is stored but the heights, triangles are made where they are asked for.
 *
 * Triangle 2 * cell + k of cell row * (columns - 1) + column: both are cut along the way from the lowest corner (x, y)
 * to the highest; k = 0 lies on the side of larger x. One with a hole at a corner is not there. */
#ifndef TAHR_NATIVE_HEIGHTS_H
#define TAHR_NATIVE_HEIGHTS_H

#include "../common/mesh.h"

#include <tahr/backend.h>

typedef struct tahr__heights {
    double *z;     /* rows * columns; NULL: no field */
    double *x, *y; /* of columns and rows: exact at both ends, so that fields side by side fit */
    uint32_t columns, rows;
    uint32_t may_be_thin; /* 0: no triangle of it is thin or without area */
    uint32_t has_holes;
    double half_x, half_y;
} tahr__heights;

/* Cells [column, column_end) x [row, row_end). */
typedef struct tahr__heights_range {
    uint32_t column, column_end, row, row_end;
} tahr__heights_range;

/* TAHR_OK, TAHR_E_GEOMETRY, TAHR_E_UNSUPPORTED (with a message), TAHR_E_MEMORY. [out] bounds of its surface. */
tahr_status tahr__heights_open(const tahr_host *host, const tahr_body_desc *desc, uint32_t body, tahr__heights *heights,
                               tahr_bounds *bounds);
/* The field that a mesh is, if its triangles and their corners are those of one, in their order and bit for bit on an
 * even grid: then it answers as the mesh does. TAHR_OK, TAHR_E_NOT_FOUND (it is none), TAHR_E_MEMORY. source:
 * checked. */
tahr_status tahr__heights_of_mesh(const tahr_host *host, const tahr__mesh_source *source, tahr__heights *heights,
                                  tahr_bounds *bounds);
void tahr__heights_close(const tahr_host *host, tahr__heights *heights);

/* Which cells a box may concern. */
tahr__heights_range tahr__heights_cells(const tahr__heights *heights, const tahr_bounds *box);
/* The cell of a place, or the nearest to it. */
void tahr__heights_at(const tahr__heights *heights, double x, double y, uint32_t *column, uint32_t *row);
/* Exact corners of a triangle; 0: it is not there. */
int tahr__heights_triangle(const tahr__heights *heights, uint32_t triangle, tahr_vec3 v[3]);
/* The same of the four corners of a cell, counter-clockwise from the lowest, and of its triangle k out of them. */
void tahr__heights_cell(const tahr__heights *heights, uint32_t column, uint32_t row, tahr_vec3 corners[4]);
int tahr__heights_half(const tahr__heights *heights, const tahr_vec3 corners[4], uint32_t k, tahr_vec3 v[3]);
/* The triangles, there or not, at a corner of a triangle; returns how many, at most 6. */
uint32_t tahr__heights_around(const tahr__heights *heights, uint32_t triangle, uint32_t corner, uint32_t around[6]);

/* The triangle, there or not, on the other side of edge i (corner i to corner i+1); itself at the border. */
uint32_t tahr__heights_across(const tahr__heights *heights, uint32_t triangle, uint32_t edge);

static inline tahr_vec3 tahr__heights_normal(const tahr_vec3 v[3])
{
    return v_unit(v_cross(v_sub(v[1], v[0]), v_sub(v[2], v[0])));
}

#endif
