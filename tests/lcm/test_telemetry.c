/* SPDX-License-Identifier: MIT
 * From the step to the subscriber: what arrives is what was stepped. */
#include "inbox.h"
#include "quiet.h"

#include <tahr/tahr.h>
#include <tahr/lcm.h>
#include <tahr/native.h>
#include <tahr/telemetry.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { CHARACTERS = 5, STEPS = 240, MOST_EVENTS = 16, LIFT = 1 };

#define DT (1.0 / 60.0)

/* One step as it was taken. */
typedef struct page {
    tahr_state before, after;
    tahr_input input;
    tahr_report report;
    tahr_event events[MOST_EVENTS];
    tahr_status status;
    uint64_t epoch;
} page;

/* A run, and what was heard of it. */
typedef struct ledger {
    page pages[CHARACTERS][STEPS];
    uint64_t epoch;
    tahr_body_pose lift[STEPS + 1]; /* by epoch */
    uint64_t heard[TAHR_MESSAGE_COUNT];
    uint64_t event_sequence[CHARACTERS];
    uint64_t events[CHARACTERS][STEPS]; /* heard of each step */
    uint64_t wrong;                     /* messages that say something else than the pages */
    tahr_telemetry_counts counts;
} ledger;

static void count_wrong(ledger *l, const char *what, int is_right)
{
    if (is_right) return;
    if (l->wrong++ < 5) print_message("differs: %s\n", what);
}

static int is_same(const void *a, const void *b, size_t size)
{
    return memcmp(a, b, size) == 0;
}

/* The page that a message is about, or NULL. */
static page *page_of(ledger *l, int32_t character, int64_t step)
{
    const int is_there = character >= 0 && character < CHARACTERS && step >= 0 && step < STEPS;
    count_wrong(l, "a character or a step that was not", is_there);
    return is_there ? &l->pages[character][step] : NULL;
}

static void hear_state(const lcm_recv_buf_t *buffer, const char *channel, const tahr_state_t *m, void *user)
{
    ledger *l = user;
    const page *p = page_of(l, m->character, m->step);
    (void)buffer, (void)channel;
    l->heard[TAHR_MESSAGE_STATE]++;
    if (!p) return;
    count_wrong(l, "state",
                is_same(m->position, &p->after.position, sizeof m->position) &&
                    is_same(m->velocity, &p->after.velocity, sizeof m->velocity) &&
                    is_same(m->orientation, &p->after.orientation, sizeof m->orientation) &&
                    m->mode == (int32_t)p->after.mode && m->flags == (int32_t)p->after.flags &&
                    m->base_body == (int32_t)p->after.base.body &&
                    is_same(&m->floor_distance, &p->after.floor.distance, sizeof m->floor_distance) &&
                    m->sequence == m->step);
}

static void hear_event(const lcm_recv_buf_t *buffer, const char *channel, const tahr_event_t *m, void *user)
{
    ledger *l = user;
    const page *p = page_of(l, m->character, m->step);
    (void)buffer, (void)channel;
    l->heard[TAHR_MESSAGE_EVENT]++;
    if (!p) return;
    const uint64_t index = l->events[m->character][m->step]++;
    if (index >= p->report.event_count) {
        count_wrong(l, "more events than there were", 0);
        return;
    }
    const tahr_event *e = &p->events[index];
    count_wrong(l, "event",
                m->type == (int32_t)e->type && m->body == (int32_t)e->body && m->value == e->value &&
                    is_same(m->position, &e->position, sizeof m->position) &&
                    is_same(m->normal, &e->normal, sizeof m->normal) &&
                    m->sequence == (int64_t)l->event_sequence[m->character]++);
}

static void hear_input(const lcm_recv_buf_t *buffer, const char *channel, const tahr_input_t *m, void *user)
{
    ledger *l = user;
    const page *p = page_of(l, m->character, m->step);
    (void)buffer, (void)channel;
    l->heard[TAHR_MESSAGE_INPUT]++;
    if (!p) return;
    count_wrong(l, "input",
                m->dt == DT && m->jump == (int32_t)p->input.jump && m->crouch == (int32_t)p->input.crouch &&
                    m->flags == (int32_t)p->input.flags && m->epoch == (int64_t)p->epoch &&
                    is_same(m->move, &p->input.move, sizeof m->move) && m->config == 0);
}

