/* SPDX-License-Identifier: MIT
 * test_corner.c: rising past the corner of a ceiling. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "player.h"

static const double G = 9.81, V = 4.2;

/* Jumps from x = 0 under a ceiling at 2.5 m, 0.7 m over the head, that begins at x = edge. Returns
 * the height it stood at. */
static double jump_under(rig *r, fake_world *w, player *p, const tahr_config *c, double rate, double edge)
{
    fake_world_flat(w);
    fake_add_box(w, fake_vec(edge, -5, 2.5), fake_vec(10, 5, 6));
    rig_stand(r, w, c, fake_vec(0, 0, 1));
    r->state.velocity = fake_vec(0, 1, 0);
    double z = r->state.position.z;
    player_begin(p, r, rate);
    player_press(p, 0.7);
    return z;
}

static tahr_config corner_config(uint32_t shape)
{
    tahr_config c = rig_config();
    c.corner_correction = 0.1;
    if (shape == TAHR_SHAPE_BOX) {
        c.shape = (tahr_shape){TAHR_SHAPE_BOX, 0, 0, 0.9, 0.35, 0.35};
    }
    return c;
}

/* The side of the shape and its skin reach 0.36 m; what of it lies under the ceiling is the way aside. */
static void head_goes_past_a_corner_by_the_least_way_aside(void **unused)
{
    const uint32_t shapes[] = {TAHR_SHAPE_CAPSULE, TAHR_SHAPE_BOX};
    const double edges[] = {0.3, 0.28, 0.265};
    (void)unused;
    for (int i = 0; i < RIG_RATES * 2 * 3; i++) {
        fake_world w;
        rig r;
        player p;
        double edge = edges[i % 3];
        tahr_config c = corner_config(shapes[i / 3 % 2]);
        double z = jump_under(&r, &w, &p, &c, rig_rates[i / 6], edge);
        assert_int_equal(p.seen[TAHR_EVENT_HIT], 0);
        assert_near(r.state.position.x, edge - 0.36, 1e-5);
        assert_near(p.last[TAHR_EVENT_APEX].position.z, z + V * V / (2 * G), 1e-7);
        assert_near(p.when[TAHR_EVENT_APEX], V / G, 1e-7);
        assert_near(r.state.velocity.y, 1, 1e-9);
        assert_true(r.state.velocity.x == 0);
        rig_close(&r);
    }
}

/* Pushed toward the corner its velocity would take it back under the head's rounding for good: it goes up beside what
 * is there. Slides of TWO_WALLS take off a part of the rise at any wall. */
static void head_that_is_pushed_toward_the_corner_goes_past_it_too(void **unused)
{
    (void)unused;
    for (int i = 0; i < 8 * RIG_RATES; i++) {
        fake_world w;
        rig r;
        player p;
        tahr_config c = corner_config(i & 1 ? TAHR_SHAPE_BOX : TAHR_SHAPE_CAPSULE);
        int exact = (i & 2) == 0, turned = i & 4;
        c.slide_solver = exact ? TAHR_SLIDE_JOINT : TAHR_SLIDE_TWO_WALLS;
        c.air_control = 1;
        c.corner_correction = 0.3; /* the round head meets the corner later and farther in */
        fake_world_flat(&w);
        fake_add_box(&w, turned ? fake_vec(-5, 0.545, 2.5) : fake_vec(0.545, -5, 2.5), fake_vec(10, 10, 6));
        rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
        double z = r.state.position.z, rate = rig_rates[i / 8];
        player_begin(&p, &r, rate);
        r.input.move = turned ? fake_vec(0, 0.2, 0) : fake_vec(0.2, 0, 0);
        player_press(&p, 0.42); /* just before its apex */
        double beside = turned ? r.state.position.y : r.state.position.x;
        /* 0.22 m of the round head, skin included, are above the ceiling's face (of TWO_WALLS, 0.19): its widest part
         * is 0.14 (0.17) m below and leaves 0.36 - sqrt(0.36^2 - 0.14^2) beside the corner. */
        double room = i & 1 ? 1e-5 : exact ? 0.0285 : 0.0427;
        assert_true(beside > 0.545 - 0.36 - 1e-5 && beside < 0.545 - 0.36 + room);
        assert_true(r.report.time_lost == 0);
        assert_true(p.top <= z + V * V / (2 * G) + 1e-6);
        if (exact) {
            assert_near(r.state.position.z, z + V * 0.42 - G / 2 * 0.42 * 0.42, 1e-6);
        } else if (rate >= 60) {
            assert_true(p.top > z + 0.8);
        }
        rig_close(&r);
    }
}

/* Whichever way it goes or wishes: a level head that is under the ceiling by no more than the correction where it meets
 * it rises on beside it and goes no farther that way; one that is under it by more is stopped. Nobody hangs there. */
