/* SPDX-License-Identifier: MIT
 * pace.c: bursts by the clock, and a look at the listeners between them. */
#include "pace.h"

#include <time.h>

enum { MILLISECOND = 1000000, SECOND = 1000 * MILLISECOND, PATIENCE = 100 * MILLISECOND }; /* ns */

void tahr__lcm_pace_open(tahr__lcm_pace *p, uint32_t burst, uint32_t rate)
{
    *p = (tahr__lcm_pace){.rate = rate ? rate : TAHR__LCM_RATE, .patience_ns = PATIENCE, .listeners = {.table = -1}};
    p->burst = burst ? burst : TAHR__LCM_BURST;
    if (p->burst > p->rate) p->burst = p->rate;
}

static int64_t now_ns(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (int64_t)t.tv_sec * SECOND + t.tv_nsec;
}

static void sleep_ns(int64_t ns)
{
    const struct timespec t = {.tv_sec = (time_t)(ns / SECOND), .tv_nsec = (long)(ns % SECOND)};
    if (ns > 0) nanosleep(&t, NULL);
}

/* A listener on this machine that the system has not let run for a while gets the time to read what waits for him. Who
 * is always too slow does not hold up the others: patience grows by an eighth of the time that messages take. */
static void wait_for_listeners(tahr__lcm_pace *p)
{
    p->patience_ns += (int64_t)p->unwatched * SECOND / p->rate / 8;
    if (p->patience_ns > PATIENCE) p->patience_ns = PATIENCE;
    p->unwatched = 0;
    while (p->patience_ns >= MILLISECOND && tahr__lcm_listeners_lag(&p->listeners)) {
        sleep_ns(MILLISECOND);
        p->patience_ns -= MILLISECOND;
    }
}

/* Lets a burst through, and the next one when its time has come. A long message counts once for each kilobyte, as it
 * does in the buffer of a socket. A burst that follows another is due when that was over, so that what the system slept
 * too long is made good; but not much more, or a listener would get at once what was held up for him. */
void tahr__lcm_pace_keep(tahr__lcm_pace *p, uint32_t size)
{
    enum { SLACK = MILLISECOND / 2, WATCHED = 64 /* messages; a look every millisecond at the usual rate */ };
    const uint32_t cost = 1 + size / 1024;

    if (p->sent == 0) {
        const int64_t now = now_ns();
        p->begun_ns = now >= p->due_ns && now < p->due_ns + SLACK ? p->due_ns : now;
    }
    p->sent += cost;
    p->unwatched += cost;
    if (p->sent < p->burst) return;
    p->due_ns = p->begun_ns + (int64_t)p->sent * SECOND / p->rate;
    p->sent = 0;
    sleep_ns(p->due_ns - now_ns());
    if (p->unwatched >= WATCHED) wait_for_listeners(p);
}
