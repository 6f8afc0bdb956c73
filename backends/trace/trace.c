/* SPDX-License-Identifier: MIT
 * trace.c: the table of the trace backend and its life cycle. */
#include <tahr/trace.h>

const tahr_backend *tahr_backend_v1_trace(void)
{
    return NULL;
}
