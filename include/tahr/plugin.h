/* SPDX-License-Identifier: MIT
 * plugin.h: backends from shared objects. Optional: a backend that is linked needs none of this. */
#ifndef TAHR_PLUGIN_H
#define TAHR_PLUGIN_H

#include <tahr/backend.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A shared object that is loaded. Those of this library are called libtahr_NAME.so; backends/template is one to
 * copy. */
typedef struct tahr_plugin tahr_plugin;

/* Loads the shared object at a path (never searched for: without a slash it is the one in the working directory), asks
 * its tahr_backend_v1 for the backend and checks it: struct_size, ABI, every slot that must be there.
 * [in] path; log may be NULL; [out] plugin, untouched on failure; unload it after every world on it is closed.
 * Returns TAHR_OK, TAHR_E_NULL (an argument, or a slot of the backend), TAHR_E_NOT_FOUND (no such file, not a shared
 * object or one that is cut off, a folder or a pipe, or none with that symbol), TAHR_E_STRUCT_SIZE, TAHR_E_ABI,
 * TAHR_E_MEMORY, TAHR_E_UNSUPPORTED (this platform loads nothing); the log says what was expected and what was there,
 * and nothing stays loaded. Allocates by malloc; may run on several threads. Runs the initialisers of the shared
 * object: load only what you trust. Since 0.1. */
TAHR_API tahr_status tahr_plugin_load(const char *path, const tahr_log *log, tahr_plugin **plugin);

/* What it brought, valid until tahr_plugin_unload. NULL for NULL. Since 0.1. */
TAHR_API const tahr_backend *tahr_plugin_backend(const tahr_plugin *plugin);

/* Unloads it; every world on it must be closed. NULL is allowed. Since 0.1. */
TAHR_API void tahr_plugin_unload(tahr_plugin *plugin);

#ifdef __cplusplus
}
#endif
#endif
