/* SPDX-License-Identifier: MIT
 * feed.h: what a run publishes over LCM while it goes on: a telemetry, and the sink that takes it there. */
#ifndef TAHR_CLI_FEED_H
#define TAHR_CLI_FEED_H

#include "moment.h"

#include <tahr/sink.h>

struct feed;

/* Where --lcm asks for it; *feed stays NULL where it does not, or (after a message) where the network is not there: the
 * run goes on without it. -1: said why that cannot be meant. */
int feed_open(struct run *run, struct feed **feed);

/* Delivers what is left, and writes into the run's result what became of it all. */
void feed_close(struct run *run, struct feed *feed);

/* The rest does nothing without a feed. */

/* Before all of a tick that begins at a time, s: to a network it waits for the wall clock, else for who takes what the
 * last ticks told, so that nothing is dropped. */
void feed_wait(struct feed *feed, double time);

/* After the run's bodies were moved. */
void feed_bodies(struct feed *feed, const struct run *run);

/* Before and after a step of a character. status: of the step; ns: how long it took, or 0; flags: TAHR_STEP_*. */
void feed_begin(struct feed *feed, uint32_t character, const tahr_state *state);
void feed_step(struct feed *feed, const struct run *run, const struct moment *moment, tahr_status status, uint64_t ns,
               uint32_t flags);

#endif
