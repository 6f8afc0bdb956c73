/* SPDX-License-Identifier: MIT
 * options.c: reading tahr_world_desc.options. */
#include "options.h"

#include <string.h>

/* A newer version may add this many bytes to the options; beyond is a size that was never set, and reading it a
 * crash. */
#define MOST_UNKNOWN 4096u

void tahr__log_error(const tahr_host *host, const char *text)
{
    host->log.write(host->log.user, TAHR_LOG_ERROR, text);
}

tahr_status tahr__options_read(const tahr_host *host, const void *options, void *desc, uint32_t size)
{
    uint32_t given;

    if (!options) return TAHR_OK;
    memcpy(&given, options, sizeof given);
    if (given < size || given > size + MOST_UNKNOWN) {
        tahr__log_error(host, "options.struct_size is smaller than this description of version 0.1, or garbage");
        return TAHR_E_STRUCT_SIZE;
    }
    for (uint32_t i = size; i < given; i++) {
        if (((const unsigned char *)options)[i] == 0) continue;
        tahr__log_error(host, "options has fields of a newer version that are not 0");
        return TAHR_E_UNSUPPORTED;
    }
    memcpy(desc, options, size);
    return TAHR_OK;
}
