/* SPDX-License-Identifier: MIT
 * inbox.h: what arrived over an lcm_t, decoded: how many of each kind, and the last one. */
#ifndef TAHR_TEST_INBOX_H
#define TAHR_TEST_INBOX_H

#include <tahr/sink.h>

#include <tahr_lcm/tahr_body_t.h>
#include <tahr_lcm/tahr_event_t.h>
#include <tahr_lcm/tahr_input_t.h>
#include <tahr_lcm/tahr_report_t.h>
#include <tahr_lcm/tahr_snapshot_t.h>
#include <tahr_lcm/tahr_state_t.h>
#include <tahr_lcm/tahr_world_t.h>

typedef struct inbox {
    lcm_t *lcm;
    uint32_t count[TAHR_MESSAGE_COUNT];
    char channel[64]; /* of the last message */
    tahr_state_t state;
    tahr_event_t event;
    tahr_input_t input;
    tahr_report_t report;
    tahr_snapshot_t snapshot; /* its bytes are state_bytes */
    tahr_body_t bodies[8];    /* the first ones */
    tahr_world_t world;       /* its texts and bytes are those below */
    unsigned char state_bytes[sizeof(tahr_state)];
    char level[64], backend[64], version[32];
    unsigned char configs[8192];
    struct {
        tahr_state_t_subscription_t *state;
        tahr_event_t_subscription_t *event;
        tahr_input_t_subscription_t *input;
        tahr_report_t_subscription_t *report;
        tahr_snapshot_t_subscription_t *snapshot;
        tahr_body_t_subscription_t *body;
        tahr_world_t_subscription_t *world;
    } subscriptions;
} inbox;

/* Subscribes to the channels that the pattern fits, each kind decoded as its name says. */
void inbox_open(inbox *box, lcm_t *lcm, const char *prefix, const char *suffix);

/* Unsubscribes; the lcm_t stays. */
void inbox_close(inbox *box);

/* Takes messages until n of a kind have come. 0 if nothing came for five seconds. */
int inbox_wait(inbox *box, uint32_t kind, uint32_t n);

#endif
