/* SPDX-License-Identifier: MIT
 * glue.h: what stands between Python and the library: handles that no thread, fork or garbage collector can pull away
 * from under a call, and the library's messages, kept for the exception. cffi reads this file too. */
#ifndef TAHR_PYTHON_GLUE_H
#define TAHR_PYTHON_GLUE_H

#include <tahr/native.h>
#include <tahr/plugin.h>
#include <tahr/tahr.h>
#include <tahr/trace.h>
#ifdef TAHR_HAVE_CCD
#include <tahr/ccd.h>
#endif
#ifdef TAHR_HAVE_FCL
#include <tahr/fcl.h>
#endif
#ifdef TAHR_HAVE_BOX2D
#include <tahr/box2d.h>
#endif
#ifdef TAHR_HAVE_THREADS
#include <tahr/threads.h>
#endif
#ifdef TAHR_HAVE_LCM
#include <tahr/lcm.h>
#include <tahr/telemetry.h>
#endif

/* Beside the library's own statuses. CLOSED: the object was closed. IN_USE: it cannot be closed while others need
 * it. */
enum { GLUE_CLOSED = -1000, GLUE_IN_USE = -1001 };

/* A world, and who uses it now: any number of steps and questions, or one change. It is closed when it is asked to be,
 * or when nobody holds it any more: Python, and everything that steps in it. */
typedef struct glue_world glue_world;

/* A mover or a crowd of a world. Used by one call at a time. */
typedef struct glue_stepper glue_stepper;

/* Keeps what the library says on this thread, and on threads that work for it, for glue_message. */
const tahr_log *glue_log(void);
void glue_forget(void);
const char *glue_message(void);

/* Takes over an open world; NULL (world closed) without memory. drop: Python has let it go. */
glue_world *glue_world_hold(tahr_world *world);
tahr_status glue_world_close(glue_world *held);
int32_t glue_world_is_closed(glue_world *held);
void glue_world_drop(glue_world *held);

/* Questions: *world is NULL, and leave must not follow, unless TAHR_OK comes. */
tahr_status glue_world_enter(glue_world *held, tahr_world **world);
void glue_world_leave(glue_world *held);

/* Changes. dt 0: tahr_world_set. */
tahr_status glue_world_move(glue_world *held, const tahr_body_pose *poses, uint32_t count, double dt);
tahr_status glue_world_touch(glue_world *held);

/* Records to a file, until it is ended or the world is closed; then one thread steps at a time. */
tahr_status glue_world_record(glue_world *held, const char *path, uint32_t flags);
tahr_status glue_world_record_end(glue_world *held);

/* desc: run_tasks and run_user are set here; threads as in tahr_threads_create. */
tahr_status glue_mover_create(glue_world *held, const tahr_config *config, glue_stepper **stepper);
tahr_status glue_crowd_create(glue_world *held, tahr_crowd_desc *desc, uint32_t threads, glue_stepper **stepper);
tahr_status glue_stepper_close(glue_stepper *stepper);
void glue_stepper_drop(glue_stepper *stepper);
tahr_status glue_mover_step(glue_stepper *stepper, const tahr_input *input, double dt, tahr_state *state,
                            tahr_report *report);
tahr_status glue_mover_set_custom_mode(glue_stepper *stepper, tahr_custom_mode_fn fn, void *user);

/* Sets up tick->reports, if there are any, with room for `room` of events each. */
tahr_status glue_crowd_step(glue_stepper *stepper, const tahr_crowd_tick *tick, tahr_event *events, uint32_t room);
tahr_status glue_crowd_counts(glue_stepper *stepper, tahr_crowd_counts *counts);

/* 3 doubles a place. [out] *done of count. */
tahr_status glue_states_init(const tahr_config *config, const double *places, size_t count, tahr_state *states,
                             size_t *done);
void glue_states_hash(const tahr_state *states, size_t count, uint64_t *hashes);

#ifdef TAHR_HAVE_LCM
/* A telemetry whose sink is LCM. Used by one call at a time. */
typedef struct glue_publisher glue_publisher;

/* Whose step it is, and by what it is taken. */
typedef struct glue_published {
    glue_stepper *mover;
    uint32_t character, config, flags;
} glue_published;

/* desc->sink is set here. */
tahr_status glue_publisher_open(const tahr_lcm_desc *channels, tahr_telemetry_desc *desc, glue_publisher **publisher);

/* As glue_mover_step and glue_crowd_step, and told of; report may be NULL, the tick has reports and statuses. */
tahr_status glue_publisher_step(glue_publisher *publisher, const glue_published *whom, const tahr_input *input,
                                double dt, tahr_state *state, tahr_report *report);
tahr_status glue_publisher_crowd_step(glue_publisher *publisher, glue_stepper *stepper, const tahr_crowd_tick *tick,
                                      tahr_event *events, uint32_t room);

/* Changes the world, and tells of it. */
tahr_status glue_publisher_change(glue_publisher *publisher, glue_world *held, uint32_t kind,
                                  const tahr_body_pose *poses, uint32_t count, double dt);
tahr_status glue_publisher_latest(glue_publisher *publisher, uint32_t character, tahr_state *state);
tahr_status glue_publisher_counts(glue_publisher *publisher, tahr_telemetry_counts *counts);

/* [out] counts, if it was open. */
tahr_status glue_publisher_close(glue_publisher *publisher, uint32_t how, double timeout,
                                 tahr_telemetry_counts *counts);
void glue_publisher_drop(glue_publisher *publisher);
#endif

/* The backends inside, NULL at the end. */
const tahr_backend *glue_backend(uint32_t index);

/* Where the C compiler put every field that Python reads by itself; written when the extension is built. */
typedef struct glue_field {
    const char *type, *field;
    size_t size, offset; /* of the field; of the type, and 0, where field is NULL */
} glue_field;
extern const glue_field glue_layout[];
extern const size_t glue_layout_count;

#endif
