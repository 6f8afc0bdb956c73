/* SPDX-License-Identifier: MIT
 * feed.c: what a run publishes over LCM while it goes on. */
#include "feed.h"

#ifdef TAHR_HAVE_LCM

#include "interrupt.h"
#include "pace.h"
#include "say.h"
#include "scene.h"

#include <stdlib.h>
#include <string.h>
#include <tahr/lcm.h>
#include <tahr/telemetry.h>

enum {
    RING_LEAST = 4 << 20,  /* bytes: the telemetry's own */
    RING_MOST = 1 << 30,   /* its limit */
    RING_CHARACTER = 4096, /* so that four ticks of everybody fit, at some 1000 bytes for each step */
    MESSAGE_BYTES = 640    /* of the ring, for which the largest message stands: all of a state and its head */
};

#define STALLED 5.0 /* s without a message taken, after which a run waits no more: it drops and counts */
#define LEAVE 10.0  /* s for what is left at the end */

struct feed {
    tahr_telemetry *telemetry;
    tahr_lcm *lcm;
    struct pace pace;      /* speed 0: who takes it sets the pace */
    uint64_t most_waiting; /* messages in the ring at the beginning of a tick */
    int stalled;
};

/* Only a network is watched live. */
static int is_network(const char *url)
{
    return strncmp(url, "file://", 7) != 0 && strncmp(url, "memq://", 7) != 0;
}

static int open_sink(struct run *run, struct feed *feed)
{
    const struct options *o = run->options;
    const tahr_log log = say_log();
    tahr_lcm_desc desc;
    tahr_lcm_desc_init(&desc, sizeof desc);
    desc.url = o->lcm;
    desc.prefix = o->lcm_prefix;
    desc.log = &log;
    tahr_status status = tahr_lcm_open(&desc, &feed->lcm);
    if (status == TAHR_E_NOT_FOUND) {
        say_error("--lcm '%s': cannot be reached; the run goes on without it", o->lcm);
        return 1;
    }
    if (status < 0) {
        say_error("--lcm '%s': cannot be published to", o->lcm);
        return -1;
    }
    return 0;
}

static int open_telemetry(const struct run *run, struct feed *feed)
{
    const struct options *o = run->options;
    const tahr_log log = say_log();
    const uint64_t wanted = (uint64_t)o->characters * RING_CHARACTER;
    tahr_telemetry_desc desc;
    tahr_telemetry_desc_init(&desc, sizeof desc);
    desc.sink = tahr_lcm_sink(feed->lcm);
    desc.characters = o->characters;
    desc.ring_bytes = wanted < RING_LEAST ? RING_LEAST : wanted > RING_MOST ? RING_MOST : (uint32_t)wanted;
    desc.bodies = (uint32_t)run->level.mover_count;
    desc.configs = &run->config;
    desc.config_count = 1;
    desc.state_rate = o->lcm_rate;
    desc.level = run->level.name;
    desc.level_hash = scene_hash(&run->level);
    desc.backend = o->backend->name;
    desc.revision = tahr_world_revision(run->world);
    desc.log = &log;
    feed->most_waiting = desc.ring_bytes / MESSAGE_BYTES / 4;
    tahr_status status = tahr_telemetry_create(&desc, &feed->telemetry);
    if (status < 0) {
        say_error("--lcm '%s': %s", o->lcm, tahr_status_message(status));
    }
    return status < 0 ? -1 : 0;
}

int feed_open(struct run *run, struct feed **out)
{
    if (run->options->lcm == NULL) {
        return 0;
    }
    struct feed *feed = memory_new(1, sizeof *feed);
    int failed = open_sink(run, feed);
    if (failed == 0) {
        failed = open_telemetry(run, feed);
    }
    if (failed != 0) {
        tahr_lcm_close(feed->lcm);
        free(feed);
        return failed < 0 ? -1 : 0;
    }
    run->result.lcm.open = 1;
    feed->pace.speed = is_network(run->options->lcm) && !run->options->fast ? 1 : 0;
    interrupt_watch(); /* who watches may have seen enough */
    *out = feed;
    return 0;
}

