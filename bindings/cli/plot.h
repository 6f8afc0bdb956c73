/* SPDX-License-Identifier: MIT
 * plot.h: a picture of a run: the level from above with the paths on it, and the heights below. */
#ifndef TAHR_CLI_PLOT_H
#define TAHR_CLI_PLOT_H

#include "level.h"
#include "track.h"

struct plot {
    const char *path; /* .svg or .png */
    const struct level *level;
    const struct track *track;
    double seconds;
    double walkable_angle; /* rad */
    const char *caption;
};

/* 0, or -1 after a message. */
int plot_write(const struct plot *plot);

#endif
