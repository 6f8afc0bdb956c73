/* SPDX-License-Identifier: MIT
 * row.h: one measured point of a chart, and the CSV that it is written to. All families have the same columns. */
#ifndef TAHR_CHART_ROW_H
#define TAHR_CHART_ROW_H

#include <stdint.h>
#include <stdio.h>

/* What a setting is there for, beside its place on a chart: only a KNOB that is never on a front is a candidate to go.
 * DEFAULT: what a preset has. OFF: the off switch of a shortcut. PARITY: another library's behaviour, to move alike.
 * ONLY: all that its backend, or the engine under it, can do. DEFINITION: what is right changes with it, so that it has
 * no place on a front. */
#define CHART_DEFAULT "default"
#define CHART_KNOB "knob"
#define CHART_OFF "off"
#define CHART_PARITY "parity"
#define CHART_ONLY "only"
#define CHART_DEFINITION "definition"

/* NAN: not measured, an empty field. SI units, nanoseconds where the name says so. */
typedef struct chart_row {
    const char *scene;   /* what is moved through or asked about: one panel */
    const char *curve;   /* the method: one line */
    const char *setting; /* the point's name */
    const char *role;
    const char *reference; /* what errors are measured against */
    char why[128];         /* what the failures were */
    double value;          /* of the knob: the order along the curve */
    double rate;           /* Hz, of the steps */
    uint64_t samples, failed;
    double error_p50, error_p99, error_max; /* m */
    double penetration;                     /* m, deepest */
    double ns_p50, ns_p99, ns_mean;         /* per call: a sweep or a step */
    double ns_second;                       /* per simulated second */
    double queries, tests, iterations;      /* per call */
    double saved;                           /* per call, by the shortcut of the row: see TAHR_SHORTCUT_TABLE */
    double bytes;                           /* of the world, per triangle */
    double build_seconds;
    double threads;
} chart_row;

/* Everything empty. */
void chart_row_clear(chart_row *row);

void chart_row_head(FILE *csv);
void chart_row_write(FILE *csv, const char *family, const chart_row *row);

/* What errors are distributed like; sorts them. None: NAN. */
void chart_row_errors(chart_row *row, double *errors, uint32_t count);

#endif
