/* SPDX-License-Identifier: MIT
 * callbacks.h: a user's functions as a backend. */
#ifndef TAHR_CALLBACKS_H
#define TAHR_CALLBACKS_H

#include <tahr/backend.h>

/* The vtables whose `self` is a tahr_callbacks: of users who honour the margin, and of those who do not
 * (TAHR_CALLBACKS_NO_MARGIN). */
extern const tahr_backend tahr__callbacks_backend, tahr__callbacks_without_margin;

static inline int is_callbacks(const tahr_backend *backend)
{
    return backend == &tahr__callbacks_backend || backend == &tahr__callbacks_without_margin;
}

#endif
