/* SPDX-License-Identifier: MIT
 * replay_trace.h: a recorded run, repeated without its backend and its level. */
#ifndef TAHR_CLI_REPLAY_TRACE_H
#define TAHR_CLI_REPLAY_TRACE_H

#include <stdint.h>

/* What a replay found. */
struct replayed {
    uint64_t steps;  /* repeated, with the same state, status and queries */
    uint64_t custom; /* left out: they ran the caller's own mode */
    uint32_t movers;
    int whole;     /* 1: up to the end of the file */
    int differs;   /* 1: the next step did something else; */
    char how[320]; /* in words */
};

/* Repeats the run in a file. 0, or -1 after a message: no trace, or one that does not open; what is broken further on
 * leaves whole at 0, after a message. */
int replay_file(const char *path, struct replayed *replayed);

/* The same, said in words. Returns an exit code. */
int replay_trace(const char *path);

#endif
