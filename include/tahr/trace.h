/* SPDX-License-Identifier: MIT
 * trace.h: the backend that records every query of another one, and answers from the record without it. Not part of
 * libtahr: link libtahr_trace. */
#ifndef TAHR_TRACE_H
#define TAHR_TRACE_H

#include <tahr/backend.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The trace backend. Static memory. Since 0.1. */
TAHR_API const tahr_backend *tahr_backend_v1_trace(void);

#ifdef __cplusplus
}
#endif
#endif
