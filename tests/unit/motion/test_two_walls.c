/* SPDX-License-Identifier: MIT
 * test_two_walls.c: characters of the unreal preset, and of every pair of integrator and slide solver, wander over a
 * course of walls, corners, stairs, ramps and ledges. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "native_world.h"
#include "rig.h"

/* A yard of 16 m x 16 m with walls around it. */
enum { COURSE = 24 };
static uint32_t make_course(tahr_body_desc bodies[COURSE])
{
    const double s15 = sin(acos(-1.0) / 12), c15 = cos(acos(-1.0) / 12);
    uint32_t n = 0;
    bodies[n++] = native_box(fake_vec(0, 0, -1), fake_vec(9, 9, 1));
    for (int side = -1; side < 2; side += 2) {
        bodies[n++] = native_box(fake_vec(side * 8.5, 0, 4), fake_vec(0.5, 9, 5));
        bodies[n++] = native_box(fake_vec(0, side * 8.5, 4), fake_vec(9, 0.5, 5));
    }
    for (int i = 0; i < 6; i++) { /* stairs, 17 cm by 30 cm, and the platform that they lead to: a ledge of 1.02 m */
        bodies[n++] = native_box(fake_vec(2.15 + 0.3 * i, 4, 0.085 * (i + 1)), fake_vec(0.15, 1.5, 0.085 * (i + 1)));
    }
    bodies[n++] = native_box(fake_vec(5.3, 4, 0.51), fake_vec(1.5, 1.5, 0.51));
    bodies[n] = native_box(fake_vec(-4, 4, 0), fake_vec(2.5, 1.5, 0.5)); /* a ramp of 30 degrees */
    bodies[n++].pose.orientation = (tahr_quat){0, -s15, 0, c15};
    bodies[n] = native_box(fake_vec(-4, -4, 0), fake_vec(2, 1.5, 1)); /* and one of 60, too steep */
    bodies[n++].pose.orientation = (tahr_quat){0, -0.5, 0, sqrt(0.75)};
    bodies[n] = native_box(fake_vec(3, -4, 1), fake_vec(1.5, 0.3, 2)); /* two walls that meet at 60 degrees */
    bodies[n++].pose.orientation = (tahr_quat){0, 0, 0.5, sqrt(0.75)};
    bodies[n++] = native_box(fake_vec(3.5, -4.8, 1), fake_vec(1.5, 0.3, 2));
    bodies[n++] = native_box(fake_vec(0, -1.5, 0.2), fake_vec(0.4, 0.4, 0.2)); /* a block just low enough to step on */
    bodies[n++] = native_box(fake_vec(0, 2, 0.35), fake_vec(0.5, 0.5, 0.35));  /* one too high */
    bodies[n++] = native_box(fake_vec(-1, -6, 2.6), fake_vec(1, 1, 0.5));      /* a ceiling low enough to bump into */
    bodies[n] = native_box(fake_vec(0, 5.5, 1.2), fake_vec(1, 1, 0.1));        /* a leaning slab */
    bodies[n++].pose.orientation = (tahr_quat){0.3826834323650898, 0, 0, 0.9238795325112867};
    assert_true(n <= COURSE);
    return n;
}

/* Toward a new place of the yard every 0.2 to 1.2 s, often with a jump; sometimes it stands. */
typedef struct wanderer {
    oracle_random dice;
    double until;
} wanderer;

static void choose(wanderer *w, rig *r)
{
    if (r->time < w->until) {
        return;
    }
    double x = oracle_uniform(&w->dice, -7, 7) - r->state.position.x,
           y = oracle_uniform(&w->dice, -7, 7) - r->state.position.y;
    double size = oracle_uniform(&w->dice, -0.3, 1.5), far = hypot(x, y) + 1e-9;
    size = size < 0 ? 0 : (size > 1 ? 1 : size);
    r->input.move = fake_vec(size * x / far, size * y / far, 0);
    r->input.jump = !r->input.jump && oracle_uniform(&w->dice, 0, 1) < 0.5;
    w->until = r->time + oracle_uniform(&w->dice, 0.2, 1.2);
}

/* m the true shape is deep in something. */
static double depth_of(const rig *r)
{
    tahr_contact contacts[16];
    uint32_t count = 0;
    double deepest = 0;
    tahr_contact_query q = {.shape = r->config.shape,
                            .position = r->state.position,
                            .up = r->state.up,
                            .orientation = r->state.orientation,
                            .mask = r->config.mask,
                            .ignore_body = TAHR_NO_BODY};
    assert_true(tahr_world_contacts(r->world, &q, contacts, 16, &count) >= 0);
    for (uint32_t i = 0; i < count; i++) {
        deepest = fmax(deepest, -contacts[i].distance);
    }
    return deepest;
}

