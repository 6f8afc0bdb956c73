/* SPDX-License-Identifier: MIT
 * avx2_begin.h: what follows, up to avx2_end.h, is compiled for AVX2 and without FMA, so that it does the operations of
 * what is compiled for any processor; to be run only where the processor has it. Compilers make no vectors of 32 bytes
 * by themselves. For files that have asked whether this is GNU C on x86-64. No include guard: each file begins once. */
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2,prefer-vector-width=128")
#endif
