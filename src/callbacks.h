/* SPDX-License-Identifier: MIT
 * callbacks.h: a user's functions as a backend. */
#ifndef TAHR_CALLBACKS_H
#define TAHR_CALLBACKS_H

#include <tahr/backend.h>

/* The vtable whose `self` is a tahr_callbacks. */
extern const tahr_backend tahr__callbacks_backend;

#endif
