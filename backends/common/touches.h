/* SPDX-License-Identifier: MIT
 * touches.h: putting contacts into the order of the contract, each place once. */
#ifndef TAHR_COMMON_TOUCHES_H
#define TAHR_COMMON_TOUCHES_H

#include "surface.h"
#include "vec.h"

typedef struct tahr__touches {
    tahr_contact *out; /* of the caller */
    uint32_t capacity, count, lost, reserved;
} tahr__touches;

/* Fills in what the body says. */
void tahr__contact_of(const tahr__surface *surface, tahr_contact *contact);

/* Keeps a contact among the nearest, unless the same one is there already. */
void tahr__touches_keep(tahr__touches *touches, const tahr_contact *contact);

#endif
