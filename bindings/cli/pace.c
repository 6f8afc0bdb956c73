/* SPDX-License-Identifier: MIT
 * pace.c: what is to happen at a time happens then. */
#include "pace.h"

#include "stats.h"

#include <time.h>

#define LATE 1.0 /* s that are made up for */

void pace_sleep(double seconds)
{
    const struct timespec span = {(time_t)seconds, (long)((seconds - (double)(time_t)seconds) * 1e9)};
    nanosleep(&span, NULL);
}

int pace_wait(struct pace *pace, double time)
{
    if (!(pace->speed > 0)) {
        return 0;
    }
    const uint64_t now = clock_ns();
    const uint64_t due = (uint64_t)(time / pace->speed * 1e9);
    if (pace->began == 0) {
        pace->began = now - due;
    }
    const double left = ((double)due - (double)(now - pace->began)) * 1e-9;
    if (left < -LATE) {
        pace->began += (uint64_t)(-left * 1e9);
    } else if (left > 0) {
        pace_sleep(left);
        return 1;
    }
    return 0;
}
