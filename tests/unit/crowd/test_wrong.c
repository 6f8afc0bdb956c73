/* SPDX-License-Identifier: MIT
 * test_wrong.c: what is wrong with a crowd or a tick is named, and nothing is touched; one character's failure is his
 * own. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <tahr/record.h>

#include "throng.h"

static void open_four(throng *t)
{
    throng_open_ground(t);
    throng_make(t, 4);
    for (uint32_t i = 0; i < 4; i++) {
        throng_place(t, i, 2.0 * i, 0);
        throng_go(t, i, 1, 0);
    }
}

/* The tick is refused with this status, the log says this, and no array was written to. */
static void refuses(throng *t, tahr_status status, const char *said)
{
    tahr_state states[4];
    tahr_report reports[4];
    const tahr_status mark[4] = {77, 77, 77, 77};
    memcpy(states, t->states, sizeof states);
    memcpy(reports, t->reports, sizeof reports);
    memcpy(t->statuses, mark, sizeof mark);
    t->said[0] = 0;
    assert_int_equal(tahr_crowd_step(t->crowd, &t->tick), status);
    if (!strstr(t->said, said)) {
        fail_msg("'%s' is not in '%s'", said, t->said);
    }
    assert_memory_equal(states, t->states, sizeof states);
    assert_memory_equal(reports, t->reports, sizeof reports);
    assert_memory_equal(mark, t->statuses, sizeof mark);
}

static void ticks_that_are_wrong_are_named_and_touch_nothing(void **unused)
{
    throng t;
    (void)unused;
    open_four(&t);
    const tahr_crowd_tick good = t.tick;
    assert_int_equal(tahr_crowd_step(NULL, &t.tick), TAHR_E_NULL);
    assert_int_equal(tahr_crowd_step(t.crowd, NULL), TAHR_E_NULL);
    t.tick.count = 5;
    refuses(&t, TAHR_E_ARGUMENT, "tick.count is 5, above the capacity of 4");
    t.tick = good;
    t.tick.struct_size = 8;
    refuses(&t, TAHR_E_STRUCT_SIZE, "tick:");
    t.tick = good;
    t.tick.inputs = NULL;
    refuses(&t, TAHR_E_NULL, "tick.inputs is NULL");
    t.tick = good;
    t.tick.states = NULL;
    assert_int_equal(tahr_crowd_step(t.crowd, &t.tick), TAHR_E_NULL);
    assert_non_null(strstr(t.said, "tick.states is NULL"));
    t.tick = good;
    t.tick.dt = -1;
    refuses(&t, TAHR_E_ARGUMENT, "tick.dt");
    t.tick.dt = NAN;
    refuses(&t, TAHR_E_ARGUMENT, "tick.dt");
    t.tick = good;
    t.members[3].id = 1;
    refuses(&t, TAHR_E_ARGUMENT, "members.id 1 is there twice, again at index 3");
    t.members[3].id = 0x7FFFFFFF;
    refuses(&t, TAHR_E_ARGUMENT, "members[3].id is out of range");
    t.members[3].id = 3;
    t.members[2].config = 1;
    refuses(&t, TAHR_E_ARGUMENT, "members[2].config is out of range");
    t.members[2].config = 0;
    t.members[1].flags = 2;
    refuses(&t, TAHR_E_ARGUMENT, "members[1].flags has unknown bits");
    t.members[1].flags = 0;
    t.members[1].reserved = 1;
    refuses(&t, TAHR_E_ARGUMENT, "members[1].reserved");
    t.members[1].reserved = 0;
    const double budgets[] = {-1, 11, NAN, INFINITY};
    for (int i = 0; i < 4; i++) {
        t.members[0].budget = budgets[i];
        refuses(&t, TAHR_E_ARGUMENT, "members[0].budget is out of range");
    }
    t.members[0].budget = 0.1;
    t.tick.delays = NULL;
    refuses(&t, TAHR_E_ARGUMENT, "members[0].budget is set, but tick.delays is NULL");
    t.members[0].budget = 0;
    t.inputs[2].struct_size += 8;
    refuses(&t, TAHR_E_STRUCT_SIZE, "inputs[2].struct_size is not that of the first one");
    t.inputs[2].struct_size -= 8;
    t.inputs[0].struct_size = 0;
    refuses(&t, TAHR_E_STRUCT_SIZE, "inputs[0].struct_size");
    t.inputs[0].struct_size = sizeof t.inputs[0];
    t.reports[3].struct_size = 16;
    refuses(&t, TAHR_E_STRUCT_SIZE, "reports[3].struct_size");
    t.reports[3].struct_size = sizeof t.reports[3];
    assert_int_equal(tahr_crowd_step(t.crowd, &t.tick), TAHR_OK);
    t.tick.count = 0;
    assert_int_equal(tahr_crowd_step(t.crowd, &t.tick), TAHR_OK);
    throng_close(&t);
}

