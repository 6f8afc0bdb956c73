/* SPDX-License-Identifier: MIT
 * deliver.c: a record, told to the sink message by message. Hashing is done here, far from who steps. */
#include <tahr/state.h>

#include "record.h"
#include "telemetry.h"
#include "words.h"

void tahr__deliver_count(tahr_telemetry *t, uint32_t message, tahr_status status)
{
    tahr__tally_add(status < 0 ? &t->drain.failed : &t->drain.delivered, message, 1);
    if (status < 0) atomic_store_explicit(&t->drain.last_failure, status, memory_order_relaxed);
    t->drain.told++;
}

/* Whether the sink may still be called; if not, the message is counted. */
static int may_tell(tahr_telemetry *t, uint32_t message)
{
    const int may = !tahr__is_abandoned(t);
    if (!may) tahr__tally_add(&t->drain.dropped, message, 1);
    return may;
}

static void deliver_events(tahr_telemetry *t, const uint64_t *words, const tahr__record_step *r, tahr_stamp stamp)
{
    const int64_t begin = r->time_ns - (int64_t)(r->dt * 1e9 + 0.5);
    stamp.sequence = r->sequence[TAHR_MESSAGE_EVENT];
    for (uint64_t i = 0; i < r->events; i++, stamp.sequence++) {
        tahr_event event;
        memcpy(&event, words + i * TAHR__EVENT_WORDS, sizeof event);
        stamp.time_ns = begin + (int64_t)(event.time * 1e9 + 0.5);
        if (may_tell(t, TAHR_MESSAGE_EVENT))
            tahr__deliver_count(t, TAHR_MESSAGE_EVENT, t->sink.event(t->sink.user, &stamp, &event));
    }
}

static void deliver_report(tahr_telemetry *t, tahr_report *report, const tahr__record_step *r, tahr_stamp stamp)
{
    if (!may_tell(t, TAHR_MESSAGE_REPORT)) return;
    report->struct_size = sizeof *report;
    report->events = NULL;
    report->decisions = NULL;
    report->queries = NULL;
    const tahr_sink_report told = {
        .report = report, .hash = tahr_state_hash(&t->drain.last[r->character]), .ns = r->ns, .status = r->status};
    stamp.sequence = r->sequence[TAHR_MESSAGE_REPORT];
    tahr__deliver_count(t, TAHR_MESSAGE_REPORT, t->sink.report(t->sink.user, &stamp, &told));
}

static void deliver_input(tahr_telemetry *t, tahr_input *input, const tahr__record_step *r, tahr_stamp stamp)
{
    if (!may_tell(t, TAHR_MESSAGE_INPUT)) return;
    input->struct_size = sizeof *input;
    const tahr_sink_input told = {.input = input, .dt = r->dt, .flags = r->flags};
    stamp.sequence = r->sequence[TAHR_MESSAGE_INPUT];
    tahr__deliver_count(t, TAHR_MESSAGE_INPUT, t->sink.input(t->sink.user, &stamp, &told));
}

/* Returns what comes after it. */
static const uint64_t *read_input(const uint64_t *words, tahr_input *input)
{
    memcpy(input, words, TAHR__PLAIN_INPUT_WORDS * 8);
    if (input->flags == 0) return words + TAHR__PLAIN_INPUT_WORDS;
    memcpy(input, words, sizeof *input);
    return words + TAHR__INPUT_WORDS;
}

/* Returns what comes after it. */
static const uint64_t *read_state(const uint64_t *words, tahr_state *state)
{
    tahr__motion_apply((const void *)words, state);
    return tahr__words_unpack(words + sizeof(tahr__motion) / 8, state);
}

static void deliver_step(tahr_telemetry *t, const tahr__record_step *r)
{
    const uint32_t parts = r->head.parts;
    const uint64_t *words = (const uint64_t *)(const void *)(r + 1);
    tahr_state *state = &t->drain.last[r->character];
    tahr_stamp stamp = {.character = r->character,
                        .config = r->config,
                        .step = r->step,
                        .epoch = r->head.epoch,
                        .time_ns = r->time_ns,
                        .wall_ns = r->wall_ns ? r->wall_ns : tahr__clock_ns(CLOCK_REALTIME)};
    tahr_input input = {0};
    tahr_report report = {0};
    if (parts & 1u << TAHR_MESSAGE_INPUT) words = read_input(words, &input);
    if (parts & (1u << TAHR_MESSAGE_STATE | 1u << TAHR_MESSAGE_REPORT)) words = read_state(words, state);
    if (parts & 1u << TAHR_MESSAGE_REPORT) {
        memcpy(&report, words, sizeof report);
        words += TAHR__REPORT_WORDS;
    }
    if (parts & 1u << TAHR_MESSAGE_INPUT) deliver_input(t, &input, r, stamp);
    deliver_events(t, words, r, stamp);
    if (parts & 1u << TAHR_MESSAGE_STATE && may_tell(t, TAHR_MESSAGE_STATE)) {
        stamp.sequence = r->sequence[TAHR_MESSAGE_STATE];
        tahr__deliver_count(t, TAHR_MESSAGE_STATE, t->sink.state(t->sink.user, &stamp, state));
    }
    if (parts & 1u << TAHR_MESSAGE_REPORT) deliver_report(t, &report, r, stamp);
}

static void deliver_snapshot(tahr_telemetry *t, const tahr__record_snapshot *r)
{
    tahr_state *state = &t->drain.last[r->character];
    const tahr_stamp stamp = {.character = r->character,
                              .config = r->config,
                              .step = r->step,
                              .sequence = r->sequence,
                              .epoch = r->head.epoch,
                              .time_ns = r->time_ns,
                              .wall_ns = tahr__clock_ns(CLOCK_REALTIME)};
    read_state((const uint64_t *)(const void *)(r + 1), state);
    if (may_tell(t, TAHR_MESSAGE_SNAPSHOT))
        tahr__deliver_count(t, TAHR_MESSAGE_SNAPSHOT, t->sink.snapshot(t->sink.user, &stamp, state));
}

static void deliver_change(tahr_telemetry *t, const tahr__record_change *r)
{
    const tahr_body_pose *poses = (const tahr_body_pose *)(const void *)(r + 1);
    const int is_snapshot = r->head.parts == TAHR_CHANGE_SNAPSHOT;
    const tahr_sink_change change = {.kind = r->head.parts,
                                     .count = (uint32_t)r->count,
                                     .poses = r->count ? poses : NULL,
                                     .before = is_snapshot ? poses + r->count : NULL,
                                     .dt = r->dt,
                                     .epoch = r->head.epoch,
                                     .revision = r->revision,
                                     .wall_ns = tahr__clock_ns(CLOCK_REALTIME)};
    if (may_tell(t, TAHR_MESSAGE_BODY))
        tahr__deliver_count(t, TAHR_MESSAGE_BODY, t->sink.change(t->sink.user, &change));
}

void tahr__deliver(tahr_telemetry *t, const void *record)
{
    const tahr__record *head = record;
    if (head->kind == TAHR__RECORD_STEP) deliver_step(t, record);
    if (head->kind == TAHR__RECORD_SNAPSHOT) deliver_snapshot(t, record);
    if (head->kind == TAHR__RECORD_CHANGE) deliver_change(t, record);
}
