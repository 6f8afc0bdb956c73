/* SPDX-License-Identifier: MIT
 * stepper.c: movers and crowds, used by one call at a time and let go at any. */
#include "held.h"

#ifdef TAHR_HAVE_THREADS
#include <unistd.h>
#endif

static glue_stepper *new_stepper(glue_world *held)
{
    glue_stepper *stepper = calloc(1, sizeof *stepper);
    if (stepper == NULL) {
        glue_complain(TAHR_E_MEMORY, tahr_status_message(TAHR_E_MEMORY));
        return NULL;
    }
    atomic_flag_clear(&stepper->busy);
    stepper->held = held;
    return stepper;
}

static void adopt(glue_world *held)
{
    atomic_fetch_add(&held->steppers, 1);
    atomic_fetch_add(&held->holders, 1);
}

tahr_status glue_mover_create(glue_world *held, const tahr_config *config, glue_stepper **stepper)
{
    glue_forget();
    tahr_status status = glue_world_share(held);
    if (status < 0) return status;
    glue_stepper *made = new_stepper(held);
    status = made ? tahr_mover_create(held->world, config, &made->mover) : TAHR_E_MEMORY;
    if (status >= 0) {
        adopt(held);
        *stepper = made;
    } else {
        free(made);
    }
    glue_world_leave(held);
    return status;
}

/* A task of a crowd, on whichever thread, complains to the one that steps. */
typedef struct job {
    tahr_task_fn task;
    void *argument;
    glue_text *text;
} job;

static void work(void *argument, uint32_t index)
{
    const job *j = argument;
    glue_text *before = glue_text_redirect(j->text);
    j->task(j->argument, index);
    glue_text_redirect(before);
}

static void run_tasks(void *user, tahr_task_fn task, void *argument, uint32_t count)
{
    job j = {task, argument, glue_text_mine()};
#ifdef TAHR_HAVE_THREADS
    const glue_stepper *stepper = user;
    tahr_threads_run(stepper->pool, work, &j, count);
#else
    (void)user; /* never asked for: start_pool refuses */
    for (uint32_t i = 0; i < count; i++) {
        work(&j, i);
    }
#endif
}

/* The threads of a pool stay behind when a process forks: the child starts its own, and leaves the old pool alone, for
 * its lock may be held by a thread that is not there. */
static tahr_status start_pool(glue_stepper *stepper)
{
    if (stepper->threads == 1) return TAHR_OK;
#ifdef TAHR_HAVE_THREADS
    if (stepper->pool != NULL && stepper->process == (long)getpid()) return TAHR_OK;
    tahr_threads *pool = NULL;
    tahr_status status = tahr_threads_create(NULL, stepper->threads, &pool);
    if (status < 0) return glue_complain(status, "the pool of threads cannot be started");
    stepper->pool = pool;
    stepper->process = (long)getpid();
    return TAHR_OK;
#else
    return glue_complain(TAHR_E_UNSUPPORTED, "threads: this package was built without a pool of threads, expected 1");
#endif
}

static void end_pool(glue_stepper *stepper)
{
#ifdef TAHR_HAVE_THREADS
    if (stepper->pool != NULL && stepper->process == (long)getpid()) tahr_threads_destroy(stepper->pool);
#endif
    stepper->pool = NULL;
}

tahr_status glue_crowd_create(glue_world *held, tahr_crowd_desc *desc, uint32_t threads, glue_stepper **stepper)
{
    glue_forget();
    tahr_status status = glue_world_claim(held, GLUE_CLEANING);
    if (status < 0) return status;
    glue_stepper *made = new_stepper(held);
    status = made ? TAHR_OK : TAHR_E_MEMORY;
    if (status >= 0) {
        made->threads = threads;
        desc->run_tasks = threads == 1 ? NULL : run_tasks;
        desc->run_user = made;
        status = tahr_crowd_create(held->world, desc, &made->crowd);
    }
    if (status >= 0) status = start_pool(made);
    if (status >= 0) {
        adopt(held);
        *stepper = made;
    } else if (made != NULL) {
        tahr_crowd_destroy(made->crowd);
        free(made);
    }
    glue_world_leave(held);
    return status;
}

