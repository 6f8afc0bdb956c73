/* SPDX-License-Identifier: MIT
 * test_record.c: who watches a world is told everything in order, and the world is as before when it ends. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <tahr/native.h>
#include <tahr/record.h>

#include "stage.h"

/* Hears everything and keeps count. */
typedef struct listener {
    uint32_t begun, ended, moves, steps, done, body_count, last_kind, mover;
    uint64_t hash;
    double dt;
    tahr_status answer;                      /* of begin */
    void (*spoil)(tahr_record_world *world); /* in begin */
    const tahr_backend *backend;
} listener;

static tahr_status begin(void *user, tahr_record_world *world)
{
    listener *l = user;
    l->begun++;
    l->body_count = world->body_count;
    l->backend = world->backend;
    if (l->spoil) {
        l->spoil(world);
    }
    return l->answer;
}

static void hear_move(void *user, const tahr_record_move *m)
{
    listener *l = user;
    l->moves++;
    l->last_kind = m->kind;
    l->dt = m->dt;
}

static void hear_step(void *user, const tahr_record_step *s)
{
    listener *l = user;
    assert_int_equal(l->steps++, l->done); /* one after the other */
    l->mover = s->mover;
    assert_non_null(s->config);
    l->hash = tahr_state_hash(s->state);
}

static void hear_done(void *user, const tahr_record_done *d)
{
    listener *l = user;
    l->done++;
    assert_int_equal(d->mover, l->mover);
    assert_true(d->hash == tahr_state_hash(d->state));
}

static void end(void *user)
{
    ((listener *)user)->ended++;
}

static tahr_recorder recorder_of(listener *l)
{
    return (tahr_recorder){.struct_size = sizeof(tahr_recorder),
                           .user = l,
                           .begin = begin,
                           .move = hear_move,
                           .step = hear_step,
                           .done = hear_done,
                           .end = end};
}

static void a_recorder_hears_steps_and_placements_until_it_ends(void **unused)
{
    rig r;
    listener l = {0}, other = {0};
    const tahr_recorder first = recorder_of(&l), second = recorder_of(&other);
    tahr_body_desc bodies[2] = {stage_ground(), stage_box(fake_vec(3, 0, 0), fake_vec(1, 1, 0.5))};
    const tahr_body_pose pose = {1, 0, {fake_vec(3, 0, 0.1), STAGE_LEVEL}};
    tahr_mover *mover;
    (void)unused;
    rig_open_bodies(&r, bodies, 2, NULL, fake_vec(0, 0, 0.95));
    const uint64_t bytes = tahr_world_memory(r.world);
    assert_int_equal(tahr_world_record(r.world, &first), TAHR_OK);
    assert_int_equal(l.body_count, 2);
    assert_string_equal(l.backend->name, "native");
    const uint64_t before = tahr_state_hash(&r.state);
    rig_step(&r, 1.0 / 60);
    assert_true(l.hash == before);
    assert_int_equal(tahr_world_move(r.world, &pose, 1, 0.5), TAHR_OK);
    assert_int_equal(l.last_kind, TAHR_RECORD_MOVE);
    assert_true(l.dt == 0.5);
    assert_int_equal(tahr_world_set(r.world, &pose, 1), TAHR_OK);
    assert_int_equal(l.last_kind, TAHR_RECORD_SET);
    assert_int_equal(tahr_world_touch(r.world), TAHR_OK);
    assert_int_equal(l.last_kind, TAHR_RECORD_TOUCH);
    assert_int_equal(tahr_world_move(r.world, &pose, 1, -1), TAHR_E_ARGUMENT); /* nothing happened */
    assert_int_equal(l.moves, 3);
    assert_int_equal(tahr_mover_create(r.world, &r.config, &mover), TAHR_OK);
    assert_int_equal(tahr_mover_step(mover, &r.input, 0.01, &r.state, NULL), TAHR_OK);
    assert_int_equal(l.mover, 1);
    rig_step(&r, 1.0 / 60);
    assert_int_equal(l.mover, 0);
    assert_int_equal(tahr_mover_step(mover, &r.input, -1, &r.state, NULL), TAHR_E_ARGUMENT); /* no step */
    assert_int_equal(l.done, 3);
    assert_int_equal(tahr_world_record(r.world, &second), TAHR_OK);
    assert_int_equal(l.ended, 1);
    assert_int_equal(tahr_mover_step(mover, &r.input, 0.01, &r.state, NULL), TAHR_OK);
    assert_int_equal(other.mover, 0); /* movers are numbered anew */
    assert_int_equal(tahr_world_record(r.world, NULL), TAHR_OK);
    assert_int_equal(other.ended, 1);
    assert_true(tahr_world_memory(r.world) == bytes);
    rig_step(&r, 1.0 / 60);
    assert_int_equal(l.steps, 3);
    assert_int_equal(other.steps, 1);
    assert_int_equal(tahr_world_record(r.world, &first), TAHR_OK);
    tahr_mover_destroy(mover);
    rig_close(&r);
    assert_int_equal(l.ended, 2);
}

