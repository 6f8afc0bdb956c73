/* SPDX-License-Identifier: MIT
 * callbacks.h: a user's functions as a backend. */
#ifndef TAHR_CALLBACKS_H
#define TAHR_CALLBACKS_H

#include <tahr/backend.h>

/* The vtables whose `self` is a tahr_callbacks: of users who honour the margin, and of those who do not
 * (TAHR_CALLBACKS_NO_MARGIN). */
extern const tahr_backend tahr__callbacks_backend, tahr__callbacks_without_margin;

/* The user's sweep, with what the user leaves out filled in. */
tahr_status tahr__sweep_solids(const tahr_callbacks *user, tahr_query_context *context, const tahr_sweep *query,
                               tahr_hit *hits, uint32_t *count);

/* derived.c: contacts from sweeps alone; at most so many of them for one answer, without TAHR_CALLBACKS_PROBE and with
 * it. */
enum { TAHR__MOST_OVERLAPS = 4, TAHR__MOST_PROBES = 46 };
tahr_status tahr__derive_contacts(const tahr_callbacks *user, tahr_query_context *context,
                                  const tahr_contact_query *query, tahr_contact *out, uint32_t capacity,
                                  uint32_t *count);

static inline int is_callbacks(const tahr_backend *backend)
{
    return backend == &tahr__callbacks_backend || backend == &tahr__callbacks_without_margin;
}

#endif
