/* SPDX-License-Identifier: MIT
 * lanes_avx2.c: the cull eight lanes at a time. Only called where the processor has AVX2; without FMA, so that it does
 * the operations of the scalar twin. */
#include "../common/processor.h"
#include "lanes.h"

#if defined(__GNUC__) && defined(__x86_64__)

#include "../common/avx2_begin.h"

#include "../common/lane_8.h"

#include "lanes_which.h"

#include "lanes_kernel.h"

#include "../common/avx2_end.h"

const tahr__lanes_way *tahr__lanes_of_avx2(void)
{
    static const tahr__lanes_way eight = {lanes_cull, lanes_near, lanes_measure, lanes_pick, "AVX2"};
    return tahr__has_avx2() ? &eight : NULL;
}

#else

const tahr__lanes_way *tahr__lanes_of_avx2(void)
{
    return NULL;
}

#endif
