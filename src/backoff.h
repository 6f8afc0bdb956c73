/* SPDX-License-Identifier: MIT
 * backoff.h: what is tried only where it is of use: after it was in vain it is left alone for a while, twice as long
 * each time, up to 15 times. Of what bears on no bit. */
#ifndef TAHR_BACKOFF_H
#define TAHR_BACKOFF_H

#include <stdint.h>

typedef struct tahr__backoff {
    uint32_t rest;   /* times that it is not tried, */
    uint32_t failed; /* and how often in a row it was in vain; the first time is forgiven */
} tahr__backoff;

static inline int backoff_tries(tahr__backoff *b)
{
    const int tries = b->rest == 0;
    b->rest -= !tries;
    return tries;
}

/* Of a try. Returns whether it was of use. */
static inline int backoff_note(tahr__backoff *b, int done)
{
    const uint32_t most = 5;
    b->failed = done ? 0 : b->failed < most ? b->failed + 1 : most;
    b->rest = (1u << b->failed) / 2 - (b->failed > 0);
    return done;
}

#endif
