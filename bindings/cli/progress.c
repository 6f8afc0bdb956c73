/* SPDX-License-Identifier: MIT
 * progress.c: tells characters that get nowhere although they could. */
#include "progress.h"

#include "vec.h"
#include "wander.h"

#define PROGRESS 0.2  /* m */
#define PATIENCE 10.0 /* s */
#define HEADINGS 5
#define DIRECTIONS 16
#define FREE_STEP 0.1 /* m */
#define FALLEN 0.01   /* m */
#define HANG 0.5      /* s */

void progress_start(struct progress *progress, const tahr_state *state, double time)
{
    *progress =
        (struct progress){.anchor = state->position, .since = time, .held = state->position, .held_since = time};
}

tahr_shape shape_now(const tahr_config *config, const tahr_state *state)
{
    tahr_shape shape = config->shape;
    shape.radius = state->radius;
    shape.half_height = state->half_height;
    return shape;
}

/* With margin 0: whether the true shape could go there. */
static int could_move(tahr_world *world, const tahr_config *config, const tahr_state *state)
{
    tahr_sweep query = {.shape = shape_now(config, state),
                        .position = state->position,
                        .up = state->up,
                        .orientation = state->orientation,
                        .mask = config->mask,
                        .ignore_body = TAHR_NO_BODY};
    for (int i = 0; i < DIRECTIONS; i++) {
        tahr_hit hit;
        uint32_t count = 0;
        query.motion = vec_scale(unit_vector((double)i / DIRECTIONS), FREE_STEP);
        if (fabs(vec_dot(query.motion, state->up)) > 1e-9) {
            continue; /* of two dimensions only left and right are directions to go */
        }
        if (tahr_world_sweep(world, &query, &hit, 1, &count) == TAHR_OK && count == 0) {
            return 1;
        }
    }
    return 0;
}

static void start_anew(struct progress *progress, const tahr_state *state, double time)
{
    progress->anchor = state->position;
    progress->since = time;
    progress->headings = 0;
}

int progress_watch(struct progress *progress, tahr_world *world, const tahr_config *config, const tahr_state *state,
                   const tahr_input *input, int heading_is_new, double time)
{
    tahr_vec3 gone = vec_sub(state->position, progress->anchor);
    if (vec_dot(gone, gone) >= PROGRESS * PROGRESS || vec_dot(input->move, input->move) == 0) {
        start_anew(progress, state, time);
        return 0;
    }
    progress->headings += heading_is_new != 0;
    if (time - progress->since < PATIENCE || progress->headings < HEADINGS) {
        return 0;
    }
    start_anew(progress, state, time);
    return could_move(world, config, state);
}

int progress_hangs(struct progress *progress, const tahr_state *state, double time)
{
    tahr_vec3 gone = vec_sub(state->position, progress->held);
    int falls = state->mode == TAHR_MODE_FALLING && !(state->flags & TAHR_STATE_CRUSHED) &&
                vec_dot(gone, gone) < FALLEN * FALLEN;
    if (falls && time - progress->held_since < HANG - 1e-9) { /* the rounding of a sum of steps */
        return 0;
    }
    progress->held = state->position;
    progress->held_since = time;
    return falls;
}
