/* SPDX-License-Identifier: MIT
 * options.h: reading tahr_world_desc.options, the backend's own sized description. */
#ifndef TAHR_COMMON_OPTIONS_H
#define TAHR_COMMON_OPTIONS_H

#include <tahr/backend.h>

/* Logs an error: "options.engine is neither ...". */
void tahr__log_error(const tahr_host *host, const char *text);

/* Copies size bytes of options to desc, which the caller has zeroed; NULL leaves it so. TAHR_OK, TAHR_E_STRUCT_SIZE,
 * TAHR_E_UNSUPPORTED (fields of a newer version that are not 0), with a message in the log. */
tahr_status tahr__options_read(const tahr_host *host, const void *options, void *desc, uint32_t size);

#endif
