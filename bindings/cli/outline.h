/* SPDX-License-Identifier: MIT
 * outline.h: the outlines of many polygons that lie side by side: sides that two of them share are no outline. */
#ifndef TAHR_CLI_OUTLINE_H
#define TAHR_CLI_OUTLINE_H

#include <stddef.h>
#include <stdint.h>

/* Corners are whole multiples of this part of a pixel, so that sides that ought to be the same are the same. */
#define OUTLINE_GRID 256.0

struct outline_point {
    double x, y; /* pixels, y up */
};

struct outline_edge {
    int64_t ax, ay, bx, by; /* in parts of a pixel; what is solid is on the left */
    uint32_t tag;           /* edges of different tags are never joined */
    uint32_t used;
};

struct outline {
    struct outline_edge *edges;
    size_t count, capacity;
};

/* A closed polygon, counter-clockwise, or a line that stays open. */
void outline_add(struct outline *outline, const struct outline_point *points, size_t count, int closed, uint32_t tag);

/* OPEN: a line. RING: closed. PART: a line that the next one goes on from; the LAST of them ends where the first
 * began. */
enum outline_end { OUTLINE_OPEN, OUTLINE_RING, OUTLINE_PART, OUTLINE_LAST };

/* Hands out every outline with as few points as it needs, and frees the edges. The points are valid during the call. */
typedef void (*outline_fn)(void *user, const struct outline_point *points, size_t count, enum outline_end end,
                           uint32_t tag);
void outline_finish(struct outline *outline, outline_fn found, void *user);

#endif
