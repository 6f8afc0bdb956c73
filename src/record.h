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
    void *self;                  /* and its scene, */
    uint32_t derived;            /* and how its contacts were made */
    uint32_t movers;             /* numbered so far */
    uint32_t busy;               /* 1: inside a step */
};

/* The step of a mover in a watched world: tells of it, takes it and tells how it ended. Arguments not NULL. */
tahr_status tahr__record_step(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                              tahr_report *report);

/* After a change of a watched world. */
void tahr__record_move(const tahr_world *world, uint32_t kind, const tahr_body_pose *poses, uint32_t count, double dt);

/* Ends a recording; nothing without one. */
void tahr__record_end(tahr_world *world);

#endif
