/* SPDX-License-Identifier: MIT
 * test_trace.c: every rule of walking and falling shows in a trace what it accepted and what it rejected, and why.
 * test_trace_modes.c: the other rules, and the other methods. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "trace.h"

static trace_row rows[] = {{TAHR_RULE_WALKABLE, 1, "cosine of the face's slope", 0},
                           {TAHR_RULE_WALKABLE, 0, "cosine of the face's slope", 0},
                           {TAHR_RULE_EDGE_TOLERANCE, 0, "touches the rim", 0},
                           {TAHR_RULE_PERCH, 1, "floor for the inner foot", 0},
                           {TAHR_RULE_PERCH, 0, "floor for the inner foot", 0},
                           {TAHR_RULE_FLOOR, 1, "floor distance", 0},
                           {TAHR_RULE_FLOOR, 0, "floor distance", 0},
                           {TAHR_RULE_FLOOR, 0, "nothing below", 0},
                           {TAHR_RULE_CACHED_FLOOR, 1, "neither the character nor the world moved", 0},
                           {TAHR_RULE_FLOOR_HEIGHT, 1, "clearance outside the band", 0},
                           {TAHR_RULE_RAMP, 1, "a walkable face", 0},
                           {TAHR_RULE_RAMP, 0, "too steep to go on along", 0},
                           {TAHR_RULE_SLIDE, 1, "slides along", 0},
                           {TAHR_RULE_SLIDE, 0, "squeezed between floor and ceiling", 0},
                           {TAHR_RULE_STEP_UP, 1, "landed", 0},
                           {TAHR_RULE_STEP_UP, 0, "blocked at step height too", 0},
                           {TAHR_RULE_STEP_UP, 0, "no room to rise", 0},
                           {TAHR_RULE_STEP_UP, 0, "higher than a step", 0},
                           {TAHR_RULE_STEP_DOWN, 1, "floor followed down", 0},
                           {TAHR_RULE_LANDING, 1, "floor where it fell", 0},
                           {TAHR_RULE_LANDING, 0, "floor where it fell", 0},
                           {TAHR_RULE_LANDING, 0, "not met from above", 0},
                           {TAHR_RULE_WEDGE, 1, "downward motion that the contacts leave", 0},
                           {TAHR_RULE_WEDGE, 0, "downward motion that the contacts leave", 0},
                           {TAHR_RULE_LEDGE, 1, "held at the ledge", 0},
                           {TAHR_RULE_LEDGE, 0, "no floor on the way here", 0},
                           {TAHR_RULE_DEPENETRATION, 1, "depth left after the joint push", 0},
                           {TAHR_RULE_DEPENETRATION, 0, "depth left after the joint push", 0},
                           {TAHR_RULE_JUMP, 1, "button went down on ground", 0},
                           {TAHR_RULE_SLOPE, 1, "ground half-way to the contact", 0},
                           {TAHR_RULE_SWEEP, 1, "nothing in the way", 0},
                           {TAHR_RULE_SWEEP, 0, "kept the skin to something", 0},
                           {TAHR_RULE_SWEEP, 0, "undecided, taken for a wall", 0},
                           {TAHR_RULE_SWEEP, 0, "overlaps something already", 0}};
static trace all = {rows, sizeof rows / sizeof rows[0]};

static void stand_walk_jump_and_meet_a_wall(void)
{
    fake_world w;
    rig r;
    fake_world_flat(&w);
    fake_add_plane(&w, fake_vec(-1, 0, 0), -3);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
    trace_steps(&all, &r, 2, fake_vec(0, 0, 0));
    trace_steps(&all, &r, 60, fake_vec(0.8, 0.6, 0));
    r.input.jump = 1;
    trace_steps(&all, &r, 90, fake_vec(1, 0, 0));
    rig_close(&r);
}

/* Up a step, into a block that is too high, down again; under a beam that leaves no room for the step behind it. */
static void climb(void)
{
    fake_world w;
    rig r;
    fake_world_flat(&w);
    fake_add_box(&w, fake_vec(1, -9, -1), fake_vec(3, 9, 0.3));
    fake_add_box(&w, fake_vec(-3, -9, -1), fake_vec(-1.5, 9, 0.6));
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
    trace_steps(&all, &r, 60, fake_vec(-0.5, 0, 0));
    trace_steps(&all, &r, 150, fake_vec(0.6, 0, 0));
    fake_add_box(&w, fake_vec(0.2, -9, 1.9), fake_vec(0.9, 9, 3));
    trace_steps(&all, &r, 150, fake_vec(-1, 0, 0));
    rig_close(&r);
    fake_world_flat(&w);
    fake_add_box(&w, fake_vec(1, -9, -1), fake_vec(3, 9, 0.41)); /* swept over, and yet too high */
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
    trace_steps(&all, &r, 60, fake_vec(1, 0, 0));
    rig_close(&r);
    fake_world_flat(&w);
    fake_add_box(&w, fake_vec(1, -9, -1), fake_vec(3, 9, 0.2));
    fake_add_box(&w, fake_vec(-9, -9, 1.815), fake_vec(9, 9, 3));
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 0.9));
    trace_steps(&all, &r, 60, fake_vec(1, 0, 0));
    rig_close(&r);
}

