/* SPDX-License-Identifier: MIT
 * test_loops.c: rows Q (ramps) and L (time steps, braking, jumps, steps) in centimetres. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "move_along_floor.h"
#include "parity.h"
#include "rig.h"
#include "step_up.h"
#include "stepped.h"

static void ramps_lift_a_level_motion(void **unused)
{
    static const struct {
        const char *id;
        double x, y;
        uint32_t keep;
        double to[3];
    } rows[] = {{"Q1", 10, 0, 1, {10, 0, 5.7735}},
                {"Q2", 10, 0, 0, {8.66025, 0, 5}},
                {"Q3", -10, 0, 1, {-10, 0, -5.7735}},
                {"Q4", 0, 10, 1, {0, 10, 0}},
                {"Q5", 6, 8, 1, {6, 8, 3.4641}}};
    parity_table table;
    parity_scene scene = {.count = 0};
    parity p;
    (void)unused;
    parity_begin(&table, "Q, ramps");
    parity_open(&p, &scene, PARITY_FAKE, NULL, 0, 0, 0);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        parity_row(&table, rows[i].id, NULL);
        p.config.keep_level_speed = rows[i].keep;
        parity_floor(&p, 2.15, unit(vec(-0.5, 0, sqrt(0.75))), TAHR_FLOOR_BLOCKING | TAHR_FLOOR_WALKABLE);
        tahr__ramp ramp = tahr__floor_ramp(&p.step.state.floor);
        vec3 delta = parity_vec(rows[i].x, rows[i].y, 0);
        vec3 to = tahr__ground_movement_delta(&p.step, delta, &ramp);
        parity_vector(&table, "motion", to, rows[i].to[0], rows[i].to[1], rows[i].to[2], 1e-4);
        parity_count(&table, "queries", p.step.queries, 0);
        p.step.state.floor.flags |= TAHR_FLOOR_LINE; /* a floor that a ray found is no ramp, nor is one too steep */
        ramp = tahr__floor_ramp(&p.step.state.floor);
        to = tahr__ground_movement_delta(&p.step, delta, &ramp);
        parity_vector(&table, "without a ramp", to, rows[i].x, rows[i].y, 0, 0);
        parity_floor(&p, 2.15, unit(vec(-0.5, 0, sqrt(0.75))), TAHR_FLOOR_BLOCKING);
        ramp = tahr__floor_ramp(&p.step.state.floor);
        to = tahr__ground_movement_delta(&p.step, delta, &ramp);
        parity_vector(&table, "not walkable", to, rows[i].x, rows[i].y, 0, 0);
    }
    parity_close(&p);
    parity_end(&table);
}

/* 10 cm into faces that only an override makes walkable: sqrt(1 - z^2) / z times as high, or all of it shorter. */
static void no_ramp_lifts_higher_than_a_step(void **unused)
{
    static const double faces[] = {0.3, 0.22, 0.2, 0.1, 0.001};
    parity_scene scene = {.count = 0};
    parity p;
    (void)unused;
    parity_open(&p, &scene, PARITY_FAKE, NULL, 0, 0, 0);
    for (size_t i = 0; i < sizeof faces / sizeof faces[0]; i++) {
        double z = faces[i], high = 10 * sqrt(1 - z * z) / z, part = fmin(1, 45 / high);
        vec3 normal = vec(-sqrt(1 - z * z), 0, z);
        const tahr__ramp ramp = {normal, normal, 1};
        for (int way = -1; way < 2; way += 2) {
            vec3 to = tahr__ground_movement_delta(&p.step, parity_vec(10 * way, 0, 0), &ramp);
            assert_near(100 * to.x, 10 * way * part, 1e-9);
            assert_near(100 * to.z, high * way * part, 1e-9);
        }
    }
    parity_close(&p);
}

