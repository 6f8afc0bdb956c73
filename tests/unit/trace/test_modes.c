/* SPDX-License-Identifier: MIT
 * test_modes.c: the rules of bases, shapes, fluids, walls and edges show in a trace what they accepted and what
 * they rejected, and why; so do the methods of the preset `unreal`. test_trace.c: the rules of walking and falling. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

#include "layers.h"
#include "pool.h"
#include "stage.h"
#include "trace.h"

static trace_row rows[] = {{TAHR_RULE_BASE, 1, "carried with the base", 0},
                           {TAHR_RULE_BASE, 0, "carried with the base", 0},
                           {TAHR_RULE_BASE, 1, "pushed by a body that moves", 0},
                           {TAHR_RULE_BASE, 0, "pushed by a body that moves", 0},
                           {TAHR_RULE_SHAPE, 1, "room for a larger shape", 0},
                           {TAHR_RULE_SHAPE, 0, "room for a larger shape", 0},
                           {TAHR_RULE_FLUID, 1, "deep enough to swim", 0},
                           {TAHR_RULE_FLUID, 0, "too shallow to swim on", 0},
                           {TAHR_RULE_FLUID, 1, "finds its feet in the shallows", 0},
                           {TAHR_RULE_FLUID, 0, "finds its feet in the shallows", 0},
                           {TAHR_RULE_JUMP, 1, "at the surface of the water", 0},
                           {TAHR_RULE_JUMP, 0, "at the surface of the water", 0},
                           {TAHR_RULE_WALL_JUMP, 1, "button went down at a wall", 0},
                           {TAHR_RULE_WALL_JUMP, 0, "jumped off this wall already", 0},
                           {TAHR_RULE_LEDGE_GRAB, 0, "the wall is higher", 0},
                           {TAHR_RULE_LEDGE_GRAB, 0, "no top to stand on", 0},
                           {TAHR_RULE_LEDGE_GRAB, 0, "let go", 0},
                           {TAHR_RULE_LEDGE_GRAB, 1, "an edge", 0},
                           {TAHR_RULE_LEDGE_GRAB, 1, "hangs", 0},
                           {TAHR_RULE_LEDGE_GRAB, 0, "the edge is gone", 0},
                           {TAHR_RULE_LEDGE_GRAB, 0, "no room to rise", 0},
                           {TAHR_RULE_LEDGE_GRAB, 1, "climbed", 0},
                           {TAHR_RULE_CORNER, 1, "aside, past the corner", 0},
                           {TAHR_RULE_CORNER, 0, "no way past the corner", 0},
                           {TAHR_RULE_PULL_BACK, 1, "kept off the contact", 0},
                           {TAHR_RULE_PULL_BACK, 0, "kept off the contact", 0},
                           {TAHR_RULE_DEPENETRATION, 1, "pushed out of one surface", 0},
                           {TAHR_RULE_SLIDE, 1, "along a surface", 0},
                           {TAHR_RULE_STEP_UP, 1, "came down", 0},
                           {TAHR_RULE_STEP_UP, 0, "higher than a step", 0},
                           {TAHR_RULE_STEP_UP, 0, "met too high, or no higher than the floor", 0},
                           {TAHR_RULE_RAMP, 1, "another ramp", 0},
                           {TAHR_RULE_LANDING, 0, "too steep, or not under the foot", 0},
                           {TAHR_RULE_LEDGE, 0, "no floor beside the ledge", 0},
                           {TAHR_RULE_STEP_UP, 0, "passed from below", 0},
                           {TAHR_RULE_DROP, 1, "drops through", 0},
                           {TAHR_RULE_DROP, 0, "it is through", 0},
                           {TAHR_RULE_DROP, 0, "not on ground", 0},
                           {TAHR_RULE_DROP, 0, "no one-way floor", 0},
                           {TAHR_RULE_DROP, 0, "something else holds it too", 0}};
static trace all = {rows, sizeof rows / sizeof rows[0]};

/* A platform (1) carries the character against a block (2), and another one (3) pushes it. */
static void bases(void)
{
    const tahr_quat level = {0, 0, 0, 1};
    rig r;
    tahr_body_desc bodies[4] = {stage_ground(), stage_box(fake_vec(0, 0, 0.5), fake_vec(2, 2, 0.5)),
                                stage_box(fake_vec(2, 0, 2.6), fake_vec(0.5, 3, 1)),
                                stage_box(fake_vec(-9, 0, 2.6), fake_vec(0.5, 3, 1))};
    rig_open_bodies(&r, bodies, 4, NULL, fake_vec(0, 0, 2));
    rig_settle(&r);
    for (int k = 1; k <= 60; k++) {
        stage_step(&r, 1, (tahr_pose){{0.03 * k, 0, 0.5}, level}, 1.0 / 60);
        trace_note(&all, &r);
    }
    for (int k = 1; k <= 90; k++) {
        stage_step(&r, 3, (tahr_pose){{-9 + 0.1 * k, 0, 2.6}, level}, 1.0 / 60);
        trace_note(&all, &r);
    }
    rig_close(&r);
    bodies[3].flags = 0; /* against a wall that gives way for nobody */
    bodies[3].pose.position.x = -1;
    rig_open_bodies(&r, bodies, 4, NULL, fake_vec(0, 0, 2));
    rig_settle(&r);
    for (int k = 1; k <= 60; k++) {
        stage_step(&r, 2, (tahr_pose){{2 - 0.03 * k, 0, 2.6}, level}, 1.0 / 60);
        trace_note(&all, &r);
    }
    rig_close(&r);
}

