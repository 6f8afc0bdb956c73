/* SPDX-License-Identifier: MIT
 * score.h: how wrong sweeps and paths are, scored backward: not by the distance of an answer from the one number that
 * truth has (a graze has no stable time of impact), but by what the answer itself implies: how far from the margin the
 * shape is where the answer stops it, how far the normal lies outside of all those that are right there. Failures are
 * counted apart and never averaged in. Everything is judged by a distance of its own, in long double, relative to the
 * place that is asked about, so that a far origin costs no digits. SI units, degrees for angles. Nothing here is shared
 * with the library but its plain data. Not for several threads at once on one accumulator. */
#ifndef TAHR_ACCURACY_SCORE_H
#define TAHR_ACCURACY_SCORE_H

#include <tahr/report.h>
#include <tahr/state.h>
#include <tahr/types.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Values to be summed up: mean, quantiles, extremes. Zero is empty. Values that are not finite are counted only. */
typedef struct score_stat {
    double *values;
    uint32_t count, capacity;
    uint32_t not_finite;
    uint32_t sorted;
    double sum, sum_of_squares, min, max;
} score_stat;

void score_stat_add(score_stat *stat, double value); /* aborts without memory */
void score_stat_merge(score_stat *stat, const score_stat *other);
/* The smallest value that at least a part q (0..1) of all is not above; 0 of none. */
double score_stat_quantile(score_stat *stat, double q);
double score_stat_mean(const score_stat *stat); /* 0 of none */
double score_stat_rms(const score_stat *stat);
void score_stat_free(score_stat *stat);

/* What is there: triangles that block from both sides or, with SOLID, the boundary of a convex solid, counter-clockwise
 * seen from outside. World frame. The arrays stay the caller's. Shapes that can be judged: spheres, capsules, boxes. */
enum { SCORE_SOLID = 1 };
typedef struct score_body {
    const double *vertices;  /* 3 each */
    const uint32_t *indices; /* 3 each */
    uint32_t vertex_count, triangle_count;
    uint32_t flags; /* SCORE_SOLID */
    uint32_t reserved;
} score_body;

typedef struct score_scene {
    const score_body *bodies;
    uint32_t body_count;
} score_scene;

/* Signed distance of the shape at a fraction of the motion from everything; where its core (point, segment, whole box)
 * is in something: minus its radius. Bodies further than reach (m) need not be looked at: the answer is then any number
 * not below reach. Infinite without bodies. */
double score_distance(const score_scene *scene, const tahr_sweep *query, double fraction, double reach);

/* Degrees between a direction and the nearest one of the cone that all directions span in which something is closest:
 * within slack (m) of the smallest distance. 180 if there is none. */
double score_normal_error(const score_scene *scene, const tahr_sweep *query, double fraction, double slack,
                          tahr_vec3 normal);

/* ---- Sweeps ---- */

enum { SCORE_FREE = 0, SCORE_HIT = 1, SCORE_OVERLAP = 2 };

/* What is true of a sweep. start_gap: signed distance at the start; min_gap: smallest distance along the whole motion,
 * less the margin (an upper bound where nothing is in reach). */
typedef struct score_truth {
    uint32_t status; /* SCORE_FREE, _HIT, _OVERLAP */
    uint32_t reserved;
    double start_gap, fraction, min_gap;
    tahr_vec3 start_normal, normal;
} score_truth;

/* Finds the truth of a sweep on the spot, in long double: convexity, golden section, bisection. About 200 distances for
 * each triangle in reach. Returns 0 where there is nothing sure to judge by: the core touches something at the start (no
 * unique way out), or what is within the margin at the start goes on as another face that bends the motion. */
int score_solve(const score_scene *scene, const tahr_sweep *query, score_truth *truth);

/* What can go wrong, each counted apart. MISS: went through what it should have met. FALSE_HIT: stopped by nothing.
 * START: overlap at the start where there is none, or the other way round. CAP: a query cap or an array that was full.
 * STUCK, CRUSHED: as the step reported. */
enum {
    SCORE_MISS = 0,
    SCORE_FALSE_HIT = 1,
    SCORE_START = 2,
    SCORE_NOT_FINITE = 3,
    SCORE_ERROR = 4, /* an error status */
    SCORE_UNKNOWN = 5,
    SCORE_CAP = 6,
    SCORE_STUCK = 7,
    SCORE_CRUSHED = 8,
    SCORE_FAILURES = 9,
    SCORE_FINE = -1
};

const char *score_failure_name(int failure); /* "miss"; "?" for none of them. Static memory. */

/* tau, m: how far beyond the margin truth must be for hit or miss to be no matter of rounding. */
enum { SCORE_TAUS = 2 };
extern const double SCORE_TAU[SCORE_TAUS]; /* 1e-6, 1e-3 */

