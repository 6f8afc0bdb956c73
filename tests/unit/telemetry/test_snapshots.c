/* SPDX-License-Identifier: MIT
 * test_snapshots.c: where a recording can begin: snapshots of characters and of the world. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#ifdef TAHR_HAVE_THREADS
#include <tahr/native.h>

#include "listener.h"

enum { MOST = 64 };

typedef struct snapshots {
    listener ear;
    tahr_stamp stamps[MOST];
    uint32_t count;
} snapshots;

static void see_snapshot(void *test, const tahr_stamp *stamp, const tahr_state *state)
{
    snapshots *s = test;
    (void)state;
    if (s->count < MOST) s->stamps[s->count++] = *stamp;
}

static void take(tahr_telemetry *t, made_up *m, uint32_t config, tahr_status expected)
{
    assert_int_equal(tahr_telemetry_begin(t, 0, 0, config, &m->state), expected);
    made_up_step(m);
    m->report.event_count = 0;
    const tahr_telemetry_step s = made_up_pushed(m, 0); /* 4 ms */
    assert_true(tahr_telemetry_push(t, 0, &s) >= 0);
}

/* At the first step, every half second, after the state was written to, and with another config. */
static void one_is_sent_wherever_a_step_does_not_follow_from_the_last(void **unused)
{
    static snapshots s;
    static tahr_config configs[2];
    tahr_telemetry_desc desc;
    tahr_telemetry *t;
    made_up m;
    (void)unused;
    listener_init(&s.ear, &s);
    s.ear.on_snapshot = see_snapshot;
    listener_describe(&s.ear, 1, &desc);
    configs[0] = configs[1] = *desc.configs;
    configs[1].max_speed = 3;
    desc.configs = configs;
    desc.config_count = 2;
    desc.snapshot_period = 0.5;
    desc.ring_bytes = 16 << 20;
    assert_int_equal(tahr_telemetry_create(&desc, &t), TAHR_OK);
    made_up_init(&m, 5);
    for (uint32_t i = 0; i < 300; i++) {
        if (i == 130) m.state.reserved[39] ^= 1;
        take(t, &m, i >= 140, TAHR_OK);
    }
    assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_DRAIN, 100), TAHR_OK);
    tahr_telemetry_destroy(t);
    assert_null(atomic_load(&s.ear.wrong));
    const uint32_t steps[] = {0, 125, 130, 140, 265};
    assert_int_equal(s.count, 5);
    for (uint32_t i = 0; i < 5; i++) {
        assert_int_equal(s.stamps[i].step, steps[i]);
        assert_int_equal(s.stamps[i].time_ns, 4000000 * (int64_t)steps[i]);
        assert_int_equal(s.stamps[i].config, steps[i] >= 140);
        assert_int_equal(s.stamps[i].sequence, i);
    }
    listener_end(&s.ear);
}

static void one_that_found_no_room_is_sent_before_the_next_step(void **unused)
{
    static snapshots s;
    tahr_telemetry_desc desc;
    tahr_telemetry *t;
    made_up m;
    tahr_telemetry_counts c = {.struct_size = sizeof c};
    (void)unused;
    listener_init(&s.ear, &s);
    s.ear.on_snapshot = see_snapshot;
    listener_describe(&s.ear, 1, &desc);
    desc.ring_bytes = 4096;
    listener_close(&s.ear);
    assert_int_equal(tahr_telemetry_create(&desc, &t), TAHR_OK);
    listener_wait_for_call(&s.ear);
    made_up_init(&m, 5);
    uint32_t steps = 0;
    for (; c.dropped[TAHR_MESSAGE_INPUT] < 3; steps++) { /* until nothing at all finds room */
        take(t, &m, 0, TAHR_OK);
        tahr_telemetry_get_counts(t, &c);
    }
    m.state.reserved[39] ^= 1;
    take(t, &m, 0, TAHR_TRUNCATED);
    take(t, &m, 0, TAHR_TRUNCATED);
    listener_open(&s.ear);
    do { /* until all has been read */
        tahr_telemetry_get_counts(t, &c);
    } while (c.delivered[TAHR_MESSAGE_INPUT] + c.dropped[TAHR_MESSAGE_INPUT] < c.offered[TAHR_MESSAGE_INPUT]);
    take(t, &m, 0, TAHR_OK);
    take(t, &m, 0, TAHR_OK);
    assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_DRAIN, 100), TAHR_OK);
    tahr_telemetry_destroy(t);
    assert_int_equal(s.count, 2);
    assert_int_equal(s.stamps[1].step, steps + 2);
    assert_int_equal(s.stamps[1].sequence, 3);
    assert_int_equal(s.ear.missed[TAHR_MESSAGE_SNAPSHOT], 2);
    listener_end(&s.ear);
}

