/* SPDX-License-Identifier: MIT
 * words.h: many bits at once: what differs between two pieces of memory, for one branch in the end. */
#ifndef TAHR_WORDS_H
#define TAHR_WORDS_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* 16 bytes, which every processor with vectors has registers for. */
#ifdef __GNUC__
typedef uint64_t tahr__words __attribute__((vector_size(16)));

static inline tahr__words words_or(tahr__words a, tahr__words b)
{
    return a | b;
}

static inline tahr__words words_xor(tahr__words a, tahr__words b)
{
    return a ^ b;
}

static inline uint64_t words_any(tahr__words w)
{
    return w[0] | w[1];
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

static inline uint64_t words_any(tahr__words w)
{
    return w.low | w.high;
}
#endif

static inline tahr__words words_at(const void *from, size_t at)
{
    tahr__words w;
    memcpy(&w, (const char *)from + at, sizeof w);
    return w;
}

/* All bits that differ in so many bytes: a multiple of 16 that is known when this is compiled. */
static inline tahr__words other_words(const void *a, const void *b, size_t size)
{
    tahr__words other = {0, 0};
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC unroll 16
#endif
    for (size_t at = 0; at < size; at += sizeof other) {
        other = words_or(other, words_xor(words_at(a, at), words_at(b, at)));
    }
    return other;
}

#endif
