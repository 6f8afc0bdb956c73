/* SPDX-License-Identifier: MIT
 * processor.h: what this processor has beyond what every one of its kind has. */
#ifndef TAHR_COMMON_PROCESSOR_H
#define TAHR_COMMON_PROCESSOR_H

static inline int tahr__has_avx2(void)
{
#if defined(__GNUC__) && defined(__x86_64__)
    return __builtin_cpu_supports("avx2") != 0;
#else
    return 0;
#endif
}

/* Not the first that had it: those lower their clock for all else when they meet 64-byte vectors. Those with VBMI2 (Ice
 * Lake, Zen 4 and later) do not, and have the other parts too. */
static inline int tahr__has_avx512(void)
{
#if defined(__GNUC__) && defined(__x86_64__)
    return __builtin_cpu_supports("avx512vbmi2") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq");
#else
    return 0;
#endif
}

#endif
