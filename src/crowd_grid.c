/* SPDX-License-Identifier: MIT
 * crowd_grid.c: a grid with cells twice as wide as two characters can be apart and still meet: then only the four cells
 * around the nearest corner count. The few that are much larger than the others would make all cells as wide as they
 * are: they are in none, and everybody looks at each of them. */
#include "crowd_grid.h"

#include <string.h>

/* Of the crowd, that may be taken for much larger than the others. */
static uint32_t most_wide(uint32_t count)
{
    return 4 + count / 1024;
}

static double component(vec3 v, int axis)
{
    return axis == 0 ? v.x : (axis == 1 ? v.y : v.z);
}

static double half_width(const tahr__figure *f, const int axis[2])
{
    return max_of(component(f->box, axis[0]), component(f->box, axis[1]));
}

/* The exponent of a double, from 2^-7. */
static int size_of(double width)
{
    uint64_t bits;
    memcpy(&bits, &width, sizeof bits);
    int size = (int)(bits >> 52) - (1023 - 7);
    return size < 0 ? 0 : (size >= TAHR__SIZES ? TAHR__SIZES - 1 : size);
}

void tahr__spread_begin(tahr__spread *s, const int axis[2])
{
    for (int i = 0; i < TAHR__SIZES; i++) { /* not at once: compilers clear that much with a slow string instruction */
        s->largest[i] = 0;
        s->count[i] = 0;
    }
    s->axis[0] = axis[0];
    s->axis[1] = axis[1];
    s->min = vec(INFINITY, INFINITY, INFINITY);
    s->max = vec(-INFINITY, -INFINITY, -INFINITY);
}

void tahr__spread_add(tahr__spread *s, const tahr__figure *f)
{
    if (!(f->flags & TAHR__FIGURE_THERE)) {
        return;
    }
    const vec3 at = f->range.at;
    const double width = half_width(f, s->axis);
    const int size = size_of(width);
    s->min = vec(min_of(s->min.x, at.x), min_of(s->min.y, at.y), min_of(s->min.z, at.z));
    s->max = vec(max_of(s->max.x, at.x), max_of(s->max.y, at.y), max_of(s->max.z, at.z));
    s->largest[size] = max_of(s->largest[size], width);
    s->count[size]++;
}

void tahr__spread_merge(tahr__spread *s, const tahr__spread *o)
{
    s->min = vec(min_of(s->min.x, o->min.x), min_of(s->min.y, o->min.y), min_of(s->min.z, o->min.z));
    s->max = vec(max_of(s->max.x, o->max.x), max_of(s->max.y, o->max.y), max_of(s->max.z, o->max.z));
    for (int i = 0; i < TAHR__SIZES; i++) {
        s->largest[i] = max_of(s->largest[i], o->largest[i]);
        s->count[i] += o->count[i];
    }
}

void tahr__grid_begin(tahr__grid *g, const tahr__spread *s)
{
    uint32_t wide = 0;
    int size = TAHR__SIZES - 1, narrow = 0;
    while (size > 0 && wide + s->count[size] <= most_wide(g->count)) {
        wide += s->count[size--];
    }
    g->cells.wide = s->largest[size] > 0 ? s->largest[size] : 1;
    g->cells.per_cell = 1 / (4.001 * g->cells.wide); /* a thousandth for rounding */
    vec3 across = sub(s->max, s->min);
    for (int axis = 1; axis < 3; axis++) {
        narrow = component(across, axis) <= component(across, narrow) ? axis : narrow;
    }
    g->cells.axis[0] = narrow == 0 ? 1 : 0;
    g->cells.axis[1] = narrow == 2 ? 1 : 2;
}

static uint64_t mix(int64_t x, int64_t y)
{
    return (uint64_t)x * TAHR__ALONG + (uint64_t)y * TAHR__ACROSS;
}

/* Rounds down, within what an int64_t holds: places are within 2e7 m, cells no smaller than 1e-6 m. */
static int64_t cell_of(double x)
{
    int64_t i = (int64_t)x;
    return (double)i > x ? i - 1 : i;
}

void tahr__grid_place(tahr__grid *g, uint32_t begin, uint32_t end, uint32_t kept)
{
    const int a = g->cells.axis[0], b = g->cells.axis[1];
    for (uint32_t i = begin; i < end; i++) {
        const tahr__figure *f = &g->figures[i];
        if (f->flags & kept) {
            continue;
        }
        if (!(f->flags & TAHR__FIGURE_THERE)) {
            g->bucket[i] = g->mask + 2; /* behind all buckets: in no run */
        } else if (half_width(f, g->cells.axis) > g->cells.wide) {
            g->bucket[i] = 0;
        } else {
            const double x = component(f->range.at, a) * g->cells.per_cell,
                         y = component(f->range.at, b) * g->cells.per_cell;
            const int64_t low_x = cell_of(x - 0.5), low_y = cell_of(y - 0.5);
            const uint64_t corner = mix(low_x, low_y);
            /* Its own cell is one of the four. */
            const uint64_t own =
                (x >= (double)(low_x + 1) ? TAHR__ALONG : 0) + (y >= (double)(low_y + 1) ? TAHR__ACROSS : 0);
            g->corner[i] = corner;
            g->bucket[i] = grid_bucket(g, corner + own);
        }
    }
}

void tahr__grid_sort(tahr__grid *g)
{
    const uint32_t buckets = g->mask + 3;
    memset(g->start, 0, (buckets + 1) * sizeof *g->start);
    for (uint32_t i = 0; i < g->count; i++) {
        g->start[g->bucket[i] + 1]++;
    }
    g->wide_count = g->start[1];
    for (uint32_t b = 0; b < buckets; b++) {
        g->start[b + 1] += g->start[b];
    }
    /* Each bucket is filled from its end, which leaves start[b + 1] at its begin; then all move down by one. */
    for (uint32_t i = g->count; i-- > 0;) {
        g->order[--g->start[g->bucket[i] + 1]] = i;
    }
    memmove(g->start, g->start + 1, buckets * sizeof *g->start);
    g->start[buckets] = g->count;
}
