/* SPDX-License-Identifier: MIT
 * watch.h: what must hold after every step, each with a number and its bound. */
#ifndef STABILITY_WATCH_H
#define STABILITY_WATCH_H

#include "judge.h"

enum { WATCH_EVENTS = 64 };

/* A broken promise: the first one of a run. */
typedef struct accusation {
    uint32_t kept; /* the KEEPS_* that was not; 0: none */
    int step;
    double value, bound;
    char text[192];
} accusation;

/* The worst of a run, whatever was expected. */
typedef struct measure {
    double deepest;   /* m, farthest below what had to stay free; >= 0 */
    double apart;     /* m, farthest that twins came apart in a step, or in all */
    double used;      /* the largest part of a bound that was used up */
    uint32_t queries; /* most of a step */
    uint32_t steps, walking, errors;
} measure;

typedef struct watch {
    const trial *trial;
    const judge *judge;
    uint32_t keeps;
    int honest;   /* errors are failures */
    double exact; /* m, what the backend's answers may be off */
    int moves;    /* something does */
    accusation first;
    measure worst;
    tahr_pose poses[2][TRIAL_BODIES]; /* of the bodies: before and in this step */
    int idle, still, hanging, landed; /* steps in a row */
    tahr_vec3 held;
    double gap; /* m, after the last step */
    int gap_known;
} watch;

/* gap: m that the backend's answers may be off. */
void watch_begin(watch *w, const trial *t, const judge *j, uint32_t keeps, int honest, double gap);
/* The bodies are at these poses from now on. */
void watch_move(watch *w, const tahr_pose *poses);
/* teleported: bodies that jumped (bits). */
void watch_step(watch *w, int step, tahr_status status, const tahr_state *before, const tahr_state *now,
                const tahr_report *report, uint64_t teleported);
/* Says that something is broken, unless something was before. */
void watch_accuse(watch *w, uint32_t kept, int step, double value, double bound, const char *what);

const char *watch_name(uint32_t kept);

#endif