static struct tahr_telemetry_counts counts_of(const struct feed *feed)
{
    tahr_telemetry_counts counts = {.struct_size = sizeof counts};
    tahr_telemetry_get_counts(feed->telemetry, &counts);
    return counts;
}

void feed_close(struct run *run, struct feed *feed)
{
    if (feed == NULL) {
        return;
    }
    const tahr_status status = tahr_telemetry_stop(feed->telemetry, TAHR_STOP_DRAIN, LEAVE);
    const tahr_telemetry_counts counts = counts_of(feed);
    struct feed_counts *lcm = &run->result.lcm;
    for (int kind = 0; kind < TAHR_MESSAGE_COUNT; kind++) {
        lcm->sent += counts.delivered[kind];
        lcm->thinned += counts.thinned[kind];
        lcm->dropped += counts.dropped[kind];
        lcm->failed += counts.failed[kind];
    }
    tahr_telemetry_destroy(feed->telemetry);
    if (status == TAHR_E_TIMEOUT) {
        say_error("--lcm '%s': does not take what is left", run->options->lcm);
    } else {
        tahr_lcm_close(feed->lcm);
    }
    free(feed);
}

/* Messages that nobody has taken yet. */
static uint64_t waiting(const struct feed *feed, uint64_t *taken)
{
    const tahr_telemetry_counts counts = counts_of(feed);
    uint64_t all = 0;
    *taken = 0;
    for (int kind = 0; kind < TAHR_MESSAGE_COUNT; kind++) {
        all += counts.offered[kind] - counts.thinned[kind] - counts.dropped[kind];
        *taken += counts.delivered[kind] + counts.failed[kind];
    }
    return all > *taken ? all - *taken : 0;
}

void feed_wait(struct feed *feed, double time)
{
    uint64_t taken = 0, before = 0, since = 0;
    if (feed == NULL) {
        return;
    }
    if (feed->pace.speed > 0) {
        pace_wait(&feed->pace, time);
        return;
    }
    while (!feed->stalled && waiting(feed, &taken) > feed->most_waiting && !interrupt_came()) {
        since = taken != before || since == 0 ? clock_ns() : since;
        before = taken;
        feed->stalled = (double)(clock_ns() - since) * 1e-9 > STALLED;
        pace_sleep(0.0005);
    }
}

void feed_bodies(struct feed *feed, const struct run *run)
{
    if (feed != NULL) {
        tahr_telemetry_change(feed->telemetry, TAHR_CHANGE_MOVE, run->poses, (uint32_t)run->level.mover_count, run->dt,
                              tahr_world_revision(run->world));
    }
}

void feed_begin(struct feed *feed, uint32_t character, const tahr_state *state)
{
    if (feed != NULL) {
        tahr_telemetry_begin(feed->telemetry, 0, character, 0, state);
    }
}

void feed_step(struct feed *feed, const struct run *run, const struct moment *m, tahr_status status, uint64_t ns,
               uint32_t flags)
{
    if (feed != NULL) {
        tahr_telemetry_push(feed->telemetry, 0,
                            &(tahr_telemetry_step){.character = m->index,
                                                   .status = status,
                                                   .input = &m->input,
                                                   .state = &run->characters[m->index].state,
                                                   .report = &m->report,
                                                   .dt = run->dt,
                                                   .ns = ns,
                                                   .flags = flags});
    }
}

#else

#include "say.h"

int feed_open(struct run *run, struct feed **feed)
{
    (void)feed;
    if (run->options->lcm != NULL) {
        say_error("--lcm '%s': this tahr was built without LCM", run->options->lcm);
    }
    return run->options->lcm != NULL ? -1 : 0;
}

void feed_close(struct run *run, struct feed *feed)
{
    (void)run, (void)feed;
}

void feed_wait(struct feed *feed, double time)
{
    (void)feed, (void)time;
}

void feed_bodies(struct feed *feed, const struct run *run)
{
    (void)feed, (void)run;
}

void feed_begin(struct feed *feed, uint32_t character, const tahr_state *state)
{
    (void)feed, (void)character, (void)state;
}

void feed_step(struct feed *feed, const struct run *run, const struct moment *m, tahr_status status, uint64_t ns,
               uint32_t flags)
{
    (void)feed, (void)run, (void)m, (void)status, (void)ns, (void)flags;
}

#endif
