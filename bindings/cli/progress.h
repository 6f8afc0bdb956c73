/* SPDX-License-Identifier: MIT
 * progress.h: tells characters that get nowhere although they could. */
#ifndef TAHR_CLI_PROGRESS_H
#define TAHR_CLI_PROGRESS_H

#include <tahr/tahr.h>

/* What is remembered of one character. */
struct progress {
    tahr_vec3 anchor; /* where it was when it last had got somewhere */
    double since;     /* s */
    uint32_t headings;
    tahr_vec3 held; /* where it was when it last had fallen, or stood */
    double held_since;
};

/* The shape of a character now. */
tahr_shape shape_now(const tahr_config *config, const tahr_state *state);

void progress_start(struct progress *progress, const tahr_state *state, double time);

/* After a step that ended at time; heading_is_new if the wish changed with it. 1: stuck for good, and counted anew from
 * here: asked to move, less than 0.2 m of progress in 10 s over at least 5 headings, although a step of 0.1 m is free
 * in some of 16 directions. */
int progress_watch(struct progress *progress, tahr_world *world, const tahr_config *config, const tahr_state *state,
                   const tahr_input *input, int heading_is_new, double time);

/* After every step. 1: hangs in the air, and looked at anew from here: falling for 0.5 s without getting 1 cm away. Who
 * falls freely has fallen 0.3 m by then, even around an apex; who is crushed is held by what crushes him. */
int progress_hangs(struct progress *progress, const tahr_state *state, double time);

#endif
