/* SPDX-License-Identifier: MIT
 * pace.h: what is to happen at a time happens then, by the wall clock. */
#ifndef TAHR_CLI_PACE_H
#define TAHR_CLI_PACE_H

#include <stdint.h>

struct pace {
    uint64_t began; /* ns; 0: not yet */
    double speed;   /* seconds of the plan in one of the clock; 0: nothing waits */
};

/* Sleeps until `time` seconds of the plan are over (or a signal comes). Who is late goes on at once; more than a second
 * is not made up for: the plan begins later. 1: it slept. */
int pace_wait(struct pace *pace, double time);

/* Sleeps for so long, or until a signal comes. */
void pace_sleep(double seconds);

#endif
