/* SPDX-License-Identifier: MIT
 * opened.h: a level of the shell's as a world. */
#ifndef TAHR_FUZZ_OPENED_H
#define TAHR_FUZZ_OPENED_H

#include "../bindings/cli/level.h"

/* Checks that the bodies hold what they say, and opens them; NULL if they are refused with a status. */
tahr_world *opened(const struct level *level, const struct tahr_backend *backend, const void *options);

#endif
