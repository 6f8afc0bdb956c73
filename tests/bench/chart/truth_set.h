/* SPDX-License-Identifier: MIT
 * truth_set.h: sweeps with their stored truth (tests/accuracy/truth), grouped, and how wrong an answer is. */
#ifndef TAHR_CHART_TRUTH_SET_H
#define TAHR_CHART_TRUTH_SET_H

#include <tahr/tahr.h>

enum { CHART_TRUTH_SETS = 6 };

typedef struct chart_truth_set chart_truth_set;

/* What an answer is: right but for error, or one of the failures. */
typedef enum chart_verdict {
    CHART_FREE, /* both say free: no error to measure */
    CHART_HIT,
    CHART_MISSED,
    CHART_FALSE_HIT,
    CHART_WRONG_NORMAL, /* more than 2 degrees outside of all that are right there */
    CHART_GAVE_UP       /* unknown, an error, a number that is none */
} chart_verdict;

/* Reads every stride-th case of a group: capsules and spheres against "triangles", "meshes", "convex" bodies and what
 * is "hard", "boxes" against all of them, or all shapes in a plane, "outlines". NULL: out of memory. */
chart_truth_set *chart_truth_load(int set, uint32_t stride);
void chart_truth_free(chart_truth_set *set);

const char *chart_truth_name(int set);
uint32_t chart_truth_count(const chart_truth_set *set);
const tahr_sweep *chart_truth_sweep(const chart_truth_set *set, uint32_t i);

/* Whether a group happens in the plane, where backends of two dimensions are asked too. */
int chart_truth_planar(int set);

/* The body of a case, for backends of two dimensions or of three; same is 1 where it is that of the case before. */
const tahr_body_desc *chart_truth_body(const chart_truth_set *set, uint32_t i, int planar, int *same);

/* Judges an answer backward: error, m, is how far from the margin (or, overlapping from the start, from the depth) the
 * shape is where it was stopped. A miss or a false hit counts beyond 1 um of distance, for ways beyond a metre a
 * millionth of the way, at most 0.1 mm: closer than that it is a matter of rounding. */
chart_verdict chart_truth_judge(const chart_truth_set *set, uint32_t i, tahr_status status, const tahr_hit *hit,
                                uint32_t count, double *error);

#endif
