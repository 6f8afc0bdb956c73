/* SPDX-License-Identifier: MIT
 * tmj_data.c: the numbers of a tile layer: a list, or base64, packed by zlib or gzip where this shell was built with
 * zlib. */
#include "say.h"
#include "tmj.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#ifdef TAHR_HAVE_ZLIB
#include <zlib.h>
#endif

static int read_list(struct tmj *tmj, const json_t *list, uint32_t *numbers, size_t count)
{
    if (json_array_size(list) != count) {
        return tmj_complain(tmj, "data: %zu numbers; expected %zu (width times height)", json_array_size(list), count);
    }
    for (size_t i = 0; i < count; i++) {
        const json_t *item = json_array_get(list, i);
        json_int_t number = json_integer_value(item);
        if (!json_is_integer(item) || number < 0 || number > 0xFFFFFFFF) {
            return tmj_complain(tmj, "data[%zu]: expected a whole number from 0 to 4294967295", i);
        }
        numbers[i] = (uint32_t)number;
    }
    return 0;
}

static int digit_of(char c)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *place = c != '\0' ? strchr(digits, c) : NULL;
    return place != NULL ? (int)(place - digits) : -1;
}

/* The bytes of a base64 text, to be freed; NULL after a message. */
static unsigned char *decode(struct tmj *tmj, const char *text, size_t *size)
{
    size_t length = strlen(text);
    unsigned char *bytes = memory_new(length + 3, 1);
    uint32_t bits = 0;
    int held = 0;
    *size = 0;
    while (length > 0 && text[length - 1] == '=') {
        length--;
    }
    for (size_t i = 0; i < length; i++) {
        int digit = digit_of(text[i]);
        if (digit < 0) {
            tmj_complain(tmj, "data: character %zu of the text is no base64", i + 1);
            free(bytes);
            return NULL;
        }
        bits = bits << 6 | (uint32_t)digit;
        held += 6;
        if (held >= 8) {
            held -= 8;
            bytes[(*size)++] = (unsigned char)(bits >> held);
        }
    }
    return bytes;
}

/* Unpacks to exactly `wanted` bytes, to be freed; NULL after a message. */
static unsigned char *unpack(struct tmj *tmj, const unsigned char *packed, size_t size, size_t wanted)
{
#ifdef TAHR_HAVE_ZLIB
    unsigned char *bytes = memory_new(wanted + 1, 1); /* one more, to see what is too long */
    z_stream stream = {.next_in = (unsigned char *)(uintptr_t)packed,
                       .avail_in = (uInt)size,
                       .next_out = bytes,
                       .avail_out = (uInt)(wanted + 1)};
    int either = 15 + 32; /* the largest window; zlib's own header or that of gzip */
    int ended = inflateInit2(&stream, either) == Z_OK ? inflate(&stream, Z_FINISH) : Z_MEM_ERROR;
    inflateEnd(&stream);
    if (ended == Z_STREAM_END && stream.total_out == wanted) {
        return bytes;
    }
    tmj_complain(tmj, "data: does not unpack to %zu bytes (width times height times 4)%s%s", wanted,
                 stream.msg != NULL ? ": " : "", stream.msg != NULL ? stream.msg : "");
    free(bytes);
#else
    (void)packed, (void)size, (void)wanted;
    tmj_complain(tmj, "compression: this shell was built without zlib; expected tile layers as CSV or plain base64");
#endif
    return NULL;
}

static int is_packed(struct tmj *tmj, const char *compression)
{
    if (compression == NULL || *compression == '\0') {
        return 0;
    }
    if (strcmp(compression, "zlib") == 0 || strcmp(compression, "gzip") == 0) {
        return 1;
    }
    return tmj_complain(tmj, "compression '%s': expected none, zlib or gzip (Tile Layer Format in Tiled)", compression);
}

static int read_text(struct tmj *tmj, const char *text, int packed, uint32_t *numbers, size_t count)
{
    size_t size = 0;
    unsigned char *bytes = decode(tmj, text, &size);
    if (bytes != NULL && packed) {
        unsigned char *whole = unpack(tmj, bytes, size, 4 * count);
        free(bytes);
        bytes = whole;
        size = 4 * count;
    }
    if (bytes == NULL) {
        return -1;
    }
    for (size_t i = 0; i < count && size == 4 * count; i++) {
        const unsigned char *b = bytes + 4 * i;
        numbers[i] = (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
    }
    free(bytes);
    return size == 4 * count
               ? 0
               : tmj_complain(tmj, "data: %zu bytes; expected %zu (width times height times 4)", size, 4 * count);
}

uint32_t *tmj_data(struct tmj *tmj, const json_t *holder, const json_t *layer, size_t count)
{
    const json_t *data = json_object_get(holder, "data");
    const char *encoding = json_string_value(json_object_get(layer, "encoding"));
    int base64 = encoding != NULL && strcmp(encoding, "base64") == 0;
    if (encoding != NULL && !base64 && strcmp(encoding, "csv") != 0) {
        tmj_complain(tmj, "encoding '%s': expected csv or base64", encoding);
        return NULL;
    }
    int packed = base64 ? is_packed(tmj, json_string_value(json_object_get(layer, "compression"))) : 0;
    if (packed < 0) {
        return NULL;
    }
    if (base64 ? !json_is_string(data) : !json_is_array(data)) {
        tmj_complain(tmj, "%sdata: expected %s", data == NULL ? "missing " : "",
                     base64 ? "a text in base64" : "a list of numbers");
        return NULL;
    }
    uint32_t *numbers = memory_new(count, sizeof *numbers);
    if ((base64 ? read_text(tmj, json_string_value(data), packed, numbers, count)
                : read_list(tmj, data, numbers, count)) != 0) {
        free(numbers);
        return NULL;
    }
    return numbers;
}