/* The same of whole steps, into a face of 88 degrees, up which 10 cm lead 2.9 m. */
static void faces_walkable_by_an_override_are_gone_up_a_step_at_a_time(void **unused)
{
    const double steep = 88 * 0.017453292519943295;
    (void)unused;
    for (uint32_t solver = TAHR_SLIDE_JOINT; solver <= TAHR_SLIDE_TWO_WALLS; solver++) {
        tahr_config c = parity_config();
        fake_world w;
        rig r;
        c.slide_solver = solver;
        fake_world_flat(&w);
        fake_solid *face = fake_add_plane(&w, vec(-sin(steep), 0, cos(steep)), -1);
        face->walkable_rule = TAHR_WALKABLE_INCREASE;
        face->walkable_angle = 1.55;
        rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
        r.input.move = fake_vec(1, 0, 0);
        double most = 0;
        for (int i = 0; i < 60; i++) {
            double z = r.state.position.z;
            rig_step(&r, 1.0 / 60);
            most = fmax(most, r.state.position.z - z);
            assert_true(r.report.slices == 1);
        }
        assert_true(most > 0.4 && most <= 2 * c.step_height + 0.05); /* two ramps in one slice, and the clearance */
        rig_close(&r);
    }
}

/* L1 */
static void time_steps(parity_table *table, const tahr_config *c)
{
    static const struct {
        double time;
        int count;
        double first, last;
    } rows[] = {{0.051, 2, 0.0255, 0.0255},
                {0.125, 3, 0.05, 0.0375},
                {0.5, 8, 0.05, 0.15},
                {1.0, 8, 0.05, 0.65},
                {0.05, 1, 0.05, 0.05}};
    parity_row(table, "L1", NULL);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        double left = rows[i].time, h = 0, sum = 0;
        int n = 0;
        while (left >= TAHR__LEAST_TIME) {
            h = tahr__time_step(c, left, (uint32_t)++n);
            parity_number(table, "a slice before the last two", n == 1 && rows[i].count > 2 ? h : rows[i].first,
                          rows[i].first, 1e-12);
            left -= h;
            sum += h;
        }
        parity_count(table, "slices", (uint32_t)n, (uint32_t)rows[i].count);
        parity_number(table, "the last slice", h, rows[i].last, 1e-12);
        parity_number(table, "their sum", sum, rows[i].time, 1e-12);
    }
}

static tahr__law braking_law(const tahr_config *c)
{
    tahr__law law = {.braking = c->braking_deceleration, .drag = c->braking_drag};
    return law;
}

/* L2, L3 */
static void braking(parity_table *table, const tahr_config *c)
{
    static const double once[3][2] = {{1.0 / 60, 405.8667}, {1.0 / 30, 263.5022}, {0.05, 134.0800}};
    static const double way[4][2] = {{20, 6.704}, {30, 11.535}, {60, 15.623}, {120, 19.530}};
    tahr__law law = braking_law(c);
    parity_row(table, "L2", NULL);
    for (int i = 0; i < 3; i++) {
        vec3 v = tahr__velocity_braking(c, &law, parity_vec(0, 600, 0), once[i][0]);
        parity_vector(table, "velocity", v, 0, once[i][1], 0, 1e-3);
    }
    parity_row(table, "L3", NULL);
    for (int i = 0; i < 4; i++) {
        vec3 v = parity_vec(600, 0, 0);
        double distance = 0, h = 1 / way[i][0];
        for (int k = 0; k < 600; k++) {
            v = tahr__velocity_braking(c, &law, v, h);
            distance += v.x * h;
        }
        parity_length(table, "stopping distance", distance, way[i][1], 5e-4);
        parity_length(table, "speed", v.x, 0, 0);
    }
    for (int i = 0; i < 4; i++) { /* the closed form: to 10 cm/s, and to rest */
        double h = 1 / way[i][0], distance = 0, to_snap = -1;
        vec3 v = parity_vec(600, 0, 0);
        for (int k = 0; k < 600; k++) {
            tahr__motion m = tahr__law_advance(&law, v, h);
            if (to_snap < 0 && m.velocity.x <= 0.1) {
                double t = log((law.drag * v.x + law.braking) / (law.drag * 0.1 + law.braking)) / law.drag;
                to_snap = distance + tahr__law_advance(&law, v, t).displacement.x;
            }
            distance += m.displacement.x;
            v = m.velocity;
        }
        parity_length(table, "exact distance to the snap", to_snap, 23.571, 0.05);
        parity_length(table, "exact distance to rest", distance, 23.594, 5e-4);
    }
}

