/* SPDX-License-Identifier: MIT
 * reader.h: a trace being read. */
#ifndef TAHR_TRACE_READER_H
#define TAHR_TRACE_READER_H

#include "format.h"

#include <stdio.h>

/* One query as it was recorded, with its answer. */
typedef struct tahr__trace_query {
    uint32_t kind, body, capacity, count, kept;
    tahr_status status;
    tahr_sweep sweep;
    tahr_contact_query contacts;
    tahr_ray ray;
    tahr_fluid_query fluid;
    tahr_fluid fluid_answer;
    tahr_body_motion motion;
    tahr_query_context cost; /* what it added */
    tahr_hit hits[TAHR__TRACE_ANSWERS];
    tahr_contact found[TAHR__TRACE_ANSWERS];
} tahr__trace_query;

struct tahr_trace_reader {
    FILE *file;
    tahr_trace_read_fn read;
    void *user;
    tahr_log log;
    tahr_status status; /* negative: the file is broken here */
    tahr_recorder recorder;
    tahr_backend table; /* that answers */
    char name[64], version[64];
    uint32_t capabilities, slots;
    tahr_record_world world;
    tahr_record_body *bodies;
    tahr_input *inputs; /* of each mover, the last one */
    uint32_t mover_count, mover_room;
    tahr_body_pose *poses;
    uint32_t pose_room;
    uint32_t tag;     /* of the record that begins at in.at; 0: not looked at yet */
    uint32_t in_step; /* 0, 1, 2: custom */
    uint32_t mover;   /* of that step */
    uint32_t asked;   /* queries of it */
    uint64_t steps;
    uint64_t offset; /* of the bytes of the block, in the file */
    uint32_t block;
    uint32_t differs; /* 1: difference says how */
    char difference[240];
    tahr_input input;
    tahr_config config;
    tahr_state state;
    tahr__trace_query query;
    tahr__trace_bases bases;
    tahr__trace_bytes in;
    unsigned char buffer[TAHR__TRACE_BUFFER];
};

/* Says what was expected at the byte that is read next; the reader is of no use from then on. Returns TAHR_E_FILE. */
tahr_status tahr__trace_broken(tahr_trace_reader *reader, const char *expected);
/* The kind of the next record, from the next block if this one is over; 0: the file is broken. */
uint32_t tahr__trace_peek(tahr_trace_reader *reader);
/* Reads the record of a query that peek has seen; reader->query holds it. */
tahr_status tahr__trace_take_query(tahr_trace_reader *reader);

/* The head of the file and all that is known of the world before its first step. */
tahr_status tahr__trace_read_begin(tahr_trace_reader *reader);
/* Has everything been read? */
int tahr__trace_is_over(tahr_trace_reader *reader);
/* Memory with room for one more than count; grows with what is really there, not with what a file announces. NULL:
 * there is none, and the old one stays. */
void *tahr__trace_grow(void *memory, uint32_t count, uint32_t *room, size_t size);

/* answers.c: fills in table and recorder. */
void tahr__trace_answer(tahr_trace_reader *reader);

#endif
