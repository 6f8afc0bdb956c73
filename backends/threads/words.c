/* SPDX-License-Identifier: MIT
 * words.c: packs words by a mask, and unpacks them. */
#include "words.h"

uint64_t *tahr__words_pack(uint64_t *to, const void *object, uint64_t mask)
{
    *to++ = mask;
    for (; mask; mask &= mask - 1)
        *to++ = tahr__word_of(object, tahr__lowest_bit(mask));
    return to;
}

/* Without a branch for each word: which ones are zero changes from step to step. */
uint64_t *tahr__words_pack_used(uint64_t *to, const void *object, size_t size)
{
    uint64_t mask = 0, *next = to + 1;
    for (size_t i = 0; i < size / 8; i++) {
        const uint64_t word = tahr__word_of(object, (int)i);
        const uint64_t used = word != 0;
        *next = word;
        next += used;
        mask |= used << i;
    }
    *to = mask;
    return next;
}

const uint64_t *tahr__words_unpack(const uint64_t *from, void *object)
{
    uint64_t mask = *from++;
    for (; mask; mask &= mask - 1)
        memcpy((char *)object + 8 * tahr__lowest_bit(mask), from++, 8);
    return from;
}