/* Crouched under a beam 1.3 m high, and out of it. */
static void shapes(void)
{
    fake_world w;
    rig r;
    fake_world_flat(&w);
    fake_add_box(&w, fake_vec(1, -3, 1.3), fake_vec(4, 3, 3));
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
    r.input.crouch = 1;
    trace_steps(&all, &r, 60, fake_vec(1, 0, 0));
    r.input.crouch = 0;
    trace_steps(&all, &r, 120, fake_vec(1, 0, 0));
    rig_close(&r);
}

/* Down a shore of 1 in 4 into the sea, jumps there, and back; down to a deep bottom; and out of the water at once. */
static void fluids(void)
{
    pool p;
    rig r;
    const double size = sqrt(1 + 1.0 / 16);
    pool_init(&p);
    fake_add_plane(&p.world, fake_vec(0.25 / size, 0, 1 / size), 0);
    pool_open(&r, &p, NULL, fake_vec(2, 0, 1));
    trace_steps(&all, &r, 360, fake_vec(1, 0, 0));
    r.input.jump = 1;
    trace_steps(&all, &r, 60, fake_vec(0, 0, 0));
    r.input.jump = 0;
    trace_steps(&all, &r, 30, fake_vec(1, 0, -1));
    r.input.jump = 1;
    trace_steps(&all, &r, 5, fake_vec(1, 0, -1));
    r.input.jump = 0;
    trace_steps(&all, &r, 600, fake_vec(-1, 0, 0));
    rig_close(&r);
    pool_init(&p);
    fake_add_plane(&p.world, fake_vec(0, 0, 1), -4);
    pool_open(&r, &p, NULL, fake_vec(0, 0, -2));
    r.state.mode = TAHR_MODE_SWIMMING;
    trace_steps(&all, &r, 120, fake_vec(0, 0, -1));
    r.state.position.z = 2;
    trace_steps(&all, &r, 1, fake_vec(0, 0, 0));
    rig_close(&r);
}

/* Two jumps off one wall. */
static void walls(void)
{
    tahr_config c = rig_config();
    fake_world w;
    rig r;
    c.wall_jump_speed = 1;
    fake_world_flat(&w);
    fake_add_plane(&w, fake_vec(-1, 0, 0), 0);
    rig_open(&r, &w, &c, fake_vec(-0.36, 0, 20));
    trace_steps(&all, &r, 5, fake_vec(1, 0, 0));
    for (int k = 0; k < 3; k++) {
        r.input.jump = 1;
        trace_steps(&all, &r, 1, fake_vec(1, 0, 0));
        r.input.jump = 0;
        trace_steps(&all, &r, 40, fake_vec(1, 0, 0));
    }
    rig_close(&r);
}

/* At a wall 10 m high: far below its end, at it, and where the end is gone or too narrow to stand on. */
static void edges(void)
{
    tahr_config c = rig_config();
    fake_world w;
    rig r;
    c.ledge_grab = 0.3;
    fake_world_flat(&w);
    fake_solid *wall = fake_add_box(&w, fake_vec(0, -5, 0), fake_vec(6, 5, 10));
    rig_open(&r, &w, &c, fake_vec(-0.36, 0, 5));
    trace_steps(&all, &r, 10, fake_vec(1, 0, 0));
    r.state.position.z = 9.2; /* hangs, and cannot climb under a beam */
    fake_solid *beam = fake_add_box(&w, fake_vec(-2, -5, 10.5), fake_vec(2, 5, 12));
    r.state.velocity = fake_vec(0, 0, 0);
    tahr_world_touch(r.world);
    trace_steps(&all, &r, 10, fake_vec(1, 0, 0));
    r.input.jump = 1;
    trace_steps(&all, &r, 1, fake_vec(0, 0, 0));
    r.input.jump = 0;
    trace_steps(&all, &r, 1, fake_vec(0, 0, 0));
    beam->min.z = 20, beam->max.z = 21;
    tahr_world_touch(r.world);
    rig_close(&r);
    rig_open(&r, &w, &c, fake_vec(-0.36, 0, 9.5));
    r.input.crouch = 1; /* its head 5 cm above the edge: who crouches passes it */
    trace_steps(&all, &r, 20, fake_vec(1, 0, 0));
    rig_close(&r);
    rig_open(&r, &w, &c, fake_vec(-0.36, 0, 9.2));
    trace_steps(&all, &r, 10, fake_vec(1, 0, 0));
    r.input.jump = 1;
    trace_steps(&all, &r, 2, fake_vec(0, 0, 0));
    rig_close(&r);
    rig_open(&r, &w, &c, fake_vec(-0.36, 0, 9.2));
    trace_steps(&all, &r, 10, fake_vec(1, 0, 0));
    wall->max.z = 2;
    tahr_world_touch(r.world);
    trace_steps(&all, &r, 2, fake_vec(0, 0, 0));
    rig_close(&r);
    fake_world_flat(&w);
    fake_add_box(&w, fake_vec(0, -5, 0), fake_vec(0.02, 5, 10));
    rig_open(&r, &w, &c, fake_vec(-0.36, 0, 9.2));
    trace_steps(&all, &r, 10, fake_vec(1, 0, 0));
    rig_close(&r);
}

