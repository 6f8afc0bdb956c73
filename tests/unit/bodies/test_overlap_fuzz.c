/* SPDX-License-Identifier: MIT
 * test_overlap_fuzz.c: wandering among many sensors: the way is the same bit for bit as without them; what the state
 * remembers is what a contact query finds, and what the events add up to. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "sensor_rig.h"

enum { SENSORS_HERE = 9, STEPS = 8000 };

static double uniform(oracle_random *seed, double low, double high)
{
    return oracle_uniform(seed, low, high);
}

/* Walls, a step and a table on the floor; the solid bodies of both worlds are the same. */
static void furnish(sensor_rig *s)
{
    const tahr_vec3 boxes[4][2] = {{{3, -4, 0}, {3.5, 4, 3}},
                                   {{-4, 2, 0}, {3.25, 2.5, 3}},
                                   {{-3, -3, 0}, {-1, -1, 0.25}},
                                   {{0, -4, 1.5}, {1, -2, 1.75}}};
    for (int i = 0; i < 4; i++) {
        uint32_t body = sensor_box(s, boxes[i][0], boxes[i][1]);
        s->bodies[body].flags = 0;
        s->sensors.count--;
        fake_add_box(&s->solid, boxes[i][0], boxes[i][1]);
    }
}

/* Of callbacks the sensors' bodies count from 1. */
static uint32_t first_sensor(const sensor_rig *s)
{
    return s->backend == ON_CALLBACKS ? 1 : 5;
}

static void place(sensor_rig *s, uint32_t i, oracle_random *seed)
{
    uint32_t body = first_sensor(s) + i;
    tahr_vec3 at = {uniform(seed, -4, 4), uniform(seed, -4, 4), uniform(seed, 0, 3)};
    if (s->backend == ON_CALLBACKS) {
        sensor_put(s, body, at);
        return;
    }
    double a = uniform(seed, 0, 3.14);
    tahr_body_pose pose = {body, 0, {at, {0, sin(0.5 * a), 0, cos(0.5 * a)}}};
    assert_int_equal(tahr_world_set(s->r.world, &pose, 1), TAHR_OK);
}

static void open_pair(sensor_rig *with, sensor_rig *without, int backend, uint32_t shape)
{
    oracle_random seed = {77};
    sensor_begin(with, backend);
    sensor_begin(without, backend);
    furnish(with);
    furnish(without);
    for (int i = 0; i < SENSORS_HERE; i++) {
        tahr_vec3 at = {uniform(&seed, -4, 4), uniform(&seed, -4, 4), uniform(&seed, 0, 3)};
        tahr_vec3 h = {uniform(&seed, 0.02, 1.5), uniform(&seed, 0.02, 1.5), uniform(&seed, 0.02, 1.5)};
        uint32_t body = sensor_box(with, fake_vec(at.x - h.x, at.y - h.y, at.z - h.z),
                                   fake_vec(at.x + h.x, at.y + h.y, at.z + h.z));
        if (backend != ON_CALLBACKS && i % 3 == 0) {
            with->bodies[body].type = TAHR_BODY_SPHERE;
            with->bodies[body].radius = h.x;
        }
    }
    tahr_config c = rig_config();
    if (shape == TAHR_SHAPE_BOX) {
        c.shape = (tahr_shape){TAHR_SHAPE_BOX, 0, 0, 0.9, 0.3, 0.4};
    }
    sensor_open(with, &c, fake_vec(0, 0, 1));
    sensor_open(without, &c, fake_vec(0, 0, 1));
}

static tahr_state without_touched(const tahr_state *state)
{
    tahr_state s = *state;
    for (int i = 0; i < TAHR_MAX_TOUCHED; i++) {
        s.touched[i] = TAHR_NO_BODY;
    }
    s.touched_count = 0;
    s.floor_revision = 0; /* the worlds have other bodies */
    return s;
}

static int holds(const tahr_state *state, uint32_t body)
{
    int n = 0;
    for (uint32_t i = 0; i < state->touched_count; i++) {
        n += state->touched[i] == body;
        assert_true(i == 0 || state->touched[i - 1] < state->touched[i]);
    }
    return n;
}

/* What a query finds, but for what it finds within a micrometre of the surface. */
static void assert_touched(sensor_rig *s)
{
    const tahr_state *state = &s->r.state;
    tahr_contact found[64];
    uint32_t count = 0;
    tahr_contact_query q = {.shape = s->r.config.shape,
                            .position = state->position,
                            .up = state->up,
                            .orientation = state->orientation,
                            .margin = 1e-6,
                            .mask = 0xFFFFFFFFu,
                            .ignore_body = TAHR_NO_BODY};
    assert_int_equal(tahr_world_contacts(s->r.world, &q, found, 64, &count), TAHR_OK);
    for (uint32_t i = 0; i < count; i++) {
        if (found[i].sensor && found[i].distance < -1e-6) {
            assert_int_equal(holds(state, found[i].body), 1);
        }
    }
    for (uint32_t i = 0; i < state->touched_count; i++) {
        int near = 0;
        for (uint32_t k = 0; k < count; k++) {
            near |= found[k].sensor && found[k].body == state->touched[i];
        }
        assert_true(near);
    }
}

