/* SPDX-License-Identifier: MIT
 * liar.h: the native backend with one in four of its answers made a lie: what the movement must survive. */
#ifndef STABILITY_LIAR_H
#define STABILITY_LIAR_H

#include <tahr/backend.h>

/* NOT_NUMBERS: a number of the answer is NaN, infinite or out of range, or the count is. LATE: hits up to 0.1 m late,
 * or missed. FALSE: hits and contacts where nothing is. NORMALS: unit vectors that point anywhere. GARBAGE: every field
 * drawn anew. */
enum { LIE_NONE, LIE_NOT_NUMBERS, LIE_LATE, LIE_FALSE, LIE_NORMALS, LIE_GARBAGE };

/* For tahr_world_desc.options of its worlds. */
typedef struct liar_desc {
    uint32_t struct_size;
    uint32_t lie; /* LIE_* */
    uint64_t seed;
} liar_desc;

const tahr_backend *liar_backend(void);

#endif
