/* SPDX-License-Identifier: MIT
 * fit.h: whether a character fits the world that it is to move in. */
#ifndef TAHR_FIT_H
#define TAHR_FIT_H

#include "core.h"

/* Says which field of a checked config the world has no room for: a shape that its backend does not sweep, a motion out
 * of a world of two dimensions, a hull that its scene does not hold. TAHR_OK: none. */
tahr_status tahr__fit_check(const tahr_world *world, const tahr_config *config, const char *function);

#endif