static void check_whereabouts(const rig *r, const char *what, double hz)
{
    const tahr_state *s = &r->state;
    const double values[6] = {s->position.x, s->position.y, s->position.z, s->velocity.x, s->velocity.y, s->velocity.z};
    for (int i = 0; i < 6; i++) {
        if (!(fabs(values[i]) < 50)) {
            fail_msg("%s at %g Hz, %g s: a number is %g", what, hz, r->time, values[i]);
        }
    }
    double rim = 8 - r->config.shape.radius, low = r->config.shape.half_height;
    if (fabs(s->position.x) > rim || fabs(s->position.y) > rim || s->position.z < low - 1e-3) {
        fail_msg("%s at %g Hz, %g s: left the yard at %g %g %g", what, hz, r->time, s->position.x, s->position.y,
                 s->position.z);
    }
    assert_true(s->mode == TAHR_MODE_WALKING || s->mode == TAHR_MODE_FALLING);
}

/* Another mover, which has just been somewhere else, makes the same bits of the same state. */
static void check_rollback(rig *r, tahr_mover *other, const tahr_state *before, double dt)
{
    tahr_state again = *before, elsewhere = *before;
    elsewhere.position = fake_vec(-before->position.y, before->position.x, before->position.z + 1);
    assert_true(tahr_mover_step(other, &r->input, dt, &elsewhere, NULL) >= 0);
    assert_true(tahr_mover_step(other, &r->input, dt, &again, NULL) >= 0);
    assert_memory_equal(&again, &r->state, sizeof again);
}

typedef struct journey {
    double deepest, way, highest;
    int walked, fell, hits, steps, landings, capped;
} journey;

static void count_events(const rig *r, journey *j)
{
    for (uint32_t i = 0; i < r->report.event_count; i++) {
        j->hits += r->events[i].type == TAHR_EVENT_HIT;
        j->steps += r->events[i].type == TAHR_EVENT_STEPPED_UP;
        j->landings += r->events[i].type == TAHR_EVENT_LANDED;
    }
}

/* The most that a slice of the unreal preset asks: walking 2 moves, a failed step up (9), a slide (2), a floor (6), its
 * height and a look beside a ledge (4); falling 3 moves, a step aside, 3 landing spots (6 each), a look down (6), a
 * floor and its height. Where something overlaps every move may ask 7. */
static void check_queries(const rig *r)
{
    enum { WALKING = 2 + 9 + 2 + 6 + 1 + 4, FALLING = 3 + 1 + 18 + 6 + 6 + 1, ENTRY = 6 };
    const tahr_config *c = &r->config;
    int unreal = c->slide_solver == TAHR_SLIDE_TWO_WALLS && c->step_rule == TAHR_STEP_BY_CONTACT &&
                 c->floor_probe == TAHR_FLOOR_PROBE_SHRUNK;
    if (unreal && r->report.contact_queries == 0) {
        uint32_t most = FALLING > WALKING ? FALLING : WALKING;
        assert_true(r->report.sweeps + r->report.rays <= most * r->report.slices + ENTRY);
    }
}

/* 20 s. allowed: m of depth. */
static journey wander(const tahr_config *config, const char *what, double hz, uint64_t seed, double allowed)
{
    tahr_body_desc bodies[COURSE];
    rig r;
    wanderer w = {.dice = {seed}};
    journey j = {0};
    tahr_mover *other = NULL;
    rig_open_bodies(&r, bodies, make_course(bodies), config, fake_vec(0, 0, 1));
    assert_int_equal(tahr_mover_create(r.world, config, &other), TAHR_OK);
    for (int i = 0; i < (int)(20 * hz); i++) {
        tahr_state before = r.state;
        choose(&w, &r);
        rig_step(&r, 1 / hz);
        check_whereabouts(&r, what, hz);
        rig_assert_in_order(&r, 1 / hz);
        j.capped += (r.report.flags & TAHR_REPORT_QUERY_CAP) != 0;
        check_queries(&r);
        double depth = depth_of(&r);
        if (depth > allowed) {
            fail_msg("%s at %g Hz, %g s: %g m deep at %g %g %g", what, hz, r.time, depth, r.state.position.x,
                     r.state.position.y, r.state.position.z);
        }
        if (i % 7 == 0) {
            check_rollback(&r, other, &before, 1 / hz);
        }
        j.deepest = fmax(j.deepest, depth);
        j.way += hypot(r.state.position.x - before.position.x, r.state.position.y - before.position.y);
        j.highest = fmax(j.highest, r.state.position.z);
        j.walked += r.state.mode == TAHR_MODE_WALKING;
        j.fell += r.state.mode == TAHR_MODE_FALLING;
        count_events(&r, &j);
    }
    tahr_mover_destroy(other);
    rig_close(&r);
    return j;
}

static const double rates[] = {10, 30, 60, 120};

