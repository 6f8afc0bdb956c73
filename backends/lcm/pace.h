/* SPDX-License-Identifier: MIT
 * pace.h: how fast messages go out to a network, so that they do not run over a listener's buffer. */
#ifndef TAHR_LCM_PACE_H
#define TAHR_LCM_PACE_H

#include "listeners.h"

/* What 256 characters tell at 60 Hz, states, inputs and reports, are 46 080 messages a second; 16 at once suit a
 * subscription, which holds 30 messages that were not handled yet. */
enum { TAHR__LCM_BURST = 16, TAHR__LCM_RATE = 64000 };

typedef struct tahr__lcm_pace {
    uint32_t burst;      /* at once */
    uint32_t rate;       /* per second */
    uint32_t sent;       /* of a burst that began, */
    uint32_t unwatched;  /* messages since listeners were looked at */
    int64_t begun_ns;    /* on the monotonic clock, then */
    int64_t due_ns;      /* when the next one may begin */
    int64_t patience_ns; /* for which listeners may still be waited for */
    tahr__lcm_listeners listeners;
} tahr__lcm_pace;

/* burst, rate: 0 for what suits most. Of no group, until listeners are opened. */
void tahr__lcm_pace_open(tahr__lcm_pace *pace, uint32_t burst, uint32_t rate);

/* A message of so many bytes went out: waits, if it was the last of a burst. */
void tahr__lcm_pace_keep(tahr__lcm_pace *pace, uint32_t size);

#endif
