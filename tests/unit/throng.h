/* SPDX-License-Identifier: MIT
 * throng.h: a crowd on the native backend, its arrays, and an independent look at how near its characters are. */
#ifndef THRONG_H
#define THRONG_H

#include <tahr/native.h>
#include <tahr/tahr.h>

typedef struct throng {
    tahr_world *world;
    tahr_crowd *crowd;
    tahr_config config;
    tahr_crowd_desc desc; /* of the crowd; set what is needed before throng_make */
    tahr_crowd_tick tick;
    uint32_t count;
    tahr_member *members;
    tahr_input *inputs;
    tahr_state *states, *before; /* before: the last tick */
    tahr_report *reports;
    tahr_status *statuses;
    tahr_delay *delays;
    char said[512]; /* last message of the log */
} throng;

/* A world of these bodies, precise settings with max_speed 4 m/s, no crowd yet. */
void throng_open(throng *t, const tahr_body_desc *bodies, uint32_t count);
/* A level ground at z = 0, 400 m wide. */
void throng_open_ground(throng *t);
/* Makes the crowd of count characters: ids by index, one config, nobody placed. */
void throng_make(throng *t, uint32_t count);
void throng_close(throng *t);

/* Puts a character on the ground, its floor clearance in the band. */
void throng_place(throng *t, uint32_t i, double x, double y);
/* Lets it go in this direction, as fast as this part of its speed. */
void throng_go(throng *t, uint32_t i, double x, double y);

/* One tick of 1/60 s, every status and every state looked at. Returns the status of the tick. */
tahr_status throng_step(throng *t);

/* m between two upright capsules, in long double, apart from the library's own. */
double throng_gap(const tahr_state *a, const tahr_state *b);
/* The least of all pairs. */
double throng_least_gap(const throng *t);
/* How much deeper any pair overlaps than before the last tick, m; 0 if none overlaps more. */
double throng_deeper(const throng *t);

/* Of all states in the order of ids. */
uint64_t throng_hash(const throng *t);

/* A scheduler that hands out tasks last first. */
void throng_backwards(void *user, tahr_task_fn task, void *argument, uint32_t count);

#endif
