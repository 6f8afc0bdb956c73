/* SPDX-License-Identifier: MIT
 * writer.h: a trace being written. */
#ifndef TAHR_TRACE_WRITER_H
#define TAHR_TRACE_WRITER_H

#include "format.h"

#include <stdio.h>

typedef struct tahr__trace_mover {
    tahr_input input; /* of its last step */
    tahr_state after; /* what that left */
} tahr__trace_mover;

struct tahr_trace {
    FILE *file;
    tahr_trace_write_fn write;
    void *user;
    tahr_log log;
    uint32_t flags;
    tahr_status status; /* negative: nothing is written any more */
    tahr_recorder recorder;
    tahr_backend table; /* that records; in front of */
    const tahr_backend *inner;
    void *inner_self;
    uint32_t derived; /* 1: contacts are made of sweeps, each of which counts */
    tahr__trace_mover *movers;
    uint32_t mover_count, mover_room;
    uint32_t block; /* number of the one being filled */
    uint32_t in_step, began;
    uint64_t steps, queries, bytes;
    tahr__trace_bases bases;
    tahr__trace_bytes out;
    unsigned char buffer[TAHR__TRACE_BUFFER];
};

/* Begins a record: writes the block before if it is full. Returns 0 if nothing can be recorded. */
int tahr__trace_begin(tahr_trace *trace, uint32_t tag);
/* Gives up recording, with a message. */
void tahr__trace_give_up(tahr_trace *trace, tahr_status status, const char *why);
/* Writes what is buffered. */
void tahr__trace_flush(tahr_trace *trace);

/* wrap.c: the table that asks inner and records. */
void tahr__trace_wrap(tahr_trace *trace);

#endif
