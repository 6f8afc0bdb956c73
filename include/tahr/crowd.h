/* SPDX-License-Identifier: MIT
 * crowd.h: many characters in one step, each an obstacle of the others, on as many threads as you give it. */
#ifndef TAHR_CROWD_H
#define TAHR_CROWD_H

#include <tahr/mover.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct tahr_crowd tahr_crowd;

/* One part of a crowd's step. */
typedef void (*tahr_task_fn)(void *argument, uint32_t index);

/* Your scheduler: calls task(argument, i) once for every i < count, on any threads and in any order, the calling one
 * among them if you like, and returns when all of them have returned. <tahr/threads.h> brings one. */
typedef void (*tahr_run_tasks_fn)(void *user, tahr_task_fn task, void *argument, uint32_t count);

/* A character as a body: TAHR_CHARACTER_BODY + its id stands for it in hits, contacts, floors and events of the others.
 * While a crowd is open the bodies of a world over callbacks have smaller numbers than that. */
#define TAHR_CHARACTER_BODY 0x80000000u

/* STAND_ON_HEADS: a head is a floor like any other, as far as it is no steeper than config.walkable_angle. It carries
 * nobody: who stands on it is not taken along, and in the way of whom it belongs to when he goes to that side. Without
 * it nobody stands on another character: who comes down on one slides off (and floats where it is met exactly in the
 * middle, until one of them moves).
 * LEAN: one mover for each task instead of one for each character: 39 KB a character less on native, and several times
 * the cost, for every step gathers its surroundings anew and who stands still is computed all the same. The same
 * bits. */
enum { TAHR_CROWD_STAND_ON_HEADS = 1 << 0, TAHR_CROWD_LEAN = 1 << 1 };

/* [in] everything is copied. */
typedef struct tahr_crowd_desc {
    uint32_t struct_size;
    uint32_t flags;              /* TAHR_CROWD_* */
    uint32_t capacity;           /* 1..2^22 characters, for which memory is taken */
    uint32_t config_count;       /* 1..65536 */
    const tahr_config *configs;  /* what members choose from; all of one struct_size */
    tahr_run_tasks_fn run_tasks; /* NULL: everything on the calling thread; so are ticks of less than 32 characters */
    void *run_user;              /* handed to it; must stay valid until the crowd is destroyed */
    uint32_t tasks; /* [0: 32] parts that a tick is cut into, up to 4096, of 16 characters or more: changes no result */
    uint32_t reserved; /* 0 */
} tahr_crowd_desc;

/* ALONE: meets nobody. */
enum { TAHR_MEMBER_ALONE = 1 << 0 };

/* Who a character is. Frozen. Zero what you do not use. Two of them are obstacles of each other if each has a bit of
 * the other's groups in its mask. */
typedef struct tahr_member {
    uint32_t id;     /* unique in a tick, below 0x7FFFFFFF; decides what would else be chance */
    uint32_t config; /* index into tahr_crowd_desc.configs */
    uint32_t groups; /* bits; 0: the lowest one */
    uint32_t mask;   /* bits; 0: all */
    uint32_t flags;  /* TAHR_MEMBER_* */
    uint32_t reserved;
    double budget; /* m, 0..10: how far its shown place may be off, for a cheaper step; needs a tahr_delay; 0: exact */
} tahr_member;

/* Of a distant character: what was computed ahead. Plain data like tahr_state, and like it part of what decides the
 * future: keep it, copy it, hash it together with the state. Zero for a new character. Frozen, 1280 bytes. */
typedef struct tahr_delay {
    tahr_state from, to;     /* the step that was computed, from its begin to its end */
    double length;           /* s, of that step; 0: none */
    double elapsed;          /* s of it that are shown */
    uint64_t revision;       /* of the world then */
    tahr_vec3 move, gravity; /* input of that step */
    uint32_t jump, crouch;
    uint32_t flags;    /* of that input */
    uint32_t config;   /* and of the member */
    uint32_t rounds;   /* steps computed ahead so far, saturating */
    uint32_t failures; /* ticks until the next try */
    uint8_t reserved[160];
} tahr_delay;

/* One tick. Arrays of count elements, in the same order, which does not matter and may change from tick to tick: what
 * counts is the id. */
typedef struct tahr_crowd_tick {
    uint32_t struct_size;
    uint32_t count;
    double dt;                  /* s, as in tahr_mover_step */
    const tahr_member *members; /* NULL: ids are indices, everybody meets everybody and has the first config */
    const tahr_input *inputs;   /* all of one struct_size */
    tahr_state *states;         /* [in,out] */
    tahr_report *reports;       /* [out] or NULL; set up each as for tahr_mover_step, all of one struct_size */
    tahr_status *statuses;      /* [out] or NULL: what each step came to, as tahr_mover_step returns it */
    tahr_delay *delays;         /* [in,out] or NULL: needed where a member has a budget */
} tahr_crowd_tick;

