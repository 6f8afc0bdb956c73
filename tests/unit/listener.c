/* SPDX-License-Identifier: MIT
 * listener.c: counts what a telemetry tells, behind a gate that a test can close. */
#include "listener.h"

#include <string.h>

void listener_expect(listener *l, int condition, const char *what)
{
    const char *nothing = NULL;
    if (!condition) atomic_compare_exchange_strong(&l->wrong, &nothing, what);
}

static tahr_status heard(listener *l, uint32_t message, const tahr_stamp *stamp)
{
    pthread_mutex_lock(&l->lock);
    l->inside = 1;
    pthread_cond_broadcast(&l->changed);
    while (l->closed)
        pthread_cond_wait(&l->changed, &l->lock);
    l->inside = 0;
    pthread_mutex_unlock(&l->lock);
    l->got[message]++;
    if (stamp) {
        uint64_t *next = &l->next[message][stamp->character % LISTENER_CHARACTERS];
        listener_expect(l, stamp->sequence >= *next, "sequences that only grow");
        l->missed[message] += stamp->sequence - *next;
        *next = stamp->sequence + 1;
    }
    if (l->fail_every == 0 || ++l->calls % l->fail_every != 0) return TAHR_OK;
    l->failed[message]++;
    return TAHR_E_FILE;
}

static tahr_status hear_state(void *user, const tahr_stamp *stamp, const tahr_state *state)
{
    listener *l = user;
    if (l->on_state) l->on_state(l->test, stamp, state);
    return heard(l, TAHR_MESSAGE_STATE, stamp);
}

static tahr_status hear_event(void *user, const tahr_stamp *stamp, const tahr_event *event)
{
    listener *l = user;
    if (l->on_event) l->on_event(l->test, stamp, event);
    return heard(l, TAHR_MESSAGE_EVENT, stamp);
}

static tahr_status hear_input(void *user, const tahr_stamp *stamp, const tahr_sink_input *input)
{
    listener *l = user;
    if (l->on_input) l->on_input(l->test, stamp, input);
    return heard(l, TAHR_MESSAGE_INPUT, stamp);
}

static tahr_status hear_report(void *user, const tahr_stamp *stamp, const tahr_sink_report *report)
{
    listener *l = user;
    if (l->on_report) l->on_report(l->test, stamp, report);
    return heard(l, TAHR_MESSAGE_REPORT, stamp);
}

static tahr_status hear_snapshot(void *user, const tahr_stamp *stamp, const tahr_state *state)
{
    listener *l = user;
    if (l->on_snapshot) l->on_snapshot(l->test, stamp, state);
    return heard(l, TAHR_MESSAGE_SNAPSHOT, stamp);
}

static tahr_status hear_change(void *user, const tahr_sink_change *change)
{
    listener *l = user;
    if (l->on_change) l->on_change(l->test, change);
    return heard(l, TAHR_MESSAGE_BODY, NULL);
}

static tahr_status hear_world(void *user, const tahr_sink_world *world)
{
    listener *l = user;
    if (l->on_world) l->on_world(l->test, world);
    return heard(l, TAHR_MESSAGE_WORLD, NULL);
}

static void hear_flush(void *user)
{
    listener *l = user;
    l->flushes++;
}

void listener_init(listener *l, void *test)
{
    memset(l, 0, sizeof *l);
    l->test = test;
    l->sink = (tahr_sink){.struct_size = sizeof l->sink,
                          .abi_major = TAHR_ABI_MAJOR,
                          .abi_minor = TAHR_ABI_MINOR,
                          .name = "listener",
                          .user = l,
                          .state = hear_state,
                          .event = hear_event,
                          .input = hear_input,
                          .report = hear_report,
                          .snapshot = hear_snapshot,
                          .change = hear_change,
                          .world = hear_world,
                          .flush = hear_flush};
    pthread_mutex_init(&l->lock, NULL);
    pthread_cond_init(&l->changed, NULL);
}

void listener_end(listener *l)
{
    pthread_cond_destroy(&l->changed);
    pthread_mutex_destroy(&l->lock);
}

void listener_describe(listener *l, uint32_t characters, tahr_telemetry_desc *desc)
{
    static tahr_config config;
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    tahr_telemetry_desc_init(desc, sizeof *desc);
    desc->sink = &l->sink;
    desc->characters = characters;
    desc->configs = &config;
    desc->config_count = 1;
}

static void set_gate(listener *l, int closed)
{
    pthread_mutex_lock(&l->lock);
    l->closed = closed;
    pthread_cond_broadcast(&l->changed);
    pthread_mutex_unlock(&l->lock);
}

void listener_close(listener *l)
{
    set_gate(l, 1);
}

void listener_open(listener *l)
{
    set_gate(l, 0);
}

void listener_wait_for_call(listener *l)
{
    pthread_mutex_lock(&l->lock);
    while (!l->inside)
        pthread_cond_wait(&l->changed, &l->lock);
    pthread_mutex_unlock(&l->lock);
}

/* splitmix64 */
uint64_t made_up_number(made_up *m)
{
    uint64_t z = m->random += 0x9E3779B97F4A7C15u;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
    z = (z ^ z >> 27) * 0x94D049BB133111EBu;
    return z ^ z >> 31;
}

void made_up_init(made_up *m, uint64_t seed)
{
    memset(m, 0, sizeof *m);
    m->random = seed;
    m->input.struct_size = sizeof m->input;
    m->report.struct_size = sizeof m->report;
    m->report.events = m->events;
    m->report.event_capacity = 4;
}

void made_up_change(made_up *m)
{
    uint64_t word = made_up_number(m) % 3 ? made_up_number(m) : 0;
    memcpy((char *)&m->state + 8 * (made_up_number(m) % 64), &word, sizeof word);
}

void made_up_step(made_up *m)
{
    for (uint64_t n = made_up_number(m) % 20; n > 0; n--)
        made_up_change(m);
    m->input.flags = made_up_number(m) % 4 ? 0 : TAHR_INPUT_LAUNCH;
    m->input.move.x = (double)(made_up_number(m) % 1000);
    m->input.launch.y = m->input.flags ? (double)(made_up_number(m) % 1000) : 0;
    m->report.sweeps = (uint32_t)made_up_number(m);
    m->report.time_lost = (double)(made_up_number(m) % 7);
    m->report.event_count = made_up_number(m) % 3 ? 0 : (uint32_t)(made_up_number(m) % 5);
    for (uint32_t i = 0; i < m->report.event_count; i++)
        m->events[i] = (tahr_event){.type = i + 1, .body = (uint32_t)made_up_number(m), .time = 0.001 * i};
}

tahr_telemetry_step made_up_pushed(const made_up *m, uint32_t character)
{
    return (tahr_telemetry_step){
        .character = character, .input = &m->input, .state = &m->state, .report = &m->report, .dt = 0.004};
}
