/* SPDX-License-Identifier: MIT
 * wander.h: one character's aimless walk: a new heading every 0.5 to 2 s, now and then with a jump. */
#ifndef TAHR_CLI_WANDER_H
#define TAHR_CLI_WANDER_H

#include <tahr/tahr.h>

/* A stream of random numbers: PCG32. */
struct pcg {
    uint64_t state, increment;
};

struct wander {
    struct pcg random;
    double next_change; /* s */
    tahr_vec3 heading;
    int crouches; /* 1: may go crouched for the time of a heading */
    uint32_t crouch;
    int side; /* 1: two dimensions: left, right or nowhere, with jumps of any height, and down through platforms */
    double jump_until, drop_until;
};

void pcg_start(struct pcg *random, uint64_t seed, uint64_t stream);
uint32_t pcg_next(struct pcg *random);
double pcg_unit(struct pcg *random); /* in [0, 1) */

/* (cos, sin) of a fraction of a full turn in [0, 1), with the same bits on every machine. */
tahr_vec3 unit_vector(double turn);

void wander_start(struct wander *wander, uint64_t seed, uint32_t character);

/* Fills move, jump and crouch for the step that begins at time. 1: the heading is new. */
int wander_input(struct wander *wander, double time, tahr_input *input);

#endif
