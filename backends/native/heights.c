/* SPDX-License-Identifier: MIT
 * heights.c: see heights.h. */
#include "heights.h"

#include "../common/mesh.h"

#include <string.h>

/* Two triangles a cell, and names of primitives have 28 bits. */
#define MOST_CELLS (1u << 27)

/* Half a cell: more than rounding could be wrong by, and places that are UNEVEN. */
#define OUTWARD 0.5
/* Corners of a mesh may be off an even grid by this part of a cell. */
#define UNEVEN 1e-3

static size_t samples_of(const tahr__heights *h)
{
    return (size_t)h->columns * h->rows;
}

static size_t bytes_of(const tahr__heights *h)
{
    return (samples_of(h) + h->columns + h->rows) * sizeof *h->z;
}

static double place(uint32_t i, uint32_t count, double half)
{
    return (2.0 * i / (count - 1) - 1) * half + 0.0;
}

/* Column and row of a corner of a triangle, seen from its cell: counter-clockwise from above. */
static const uint8_t CORNERS[2][3][2] = {{{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 1}, {0, 1}}};

void tahr__heights_cell(const tahr__heights *h, uint32_t column, uint32_t row, tahr_vec3 corners[4])
{
    const double *low = h->z + (size_t)row * h->columns + column, *high = low + h->columns;
    double x0 = h->x[column], x1 = h->x[column + 1], y0 = h->y[row], y1 = h->y[row + 1];
    corners[0] = v_make(x0, y0, low[0] + 0.0); /* no minus zero, as in a mesh */
    corners[1] = v_make(x1, y0, low[1] + 0.0);
    corners[2] = v_make(x1, y1, high[1] + 0.0);
    corners[3] = v_make(x0, y1, high[0] + 0.0);
}

int tahr__heights_half(const tahr__heights *h, const tahr_vec3 corners[4], uint32_t k, tahr_vec3 v[3])
{
    v[0] = corners[0];
    v[1] = corners[1 + k];
    v[2] = corners[2 + k];
    double sum = v[0].z + v[1].z + v[2].z;
    if (!(sum == sum)) return 0;
    return !h->may_be_thin || tahr__slimness(v[0], v[1], v[2]) > TAHR__NO_AREA;
}

int tahr__heights_triangle(const tahr__heights *h, uint32_t triangle, tahr_vec3 v[3])
{
    tahr_vec3 corners[4];
    uint32_t cell = triangle / 2;
    tahr__heights_cell(h, cell % (h->columns - 1), cell / (h->columns - 1), corners);
    return tahr__heights_half(h, corners, triangle % 2, v);
}

uint32_t tahr__heights_around(const tahr__heights *h, uint32_t triangle, uint32_t corner, uint32_t around[6])
{
    /* Which triangles of the cells up to one back have that corner. */
    static const struct {
        uint8_t column, row, triangle;
    } near[6] = {{1, 1, 0}, {1, 1, 1}, {0, 1, 1}, {1, 0, 0}, {0, 0, 0}, {0, 0, 1}};
    const uint8_t *at = CORNERS[triangle % 2][corner];
    uint32_t cell = triangle / 2, wide = h->columns - 1, count = 0;
    uint32_t column = cell % wide + at[0], row = cell / wide + at[1];
    for (int i = 0; i < 6; i++) {
        uint32_t c = column - near[i].column, r = row - near[i].row; /* below zero: far above */
        if (c < wide && r < h->rows - 1) around[count++] = 2 * (r * wide + c) + near[i].triangle;
    }
    return count;
}

uint32_t tahr__heights_across(const tahr__heights *h, uint32_t triangle, uint32_t edge)
{
    /* In which cell, seen from the one before that of the triangle; it is always the other half. Below zero: far
     * above. */
    static const uint32_t at[2][3][2] = {{{1, 0}, {2, 1}, {1, 1}}, {{1, 1}, {1, 2}, {0, 1}}};
    const uint32_t k = triangle % 2, cell = triangle / 2, wide = h->columns - 1, row = cell / wide;
    const uint32_t c = cell - row * wide + at[k][edge][0] - 1, r = row + at[k][edge][1] - 1;
    return c < wide && r < h->rows - 1 ? 2 * (r * wide + c) + 1 - k : triangle;
}

