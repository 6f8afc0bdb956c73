/* SPDX-License-Identifier: MIT
 * report.h: writing events, decisions and queries into the caller's arrays. */
#ifndef TAHR_CORE_REPORT_H
#define TAHR_CORE_REPORT_H

#include <string.h>

#include "core.h"

/* Nothing so far, in the arrays of the user (or NULL). */
static inline void tahr__report_begin(tahr_report *r, const tahr_report *user)
{
    const size_t half = sizeof *r / 2; /* compilers clear more than 96 bytes at once with a slow string instruction */
    memset(r, 0, half);
    memset((char *)r + half, 0, sizeof *r - half);
    r->struct_size = sizeof *r;
    if (user) {
        r->struct_size = user->struct_size;
        r->events = user->events;
        r->event_capacity = user->events ? user->event_capacity : 0;
        r->decisions = user->decisions;
        r->decision_capacity = user->decisions ? user->decision_capacity : 0;
        r->queries = user->queries;
        r->query_capacity = user->queries ? user->query_capacity : 0;
    }
}

/* The same in place, of a user who asks for neither decisions nor queries. In pieces that compilers clear with a few
 * stores: more than 96 bytes at once they clear with a slow string instruction. */
static inline void tahr__report_clear(tahr_report *r)
{
    char *from = (char *)&r->events_lost;
    enum { SIZE = sizeof *r - offsetof(tahr_report, events_lost), PIECE = 80 };
    _Static_assert(SIZE == 2 * PIECE, "two pieces");
    r->flags = 0;
    r->event_capacity = r->events ? r->event_capacity : 0;
    r->event_count = 0;
    memset(from, 0, PIECE);
    memset(from + PIECE, 0, PIECE);
}

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
