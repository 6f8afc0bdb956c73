/* SPDX-License-Identifier: MIT
 * inbox.c: one subscription for each kind of message. */
#include "inbox.h"

#include <stdio.h>
#include <string.h>

static inbox *note(void *user, uint32_t kind, const char *channel)
{
    inbox *box = user;
    box->count[kind]++;
    snprintf(box->channel, sizeof box->channel, "%s", channel);
    return box;
}

#define TAKE(kind, NAME)                                                                                       \
    static void take_##kind(const lcm_recv_buf_t *buffer, const char *channel, const tahr_##kind##_t *message, \
                            void *user)                                                                        \
    {                                                                                                          \
        (void)buffer;                                                                                          \
        note(user, TAHR_MESSAGE_##NAME, channel)->kind = *message;                                             \
    }
TAKE(state, STATE)
TAKE(event, EVENT)
TAKE(input, INPUT)
TAKE(report, REPORT)

static void take_snapshot(const lcm_recv_buf_t *buffer, const char *channel, const tahr_snapshot_t *message, void *user)
{
    inbox *box = note(user, TAHR_MESSAGE_SNAPSHOT, channel);
    (void)buffer;
    box->snapshot = *message;
    box->snapshot.state = box->state_bytes;
    if (message->size == (int32_t)sizeof box->state_bytes)
        memcpy(box->state_bytes, message->state, sizeof box->state_bytes);
}

static void take_body(const lcm_recv_buf_t *buffer, const char *channel, const tahr_body_t *message, void *user)
{
    inbox *box = note(user, TAHR_MESSAGE_BODY, channel);
    (void)buffer;
    if (box->count[TAHR_MESSAGE_BODY] <= 8) box->bodies[box->count[TAHR_MESSAGE_BODY] - 1] = *message;
}

static void take_world(const lcm_recv_buf_t *buffer, const char *channel, const tahr_world_t *message, void *user)
{
    inbox *box = note(user, TAHR_MESSAGE_WORLD, channel);
    (void)buffer;
    box->world = *message;
    snprintf(box->level, sizeof box->level, "%s", message->level);
    snprintf(box->backend, sizeof box->backend, "%s", message->backend);
    snprintf(box->version, sizeof box->version, "%s", message->version);
    if (message->size > 0 && (size_t)message->size <= sizeof box->configs)
        memcpy(box->configs, message->configs, (size_t)message->size);
    box->world.level = box->level;
    box->world.backend = box->backend;
    box->world.version = box->version;
    box->world.configs = box->configs;
}

void inbox_open(inbox *box, lcm_t *lcm, const char *prefix, const char *suffix)
{
    char channel[128];

    memset(box, 0, sizeof *box);
    box->lcm = lcm;
#define SUBSCRIBE(kind, NAME, end)                                                       \
    snprintf(channel, sizeof channel, "%sTAHR_" NAME "%s", prefix, end);                 \
    box->subscriptions.kind = tahr_##kind##_t_subscribe(lcm, channel, take_##kind, box); \
    tahr_##kind##_t_subscription_set_queue_capacity(box->subscriptions.kind, 1 << 20 /* all */)
    SUBSCRIBE(state, "STATE", suffix);
    SUBSCRIBE(event, "EVENT", suffix);
    SUBSCRIBE(input, "INPUT", suffix);
    SUBSCRIBE(report, "REPORT", suffix);
    SUBSCRIBE(snapshot, "SNAPSHOT", suffix);
    SUBSCRIBE(body, "BODY", "");
    SUBSCRIBE(world, "WORLD", "");
#undef SUBSCRIBE
}

void inbox_close(inbox *box)
{
    tahr_state_t_unsubscribe(box->lcm, box->subscriptions.state);
    tahr_event_t_unsubscribe(box->lcm, box->subscriptions.event);
    tahr_input_t_unsubscribe(box->lcm, box->subscriptions.input);
    tahr_report_t_unsubscribe(box->lcm, box->subscriptions.report);
    tahr_snapshot_t_unsubscribe(box->lcm, box->subscriptions.snapshot);
    tahr_body_t_unsubscribe(box->lcm, box->subscriptions.body);
    tahr_world_t_unsubscribe(box->lcm, box->subscriptions.world);
}

int inbox_wait(inbox *box, uint32_t kind, uint32_t n)
{
    while (box->count[kind] < n) {
        if (lcm_handle_timeout(box->lcm, 5000) <= 0) return 0;
    }
    return 1;
}