/* First and last cell of [low, high] along one way; at: of the corners. */
static void span(double low, double high, const double *at, uint32_t corners, uint32_t *first, uint32_t *end)
{
    double scale = (corners - 1) / (at[corners - 1] - at[0]), most = corners - 1;
    double from = floor((low - at[0]) * scale - OUTWARD), to = floor((high - at[0]) * scale + OUTWARD) + 1;
    *first = (uint32_t)d_max(0, d_min(from, most));
    *end = (uint32_t)d_max(0, d_min(to, most));
}

tahr__heights_range tahr__heights_cells(const tahr__heights *h, const tahr_bounds *box)
{
    tahr__heights_range r;
    span(box->min.x, box->max.x, h->x, h->columns, &r.column, &r.column_end);
    span(box->min.y, box->max.y, h->y, h->rows, &r.row, &r.row_end);
    return r;
}

static uint32_t cell_at(double x, const double *at, uint32_t corners)
{
    double cell = floor((x - at[0]) * ((corners - 1) / (at[corners - 1] - at[0])));
    return (uint32_t)d_max(0, d_min(cell, corners - 2.0));
}

void tahr__heights_at(const tahr__heights *h, double x, double y, uint32_t *column, uint32_t *row)
{
    *column = cell_at(x, h->x, h->columns);
    *row = cell_at(y, h->y, h->rows);
}

/* The least slimness that a triangle of this field may have: its area seen from above over its longest edge. */
static int may_be_thin(const tahr__heights *h, double range)
{
    double x = 2 * h->half_x / (h->columns - 1), y = 2 * h->half_y / (h->rows - 1);
    return !(x * y / (x * x + y * y + range * range) > 2 * TAHR__THIN);
}

static int find_bounds(const tahr__heights *h, tahr_bounds *bounds)
{
    uint32_t found = 0;
    for (uint32_t i = 0; i < 2 * (h->columns - 1) * (h->rows - 1); i++) {
        tahr_vec3 v[3];
        if (!tahr__heights_triangle(h, i, v)) continue;
        if (!found) bounds->min = bounds->max = v[0];
        found = 1;
        bounds->min = v_min(bounds->min, v_min(v[0], v_min(v[1], v[2])));
        bounds->max = v_max(bounds->max, v_max(v[0], v_max(v[1], v[2])));
    }
    return found != 0;
}

/* Room for a field of that size. */
static tahr_status give_room(const tahr_host *host, tahr__heights *h)
{
    h->z = host->allocator.alloc(host->allocator.user, bytes_of(h), 64);
    if (!h->z) return TAHR_E_MEMORY;
    h->x = h->z + samples_of(h);
    h->y = h->x + h->columns;
    return TAHR_OK;
}

/* What there is to know once all numbers are there; 0: it has no triangle. */
static int finish(tahr__heights *h, tahr_bounds *bounds)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < samples_of(h); i++) {
        h->has_holes |= h->z[i] != h->z[i];
        low = d_min(h->z[i], low);
        high = d_max(h->z[i], high);
    }
    h->may_be_thin = low <= high ? (uint32_t)may_be_thin(h, high - low) : 0;
    return find_bounds(h, bounds);
}

tahr_status tahr__heights_open(const tahr_host *host, const tahr_body_desc *d, uint32_t body, tahr__heights *heights,
                               tahr_bounds *bounds)
{
    tahr__heights h = {
        .columns = d->columns, .rows = d->rows, .half_x = d->half_extents.x, .half_y = d->half_extents.y};
    if ((uint64_t)(h.columns - 1) * (h.rows - 1) > MOST_CELLS) {
        tahr__log_body(host, body, "columns times rows is above 2^27");
        return TAHR_E_UNSUPPORTED;
    }
    if (give_room(host, &h) != TAHR_OK) return TAHR_E_MEMORY;
    for (uint32_t i = 0; i < h.columns; i++)
        h.x[i] = place(i, h.columns, h.half_x);
    for (uint32_t i = 0; i < h.rows; i++)
        h.y[i] = place(i, h.rows, h.half_y);
    memcpy(h.z, d->heights, samples_of(&h) * sizeof *h.z);
    if (!finish(&h, bounds)) {
        tahr__log_body(host, body, "heights: no triangle of the field is without a hole at a corner");
        tahr__heights_close(host, &h);
        return TAHR_E_GEOMETRY;
    }
    *heights = h;
    return TAHR_OK;
}

