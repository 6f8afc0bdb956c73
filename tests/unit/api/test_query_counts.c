/* SPDX-License-Identifier: MIT
 * test_query_counts.c: the unreal preset asks what is promised: exactly so many queries in nominal scenes, and never
 * more than the most for each function. Those of moves, slides and floors are in test_parity_*.c. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "floor_distance.h"
#include "landing.h"
#include "move_along_floor.h"
#include "native_world.h"
#include "parity.h"
#include "perch.h"
#include "rig.h"
#include "scene_backend.h"
#include "slide.h"
#include "step_up.h"
#include "walk_two_walls.h"

static uint32_t asked(const rig *r)
{
    return r->report.sweeps + r->report.contact_queries + r->report.rays;
}

static void expect_each(rig *r, int steps, uint32_t expected)
{
    for (int i = 0; i < steps; i++) {
        rig_step(r, 1.0 / 60);
        assert_int_equal(asked(r), expected);
        assert_int_equal(r->report.sweeps, expected);
    }
}

static void walking_on_flat_ground_asks_two_standing_one_cached_none(void **unused)
{
    (void)unused;
    for (uint32_t cached = 0; cached < 2; cached++) {
        fake_world w;
        rig r;
        tahr_config c = parity_config();
        c.cached_floor = cached;
        c.sleep = 0;
        fake_world_flat(&w);
        rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
        expect_each(&r, 20, cached ? 0 : 1);
        r.input.move = fake_vec(1, 0, 0);
        expect_each(&r, 60, 2);
        r.input.move = fake_vec(0, 0, 0);
        rig_steps(&r, 60, 1.0 / 60);
        expect_each(&r, 20, cached ? 0 : 1);
        rig_close(&r);
    }
}

/* The same whole steps over a box of the native backend, whose nearest face is not told by a closed form; in the air
 * 1. */
static void bodies_are_asked_as_often_as_closed_forms(void **unused)
{
    tahr_body_desc ground = native_box(fake_vec(0, 0, -1), fake_vec(50, 50, 1));
    (void)unused;
    for (uint32_t mix = 0; mix < 4; mix++) {
        rig r;
        tahr_config c = parity_config();
        c.cached_floor = mix & 1;
        ground.flags = mix & 2 ? TAHR_BODY_MOVABLE : 0; /* what may move is looked at each time */
        uint32_t standing = c.cached_floor && !(mix & 2) ? 0 : 1;
        c.sleep = 0;
        rig_open_bodies(&r, &ground, 1, &c, fake_vec(0, 0, 1.5));
        rig_step(&r, 1.0 / 60);
        assert_true(r.state.mode == TAHR_MODE_FALLING && asked(&r) == 1);
        rig_settle(&r);
        expect_each(&r, 20, standing);
        r.input.move = fake_vec(1, 0, 0);
        expect_each(&r, 60, 2);
        r.input.move = fake_vec(0, 0, 0);
        rig_steps(&r, 60, 1.0 / 60);
        expect_each(&r, 20, standing);
        rig_close(&r);
    }
}

static void walk(tahr_mover *mover, const tahr_input *input, tahr_state *s, int steps)
{
    for (int i = 0; i < steps; i++) {
        assert_true(tahr_mover_step(mover, input, 1.0 / 60, s, NULL) >= 0);
    }
}

static void expect_each_step(tahr_mover *mover, const tahr_input *input, tahr_state *s, int steps, uint32_t sweeps)
{
    for (int i = 0; i < steps; i++) {
        tahr_report report = {.struct_size = sizeof report};
        assert_true(tahr_mover_step(mover, input, 1.0 / 60, s, &report) >= 0);
        assert_int_equal(s->mode, TAHR_MODE_WALKING);
        assert_int_equal(report.sweeps, sweeps);
        assert_int_equal(report.contact_queries + report.rays + report.fluid_queries, 0);
    }
}

