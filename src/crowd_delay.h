/* SPDX-License-Identifier: MIT
 * crowd_delay.h: characters that take one step for several ticks, and are shown on its way in between. */
#ifndef TAHR_CROWD_DELAY_H
#define TAHR_CROWD_DELAY_H

#include "crowd.h"

/* One character's part of a tick. */
typedef struct tahr__turn {
    tahr_mover *mover;
    const tahr_input *input;
    double dt;
    tahr_state *state;
    tahr_report *report; /* or NULL */
    tahr__company *company;
    tahr_crowd_counts *counts;
} tahr__turn;

/* Writes a report of nothing but flags. NULL is allowed. */
void tahr__turn_report(tahr_report *report, uint32_t flags);

/* Like tahr_mover_step among others: also TAHR__STRAYED. */
tahr_status tahr__turn_step(const tahr__turn *turn);

/* The same for a member with a budget. */
tahr_status tahr__turn_delayed(const tahr__turn *turn, const tahr_member *member, tahr_delay *delay);

#endif
