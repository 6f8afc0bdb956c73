/* SPDX-License-Identifier: MIT
 * throng.c: all characters of a run in one step, and an independent look at how near they come to each other. */
#include "throng.h"

#include "feed.h"
#include "say.h"
#include "vec.h"

#include <stdlib.h>
#include <string.h>
#include <tahr/crowd.h>
#ifdef TAHR_HAVE_THREADS
#include <tahr/threads.h>
#endif

#define LOOK_PERIOD 4 /* steps between two looks with --check sampled: all pairs that are near cost as much as a step */
#define THRONG_EVENTS 16 /* of one character in one step; more are counted as lost */

struct place {
    double x; /* m, of the centre */
    uint32_t index;
};

struct throng {
    tahr_crowd *crowd;
    void *threads;
    tahr_member *members;
    tahr_input *inputs;
    tahr_state *states;
    tahr_report *reports;
    tahr_event *events; /* THRONG_EVENTS for each */
    tahr_status *statuses;
    struct moment *moments; /* what has to be known of each before its step; without events */
    struct place *places;
    int meets; /* 1: they are obstacles of each other */
};

static int start_threads(const struct options *o, struct throng *t, tahr_crowd_desc *desc)
{
#ifdef TAHR_HAVE_THREADS
    tahr_threads *threads = NULL;
    if (o->threads > 1) {
        tahr_status status = tahr_threads_create(NULL, o->threads, &threads);
        if (status < 0) {
            say_error("--threads %u: %s", o->threads, tahr_status_message(status));
            return -1;
        }
        desc->run_tasks = tahr_threads_run;
        desc->run_user = threads;
    }
    t->threads = threads;
#else
    (void)t, (void)desc;
    if (o->threads > 1) {
        say_error("--threads %u: this tahr was built without threads", o->threads);
        return -1;
    }
#endif
    return 0;
}

int throng_open(struct run *run, struct throng **out)
{
    const struct options *o = run->options;
    const uint32_t n = o->characters;
    if (o->threads == 0 && !o->crowd) {
        return 0;
    }
    struct throng *t = memory_new(1, sizeof *t);
    tahr_crowd_desc desc;
    *out = t;
    tahr_crowd_desc_init(&desc, sizeof desc);
    desc.capacity = n;
    desc.configs = &run->config;
    desc.config_count = 1;
    if (start_threads(o, t, &desc) != 0) {
        return -1;
    }
    tahr_status status = tahr_crowd_create(run->world, &desc, &t->crowd);
    if (status < 0) {
        say_error("cannot create a crowd of %u on backend '%s': %s", n, o->backend->name, tahr_status_message(status));
        return -1;
    }
    t->meets = o->crowd;
    t->members = memory_new(n, sizeof *t->members);
    t->inputs = memory_new(n, sizeof *t->inputs);
    t->states = memory_new(n, sizeof *t->states);
    t->reports = memory_new(n, sizeof *t->reports);
    t->events = memory_new((size_t)n * THRONG_EVENTS, sizeof *t->events);
    t->statuses = memory_new(n, sizeof *t->statuses);
    t->moments = memory_new(n, sizeof *t->moments);
    t->places = memory_new(n, sizeof *t->places);
    for (uint32_t i = 0; i < n; i++) {
        t->members[i].id = i;
        t->members[i].flags = o->crowd ? 0u : (uint32_t)TAHR_MEMBER_ALONE;
    }
    return 0;
}

void throng_close(struct throng *t)
{
    if (t == NULL) {
        return;
    }
    tahr_crowd_destroy(t->crowd);
#ifdef TAHR_HAVE_THREADS
    tahr_threads_destroy(t->threads);
#endif
    free(t->members);
    free(t->inputs);
    free(t->states);
    free(t->reports);
    free(t->events);
    free(t->statuses);
    free(t->moments);
    free(t->places);
    free(t);
}