/* Are the triangles of a mesh those of a field with that many columns, corner by corner and in their order? */
static int has_field_order(const tahr__mesh_source *s, uint32_t columns)
{
    uint32_t wide = columns - 1;
    for (uint32_t i = 0; i < s->triangle_count; i++) {
        uint32_t cell = i / 2, lowest = cell / wide * columns + cell % wide;
        for (int k = 0; k < 3; k++) {
            const uint8_t *at = CORNERS[i % 2][k];
            if (s->indices[3 * (size_t)i + (size_t)k] != lowest + at[0] + at[1] * columns) return 0;
        }
    }
    return 1;
}

/* Do they grow evenly? */
static int is_even(const double *at, uint32_t count)
{
    double step = (at[count - 1] - at[0]) / (count - 1);
    for (uint32_t i = 0; i < count; i++) {
        if (!(fabs(at[i] - (at[0] + i * step)) <= UNEVEN * step)) return 0;
    }
    return step > 0;
}

/* Takes the corners over; 0: they are not on a grid. */
static int take_corners(const tahr__mesh_source *s, tahr__heights *h)
{
    for (uint32_t i = 0; i < h->columns; i++)
        h->x[i] = s->vertices[3 * (size_t)i] + 0.0;
    for (uint32_t i = 0; i < h->rows; i++)
        h->y[i] = s->vertices[3 * (size_t)i * h->columns + 1] + 0.0;
    if (!is_even(h->x, h->columns) || !is_even(h->y, h->rows)) return 0;
    for (uint32_t row = 0; row < h->rows; row++) {
        for (uint32_t column = 0; column < h->columns; column++) {
            size_t i = (size_t)row * h->columns + column;
            const double *v = s->vertices + 3 * i;
            if (v[0] != h->x[column] || v[1] != h->y[row]) return 0;
            h->z[i] = v[2];
        }
    }
    h->half_x = 0.5 * (h->x[h->columns - 1] - h->x[0]);
    h->half_y = 0.5 * (h->y[h->rows - 1] - h->y[0]);
    return 1;
}

tahr_status tahr__heights_of_mesh(const tahr_host *host, const tahr__mesh_source *s, tahr__heights *heights,
                                  tahr_bounds *bounds)
{
    const uint32_t *first = s->indices;
    if (s->triangle_count < 2 || first[0] != 0 || first[1] != 1 || first[2] < 3) return TAHR_E_NOT_FOUND;
    tahr__heights h = {.columns = first[2] - 1};
    h.rows = s->vertex_count / h.columns;
    uint64_t cells = (uint64_t)(h.columns - 1) * (h.rows - 1);
    if (h.rows < 2 || h.rows * h.columns != s->vertex_count || cells > MOST_CELLS || 2 * cells != s->triangle_count)
        return TAHR_E_NOT_FOUND;
    if (!has_field_order(s, h.columns)) return TAHR_E_NOT_FOUND;
    if (give_room(host, &h) != TAHR_OK) return TAHR_E_MEMORY;
    if (!take_corners(s, &h) || !finish(&h, bounds)) {
        tahr__heights_close(host, &h);
        return TAHR_E_NOT_FOUND;
    }
    *heights = h;
    return TAHR_OK;
}

void tahr__heights_close(const tahr_host *host, tahr__heights *h)
{
    if (h->z) host->allocator.free(host->allocator.user, h->z, bytes_of(h), 64);
    h->z = NULL;
}
