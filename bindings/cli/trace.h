/* SPDX-License-Identifier: MIT
 * trace.h: paths and events of a run, remembered for the plot. */
#ifndef TAHR_CLI_TRACE_H
#define TAHR_CLI_TRACE_H

#include <tahr/tahr.h>

/* One place of a foot on a path. mode is a TAHR_MODE_*; 0 ends a piece of the path (the character was put elsewhere). */
struct trace_point {
    float x, y, z, time;
    uint32_t mode;
};

/* What an event of the plot is; these are found by the shell itself. DROPPED: left the ground through it. */
enum { TRACE_FELL_OUT = 1000, TRACE_TUNNEL = 1001, TRACE_STUCK = 1002, TRACE_DROPPED = 1003 };

struct trace_mark {
    float x, y, z, time;
    uint32_t type, character;
};

struct trace_path {
    struct trace_point *points;
    size_t count, capacity;
};

struct trace {
    struct trace_path *paths;
    uint32_t character_count;
    struct trace_mark *marks;
    size_t mark_count, mark_capacity;
    uint64_t stride; /* every so many steps a point is kept */
};

void trace_open(struct trace *trace, uint32_t characters, uint64_t steps);
void trace_point(struct trace *trace, uint32_t character, uint64_t step, double time, const tahr_state *state);
void trace_break(struct trace *trace, uint32_t character);
void trace_mark(struct trace *trace, uint32_t character, uint32_t type, double time, tahr_vec3 position);
void trace_close(struct trace *trace);

#endif
