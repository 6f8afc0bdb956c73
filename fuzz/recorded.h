/* SPDX-License-Identifier: MIT
 * recorded.h: a short recording over LCM, made once: two characters, a lift under one of them, and somebody who writes
 * to the other's state. */
#ifndef TAHR_FUZZ_RECORDED_H
#define TAHR_FUZZ_RECORDED_H

#include <stddef.h>
#include <stdint.h>
#include <tahr/tahr.h>

enum { RECORDED_CHARACTERS = 2, RECORDED_STEPS = 40 }; /* of each */

/* A message as it was published, but for the head of its event in a log. */
typedef struct recorded_message {
    char channel[64];
    uint8_t *data;
    size_t size;
} recorded_message;

typedef struct recorded {
    tahr_config config;
    recorded_message *messages;
    size_t count, capacity;
} recorded;

/* The world of the recording, as it was at its start. */
tahr_world *recorded_world(void);

/* Made at the first call; ends the program if that is not possible. */
const recorded *recorded_run(void);

#endif
