/* SPDX-License-Identifier: MIT
 * outline.c: the outlines of many polygons that lie side by side. All corners are whole numbers: sides on one line are
 * added up along it, and what goes there and back is inside. */
#include "outline.h"

#include "say.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void add_edge(struct outline *outline, struct outline_edge edge)
{
    if (edge.ax == edge.bx && edge.ay == edge.by) {
        return;
    }
    outline->edges = memory_grow(outline->edges, &outline->capacity, outline->count + 1, sizeof *outline->edges);
    outline->edges[outline->count++] = edge;
}

void outline_add(struct outline *outline, const struct outline_point *points, size_t count, int closed, uint32_t tag)
{
    for (size_t i = 0; i + (closed ? 0 : 1) < count; i++) {
        const struct outline_point *a = &points[i], *b = &points[(i + 1) % count];
        add_edge(outline, (struct outline_edge){.ax = llround(a->x * OUTLINE_GRID),
                                                .ay = llround(a->y * OUTLINE_GRID),
                                                .bx = llround(b->x * OUTLINE_GRID),
                                                .by = llround(b->y * OUTLINE_GRID),
                                                .tag = tag});
    }
}

/* An edge on its line: direction (dx, dy) to the right or straight up, offset, and where on it the edge begins and
 * ends; sign -1: the edge goes the other way. */
struct lying {
    int64_t dx, dy, offset, from, to;
    int sign;
    uint32_t tag;
};