static void a_watched_sleeper_is_computed_and_sleeps_again_afterwards(void **unused)
{
    fake_world w;
    rig r;
    listener l = {0};
    const tahr_recorder recorder = recorder_of(&l);
    (void)unused;
    fake_world_flat(&w);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
    for (int i = 0; i < 3; i++) {
        tahr_mover_step(r.mover, &r.input, 1.0 / 60, &r.state, NULL);
    }
    tahr_report report = {.struct_size = sizeof report};
    tahr_mover_step(r.mover, &r.input, 1.0 / 60, &r.state, &report);
    assert_true(report.flags & TAHR_REPORT_ASLEEP);
    tahr_world_record(r.world, &recorder);
    const tahr_state before = r.state;
    tahr_mover_step(r.mover, &r.input, 1.0 / 60, &r.state, &report);
    assert_false(report.flags & TAHR_REPORT_ASLEEP);
    assert_memory_equal(&before, &r.state, sizeof before);
    tahr_world_record(r.world, NULL);
    tahr_mover_step(r.mover, &r.input, 1.0 / 60, &r.state, &report);
    assert_true(report.flags & TAHR_REPORT_ASLEEP);
    rig_close(&r);
}

static void a_recorder_that_refuses_leaves_the_world_alone(void **unused)
{
    fake_world w;
    rig r;
    listener l = {.answer = TAHR_E_FILE};
    const tahr_recorder recorder = recorder_of(&l);
    struct {
        tahr_recorder recorder;
        uint64_t tail;
    } newer = {recorder, 1};
    (void)unused;
    fake_world_flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
    assert_int_equal(tahr_world_record(NULL, &recorder), TAHR_E_NULL);
    assert_int_equal(tahr_world_record(r.world, &recorder), TAHR_E_FILE);
    assert_int_equal(l.begun, 1);
    assert_int_equal(l.ended, 0);
    rig_step(&r, 1.0 / 60);
    assert_int_equal(l.steps, 0);
    newer.recorder.struct_size = sizeof newer;
    assert_int_equal(tahr_world_record(r.world, &newer.recorder), TAHR_E_UNSUPPORTED);
    newer.recorder.struct_size = 8;
    assert_int_equal(tahr_world_record(r.world, &newer.recorder), TAHR_E_STRUCT_SIZE);
    newer.recorder.struct_size = sizeof newer.recorder, newer.recorder.flags = 4;
    assert_int_equal(tahr_world_record(r.world, &newer.recorder), TAHR_E_UNSUPPORTED);
    assert_int_equal(l.begun, 1);
    assert_int_equal(tahr_world_record(r.world, NULL), TAHR_OK);
    rig_close(&r);
}

static void spoil_pose(tahr_record_world *w)
{
    w->bodies[0].pose.position.x = NAN;
}

static void spoil_turn(tahr_record_world *w)
{
    w->bodies[0].before.orientation.w = 7;
}

static void spoil_dt(tahr_record_world *w)
{
    w->bodies[0].dt = -1;
}

static void spoil_reach(tahr_record_world *w)
{
    w->bodies[0].reach = INFINITY;
}

static void spoil_has(tahr_record_world *w)
{
    w->has = 1u << 30;
}

static void spoil_revision(tahr_record_world *w)
{
    w->revision = 0;
}

static void spoil_count(tahr_record_world *w)
{
    w->body_count++;
}

static void spoil_derived(tahr_record_world *w)
{
    w->derived = 1u << 20;
}