/* Fills a ring that nobody reads until inputs are dropped, and lets it be read. Returns the steps taken. */
static uint32_t make_gap(snapshots *s, tahr_telemetry *t, made_up *m)
{
    tahr_telemetry_counts c = {.struct_size = sizeof c};
    uint32_t steps = 0;
    for (; c.dropped[TAHR_MESSAGE_INPUT] < 3; steps++) {
        take(t, m, 0, TAHR_OK);
        tahr_telemetry_get_counts(t, &c);
    }
    listener_open(&s->ear);
    while (c.delivered[TAHR_MESSAGE_INPUT] + c.dropped[TAHR_MESSAGE_INPUT] < c.offered[TAHR_MESSAGE_INPUT])
        tahr_telemetry_get_counts(t, &c);
    return steps;
}

static void one_is_sent_after_a_gap_as_soon_as_there_is_room(void **unused)
{
    static snapshots s;
    tahr_telemetry_desc desc;
    tahr_telemetry *t;
    made_up m;
    (void)unused;
    listener_init(&s.ear, &s);
    s.ear.on_snapshot = see_snapshot;
    listener_describe(&s.ear, 1, &desc);
    desc.ring_bytes = 65536;
    listener_close(&s.ear);
    assert_int_equal(tahr_telemetry_create(&desc, &t), TAHR_OK);
    listener_wait_for_call(&s.ear);
    made_up_init(&m, 5);
    const uint32_t steps = make_gap(&s, t, &m);
    for (int i = 0; i < 5; i++)
        take(t, &m, 0, TAHR_OK);
    assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_DRAIN, 100), TAHR_OK);
    tahr_telemetry_destroy(t);
    assert_int_equal(s.count, 2);
    assert_int_equal(s.stamps[1].step, steps);
    assert_int_equal(s.ear.missed[TAHR_MESSAGE_SNAPSHOT], 0); /* none was tried before */
    listener_end(&s.ear);
}

/* A world whose bodies a test moves, as it was after each change. */
enum { BODIES = 6, CHANGES = 200 };

typedef struct scene {
    listener ear;
    tahr_body_motion is[CHANGES + 1][BODIES]; /* by epoch */
    tahr_body_pose poses[CHANGES + 1][BODIES], before[CHANGES + 1][BODIES];
    uint32_t counts[CHANGES + 1]; /* of a snapshot with this epoch, or 0 */
    double dt[CHANGES + 1];
    uint32_t snapshots;
} scene;

static void see_change(void *test, const tahr_sink_change *change)
{
    scene *s = test;
    const uint64_t e = change->epoch;
    if (change->kind != TAHR_CHANGE_SNAPSHOT) {
        listener_expect(&s->ear, change->before == NULL, "no earlier poses of a mere change");
        return;
    }
    listener_expect(&s->ear, e <= CHANGES && change->count > 0 && change->count <= BODIES, "a change that was made");
    if (atomic_load(&s->ear.wrong)) return;
    s->counts[e] = change->count;
    s->dt[e] = change->dt;
    memcpy(s->poses[e], change->poses, change->count * sizeof *change->poses);
    memcpy(s->before[e], change->before, change->count * sizeof *change->before);
    s->snapshots++;
}

static tahr_world *open_bodies(void)
{
    tahr_body_desc bodies[BODIES];
    tahr_world_desc desc;
    tahr_world *world = NULL;
    for (int i = 0; i < BODIES; i++) {
        tahr_body_desc_init(&bodies[i], sizeof bodies[i], TAHR_BODY_BOX);
        bodies[i].half_extents = (tahr_vec3){1, 1, 1};
        bodies[i].flags = TAHR_BODY_MOVABLE;
    }
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bodies;
    desc.body_count = BODIES;
    assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &world), TAHR_OK);
    return world;
}

