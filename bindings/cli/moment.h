/* SPDX-License-Identifier: MIT
 * moment.h: a run under way, and one step of one character in it, for everything that looks at it. */
#ifndef TAHR_CLI_MOMENT_H
#define TAHR_CLI_MOMENT_H

#include "check.h"
#include "progress.h"
#include "route.h"
#include "run.h"
#include "wander.h"

#include <stdio.h>
#include <tahr/trace.h>

struct character {
    tahr_state state;
    tahr_mover *mover;
    tahr_vec3 spawn;
    struct wander wander;
    struct progress progress;
};

struct run {
    const struct options *options;
    struct level level;
    tahr_world *world;
    tahr_config config;
    struct character *characters;
    tahr_body_pose *poses; /* of the level's movers */
    struct route route;
    struct checker *checker; /* NULL: off */
    struct track track;
    FILE *csv;         /* or NULL */
    tahr_trace *trace; /* or NULL */
    struct feed *feed; /* or NULL */
    uint64_t step_count;
    double dt;
    struct result result;
};

/* One step of one character, for everything that looks at it. */
struct moment {
    uint64_t step;
    uint32_t index;
    double time; /* s, at the start of the step */
    tahr_vec3 before;
    uint32_t flags_before; /* of the state */
    tahr_shape shape_before;
    tahr_input input;
    int heading_is_new;
    tahr_report report; /* its events are those of the step */
};

/* Puts a character where it started. */
void moment_place(struct run *run, struct character *character, double time);

/* Counts, checks and writes down the step that was just made; brings back who left the level. */
void moment_watch(struct run *run, const struct moment *m, struct character *character);

#endif