static void hear_report(const lcm_recv_buf_t *buffer, const char *channel, const tahr_report_t *m, void *user)
{
    ledger *l = user;
    const page *p = page_of(l, m->character, m->step);
    (void)buffer, (void)channel;
    l->heard[TAHR_MESSAGE_REPORT]++;
    if (!p) return;
    count_wrong(l, "report",
                (uint64_t)m->state_hash == tahr_state_hash(&p->after) && m->status == p->status &&
                    m->sweeps == (int32_t)p->report.sweeps && m->flags == (int32_t)p->report.flags &&
                    m->event_count == (int32_t)p->report.event_count &&
                    is_same(m->saved, p->report.saved, sizeof m->saved));
}

static void hear_snapshot(const lcm_recv_buf_t *buffer, const char *channel, const tahr_snapshot_t *m, void *user)
{
    ledger *l = user;
    const page *p = page_of(l, m->character, m->step);
    (void)buffer, (void)channel;
    l->heard[TAHR_MESSAGE_SNAPSHOT]++;
    if (!p) return;
    count_wrong(l, "snapshot",
                m->size == (int32_t)sizeof p->before && is_same(m->state, &p->before, sizeof p->before) &&
                    (uint64_t)m->state_hash == tahr_state_hash(&p->before));
}

static void hear_body(const lcm_recv_buf_t *buffer, const char *channel, const tahr_body_t *m, void *user)
{
    ledger *l = user;
    (void)buffer, (void)channel;
    l->heard[TAHR_MESSAGE_BODY]++;
    if (m->kind == TAHR_BODY_T_SNAPSHOT) return;
    const int is_there = m->epoch >= 1 && m->epoch <= STEPS;
    count_wrong(l, "body",
                is_there && m->kind == TAHR_BODY_T_MOVE && m->body == LIFT && m->count == 1 && m->index == 0 &&
                    m->dt == DT && is_same(m->position, &l->lift[m->epoch].pose.position, sizeof m->position));
}

static void hear_world(const lcm_recv_buf_t *buffer, const char *channel, const tahr_world_t *m, void *user)
{
    ledger *l = user;
    (void)buffer, (void)channel;
    l->heard[TAHR_MESSAGE_WORLD]++;
    count_wrong(l, "world",
                strcmp(m->level, "lift") == 0 && strcmp(m->backend, "native") == 0 && m->characters == CHARACTERS &&
                    m->config_count == 1 && m->size == (int32_t)sizeof(tahr_config));
}

/* A floor, and a lift upon it. */
static tahr_world *open_world(void)
{
    tahr_body_desc bodies[2];
    tahr_world_desc desc;
    tahr_world *world;
    for (int i = 0; i < 2; i++)
        assert_int_equal(tahr_body_desc_init(&bodies[i], sizeof bodies[i], TAHR_BODY_BOX), TAHR_OK);
    bodies[0].half_extents = (tahr_vec3){50, 50, 1};
    bodies[0].pose.position = (tahr_vec3){0, 0, -1};
    bodies[LIFT].half_extents = (tahr_vec3){2, 2, 0.1};
    bodies[LIFT].pose.position = (tahr_vec3){0, 0, 0.1};
    bodies[LIFT].flags = TAHR_BODY_MOVABLE;
    assert_int_equal(tahr_world_desc_init(&desc, sizeof desc), TAHR_OK);
    desc.bodies = bodies;
    desc.body_count = 2;
    assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &world), TAHR_OK);
    return world;
}

static void move_lift(ledger *l, tahr_world *world, tahr_telemetry *telemetry, int step)
{
    tahr_body_pose *pose = &l->lift[++l->epoch];
    *pose = (tahr_body_pose){.body = LIFT, .pose = {.orientation = {0, 0, 0, 1}}};
    pose->pose.position = (tahr_vec3){0, 0, 0.1 + 0.01 * (step % 60)};
    assert_int_equal(tahr_world_move(world, pose, 1, DT), TAHR_OK);
    assert_int_equal(tahr_telemetry_change(telemetry, TAHR_CHANGE_MOVE, pose, 1, DT, tahr_world_revision(world)),
                     TAHR_OK);
}