static void what_no_world_can_be_is_not_restored(void **unused)
{
    const struct {
        void (*spoil)(tahr_record_world *);
        const char *field;
    } ways[] = {{spoil_pose, "bodies[0].pose"},
                {spoil_turn, "bodies[0].before"},
                {spoil_dt, "bodies[0].dt"},
                {spoil_reach, "bodies[0].reach"},
                {spoil_has, "has"},
                {spoil_revision, "revision"},
                {spoil_count, "body_count"},
                {spoil_derived, "derived"}};
    rig r;
    tahr_body_desc ground = stage_ground();
    (void)unused;
    rig_open_bodies(&r, &ground, 1, NULL, fake_vec(0, 0, 0.95));
    const uint64_t revision = tahr_world_revision(r.world);
    for (size_t i = 0; i < sizeof ways / sizeof ways[0]; i++) {
        listener l = {.spoil = ways[i].spoil};
        tahr_recorder recorder = recorder_of(&l);
        recorder.flags = TAHR_RECORDER_RESTORES;
        assert_int_equal(tahr_world_record(r.world, &recorder), TAHR_E_ARGUMENT);
        assert_int_equal(l.ended, 1);
        const char *said = strstr(r.log.text, "restored what no world can be: ");
        assert_non_null(said);
        assert_string_equal(said + strlen("restored what no world can be: "), ways[i].field);
        assert_true(tahr_world_revision(r.world) == revision);
    }
    rig_step(&r, 1.0 / 60);
    rig_close(&r);
}

static tahr_world *watched;
static tahr_mover *second_mover;
static int nested;

static void call_back(fake_world *w)
{
    tahr_state state;
    tahr_config config = rig_config();
    const tahr_input input = {.struct_size = sizeof input};
    const tahr_vec3 at = {0, 0, 1};
    w->on_sweep = NULL;
    nested++;
    tahr_state_init(&state, &config, &at);
    assert_int_equal(tahr_world_record(watched, NULL), TAHR_E_REENTRANT);
    assert_int_equal(tahr_mover_step(second_mover, &input, 0.01, &state, NULL), TAHR_E_REENTRANT);
}

static void inside_a_recorded_step_nothing_else_begins(void **unused)
{
    fake_world w;
    rig r;
    listener l = {0};
    const tahr_recorder recorder = recorder_of(&l);
    (void)unused;
    fake_world_flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
    watched = r.world;
    assert_int_equal(tahr_mover_create(r.world, &r.config, &second_mover), TAHR_OK);
    tahr_world_record(r.world, &recorder);
    w.on_sweep = call_back;
    rig_step(&r, 1.0 / 60);
    assert_int_equal(nested, 1);
    assert_int_equal(l.done, 1);
    tahr_mover_destroy(second_mover);
    rig_close(&r);
}

static void without_memory_nobody_watches_and_nothing_is_kept(void **unused)
{
    (void)unused;
    for (uint64_t fail_at = 0; fail_at <= 2; fail_at++) {
        fake_memory memory = {0};
        const tahr_allocator allocator = fake_allocator(&memory);
        tahr_body_desc ground = stage_ground();
        tahr_world_desc desc;
        tahr_world *world;
        listener l = {0};
        const tahr_recorder recorder = recorder_of(&l);
        tahr_world_desc_init(&desc, sizeof desc);
        desc.allocator = &allocator, desc.bodies = &ground, desc.body_count = 1;
        assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &world), TAHR_OK);
        const uint64_t bytes = memory.live_bytes;
        memory.fail_at = fail_at ? memory.requests + fail_at : 0;
        assert_int_equal(tahr_world_record(world, &recorder), fail_at ? TAHR_E_MEMORY : TAHR_OK);
        assert_int_equal(l.begun, fail_at == 0);
        tahr_world_record(world, NULL);
        assert_true(memory.live_bytes == bytes);
        tahr_world_close(world);
        assert_int_equal(memory.live_blocks, 0);
        assert_int_equal(memory.mismatches, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_recorder_hears_steps_and_placements_until_it_ends),
        cmocka_unit_test(a_watched_sleeper_is_computed_and_sleeps_again_afterwards),
        cmocka_unit_test(a_recorder_that_refuses_leaves_the_world_alone),
        cmocka_unit_test(what_no_world_can_be_is_not_restored),
        cmocka_unit_test(inside_a_recorded_step_nothing_else_begins),
        cmocka_unit_test(without_memory_nobody_watches_and_nothing_is_kept),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
