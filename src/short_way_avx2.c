/* SPDX-License-Identifier: MIT
 * short_way_avx2.c: the short way on a processor with 32-byte vectors: the same operations. Without FMA, which would be
 * other bits. */
#include "answer.h"
#include "floor.h"
#include "falling.h"
#include "path.h"
#include "shape.h"
#include "short_way.h"

#if defined(__GNUC__) && defined(__x86_64__)

#include "avx2_begin.h"

#define TAHR__WIDE_WORDS
#include "short_step.h"

tahr_status tahr__quick_step_wide(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                                  tahr_report *report)
{
    return quick_step(mover, input, dt, state, report);
}

#include "avx2_end.h"

#else

tahr_status tahr__quick_step_wide(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                                  tahr_report *report)
{
    return tahr__quick_step(mover, input, dt, state, report);
}

#endif
