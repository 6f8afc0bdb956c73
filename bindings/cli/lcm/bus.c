/* SPDX-License-Identifier: MIT
 * bus.c: a connection to LCM. */
#include "bus.h"

#include "../interrupt.h"
#include "../log_file.h"
#include "../say.h"
#include "../stats.h"

#include <arpa/inet.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <tahr/lcm.h>
#include <unistd.h>

#define PAUSE_NS 100000000u    /* between two pauses at most */
#define ASKED_BUFFER (8 << 20) /* bytes: a second of 256 characters at 60 Hz; the system gives what it allows */
#define QUEUE 65536 /* messages that liblcm keeps until they are handled; its own 30 are less than one tick */

const char *bus_url(const char *url)
{
    const char *set = getenv("LCM_DEFAULT_URL");
    return url != NULL ? url : set != NULL && *set != '\0' ? set : "udpm://239.255.76.67:7667?ttl=0"; /* LCM's own */
}

static int begins(const char *text, const char *with)
{
    return strncmp(text, with, strlen(with)) == 0;
}

static lcm_t *complain(const char *url, const char *what)
{
    say_error("--lcm '%s': %s", url, what);
    return NULL;
}

/* The sink looks for what liblcm would only print about: another scheme, no route for multicast. */
static int is_there(const char *url)
{
    const tahr_log log = say_log();
    tahr_lcm_desc desc;
    tahr_lcm *sink = NULL;
    tahr_lcm_desc_init(&desc, sizeof desc);
    desc.url = url;
    desc.log = &log;
    const tahr_status status = tahr_lcm_open(&desc, &sink);
    tahr_lcm_close(sink);
    if (status < 0) {
        complain(url, "cannot be opened");
    }
    return status >= 0;
}

/* As much as a socket may have: Linux grants twice what is asked for, up to a limit, and liblcm prints a warning where
 * it gets less than it asked for. */
static int receive_buffer(void)
{
    int bytes = ASKED_BUFFER;
    socklen_t size = sizeof bytes;
    const int plug = socket(AF_INET, SOCK_DGRAM, 0);
    const int known = plug >= 0 && setsockopt(plug, SOL_SOCKET, SO_RCVBUF, &bytes, sizeof bytes) == 0 &&
                      getsockopt(plug, SOL_SOCKET, SO_RCVBUF, &bytes, &size) == 0;
    if (plug >= 0) {
        close(plug);
    }
    return known ? bytes / 2 : 0;
}

static lcm_t *connect_network(const char *url)
{
    char wide[512];
    if (!is_there(url)) {
        return NULL;
    }
    const int bytes = strstr(url, "recv_buf_size") == NULL ? receive_buffer() : 0;
    const int length =
        snprintf(wide, sizeof wide, "%s%crecv_buf_size=%d", url, strchr(url, '?') != NULL ? '&' : '?', bytes);
    lcm_t *lcm = lcm_create(bytes > 0 && length < (int)sizeof wide ? wide : url);
    return lcm != NULL ? lcm : complain(url, "LCM cannot be set up");
}

lcm_t *bus_open_to_hear(const char *given)
{
    const char *url = bus_url(given);
    if (begins(url, "udpm://")) {
        return connect_network(url);
    }
    if (begins(url, "file://")) {
        char path[4096];
        enum log_kind kind = LOG_UNKNOWN;
        snprintf(path, sizeof path, "%.*s", (int)strcspn(url + 7, "?"), url + 7);
        if (log_file_kind(path, &kind) != 0) {
            return NULL;
        }
        lcm_t *lcm = kind == LOG_EVENTS ? lcm_create(url) : NULL;
        return lcm != NULL ? lcm : complain(url, "expected an LCM event log");
    }
    return complain(url, begins(url, "memq://") ? "is heard only by who publishes on it; expected udpm:// or file://"
                                                : "expected udpm://, or file:// of an LCM event log");
}

lcm_t *bus_open_to_speak(const char *given)
{
    const char *url = bus_url(given);
    return begins(url, "udpm://") ? connect_network(url) : complain(url, "expected udpm://");
}

static void on_message(const lcm_recv_buf_t *message, const char *channel, void *user)
{
    const struct bus_listener *listener = user;
    if (!listener->is_done(listener->user)) {
        listener->hear(listener->user, message, channel);
    }
}

int bus_listen(lcm_t *lcm, const struct bus_listener *listener)
{
    struct bus_listener own = *listener;
    const uint64_t began = clock_ns();
    uint64_t paused = began, now = began;
    int got = 0;
    lcm_subscription_t *all = lcm_subscribe(lcm, ".*", on_message, &own);
    if (all == NULL) {
        say_error("LCM does not let subscribe");
        return -1;
    }
    lcm_subscription_set_queue_capacity(all, QUEUE);
    while (got >= 0 && !interrupt_came() && !own.is_done(own.user) &&
           (own.seconds <= 0 || (double)(now - began) * 1e-9 < own.seconds)) {
        got = lcm_handle_timeout(lcm, 0);
        now = clock_ns();
        if (got == 0 || now - paused >= PAUSE_NS) {
            own.pause(own.user);
            paused = now;
        }
        if (got == 0) {
            const double left = own.seconds > 0 ? own.seconds - (double)(now - began) * 1e-9 : 1;
            got = lcm_handle_timeout(lcm, left < 0.1 ? (int)(left * 1e3) + 1 : 100);
            now = clock_ns();
        }
    }
    own.pause(own.user);
    lcm_unsubscribe(lcm, all);
    return 0;
}
