/* SPDX-License-Identifier: MIT
 * record.h: what stands in a ring: a head, what belongs to its kind, and then words. */
#ifndef TAHR_THREADS_RECORD_H
#define TAHR_THREADS_RECORD_H

#include <stddef.h>

#include <tahr/sink.h>

#include "motion.h"

enum { TAHR__RECORD_STEP = 1, TAHR__RECORD_SNAPSHOT = 2, TAHR__RECORD_CHANGE = 3 };

/* The first word is what ring.h asks for: words, and no bit 63. */
typedef struct tahr__record {
    uint64_t words; /* of all of it */
    uint64_t epoch;
    uint32_t kind;  /* TAHR__RECORD_* */
    uint32_t parts; /* STEP: which messages, 1 << TAHR_MESSAGE_*; CHANGE: TAHR_CHANGE_* */
} tahr__record;

/* After it, as far as parts says so: the input, without its optional fields if its flags are 0; if there is a state or
 * a report: the motion, and the words of the rest of the state that changed since the last record of this character which
 * has any (words.h); the report; the events. */
typedef struct tahr__record_step {
    tahr__record head;
    uint32_t character, config;
    uint64_t step;
    uint64_t sequence[4]; /* of STATE, EVENT (the first one), INPUT, REPORT */
    int64_t time_ns, wall_ns;
    double dt;
    uint64_t ns;
    tahr_status status;
    uint32_t flags;
    uint64_t events;
} tahr__record_step;

/* After it: the state, as above. */
typedef struct tahr__record_snapshot {
    tahr__record head;
    uint32_t character, config;
    uint64_t step, sequence;
    int64_t time_ns;
} tahr__record_snapshot;

/* After it: count poses; of a snapshot then as many more, where the last motion began. */
typedef struct tahr__record_change {
    tahr__record head;
    uint64_t count, revision;
    double dt;
} tahr__record_change;

enum {
    TAHR__POSE_WORDS = sizeof(tahr_body_pose) / 8,
    TAHR__EVENT_WORDS = sizeof(tahr_event) / 8,
    TAHR__PACKED_STATE = TAHR__STATE_WORDS + 1, /* words, at most */
    TAHR__INPUT_WORDS = sizeof(tahr_input) / 8,
    TAHR__PLAIN_INPUT_WORDS = offsetof(tahr_input, facing) / 8, /* where no flag makes one of the others count */
    TAHR__REPORT_WORDS = sizeof(tahr_report) / 8
};

#endif