static void take_step(page *p, tahr_telemetry *telemetry, tahr_mover *mover, uint32_t character, int step,
                      tahr_state *state)
{
    p->input = (tahr_input){.struct_size = sizeof p->input};
    p->input.move = (tahr_vec3){character % 2 ? 1 : -0.5, 0.25 * character, 0};
    p->input.jump = (uint32_t)(step + 7 * (int)character) / 20 % 2;
    p->report = (tahr_report){.struct_size = sizeof p->report, .events = p->events, .event_capacity = MOST_EVENTS};
    p->before = *state;
    assert_int_equal(tahr_telemetry_begin(telemetry, 0, character, 0, state), TAHR_OK);
    p->status = tahr_mover_step(mover, &p->input, DT, state, &p->report);
    assert_true(p->status >= 0);
    p->after = *state;
    const tahr_telemetry_step taken = {.character = character,
                                       .status = p->status,
                                       .input = &p->input,
                                       .state = state,
                                       .report = &p->report,
                                       .dt = DT};
    assert_int_equal(tahr_telemetry_push(telemetry, 0, &taken), TAHR_OK);
}

/* Steps everybody, tells the sink, and stops the telemetry when all is told. */
static void run(ledger *l, const tahr_sink *sink)
{
    tahr_world *world = open_world();
    tahr_config config;
    tahr_telemetry_desc desc;
    tahr_telemetry *telemetry;
    tahr_mover *mover;
    tahr_state states[CHARACTERS];

    assert_int_equal(tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE), TAHR_OK);
    assert_int_equal(tahr_mover_create(world, &config, &mover), TAHR_OK);
    assert_int_equal(tahr_telemetry_desc_init(&desc, sizeof desc), TAHR_OK);
    desc.sink = sink;
    desc.characters = CHARACTERS;
    desc.bodies = 2;
    desc.configs = &config;
    desc.config_count = 1;
    desc.snapshot_period = 1;
    desc.level = "lift";
    desc.backend = tahr_world_backend_name(world);
    desc.revision = tahr_world_revision(world);
    assert_int_equal(tahr_telemetry_create(&desc, &telemetry), TAHR_OK);
    for (uint32_t c = 0; c < CHARACTERS; c++)
        assert_int_equal(tahr_state_init(&states[c], &config, &(tahr_vec3){c - 2.0, 0.5 * c, 1.5}), TAHR_OK);
    for (int step = 0; step < STEPS; step++) {
        move_lift(l, world, telemetry, step);
        for (uint32_t c = 0; c < CHARACTERS; c++) {
            l->pages[c][step].epoch = l->epoch;
            take_step(&l->pages[c][step], telemetry, mover, c, step, &states[c]);
        }
    }
    assert_int_equal(tahr_telemetry_stop(telemetry, TAHR_STOP_DRAIN, 60), TAHR_OK);
    l->counts.struct_size = sizeof l->counts;
    assert_int_equal(tahr_telemetry_get_counts(telemetry, &l->counts), TAHR_OK);
    tahr_telemetry_destroy(telemetry);
    tahr_mover_destroy(mover);
    tahr_world_close(world);
}

#define EACH_KIND(X)             \
    X(state, "TAHR_STATE")       \
    X(event, "TAHR_EVENT")       \
    X(input, "TAHR_INPUT")       \
    X(report, "TAHR_REPORT")     \
    X(snapshot, "TAHR_SNAPSHOT") \
    X(body, "TAHR_BODY")         \
    X(world, "TAHR_WORLD")

/* Hears what a run tells a sink of that lcm_t; or, without a sink, all that a log holds. */
static void listen_to(lcm_t *lcm, ledger *l, const tahr_sink *sink)
{
#define BEGIN(kind, channel)                                                                             \
    tahr_##kind##_t_subscription_t *of_##kind = tahr_##kind##_t_subscribe(lcm, channel, hear_##kind, l); \
    tahr_##kind##_t_subscription_set_queue_capacity(of_##kind, 1 << 20);
    EACH_KIND(BEGIN)
    if (sink) run(l, sink);
    while (lcm_handle_timeout(lcm, sink ? 0 : 5000) > 0) {
    }
#define END(kind, channel) tahr_##kind##_t_unsubscribe(lcm, of_##kind);
    EACH_KIND(END)
}

