/* SPDX-License-Identifier: MIT
 * actor.h: one character of a recorded run that is taken again: what is known of it, and what was found. */
#ifndef TAHR_CLI_LCM_ACTOR_H
#define TAHR_CLI_LCM_ACTOR_H

#include "judge.h"

enum { EVENTS_KEPT = 32 };

struct actor {
    int32_t character;
    uint32_t config;
    tahr_mover *mover;
    tahr_state state; /* before step `next`, if it is known */
    int known;
    int64_t next;
    uint64_t hash;     /* of state */
    int64_t unsettled; /* steps taken since the last whose recorded hash was compared */
    int64_t gap_from;  /* -1: none open; */
    int64_t last;      /* the last step heard of in it */
    const char *gap_why;
    int64_t sequence[TAHR_MESSAGE_COUNT]; /* that comes next; -1: none heard */
    int64_t events_step, events;          /* heard of that step */
    /* The events of the last step taken alone, as they happened again; -1: there is none, or one was lost. */
    int64_t taken_step;
    tahr_event taken[EVENTS_KEPT];
    uint32_t taken_count;
    int is_wrong; /* 1: an event is not what happened, if the hash says that all else is */
    struct contradiction wrong;
    int differs;           /* 1: until a snapshot, which may excuse it; */
    struct desync *desync; /* where it is told, or NULL */
    int heard;             /* 1: the message of a state, the last that came */
    tahr_state_t heard_state;
    int has_report; /* 1: of a step that waits for the others of its tick */
    tahr_report_t report;
};

struct actor *actor_new(int32_t character);
void actor_free(struct actor *actor);

/* It is not known what it does from this step on. */
void actor_lose(struct actor *actor, struct verdict *verdict, int64_t from, const char *why);

/* A state is known, before a step. */
void actor_take(struct actor *actor, struct verdict *verdict, int64_t step, const tahr_state *state);

/* A step came to actor->state. */
void actor_stepped(struct actor *actor);

/* The hash that was recorded of the last step. */
void actor_compare(struct actor *actor, struct verdict *verdict, uint64_t recorded);

/* An event of a step, the actor->events-th of it. */
void actor_compare_event(struct actor *actor, const tahr_event_t *recorded);

/* Steps that were taken, but of which nothing says where they led, are a gap. */
void actor_give_up(struct actor *actor, struct verdict *verdict);

/* Nothing more comes. */
void actor_end(struct actor *actor, struct verdict *verdict);

/* Numbers missing before this one, of a kind. */
int64_t actor_missing(struct actor *actor, uint32_t kind, int64_t sequence);

/* A stretch of steps that is not proven, on its own. */
void verdict_gap(struct verdict *verdict, const struct gap *gap);

#endif
