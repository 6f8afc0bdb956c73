/* SPDX-License-Identifier: MIT
 * crowd_rest_avx2.c: who of a crowd sleeps, on a processor with 32-byte vectors. */
#include "crowd.h"
#include "shape.h"

#if defined(__GNUC__) && defined(__x86_64__)

#include "avx2_begin.h"

#define TAHR__WIDE_WORDS
#include "crowd_rest.h"

uint32_t tahr__rests_wide(const tahr__tick *t, uint32_t begin, uint32_t end)
{
    return rests_among(t, begin, end);
}

#include "avx2_end.h"

#else

#include "crowd_rest.h"

uint32_t tahr__rests_wide(const tahr__tick *t, uint32_t begin, uint32_t end)
{
    return tahr__rests(t, begin, end);
}

#endif