/* One answer judged. gap_error, normal_error, distance_error, point_error count only where measured is 1. */
typedef struct score_answer {
    int32_t failure;       /* SCORE_*, at the smaller tau */
    uint32_t measured;     /* a hit where there is one */
    double beyond;         /* m: of a MISS, FALSE_HIT or START: how far beyond the margin truth is; else 0 */
    double gap_error;      /* m: distance at the stop less what it should be there; negative: too near, stopped late */
    double normal_error;   /* degrees outside of the normal cone at the stop */
    double distance_error; /* m: of hit.distance (SCORE_OVERLAP: of hit.depth), absolute */
    double point_error;    /* m: distance of hit.point from the surface */
} score_answer;

/* Judges one answer: the status of the query, and its first hit if count is not 0. slack (m): how near to the smallest
 * distance a surface counts as closest for the normal; twice the gap error that is allowed. */
score_answer score_sweep(const score_scene *scene, const tahr_sweep *query, const score_truth *truth,
                         tahr_status status, const tahr_hit *hit, uint32_t count, double slack);

/* Many of them. Zero is empty. */
typedef struct score_sweeps {
    score_stat gap, normal; /* absolute gap error, m; degrees */
    double late, early;     /* m, the worst, each >= 0 */
    double distance, point; /* m, the worst */
    uint32_t cases;
    uint32_t failures[SCORE_FAILURES];
    uint32_t misses[SCORE_TAUS], false_hits[SCORE_TAUS];
    double deepest_miss; /* m beyond the margin */
} score_sweeps;

void score_sweeps_add(score_sweeps *sweeps, const score_answer *answer);
void score_sweeps_free(score_sweeps *sweeps);

/* ---- Paths ---- */

/* A path to compare with: knots in order of time, a cubic with their velocities between two of them (which is exact for
 * straight pieces and for parabolas); a bend is two knots of one time. */
typedef struct score_knot {
    double time; /* s */
    tahr_vec3 position, velocity;
} score_knot;

typedef struct score_reference {
    const score_knot *knots;
    uint32_t count;
} score_reference;

/* Where the path is at a time; before its first and after its last knot: there. */
tahr_vec3 score_reference_at(const score_reference *reference, double time);

/* A character after a step, whoever moved it. */
typedef struct score_step {
    double time;        /* s since the start, at the end of the step */
    tahr_sweep place;   /* shape, position, up, orientation; motion zero */
    tahr_vec3 velocity; /* m/s */
    double work;        /* J/kg that was put in during the step; 0: nothing drives it */
    uint32_t failures;  /* bits 1 << SCORE_*: what the step itself reports */
    uint32_t grounded;  /* stands on something walkable, as the mover itself says */
    uint32_t idle;      /* nothing is asked for: it should rest */
    uint32_t queries;   /* of the step */
    uint32_t reserved[2];
} score_step;

/* What a path is held against. reference and scene may be NULL: then those figures are not taken. */
typedef struct score_path_desc {
    const score_reference *reference;
    const score_scene *scene;
    double reach;      /* m: distances beyond it are not looked for; 0: 1 m */
    tahr_vec3 gravity; /* m/s2, for the energy */
} score_path_desc;

/* Figures of one path. Zero it, set desc, add the start and then every step. */
typedef struct score_path {
    score_path_desc desc;
    score_stat error;      /* m from the reference, of every step: max and score_stat_rms over time */
    score_stat queries;    /* per step: mean, p99, max */
    double end_error;      /* m, of the last step */
    double deepest;        /* m, deepest penetration, >= 0 */
    double clearance;      /* m, least signed distance; INFINITY if never measured */
    double energy_excess;  /* J/kg, most above what the lowest energy before and the work since allow */
    double length;         /* m, of the path itself */
    uint32_t ground_flips; /* times that standing began or ended */
    double jitter;         /* m, largest second difference of the position at rest, from the third idle step on */
    uint32_t rest_changes; /* idle steps after the third that changed a bit of the position */
    uint32_t steps;        /* without the start */
    double duration;       /* s */
    uint32_t failures[SCORE_FAILURES]; /* steps */
    uint32_t failed_steps;             /* steps with at least one of them */

    uint32_t started, idle_steps, stood, reserved; /* what goes on from step to step */
    double surplus;
    score_step last, before;
} score_path;

void score_path_start(score_path *path, const score_path_desc *desc, const score_step *start);
void score_path_add(score_path *path, const score_step *step);
double score_path_flips_per_second(const score_path *path);
void score_path_free(score_path *path);

/* A step of Tahr's as score_path takes it: after tahr_mover_step with this status and report (or NULL); shape:
 * config.shape, whose radius and half height are then the state's. work and idle are the caller's to set. Velocity:
 * relative to a base, as the state has it. */
score_step score_step_of(const tahr_state *state, const tahr_shape *shape, double time, tahr_status status,
                         const tahr_report *report);

#ifdef __cplusplus
}
#endif
#endif
