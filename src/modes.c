/* SPDX-License-Identifier: MIT
 * modes.c: the state machine: one table of modes. A mode returns the time that it left over and the mode that should go
 * on; only here and in mover.c does the mode change. */
#include "modes.h"

#include "falling.h"
#include "hanging.h"
#include "jump.h"
#include "report.h"
#include "walking.h"

static tahr__next rest(tahr__step *step, double time)
{
    tahr__next next = {TAHR_MODE_NONE, 0};
    step->time += time;
    return next;
}

typedef struct entry {
    const char *name;
    tahr__next (*run)(tahr__step *step, double time);
} entry;

/* Indexed by TAHR_MODE_*. Transitions: walking -> falling when the floor ends or a jump starts; falling -> walking
 * when a floor is landed on; falling -> hanging where an edge is grabbed, hanging -> falling when it is let go or
 * jumped off, hanging -> walking when it is climbed; none stays. */
static const entry modes[TAHR_MODE_CUSTOM + 1] = {
    {"none", rest},   {"walking", tahr__walk}, {"falling", tahr__fall}, {"swimming", rest},
    {"flying", rest}, {"hanging", tahr__hang}, {"custom", rest},
};

const char *tahr_mode_name(uint32_t mode)
{
    return tahr__is_mode(mode) ? modes[mode].name : "?";
}

void tahr__change_mode(tahr__step *step, uint32_t mode)
{
    if (step->state.mode != mode) {
        if (step->state.mode == TAHR_MODE_FALLING) {
            tahr__flight_ended(step);
        }
        step->state.mode = mode;
        tahr__event(step, TAHR_EVENT_MODE, NULL, mode);
    }
}

double tahr__run_mode(tahr__step *step, double time)
{
    step->ahead = 0;
    int walked = step->state.mode == TAHR_MODE_WALKING;
    tahr__next next = modes[step->state.mode].run(step, time);
    step->ahead = 0; /* a mode has moved step->time to where it ended */
    if (walked && next.mode == TAHR_MODE_FALLING) {
        tahr__floor_ended(step);
    }
    tahr__change_mode(step, next.mode);
    return next.time_left;
}
