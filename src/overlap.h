/* SPDX-License-Identifier: MIT
 * overlap.h: the sensors that a character is inside of. */
#ifndef TAHR_OVERLAP_H
#define TAHR_OVERLAP_H

#include "core.h"

/* Tells which sensors were entered, left and passed through in this step. */
void tahr__find_overlaps(tahr__step *step);

#endif
