/* SPDX-License-Identifier: MIT
 * track.c: paths and events of a run, remembered for the plot. */
#include "track.h"

#include "say.h"
#include "vec.h"

#include <stdlib.h>

/* More would not be seen in a picture: 80 MB of points and 24 MB of marks. */
#define MAX_POINTS 4000000u
#define MAX_MARKS 1000000u

void track_open(struct track *track, uint32_t characters, uint64_t steps)
{
    *track = (struct track){.character_count = characters, .stride = 1 + characters * steps / MAX_POINTS};
    track->paths = memory_new(characters, sizeof *track->paths);
}

static void add_point(struct track_path *path, struct track_point point)
{
    path->points = memory_grow(path->points, &path->capacity, path->count + 1, sizeof *path->points);
    path->points[path->count++] = point;
}

void track_point(struct track *track, uint32_t character, uint64_t step, double time, const tahr_state *state)
{
    if (step % track->stride == 0) {
        tahr_vec3 foot = vec_sub(state->position, vec_scale(state->up, state->half_height));
        add_point(&track->paths[character],
                  (struct track_point){(float)foot.x, (float)foot.y, (float)foot.z, (float)time, state->mode});
    }
}

void track_break(struct track *track, uint32_t character)
{
    struct track_path *path = &track->paths[character];
    if (path->count > 0) {
        path->points[path->count - 1].mode = TAHR_MODE_NONE;
    }
}

void track_mark(struct track *track, uint32_t character, uint32_t type, double time, tahr_vec3 p)
{
    if (track->mark_count < MAX_MARKS) {
        track->marks = memory_grow(track->marks, &track->mark_capacity, track->mark_count + 1, sizeof *track->marks);
        track->marks[track->mark_count++] =
            (struct track_mark){(float)p.x, (float)p.y, (float)p.z, (float)time, type, character};
    }
}

void track_close(struct track *track)
{
    for (uint32_t i = 0; i < track->character_count; i++) {
        free(track->paths[i].points);
    }
    free(track->paths);
    free(track->marks);
    *track = (struct track){0};
}
