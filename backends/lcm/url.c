/* SPDX-License-Identifier: MIT
 * url.c: scheme://target?option=value&option=value, as liblcm reads it. */
#include "url.h"

#include <arpa/inet.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A piece of the text that was given. */
typedef struct piece {
    const char *at;
    int size;
} piece;

static tahr_status refuse(tahr__lcm_url *url, tahr_status status, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    vsnprintf(url->problem, sizeof url->problem, format, list);
    va_end(list);
    return status;
}

static int is(piece p, const char *word)
{
    return (size_t)p.size == strlen(word) && memcmp(p.at, word, (size_t)p.size) == 0;
}

/* What comes before the first of some letters; all of it if there is none. The rest begins after that letter. */
static piece cut(piece *rest, const char *letters)
{
    piece first = {rest->at, 0};
    while (first.size < rest->size && !strchr(letters, first.at[first.size]))
        first.size++;
    const int taken = first.size < rest->size ? first.size + 1 : first.size;
    rest->at += taken;
    rest->size -= taken;
    return first;
}

/* A whole number, also in hexadecimal, within 0..most. */
static int read_number(piece p, long most, long *value)
{
    char text[24], *end;
    if (p.size < 1 || (size_t)p.size >= sizeof text) return 0;
    memcpy(text, p.at, (size_t)p.size);
    text[p.size] = 0;
    *value = strtol(text, &end, 0);
    return *end == 0 && *value >= 0 && *value <= most;
}

/* liblcm's own values, where a part is missing (lcm.h). */
static tahr_status read_group(tahr__lcm_url *url, piece target)
{
    const piece given = target;
    const piece group = cut(&target, ":");
    const int has_port = group.size < given.size;
    char text[16] = ""; /* of an address in full, and empty for what is longer */
    long port;

    memcpy(url->group, (const uint8_t[4]){239, 255, 76, 67}, sizeof url->group);
    url->port = 7667;
    if (given.size == 0) return TAHR_OK;
    if ((size_t)group.size < sizeof text) memcpy(text, group.at, (size_t)group.size);
    if (inet_pton(AF_INET, text, url->group) != 1 || url->group[0] < 224 || url->group[0] > 239)
        return refuse(url, TAHR_E_ARGUMENT, "'%.*s' is no multicast group, 224.0.0.0 to 239.255.255.255", group.size,
                      group.at);
    if (has_port) {
        if (!read_number(target, 65535, &port) || port == 0)
            return refuse(url, TAHR_E_ARGUMENT, "'%.*s' is no port, 1 to 65535", target.size, target.at);
        url->port = (uint16_t)port;
    }
    return TAHR_OK;
}

static tahr_status read_path(tahr__lcm_url *url, piece target)
{
    if (target.size == 0) return refuse(url, TAHR_E_ARGUMENT, "file:// names no file");
    if (target.size > TAHR__LCM_MOST_PATH)
        return refuse(url, TAHR_E_ARGUMENT, "the path has %d letters, more than %d", target.size, TAHR__LCM_MOST_PATH);
    memcpy(url->path, target.at, (size_t)target.size);
    url->path[target.size] = 0;
    return TAHR_OK;
}

static tahr_status read_option(tahr__lcm_url *url, piece option)
{
    const piece name = cut(&option, "=");
    const piece value = option;
    long number;

    if (name.size == 0) return TAHR_OK;
    if (url->scheme == TAHR__LCM_UDPM && is(name, "ttl")) {
        if (read_number(value, 255, &number)) return TAHR_OK;
        return refuse(url, TAHR_E_ARGUMENT, "ttl=%.*s is not within 0 to 255", value.size, value.at);
    }
    if (url->scheme == TAHR__LCM_UDPM && is(name, "recv_buf_size")) {
        if (read_number(value, INT_MAX, &number)) return TAHR_OK;
        return refuse(url, TAHR_E_ARGUMENT, "recv_buf_size=%.*s is no number of bytes", value.size, value.at);
    }
    if (url->scheme == TAHR__LCM_FILE && is(name, "mode")) {
        if (is(value, "w")) return TAHR_OK;
        return refuse(url, TAHR_E_ARGUMENT, "mode=%.*s: what is published to is written, mode=w", value.size, value.at);
    }
    return refuse(url, TAHR_E_ARGUMENT, "unknown option '%.*s'; known: %s", name.size, name.at,
                  url->scheme == TAHR__LCM_UDPM   ? "ttl, recv_buf_size"
                  : url->scheme == TAHR__LCM_FILE ? "mode"
                                                  : "none");
}

static tahr_status read_scheme(tahr__lcm_url *url, piece scheme)
{
    if (is(scheme, "tcpq")) return refuse(url, TAHR_E_UNSUPPORTED, "tcpq:// waits for ever for a server that stalls");
    url->scheme = is(scheme, "udpm")   ? TAHR__LCM_UDPM
                  : is(scheme, "file") ? TAHR__LCM_FILE
                  : is(scheme, "memq") ? TAHR__LCM_MEMQ
                                       : 0u;
    if (url->scheme) return TAHR_OK;
    return refuse(url, TAHR_E_UNSUPPORTED, "unknown scheme '%.*s'; known: udpm, file, memq", scheme.size, scheme.at);
}

tahr_status tahr__lcm_url_read(const char *text, tahr__lcm_url *url)
{
    const char *colon = strstr(text, "://");

    if (!colon) return refuse(url, TAHR_E_ARGUMENT, "no URL; one begins with udpm://, file:// or memq://");
    if (strlen(text) > INT_MAX / 2) return refuse(url, TAHR_E_ARGUMENT, "longer than any URL");
    tahr_status status = read_scheme(url, (piece){text, (int)(colon - text)});
    piece rest = {colon + 3, (int)strlen(colon + 3)};
    const piece target = cut(&rest, "?");
    if (status >= 0 && url->scheme == TAHR__LCM_UDPM) status = read_group(url, target);
    if (status >= 0 && url->scheme == TAHR__LCM_FILE) status = read_path(url, target);
    if (status >= 0 && url->scheme == TAHR__LCM_MEMQ && target.size > 0)
        status =
            refuse(url, TAHR_E_ARGUMENT, "memq:// goes nowhere else: '%.*s' is one too many", target.size, target.at);
    while (status >= 0 && rest.size > 0)
        status = read_option(url, cut(&rest, ",&"));
    return status;
}
