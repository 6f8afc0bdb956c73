/* SPDX-License-Identifier: MIT
 * backends.h: the collision engines that this shell was built with, by name. */
#ifndef TAHR_CLI_BACKENDS_H
#define TAHR_CLI_BACKENDS_H

#include <tahr/plugin.h>

struct backend_choice {
    const char *name;
    const char *about;
    tahr_backend_fn get;
    const void *options;        /* for tahr_world_desc.options, or NULL */
    double penetration_allowed; /* m, before a check fails */
};

/* One that comes from a shared object. */
struct backend_plugin {
    struct backend_choice choice; /* get is NULL */
    tahr_plugin *plugin;
};

/* Is this the path of a shared object, and no name? */
int backend_is_path(const char *text);

/* Loads the backend at a path; close it after every world on it. 0, or -1 after a message. */
int backend_load(struct backend_plugin *loaded, const char *path);
void backend_unload(struct backend_plugin *loaded);

/* The table of a choice, linked or loaded. */
const tahr_backend *backend_table(const struct backend_choice *choice);

/* The index-th choice, or NULL after the last. The first is the default. */
const struct backend_choice *backend_choice_at(size_t index);

/* The choice of that name, or NULL. */
const struct backend_choice *backend_choice_find(const char *name);

/* Names of the capabilities of a backend: calls visit for each that is set. */
void backend_capabilities(const tahr_backend *backend, void (*visit)(void *user, const char *name), void *user);

#endif