static void slopes(void)
{
    fake_world w;
    rig r;
    fake_world_flat(&w);
    fake_add_slope(&w, 30);
    rig_stand(&r, &w, NULL, fake_vec(-2, 0, 1));
    trace_steps(&all, &r, 60, fake_vec(1, 0, 0));
    rig_close(&r);
    fake_world_init(&w);
    fake_add_slope(&w, 65);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 2));
    trace_steps(&all, &r, 60, fake_vec(0, 0, 0));
    rig_close(&r);
    fake_world_init(&w); /* a gutter of two such faces */
    fake_add_plane(&w, fake_vec(0.8, 0, 0.6), 0);
    fake_add_plane(&w, fake_vec(-0.8, 0, 0.6), 0);
    rig_open(&r, &w, NULL, fake_vec(0.1, 0, 2));
    trace_steps(&all, &r, 120, fake_vec(0, 0, 0));
    rig_close(&r);
    fake_world_flat(&w); /* a ceiling that comes down */
    fake_add_plane(&w, fake_vec(-0.1, 0, -0.99498743710662), -2);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 0.95));
    trace_steps(&all, &r, 120, fake_vec(1, 0, 0));
    rig_close(&r);
}

/* The end of a platform: leaning over it with and without something below, at its rim, held at it. */
static void edges(double below)
{
    const double out[] = {0.1, 0.25, 0.35, 0.35995};
    tahr_config c = rig_config();
    fake_world w;
    rig r;
    for (int i = 0; i < 4; i++) {
        fake_world_init(&w);
        fake_add_box(&w, fake_vec(-5, -5, -1), fake_vec(0, 5, 0));
        fake_add_plane(&w, fake_vec(0, 0, 1), below);
        rig_open(&r, &w, NULL, fake_vec(out[i], 0, 1));
        trace_steps(&all, &r, 30, fake_vec(0, 0, 0));
        rig_close(&r);
    }
    for (c.walk_off_ledges = 0; c.walk_off_ledges < 2; c.walk_off_ledges++) {
        rig_stand(&r, &w, &c, fake_vec(-1, 0, 1));
        trace_steps(&all, &r, 60, fake_vec(1, 0.2, 0));
        rig_close(&r);
    }
}

/* A level ceiling in the way of a level motion: only a world that contradicts itself has one. */
static tahr_status sweep_under_ceiling(void *user, const tahr_sweep *query, tahr_hit *hit)
{
    tahr_status status = fake_sweep(user, query, hit);
    if (query->motion.z == 0 && query->motion.x > 0) {
        *hit = (tahr_hit){.blocking = 1, .fraction = 0.5, .normal = {0, 0, -1}};
    }
    return status;
}

static void squeeze(void)
{
    fake_world w;
    rig r;
    fake_world_flat(&w);
    tahr_callbacks c = fake_callbacks(&w);
    c.sweep = sweep_under_ceiling;
    rig_open_callbacks(&r, &c, NULL, fake_vec(0, 0, 1));
    rig_settle(&r);
    trace_steps(&all, &r, 5, fake_vec(1, 0, 0));
    rig_close(&r);
}

static void overlaps(void)
{
    fake_world w;
    rig r;
    fake_world_flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 0.8));
    trace_steps(&all, &r, 5, fake_vec(1, 0, 0));
    fake_add_plane(&w, fake_vec(0, 0, -1), -1.5);
    tahr_world_touch(r.world);
    trace_steps(&all, &r, 5, fake_vec(1, 0, 0));
    rig_close(&r);
}

static void noise(void)
{
    fake_backend b;
    rig r;
    rig_open_backend(&r, &b, FAKE_BACKEND_ALL);
    tahr_config c = r.config;
    tahr_mover_destroy(r.mover);
    c.walk_off_ledges = 0;
    assert_int_equal(tahr_mover_create(r.world, &c, &r.mover), TAHR_OK);
    b.random = 1;
    for (int i = 0; i < 4000; i++) {
        r.state.position = fake_vec(0, 0, 1);
        r.input.move = dice_direction(&b.seed);
        rig_step(&r, 0.1);
        trace_note(&all, &r);
    }
    rig_close(&r);
}

static void every_rule_of_walking_and_falling_is_traced_with_its_reason(void **unused)
{
    (void)unused;
    stand_walk_jump_and_meet_a_wall();
    climb();
    slopes();
    edges(-4);
    edges(-0.2);
    overlaps();
    squeeze();
    noise();
    trace_check(&all, TAHR_RULE_WALKABLE, TAHR_RULE_SLOPE);
}

/* The sweep of a move that is cut short says where, and by what. */
static void the_sweep_of_a_move_tells_how_far_it_went(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_init(&w);
    fake_add_plane(&w, fake_vec(-1, 0, 0), -1);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 5));
    r.state.mode = TAHR_MODE_FALLING;
    r.state.velocity = fake_vec(64, 0, 0); /* one chord: the wall is met at 0.64 m of it */
    rig_step(&r, 1.0 / 64);
    const tahr_decision *d = &r.decisions[0];
    assert_true(r.report.decision_count > 0);
    assert_int_equal(d->rule, TAHR_RULE_SWEEP);
    assert_true(!d->accepted && d->body == 0 && d->limit == 1 && d->normal.x == -1);
    assert_near(d->value, 0.64, 1e-3);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_rule_of_walking_and_falling_is_traced_with_its_reason),
                                       cmocka_unit_test(the_sweep_of_a_move_tells_how_far_it_went)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
