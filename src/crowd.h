/* SPDX-License-Identifier: MIT
 * crowd.h: a crowd behind its handle, and the tick in progress. */
#ifndef TAHR__CROWD_H
#define TAHR__CROWD_H

#include "crowd_grid.h"

/* Of one character: more are as good as none, for so many do not fit around one that is not far larger. */
enum { TAHR__NEIGHBOURS = 128 };

/* What a part of a tick counts, on a line of memory of its own. */
typedef struct tahr__part {
    tahr__spread spread;
    tahr_crowd_counts counts;
    uint32_t rests;    /* characters that rest (crowd_rest.h), */
    uint32_t woken;    /* and all others, in the steps of a tick */
    uint32_t still;    /* figures that are those of the last tick */
    uint32_t strays;   /* steps that must be taken again */
    uint32_t bad;      /* first character with something wrong that stops the tick, or ~0u, */
    const char *field; /* and what */
    const char *why;
    tahr_status status;
} tahr__part;

typedef struct tahr__rest tahr__rest;

struct tahr_crowd {
    tahr_world *world;
    tahr_allocator allocator;
    void *memory;
    size_t size;
    uint32_t capacity, kind_count, tasks, busy;
    uint32_t walkable_rule; /* of heads */
    uint32_t key_mask;      /* of keys */
    tahr_run_tasks_fn run_tasks;
    void *run_user;
    tahr_mover **kinds;  /* one for each config, which nobody steps */
    tahr_mover **movers; /* one for each place in the arrays of a tick; lean: for each part */
    uint32_t *kind_of;   /* whose config it has now */
    uint32_t mover_count, is_lean;
    tahr__figure *figures;
    tahr__look *looks;
    tahr_status *statuses;
    double *strayed; /* m, of who would have gone farther than foreseen */
    uint32_t *keys;  /* ids of a tick, to find one that is there twice */
    tahr__part *parts;
    tahr__rest *rests;      /* of each place in the arrays of a tick; lean: none */
    uint8_t *resting;       /* TAHR__RESTS*; 0: it does not, and nothing of its rest counts */
    uint8_t *still;         /* 1: it rests on in this tick */
    double rest_dt;         /* s, and */
    uint64_t rest_revision; /* of the world: of the steps that were noted */
    uint32_t has_rests;     /* 1: some are valid */
    uint32_t settled;       /* 1: everybody rested in the last tick, which was in order */
    tahr_status worst;      /* then: what that came to */
    tahr__grid grid;
    tahr_crowd_counts counts;
};

/* A tick in progress. */
typedef struct tahr__tick {
    tahr_crowd *crowd;
    const tahr_crowd_tick *asked;
    size_t input_stride, report_stride;
    uint64_t revision; /* of the world */
    uint32_t tasks;
    uint32_t looked;     /* 1: crowd->still is known */
    uint32_t rules;      /* TAHR__PAIR_* */
    uint32_t same_cells; /* 1: the grid's cells are those of the last tick, and so many figures are in them */
} tahr__tick;

static inline const tahr_input *tick_input(const tahr__tick *t, uint32_t i)
{
    return (const tahr_input *)(const void *)((const char *)t->asked->inputs + i * t->input_stride);
}

static inline tahr_report *tick_report(const tahr__tick *t, uint32_t i)
{
    return t->asked->reports ? (tahr_report *)(void *)((char *)t->asked->reports + i * t->report_stride) : NULL;
}

/* What is wrong with a tick as a whole; TAHR_OK if nothing is. Says it. */
tahr_status tahr__tick_check(tahr_crowd *crowd, const tahr_crowd_tick *asked, tahr__tick *tick);
/* The rest of tahr__tick_check_one. */
const char *tahr__tick_check_member(const tahr__tick *tick, const tahr_member *member, tahr_status *status,
                                    const char **why);

/* What is wrong with one character's part of a tick that stops all: the field, or NULL. */
static inline const char *tahr__tick_check_one(const tahr__tick *t, uint32_t i, tahr_status *status, const char **why)
{
    const int input = tick_input(t, i)->struct_size != t->input_stride;
    if (input || (t->asked->reports && tick_report(t, i)->struct_size != t->report_stride)) {
        *status = TAHR_E_STRUCT_SIZE;
        *why = "is not that of the first one";
        return input ? "inputs.struct_size" : "reports.struct_size";
    }
    return t->asked->members ? tahr__tick_check_member(t, &t->asked->members[i], status, why) : NULL;
}

/* Finds an id that is there twice. Returns TAHR_OK, or says it. */
tahr_status tahr__tick_check_ids(const tahr__tick *tick);

#endif
