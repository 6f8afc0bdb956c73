/* SPDX-License-Identifier: MIT
 * connection.c: opens what a URL names, and sends.
 *
 * liblcm prints when it cannot connect; so everything that may fail is tried before it is asked. */
#include "connection.h"
#include "url.h"

#include <errno.h>
#include <netinet/in.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

tahr_status tahr__lcm_complain(const tahr_log *log, tahr_status status, const char *format, ...)
{
    char text[512];
    va_list list;

    if (!log || !log->write) return status;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    log->write(log->user, TAHR_LOG_ERROR, text);
    return status;
}

/* A socket that is connected sends nothing: the system only looks for the way. */
static tahr_status probe_route(const tahr__lcm_url *url, const tahr_log *log)
{
    struct sockaddr_in to;
    const int probe = socket(AF_INET, SOCK_DGRAM, 0);

    memset(&to, 0, sizeof to);
    to.sin_family = AF_INET;
    to.sin_port = htons(url->port);
    memcpy(&to.sin_addr, url->group, sizeof url->group);
    const int is_there = probe >= 0 && connect(probe, (const struct sockaddr *)&to, sizeof to) == 0;
    const int why = errno;
    if (probe >= 0) close(probe);
    if (is_there) return TAHR_OK;
    return tahr__lcm_complain(log, TAHR_E_NOT_FOUND,
                              "tahr_lcm_open: no way to multicast group %d.%d.%d.%d: %s; a machine without a network "
                              "needs 'ip link set lo multicast on' and 'ip route add 224.0.0.0/4 dev lo'",
                              url->group[0], url->group[1], url->group[2], url->group[3], strerror(why));
}

static tahr_status open_log(tahr__lcm_connection *c, const char *path)
{
    c->log = lcm_eventlog_create(path, "w");
    if (c->log) return TAHR_OK;
    return tahr__lcm_complain(&c->complaints, TAHR_E_FILE, "tahr_lcm_open: cannot be written: %s: %s", strerror(errno),
                              path);
}

static tahr_status open_lcm(tahr__lcm_connection *c, const char *text, const tahr__lcm_url *url)
{
    c->is_paced = url->scheme == TAHR__LCM_UDPM;
    tahr_status status = c->is_paced ? probe_route(url, &c->complaints) : TAHR_OK;
    if (status < 0) return status;
    c->lcm = lcm_create(text);
    c->is_own = 1;
    if (c->lcm && c->is_paced) tahr__lcm_listeners_open(&c->pace.listeners, url->group, url->port);
    if (c->lcm) return TAHR_OK;
    return tahr__lcm_complain(&c->complaints, TAHR_E_NOT_FOUND, "tahr_lcm_open: LCM cannot be set up for '%.200s'",
                              text);
}

tahr_status tahr__lcm_connect(tahr__lcm_connection *c, const tahr_lcm_desc *desc)
{
    const char *from = "desc.url", *text = desc->url;
    tahr__lcm_url url;

    memset(c, 0, sizeof *c);
    tahr__lcm_pace_open(&c->pace, desc->burst, desc->rate);
    if (desc->log) c->complaints = *desc->log;
    if (desc->lcm) {
        c->lcm = desc->lcm;
        c->is_paced = 1; /* it may be a network */
        return TAHR_OK;
    }
    if (!text) {
        from = "LCM_DEFAULT_URL";
        text = getenv(from);
        if (!text || !*text) text = "udpm://";
    }
    tahr_status status = tahr__lcm_url_read(text, &url);
    if (status < 0)
        return tahr__lcm_complain(&c->complaints, status, "tahr_lcm_open: %s '%.200s': %s", from, text, url.problem);
    return url.scheme == TAHR__LCM_FILE ? open_log(c, url.path) : open_lcm(c, text, &url);
}

static int64_t now_us(void)
{
    struct timespec t;
    clock_gettime(CLOCK_REALTIME, &t);
    return (int64_t)t.tv_sec * 1000000 + t.tv_nsec / 1000;
}

static int write_event(lcm_eventlog_t *log, const char *channel, const void *bytes, uint32_t size)
{
    /* liblcm takes pointers that it could write to, and does not. */
    lcm_eventlog_event_t event = {.timestamp = now_us(),
                                  .channellen = (int32_t)strlen(channel),
                                  .datalen = (int32_t)size,
                                  .channel = (char *)channel,
                                  .data = (void *)bytes};
    return lcm_eventlog_write_event(log, &event);
}

/* Once for every time that it begins. */
static void begin_to_fail(tahr__lcm_connection *c, const char *what)
{
    if (!c->is_failing) tahr__lcm_complain(&c->complaints, TAHR_E_FILE, "tahr_lcm: %s: %s", what, strerror(errno));
    c->is_failing = 1;
}

tahr_status tahr__lcm_send(tahr__lcm_connection *c, const char *channel, const void *bytes, uint32_t size)
{
    /* What follows a torn message in a log would be taken for a part of it. */
    if (c->log && c->is_failing) return TAHR_E_FILE;
    if (c->log ? write_event(c->log, channel, bytes, size) : lcm_publish(c->lcm, channel, bytes, size)) {
        begin_to_fail(c, c->log ? "the log ends here, a write failed" : "messages cannot be sent");
        return TAHR_E_FILE;
    }
    c->is_failing = 0;
    if (c->is_paced) tahr__lcm_pace_keep(&c->pace, size);
    return TAHR_OK;
}

void tahr__lcm_flush(tahr__lcm_connection *c)
{
    if (c->log && !c->is_failing && fflush(c->log->f)) begin_to_fail(c, "the log ends here, a write failed");
}

void tahr__lcm_disconnect(tahr__lcm_connection *c)
{
    tahr__lcm_flush(c);
    tahr__lcm_listeners_close(&c->pace.listeners);
    if (c->log) lcm_eventlog_destroy(c->log);
    if (c->lcm && c->is_own) lcm_destroy(c->lcm);
}
