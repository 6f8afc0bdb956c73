/* SPDX-License-Identifier: MIT
 * method_outline.c: takes the edges that lie at z = 1 and joins them to lines. */
#include "method_outline.h"

#include <stdlib.h>
#include <string.h>

static const uint32_t NONE = UINT32_MAX;

typedef struct links {
    uint32_t *next, *previous; /* of a vertex, along the outline; NONE */
} links;

static const double *corner(const method_level *level, uint32_t triangle, int k)
{
    return level->vertices + 3 * (size_t)level->indices[3 * (size_t)triangle + (size_t)(k % 3)];
}

/* A quad that was drawn out has one edge at z = 1. A cap has all three there: they belong to quads. */
static void link_edges(const method_level *level, links *l)
{
    for (uint32_t i = 0; i < level->triangle_count; i++) {
        for (int k = 0; k < 3; k++) {
            const double *a = corner(level, i, k), *b = corner(level, i, k + 1), *c = corner(level, i, k + 2);
            if (a[2] == 1 && b[2] == 1 && c[2] != 1) {
                uint32_t from = (uint32_t)((a - level->vertices) / 3), to = (uint32_t)((b - level->vertices) / 3);
                l->next[to] = from; /* the triangle is in front on the left hand of from, to */
                l->previous[from] = to;
            }
        }
    }
}

static void add_line(method_outline *o, const method_level *level, links *l, uint32_t start)
{
    method_line *line = &o->lines[o->line_count++];
    *line = (method_line){.first = o->point_count};
    for (uint32_t v = start; v != NONE;) {
        uint32_t next = l->next[v];
        memcpy(o->points + 2 * (size_t)o->point_count++, level->vertices + 3 * (size_t)v, 2 * sizeof(double));
        l->next[v] = l->previous[v] = NONE;
        line->count++;
        line->loop = next == start;
        v = line->loop ? NONE : next;
    }
}

int method_outline_make(method_outline *o, const method_level *level)
{
    size_t count = level->vertex_count;
    links l = {malloc(sizeof *l.next * (count + 1)), malloc(sizeof *l.previous * (count + 1))};
    memset(o, 0, sizeof *o);
    o->points = malloc(sizeof *o->points * 2 * (count + 1));
    o->lines = malloc(sizeof *o->lines * (count + 1));
    int ok = l.next && l.previous && o->points && o->lines;
    if (ok) {
        memset(l.next, 0xff, sizeof *l.next * count);
        memset(l.previous, 0xff, sizeof *l.previous * count);
        link_edges(level, &l);
        for (int loops = 0; loops < 2; loops++) { /* what has a beginning first, then what has none */
            for (uint32_t v = 0; v < level->vertex_count; v++) {
                if (l.next[v] != NONE && (loops || l.previous[v] == NONE)) {
                    add_line(o, level, &l, v);
                }
            }
        }
    }
    free(l.next);
    free(l.previous);
    return ok;
}

void method_outline_free(method_outline *o)
{
    free(o->points);
    free(o->lines);
    memset(o, 0, sizeof *o);
}
