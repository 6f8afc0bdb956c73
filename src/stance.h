/* SPDX-License-Identifier: MIT
 * stance.h: crouching and other changes of the shape. */
#ifndef TAHR_STANCE_H
#define TAHR_STANCE_H

#include "core.h"

/* Everything the step measures against, for a character of this size. */
void tahr__use_shape(tahr__step *step, double radius, double half_height);

/* Takes the shape that the input asks for, if there is room. */
void tahr__take_stance(tahr__step *step);

#endif
