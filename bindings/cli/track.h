/* SPDX-License-Identifier: MIT
 * track.h: paths and events of a run, remembered for the plot. */
#ifndef TAHR_CLI_TRACK_H
#define TAHR_CLI_TRACK_H

#include <tahr/tahr.h>

/* One place of a foot on a path. mode is a TAHR_MODE_*; 0 ends a piece of the path (the character was put
 * elsewhere). */
struct track_point {
    float x, y, z, time;
    uint32_t mode;
};

/* What an event of the plot is; these are found by the shell itself. DROPPED: left the ground through it. */
enum { TRACK_FELL_OUT = 1000, TRACK_TUNNEL = 1001, TRACK_STUCK = 1002, TRACK_DROPPED = 1003 };

struct track_mark {
    float x, y, z, time;
    uint32_t type, character;
};

struct track_path {
    struct track_point *points;
    size_t count, capacity;
};

struct track {
    struct track_path *paths;
    uint32_t character_count;
    struct track_mark *marks;
    size_t mark_count, mark_capacity;
    uint64_t stride; /* every so many steps a point is kept */
};

void track_open(struct track *track, uint32_t characters, uint64_t steps);
void track_point(struct track *track, uint32_t character, uint64_t step, double time, const tahr_state *state);
void track_break(struct track *track, uint32_t character);
void track_mark(struct track *track, uint32_t character, uint32_t type, double time, tahr_vec3 position);
void track_close(struct track *track);

#endif
