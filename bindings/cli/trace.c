/* SPDX-License-Identifier: MIT
 * trace.c: paths and events of a run, remembered for the plot. */
#include "trace.h"

#include "say.h"
#include "vec.h"

#include <stdlib.h>

/* More would not be seen in a picture: 80 MB of points and 24 MB of marks. */
#define MAX_POINTS 4000000u
#define MAX_MARKS 1000000u

void trace_open(struct trace *trace, uint32_t characters, uint64_t steps)
{
    *trace = (struct trace){.character_count = characters, .stride = 1 + characters * steps / MAX_POINTS};
    trace->paths = memory_new(characters, sizeof *trace->paths);
}

static void add_point(struct trace_path *path, struct trace_point point)
{
    path->points = memory_grow(path->points, &path->capacity, path->count + 1, sizeof *path->points);
    path->points[path->count++] = point;
}

void trace_point(struct trace *trace, uint32_t character, uint64_t step, double time, const tahr_state *state)
{
    if (step % trace->stride == 0) {
        tahr_vec3 foot = vec_sub(state->position, vec_scale(state->up, state->half_height));
        add_point(&trace->paths[character],
                  (struct trace_point){(float)foot.x, (float)foot.y, (float)foot.z, (float)time, state->mode});
    }
}

void trace_break(struct trace *trace, uint32_t character)
{
    struct trace_path *path = &trace->paths[character];
    if (path->count > 0) {
        path->points[path->count - 1].mode = TAHR_MODE_NONE;
    }
}

void trace_mark(struct trace *trace, uint32_t character, uint32_t type, double time, tahr_vec3 p)
{
    if (trace->mark_count < MAX_MARKS) {
        trace->marks = memory_grow(trace->marks, &trace->mark_capacity, trace->mark_count + 1, sizeof *trace->marks);
        trace->marks[trace->mark_count++] =
            (struct trace_mark){(float)p.x, (float)p.y, (float)p.z, (float)time, type, character};
    }
}

void trace_close(struct trace *trace)
{
    for (uint32_t i = 0; i < trace->character_count; i++) {
        free(trace->paths[i].points);
    }
    free(trace->paths);
    free(trace->marks);
    *trace = (struct trace){0};
}