/* Begins and ends take turns for every sensor, and lead from one state to the next. */
static void assert_events_add_up(const rig *r, const tahr_state *before, double dt)
{
    int inside[SENSOR_BODIES];
    rig_assert_in_order(r, dt);
    for (uint32_t b = 0; b < SENSOR_BODIES; b++) {
        inside[b] = holds(before, b);
    }
    for (uint32_t i = 0; i < r->report.event_count; i++) {
        const tahr_event *e = &r->events[i];
        if (e->type == TAHR_EVENT_OVERLAP_BEGIN || e->type == TAHR_EVENT_OVERLAP_END) {
            assert_int_equal(inside[e->body], e->type == TAHR_EVENT_OVERLAP_END);
            inside[e->body] = !inside[e->body];
        }
    }
    for (uint32_t b = 0; b < SENSOR_BODIES; b++) {
        assert_int_equal(inside[b], holds(&r->state, b));
    }
}

static int events_but_overlaps(const rig *r)
{
    return (int)r->report.event_count - sensor_events(r, TAHR_EVENT_OVERLAP_BEGIN) -
           sensor_events(r, TAHR_EVENT_OVERLAP_END);
}

static void wander(int backend, uint32_t shape)
{
    const double dts[] = {1.0 / 60, 1.0 / 60, 0.1, 1.0 / 144, 0.001, 0.5};
    sensor_rig with, without;
    oracle_random seed = {5};
    int begins = 0;
    open_pair(&with, &without, backend, shape);
    for (int i = 0; i < STEPS; i++) {
        rig *r = &with.r, *other = &without.r;
        if (oracle_below(&seed, 25) == 0) {
            double a = uniform(&seed, 0, 6.2831853);
            r->input.move = oracle_below(&seed, 6) ? fake_vec(cos(a), sin(a), 0) : fake_vec(0, 0, 0);
            r->input.jump = oracle_below(&seed, 4) == 0;
            r->input.flags = oracle_below(&seed, 2) ? (uint32_t)TAHR_INPUT_FACING : 0u;
            r->input.facing = fake_vec(sin(a), cos(a), 0);
            other->input = r->input;
        }
        if (oracle_below(&seed, 40) == 0) {
            place(&with, oracle_below(&seed, SENSORS_HERE), &seed);
            assert_int_equal(tahr_world_touch(other->world), TAHR_OK); /* as much of a change there */
        }
        if (oracle_below(&seed, 40) == 0) { /* written from outside */
            r->state.position = fake_vec(uniform(&seed, -3, 2.5), uniform(&seed, -3, 1.5), uniform(&seed, 1, 3));
            other->state.position = r->state.position;
        }
        double dt = dts[oracle_below(&seed, 6)];
        tahr_state before = r->state;
        rig_step(r, dt);
        rig_step(other, dt);
        tahr_state a = without_touched(&r->state), b = without_touched(&other->state);
        assert_memory_equal(&a, &b, sizeof a);
        assert_int_equal(events_but_overlaps(r), other->report.event_count);
        assert_events_add_up(r, &before, dt);
        if (backend != ON_CALLBACKS) {
            assert_touched(&with);
        }
        begins += sensor_events(r, TAHR_EVENT_OVERLAP_BEGIN);
    }
    print_message("    %d sensors entered in %d steps\n", begins, STEPS);
    assert_true(begins > 200);
    sensor_close(&with);
    sensor_close(&without);
}

static void sensors_change_no_bit_of_the_way_on_native(void **unused)
{
    (void)unused;
    wander(ON_NATIVE, TAHR_SHAPE_CAPSULE);
}

static void sensors_change_no_bit_of_the_way_of_a_box_on_native(void **unused)
{
    (void)unused;
    wander(ON_NATIVE, TAHR_SHAPE_BOX);
}

static void sensors_change_no_bit_of_the_way_on_callbacks(void **unused)
{
    (void)unused;
    wander(ON_CALLBACKS, TAHR_SHAPE_CAPSULE);
}

static void sensors_change_no_bit_of_the_way_on_ccd(void **unused)
{
    (void)unused;
    if (sensor_backends() <= ON_CCD) {
        print_message("SKIP: unit_bodies_overlap_fuzz: ccd was not built\n");
        skip();
    }
    wander(ON_CCD, TAHR_SHAPE_CAPSULE);
}

/* From any remembered state the same steps give the same bits, whichever mover takes them. */
static void a_rollback_repeats_what_is_touched(void **unused)
{
    enum { AHEAD = 40 };
    sensor_rig s, without;
    oracle_random seed = {11};
    tahr_mover *second = NULL;
    (void)unused;
    open_pair(&s, &without, ON_NATIVE, TAHR_SHAPE_CAPSULE);
    assert_int_equal(tahr_mover_create(s.r.world, &s.r.config, &second), TAHR_OK);
    for (int i = 0; i < 60; i++) {
        tahr_state start = s.r.state, first[AHEAD];
        double a = uniform(&seed, 0, 6.2831853);
        s.r.input.move = fake_vec(cos(a), sin(a), 0);
        for (int k = 0; k < AHEAD; k++) {
            rig_step(&s.r, 1.0 / 60);
            first[k] = s.r.state;
        }
        for (int k = 0; k < AHEAD; k++) {
            assert_true(tahr_mover_step(second, &s.r.input, 1.0 / 60, &start, NULL) >= 0);
            assert_memory_equal(&start, &first[k], sizeof start);
        }
    }
    tahr_mover_destroy(second);
    sensor_close(&s);
    sensor_close(&without);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sensors_change_no_bit_of_the_way_on_native),
        cmocka_unit_test(sensors_change_no_bit_of_the_way_of_a_box_on_native),
        cmocka_unit_test(sensors_change_no_bit_of_the_way_on_callbacks),
        cmocka_unit_test(sensors_change_no_bit_of_the_way_on_ccd),
        cmocka_unit_test(a_rollback_repeats_what_is_touched),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
