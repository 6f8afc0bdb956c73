/* SPDX-License-Identifier: MIT
 * telemetry_check.h: what a telemetry is described by. */
#ifndef TAHR_THREADS_TELEMETRY_CHECK_H
#define TAHR_THREADS_TELEMETRY_CHECK_H

#include <tahr/telemetry.h>

/* Of a desc that is no NULL: the log names what is wrong. */
tahr_status tahr__telemetry_check(const tahr_telemetry_desc *desc);

/* Writes "tahr_telemetry_create: text" to the log of the desc, if it has one. Returns status. */
tahr_status tahr__telemetry_complain(const tahr_telemetry_desc *desc, tahr_status status, const char *text);

/* Of a desc that is valid: bytes of each ring. */
uint64_t tahr__telemetry_ring_bytes(const tahr_telemetry_desc *desc);

#endif
