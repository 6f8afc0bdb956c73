/* SPDX-License-Identifier: MIT
 * modes.c: the state machine: one table of modes, one of the ways from one to another. A mode returns the time that it
 * left over and the mode that should go on; only here does the mode change. The README's state diagram is printed from
 * the second table (tests/state_diagram.sh reads these lines). */
#include "modes.h"

#include "custom.h"
#include "falling.h"
#include "flying.h"
#include "hanging.h"
#include "jump.h"
#include "overlap.h"
#include "report.h"
#include "swimming.h"
#include "walking.h"

static tahr__next rest(tahr__step *step, double time)
{
    tahr__next next = {step->state.mode, 0};
    step->time += time;
    return next;
}

static tahr__next walk(tahr__step *step, double time)
{
    return step_has_fluids(step) ? tahr__wade(step, time) : tahr__walk(step, time);
}

const tahr__mode tahr__modes[TAHR_MODE_CUSTOM + 1] = {
    {"none", rest},        {"walking", walk},       {"falling", tahr__fall},      {"swimming", tahr__swim},
    {"flying", tahr__fly}, {"hanging", tahr__hang}, {"custom", tahr__run_custom},
};

static const struct transition {
    uint32_t from, to;
    const char *why;
} transitions[] = {
    {TAHR_MODE_WALKING, TAHR_MODE_FALLING, "the floor ended, a jump, a launch"},
    {TAHR_MODE_WALKING, TAHR_MODE_SWIMMING, "deep enough to swim"},
    {TAHR_MODE_FALLING, TAHR_MODE_WALKING, "landed on a floor that holds"},
    {TAHR_MODE_FALLING, TAHR_MODE_SWIMMING, "deep enough to swim"},
    {TAHR_MODE_FALLING, TAHR_MODE_HANGING, "an edge within reach"},
    {TAHR_MODE_SWIMMING, TAHR_MODE_FALLING, "out of the water, a jump at the surface"},
    {TAHR_MODE_SWIMMING, TAHR_MODE_WALKING, "a floor in the shallows"},
    {TAHR_MODE_HANGING, TAHR_MODE_FALLING, "let go, a jump"},
    {TAHR_MODE_HANGING, TAHR_MODE_WALKING, "pulled up"},
    {TAHR_MODE_CUSTOM, TAHR_MODE_NONE, "your function"},
    {TAHR_MODE_CUSTOM, TAHR_MODE_WALKING, "your function"},
    {TAHR_MODE_CUSTOM, TAHR_MODE_FALLING, "your function"},
    {TAHR_MODE_CUSTOM, TAHR_MODE_SWIMMING, "your function"},
    {TAHR_MODE_CUSTOM, TAHR_MODE_FLYING, "your function"},
};

const char *tahr_mode_name(uint32_t mode)
{
    return tahr__is_mode(mode) ? tahr__modes[mode].name : "?";
}

const char *tahr__transition(uint32_t from, uint32_t to)
{
    for (size_t i = 0; i < sizeof transitions / sizeof transitions[0]; i++) {
        if (transitions[i].from == from && transitions[i].to == to) {
            return transitions[i].why;
        }
    }
    return NULL;
}

void tahr__grant_mode(tahr__step *step, uint32_t mode)
{
    if (step->state.mode == TAHR_MODE_FALLING) {
        tahr__flight_ended(step, mode);
    }
    step->state.mode = mode;
    tahr__event(step, TAHR_EVENT_MODE, NULL, mode);
}

void tahr__change_mode(tahr__step *step, uint32_t mode)
{
    if (step->state.mode == mode) {
        return;
    }
    if (!tahr__transition(step->state.mode, mode)) {
        step->report.flags |= TAHR_REPORT_MODE_REFUSED;
        return;
    }
    tahr__grant_mode(step, mode);
}

void tahr__end_mode(tahr__step *step, uint32_t ran, uint32_t next)
{
    if (ran == TAHR_MODE_WALKING && next == TAHR_MODE_FALLING) {
        tahr__floor_ended(step);
    }
    tahr__change_mode(step, next);
}
