/* SPDX-License-Identifier: MIT
 * recording.h: traces in memory, and a replay of one. */
#ifndef RECORDING_H
#define RECORDING_H

#include <tahr/tahr.h>
#include <tahr/trace.h>

/* A file in memory. chunk: at most so many bytes are taken or given at a time; 0: all. fail_at: writing fails when it
 * would grow beyond so many bytes; 0: never. */
typedef struct recording {
    unsigned char *bytes;
    size_t size, room, at, chunk, fail_at;
    char message[512];   /* the last one of the trace or its reader, */
    char complaint[512]; /* and of the replay's world */
    int messages;
} recording;

void recording_free(recording *r);

/* Begins to record a world. */
tahr_trace *recording_begin(recording *r, tahr_world *world, uint32_t flags);
/* Ends it. Returns what tahr_trace_close returned. */
tahr_status recording_end(tahr_trace *trace, tahr_world *world);

/* Sums of what reports count: sweeps, contact queries, rays, fluid queries, triangle tests, narrow iterations, gathers,
 * escapes, and what each shortcut saved; and a hash of each step's, in order. */
enum { RECORDING_COUNTS = 8 + TAHR_SHORTCUT_COUNT };
typedef struct recording_counts {
    uint64_t sum[RECORDING_COUNTS];
    uint64_t hash;
} recording_counts;

void recording_count(recording_counts *counts, const tahr_report *report);

/* What a replay found. */
typedef struct replay {
    tahr_status opened;     /* of tahr_trace_read, and of everything before the first event */
    tahr_status read;       /* of the last tahr_trace_next */
    uint64_t steps, custom; /* repeated; left out */
    uint64_t moves;
    int ended;          /* the end of the file was reached */
    int differs;        /* a step was not the recorded one */
    char how[256];      /* the difference of a query, or "" */
    tahr_status status; /* of the last step */
    tahr_state state;   /* of the last mover, after it */
    recording_counts counts;
    double speed_factor; /* in: of config.max_speed, to repeat something else; 0: 1 */
} replay;

/* Repeats what is in the file, from its begin. */
void replay_run(replay *p, recording *r);

#endif
