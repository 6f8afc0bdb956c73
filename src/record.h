/* SPDX-License-Identifier: MIT
 * record.h: telling a recorder what happens to a world that it watches. */
#ifndef TAHR__RECORD_H
#define TAHR__RECORD_H

#include <tahr/record.h>

#include "core.h"

/* In a world that is watched. */
struct tahr__recording {
    tahr_recorder recorder;
    const tahr_backend *backend; /* that the world had before, */
    void *self;                  /* and its scene */
    uint32_t movers;             /* numbered so far */
    uint32_t busy;               /* 1: inside a step */
};

/* Around every step of a watched world with valid arguments: tahr__record_done gets its status and hands it back. */
void tahr__record_step(tahr_mover *mover, const tahr_input *input, double dt, const tahr_state *state,
                       const tahr_report *report);
tahr_status tahr__record_done(const tahr_mover *mover, tahr_status status, const tahr_state *state);

/* After a change of a watched world. */
void tahr__record_move(const tahr_world *world, uint32_t kind, const tahr_body_pose *poses, uint32_t count, double dt);

/* Ends a recording; nothing without one. */
void tahr__record_end(tahr_world *world);

#endif
