/* SPDX-License-Identifier: MIT
 * backends.h: the collision engines that this shell was built with, by name. */
#ifndef TAHR_CLI_BACKENDS_H
#define TAHR_CLI_BACKENDS_H

#include <tahr/backend.h>

struct backend_choice {
    const char *name;
    const char *about;
    tahr_backend_fn get;
    const void *options;        /* for tahr_world_desc.options, or NULL */
    double penetration_allowed; /* m, before a check fails */
};

/* The index-th choice, or NULL after the last. The first is the default. */
const struct backend_choice *backend_choice_at(size_t index);

/* The choice of that name, or NULL. */
const struct backend_choice *backend_choice_find(const char *name);

/* Names of the capabilities of a backend: calls visit for each that is set. */
void backend_capabilities(const tahr_backend *backend, void (*visit)(void *user, const char *name), void *user);

#endif
