/* SPDX-License-Identifier: MIT
 * publisher.c: telemetry over LCM: what is stepped here is published by the telemetry's own thread, without Python. */
#include "held.h"

#ifdef TAHR_HAVE_LCM
#include <time.h>
#include <unistd.h>

enum { EVENT_ROOM = 64 }; /* of a step whose caller wants no report: more than any step of a mover has had */

struct glue_publisher {
    tahr_lcm *lcm;
    tahr_telemetry *telemetry; /* NULL: closed */
    long process;              /* that started its thread: a fork has none */
    atomic_flag busy;
    tahr_report report; /* for who has none */
    tahr_event events[EVENT_ROOM];
};

tahr_status glue_publisher_open(const tahr_lcm_desc *channels, tahr_telemetry_desc *desc, glue_publisher **publisher)
{
    glue_forget();
    glue_publisher *made = calloc(1, sizeof *made);
    if (made == NULL) return glue_complain(TAHR_E_MEMORY, tahr_status_message(TAHR_E_MEMORY));
    atomic_flag_clear(&made->busy);
    made->process = (long)getpid();
    tahr_status status = tahr_lcm_open(channels, &made->lcm);
    if (status >= 0) {
        desc->sink = tahr_lcm_sink(made->lcm);
        status = tahr_telemetry_create(desc, &made->telemetry);
    }
    if (status < 0) {
        tahr_lcm_close(made->lcm);
        free(made);
        return status;
    }
    *publisher = made;
    return status;
}

/* NULL is what a fork has of it. */
static tahr_status check(const glue_publisher *publisher)
{
    glue_forget();
    if (publisher == NULL) {
        return glue_complain(TAHR_E_UNSUPPORTED, "the thread that publishes has stayed in the process that forked; "
                                                 "open another publisher here");
    }
    return publisher->telemetry ? TAHR_OK : glue_complain(GLUE_CLOSED, "this publisher is closed");
}

/* The publisher for this call alone. */
static tahr_status enter(glue_publisher *publisher)
{
    tahr_status status = check(publisher);
    if (status < 0) return status;
    if (atomic_flag_test_and_set(&publisher->busy)) {
        return glue_complain(TAHR_E_REENTRANT, "this publisher is in use already, by another thread");
    }
    return TAHR_OK;
}

static void leave(glue_publisher *publisher)
{
    atomic_flag_clear(&publisher->busy);
}

static uint64_t nanoseconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000000u + (uint64_t)now.tv_nsec;
}

/* Messages for which there is no room are counted: no reason not to step. */
static tahr_status begin(glue_publisher *publisher, const glue_published *whom, const tahr_state *state)
{
    tahr_status status = tahr_telemetry_begin(publisher->telemetry, 0, whom->character, whom->config, state);
    return status < 0 ? status : TAHR_OK;
}

tahr_status glue_publisher_step(glue_publisher *publisher, const glue_published *whom, const tahr_input *input,
                                double dt, tahr_state *state, tahr_report *report)
{
    tahr_status status = enter(publisher);
    if (status < 0) return status;
    tahr_report *used = report ? report : &publisher->report;
    if (report == NULL) {
        *used = (tahr_report){.struct_size = sizeof *used, .events = publisher->events, .event_capacity = EVENT_ROOM};
    }
    status = begin(publisher, whom, state);
    if (status >= 0) {
        uint64_t start = nanoseconds();
        status = glue_mover_step(whom->mover, input, dt, state, used);
        if (status >= 0) {
            tahr_telemetry_step step = {.character = whom->character,
                                        .status = status,
                                        .input = input,
                                        .state = state,
                                        .report = used,
                                        .dt = dt,
                                        .ns = nanoseconds() - start,
                                        .flags = whom->flags};
            tahr_status pushed = tahr_telemetry_push(publisher->telemetry, 0, &step);
            status = pushed < 0 ? pushed : status;
        }
    }
    leave(publisher);
    return status;
}

