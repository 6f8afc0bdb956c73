/* SPDX-License-Identifier: MIT
 * motion.h: what nearly every step of a character on its way changes of a state. It is passed on whole, without asking
 * what of it has changed: to compare, and then to copy by what came out of it, is another path through the code for
 * every character, which no processor foresees. */
#ifndef TAHR_THREADS_MOTION_H
#define TAHR_THREADS_MOTION_H

#include <stddef.h>

#include <tahr/state.h>

typedef struct tahr__motion {
    tahr_vec3 position, velocity;
    tahr_vec3 floor_point;
    double floor_distance;
    tahr_vec3 floor_position;
} tahr__motion;

static inline tahr__motion tahr__motion_of(const tahr_state *s)
{
    return (tahr__motion){s->position, s->velocity, s->floor.point, s->floor.distance, s->floor_position};
}

static inline void tahr__motion_apply(const tahr__motion *m, tahr_state *s)
{
    s->position = m->position;
    s->velocity = m->velocity;
    s->floor.point = m->floor_point;
    s->floor.distance = m->floor_distance;
    s->floor_position = m->floor_position;
}

/* A state as words of 8 bytes: where the motion's begin, and those behind them. */
enum {
    TAHR__BEHIND_VELOCITY = offsetof(tahr_state, orientation) / 8,
    TAHR__FLOOR_POINT = offsetof(tahr_state, floor.point) / 8,
    TAHR__BEHIND_DISTANCE = offsetof(tahr_state, floor.perch_distance) / 8,
    TAHR__FLOOR_POSITION = offsetof(tahr_state, floor_position) / 8,
    TAHR__BEHIND_FLOOR_POSITION = offsetof(tahr_state, floor_revision) / 8,
    TAHR__STATE_WORDS = sizeof(tahr_state) / 8
};

_Static_assert(offsetof(tahr_state, position) == 0 && offsetof(tahr_state, velocity) == sizeof(tahr_vec3) &&
                   TAHR__BEHIND_VELOCITY == 6 && TAHR__BEHIND_DISTANCE == TAHR__FLOOR_POINT + 4 &&
                   TAHR__BEHIND_FLOOR_POSITION == TAHR__FLOOR_POSITION + 3,
               "a motion is these words, and the rest is the others");

/* Of words from begin to end, a bit each. */
#define TAHR__WORDS(begin, end) (((uint64_t)1 << (end)) - ((uint64_t)1 << (begin)))
#define TAHR__MOTION_MASK                                                                            \
    (TAHR__WORDS(0, TAHR__BEHIND_VELOCITY) | TAHR__WORDS(TAHR__FLOOR_POINT, TAHR__BEHIND_DISTANCE) | \
     TAHR__WORDS(TAHR__FLOOR_POSITION, TAHR__BEHIND_FLOOR_POSITION))

#endif
