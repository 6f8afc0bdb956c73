/* SPDX-License-Identifier: MIT
 * format.c: numbers, structs and checksums as bytes. */
#include "format.h"

#include <stdio.h>
#include <string.h>

void tahr__trace_head_fill(tahr__trace_head *head)
{
    const uint32_t sizes[16] = {sizeof(tahr_sweep),
                                sizeof(tahr_contact_query),
                                sizeof(tahr_ray),
                                sizeof(tahr_fluid_query),
                                sizeof(tahr_hit),
                                sizeof(tahr_contact),
                                sizeof(tahr_fluid),
                                sizeof(tahr_body_motion),
                                sizeof(tahr_body_pose),
                                sizeof(tahr_record_body),
                                sizeof(tahr_state),
                                sizeof(tahr_config),
                                sizeof(tahr_input),
                                sizeof(tahr__trace_head),
                                0,
                                0};
    memset(head, 0, sizeof *head);
    memcpy(head->magic, TAHR__TRACE_MAGIC, sizeof head->magic);
    head->version = TAHR__TRACE_VERSION;
    head->abi = TAHR_ABI;
    memcpy(head->sizes, sizes, sizeof sizes);
    head->checksum = tahr__trace_hash(0, head, offsetof(tahr__trace_head, checksum));
}

uint64_t tahr__trace_hash(uint64_t seed, const void *bytes, size_t size)
{
    const unsigned char *b = bytes;
    uint64_t hash = seed ? seed : 0xCBF29CE484222325u;

    for (size_t i = 0; i < size; i++)
        hash = (hash ^ b[i]) * 0x100000001B3u;
    return hash;
}

void tahr__trace_complain(const tahr_log *log, const char *function, const char *name, const char *what)
{
    char text[240];

    if (!log || !log->write) return;
    snprintf(text, sizeof text, "%s: %.160s %s", function, name, what);
    log->write(log->user, TAHR_LOG_ERROR, text);
}

static int is_little(void)
{
    const uint32_t one = 1;
    unsigned char first;

    memcpy(&first, &one, 1);
    return first == 1;
}

tahr_status tahr__trace_check(const tahr_trace_desc *desc, uint32_t known_flags)
{
    uint32_t size;

    memcpy(&size, desc, sizeof size);
    if (size < sizeof *desc || size > sizeof *desc + 4096) return TAHR_E_STRUCT_SIZE;
    for (uint32_t i = sizeof *desc; i < size; i++) {
        if (((const unsigned char *)desc)[i]) return TAHR_E_UNSUPPORTED;
    }
    return desc->flags & ~known_flags || !is_little() ? TAHR_E_UNSUPPORTED : TAHR_OK;
}

void tahr__trace_put(tahr__trace_bytes *b, uint64_t number)
{
    for (; number > 127; number >>= 7)
        *b->at++ = (unsigned char)(number | 128);
    *b->at++ = (unsigned char)number;
}

/* Once something is bad nothing more is read. */
static int is_there(tahr__trace_bytes *b, size_t size, const char *what)
{
    if (!b->bad && (size_t)(b->end - b->at) < size) b->bad = what;
    return !b->bad;
}

uint64_t tahr__trace_get(tahr__trace_bytes *b, const char *what)
{
    uint64_t number = 0;

    for (int shift = 0; shift < 64 && is_there(b, 1, what); shift += 7) {
        unsigned char byte = *b->at++;
        number |= (uint64_t)(byte & 127) << shift;
        if (byte < 128) return number;
    }
    if (!b->bad) b->bad = what;
    return 0;
}

void tahr__trace_put_words(tahr__trace_bytes *b, const void *object, void *base, size_t size)
{
    const unsigned char *now = object;
    unsigned char *before = base, *mask = b->at;
    size_t words = size / 8, bytes = (words + 7) / 8;

    memset(mask, 0, bytes);
    b->at += bytes;
    for (size_t i = 0; i < words; i++) {
        if (memcmp(now + 8 * i, before + 8 * i, 8) == 0) continue;
        mask[i / 8] = (unsigned char)(mask[i / 8] | 1u << i % 8);
        memcpy(b->at, now + 8 * i, 8);
        b->at += 8;
    }
    memcpy(before, now, size);
}

void tahr__trace_get_words(tahr__trace_bytes *b, void *object, void *base, size_t size, const char *what)
{
    unsigned char *words_of = base;
    const unsigned char *mask = b->at;
    size_t words = size / 8, bytes = (words + 7) / 8;

    if (!is_there(b, bytes, what)) return;
    b->at += bytes;
    for (size_t i = 0; i < words; i++) {
        if (!(mask[i / 8] >> i % 8 & 1)) continue;
        if (!is_there(b, 8, what)) return;
        memcpy(words_of + 8 * i, b->at, 8);
        b->at += 8;
    }
    memcpy(object, base, size);
}

void tahr__trace_put_text(tahr__trace_bytes *b, const char *text, size_t room)
{
    size_t length = strlen(text);

    length = length < room ? length : room - 1;
    tahr__trace_put(b, length);
    memcpy(b->at, text, length);
    b->at += length;
}

void tahr__trace_get_text(tahr__trace_bytes *b, char *text, size_t room, const char *what)
{
    uint64_t length = tahr__trace_get(b, what);

    text[0] = 0;
    if (length >= room) b->bad = what;
    if (!is_there(b, (size_t)length, what)) return;
    memcpy(text, b->at, (size_t)length);
    text[length] = 0;
    b->at += length;
}