/* Twenty-five flush tiles of a metre; 2 s at 6 m/s pass over twelve seams. In a plane up is +y. */
static void walk_over_tiles(const scene_backend *backend)
{
    tahr_body_desc tiles[25];
    tahr_world *world = NULL;
    tahr_mover *mover = NULL;
    tahr_state s;
    tahr_config c;
    tahr_input input = {.struct_size = sizeof input};
    tahr_config_init(&c, sizeof c, backend->planar ? TAHR_PRESET_PLATFORMER : TAHR_PRESET_PRECISE);
    for (int i = 0; i < 25; i++) {
        tahr_vec3 middle = backend->planar ? fake_vec(i - 2, -0.5, 0) : fake_vec(i - 2, 0, -0.5);
        tiles[i] = native_box(middle, backend->planar ? fake_vec(0.5, 0.5, 5) : fake_vec(0.5, 5, 0.5));
    }
    tahr_vec3 at = backend->planar ? fake_vec(0, 1, 0) : fake_vec(0, 0, 1);
    assert_int_equal(scene_backend_open(backend, tiles, 25, NULL, &world), TAHR_OK);
    assert_int_equal(tahr_mover_create(world, &c, &mover), TAHR_OK);
    tahr_state_init(&s, &c, &at);
    walk(mover, &input, &s, 60);
    expect_each_step(mover, &input, &s, 20, 0); /* asleep */
    input.move.x = 1;
    walk(mover, &input, &s, 30); /* up to speed, which is a bend of the way and one sweep more */
    double from = s.position.x;
    expect_each_step(mover, &input, &s, 120, 2);
    assert_near(s.position.x - from, 12, 1e-9);
    tahr_mover_destroy(mover);
    tahr_world_close(world);
}

static void a_walk_over_flush_tiles_asks_two_sweeps_on_every_backend(void **unused)
{
    (void)unused;
    for (int i = 0; i < SCENE_BACKEND_COUNT; i++) {
        walk_over_tiles(&SCENE_BACKENDS[i]);
    }
    for (int i = 0; i < SCENE_PLANAR_BACKEND_COUNT; i++) {
        walk_over_tiles(&SCENE_PLANAR_BACKENDS[i]);
    }
}

/* On the ground 0 to crouch and 1 or 2 to stand up again, in the air up to 3; refused is asked each step. */
static void crouching_asks_at_most_one_and_standing_up_at_most_three(void **unused)
{
    (void)unused;
    for (int air = 0; air < 2; air++) {
        for (int low = 0; low < 2; low++) { /* under a ceiling 1.2 m over the foot there is no room */
            tahr_body_desc bodies[2] = {native_box(fake_vec(0, 0, -1), fake_vec(50, 50, 1)),
                                        native_box(fake_vec(0, 0, low ? 2.2 : 50), fake_vec(50, 50, 1))};
            rig r;
            tahr_config c = parity_config();
            c.sleep = 0;
            c.gravity = air ? fake_vec(0, 0, 0) : c.gravity;
            rig_open_bodies(&r, bodies, 2, &c, fake_vec(0, 0, low ? 0.6 : 1));
            r.input.crouch = 1;
            rig_step(&r, 1.0 / 60);
            assert_true(r.report.contact_queries <= 1);
            if (!air) {
                rig_settle(&r);
            }
            assert_true(r.state.half_height < 0.5);
            r.input.crouch = 0;
            for (int i = 0; i < 5; i++) {
                int crouched = r.state.half_height < 0.5;
                rig_step(&r, 1.0 / 60);
                uint32_t n = r.report.contact_queries;
                assert_true(crouched ? n >= 1 && n <= (air ? 3u : 2u) : n == 0);
            }
            assert_int_equal(r.state.half_height < 0.5, low);
            assert_int_equal((r.report.flags & TAHR_REPORT_SHAPE_REFUSED) != 0, low);
            rig_close(&r);
        }
    }
}