void glue_stepper_destroy(glue_stepper *stepper)
{
    if (stepper->mover == NULL && stepper->crowd == NULL) return;
    tahr_mover_destroy(stepper->mover);
    tahr_crowd_destroy(stepper->crowd);
    end_pool(stepper);
    stepper->mover = NULL;
    stepper->crowd = NULL;
    atomic_fetch_sub(&stepper->held->steppers, 1);
}

/* The mover or crowd for this call alone, and its world for one more. */
static tahr_status begin(glue_stepper *stepper)
{
    glue_forget();
    if (atomic_flag_test_and_set(&stepper->busy)) {
        return glue_complain(TAHR_E_REENTRANT,
                             "this mover or crowd is in use already, by another thread or by a call further up");
    }
    tahr_status status = TAHR_OK;
    if (stepper->mover == NULL && stepper->crowd == NULL)
        status = glue_complain(GLUE_CLOSED, "this mover or crowd is closed");
    if (status >= 0) status = glue_world_share(stepper->held);
    if (status < 0) atomic_flag_clear(&stepper->busy);
    return status;
}

static void end(glue_stepper *stepper)
{
    atomic_flag_clear(&stepper->busy);
    glue_world_leave(stepper->held);
}

tahr_status glue_stepper_close(glue_stepper *stepper)
{
    glue_forget();
    if (atomic_flag_test_and_set(&stepper->busy)) {
        return glue_complain(TAHR_E_REENTRANT, "a mover or crowd cannot be closed while it steps");
    }
    tahr_status status = TAHR_OK;
    if (stepper->mover != NULL || stepper->crowd != NULL) {
        status = stepper->crowd ? glue_world_claim(stepper->held, GLUE_CLEANING) : glue_world_share(stepper->held);
        if (status >= 0) {
            glue_stepper_destroy(stepper);
            glue_world_leave(stepper->held);
        }
    }
    atomic_flag_clear(&stepper->busy);
    return status;
}

/* Nobody can hear of an error any more: what cannot be freed now is freed by the last one who uses the world. */
void glue_stepper_drop(glue_stepper *stepper)
{
    glue_world *held = stepper->held;
    glue_text *before = glue_text_redirect(glue_text_nobodys()); /* an exception may be in the making */
    if (stepper->crowd == NULL && glue_world_share(held) >= 0) {
        glue_stepper_destroy(stepper);
        free(stepper);
        glue_world_leave(held);
    } else {
        glue_stepper *first = atomic_load(&held->dead);
        do {
            stepper->next = first;
        } while (!atomic_compare_exchange_weak(&held->dead, &first, stepper));
        if (glue_world_claim(held, GLUE_CLEANING) >= 0) glue_world_leave(held); /* who leaves, frees */
    }
    glue_text_redirect(before);
    glue_world_drop(held);
}

tahr_status glue_mover_step(glue_stepper *stepper, const tahr_input *input, double dt, tahr_state *state,
                            tahr_report *report)
{
    tahr_status status = begin(stepper);
    if (status < 0) return status;
    status = tahr_mover_step(stepper->mover, input, dt, state, report);
    end(stepper);
    return status;
}

tahr_status glue_mover_set_custom_mode(glue_stepper *stepper, tahr_custom_mode_fn fn, void *user)
{
    tahr_status status = begin(stepper);
    if (status < 0) return status;
    status = tahr_mover_set_custom_mode(stepper->mover, fn, user);
    end(stepper);
    return status;
}

tahr_status glue_crowd_step(glue_stepper *stepper, const tahr_crowd_tick *tick, tahr_event *events, uint32_t room)
{
    tahr_status status = begin(stepper);
    if (status < 0) return status;
    for (uint32_t i = 0; tick->reports && i < tick->count; i++) {
        tahr_report *report = &tick->reports[i];
        *report = (tahr_report){.struct_size = sizeof *report, .event_capacity = room};
        report->events = events ? events + (size_t)i * room : NULL;
    }
    status = start_pool(stepper);
    if (status >= 0) status = tahr_crowd_step(stepper->crowd, tick);
    end(stepper);
    return status;
}

tahr_status glue_crowd_counts(glue_stepper *stepper, tahr_crowd_counts *counts)
{
    tahr_status status = begin(stepper);
    if (status < 0) return status;
    status = tahr_crowd_get_counts(stepper->crowd, counts);
    end(stepper);
    return status;
}