static double jump_height(const tahr_config *config, double hz)
{
    fake_world w;
    rig r;
    double top = 0;
    fake_world_flat(&w);
    rig_stand(&r, &w, config, fake_vec(0, 0, 1));
    double ground = r.state.position.z;
    r.input.jump = 1;
    for (int i = 0; i < (int)(2 * hz); i++) {
        rig_step(&r, 1 / hz);
        const tahr_event *apex = rig_event(&r, TAHR_EVENT_APEX);
        top = fmax(top, apex ? apex->position.z - ground : 0);
    }
    rig_close(&r);
    return top;
}

/* L4 */
static void jumps(parity_table *table, const tahr_config *config)
{
    tahr_config c = *config;
    parity_row(table, "L4", NULL);
    for (int i = 0; i < 2; i++) {
        double hz = i ? 240 : 20;
        c.jump_hold_time = 0;
        parity_length(table, "apex", jump_height(&c, hz), 90, 1e-3);
        c.jump_hold_time = 0.3;
        c.jump_hold_gravity = 0;
        parity_length(table, "apex of a held jump", jump_height(&c, hz), 216, 1e-3);
    }
}

/* Sweeps of a world of callbacks, as they were asked. */
enum { SEEN = 64 };
typedef struct seen {
    fake_world world;
    vec3 motion[SEEN];
    uint32_t count;
} seen;

static tahr_status see(void *user, const tahr_sweep *query, tahr_hit *hit)
{
    seen *s = user;
    assert_true(s->count < SEEN);
    s->motion[s->count++] = query->motion;
    return fake_sweep(&s->world, query, hit);
}

/* L5: onto a step of 20 cm that lies 1 cm ahead. */
static void step_up(parity_table *table)
{
    seen s;
    parity p;
    tahr_callbacks callbacks = {.struct_size = sizeof callbacks, .user = &s, .sweep = see};
    memset(&s, 0, sizeof s);
    fake_world_flat(&s.world);
    fake_add_box(&s.world, fake_vec(0.35, -5, -1), fake_vec(5, 5, 0.2));
    parity_row(table, "L5", NULL);
    parity_open_callbacks(&p, &callbacks, NULL);
    parity_put(&p, 0, 0, 88 + 2.15);
    p.step.state.mode = TAHR_MODE_WALKING;
    parity_floor(&p, 2.15, vec(0, 0, 1), TAHR_FLOOR_BLOCKING | TAHR_FLOOR_WALKABLE | TAHR_FLOOR_FACE);
    tahr__swept obstacle;
    int found_floor;
    tahr__move_updated(&p.step, parity_vec(30, 0, 0), 0, &obstacle);
    s.count = 0;
    vec3 rest = scale(parity_vec(30, 0, 0), 1 - obstacle.hit.fraction);
    parity_true(table, "goes up", tahr__step_up_at(&p.step, rest, &obstacle, &found_floor) > 0);
    parity_true(table, "with its floor", found_floor && p.step.state.floor.body == 1);
    parity_vector(table, "way up", s.motion[0], 0, 0, 42.85, 1e-4);
    parity_vector(table, "way down", s.motion[2], 0, 0, -49.8, 1e-4);
    parity_count(table, "queries", p.step.queries - 1, 3);
    parity_close(&p);
}

static void slices_braking_jumps_and_steps(void **unused)
{
    parity_table table;
    const tahr_config c = parity_config();
    (void)unused;
    parity_begin(&table, "L, loops");
    time_steps(&table, &c);
    braking(&table, &c);
    jumps(&table, &c);
    step_up(&table);
    parity_end(&table);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ramps_lift_a_level_motion),
        cmocka_unit_test(no_ramp_lifts_higher_than_a_step),
        cmocka_unit_test(faces_walkable_by_an_override_are_gone_up_a_step_at_a_time),
        cmocka_unit_test(slices_braking_jumps_and_steps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
