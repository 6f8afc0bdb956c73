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

/* Toward the ceiling it would be back at once: its head is hit as ever, and no time is lost in going to and fro. */
static void who_goes_under_the_ceiling_is_not_held_at_its_corner(void **unused)
{
    (void)unused;
    for (int i = 0; i < 2 * RIG_RATES; i++) {
        fake_world w;
        rig r;
        tahr_config c = corner_config(i % 2 ? TAHR_SHAPE_BOX : TAHR_SHAPE_CAPSULE);
        double rate = rig_rates[i / 2];
        c.air_control = 1;
        fake_world_flat(&w);
        fake_add_box(&w, fake_vec(0.3, -5, 2.5), fake_vec(10, 5, 6));
        rig_stand(&r, &w, &c, fake_vec(-0.45, 0, 1));
        r.input.jump = 1;
        r.input.move = fake_vec(1, 0, 0);
        int hits = 0;
        for (int k = 0; k < 0.9 * rate; k++) { /* a jump lasts 0.86 s at most */
            rig_step(&r, 1 / rate);
            assert_near(r.report.time_lost, 0, 0);
            hits += rig_event(&r, TAHR_EVENT_HIT) != NULL;
        }
        assert_true(hits > 0);
        assert_true(r.state.position.x > 0.3 + 0.36); /* wholly under it */
        rig_close(&r);
    }
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
                                       cmocka_unit_test(corner_farther_in_than_the_correction_stops_the_rise),
                                       cmocka_unit_test(way_aside_that_is_not_free_is_not_taken),
                                       cmocka_unit_test(slot_that_is_too_narrow_is_not_entered),
                                       cmocka_unit_test(who_goes_under_the_ceiling_is_not_held_at_its_corner),
                                       cmocka_unit_test(turned_off_the_corner_stops_the_rise)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