/* One change of some bodies, made and told. */
static void change_some(scene *s, tahr_world *world, tahr_telemetry *t, made_up *dice, uint32_t epoch)
{
    tahr_body_pose poses[BODIES];
    uint32_t count = 0;
    const int moves = made_up_number(dice) % 3 != 0;
    for (uint32_t b = 0; b < BODIES; b++) {
        if (made_up_number(dice) % 2) continue;
        const uint32_t flags = moves && made_up_number(dice) % 4 == 0 ? TAHR_POSE_TELEPORT : 0;
        poses[count++] = (tahr_body_pose){
            b, flags, {{(double)(made_up_number(dice) % 50), 0, (double)(made_up_number(dice) % 9)}, {0, 0, 0, 1}}};
    }
    const double dt = moves ? 0.25 : 0;
    assert_int_equal(moves ? tahr_world_move(world, poses, count, dt) : tahr_world_set(world, poses, count), TAHR_OK);
    assert_int_equal(tahr_telemetry_change(t, moves ? TAHR_CHANGE_MOVE : TAHR_CHANGE_SET, poses, count, dt,
                                           tahr_world_revision(world)),
                     TAHR_OK);
    for (uint32_t b = 0; b < BODIES; b++)
        assert_int_equal(tahr_world_body(world, b, &s->is[epoch][b]), TAHR_OK);
}

/* The world of a snapshot, put together again, has every body of it where it was and as fast as it was. */
static void a_world_can_be_put_together_from_a_snapshot(void **unused)
{
    static scene s;
    tahr_telemetry_desc desc;
    tahr_telemetry *t;
    made_up dice;
    uint32_t checked = 0;
    (void)unused;
    tahr_world *world = open_bodies(), *again = open_bodies();
    listener_init(&s.ear, &s);
    s.ear.on_change = see_change;
    listener_describe(&s.ear, 1, &desc);
    desc.bodies = BODIES;
    desc.snapshot_period = 0.5;
    assert_int_equal(tahr_telemetry_create(&desc, &t), TAHR_OK);
    made_up_init(&dice, 8);
    for (uint32_t e = 1; e <= CHANGES; e++)
        change_some(&s, world, t, &dice, e);
    assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_DRAIN, 100), TAHR_OK);
    tahr_telemetry_destroy(t);
    assert_null(atomic_load(&s.ear.wrong));
    for (uint32_t e = 1; e <= CHANGES; e++) {
        if (s.counts[e] == 0) continue;
        assert_int_equal(tahr_world_set(again, s.before[e], s.counts[e]), TAHR_OK);
        if (s.dt[e] > 0) assert_int_equal(tahr_world_move(again, s.poses[e], s.counts[e], s.dt[e]), TAHR_OK);
        for (uint32_t i = 0; i < s.counts[e]; i++, checked++) {
            tahr_body_motion motion;
            const uint32_t b = s.poses[e][i].body;
            assert_int_equal(tahr_world_body(again, b, &motion), TAHR_OK);
            assert_memory_equal(&motion, &s.is[e][b], sizeof motion);
        }
    }
    assert_true(s.snapshots > 40 && checked > 200); /* some 33 simulated seconds */
    tahr_world_close(world);
    tahr_world_close(again);
    listener_end(&s.ear);
}

static void what_has_no_place_is_told_of_and_no_snapshot_has_it(void **unused)
{
    static scene s;
    tahr_telemetry_desc desc;
    tahr_telemetry *t;
    tahr_body_pose poses[3];
    (void)unused;
    listener_init(&s.ear, &s);
    s.ear.on_change = see_change;
    listener_describe(&s.ear, 1, &desc);
    desc.bodies = 2;
    assert_int_equal(tahr_telemetry_create(&desc, &t), TAHR_OK);
    for (uint32_t i = 0; i < 3; i++)
        poses[i] = (tahr_body_pose){1000 - i, 0, {{i, 0, 0}, {0, 0, 0, 1}}};
    assert_int_equal(tahr_telemetry_change(t, TAHR_CHANGE_SET, poses, 3, 0, 1), TAHR_TRUNCATED);
    assert_int_equal(tahr_telemetry_change(t, TAHR_CHANGE_SET, poses, 2, 0, 2), TAHR_OK);
    assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_DRAIN, 100), TAHR_OK);
    tahr_telemetry_destroy(t);
    assert_null(atomic_load(&s.ear.wrong));
    assert_int_equal(s.ear.got[TAHR_MESSAGE_BODY], 3);
    assert_int_equal(s.counts[1], 2);
    assert_int_equal(s.poses[1][0].body, 1000);
    assert_int_equal(s.poses[1][1].body, 999);
    listener_end(&s.ear);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_is_sent_wherever_a_step_does_not_follow_from_the_last),
        cmocka_unit_test(one_that_found_no_room_is_sent_before_the_next_step),
        cmocka_unit_test(one_is_sent_after_a_gap_as_soon_as_there_is_room),
        cmocka_unit_test(a_world_can_be_put_together_from_a_snapshot),
        cmocka_unit_test(what_has_no_place_is_told_of_and_no_snapshot_has_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
#else
int main(void)
{
    puts("SKIP: unit_telemetry_snapshots: built without libtahr_threads");
    return 77;
}
#endif
