/* SPDX-License-Identifier: MIT
 * asked.h: sweeps that were dear, and what they were answered. A way is gone again to look at its floor, a look proves
 * another: the same question has the same answer, bit for bit, until a body is placed or the frame changes. */
#ifndef TAHR_NATIVE_ASKED_H
#define TAHR_NATIVE_ASKED_H

#include <tahr/backend.h>

/* So many are kept; and so many measured distances make a sweep dear: to keep it costs less than one of them. */
enum { TAHR__ASKED = 4, TAHR__DEAR = 16 };

typedef struct tahr__asked_sweep {
    tahr_sweep sweep;
    tahr_hit hit;
    uint32_t count, reserved; /* count: of hits, 0 or 1 */
} tahr__asked_sweep;

/* Zero: nothing is known. Of one character. */
typedef struct tahr__asked {
    uint64_t placed; /* how often bodies had been placed */
    uint32_t count, next;
    tahr__asked_sweep sweeps[TAHR__ASKED];
} tahr__asked;

/* NULL: not known. */
const tahr__asked_sweep *tahr__asked_find(const tahr__asked *asked, uint64_t placed, const tahr_sweep *sweep);
/* Instead of the oldest. */
void tahr__asked_keep(tahr__asked *asked, uint64_t placed, const tahr_sweep *sweep, const tahr_hit *hit,
                      uint32_t count);

#endif
