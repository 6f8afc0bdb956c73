/* SPDX-License-Identifier: MIT
 * subject.h: what is put to the trials: backends, callbacks, liars, and (in tests) mutants. */
#ifndef STABILITY_SUBJECT_H
#define STABILITY_SUBJECT_H

#include "trial.h"

typedef struct subject {
    const char *name;
    uint32_t worlds;      /* IN_*: where it can be asked at all */
    const char *not_here; /* why not in the others */
    uint32_t keeps;       /* KEEPS_*: what may be expected of it; liars: KEEPS_SANE */
    uint32_t lie;         /* LIE_*: of a liar; its errors are no failures */
    uint32_t mutant;      /* of tests: which one, or 0 */
    int judged;           /* 1: a liar that is judged as if it were honest, so that tests see it fail */
    double gap;           /* m, what an answer may be off, for twins in other places */
    int kind;             /* of subject.c */
    uint32_t engine;      /* which Box2D */
} subject;

/* What may be switched off without changing a bit. */
enum { WITHOUT_CACHE = 1, WITHOUT_LANES = 2, WITHOUT_CACHED_FLOOR = 4, WITHOUT_SLEEP = 8, WITHOUT_SHORT_WAYS = 16 };

/* Native: triangles come from a gather callback; times ORDERED_BY: in an order drawn from that number. */
enum { GATHERED = 32, ORDERED_BY = 64 };

/* Behind a gather callback. */
typedef struct gathered {
    const trial *trial;
    uint32_t order; /* 0: as they stand in the trial */
} gathered;

typedef struct opened {
    const subject *subject;
    gathered gathered;
    tahr_log log;
    tahr_world *world;
    tahr_world *bodies; /* the one whose bodies are moved: behind callbacks another one */
    tahr_mover *mover;
} opened;

/* The subjects of this build, ended by one without a name. */
extern const subject SUBJECTS[];
int subject_count(void);
const subject *subject_named(const char *name);

/* A mutant, and a liar, judged as if they were honest. */
subject subject_mutant(uint32_t which);
subject subject_judged(const char *liar);

/* Beside TAHR_CAP_*: the slot for fluids. */
enum { NEEDS_FLUIDS = 1 << 30 };

/* TAHR_CAP_* and that, of its backend. */
uint32_t subject_capabilities(const subject *subject);

typedef struct subject_request {
    const subject *subject;
    const trial *trial;
    uint32_t without; /* WITHOUT_*, GATHERED */
    uint64_t seed;    /* of lies */
    int loud;         /* 1: what the library complains about is printed */
} subject_request;

/* o and the trial must stay where they are until it is closed. */
tahr_status subject_open(const subject_request *request, opened *o);
void subject_close(opened *o);
tahr_status subject_move(opened *o, const tahr_body_pose *poses, uint32_t count, double dt);

#endif
