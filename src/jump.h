/* SPDX-License-Identifier: MIT
 * jump.h: when a jump starts. */
#ifndef TAHR_JUMP_H
#define TAHR_JUMP_H

#include "core.h"

/* Looks at the button at the begin of a step. No query. */
void tahr__begin_jump(tahr__step *step);

#endif
