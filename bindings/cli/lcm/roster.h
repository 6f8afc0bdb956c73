/* SPDX-License-Identifier: MIT
 * roster.h: who was heard: every character of every publisher, what is known of it, and what was lost of it. */
#ifndef TAHR_CLI_LCM_ROSTER_H
#define TAHR_CLI_LCM_ROSTER_H

#include "message.h"

/* One character. */
struct roster_row {
    int64_t next[TAHR_MESSAGE_COUNT]; /* sequence expected; -1: none heard yet */
    uint64_t messages, lost;
    uint64_t counted; /* messages when the rate was last taken */
    double rate;      /* messages per second */
    int has_state, has_event;
    tahr_state_t state;
    tahr_event_t event;
};

/* Whoever publishes with one prefix. */
struct roster_publisher {
    char prefix[64];
    int has_world;
    int64_t run;
    char level[48], backend[24];
    int32_t characters;
    int64_t dropped, failed; /* as it says itself */
    uint64_t runs;           /* begun before our ears, at least */
    int64_t epoch;           /* of the last change of the world, or -1; */
    int64_t bodies_left;     /* messages of it that are missing */
    int64_t next_world;
    struct roster_row **rows; /* by character, NULL: not heard */
    size_t row_count, row_capacity;
};

struct roster {
    struct roster_publisher *publishers;
    size_t publisher_count, publisher_capacity;
    uint64_t messages, bytes; /* of ours, by what was asked for */
    uint64_t lost;            /* numbers that are missing in their sequences */
    uint64_t foreign;         /* of another package or version on our channels */
    uint64_t strange;         /* of ours, but with a character that cannot be, or of too many publishers */
    uint64_t by_kind[TAHR_MESSAGE_COUNT];
};

/* Counts a message of ours; its channel says who sent it. 0: it is strange. */
int roster_hear(struct roster *roster, const struct message *message, const char *channel);

/* Messages per second of each, over the time since the last call, s. */
void roster_take_rates(struct roster *roster, double seconds);

void roster_close(struct roster *roster);

#endif