/* 0.5 s in one step: 8 slices. */
static void every_slice_of_a_long_step_asks_as_a_step(void **unused)
{
    fake_world w;
    rig r;
    tahr_config c = parity_config();
    (void)unused;
    fake_world_flat(&w);
    rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
    r.input.move = fake_vec(1, 0, 0);
    rig_step(&r, 0.5);
    assert_int_equal(asked(&r), 16);
    rig_step(&r, 0.051);
    assert_int_equal(asked(&r), 4);
    rig_close(&r);
}

/* Down a slope of which the floor is 3 mm lower than the ramp says: the height is put right by one more. */
static void a_correction_of_the_height_asks_one_more(void **unused)
{
    fake_world w;
    rig r;
    tahr_config c = parity_config();
    (void)unused;
    fake_world_flat(&w);
    fake_add_box(&w, fake_vec(-5, -5, -1), fake_vec(0.2, 5, 0.01));
    rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
    r.state.velocity = fake_vec(6, 0, 0);
    r.input.move = fake_vec(1, 0, 0);
    uint32_t twos = 0, threes = 0;
    for (int i = 0; i < 20; i++) {
        rig_step(&r, 1.0 / 60);
        twos += asked(&r) == 2;
        threes += asked(&r) == 3;
    }
    assert_int_equal(twos + threes, 20);
    assert_true(threes >= 1 && threes < 8);
    rig_close(&r);
}

static void falling_free_asks_one_and_landing_three(void **unused)
{
    fake_world w;
    rig r;
    tahr_config c = parity_config();
    (void)unused;
    fake_world_flat(&w);
    rig_open(&r, &w, &c, fake_vec(0, 0, 2));
    while (r.state.mode == TAHR_MODE_FALLING) {
        assert_true(r.time < 2);
        rig_step(&r, 1.0 / 60);
        if (r.state.mode == TAHR_MODE_FALLING) {
            assert_int_equal(asked(&r), 1);
        }
    }
    /* The fall, nothing for the landing spot, the floor on entry, its height; then the rest of the time standing: 1. */
    assert_true(asked(&r) >= 3 && asked(&r) <= 4);
    rig_close(&r);
}

static void an_apex_asks_one_more(void **unused)
{
    fake_world w;
    rig r;
    tahr_config c = parity_config();
    (void)unused;
    fake_world_flat(&w);
    rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
    r.input.jump = 1;
    int apexes = 0;
    for (int i = 0; i < 40; i++) {
        rig_step(&r, 1.0 / 60);
        int apex = rig_event(&r, TAHR_EVENT_APEX) != NULL;
        assert_int_equal(asked(&r), apex ? 2 : 1);
        apexes += apex;
    }
    assert_int_equal(apexes, 1);
    rig_close(&r);
}

static void put_on_floor(parity *p, double x, double y, double z)
{
    tahr_floor floor;
    parity_put(p, x, y, z);
    p->step.state.mode = TAHR_MODE_WALKING;
    tahr__find_floor(&p->step, p->config.snap_distance, NULL, &floor);
    tahr__keep_floor(&p->step, &floor);
    p->step.queries = 0;
}

static void ledges_ask_one_or_two_on_each_side(void **unused)
{
    static const struct {
        double x, y;
        uint32_t queries;
    } rows[] = {{0, 0, 2}, {140, -140, 4}, {140, 140, 2}, {0, -200, 4}};
    parity_scene scene = {.count = 0};
    parity p;
    (void)unused;
    parity_box(&scene, fake_vec(-150, -150, -50), fake_vec(150, 150, 0));
    parity_open(&p, &scene, PARITY_FAKE, NULL, 0, 0, 90.15);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        put_on_floor(&p, rows[i].x, rows[i].y, 90.15);
        tahr__ledge_move(&p.step, p.step.state.position, parity_vec(100, 0, 0)); /* to the right is -y */
        assert_int_equal(p.step.queries, rows[i].queries);
    }
    parity_close(&p);
}