static void corners(void)
{
    const double edges_at[] = {0.3, 0.2};
    tahr_config c = rig_config();
    c.corner_correction = 0.1;
    for (int k = 0; k < 2; k++) {
        fake_world w;
        rig r;
        fake_world_flat(&w);
        fake_add_box(&w, fake_vec(edges_at[k], -5, 2.5), fake_vec(10, 5, 6));
        rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
        r.input.jump = 1;
        trace_steps(&all, &r, 40, fake_vec(0, 0, 0));
        rig_close(&r);
    }
}

/* Over a step, into a block, up a second ramp; a fall along a steep face; out of an overlap; held at a ledge. */
static void stepwise(void)
{
    tahr_config c;
    fake_world w;
    rig r;
    assert_int_equal(tahr_config_init(&c, sizeof c, TAHR_PRESET_UNREAL), TAHR_OK);
    fake_world_flat(&w);
    fake_add_box(&w, fake_vec(1, -9, -1), fake_vec(3, 9, 0.3));
    fake_add_box(&w, fake_vec(-3, -9, -1), fake_vec(-1.5, 9, 0.6));
    fake_add_box(&w, fake_vec(-9, 4, -1), fake_vec(9, 5, 9));
    rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
    trace_steps(&all, &r, 60, fake_vec(1, 0.1, 0));
    trace_steps(&all, &r, 120, fake_vec(-1, 0.1, 0));
    trace_steps(&all, &r, 120, fake_vec(0.2, 1, 0));
    r.state.position.y = 3.7; /* 4 cm inside the wall */
    trace_steps(&all, &r, 5, fake_vec(0.2, 1, 0));
    rig_close(&r);
    fake_world_flat(&w);
    fake_add_box(&w, fake_vec(1, -9, 1.6), fake_vec(3, 9, 3)); /* at its head */
    rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
    trace_steps(&all, &r, 60, fake_vec(1, 0, 0));
    rig_close(&r);
    fake_world_flat(&w);
    fake_add_slope(&w, 30);
    rig_stand(&r, &w, &c, fake_vec(-2, 0, 1));
    trace_steps(&all, &r, 90, fake_vec(1, 0, 0));
    rig_close(&r);
    fake_world_init(&w);
    fake_add_slope(&w, 65);
    rig_open(&r, &w, &c, fake_vec(0, 0, 2));
    trace_steps(&all, &r, 60, fake_vec(0, 0, 0));
    rig_close(&r);
    c.walk_off_ledges = 0;
    fake_world_init(&w);
    fake_add_box(&w, fake_vec(-1, -0.1, -1), fake_vec(1, 0.1, 0));
    rig_open(&r, &w, &c, fake_vec(0, 0, 1));
    trace_steps(&all, &r, 120, fake_vec(1, 0, 0));
    rig_close(&r);
}

/* Presses on a ground, on a platform, in the air, and between the two; and a step whose tread is one-way. */
static void drops(void)
{
    static const double X[] = {-2, 2, 0.05};
    static layers l;
    rig r;
    layers_begin(&l, 0);
    layers_add(&l, LAYER_BOX, -5, 0, 1, 0);
    layers_add(&l, LAYER_BOX, 0, 5, 1, TAHR_BODY_ONE_WAY);
    layers_add(&l, LAYER_BOX, -4, -3.3, 1.2, 0);
    layers_add(&l, LAYER_SHEET, -5, -3.3, 1.3, TAHR_BODY_ONE_WAY);
    for (int i = 0; i < 3; i++) {
        layers_open(&l, &r, NULL, X[i], 1.1);
        rig_settle(&r);
        for (int k = 0; k < 6; k++) {
            r.input.flags = k % 2 ? 0 : TAHR_INPUT_DROP;
            trace_steps(&all, &r, 3, fake_vec(0, 0, 0));
        }
        trace_steps(&all, &r, i ? 0 : 60, fake_vec(-1, 0, 0));
        rig_close(&r);
    }
}

static void every_rule_of_bases_modes_and_methods_is_traced_with_its_reason(void **unused)
{
    (void)unused;
    bases();
    shapes();
    fluids();
    walls();
    edges();
    corners();
    stepwise();
    drops();
    trace_check(&all, TAHR_RULE_BASE, TAHR_RULE_DROP);
    assert_string_equal(tahr_rule_name(TAHR_RULE_DROP + 1), "?"); /* the last one: a new rule needs its row */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_rule_of_bases_modes_and_methods_is_traced_with_its_reason)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
