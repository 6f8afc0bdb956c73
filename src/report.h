/* SPDX-License-Identifier: MIT
 * report.h: writing events, decisions and queries into the caller's arrays. */
#ifndef TAHR_CORE_REPORT_H
#define TAHR_CORE_REPORT_H

#include "core.h"

/* Appends an event at step->time + step->ahead; hit may be NULL. */
void tahr__event(tahr__step *step, uint32_t type, const tahr_hit *hit, double value);

/* Puts an event where its time belongs: behind those of the same time. What no longer fits then is the last one. */
void tahr__event_at(tahr__step *step, const tahr_event *event);

/* Appends a query as it was asked and answered; only if step->report.queries is there. */
void tahr__record(tahr__step *step, const tahr_query_record *record);

/* Appends a decision to the trace; hit may be NULL. Returns accepted. */
int tahr__trace(tahr__step *step, uint32_t rule, int accepted, const tahr_hit *hit, double value, double limit,
                const char *reason);

/* The same if the caller asked for a trace; seldom does anybody. */
static inline int tahr__decide(tahr__step *step, uint32_t rule, int accepted, const tahr_hit *hit, double value,
                               double limit, const char *reason)
{
    return step->report.decisions ? tahr__trace(step, rule, accepted, hit, value, limit, reason) : accepted;
}

#endif
