/* SPDX-License-Identifier: MIT
 * replay_trace.c: a recorded run, repeated without its backend and its level. */
#include "replay_trace.h"

#include "say.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <tahr/tahr.h>
#include <tahr/trace.h>

struct actor {
    tahr_mover *mover;
    tahr_state state;
    int is_known; /* the state is what the last recorded step left */
};

struct replay {
    tahr_trace_reader *reader;
    tahr_world *world;
    struct actor *actors;
    size_t count, capacity;
    tahr_status status; /* of the step under way */
    int repeats;        /* 1: it was repeated, 0: left out */
    struct replayed *found;
};

/* A world of as many bodies as there were: what they are comes from the file. */
static int open_world(struct replay *r)
{
    const tahr_log log = say_log();
    uint32_t count = tahr_trace_bodies(r->reader);
    tahr_body_desc *bodies = memory_new(count + 1, sizeof *bodies);
    tahr_world_desc desc;
    for (uint32_t i = 0; i < count; i++) {
        tahr_body_desc_init(&bodies[i], sizeof bodies[i], TAHR_BODY_SPHERE);
        bodies[i].radius = 1;
    }
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bodies;
    desc.body_count = count;
    desc.log = &log;
    tahr_status status = tahr_world_open(tahr_backend_v1_trace(), &desc, &r->world);
    free(bodies);
    if (status >= 0) {
        status = tahr_world_record(r->world, tahr_trace_answers(r->reader));
    }
    return status < 0 ? -1 : 0;
}

static int differ(struct replay *r, const char *what)
{
    r->found->differs = 1;
    snprintf(r->found->how, sizeof r->found->how, "%s", what);
    return -1;
}

static int move(struct replay *r, const tahr_record_move *m)
{
    tahr_status status = m->kind == TAHR_RECORD_SET    ? tahr_world_set(r->world, m->poses, m->count)
                         : m->kind == TAHR_RECORD_MOVE ? tahr_world_move(r->world, m->poses, m->count, m->dt)
                                                       : tahr_world_touch(r->world);
    return status < 0 ? differ(r, "bodies cannot be placed as they were") : 0;
}

static int create(struct replay *r, const tahr_config *recorded)
{
    tahr_config config = *recorded;
    config.sleep = 0; /* a recorded step never sleeps */
    r->actors = memory_grow(r->actors, &r->capacity, r->count + 1, sizeof *r->actors);
    struct actor *actor = &r->actors[r->count];
    *actor = (struct actor){0};
    if (tahr_mover_create(r->world, &config, &actor->mover) < 0) {
        return differ(r, "its mover cannot be created");
    }
    r->found->movers = (uint32_t)++r->count;
    return 0;
}

static int begin_step(struct replay *r, const tahr_record_step *step)
{
    if (step->config != NULL && create(r, step->config) != 0) {
        return -1;
    }
    struct actor *actor = &r->actors[step->mover];
    if (step->state != NULL) {
        actor->state = *step->state;
        actor->is_known = 1;
    }
    if (!actor->is_known) {
        return differ(r, "the state that it began with is not in the file");
    }
    r->repeats = !(step->flags & TAHR_RECORD_CUSTOM);
    if (r->repeats) {
        tahr_event events[8]; /* what is reported does not matter, but whether it is */
        tahr_report report = {.struct_size = sizeof report, .events = events, .event_capacity = 8};
        report.events = step->flags & TAHR_RECORD_EVENTS ? events : NULL;
        r->status = tahr_mover_step(actor->mover, step->input, step->dt, &actor->state, &report);
    }
    actor->is_known = r->repeats;
    return 0;
}

/* Whether a report had room for everything is no difference. */
static tahr_status counted(tahr_status status)
{
    return status == TAHR_TRUNCATED ? TAHR_OK : status;
}

static int end_step(struct replay *r, const tahr_trace_event *event)
{
    const tahr_state *state = &r->actors[event->done.mover].state;
    char what[240];
    if (!r->repeats) {
        r->found->custom++;
        return 0;
    }
    const uint64_t hash = tahr_state_hash(state);
    if (tahr_trace_difference(r->reader) != NULL) {
        return differ(r, tahr_trace_difference(r->reader));
    }
    if (counted(r->status) != counted(event->done.status)) {
        snprintf(what, sizeof what, "it returned %s, recorded is %s", tahr_status_name(r->status),
                 tahr_status_name(event->done.status));
        return differ(r, what);
    }
    if (event->queries_left > 0) {
        snprintf(what, sizeof what, "it asked %" PRIu32 " queries fewer than recorded", event->queries_left);
        return differ(r, what);
    }
    if (hash != event->done.hash) {
        snprintf(what, sizeof what,
                 "mover %" PRIu32 " came to (%.17g, %.17g, %.17g), hash %016" PRIx64 ", recorded is %016" PRIx64,
                 event->done.mover, state->position.x, state->position.y, state->position.z, hash, event->done.hash);
        return differ(r, what);
    }
    r->found->steps++;
    return 0;
}

static void repeat(struct replay *r)
{
    tahr_trace_event event;
    int failed = 0;
    while (!failed && tahr_trace_next(r->reader, &event) >= 0) {
        switch (event.kind) {
        case TAHR_TRACE_MOVE: failed = move(r, &event.move); break;
        case TAHR_TRACE_STEP: failed = begin_step(r, &event.step); break;
        case TAHR_TRACE_DONE: failed = end_step(r, &event); break;
        default: r->found->whole = 1; return;
        }
    }
}

int replay_file(const char *path, struct replayed *replayed)
{
    const tahr_log log = say_log();
    struct replay r = {.found = replayed};
    const tahr_trace_desc desc = {.struct_size = sizeof desc, .path = path, .log = &log};
    *replayed = (struct replayed){0};
    tahr_status status = tahr_trace_read(&desc, &r.reader);
    int failed = status < 0 ? -1 : open_world(&r);
    if (failed) {
        say_error("cannot replay '%s': %s", path, status < 0 ? tahr_status_message(status) : "its world does not open");
    } else {
        printf("%s: recorded on backend %s %s\n", path, tahr_trace_backend_name(r.reader),
               tahr_trace_backend_version(r.reader));
        repeat(&r);
    }
    for (size_t i = 0; i < r.count; i++) {
        tahr_mover_destroy(r.actors[i].mover);
    }
    free(r.actors);
    tahr_world_close(r.world);
    tahr_trace_reader_close(r.reader);
    return failed;
}

int replay_trace(const char *path)
{
    struct replayed found;
    if (replay_file(path, &found) != 0) {
        return EXIT_USAGE;
    }
    printf("  repeated   %" PRIu64 " steps of %" PRIu32 " character%s, each with the same queries, status and state\n",
           found.steps, found.movers, found.movers == 1 ? "" : "s");
    if (found.custom > 0) {
        printf("  left out   %" PRIu64 " steps that ran the caller's own mode\n", found.custom);
    }
    if (found.differs) {
        printf("  differs    step %" PRIu64 ": %s\n", found.steps + found.custom, found.how);
    } else if (!found.whole) {
        printf("  broken     after step %" PRIu64 "\n", found.steps + found.custom);
    }
    puts(found.whole ? "ok" : "FAILED");
    return found.whole ? EXIT_GOOD : EXIT_CHECK_FAILED;
}
