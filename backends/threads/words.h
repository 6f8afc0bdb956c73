/* SPDX-License-Identifier: MIT
 * words.h: a struct as words of 8 bytes, of which only some are passed on: a mask with one bit for each, and then those
 * whose bit is set. */
#ifndef TAHR_THREADS_WORDS_H
#define TAHR_THREADS_WORDS_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

static inline uint64_t tahr__word_of(const void *object, int i)
{
    uint64_t word;
    memcpy(&word, (const char *)object + 8 * i, sizeof word);
    return word;
}

/* mask: not 0. */
static inline int tahr__lowest_bit(uint64_t mask)
{
#ifdef __GNUC__
    return __builtin_ctzll(mask);
#else
    int i = 0;
    for (; !(mask & 1); mask >>= 1)
        i++;
    return i;
#endif
}

/* Writes the mask and the words of object that it names. Returns what comes after them. */
static inline uint64_t *tahr__words_pack(uint64_t *to, const void *object, uint64_t mask)
{
    *to++ = mask;
    for (; mask; mask &= mask - 1)
        *to++ = tahr__word_of(object, tahr__lowest_bit(mask));
    return to;
}

/* Which of 64 words are not the same in both, one bit each. one begins on a line of 64 bytes, other anywhere. */
uint64_t tahr__words_differ(const void *one, const void *other);

/* The same, where tahr__has_avx2. */
uint64_t tahr__words_differ_wide(const void *one, const void *other);

/* Writes the words that follow a mask over those of object; the others stay. Returns what comes after them. */
const uint64_t *tahr__words_unpack(const uint64_t *from, void *object);

#endif
