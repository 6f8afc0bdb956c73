/* SPDX-License-Identifier: MIT
 * test_events.c: scopes, sensors and recorded queries in the unreal preset: rows X. For the precise preset see
 * test_scope.c, test_overlap.c and test_records.c. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "move.h"
#include "parity.h"
#include "sensor_rig.h"

static const double R = 0.34, STEP = 0.05;
static const char *const names[SENSOR_BACKENDS] = {"native", "callbacks", "ccd"};

static uint32_t events_of(const rig *r, uint32_t type)
{
    return (uint32_t)sensor_events(r, type);
}

/* A box that blocks. Its flags are those of a body. */
static uint32_t add_wall(sensor_rig *s, tahr_vec3 min, tahr_vec3 max, uint32_t flags)
{
    uint32_t body = sensor_box(s, min, max);
    s->bodies[body].flags = flags;
    s->sensors.count--;
    fake_add_box(&s->solid, min, max);
    return body;
}

/* In the air at 6 m/s: into a wall, along it into another, down where both meet. On the way a sensor begins. */
static void deferred_row(parity_table *t)
{
    for (int backend = 0; backend < sensor_backends(); backend++) {
        const tahr_config c = parity_config();
        sensor_rig s;
        sensor_begin(&s, backend);
        uint32_t first = add_wall(&s, fake_vec(R + 0.1, -8, 0), fake_vec(8, 8, 16), 0);
        uint32_t second = add_wall(&s, fake_vec(-8, R + 0.12, 0), fake_vec(8, 8, 16), 0);
        uint32_t sensor = sensor_box(&s, fake_vec(R + 0.02, -8, 0), fake_vec(8, 8, 16));
        sensor_open(&s, &c, fake_vec(0, 0, 8));
        s.r.state.velocity = fake_vec(4.8, 3.6, 0);
        rig_step(&s.r, STEP);
        parity_row(t, "X1", names[backend]);
        parity_count(t, "overlaps", events_of(&s.r, TAHR_EVENT_OVERLAP_BEGIN), 1);
        parity_count(t, "overlaps that ended", events_of(&s.r, TAHR_EVENT_OVERLAP_END), 0);
        parity_count(t, "hits", events_of(&s.r, TAHR_EVENT_HIT), 2);
        uint32_t body = backend == ON_CALLBACKS ? 1 : sensor;
        const tahr_event *begin = sensor_event(&s.r, TAHR_EVENT_OVERLAP_BEGIN, body);
        const tahr_event *one = sensor_event(&s.r, TAHR_EVENT_HIT, first);
        const tahr_event *two = sensor_event(&s.r, TAHR_EVENT_HIT, second);
        parity_true(t, "in order", begin && one && two && begin < one && one < two);
        /* g dt^2 / 2 until the first wall; from there with the velocity at the end, g dt; the third motion, down the
         * crease, makes that full. Contact at 10 of 24 cm, less the pull-back of all of it, which is 30.025 cm long. */
        double part = 10.0 / 24 - (1 / 30.025 + 0.001);
        parity_length(t, "fallen", 8 - s.r.state.position.z, (0.5 * part + 1 - part) * 980 * STEP * STEP, 1e-3);
        parity_count(t, "touched", s.r.state.touched_count, 1);
        rig_assert_in_order(&s.r, STEP);
        sensor_close(&s);
    }
}

/* One step along a block that is no higher than a step but not to be stood on, under a sensor that only the try to step
 * up reaches. */
static void walk_into_block(int backend, uint32_t flags, sensor_rig *s)
{
    const tahr_config c = parity_config();
    sensor_begin(s, backend);
    uint32_t block = add_wall(s, fake_vec(R + 0.1, -8, 0), fake_vec(8, 8, 0.3), flags);
    s->bodies[block].walkable_rule = TAHR_WALKABLE_NEVER;
    sensor_box(s, fake_vec(-8, -8, 1.9), fake_vec(R + 0.1, 8, 2.1));
    sensor_open(s, &c, fake_vec(0, 0, 0.9015));
    rig_settle(&s->r);
    s->r.state.velocity = fake_vec(4.8, 3.6, 0);
    s->r.input.move = fake_vec(0.8, 0.6, 0);
    rig_step(&s->r, STEP);
}

