/* SPDX-License-Identifier: MIT
 * telemetry_check.c: says what is wrong with a description, and what was expected. */
#include "telemetry_check.h"

#include <stdio.h>
#include <string.h>

enum { LEAST_RING = 4096, USUAL_RING = 4 << 20, MOST_RING = 1 << 30 };

/* As for every sized struct: who comes from a newer header may be longer by this much, if all of that is zero. */
enum { MOST_UNKNOWN = 4096 };

tahr_status tahr__telemetry_complain(const tahr_telemetry_desc *desc, tahr_status status, const char *text)
{
    if (desc->log && desc->log->write) {
        char line[256];
        snprintf(line, sizeof line, "tahr_telemetry_create: %s", text);
        desc->log->write(desc->log->user, TAHR_LOG_ERROR, line);
    }
    return status;
}

static tahr_status check_tail(const void *object, size_t known)
{
    uint32_t size;
    memcpy(&size, object, sizeof size);
    if (size < known || size > known + MOST_UNKNOWN) return TAHR_E_STRUCT_SIZE;
    for (size_t i = known; i < size; i++)
        if (((const unsigned char *)object)[i] != 0) return TAHR_E_UNSUPPORTED;
    return TAHR_OK;
}

tahr_status tahr_telemetry_desc_init(tahr_telemetry_desc *desc, size_t size)
{
    if (!desc) return TAHR_E_NULL;
    if (size < sizeof *desc || size > UINT32_MAX) return TAHR_E_STRUCT_SIZE;
    memset(desc, 0, size);
    desc->struct_size = (uint32_t)size;
    return TAHR_OK;
}

uint64_t tahr__telemetry_ring_bytes(const tahr_telemetry_desc *desc)
{
    /* Four snapshots of the world find room in it, if nothing else was said. */
    const uint64_t bodies = (uint64_t)desc->bodies * 8 * sizeof(tahr_body_pose);
    uint64_t wanted = desc->ring_bytes, bytes = LEAST_RING;
    if (wanted == 0) wanted = bodies > USUAL_RING ? bodies : USUAL_RING;
    while (bytes < wanted)
        bytes *= 2;
    return bytes;
}

static tahr_status check_sink(const tahr_telemetry_desc *d)
{
    const tahr_sink *s = d->sink;
    char text[160];
    if (!s) return tahr__telemetry_complain(d, TAHR_E_NULL, "desc.sink is NULL");
    if (tahr_abi_check((uint32_t)s->abi_major << 16 | s->abi_minor) < 0) {
        snprintf(text, sizeof text,
                 "sink.abi_major and abi_minor are %u.%u, expected %d.%d: it was built for another ABI",
                 (unsigned)s->abi_major, (unsigned)s->abi_minor, TAHR_ABI_MAJOR, TAHR_ABI_MINOR);
        return tahr__telemetry_complain(d, TAHR_E_ABI, text);
    }
    const tahr_status status = check_tail(s, sizeof *s);
    if (status < 0) {
        snprintf(text, sizeof text, "sink.struct_size is %u, expected %u, or more with zeros", (unsigned)s->struct_size,
                 (unsigned)sizeof *s);
        return tahr__telemetry_complain(d, status, text);
    }
    return s->name ? TAHR_OK : tahr__telemetry_complain(d, TAHR_E_NULL, "sink.name is NULL");
}

/* A number, what it may be besides 0 if that stands for a default, and in words. */
typedef struct range {
    const char *name;
    double value, low, high;
    int zero; /* 1: is the default */
} range;

static tahr_status check_ranges(const tahr_telemetry_desc *d)
{
    const range ranges[] = {
        {"characters", d->characters, 1, 1 << 20, 0},
        {"lanes", d->lanes, 1, 64, 1},
        {"ring_bytes", d->ring_bytes, LEAST_RING, MOST_RING, 1},
        {"bodies", d->bodies, 0, 1 << 20, 0},
        {"config_count", d->config_count, 1, 65536, 0},
        {"state_rate", d->state_rate, 1e-6, 1e6, 1},
        {"snapshot_period", d->snapshot_period, 0.01, 1e6, 1},
        {"world_period", d->world_period, 0.01, 1e6, 1},
        {"drain_period", d->drain_period, 1e-5, 1, 1},
    };
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
        const range *r = &ranges[i];
        char text[160];
        if ((r->zero && r->value == 0) || (r->value >= r->low && r->value <= r->high)) continue; /* NaN fails too */
        snprintf(text, sizeof text, "desc.%s is %.17g, expected %s%.9g to %.9g", r->name, r->value,
                 r->zero ? "0 (the default) or " : "", r->low, r->high);
        return tahr__telemetry_complain(d, TAHR_E_ARGUMENT, text);
    }
    return TAHR_OK;
}

static tahr_status check_configs(const tahr_telemetry_desc *d)
{
    char text[160];
    if (!d->configs) return tahr__telemetry_complain(d, TAHR_E_NULL, "desc.configs is NULL");
    const char *at = (const char *)d->configs;
    for (uint32_t i = 0; i < d->config_count; i++, at += d->configs->struct_size) {
        const tahr_config *config = (const tahr_config *)(const void *)at;
        const char *field = NULL;
        const tahr_status status = tahr_config_check(config, &field);
        if (status < 0) {
            snprintf(text, sizeof text, "desc.configs[%u].%s is not valid: %s", (unsigned)i,
                     field ? field : "struct_size", tahr_status_message(status));
            return tahr__telemetry_complain(d, status, text);
        }
        if (config->struct_size != d->configs->struct_size) {
            snprintf(text, sizeof text, "desc.configs[%u].struct_size is %u, expected %u as of the first", (unsigned)i,
                     (unsigned)config->struct_size, (unsigned)d->configs->struct_size);
            return tahr__telemetry_complain(d, TAHR_E_ARGUMENT, text);
        }
    }
    return TAHR_OK;
}

tahr_status tahr__telemetry_check(const tahr_telemetry_desc *d)
{
    char text[160];
    tahr_status status = check_tail(d, sizeof *d);
    if (status == TAHR_E_STRUCT_SIZE) return status; /* nothing of it can be read, the log neither */
    if (status < 0) return tahr__telemetry_complain(d, status, "desc has a tail that is not known here, and not zero");
    if (d->flags & ~(uint32_t)(TAHR_TELEMETRY_THIN_ALL | TAHR_TELEMETRY_NARROW)) {
        snprintf(text, sizeof text, "desc.flags is %#x, expected TAHR_TELEMETRY_*", (unsigned)d->flags);
        return tahr__telemetry_complain(d, TAHR_E_UNSUPPORTED, text);
    }
    if (d->allocator && (!d->allocator->alloc || !d->allocator->free))
        return tahr__telemetry_complain(d, TAHR_E_NULL, "desc.allocator has no alloc or no free");
    status = check_sink(d);
    if (status == TAHR_OK) status = check_ranges(d);
    if (status == TAHR_OK) status = check_configs(d);
    if (status < 0) return status;
    if ((uint64_t)d->bodies * 4 * sizeof(tahr_body_pose) <= tahr__telemetry_ring_bytes(d)) return TAHR_OK;
    snprintf(text, sizeof text, "desc.ring_bytes is %u, expected %llu or more for snapshots of desc.bodies, %u",
             (unsigned)d->ring_bytes, (unsigned long long)d->bodies * 4 * sizeof(tahr_body_pose), (unsigned)d->bodies);
    return tahr__telemetry_complain(d, TAHR_E_ARGUMENT, text);
}
