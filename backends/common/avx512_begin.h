/* SPDX-License-Identifier: MIT
 * avx512_begin.h: as avx2_begin.h, for processors with AVX-512 (tahr__has_avx512); ends with avx2_end.h. */
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#pragma clang attribute push(__attribute__((target("avx512f,avx512vl,avx512bw,avx512dq,popcnt"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx512f,avx512vl,avx512bw,avx512dq,popcnt")
#endif