static int64_t common_divisor(int64_t a, int64_t b)
{
    a = a < 0 ? -a : a;
    b = b < 0 ? -b : b;
    while (b != 0) {
        int64_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

static struct lying lie_down(const struct outline_edge *e)
{
    struct lying l = {.dx = e->bx - e->ax, .dy = e->by - e->ay, .sign = 1, .tag = e->tag};
    int64_t divisor = common_divisor(l.dx, l.dy);
    if (l.dx < 0 || (l.dx == 0 && l.dy < 0)) {
        divisor = -divisor;
        l.sign = -1;
    }
    l.dx /= divisor;
    l.dy /= divisor;
    l.offset = l.dx * e->ay - l.dy * e->ax;
    /* Along the line x tells where, or y where it is upright. */
    int64_t a = l.dx != 0 ? e->ax : e->ay, b = l.dx != 0 ? e->bx : e->by;
    l.from = a < b ? a : b;
    l.to = a < b ? b : a;
    return l;
}

static int compare(int64_t a, int64_t b)
{
    return (a > b) - (a < b);
}

static int same_line(const struct lying *a, const struct lying *b)
{
    return a->dx == b->dx && a->dy == b->dy && a->offset == b->offset;
}

static int by_line(const void *left, const void *right)
{
    const struct lying *a = left, *b = right;
    int order = compare(a->dx, b->dx);
    order = order ? order : compare(a->dy, b->dy);
    order = order ? order : compare(a->offset, b->offset);
    order = order ? order : compare(a->from, b->from);
    order = order ? order : compare(a->to, b->to);
    order = order ? order : compare(a->sign, b->sign);
    return order ? order : compare(a->tag, b->tag);
}

/* The place at t on a line: its offset says the other coordinate exactly, because both ends of every edge are on the
 * grid, and t is such an end. */
static void place_on(const struct lying *line, int64_t t, int64_t *x, int64_t *y)
{
    *x = line->dx != 0 ? t : -line->offset / line->dy;
    *y = line->dx != 0 ? (line->offset + line->dy * t) / line->dx : t;
}

/* What is left of one line between two neighbouring ends; `open` is the edge before, which goes on if it can. */
static void add_rest(struct outline *rest, const struct lying *line, int64_t from, int64_t to, int net, uint32_t tag,
                     size_t *open)
{
    struct outline_edge edge = {.tag = tag};
    place_on(line, from, &edge.ax, &edge.ay);
    place_on(line, to, &edge.bx, &edge.by);
    if (net < 0) {
        edge = (struct outline_edge){.ax = edge.bx, .ay = edge.by, .bx = edge.ax, .by = edge.ay, .tag = tag};
    }
    if ((net == 1 || net == -1) && *open < rest->count) {
        struct outline_edge *before = &rest->edges[*open];
        if (net > 0 && before->tag == tag && before->bx == edge.ax && before->by == edge.ay) {
            before->bx = edge.bx;
            before->by = edge.by;
            return;
        }
        if (net < 0 && before->tag == tag && before->ax == edge.bx && before->ay == edge.by) {
            before->ax = edge.ax;
            before->ay = edge.ay;
            return;
        }
    }
    for (int i = 0; i < abs(net); i++) {
        add_edge(rest, edge);
    }
    *open = abs(net) == 1 ? rest->count - 1 : rest->count;
}

/* Adds up the edges of one line, sorted by where they begin. `ends` has room for two per edge. */
static void add_up(struct outline *rest, const struct lying *edges, size_t count, int64_t *ends,
                   int (*ascending)(const void *, const void *))
{
    size_t first = 0, end_count = 0, open = (size_t)-1;
    for (size_t i = 0; i < count; i++) {
        ends[end_count++] = edges[i].from;
        ends[end_count++] = edges[i].to;
    }
    qsort(ends, end_count, sizeof *ends, ascending);
    for (size_t i = 0; i + 1 < end_count; i++) {
        int net = 0, found = 0;
        uint32_t tags[2] = {UINT32_MAX, UINT32_MAX}; /* lowest of those that go back, and of those that go on */
        if (ends[i] == ends[i + 1]) {
            continue;
        }
        while (first < count && edges[first].to <= ends[i]) {
            first++;
        }
        for (size_t k = first; k < count && edges[k].from <= ends[i]; k++) {
            if (edges[k].to > ends[i]) {
                uint32_t *tag = &tags[edges[k].sign > 0];
                *tag = edges[k].tag < *tag ? edges[k].tag : *tag;
                net += edges[k].sign;
                found = 1;
            }
        }
        if (found && net != 0) {
            add_rest(rest, &edges[0], ends[i], ends[i + 1], net, tags[net > 0], &open);
        }
    }
}

static int ascending(const void *left, const void *right)
{
    return compare(*(const int64_t *)left, *(const int64_t *)right);
}

/* Takes away what two polygons share, and joins what goes on straight. */
static void cancel(struct outline *outline)
{
    struct outline rest = {0};
    struct lying *lying = memory_new(outline->count, sizeof *lying);
    int64_t *ends = memory_new(2 * outline->count, sizeof *ends);
    for (size_t i = 0; i < outline->count; i++) {
        lying[i] = lie_down(&outline->edges[i]);
    }
    if (outline->count > 0) {
        qsort(lying, outline->count, sizeof *lying, by_line);
    }
    for (size_t i = 0, next; i < outline->count; i = next) {
        for (next = i + 1; next < outline->count && same_line(&lying[i], &lying[next]);) {
            next++;
        }
        add_up(&rest, lying + i, next - i, ends, ascending);
    }
    free(lying);
    free(ends);
    free(outline->edges);
    *outline = rest;
}

static int by_start(const void *left, const void *right)
{
    const struct outline_edge *a = left, *b = right;
    int order = compare(a->ax, b->ax);
    order = order ? order : compare(a->ay, b->ay);
    order = order ? order : compare(a->bx, b->bx);
    order = order ? order : compare(a->by, b->by);
    return order ? order : compare(a->tag, b->tag);
}

static size_t first_from(const struct outline *outline, int64_t x, int64_t y)
{
    size_t low = 0, high = outline->count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        const struct outline_edge *e = &outline->edges[middle];
        if (e->ax < x || (e->ax == x && e->ay < y)) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

/* How far to the left b turns off a, growing from -2 (back, over the right) to 2 (back, over the left). */
static double left_turn(const struct outline_edge *a, const struct outline_edge *b)
{
    double ux = (double)(a->bx - a->ax), uy = (double)(a->by - a->ay), vx = (double)(b->bx - b->ax),
           vy = (double)(b->by - b->ay);
    double scale = sqrt((ux * ux + uy * uy) * (vx * vx + vy * vy));
    double sine = (ux * vy - uy * vx) / scale, cosine = (ux * vx + uy * vy) / scale;
    return sine >= 0 ? 1 - cosine : cosine - 1;
}

/* The edge that goes on from another: where solids only touch with their corners each keeps to itself. */
static struct outline_edge *next_edge(const struct outline *outline, const struct outline_edge *edge)
{
    struct outline_edge *best = NULL;
    for (size_t i = first_from(outline, edge->bx, edge->by);
         i < outline->count && outline->edges[i].ax == edge->bx && outline->edges[i].ay == edge->by; i++) {
        struct outline_edge *other = &outline->edges[i];
        if (!other->used && (best == NULL || left_turn(edge, other) > left_turn(edge, best))) {
            best = other;
        }
    }
    return best;
}

struct walk {
    outline_fn found;
    void *user;
    struct outline_edge **way;
    struct outline_point *points;
};

static struct outline_point in_pixels(int64_t x, int64_t y)
{
    return (struct outline_point){(double)x / OUTLINE_GRID, (double)y / OUTLINE_GRID};
}

/* Edges way[begin] to way[begin + count - 1] (counted round) are one line. */
static void hand_out(const struct walk *walk, size_t length, size_t begin, size_t count, enum outline_end end)
{
    const struct outline_edge *last = walk->way[(begin + count - 1) % length];
    for (size_t i = 0; i < count; i++) {
        const struct outline_edge *e = walk->way[(begin + i) % length];
        walk->points[i] = in_pixels(e->ax, e->ay);
    }
    walk->points[count] = in_pixels(last->bx, last->by);
    walk->found(walk->user, walk->points, count + (end == OUTLINE_RING ? 0 : 1), end, last->tag);
}

/* Follows edges from one on as far as they go; where the tag changes the line ends. */
static void follow(struct outline *outline, const struct walk *walk, struct outline_edge *first)
{
    size_t length = 0, begin = 0, changes = 0;
    const int64_t x = first->ax, y = first->ay;
    int closed = 0;
    for (struct outline_edge *e = first; e != NULL && !closed; e = closed ? NULL : next_edge(outline, e)) {
        e->used = 1;
        walk->way[length++] = e;
        closed = e->bx == x && e->by == y;
    }
    for (size_t i = closed ? 0 : 1; i < length; i++) {
        if (walk->way[i]->tag != walk->way[(i + length - 1) % length]->tag) {
            begin = closed && changes == 0 ? i : begin;
            changes++;
        }
    }
    if (changes == 0) {
        hand_out(walk, length, 0, length, closed ? OUTLINE_RING : OUTLINE_OPEN);
        return;
    }
    for (size_t done = 0, count; done < length; done += count) {
        const struct outline_edge *e = walk->way[(begin + done) % length];
        for (count = 1; done + count < length && walk->way[(begin + done + count) % length]->tag == e->tag;) {
            count++;
        }
        enum outline_end end = !closed ? OUTLINE_OPEN : done + count < length ? OUTLINE_PART : OUTLINE_LAST;
        hand_out(walk, length, (begin + done) % length, count, end);
    }
}

static int has_before(const struct outline *outline, const int64_t *arrivals, const struct outline_edge *edge)
{
    const int64_t key[2] = {edge->ax, edge->ay};
    size_t low = 0, high = outline->count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        const int64_t *p = arrivals + 2 * middle;
        if (p[0] < key[0] || (p[0] == key[0] && p[1] < key[1])) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < outline->count && arrivals[2 * low] == key[0] && arrivals[2 * low + 1] == key[1];
}

static int by_place(const void *left, const void *right)
{
    const int64_t *a = left, *b = right;
    int order = compare(a[0], b[0]);
    return order ? order : compare(a[1], b[1]);
}

void outline_finish(struct outline *outline, outline_fn found, void *user)
{
    cancel(outline);
    const size_t count = outline->count;
    struct walk walk = {found, user, memory_new(count, sizeof *walk.way), memory_new(count + 1, sizeof *walk.points)};
    int64_t *arrivals = memory_new(2 * count, sizeof *arrivals);
    if (count > 0) {
        qsort(outline->edges, count, sizeof *outline->edges, by_start);
    }
    for (size_t i = 0; i < count; i++) {
        arrivals[2 * i] = outline->edges[i].bx;
        arrivals[2 * i + 1] = outline->edges[i].by;
    }
    if (count > 0) {
        qsort(arrivals, count, 2 * sizeof *arrivals, by_place);
    }
    for (int rings = 0; rings < 2; rings++) { /* lines that begin somewhere first, or they would be cut in two */
        for (size_t i = 0; i < count; i++) {
            struct outline_edge *edge = &outline->edges[i];
            if (!edge->used && (rings || !has_before(outline, arrivals, edge))) {
                follow(outline, &walk, edge);
            }
        }
    }
    free(arrivals);
    free((void *)walk.way);
    free(walk.points);
    free(outline->edges);
    *outline = (struct outline){0};
}
