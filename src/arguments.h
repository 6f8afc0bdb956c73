/* SPDX-License-Identifier: MIT
 * arguments.h: the checks of what a step is given. */
#ifndef TAHR_ARGUMENTS_H
#define TAHR_ARGUMENTS_H

#include "core.h"

/* TAHR_OK, or the first thing that is wrong, which the log has been told. report may be NULL. */
tahr_status tahr__check_arguments(const tahr_mover *mover, const tahr_input *input, double dt, const tahr_state *state,
                                  const tahr_report *report);

#endif
