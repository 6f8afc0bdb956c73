/* SPDX-License-Identifier: MIT
 * world.c: who uses a world now, and when it is closed.
 *
 * The library asks its caller to change a world only while nothing steps in it. Python's threads and its garbage
 * collector ask nobody: here every call counts itself in, and what comes at the wrong time is refused, or, where nobody
 * is left to hear of it, put off. No call waits for another one but for the moment of a cleaning, so none waits for
 * ever. */
#include "held.h"

#include <sched.h>

glue_world *glue_world_hold(tahr_world *world)
{
    glue_world *held = calloc(1, sizeof *held);
    if (held == NULL) {
        tahr_world_close(world);
        return NULL;
    }
    held->world = world;
    atomic_init(&held->use, 0);
    atomic_init(&held->steppers, 0);
    atomic_init(&held->holders, 1);
    atomic_init(&held->dead, NULL);
    return held;
}

static const char being_changed[] = "the world is being changed by another thread";

static tahr_status refuse_closed(void)
{
    return glue_complain(GLUE_CLOSED, "the world is closed");
}

/* How often a processor is given away before cleaning counts as never ending: in the child of a fork that came in the
 * middle of it. */
enum { PATIENCE = 1 << 20 };

/* Who uses the world, after what is soon over. */
static int wait_for_cleaning(glue_world *held)
{
    int now = atomic_load(&held->use);
    for (int i = 0; now == GLUE_CLEANING && i < PATIENCE; i++) {
        sched_yield();
        now = atomic_load(&held->use);
    }
    return now;
}

tahr_status glue_world_claim(glue_world *held, int what)
{
    int now = wait_for_cleaning(held);
    while (now != 0 || !atomic_compare_exchange_strong(&held->use, &now, what)) {
        if (now > 0) return glue_complain(TAHR_E_REENTRANT, "the world is in use: something steps in it or asks it");
        if (now == GLUE_CHANGE) return glue_complain(TAHR_E_REENTRANT, being_changed);
        now = wait_for_cleaning(held);
        if (now == GLUE_CLEANING) return glue_complain(TAHR_E_REENTRANT, being_changed);
    }
    if (held->world == NULL) {
        glue_world_leave(held);
        return refuse_closed();
    }
    return TAHR_OK;
}

tahr_status glue_world_share(glue_world *held)
{
    int now = atomic_load(&held->use);
    do {
        if (now == GLUE_CLEANING) now = wait_for_cleaning(held);
        if (now < 0) return glue_complain(TAHR_E_REENTRANT, being_changed);
    } while (!atomic_compare_exchange_weak(&held->use, &now, now + 1));
    if (held->world == NULL) {
        glue_world_leave(held);
        return refuse_closed();
    }
    if (held->trace != NULL && now > 0) {
        glue_world_leave(held);
        return glue_complain(TAHR_E_REENTRANT, "a world that is recorded can be used by one call at a time");
    }
    return TAHR_OK;
}

static void bury(glue_world *held)
{
    glue_stepper *dead = atomic_exchange(&held->dead, NULL);
    while (dead != NULL) {
        glue_stepper *next = dead->next;
        glue_stepper_destroy(dead);
        free(dead);
        dead = next;
    }
}

void glue_world_leave(glue_world *held)
{
    for (;;) {
        int now = atomic_load(&held->use);
        while (!atomic_compare_exchange_weak(&held->use, &now, now < 0 ? 0 : now - 1)) {
        }
        int free = 0;
        if (atomic_load(&held->dead) == NULL) return;
        if (!atomic_compare_exchange_strong(&held->use, &free, GLUE_CLEANING)) return;
        bury(held); /* the last one out clears up; and leaves in turn */
    }
}

tahr_status glue_world_enter(glue_world *held, tahr_world **world)
{
    glue_forget();
    *world = NULL;
    tahr_status status = glue_world_share(held);
    if (status >= 0) *world = held->world;
    return status;
}

static tahr_status end_recording(glue_world *held)
{
    tahr_trace *trace = held->trace;
    held->trace = NULL;
    if (trace == NULL) return TAHR_OK;
    tahr_world_record(held->world, NULL);
    return tahr_trace_close(trace);
}

tahr_status glue_world_close(glue_world *held)
{
    glue_forget();
    tahr_status status = glue_world_claim(held, GLUE_CHANGE);
    if (status < 0) return status;
    bury(held);
    if (atomic_load(&held->steppers) > 0) {
        status = glue_complain(GLUE_IN_USE, "the world cannot be closed while movers or crowds of it are open");
    } else {
        status = end_recording(held);
        tahr_world_close(held->world);
        held->world = NULL;
    }
    glue_world_leave(held);
    return status;
}

int32_t glue_world_is_closed(glue_world *held)
{
    tahr_status status = glue_world_share(held);
    if (status >= 0) glue_world_leave(held);
    return status == GLUE_CLOSED;
}

void glue_world_drop(glue_world *held)
{
    if (atomic_fetch_sub(&held->holders, 1) > 1) return;
    glue_text *before = glue_text_redirect(glue_text_nobodys());
    bury(held);
    if (held->world != NULL) {
        end_recording(held);
        tahr_world_close(held->world);
    }
    glue_text_redirect(before);
    free(held);
}

tahr_status glue_world_move(glue_world *held, const tahr_body_pose *poses, uint32_t count, double dt)
{
    glue_forget();
    tahr_status status = glue_world_claim(held, GLUE_CHANGE);
    if (status < 0) return status;
    status = dt == 0 ? tahr_world_set(held->world, poses, count) : tahr_world_move(held->world, poses, count, dt);
    glue_world_leave(held);
    return status;
}

tahr_status glue_world_touch(glue_world *held)
{
    glue_forget();
    tahr_status status = glue_world_claim(held, GLUE_CHANGE);
    if (status < 0) return status;
    status = tahr_world_touch(held->world);
    glue_world_leave(held);
    return status;
}

tahr_status glue_world_record(glue_world *held, const char *path, uint32_t flags)
{
    glue_forget();
    tahr_trace_desc desc = {.struct_size = sizeof desc, .flags = flags, .path = path, .log = glue_log()};
    tahr_trace *trace = NULL;
    tahr_status status = glue_world_claim(held, GLUE_CHANGE);
    if (status < 0) return status;
    if (held->trace != NULL) status = glue_complain(GLUE_IN_USE, "the world is recorded already");
    if (status >= 0) status = tahr_trace_open(&desc, &trace);
    if (status >= 0) status = tahr_world_record(held->world, tahr_trace_recorder(trace));
    if (status >= 0) {
        held->trace = trace;
    } else if (trace != NULL) {
        tahr_trace_close(trace);
    }
    glue_world_leave(held);
    return status;
}

tahr_status glue_world_record_end(glue_world *held)
{
    glue_forget();
    tahr_status status = glue_world_claim(held, GLUE_CHANGE);
    if (status < 0) return status;
    status = end_recording(held);
    glue_world_leave(held);
    return status;
}
