/* SPDX-License-Identifier: MIT
 * matrix.h: families against subjects and presets, many variations a cell, in processes of their own: what crashes or
 * hangs costs one cell. POSIX. */
#ifndef STABILITY_MATRIX_H
#define STABILITY_MATRIX_H

#include "run.h"

enum { MATRIX_PRESETS = 3, MATRIX_JOBS = 64 }; /* JOBS: the most */

enum { CELL_OPEN, CELL_DONE, CELL_NOT_POSSIBLE, CELL_CRASHED, CELL_HUNG };

typedef struct cell {
    const family *family;
    const subject *subject;
    uint32_t preset;
    int what;                        /* CELL_* */
    const char *why;                 /* NOT_POSSIBLE */
    uint32_t runs, failures, insane; /* insane: of the failures, those of what lies may not do either */
    uint64_t seed;                   /* of the run under way; CRASHED, HUNG: of the last */
    uint64_t first_seed;
    accusation first;
    measure worst;  /* deepest, apart, used, queries: of all; steps, walking, errors: their sums */
    double slowest; /* s, a step: of the slowest runs, each the fastest of some repetitions */
} cell;

typedef struct matrix_request {
    const char *family, *subject; /* names; NULL: all */
    uint32_t preset;              /* 0: all */
    uint32_t seeds;               /* a cell */
    uint64_t first_seed;
    int jobs;  /* processes */
    int timed; /* 1: the slowest runs are repeated, so that the clock tells of them and not of the machine */
    int quiet; /* 1: prints nothing while it runs */
} matrix_request;

typedef struct matrix {
    cell *cells; /* family by family, in it subject by subject, in it preset by preset */
    uint32_t count;
    int subjects;
    int families;
} matrix;

/* done is called with each family whose cells are all done, in order; may be NULL. Returns 0 and says why (capacity
 * 256). */
int matrix_run(matrix *m, const matrix_request *request, void (*done)(const matrix *m, int row), char *why);
void matrix_free(matrix *m);

const cell *matrix_cell(const matrix *m, int row, int column, uint32_t preset);

/* Whether it keeps what is asked of it: 1 clean, 0 broken. sane: what even lies may not break. */
int cell_clean(const cell *c);
int cell_sane(const cell *c);

#endif