static int compare_places(const void *a, const void *b)
{
    const struct place *p = a, *q = b;
    return p->x < q->x ? -1 : p->x > q->x;
}

/* m between two upright capsules. */
static double apart(const tahr_state *a, const tahr_state *b)
{
    tahr_vec3 d = vec_sub(a->position, b->position);
    double high = vec_dot(d, a->up), straight = a->half_height - a->radius + b->half_height - b->radius;
    double level2 = vec_dot(d, d) - high * high;
    high = most(most(high, -high) - straight, 0);
    return sqrt(most(level2, 0) + high * high) - a->radius - b->radius;
}

/* How near do any two come that were apart before the step? Who overlapped before it (at a crowded start, or where he
 * was brought back to) only has to get out of it. Sorted along x, only those that follow each other closely can be
 * near. Boxes are not looked at. */
static void look(struct run *run, struct throng *t)
{
    const uint32_t n = run->config.shape.type == TAHR_SHAPE_BOX ? 0 : run->options->characters;
    const double reach = 2 * run->config.shape.radius + 1;
    for (uint32_t i = 0; i < n; i++) {
        t->places[i] = (struct place){t->states[i].position.x, i};
    }
    qsort(t->places, n, sizeof *t->places, compare_places);
    for (uint32_t i = 0; i < n; i++) {
        for (uint32_t j = i + 1; j < n && t->places[j].x - t->places[i].x < reach; j++) {
            const uint32_t p = t->places[i].index, q = t->places[j].index;
            if (apart(&run->characters[p].state, &run->characters[q].state) >= 0) {
                run->result.least_apart = least(run->result.least_apart, apart(&t->states[p], &t->states[q]));
            }
        }
    }
}

static void prepare(struct run *run, struct throng *t, uint32_t i, uint64_t step, double time)
{
    const struct character *character = &run->characters[i];
    struct moment *m = &t->moments[i];
    m->step = step;
    m->index = i;
    m->time = time;
    throng_input(run, m);
    m->before = character->state.position;
    m->flags_before = character->state.flags;
    m->shape_before = shape_now(&run->config, &character->state);
    feed_begin(run->feed, i, &character->state);
    t->inputs[i] = m->input;
    t->states[i] = character->state;
    t->reports[i] = (tahr_report){.struct_size = sizeof *t->reports,
                                  .events = t->events + (size_t)i * THRONG_EVENTS,
                                  .event_capacity = THRONG_EVENTS};
}

int throng_step(struct run *run, struct throng *t, uint64_t step, double time)
{
    const uint32_t n = run->options->characters;
    tahr_crowd_tick tick;
    tahr_crowd_tick_init(&tick, sizeof tick);
    tick.count = n;
    tick.dt = run->dt;
    tick.members = t->members;
    tick.inputs = t->inputs;
    tick.states = t->states;
    tick.reports = t->reports;
    tick.statuses = t->statuses;
    for (uint32_t i = 0; i < n; i++) {
        prepare(run, t, i, step, time);
    }
    uint64_t before = clock_ns();
    tahr_status status = tahr_crowd_step(t->crowd, &tick);
    uint64_t ns = clock_ns() - before, clock = (uint64_t)run->result.clock_cost;
    times_add(&run->result.times, (ns > clock ? ns - clock : 0) / n);
    if (status < 0) {
        say_error("step %llu: %s", (unsigned long long)step, tahr_status_message(status));
        return -1;
    }
    if (t->meets && run->options->check != CHECK_OFF && (run->options->check == CHECK_ALL || step % LOOK_PERIOD == 0)) {
        look(run, t);
    }
    for (uint32_t i = 0; i < n; i++) {
        t->moments[i].report = t->reports[i];
        run->characters[i].state = t->states[i];
        feed_step(run->feed, run, &t->moments[i], t->statuses[i], 0, t->meets ? TAHR_STEP_CROWD : 0);
        moment_watch(run, &t->moments[i], &run->characters[i]);
    }
    return 0;
}