static void check_heard(const ledger *l)
{
    uint64_t events = 0;
    assert_int_equal(l->wrong, 0);
    for (int c = 0; c < CHARACTERS; c++) {
        for (int s = 0; s < STEPS; s++) {
            events += l->pages[c][s].report.event_count;
            assert_int_equal(l->events[c][s], l->pages[c][s].report.event_count);
        }
    }
    assert_true(events > 50); /* they jumped and landed */
    assert_int_equal(l->heard[TAHR_MESSAGE_EVENT], events);
    assert_int_equal(l->heard[TAHR_MESSAGE_STATE], CHARACTERS * STEPS);
    assert_int_equal(l->heard[TAHR_MESSAGE_INPUT], CHARACTERS * STEPS);
    assert_int_equal(l->heard[TAHR_MESSAGE_REPORT], CHARACTERS * STEPS);
    /* At the start, and after each second of four. */
    assert_in_range(l->heard[TAHR_MESSAGE_SNAPSHOT], CHARACTERS * 4, CHARACTERS * 5);
    assert_true(l->heard[TAHR_MESSAGE_BODY] >= STEPS);
    assert_true(l->heard[TAHR_MESSAGE_WORLD] >= 1);
    for (int i = 0; i < TAHR_MESSAGE_COUNT; i++) {
        assert_int_equal(l->counts.failed[i], 0);
        assert_int_equal(l->counts.dropped[i], 0);
        /* A change is one thing to the telemetry, and as many messages as it has bodies. */
        if (i != TAHR_MESSAGE_BODY) assert_int_equal(l->counts.delivered[i], l->heard[i]);
    }
}

static tahr_lcm *open_sink(const char *url, void *own)
{
    tahr_lcm_desc desc;
    tahr_lcm *lcm;
    assert_int_equal(tahr_lcm_desc_init(&desc, sizeof desc), TAHR_OK);
    desc.url = url;
    desc.lcm = own;
    desc.rate = UINT32_MAX;
    assert_int_equal(tahr_lcm_open(&desc, &lcm), TAHR_OK);
    return lcm;
}

static void what_is_heard_over_memq_is_what_was_stepped(void **unused)
{
    ledger *l = calloc(1, sizeof *l);
    lcm_t *own = lcm_create("memq://");
    (void)unused;
    assert_non_null(l);
    assert_non_null(own);
    tahr_lcm *lcm = open_sink(NULL, own);
    listen_to(own, l, tahr_lcm_sink(lcm));
    tahr_lcm_close(lcm);
    check_heard(l);
    lcm_destroy(own);
    free(l);
}

static void what_is_read_from_a_log_is_what_was_stepped(void **unused)
{
    ledger *l = calloc(1, sizeof *l);
    char path[] = "/tmp/tahr_telemetry_XXXXXX", url[64];
    const int file = mkstemp(path);
    (void)unused;
    assert_non_null(l);
    assert_true(file >= 0);
    close(file);
    snprintf(url, sizeof url, "file://%s", path);
    tahr_lcm *lcm = open_sink(url, NULL);
    run(l, tahr_lcm_sink(lcm));
    tahr_lcm_close(lcm);
    snprintf(url, sizeof url, "file://%s?speed=0", path);
    lcm_t *player = lcm_create(url);
    assert_non_null(player);
    listen_to(player, l, NULL);
    check_heard(l);
    lcm_destroy(player);
    unlink(path);
    free(l);
}

/* The steps know nothing of it, and the counts tell. */
static void what_a_full_disk_refuses_is_counted(void **unused)
{
    ledger *l = calloc(1, sizeof *l);
    quiet q;
    (void)unused;
    assert_non_null(l);
    if (access("/dev/full", W_OK) != 0) {
        print_message("SKIP: what_a_full_disk_refuses_is_counted: there is no /dev/full\n");
        free(l);
        skip();
    }
    quiet_begin(&q);
    tahr_lcm *lcm = open_sink("file:///dev/full", NULL);
    run(l, tahr_lcm_sink(lcm));
    tahr_lcm_close(lcm);
    assert_int_equal(quiet_end(&q), 0);
    uint64_t failed = 0;
    for (int i = 0; i < TAHR_MESSAGE_COUNT; i++) {
        failed += l->counts.failed[i];
        assert_int_equal(l->counts.offered[i], l->counts.delivered[i] + l->counts.failed[i]);
    }
    assert_true(failed > CHARACTERS * STEPS);
    assert_int_equal(l->counts.last_failure, TAHR_E_FILE);
    free(l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_heard_over_memq_is_what_was_stepped),
        cmocka_unit_test(what_is_read_from_a_log_is_what_was_stepped),
        cmocka_unit_test(what_a_full_disk_refuses_is_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
