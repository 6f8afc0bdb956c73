/* SPDX-License-Identifier: MIT
 * bytes.h: bytes of a fuzzer as decisions and numbers. At the end everything is 0, so that shorter inputs mean less. */
#ifndef TAHR_FUZZ_BYTES_H
#define TAHR_FUZZ_BYTES_H

#include <stddef.h>
#include <stdint.h>

typedef struct bytes {
    const uint8_t *at, *end;
} bytes;

static inline uint32_t bytes_left(const bytes *b)
{
    return (uint32_t)(b->end - b->at);
}

static inline uint8_t bytes_u8(bytes *b)
{
    return b->at < b->end ? *b->at++ : (uint8_t)0;
}

/* 0..bound-1; bound at most 256. */
static inline uint32_t bytes_below(bytes *b, uint32_t bound)
{
    return bytes_u8(b) % bound;
}

/* low..high in 255 steps. */
static inline double bytes_between(bytes *b, double low, double high)
{
    return low + (high - low) * (bytes_u8(b) / 255.0);
}

#endif
