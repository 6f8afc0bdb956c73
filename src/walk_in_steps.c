/* SPDX-License-Identifier: MIT
 * walk_in_steps.c: walking with stepped velocities along the path of path.c. */
#include "report.h"
#include "stepped.h"
#include "walking.h"

tahr__next tahr__walk_in_steps(tahr__step *step, double time)
{
    tahr__next next = {TAHR_MODE_WALKING, time};
    while (next.mode == TAHR_MODE_WALKING && next.time_left >= TAHR__LEAST_TIME && step->error >= 0) {
        double h = tahr__begin_iteration(step, next.time_left);
        if (h == 0) {
            return (tahr__next){TAHR_MODE_WALKING, 0};
        }
        double left = next.time_left - h;
        vec3 before = step_level(step, step->state.velocity);
        tahr__law law = tahr__walking_law(step);
        step->state.velocity = tahr__calc_velocity(step->config, &law, 0, before, h);
        if (length_squared(before) > 0 && length_squared(step->state.velocity) == 0) {
            tahr__event(step, TAHR_EVENT_STOPPED, NULL, 0);
        }
        next = tahr__walk_slice(step, h);
        next.time_left += left;
    }
    next.time_left = next.time_left < TAHR__LEAST_TIME ? 0 : next.time_left;
    return next;
}