static void refuses_desc(throng *t, const tahr_crowd_desc *desc, tahr_status status, const char *said)
{
    tahr_crowd *crowd = NULL;
    t->said[0] = 0;
    assert_int_equal(tahr_crowd_create(t->world, desc, &crowd), status);
    assert_null(crowd);
    if (!strstr(t->said, said)) {
        fail_msg("'%s' is not in '%s'", said, t->said);
    }
}

static void crowds_that_are_wrong_are_named(void **unused)
{
    throng t;
    tahr_crowd *crowd = NULL;
    tahr_crowd_counts counts = {.struct_size = 4};
    (void)unused;
    throng_open_ground(&t);
    t.desc.capacity = 3;
    const tahr_crowd_desc good = t.desc;
    tahr_crowd_desc d = good;
    assert_int_equal(tahr_crowd_create(NULL, &d, &crowd), TAHR_E_NULL);
    assert_int_equal(tahr_crowd_create(t.world, NULL, &crowd), TAHR_E_NULL);
    assert_int_equal(tahr_crowd_create(t.world, &d, NULL), TAHR_E_NULL);
    assert_int_equal(tahr_crowd_desc_init(NULL, sizeof d), TAHR_E_NULL);
    assert_int_equal(tahr_crowd_desc_init(&d, 4), TAHR_E_STRUCT_SIZE);
    assert_int_equal(tahr_crowd_tick_init(NULL, sizeof t.tick), TAHR_E_NULL);
    assert_int_equal(tahr_crowd_get_counts(NULL, &counts), TAHR_E_NULL);
    d.capacity = 0;
    refuses_desc(&t, &d, TAHR_E_ARGUMENT, "desc.capacity");
    d.capacity = (1 << 22) + 1;
    refuses_desc(&t, &d, TAHR_E_ARGUMENT, "desc.capacity");
    d = good, d.config_count = 0;
    refuses_desc(&t, &d, TAHR_E_ARGUMENT, "desc.config_count");
    d = good, d.configs = NULL;
    refuses_desc(&t, &d, TAHR_E_NULL, "desc.configs is NULL");
    d = good, d.flags = 4;
    refuses_desc(&t, &d, TAHR_E_ARGUMENT, "desc.flags");
    d = good, d.tasks = 5000;
    refuses_desc(&t, &d, TAHR_E_ARGUMENT, "desc.tasks");
    d = good, d.reserved = 1;
    refuses_desc(&t, &d, TAHR_E_ARGUMENT, "desc.reserved");
    d = good, d.struct_size = 4;
    refuses_desc(&t, &d, TAHR_E_STRUCT_SIZE, "desc:");
    tahr_config two[2];
    two[0] = two[1] = t.config;
    two[1].skin = -1;
    d = good, d.configs = two, d.config_count = 2;
    refuses_desc(&t, &d, TAHR_E_ARGUMENT, "desc.configs[1]");
    two[1] = two[0];
    two[1].struct_size += 8;
    refuses_desc(&t, &d, TAHR_E_STRUCT_SIZE, "desc.configs.struct_size");
    throng_make(&t, 3);
    assert_int_equal(tahr_crowd_get_counts(t.crowd, &counts), TAHR_E_STRUCT_SIZE);
    throng_close(&t);
}

