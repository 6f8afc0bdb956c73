/* SPDX-License-Identifier: MIT
 * throng.h: all characters of a run in one step (crowd.h): on several threads, or as obstacles of each other. */
#ifndef TAHR_CLI_THRONG_H
#define TAHR_CLI_THRONG_H

#include "moment.h"

struct throng;

/* Where the options ask for it; *throng stays NULL where they do not. -1: said why not. */
int throng_open(struct run *run, struct throng **throng);
void throng_close(struct throng *throng);

/* One step of all, watched. -1: said why it could not go on. */
int throng_step(struct run *run, struct throng *throng, uint64_t step, double time);

/* The input of one character for the step that begins at m->time. */
void throng_input(struct run *run, struct moment *m);

#endif
