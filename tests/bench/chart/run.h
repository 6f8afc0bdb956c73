/* SPDX-License-Identifier: MIT
 * run.h: one run of the program: how much is measured, where rows go, how far it is, and the clocks. */
#ifndef TAHR_CHART_RUN_H
#define TAHR_CHART_RUN_H

#include "row.h"

/* How much is measured. TINY only shows that everything works. */
typedef struct chart_budget {
    const char *name;
    uint32_t sweep_rounds;   /* times every sweep is asked for its time */
    uint32_t sweep_stride;   /* every so manieth case of the truth */
    uint32_t slide_stride;   /* every so manieth slide of the truth */
    uint32_t windows;        /* pieces of a walk that are compared with their reference */
    uint32_t walkers;        /* that a step is timed with */
    double walk_seconds;     /* simulated, timed, by every walker */
    uint32_t max_characters; /* of the crowds */
    uint32_t max_triangles;  /* of the scenes */
    double slow;             /* of walk_seconds, where a step takes tens of microseconds */
} chart_budget;

extern const chart_budget CHART_TINY, CHART_QUICK, CHART_FULL;

/* A family is run twice: first it counts its points, so that there is a bar of all of them. */
typedef struct chart_run {
    const chart_budget *budget;
    const char *family; /* whose rows are written */
    FILE *csv;
    FILE *bar; /* NULL: none */
    int lines; /* the bar is no terminal: a line now and then */
    int counting;
    uint32_t done, total;
    double started; /* s, of the monotonic clock */
    int failed;     /* something could not be measured: said on stderr */
} chart_run;

/* One more point, of this name. Returns 0 if it is only counted. */
int chart_run_next(chart_run *run, const char *scene, const char *name);

void chart_run_write(chart_run *run, const chart_row *row);

/* Says on stderr what could not be measured, and why. */
void chart_run_fail(chart_run *run, const char *what, const char *why);

/* Says that something is not there to be measured, which is no failure. */
void chart_run_skip(chart_run *run, const char *what, const char *why);

/* s, of the processor time of this thread, and of the monotonic clock; ns that reading the latter twice adds. */
double chart_processor(void);
double chart_monotonic(void);
double chart_clock_cost(void);

/* The families. */
void chart_sweeps(chart_run *run);
void chart_movement(chart_run *run);
void chart_shortcuts(chart_run *run);
void chart_crowds(chart_run *run);
void chart_scenes(chart_run *run);

/* What this machine is, "key,value" a line. */
void chart_machine(FILE *csv);

#endif