static void who_fails_is_left_as_he_was_and_the_others_are_not_bothered(void **unused)
{
    throng t, u;
    (void)unused;
    open_four(&t);
    open_four(&u);
    u.members[1].flags = TAHR_MEMBER_ALONE;
    for (int i = 0; i < 20; i++) {
        throng_step(&t);
        throng_step(&u);
    }
    assert_memory_equal(&t.states[0], &u.states[0], sizeof t.states[0]);
    const tahr_state before = t.states[1];
    t.inputs[1].move.y = NAN;
    t.states[3].velocity.z = INFINITY;
    const tahr_state broken = t.states[3];
    assert_int_equal(tahr_crowd_step(t.crowd, &t.tick), TAHR_E_ARGUMENT);
    assert_non_null(strstr(t.said, "character 1, at index 1"));
    assert_int_equal(t.statuses[0], TAHR_OK);
    assert_int_equal(t.statuses[1], TAHR_E_ARGUMENT);
    assert_int_equal(t.statuses[2], TAHR_OK);
    assert_int_equal(t.statuses[3], TAHR_E_ARGUMENT);
    assert_memory_equal(&before, &t.states[1], sizeof before);
    assert_memory_equal(&broken, &t.states[3], sizeof broken);
    throng_step(&u);
    assert_memory_equal(&t.states[0], &u.states[0], sizeof t.states[0]);
    assert_memory_equal(&t.states[2], &u.states[2], sizeof t.states[2]);
    throng_close(&t);
    throng_close(&u);
}

/* A scheduler that steps the crowd again from within. */
static throng *again;
static tahr_status answer;

static void step_within(void *user, tahr_task_fn task, void *argument, uint32_t count)
{
    (void)user;
    answer = tahr_crowd_step(again->crowd, &again->tick);
    for (uint32_t i = 0; i < count; i++) {
        task(argument, i);
    }
}

static void a_tick_within_a_tick_is_refused(void **unused)
{
    throng t;
    (void)unused;
    throng_open_ground(&t);
    t.desc.run_tasks = step_within;
    throng_make(&t, 64);
    for (uint32_t i = 0; i < 64; i++) {
        throng_place(&t, i, 2.0 * i, 0);
    }
    again = &t;
    assert_int_equal(tahr_crowd_step(t.crowd, &t.tick), TAHR_OK);
    assert_int_equal(answer, TAHR_E_REENTRANT);
    throng_close(&t);
}

/* Counts what is allocated. */
static uint64_t allocated;

static void *counted_alloc(void *user, size_t size, size_t alignment)
{
    (void)user, (void)alignment;
    allocated++;
    return aligned_alloc(64, (size + 63) & ~(size_t)63);
}

static void counted_free(void *user, void *memory, size_t size, size_t alignment)
{
    (void)user, (void)size, (void)alignment;
    allocated -= memory != NULL;
    free(memory);
}

static void ticks_allocate_nothing_and_all_is_given_back(void **unused)
{
    const tahr_allocator allocator = {NULL, counted_alloc, counted_free};
    tahr_body_desc ground;
    tahr_world_desc desc;
    throng t;
    (void)unused;
    throng_open_ground(&t);
    tahr_world_close(t.world);
    tahr_body_desc_init(&ground, sizeof ground, TAHR_BODY_BOX);
    ground.half_extents = (tahr_vec3){50, 50, 1};
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = &ground;
    desc.body_count = 1;
    desc.allocator = &allocator;
    assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &t.world), TAHR_OK);
    throng_make(&t, 40);
    for (uint32_t i = 0; i < 40; i++) {
        throng_place(&t, i, 0.6 * (i % 8), 0.6 * (i / 8));
        t.states[i].position.z += 1;
        t.members[i].budget = i % 3 == 0 ? 0.05 : 0;
    }
    const uint64_t held = allocated;
    for (int i = 0; i < 60; i++) {
        assert_true(throng_step(&t) >= 0);
    }
    assert_int_equal(allocated, held);
    throng_close(&t);
    assert_int_equal(allocated, 0);
}

static void a_recorded_world_is_refused(void **unused)
{
    const tahr_recorder recorder = {.struct_size = sizeof recorder};
    throng t;
    (void)unused;
    open_four(&t);
    assert_int_equal(tahr_world_record(t.world, &recorder), TAHR_OK);
    refuses(&t, TAHR_E_UNSUPPORTED, "world is being recorded");
    assert_int_equal(tahr_world_record(t.world, NULL), TAHR_OK);
    assert_int_equal(tahr_crowd_step(t.crowd, &t.tick), TAHR_OK);
    throng_close(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ticks_that_are_wrong_are_named_and_touch_nothing),
        cmocka_unit_test(crowds_that_are_wrong_are_named),
        cmocka_unit_test(who_fails_is_left_as_he_was_and_the_others_are_not_bothered),
        cmocka_unit_test(a_tick_within_a_tick_is_refused),
        cmocka_unit_test(ticks_allocate_nothing_and_all_is_given_back),
        cmocka_unit_test(a_recorded_world_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
