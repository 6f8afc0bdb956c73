/* SPDX-License-Identifier: MIT
 * words.h: many bits at once: what differs between two pieces of memory, for one branch in the end. */
#ifndef TAHR_WORDS_H
#define TAHR_WORDS_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* 16 bytes, which every processor with vectors has registers for; 32 where the including file is for those that have
 * such. */
#ifdef __GNUC__
#ifdef TAHR__WIDE_WORDS
typedef uint64_t tahr__words __attribute__((vector_size(32)));
typedef long long tahr__words_signed __attribute__((vector_size(32)));
#else
typedef uint64_t tahr__words __attribute__((vector_size(16)));
#endif

static inline tahr__words words_or(tahr__words a, tahr__words b)
{
    return a | b;
}

static inline tahr__words words_xor(tahr__words a, tahr__words b)
{
    return a ^ b;
}

static inline int words_are_zero(tahr__words w)
{
#ifdef TAHR__WIDE_WORDS
    return __builtin_ia32_ptestz256((tahr__words_signed)w, (tahr__words_signed)w);
#else
    return (w[0] | w[1]) == 0;
#endif
}
#else
typedef struct tahr__words {
    uint64_t low, high;
} tahr__words;

static inline tahr__words words_or(tahr__words a, tahr__words b)
{
    const tahr__words w = {a.low | b.low, a.high | b.high};
    return w;
}

static inline tahr__words words_xor(tahr__words a, tahr__words b)
{
    const tahr__words w = {a.low ^ b.low, a.high ^ b.high};
    return w;
}

static inline int words_are_zero(tahr__words w)
{
    return (w.low | w.high) == 0;
}
#endif

static inline tahr__words words_at(const void *from, size_t at)
{
    tahr__words w;
    memcpy(&w, (const char *)from + at, sizeof w);
    return w;
}

/* All bits that differ in so many bytes: a number that is known when this is compiled, and not less than one of them
 * holds. The last ones may be looked at twice. */
static inline tahr__words other_words(const void *a, const void *b, size_t size)
{
    const size_t step = sizeof(tahr__words);
    tahr__words other = words_xor(words_at(a, size - step), words_at(b, size - step));
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC unroll 16
#endif
    for (size_t at = 0; at + step < size; at += step) {
        other = words_or(other, words_xor(words_at(a, at), words_at(b, at)));
    }
    return other;
}

/* The same of three numbers, behind which both have at least one more. */
static inline tahr__words other_three(const void *a, const void *b)
{
#ifdef TAHR__WIDE_WORDS
    const tahr__words three = {~(uint64_t)0, ~(uint64_t)0, ~(uint64_t)0, 0};
    return words_xor(words_at(a, 0), words_at(b, 0)) & three;
#else
    return other_words(a, b, 3 * sizeof(double));
#endif
}

#endif
