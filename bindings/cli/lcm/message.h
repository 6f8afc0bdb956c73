/* SPDX-License-Identifier: MIT
 * message.h: one message of a telemetry over LCM: known by its channel, read, and told apart from what others
 * send. */
#ifndef TAHR_CLI_LCM_MESSAGE_H
#define TAHR_CLI_LCM_MESSAGE_H

#include <stddef.h>
#include <tahr/sink.h>
#include <tahr_lcm/tahr_body_t.h>
#include <tahr_lcm/tahr_event_t.h>
#include <tahr_lcm/tahr_input_t.h>
#include <tahr_lcm/tahr_report_t.h>
#include <tahr_lcm/tahr_snapshot_t.h>
#include <tahr_lcm/tahr_state_t.h>
#include <tahr_lcm/tahr_world_t.h>

struct message {
    uint32_t kind;     /* TAHR_MESSAGE_* */
    size_t prefix;     /* letters of the channel before its name */
    int32_t character; /* -1: of none */
    int64_t step;      /* likewise */
    int64_t sequence;  /* of its kind and character; of bodies -1 */
    int64_t wall_ns;
    union {
        tahr_state_t state;
        tahr_event_t event;
        tahr_input_t input;
        tahr_report_t report;
        tahr_snapshot_t snapshot;
        tahr_body_t body;
        tahr_world_t world;
    } is;
};

/* OTHER: not on a channel of ours. FOREIGN: on one, but of another package or version, or broken. */
enum message_verdict { MESSAGE_OTHER, MESSAGE_FOREIGN, MESSAGE_OURS };

/* Reads what came on a channel. Only OURS fills the message, which has to be freed. Whatever the bytes are, it reads
 * none beyond them: lcm-gen's own readers trust the sizes of strings and arrays. */
enum message_verdict message_read(struct message *message, const char *channel, const void *data, size_t size);
void message_free(struct message *message);

/* "TAHR_STATE". */
const char *message_channel(uint32_t kind);

#endif
