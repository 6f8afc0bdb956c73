/* SPDX-License-Identifier: MIT
 * trace.h: which decisions a test expects to see in the traces of its steps, and which it saw. */
#ifndef TRACE_H
#define TRACE_H

#include "rig.h"

typedef struct trace_row {
    uint32_t rule, accepted;
    const char *reason;
    uint32_t seen; /* times */
} trace_row;

typedef struct trace {
    trace_row *rows;
    int count;
} trace;

/* Counts the decisions of the last step; fails the test on one that is not well-formed. */
void trace_note(trace *t, const rig *r);
/* One step at 60 Hz, noted; or n of them with this wish. */
void trace_step(trace *t, rig *r);
void trace_steps(trace *t, rig *r, int n, tahr_vec3 move);
/* Fails the test unless every row was seen, and every rule from first to last is in a row. */
void trace_check(const trace *t, uint32_t first, uint32_t last);

#endif