static void corner_is_a_wall_for_who_runs_into_it_and_for_who_turns_away(void **unused)
{
    static const double COVER[] = {0.05, 0.15, 0.24, 0.27}, SPEED[] = {0, 1, 3, 6}, WISH[] = {-1, 0, 1};
    (void)unused;
    for (int i = 0; i < 4 * 4 * 3 * RIG_RATES; i++) {
        fake_world w;
        rig r;
        double cover = COVER[i % 4], speed = SPEED[i / 4 % 4], rate = rig_rates[i / 48], wish = WISH[i / 16 % 3];
        tahr_config c = corner_config(TAHR_SHAPE_BOX);
        c.corner_correction = 0.25;
        c.air_control = 0; /* so that it is where it is by its speed alone */
        double rise = 2.5 - 0.01 - (1.8 + 0.0125), time = (V - sqrt(V * V - 2 * G * rise)) / G;
        double edge = 0.36 - cover + speed * time;
        fake_world_flat(&w);
        fake_add_box(&w, fake_vec(edge, -5, 2.5), fake_vec(10, 5, 6));
        rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
        double z = r.state.position.z, top = z;
        assert_near(z, 0.9125, 0.0026);
        r.state.velocity = fake_vec(speed, 0, 0);
        r.state.mode = TAHR_MODE_FALLING; /* the jump as a launch, which walking has not slowed down before */
        r.state.position.z = 0.9125;
        r.state.floor_revision = 0;
        r.input.flags = TAHR_INPUT_LAUNCH;
        r.input.launch = fake_vec(0, 0, V);
        r.input.move = fake_vec(wish, 0, 0);
        for (int k = 0; k < 0.42 * rate; k++) { /* V / G is 0.428 */
            double dt = fmin(1 / rate, 0.42 - k / rate);
            rig_step(&r, dt);
            r.input.flags = 0;
            assert_true(r.report.time_lost == 0);
            top = fmax(top, r.state.position.z);
        }
        if (cover < 0.25) {
            assert_near(top, 0.9125 + V * 0.42 - G / 2 * 0.42 * 0.42, 1e-6);
            assert_near(r.state.position.x, edge - 0.36, 1e-5);
            assert_near(r.state.velocity.x, 0, 1e-9);
        } else {
            assert_true(top < 0.9125 + rise + 1e-5);
            assert_near(r.state.position.x, speed * 0.42, 1e-6);
        }
        rig_close(&r);
    }
}

static void corner_farther_in_than_the_correction_stops_the_rise(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        for (int box = 0; box <= 1; box++) {
            fake_world w;
            rig r;
            player p;
            tahr_config c = corner_config(box ? TAHR_SHAPE_BOX : TAHR_SHAPE_CAPSULE);
            double z = jump_under(&r, &w, &p, &c, rig_rates[i], 0.255);
            assert_true(p.seen[TAHR_EVENT_HIT] > 0);
            assert_true(p.top < z + 0.85);
            rig_close(&r);
        }
    }
}

/* A wall beside leaves 0.04 m where 0.06 are needed. */
static void way_aside_that_is_not_free_is_not_taken(void **unused)
{
    (void)unused;
    for (int near = 0; near <= 1; near++) {
        fake_world w;
        rig r;
        player p;
        tahr_config c = corner_config(TAHR_SHAPE_CAPSULE);
        fake_world_flat(&w);
        fake_add_box(&w, fake_vec(0.3, -5, 2.5), fake_vec(10, 5, 6));
        fake_add_plane(&w, fake_vec(1, 0, 0), near ? -0.4 : -0.43);
        rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
        player_begin(&p, &r, 60);
        player_press(&p, 0.7);
        assert_int_equal(p.seen[TAHR_EVENT_HIT] > 0, near);
        assert_true(fake_clearance(&w, &c.shape, r.state.position) > 0.01 - 1e-8);
        rig_close(&r);
    }
}

/* What is aside must be free above too: a slot that is too narrow between two ceilings. */
static void slot_that_is_too_narrow_is_not_entered(void **unused)
{
    fake_world w;
    rig r;
    player p;
    tahr_config c = corner_config(TAHR_SHAPE_CAPSULE);
    (void)unused;
    fake_world_flat(&w);
    fake_add_box(&w, fake_vec(0.3, -5, 2.5), fake_vec(10, 5, 6));
    fake_add_box(&w, fake_vec(-10, -5, 2.5), fake_vec(-0.35, 5, 6));
    rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
    player_begin(&p, &r, 60);
    player_press(&p, 0.7);
    assert_true(p.seen[TAHR_EVENT_HIT] > 0);
    rig_close(&r);
}

static void turned_off_the_corner_stops_the_rise(void **unused)
{
    fake_world w;
    rig r;
    player p;
    (void)unused;
    jump_under(&r, &w, &p, NULL, 60, 0.3);
    assert_true(p.seen[TAHR_EVENT_HIT] > 0);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(head_goes_past_a_corner_by_the_least_way_aside),
                                       cmocka_unit_test(head_that_is_pushed_toward_the_corner_goes_past_it_too),
                                       cmocka_unit_test(corner_is_a_wall_for_who_runs_into_it_and_for_who_turns_away),
                                       cmocka_unit_test(corner_farther_in_than_the_correction_stops_the_rise),
                                       cmocka_unit_test(way_aside_that_is_not_free_is_not_taken),
                                       cmocka_unit_test(slot_that_is_too_narrow_is_not_entered),
                                       cmocka_unit_test(turned_off_the_corner_stops_the_rise)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