static void steps_ask_three_and_refusals_none(void **unused)
{
    parity_scene scene = {.count = 0};
    parity p;
    tahr__swept obstacle;
    int found;
    (void)unused;
    parity_plane(&scene, 0, 0, 1, 0);
    parity_box(&scene, fake_vec(35, -300, -10), fake_vec(300, 300, 20));
    for (int backend = 0; backend < PARITY_BACKENDS; backend++) {
        if (!parity_has(backend)) {
            continue;
        }
        parity_open(&p, &scene, backend, NULL, 0, 0, 90.15);
        put_on_floor(&p, 0, 0, 90.15);
        tahr__move_updated(&p.step, parity_vec(30, 0, 0), 0, &obstacle);
        assert_true(obstacle.hit.blocking);
        p.step.queries = 0;
        assert_true(tahr__step_up_by_contact(&p.step, parity_vec(25, 0, 0), &obstacle, &found));
        assert_true(found);
        assert_int_equal(p.step.queries, 3);
        obstacle.hit.blocking = 0; /* not a hit at all */
        assert_false(tahr__step_up_by_contact(&p.step, parity_vec(25, 0, 0), &obstacle, &found));
        obstacle.hit.blocking = 1;
        obstacle.hit.point = add(p.step.state.position, parity_vec(34, 0, 60)); /* over the cap */
        assert_false(tahr__step_up_by_contact(&p.step, parity_vec(25, 0, 0), &obstacle, &found));
        p.step.state.mode = TAHR_MODE_FALLING;
        assert_false(tahr__step_up_by_contact(&p.step, parity_vec(25, 0, 0), &obstacle, &found));
        assert_int_equal(p.step.queries, 3);
        parity_close(&p);
    }
}

/* The most of each function, without and with an overlap to leave on the way (a safe move asks up to 7 then). */
enum { STEP_UP = 9, STEP_UP_WORST = 21, ALONG_FLOOR = 13, ALONG_FLOOR_WORST = 7 + 7 + 21 + 14 };
enum { LANDING_SPOT = 6, LEDGE = 4, SLIDE = 2, SLIDE_WORST = 14 };

static void make_clutter(parity_scene *scene)
{
    parity_plane(scene, 0, 0, 1, 0);
    parity_plane(scene, 1, 0, 0.2, -300);
    parity_plane(scene, -0.4, -0.3, 1, -60);
    parity_box(scene, fake_vec(60, -300, -10), fake_vec(120, 300, 25));
    parity_box(scene, fake_vec(-120, 40, -10), fake_vec(0, 120, 44));
    parity_box(scene, fake_vec(-120, 110, -10), fake_vec(20, 300, 200));
    parity_box(scene, fake_vec(-60, -200, 185), fake_vec(40, -60, 260));
    parity_box(scene, fake_vec(115, -40, -10), fake_vec(140, 60, 300));
}

static uint32_t since(parity *p, uint32_t *overlapped)
{
    uint32_t queries = p->step.queries;
    *overlapped = p->step.report.contact_queries > 0; /* asked by ResolvePenetration alone */
    p->step.queries = p->step.report.contact_queries = 0;
    return queries;
}

