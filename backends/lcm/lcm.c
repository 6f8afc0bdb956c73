/* SPDX-License-Identifier: MIT
 * lcm.c: a sink on LCM is described, opened and closed. */
#include "publish.h"

#include <stdalign.h>
#include <stdio.h>
#include <string.h>

#include "../common/malloc.h"

tahr_status tahr_lcm_desc_init(tahr_lcm_desc *desc, size_t size)
{
    if (!desc) return TAHR_E_NULL;
    if (size < sizeof *desc || size > UINT32_MAX) return TAHR_E_STRUCT_SIZE;
    memset(desc, 0, size);
    desc->struct_size = (uint32_t)size;
    return TAHR_OK;
}

/* Bytes of states and settings are sent as they are in memory. */
static int is_little(void)
{
    const uint32_t one = 1;
    unsigned char first;
    memcpy(&first, &one, 1);
    return first == 1;
}

/* A newer version may have so many bytes more; beyond is a size that was never set, and reading it a crash. */
enum { MOST_UNKNOWN = 4096 };

/* The size and what lies beyond the known fields, before any of them is read. */
static tahr_status check_size(const tahr_lcm_desc *desc)
{
    uint32_t size;
    memcpy(&size, desc, sizeof size);
    if (size < sizeof *desc || size > sizeof *desc + MOST_UNKNOWN) return TAHR_E_STRUCT_SIZE;
    for (uint32_t i = sizeof *desc; i < size; i++) {
        if (((const unsigned char *)desc)[i])
            return tahr__lcm_complain(desc->log, TAHR_E_UNSUPPORTED,
                                      "tahr_lcm_open: desc has fields of a newer version that are not 0");
    }
    return TAHR_OK;
}

/* Subscribers give patterns, and other tools one name a line: printable letters without a space. */
static int is_channel_name(const char *prefix)
{
    size_t length = 0;
    for (; prefix[length]; length++) {
        if (prefix[length] <= ' ' || prefix[length] > '~' || length >= TAHR__LCM_MOST_PREFIX) return 0;
    }
    return 1;
}

static tahr_status check(const tahr_lcm_desc *desc)
{
    enum { MOST_BURST = 65536 };
    tahr_status status = check_size(desc);

    if (status < 0) return status;
    if (!is_little())
        return tahr__lcm_complain(desc->log, TAHR_E_UNSUPPORTED,
                                  "tahr_lcm_open: on this machine numbers have their highest byte first");
    if (desc->flags & ~(uint32_t)TAHR_LCM_ID_SUFFIX)
        return tahr__lcm_complain(desc->log, TAHR_E_UNSUPPORTED, "tahr_lcm_open: desc.flags 0x%x has unknown ones",
                                  (unsigned)desc->flags);
    if (desc->burst > MOST_BURST)
        return tahr__lcm_complain(desc->log, TAHR_E_ARGUMENT, "tahr_lcm_open: desc.burst %u is not within 1 to %d",
                                  (unsigned)desc->burst, MOST_BURST);
    if (desc->rate && desc->burst > desc->rate)
        return tahr__lcm_complain(desc->log, TAHR_E_ARGUMENT,
                                  "tahr_lcm_open: desc.burst %u is more than desc.rate %u, what goes out in a second",
                                  (unsigned)desc->burst, (unsigned)desc->rate);
    if (desc->prefix && !is_channel_name(desc->prefix))
        return tahr__lcm_complain(desc->log, TAHR_E_ARGUMENT,
                                  "tahr_lcm_open: desc.prefix is not of up to %d printable letters without spaces",
                                  TAHR__LCM_MOST_PREFIX);
    return TAHR_OK;
}

static void name_channels(tahr_lcm *lcm, const char *prefix)
{
    static const char *const names[TAHR_MESSAGE_COUNT] = {
        [TAHR_MESSAGE_STATE] = "STATE",   [TAHR_MESSAGE_EVENT] = "EVENT",       [TAHR_MESSAGE_INPUT] = "INPUT",
        [TAHR_MESSAGE_REPORT] = "REPORT", [TAHR_MESSAGE_SNAPSHOT] = "SNAPSHOT", [TAHR_MESSAGE_BODY] = "BODY",
        [TAHR_MESSAGE_WORLD] = "WORLD",
    };
    for (uint32_t i = 0; i < TAHR_MESSAGE_COUNT; i++)
        snprintf(lcm->names[i], sizeof lcm->names[i], "%sTAHR_%s", prefix ? prefix : "", names[i]);
}

tahr_status tahr_lcm_open(const tahr_lcm_desc *desc, tahr_lcm **lcm)
{
    tahr_status status = desc && lcm ? check(desc) : TAHR_E_NULL;

    if (status < 0) return status;
    const tahr_allocator a = tahr__allocator_or_malloc(desc->allocator);
    tahr_lcm *l = a.alloc(a.user, sizeof *l, alignof(tahr_lcm));
    if (!l) return tahr__lcm_complain(desc->log, TAHR_E_MEMORY, "tahr_lcm_open: no memory for %zu bytes", sizeof *l);
    memset(l, 0, sizeof *l);
    l->allocator = a;
    l->flags = desc->flags;
    name_channels(l, desc->prefix);
    tahr__lcm_publish_with(l);
    status = tahr__lcm_connect(&l->connection, desc);
    if (status < 0) {
        a.free(a.user, l, sizeof *l, alignof(tahr_lcm));
        return status;
    }
    *lcm = l;
    return TAHR_OK;
}

const tahr_sink *tahr_lcm_sink(tahr_lcm *lcm)
{
    return lcm ? &lcm->sink : NULL;
}

void tahr_lcm_close(tahr_lcm *lcm)
{
    if (!lcm) return;
    tahr__lcm_disconnect(&lcm->connection);
    const tahr_allocator a = lcm->allocator;
    if (lcm->world) a.free(a.user, lcm->world, lcm->world_room, 8);
    a.free(a.user, lcm, sizeof *lcm, alignof(tahr_lcm));
}
