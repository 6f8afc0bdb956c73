/* SPDX-License-Identifier: MIT
 * plugin_entry.c: compiled once into every shared object of a backend: what tahr_plugin_load looks for. TAHR_ENTRY is
 * the backend's own function. */
#include <tahr/backend.h>

TAHR_API const tahr_backend *TAHR_ENTRY(void);
TAHR_API const tahr_backend *tahr_backend_v1(void);

const tahr_backend *tahr_backend_v1(void)
{
    return TAHR_ENTRY();
}