static void check_journeys(const tahr_config *config, const char *what, double allowed)
{
    for (int i = 0; i < 4; i++) {
        journey all = {0};
        for (uint64_t seed = 1; seed <= 4; seed++) {
            journey j = wander(config, what, rates[i], seed, allowed);
            all.deepest = fmax(all.deepest, j.deepest);
            all.way += j.way / 4;
            all.highest = fmax(all.highest, j.highest);
            all.walked += j.walked;
            all.fell += j.fell;
            all.hits += j.hits;
            all.steps += j.steps;
            all.landings += j.landings;
            all.capped += j.capped;
        }
        print_message("%-34s %4g Hz: %5.1f m in 20 s, %.1e m deep, %d hits, %d steps up, %d landings, %d capped\n",
                      what, rates[i], all.way, all.deepest, all.hits, all.steps, all.landings, all.capped);
        assert_true(all.way > 20 && all.walked > all.fell && all.fell > 0); /* it goes on, on the ground and in the
                                                                             * air */
        assert_true(all.highest > 1.5 && all.hits > 50 && all.landings > 15);
        assert_int_equal(all.capped, 0);
    }
}

static void unreal_characters_stay_in_the_yard_and_out_of_walls(void **unused)
{
    tahr_config c;
    (void)unused;
    assert_int_equal(tahr_config_init(&c, sizeof c, TAHR_PRESET_UNREAL), TAHR_OK);
    check_journeys(&c, "unreal", 1e-4);
    c.cached_floor = 1;
    c.keep_level_speed = 0;
    c.walk_off_ledges = 0;
    c.perch_threshold = 0.15;
    check_journeys(&c, "unreal, other switches", 1e-4);
}

/* Up 8 steps of 17 cm by 30 cm at 6 m/s: 3.2 m of level way, from before the first to behind the last. */
static void check_stairs(const tahr_config *config, const char *what, double hz)
{
    enum { STEPS = 8 };
    tahr_body_desc bodies[STEPS + 1];
    rig r;
    double begin = -1, end = -1;
    bodies[STEPS] = native_box(fake_vec(0, 0, -1), fake_vec(20, 20, 1));
    for (int i = 0; i < STEPS; i++) {
        bodies[i] = native_box(fake_vec(7 + 0.3 * i, 0, 0.085 * (i + 1)), fake_vec(5, 2, 0.085 * (i + 1)));
    }
    rig_open_bodies(&r, bodies, STEPS + 1, config, fake_vec(0, 0, 1));
    rig_settle(&r);
    double ground = r.state.position.z;
    r.time = 0;
    r.state.velocity = fake_vec(6, 0, 0);
    r.input.move = fake_vec(1, 0, 0);
    while (end < 0 && r.time < 2) {
        double x = r.state.position.x;
        rig_step(&r, 1 / hz);
        double step = r.state.position.x - x, past = r.state.position.x;
        begin = begin < 0 && past >= 1.4 ? r.time - (past - 1.4) / (step * hz) : begin;
        end = past >= 4.6 ? r.time - (past - 4.6) / (step * hz) : end;
    }
    double time = end - begin, top = r.state.position.z - ground;
    rig_close(&r);
    if (!(end > 0 && fabs(time * 6 / 3.2 - 1) < 0.02 && fabs(top - 8 * 0.17) < 0.02)) {
        fail_msg("%s at %g Hz: %g s up the stairs, %g m high", what, hz, time, top);
    }
}

/* On top of either preset: the other settings are as it has them. */
static void name_mix(int32_t preset, uint32_t mix, tahr_config *config, char what[64])
{
    tahr_config c;
    assert_int_equal(tahr_config_init(&c, sizeof c, preset), TAHR_OK);
    c.integrator = mix & 1 ? TAHR_INTEGRATOR_STEPPED : TAHR_INTEGRATOR_EXACT;
    c.slide_solver = mix & 2 ? TAHR_SLIDE_TWO_WALLS : TAHR_SLIDE_JOINT;
    c.step_rule = mix & 4 ? TAHR_STEP_BY_CONTACT : TAHR_STEP_BY_TREAD;
    snprintf(what, 64, "%s %s %s %s", tahr_preset_name(preset), mix & 1 ? "stepped" : "exact",
             mix & 2 ? "two walls" : "joint", mix & 4 ? "contact" : "tread");
    *config = c;
}

static void every_integrator_runs_with_every_solver_and_step_rule(void **unused)
{
    (void)unused;
    for (int32_t preset = TAHR_PRESET_PRECISE; preset <= TAHR_PRESET_UNREAL; preset++) {
        for (uint32_t mix = 0; mix < 8; mix++) {
            tahr_config c;
            char what[64];
            name_mix(preset, mix, &c, what);
            check_journeys(&c, what, 1e-4);
        }
    }
}

static void all_of_them_climb_stairs_at_full_speed(void **unused)
{
    static const double hz[] = {10, 30, 60, 120, 240, 1000};
    (void)unused;
    for (int32_t preset = TAHR_PRESET_PRECISE; preset <= TAHR_PRESET_UNREAL; preset++) {
        for (uint32_t mix = 0; mix < 8; mix++) {
            tahr_config c;
            char what[64];
            name_mix(preset, mix, &c, what);
            for (int i = 0; i < 6; i++) {
                check_stairs(&c, what, hz[i]);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unreal_characters_stay_in_the_yard_and_out_of_walls),
        cmocka_unit_test(all_of_them_climb_stairs_at_full_speed),
        cmocka_unit_test(every_integrator_runs_with_every_solver_and_step_rule),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
