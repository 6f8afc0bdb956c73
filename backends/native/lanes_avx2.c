/* SPDX-License-Identifier: MIT
 * lanes_avx2.c: the cull eight lanes at a time. Only called where the processor has AVX2; without FMA, so that it does
 * the operations of the scalar twin. */
#include "lanes.h"

#if defined(__GNUC__) && defined(__x86_64__)

#include "../common/avx2_begin.h"

#include "../common/lane_8.h"

#include "lanes_which.h"

#include "lanes_kernel.h"

uint32_t tahr__lanes_cull_8(const tahr__lanes *lanes, const tahr__lanes_query *query, tahr__lanes_found *found)
{
    return lanes_cull(lanes, query, found);
}

uint32_t tahr__lanes_near_8(const tahr__lanes *lanes, const tahr__lanes_query *query, tahr__lanes_found *found)
{
    return lanes_near(lanes, query, found);
}

void tahr__lanes_measure_8(const tahr__lanes *lanes, const tahr__lanes_query *query, float *far)
{
    lanes_measure(lanes, query, far);
}

uint32_t tahr__lanes_pick_8(const float *far, const float *lift, uint32_t count, float most, tahr__lanes_found *found)
{
    return lanes_pick(far, lift, count, most, found);
}

#include "../common/avx2_end.h"

#else

uint32_t tahr__lanes_cull_8(const tahr__lanes *lanes, const tahr__lanes_query *query, tahr__lanes_found *found)
{
    return tahr__lanes_cull_4(lanes, query, found);
}

uint32_t tahr__lanes_near_8(const tahr__lanes *lanes, const tahr__lanes_query *query, tahr__lanes_found *found)
{
    return tahr__lanes_near_4(lanes, query, found);
}

void tahr__lanes_measure_8(const tahr__lanes *lanes, const tahr__lanes_query *query, float *far)
{
    tahr__lanes_measure_4(lanes, query, far);
}

uint32_t tahr__lanes_pick_8(const float *far, const float *lift, uint32_t count, float most, tahr__lanes_found *found)
{
    return tahr__lanes_pick_4(far, lift, count, most, found);
}

#endif
