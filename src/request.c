/* SPDX-License-Identifier: MIT
 * request.c: another mode, because the input asks for it. */
#include "request.h"

#include "floor.h"
#include "glide.h"
#include "modes.h"
#include "report.h"
#include "swimming.h"
#include "walking.h"

/* Walking needs a floor no farther below than walking follows one. */
static int finds_floor(tahr__step *step)
{
    tahr_floor floor;
    tahr__find_floor(step, step->config->snap_distance, NULL, &floor);
    if (!floor_is_walkable(&floor) || step->error < 0) {
        return 0;
    }
    tahr__event(step, TAHR_EVENT_LANDED, NULL, max_of(-dot(step->state.velocity, step->state.up), 0));
    step->state.velocity = step_level(step, step->state.velocity);
    tahr__keep_floor(step, &floor);
    step->state.flags |= TAHR_STATE_FLOOR_MOVED; /* standing looks again, and settles */
    return 1;
}

static int is_granted(tahr__step *step, uint32_t mode)
{
    switch (mode) {
    case TAHR_MODE_WALKING: return finds_floor(step);
    case TAHR_MODE_SWIMMING: return tahr__fluid(step, step->state.position).immersion >= tahr__swim_line(step->config);
    case TAHR_MODE_HANGING: return 0; /* on what? */
    case TAHR_MODE_CUSTOM: return step->custom->run != NULL;
    default: return 1;
    }
}

/* Frozen is no other place: what it stood on it stands on still. */
static void leave_ground(tahr__step *step)
{
    if (step->state.mode == TAHR_MODE_WALKING) {
        tahr__leave_floor(step);
        tahr__event(step, TAHR_EVENT_LEFT_GROUND, NULL, TAHR_LEFT_MODE);
    }
    tahr__glide_forget_floor(step);
}

void tahr__ask_mode(tahr__step *step)
{
    uint32_t mode = step->input->mode;
    if (!(step->input->flags & TAHR_INPUT_MODE) || mode == step->state.mode) {
        return;
    }
    if (!is_granted(step, mode)) {
        step->report.flags |= TAHR_REPORT_MODE_REFUSED;
        return;
    }
    if (mode != TAHR_MODE_NONE && mode != TAHR_MODE_WALKING) {
        leave_ground(step);
    }
    step->state.flags &= ~(uint32_t)TAHR_STATE_JUMPING;
    step->state.jump_hold = 0;
    tahr__grant_mode(step, mode);
}
