/* SPDX-License-Identifier: MIT
 * message.c: one message of a telemetry over LCM. */
#include "message.h"

#include <ctype.h>
#include <limits.h>
#include <string.h>

static const char *const channels[TAHR_MESSAGE_COUNT] = {
    [TAHR_MESSAGE_STATE] = "TAHR_STATE",       [TAHR_MESSAGE_EVENT] = "TAHR_EVENT",
    [TAHR_MESSAGE_INPUT] = "TAHR_INPUT",       [TAHR_MESSAGE_REPORT] = "TAHR_REPORT",
    [TAHR_MESSAGE_SNAPSHOT] = "TAHR_SNAPSHOT", [TAHR_MESSAGE_BODY] = "TAHR_BODY",
    [TAHR_MESSAGE_WORLD] = "TAHR_WORLD"};

const char *message_channel(uint32_t kind)
{
    return kind < TAHR_MESSAGE_COUNT ? channels[kind] : "?";
}

/* A channel's name is PREFIX NAME, or PREFIX NAME _ID. */
static int kind_of(const char *channel, size_t *prefix)
{
    size_t length = strlen(channel), digits = 0;
    while (digits < length && isdigit((unsigned char)channel[length - 1 - digits])) {
        digits++;
    }
    if (digits > 0 && length > digits && channel[length - 1 - digits] == '_') {
        length -= digits + 1;
    }
    for (int kind = 0; kind < TAHR_MESSAGE_COUNT; kind++) {
        const size_t own = strlen(channels[kind]);
        if (own <= length && memcmp(channel + length - own, channels[kind], own) == 0) {
            *prefix = length - own;
            return kind;
        }
    }
    return -1;
}

/* The number of 4 bytes, highest first, as everything in a message. */
static int64_t whole_at(const uint8_t *data, size_t at)
{
    return (int32_t)((uint32_t)data[at] << 24 | (uint32_t)data[at + 1] << 16 | (uint32_t)data[at + 2] << 8 |
                     (uint32_t)data[at + 3]);
}

/* Is there a text of at least its closing zero at *at? Then *at is behind it. */
static int has_text(const uint8_t *data, size_t size, size_t *at)
{
    if (*at + 4 > size) {
        return 0;
    }
    const int64_t length = whole_at(data, *at);
    if (length < 1 || (uint64_t)length > size - *at - 4 || data[*at + 3 + (size_t)length] != 0) {
        return 0;
    }
    *at += 4 + (size_t)length;
    return 1;
}

/* Do the texts and the array at the end of a message fill it exactly? Its fixed parts, in bytes: the fingerprint and,
 * of a snapshot, 2 numbers of 4 and 6 of 8; of a world 3 of 8, its level, 8, its backend and version, and from abi to
 * config_size 4 of 4 and 5 of 8. */
static int is_whole(uint32_t kind, const uint8_t *data, size_t size)
{
    size_t at = kind == TAHR_MESSAGE_SNAPSHOT ? 8 + 2 * 4 + 6 * 8 : 8 + 3 * 8;
    if (kind != TAHR_MESSAGE_SNAPSHOT && kind != TAHR_MESSAGE_WORLD) {
        return 1;
    }
    if (kind == TAHR_MESSAGE_WORLD) {
        if (!has_text(data, size, &at)) {
            return 0;
        }
        at += 8;
        if (!has_text(data, size, &at) || !has_text(data, size, &at)) {
            return 0;
        }
        at += 4 * 4 + 5 * 8;
    }
    return at + 4 <= size && whole_at(data, at) > 0 && (uint64_t)whole_at(data, at) == size - at - 4;
}

static int decode(struct message *m, const void *data, int size)
{
    switch (m->kind) {
    case TAHR_MESSAGE_STATE: return tahr_state_t_decode(data, 0, size, &m->is.state);
    case TAHR_MESSAGE_EVENT: return tahr_event_t_decode(data, 0, size, &m->is.event);
    case TAHR_MESSAGE_INPUT: return tahr_input_t_decode(data, 0, size, &m->is.input);
    case TAHR_MESSAGE_REPORT: return tahr_report_t_decode(data, 0, size, &m->is.report);
    case TAHR_MESSAGE_SNAPSHOT: return tahr_snapshot_t_decode(data, 0, size, &m->is.snapshot);
    case TAHR_MESSAGE_BODY: return tahr_body_t_decode(data, 0, size, &m->is.body);
    default: return tahr_world_t_decode(data, 0, size, &m->is.world);
    }
}

#define TAKE(of)                           \
    do {                                   \
        m->character = m->is.of.character; \
        m->step = m->is.of.step;           \
        m->sequence = m->is.of.sequence;   \
        m->wall_ns = m->is.of.wall_ns;     \
    } while (0)

static void take_stamp(struct message *m)
{
    m->character = -1;
    m->step = m->sequence = -1;
    switch (m->kind) {
    case TAHR_MESSAGE_STATE: TAKE(state); break;
    case TAHR_MESSAGE_EVENT: TAKE(event); break;
    case TAHR_MESSAGE_INPUT: TAKE(input); break;
    case TAHR_MESSAGE_REPORT: TAKE(report); break;
    case TAHR_MESSAGE_SNAPSHOT: TAKE(snapshot); break;
    case TAHR_MESSAGE_BODY: m->wall_ns = m->is.body.wall_ns; break;
    default:
        m->sequence = m->is.world.sequence;
        m->wall_ns = m->is.world.wall_ns;
        break;
    }
}

static uint64_t fingerprint(uint32_t kind)
{
    switch (kind) {
    case TAHR_MESSAGE_STATE: return (uint64_t)__tahr_state_t_get_hash();
    case TAHR_MESSAGE_EVENT: return (uint64_t)__tahr_event_t_get_hash();
    case TAHR_MESSAGE_INPUT: return (uint64_t)__tahr_input_t_get_hash();
    case TAHR_MESSAGE_REPORT: return (uint64_t)__tahr_report_t_get_hash();
    case TAHR_MESSAGE_SNAPSHOT: return (uint64_t)__tahr_snapshot_t_get_hash();
    case TAHR_MESSAGE_BODY: return (uint64_t)__tahr_body_t_get_hash();
    default: return (uint64_t)__tahr_world_t_get_hash();
    }
}

static int is_known(uint32_t kind, const uint8_t *data, size_t size)
{
    uint64_t found = 0;
    for (size_t i = 0; i < 8 && size >= 8; i++) {
        found = found << 8 | data[i];
    }
    return size >= 8 && size <= INT_MAX && found == fingerprint(kind);
}

enum message_verdict message_read(struct message *m, const char *channel, const void *data, size_t size)
{
    size_t prefix = 0;
    const int kind = kind_of(channel, &prefix);
    if (kind < 0) {
        return MESSAGE_OTHER;
    }
    memset(m, 0, sizeof *m);
    m->kind = (uint32_t)kind;
    m->prefix = prefix;
    if (!is_known(m->kind, data, size) || !is_whole(m->kind, data, size)) {
        return MESSAGE_FOREIGN;
    }
    const int used = decode(m, data, (int)size);
    if (used < 0 || (size_t)used != size) {
        message_free(m);
        return MESSAGE_FOREIGN;
    }
    take_stamp(m);
    return MESSAGE_OURS;
}

void message_free(struct message *m)
{
    if (m->kind == TAHR_MESSAGE_SNAPSHOT) {
        tahr_snapshot_t_decode_cleanup(&m->is.snapshot);
    } else if (m->kind == TAHR_MESSAGE_WORLD) {
        tahr_world_t_decode_cleanup(&m->is.world);
    }
}
