/* SPDX-License-Identifier: MIT
 * run.h: one variation of one family on one subject. */
#ifndef STABILITY_RUN_H
#define STABILITY_RUN_H

#include "family.h"
#include "subject.h"
#include "watch.h"

typedef struct run_request {
    const family *family;
    const subject *subject;
    uint32_t preset;
    uint64_t seed;
    int trace; /* print every step */
} run_request;

typedef struct outcome {
    accusation first; /* kept == 0: nothing broken */
    measure worst;
    uint64_t hash;            /* of all states */
    double took[TRIAL_STEPS]; /* s, of each step */
    int steps;
} outcome;

/* What else must go the same way, and how the ways are compared. */
struct twin {
    trial other;
    uint32_t with;                  /* of the first one, and */
    uint32_t without;               /* of the other one: WITHOUT_*, GATHERED */
    uint32_t pieces;                /* steps of the other for one of the first; 0: 1 */
    int in_step;                    /* 1: put where it should be before each step, so that only that step is compared */
    double tolerance;               /* m; 0: no bit may differ */
    double exactness;               /* of subject.gap, added to it */
    double ends;                    /* m: of where a floor ends, beyond what is promised of everything */
    double snap;                    /* m: grid that both are put on before each step; 0: none */
    tahr_vec3 rows[3];              /* how a vector of the first comes out in the other */
    tahr_quat turn;                 /* the same, of orientations; where bodies are turned */
    tahr_vec3 shift;                /* m, and a place */
    double scale;                   /* and a length */
    int (*ready)(const subject *s); /* NULL: for all; where this relation is promised */
};

/* Whether the subject can run the family, and why not. */
int run_possible(const family *f, const subject *s, uint32_t preset, const char **why);

void run(const run_request *request, outcome *out);

/* s, of its slowest step; step may be NULL. */
double outcome_slowest(const outcome *out, int *step);

/* Identity. */
void twin_begin(twin *w, const trial *t);

#endif