/* What ticks came to, for charts and tests: sums since the crowd was created. */
typedef struct tahr_crowd_counts {
    uint32_t struct_size;
    uint32_t most_neighbours; /* of one character in one tick */
    uint64_t ticks, steps;    /* steps: of characters */
    uint64_t beside;          /* of them with somebody near */
    uint64_t deferred;        /* of them only shown on their way, without a query */
    uint64_t ahead;           /* of them computed for several ticks at once */
    uint64_t again;           /* of them taken twice: the first time it went farther than foreseen */
} tahr_crowd_counts;

/* Sets every field to its default: zero, but struct_size. [out] desc, tick of size bytes. Untouched on error. Allocate
 * nothing; may run on several threads. Return TAHR_OK, TAHR_E_NULL, TAHR_E_STRUCT_SIZE. Since 0.1. */
TAHR_API tahr_status tahr_crowd_desc_init(tahr_crowd_desc *desc, size_t size);
TAHR_API tahr_status tahr_crowd_tick_init(tahr_crowd_tick *tick, size_t size);

/* Memory for a crowd: a mover for each of its characters (but see LEAN), and what finds neighbours; from the world's
 * allocator.
 * [in] world, which must outlive the crowd; desc, copied. [out] crowd, untouched on error; destroy it with
 * tahr_crowd_destroy. Needs exclusive access to the world. Allocates.
 * Returns TAHR_OK, TAHR_E_NULL (world, desc, crowd, desc.configs), TAHR_E_STRUCT_SIZE, TAHR_E_ARGUMENT (capacity,
 * config_count, tasks, flags; a config, as tahr_mover_create says), TAHR_E_UNSUPPORTED (unknown tail not zero; a
 * config that the world's backend cannot serve), TAHR_E_MEMORY; the log names the field. Since 0.1. */
TAHR_API tahr_status tahr_crowd_create(tahr_world *world, const tahr_crowd_desc *desc, tahr_crowd **crowd);

/* Frees a crowd; its world must still be open. NULL is allowed. Needs exclusive access to the world. Since 0.1. */
TAHR_API void tahr_crowd_destroy(tahr_crowd *crowd);

/* Moves many characters through dt seconds, each as tahr_mover_step would if it were alone.
 *
 * Characters see each other as they are when the tick begins (after what they stand on has carried them). For each pair
 * that could meet within the tick a plane between the two becomes an obstacle of both: neither crosses it, so that they
 * cannot meet, in whatever order and on however many threads they move. It leaves each the room that its velocity asks
 * for, or its share of what there is, and half of its skin. Who overlaps another from the start is pushed out of him:
 * of the way each takes the part that the other's mass is of both. Hulls are to others the box around them.
 * An infinite plane stands for a round neighbour for one tick only, but for that long also beside him. Who is squeezed
 * by a body that moves, or turns as a box where there is no room for it, goes into his neighbours rather than into what
 * never moves (TAHR_CRUSHED), and they give way in the next ticks.
 * TAHR_MODE_CUSTOM has no function in a crowd. More than 127 neighbours at once: the farthest do not count
 * (TAHR_TRUNCATED).
 *
 * A member with a budget takes one step for several ticks at once, up to 8, where that meets nothing: in between it is
 * shown on the straight line from begin to end, along which it was swept. Whatever changes (its input, dt, its state,
 * the world around it, a neighbour) ends that, and it goes on from where the exact step leads. Shown and exact place
 * differ by at most the budget, as long as nothing is met; what is met is met at most 8 ticks too late to be seen, and
 * never passed. TAHR_REPORT_DEFERRED tells of ticks without a step.
 *
 * [in,out] crowd; tick and what it points to; the arrays may not overlap.
 * Returns TAHR_OK; the largest positive status of all characters; or the status of the character with the lowest id
 * among those that failed, TAHR_E_ARGUMENT, TAHR_E_STRUCT_SIZE, TAHR_E_UNSUPPORTED or TAHR_E_BACKEND: a character that
 * fails leaves its own state as it was and the others alone. Nothing is stepped, and no array written to, with
 * TAHR_E_NULL (crowd, tick, an array that is needed), TAHR_E_STRUCT_SIZE (tick; inputs or reports that differ),
 * TAHR_E_UNSUPPORTED (unknown tail of tick; a world that is recorded), TAHR_E_ARGUMENT (count above capacity, dt, an
 * id twice or out of range, a member's config, flags or budget, a budget without delays), TAHR_E_REENTRANT; the log
 * names the field and the character.
 * Allocates nothing. Pure like tahr_mover_step: the result depends on world, configs, members, inputs, dt, states and
 * delays only. Crowds of one world may step on different threads at once, and do not see each other. Queries: those of
 * the steps. Since 0.1. */
TAHR_API tahr_status tahr_crowd_step(tahr_crowd *crowd, const tahr_crowd_tick *tick);

/* [out] counts, struct_size set by the caller; untouched on error. Allocates nothing; not while the crowd steps.
 * Returns TAHR_OK, TAHR_E_NULL, TAHR_E_STRUCT_SIZE. Since 0.1. */
TAHR_API tahr_status tahr_crowd_get_counts(const tahr_crowd *crowd, tahr_crowd_counts *counts);

#ifdef __cplusplus
}
#endif
#endif
