/* SPDX-License-Identifier: MIT
 * bodies.h: the bodies of a recorded world, placed again as the recording tells. */
#ifndef TAHR_CLI_LCM_BODIES_H
#define TAHR_CLI_LCM_BODIES_H

#include <tahr/tahr.h>
#include <tahr_lcm/tahr_body_t.h>

struct bodies {
    tahr_world *world; /* of the caller */
    int64_t epoch;     /* changes so far */
    const char *lost;  /* NULL: all is where it was; else why that is not known, static text */
    /* The change under way: one message for each body. */
    int64_t of_epoch, revision;
    int32_t kind, count, got;
    double dt;
    tahr_body_pose *now, *before;
    uint8_t *has;
    size_t now_capacity, before_capacity, has_capacity;
};

/* A world that was just opened. */
void bodies_open(struct bodies *bodies, tahr_world *world);
void bodies_close(struct bodies *bodies);

/* Once all messages of a change are there, the world is changed; where one is missing, or the world came to another
 * revision, bodies->lost says so until it is the recorded one again: by a snapshot, or by further changes. */
void bodies_hear(struct bodies *bodies, const tahr_body_t *body);

#endif
