/* SPDX-License-Identifier: MIT
 * held.h: what the files of the glue share. */
#ifndef TAHR_PYTHON_HELD_H
#define TAHR_PYTHON_HELD_H

#include "glue.h"

#include <stdatomic.h>
#include <stdlib.h>

struct glue_world {
    tahr_world *world;            /* NULL: closed */
    tahr_trace *trace;            /* while it is recorded */
    atomic_int use;               /* steps and questions under way, or GLUE_CHANGE, or GLUE_CLEANING */
    atomic_uint steppers;         /* not closed */
    atomic_uint holders;          /* Python, and steppers that Python has not let go */
    _Atomic(glue_stepper *) dead; /* let go while the world was in use */
};

struct glue_stepper {
    glue_world *held;
    tahr_mover *mover;
    tahr_crowd *crowd; /* or this; both NULL: closed */
    void *pool;        /* tahr_threads, or NULL */
    long process;      /* that started the pool: a fork has no threads */
    uint32_t threads;  /* that it was asked for */
    atomic_flag busy;
    glue_stepper *next;
};

/* Messages of one thread. Others write them too while they work for it. */
typedef struct glue_text glue_text;

/* Everything said on this thread from now on goes to another one's text; NULL: its own. Returns the one before. */
glue_text *glue_text_redirect(glue_text *text);
glue_text *glue_text_mine(void);
glue_text *glue_text_nobodys(void); /* nobody reads it */
tahr_status glue_complain(tahr_status status, const char *what);

/* Who has a world to himself, for a moment in which no Python runs. Who comes upon a CHANGE is refused: what he would
 * compute is chance. CLEANING, the making and freeing of crowds, concerns nobody: others wait for its end. */
enum { GLUE_CHANGE = -1, GLUE_CLEANING = -2 };

/* What the world is about to be used for; leave ends either. */
tahr_status glue_world_share(glue_world *held);
tahr_status glue_world_claim(glue_world *held, int what);

/* Frees what a stepper is made of. Needs the world to itself. */
void glue_stepper_destroy(glue_stepper *stepper);

#endif