tahr_status glue_publisher_crowd_step(glue_publisher *publisher, glue_stepper *stepper, const tahr_crowd_tick *tick,
                                      tahr_event *events, uint32_t room)
{
    tahr_status status = enter(publisher);
    if (status < 0) return status;
    for (uint32_t i = 0; i < tick->count && status >= 0; i++) {
        const glue_published whom = {.character = i, .config = tick->members ? tick->members[i].config : 0};
        status = begin(publisher, &whom, &tick->states[i]);
    }
    if (status >= 0) {
        /* Those that could be stepped are told of, whatever became of the others. */
        for (uint32_t i = 0; i < tick->count; i++) {
            tick->statuses[i] = TAHR_E_ARGUMENT;
        }
        status = glue_crowd_step(stepper, tick, events, room);
        tahr_status pushed = TAHR_OK;
        for (uint32_t i = 0; i < tick->count && pushed >= 0; i++) {
            tahr_telemetry_step step = {.character = i,
                                        .status = tick->statuses[i],
                                        .input = &tick->inputs[i],
                                        .state = &tick->states[i],
                                        .report = &tick->reports[i],
                                        .dt = tick->dt,
                                        .flags = TAHR_STEP_CROWD};
            pushed = tahr_telemetry_push(publisher->telemetry, 0, &step);
        }
        status = status < 0 || pushed >= 0 ? status : pushed;
    }
    leave(publisher);
    return status;
}

tahr_status glue_publisher_change(glue_publisher *publisher, glue_world *held, uint32_t kind,
                                  const tahr_body_pose *poses, uint32_t count, double dt)
{
    tahr_world *world = NULL;
    tahr_status status = enter(publisher);
    if (status < 0) return status;
    status = kind == TAHR_CHANGE_TOUCH ? glue_world_touch(held)
                                       : glue_world_move(held, poses, count, kind == TAHR_CHANGE_MOVE ? dt : 0);
    if (status >= 0) status = glue_world_enter(held, &world);
    if (status >= 0) {
        uint64_t revision = tahr_world_revision(world);
        glue_world_leave(held);
        status = tahr_telemetry_change(publisher->telemetry, kind, poses, count, dt, revision);
        status = status < 0 ? status : TAHR_OK;
    }
    leave(publisher);
    return status;
}

tahr_status glue_publisher_latest(glue_publisher *publisher, uint32_t character, tahr_state *state)
{
    tahr_status status = check(publisher);
    return status < 0 ? status : tahr_telemetry_latest(publisher->telemetry, character, state, NULL);
}

tahr_status glue_publisher_counts(glue_publisher *publisher, tahr_telemetry_counts *counts)
{
    tahr_status status = check(publisher);
    return status < 0 ? status : tahr_telemetry_get_counts(publisher->telemetry, counts);
}

/* Where the sink does not return its thread goes on to use lcm, which stays. */
tahr_status glue_publisher_close(glue_publisher *publisher, uint32_t how, double timeout, tahr_telemetry_counts *counts)
{
    glue_forget();
    if (publisher == NULL || publisher->telemetry == NULL) return TAHR_OK;
    if (atomic_flag_test_and_set(&publisher->busy)) {
        return glue_complain(TAHR_E_REENTRANT, "a publisher cannot be closed while it is in use");
    }
    tahr_status status = tahr_telemetry_stop(publisher->telemetry, how, timeout);
    if (status >= 0 || status == TAHR_E_TIMEOUT) {
        tahr_telemetry_get_counts(publisher->telemetry, counts);
        tahr_telemetry_destroy(publisher->telemetry);
        if (status >= 0) tahr_lcm_close(publisher->lcm);
        publisher->telemetry = NULL;
    }
    atomic_flag_clear(&publisher->busy);
    return status;
}

/* What a fork has of it has no thread that could be ended, and is left alone. */
void glue_publisher_drop(glue_publisher *publisher)
{
    tahr_telemetry_counts counts = {.struct_size = sizeof counts};
    if (publisher->process != (long)getpid()) return;
    glue_publisher_close(publisher, TAHR_STOP_DRAIN, 2, &counts);
    free(publisher);
}
#endif