static void no_function_asks_more_than_its_most(void **unused)
{
    parity_scene scene = {.count = 0};
    parity p;
    oracle_random dice = {5};
    uint32_t most[6] = {0, 0, 0, 0, 0, 0}, overlaps = 0, overlapped;
    (void)unused;
    make_clutter(&scene);
    parity_open(&p, &scene, PARITY_NATIVE, NULL, 0, 0, 90.15);
    for (int i = 0; i < 20000; i++) {
        double x = oracle_uniform(&dice, -150, 150), y = oracle_uniform(&dice, -150, 150);
        double z = oracle_uniform(&dice, 80, 150), way = oracle_uniform(&dice, 0.1, 60);
        vec3 d = dice_direction(&dice);
        vec3 level = scale(unit(vec(d.x, d.y, 0)), way / 100);
        put_on_floor(&p, x, y, i % 2 ? 90.15 : z);
        p.step.state.velocity = scale(level, 60);
        since(&p, &overlapped);
        tahr__move_along_floor(&p.step, level, 1.0 / 60);
        uint32_t n = since(&p, &overlapped);
        assert_true(n <= (overlapped ? ALONG_FLOOR_WORST : ALONG_FLOOR));
        most[0] = n > most[0] ? n : most[0];
        overlaps += overlapped;

        put_on_floor(&p, x, y, z);
        tahr__swept swept;
        tahr__move_updated(&p.step, level, 0, &swept);
        int found;
        since(&p, &overlapped);
        tahr__step_up_by_contact(&p.step, level, &swept, &found);
        n = since(&p, &overlapped);
        assert_true(n <= (overlapped ? STEP_UP_WORST : STEP_UP));
        most[1] = n > most[1] ? n : most[1];

        tahr__slide_along_surface(&p.step, level, 1, swept.hit.normal, &swept);
        n = since(&p, &overlapped);
        assert_true(n <= (overlapped ? SLIDE_WORST : SLIDE));
        most[4] = n > most[4] ? n : most[4];

        const tahr__perch_look look = {.radius = oracle_uniform(&dice, 0.0011, 0.34),
                                       .point = swept.hit.point,
                                       .location = swept.location,
                                       .deepest = oracle_uniform(&dice, -0.1, 0.9)};
        tahr_floor floor;
        tahr__compute_perch(&p.step, &look, &floor);
        n = since(&p, &overlapped);
        assert_true(look.deepest > 0 ? n >= 1 && n <= TAHR__FLOOR_DISTANCE_QUERIES : n == 0);
        most[5] = n > most[5] ? n : most[5];

        tahr__ledge_move(&p.step, p.step.state.position, level);
        n = since(&p, &overlapped);
        assert_true(n >= 1 && n <= LEDGE);
        most[2] = n > most[2] ? n : most[2];

        p.step.state.mode = TAHR_MODE_FALLING;
        tahr__move_updated(&p.step, scale(d, way / 100), 0, &swept);
        since(&p, &overlapped);
        tahr__is_valid_landing_spot(&p.step, &swept);
        n = since(&p, &overlapped);
        assert_true(n <= LANDING_SPOT);
        most[3] = n > most[3] ? n : most[3];
        assert_int_equal(p.step.error, TAHR_OK);
    }
    print_message("most queries: along the floor %u, step up %u, ledge %u, landing spot %u; %u overlaps\n", most[0],
                  most[1], most[2], most[3], overlaps);
    assert_true(most[0] > 6 && most[1] > 4 && most[2] == LEDGE && most[3] >= 1 && overlaps > 1000);
    assert_true(most[4] >= SLIDE && most[5] == TAHR__FLOOR_DISTANCE_QUERIES);
    parity_close(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(walking_on_flat_ground_asks_two_standing_one_cached_none),
        cmocka_unit_test(bodies_are_asked_as_often_as_closed_forms),
        cmocka_unit_test(a_walk_over_flush_tiles_asks_two_sweeps_on_every_backend),
        cmocka_unit_test(crouching_asks_at_most_one_and_standing_up_at_most_three),
        cmocka_unit_test(every_slice_of_a_long_step_asks_as_a_step),
        cmocka_unit_test(a_correction_of_the_height_asks_one_more),
        cmocka_unit_test(falling_free_asks_one_and_landing_three),
        cmocka_unit_test(an_apex_asks_one_more),
        cmocka_unit_test(ledges_ask_one_or_two_on_each_side),
        cmocka_unit_test(steps_ask_three_and_refusals_none),
        cmocka_unit_test(no_function_asks_more_than_its_most),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
