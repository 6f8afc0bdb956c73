/* SPDX-License-Identifier: MIT
 * relief.h: a level from straight above, as pixels. */
#ifndef TAHR_CLI_RELIEF_H
#define TAHR_CLI_RELIEF_H

#include "level.h"

/* width x height pixels of 0x00RRGGBB over bounds.min.x + i / scale and bounds.max.y - j / scale. Light: walkable up to
 * walkable_cosine, tinted by height; dark: steeper; white: nothing; lines: walls and drops. To be freed. */
struct relief {
    int width, height;
    double scale;     /* pixels per metre */
    double left, top; /* world place of the corner of pixel (0, 0), m */
    double walkable_cosine;
    uint32_t *pixels;
};

/* Fills relief->pixels; the other fields are set by the caller. */
void relief_draw(struct relief *relief, const struct level *level);

#endif