static void reverted_row(parity_table *t)
{
    for (int backend = ON_NATIVE; backend < sensor_backends(); backend++) {
        sensor_rig tried, not_tried;
        if (backend == ON_CALLBACKS) { /* these have no flags of bodies */
            continue;
        }
        walk_into_block(backend, 0, &tried);
        walk_into_block(backend, TAHR_BODY_NO_STEP, &not_tried);
        const tahr_state *a = &tried.r.state, *b = &not_tried.r.state;
        parity_row(t, "X2", names[backend]);
        parity_true(t, "a scope was opened", tried.r.report.sweeps >= not_tried.r.report.sweeps + 2);
        parity_true(t, "pose bit by bit",
                    memcmp(&a->position, &b->position, sizeof a->position) == 0 &&
                        memcmp(&a->orientation, &b->orientation, sizeof a->orientation) == 0);
        parity_true(t, "it moved", a->position.x > 0 && a->position.y > 0.1);
        parity_count(t, "overlaps", events_of(&tried.r, TAHR_EVENT_OVERLAP_BEGIN), 0);
        parity_count(t, "overlaps ended", events_of(&tried.r, TAHR_EVENT_OVERLAP_END), 0);
        parity_count(t, "hits", events_of(&tried.r, TAHR_EVENT_HIT), 1);
        parity_count(t, "events", tried.r.report.event_count, not_tried.r.report.event_count);
        sensor_close(&tried);
        sensor_close(&not_tried);
    }
}

/* 1 cm thick, 20 m/s, one slice. */
static void pass_row(parity_table *t)
{
    const double face = R + 0.1;
    for (int backend = 0; backend < sensor_backends(); backend++) {
        const tahr_config c = parity_config();
        sensor_rig s;
        sensor_begin(&s, backend);
        sensor_box(&s, fake_vec(face, -8, 0), fake_vec(face + 0.01, 8, 16));
        sensor_open(&s, &c, fake_vec(0, 0, 8));
        s.r.state.velocity = fake_vec(20, 0, 0);
        rig_step(&s.r, STEP);
        parity_row(t, "X3", names[backend]);
        parity_count(t, "begun", events_of(&s.r, TAHR_EVENT_OVERLAP_BEGIN), 1);
        parity_count(t, "ended", events_of(&s.r, TAHR_EVENT_OVERLAP_END), 1);
        const tahr_event *begin = rig_event(&s.r, TAHR_EVENT_OVERLAP_BEGIN);
        const tahr_event *end = rig_event(&s.r, TAHR_EVENT_OVERLAP_END);
        parity_true(t, "begin first", begin && end && begin < end);
        parity_number(t, "time of the begin", begin ? begin->time : -1, (face - R) / 20, 1e-7);
        parity_number(t, "time of the end", end ? end->time : -1, (face + 0.01 + R) / 20, 1e-7);
        parity_count(t, "touched", s.r.state.touched_count, 0);
        sensor_close(&s);
    }
}

/* Row V2 with a record. */
static void recorded_row(parity_table *t)
{
    enum { ROOM = 8 };
    static const uint32_t expected[] = {TAHR_QUERY_SWEEP, TAHR_QUERY_CONTACTS, TAHR_QUERY_SWEEP};
    parity_scene scene = {.count = 0};
    parity_plane(&scene, 0, 0, 1, 0);
    for (int backend = 0; backend < PARITY_BACKENDS; backend++) {
        for (int on = 0; on < 2 && parity_has(backend); on++) {
            tahr_query_record records[ROOM];
            tahr__swept swept;
            parity p;
            memset(records, 0, sizeof records);
            parity_open(&p, &scene, backend, NULL, 0, 0, 86);
            p.step.report.queries = on ? records : NULL;
            p.step.report.query_capacity = on ? ROOM : 0;
            parity_row(t, "X4", parity_backend_name(backend));
            parity_true(t, "moved", tahr__safe_move(&p.step, parity_vec(10, 0, 0), &swept));
            parity_count(t, "queries", p.step.queries, 3);
            parity_count(t, "records", p.step.report.query_count, on ? 3 : 0);
            for (int i = 0; i < 3 && on; i++) {
                parity_count(t, "kind", records[i].type, expected[i]);
            }
            parity_length(t, "the first sweep", records[0].motion.x, on ? 10 : 0, 1e-9);
            parity_length(t, "grown for the fit test", records[1].shape.radius, on ? 34.1 : 0, 1e-9);
            parity_length(t, "where it fits", records[1].position.z, on ? 88.125 : 0, parity_tolerance(backend));
            parity_length(t, "the last sweep", records[2].motion.x, on ? 10 : 0, 1e-9);
            parity_close(&p);
        }
    }
}

static void scopes_and_events_rows(void **unused)
{
    parity_table t;
    (void)unused;
    parity_begin(&t, "scopes and events");
    deferred_row(&t);
    reverted_row(&t);
    pass_row(&t);
    recorded_row(&t);
    parity_end(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(scopes_and_events_rows)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
