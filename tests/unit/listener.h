/* SPDX-License-Identifier: MIT
 * listener.h: a sink for tests: it counts, watches the sequences, may fail, and may be made to wait. */
#ifndef LISTENER_H
#define LISTENER_H

#include <pthread.h>
#include <stdatomic.h>

#include <tahr/telemetry.h>

enum { LISTENER_CHARACTERS = 16 };

typedef struct listener {
    tahr_sink sink; /* all functions; take away what is not wanted before tahr_telemetry_create */
    /* A test's own look at messages; NULL: none. It runs on the telemetry's thread: say what is wrong by
     * listener_expect, not by an assertion. */
    void *test;
    void (*on_state)(void *test, const tahr_stamp *stamp, const tahr_state *state);
    void (*on_event)(void *test, const tahr_stamp *stamp, const tahr_event *event);
    void (*on_input)(void *test, const tahr_stamp *stamp, const tahr_sink_input *input);
    void (*on_report)(void *test, const tahr_stamp *stamp, const tahr_sink_report *report);
    void (*on_snapshot)(void *test, const tahr_stamp *stamp, const tahr_state *state);
    void (*on_change)(void *test, const tahr_sink_change *change);
    void (*on_world)(void *test, const tahr_sink_world *world);
    uint64_t got[TAHR_MESSAGE_COUNT];                       /* calls */
    uint64_t missed[TAHR_MESSAGE_COUNT];                    /* numbers left out of the sequences */
    uint64_t next[TAHR_MESSAGE_COUNT][LISTENER_CHARACTERS]; /* number expected */
    uint64_t failed[TAHR_MESSAGE_COUNT];
    uint64_t flushes;
    uint32_t fail_every;         /* every n-th message fails; 0: none */
    uint32_t calls;              /* for that */
    _Atomic(const char *) wrong; /* what was expected first of all that was not so; NULL: nothing */
    pthread_mutex_t lock;
    pthread_cond_t changed;
    int closed, inside; /* by the lock */
} listener;

void listener_init(listener *l, void *test);
void listener_end(listener *l);

/* A description with this sink, one config and the number of characters. */
void listener_describe(listener *l, uint32_t characters, tahr_telemetry_desc *desc);

/* Calls of the sink wait while it is closed. */
void listener_close(listener *l);
void listener_open(listener *l);
/* Waits until a call is waiting. */
void listener_wait_for_call(listener *l);

void listener_expect(listener *l, int condition, const char *what);

/* A step of a made-up character: a few words of its state, its input and its report are others. */
typedef struct made_up {
    tahr_state state;
    tahr_input input;
    tahr_report report;
    tahr_event events[4];
    uint64_t random;
} made_up;

void made_up_init(made_up *m, uint64_t seed);
uint64_t made_up_number(made_up *m);
void made_up_change(made_up *m); /* the state alone, a word of it */
void made_up_step(made_up *m);
tahr_telemetry_step made_up_pushed(const made_up *m, uint32_t character);

#endif
