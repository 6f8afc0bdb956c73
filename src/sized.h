/* SPDX-License-Identifier: MIT
 * sized.h: the rule for structs that begin with struct_size: too small for version 0.1 is an error; a longer one comes
 * from a newer header and is accepted if everything this library does not know is zero. */
#ifndef TAHR_SIZED_H
#define TAHR_SIZED_H

#include <string.h>
#include <tahr/abi.h>

/* Bytes by which a newer header's struct may be longer. More is garbage, and is not read. */
#define TAHR__MOST_UNKNOWN 4096u

static inline tahr_status tahr__sized_check(const void *object, size_t known)
{
    uint32_t size;
    if (!object) {
        return TAHR_E_NULL;
    }
    memcpy(&size, object, sizeof size);
    if (size < known || size > known + TAHR__MOST_UNKNOWN) {
        return TAHR_E_STRUCT_SIZE;
    }
    for (size_t i = known; i < size; i++) {
        if (((const unsigned char *)object)[i] != 0) {
            return TAHR_E_UNSUPPORTED;
        }
    }
    return TAHR_OK;
}

#endif
