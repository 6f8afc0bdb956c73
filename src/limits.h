/* SPDX-License-Identifier: MIT
 * limits.h: what follows from a config, a shape and a gravity. */
#ifndef TAHR_LIMITS_H
#define TAHR_LIMITS_H

#include "core.h"

/* Gravity and its direction. */
tahr__pull tahr__pull_of(vec3 gravity);

/* Everything that rules measure against, for a character of this shape on a backend with these TAHR_CAP_*. */
tahr__limits tahr__limits_of(const tahr_config *c, const tahr_shape *s, uint32_t capabilities);

#endif
