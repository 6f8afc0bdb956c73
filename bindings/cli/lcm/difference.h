/* SPDX-License-Identifier: MIT
 * difference.h: in which fields a state or an event differs from a recorded one. */
#ifndef TAHR_CLI_LCM_DIFFERENCE_H
#define TAHR_CLI_LCM_DIFFERENCE_H

#include <tahr/report.h>
#include <tahr/state.h>
#include <tahr_lcm/tahr_event_t.h>
#include <tahr_lcm/tahr_state_t.h>

/* "position.x is 1.5, recorded 1.25; ..." of the first fields that differ; "" where none does. Returns their number. */
int difference_of_states(const tahr_state *state, const tahr_state *recorded, char *text, size_t size);

/* The same, for what a message of a state holds. */
int difference_of_message(const tahr_state *state, const tahr_state_t *recorded, char *text, size_t size);

int difference_of_event(const tahr_event *event, const tahr_event_t *recorded, char *text, size_t size);

#endif
