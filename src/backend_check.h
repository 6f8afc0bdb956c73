/* SPDX-License-Identifier: MIT
 * backend_check.h: can this library call that backend? */
#ifndef TAHR_BACKEND_CHECK_H
#define TAHR_BACKEND_CHECK_H

#include <tahr/backend.h>

/* Looks at size, ABI and slots of a table that is not NULL, and reads no further than the table says it is long.
 * Returns TAHR_OK, TAHR_E_ABI, TAHR_E_STRUCT_SIZE, TAHR_E_NULL; the log (may be NULL) gets "function: field is ...,
 * expected ..." with where, if not NULL, behind it. */
tahr_status tahr__backend_check(const tahr_backend *backend, const tahr_log *log, const char *function,
                                const char *where);

/* "TAHR_CAP_MESH": the lowest of some capabilities; "?" for none. */
const char *tahr__capability_name(uint32_t capabilities);

#endif
