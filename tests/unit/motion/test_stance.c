/* SPDX-License-Identifier: MIT
 * test_stance.c: crouching: at once when smaller, with room when larger, and nothing moves that need
 * not. Random requests among boxes are in test_stance_wander.c. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "rig.h"

static const double STANDING = 0.9, CROUCHED = 0.55, SKIN = 0.01;

static double foot(const rig *r)
{
    return r->state.position.z - r->state.half_height;
}

static double room_around(const rig *r, const fake_world *w)
{
    tahr_shape shape = r->config.shape;
    shape.radius = r->state.radius;
    shape.half_height = r->state.half_height;
    return fake_clearance(w, &shape, r->state.position);
}

static void crouching_keeps_the_foot_and_asks_nothing(void **unused)
{
    (void)unused;
    fake_world w;
    rig r;
    fake_world_flat(&w);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
    double before = foot(&r);
    r.input.crouch = 1;
    rig_step(&r, 1.0 / 60);
    assert_near(r.state.half_height, CROUCHED, 0);
    assert_near(r.state.radius, 0.35, 0);
    assert_near(foot(&r), before, 1e-15);
    assert_true(r.state.flags & TAHR_STATE_CROUCHED);
    assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
    assert_int_equal(r.report.sweeps + r.report.contact_queries + r.report.rays, 0);
    assert_near(r.report.step_offset, 0, 0);
    const tahr_event *e = rig_event(&r, TAHR_EVENT_SHAPE);
    assert_non_null(e);
    assert_near(e->value, CROUCHED, 0);
    assert_int_equal(r.report.event_count, 1);
    tahr_state at_rest = r.state;
    for (int i = 0; i < 20; i++) {
        rig_step(&r, 1.0 / 60);
        assert_memory_equal(&at_rest, &r.state, sizeof at_rest);
        assert_int_equal(r.report.event_count, 0);
        assert_int_equal(r.report.sweeps + r.report.contact_queries + r.report.rays, 0);
    }
    rig_close(&r);
}

static void standing_up_asks_once_and_keeps_the_foot(void **unused)
{
    (void)unused;
    fake_world w;
    rig r;
    fake_world_flat(&w);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
    double before = foot(&r);
    for (int i = 0; i < 10000; i++) {
        r.input.crouch = !r.input.crouch;
        rig_step(&r, 1.0 / 60);
        assert_int_equal(r.report.sweeps + r.report.rays, 0);
        assert_int_equal(r.report.contact_queries, r.input.crouch ? 0 : 1);
        assert_int_equal(r.report.event_count, 1);
    }
    assert_near(foot(&r), before, 1e-12); /* 10000 roundings of less than 1.2e-16 each */
    assert_near(r.state.half_height, STANDING, 0);
    assert_false(r.state.flags & TAHR_STATE_CROUCHED);
    rig_close(&r);
}

static void a_crouched_character_sleeps_and_so_does_one_that_may_not_stand_up(void **unused)
{
    (void)unused;
    fake_world w;
    rig r;
    fake_world_flat(&w);
    fake_add_box(&w, fake_vec(-3, -3, 1.3), fake_vec(3, 3, 2));
    rig_open(&r, &w, NULL, fake_vec(0, 0, 0.6));
    r.state.half_height = CROUCHED;
    for (int released = 0; released < 2; released++) {
        r.input.crouch = !released;
        rig_steps(&r, 30, 1.0 / 60);
        tahr_report report;
        memset(&report, 0, sizeof report);
        report.struct_size = sizeof report;
        tahr_state before = r.state;
        for (int i = 0; i < 3; i++) { /* a trace is never slept through, so without one */
            assert_int_equal(tahr_mover_step(r.mover, &r.input, 1.0 / 60, &r.state, &report), TAHR_OK);
        }
        assert_true(report.flags & TAHR_REPORT_ASLEEP);
        assert_int_equal((report.flags & TAHR_REPORT_SHAPE_REFUSED) != 0, released);
        assert_memory_equal(&before, &r.state, sizeof before);
        assert_true(r.state.flags & TAHR_STATE_CROUCHED);
    }
    rig_close(&r);
}

static void crouched_speed_is_walked_at_every_rate(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        fake_world_flat(&w);
        rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
        r.input.crouch = 1;
        r.input.move = fake_vec(1, 0, 0);
        rig_steps(&r, (int)rig_rates[i], 1 / rig_rates[i]);
        assert_near(r.state.position.x, 3 - 9 / (2 * 20.48), 1e-9);
        assert_near(r.state.velocity.x, 3, 1e-12);
        rig_close(&r);
    }
}

/* A crawl space 1.3 m high from x = 1 to x = 4, crossed crouched, with the button released inside. */
static void stands_up_right_after_the_crawl_space_and_not_before(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        double dt = 1 / rig_rates[i], before_x = 0;
        fake_world_flat(&w);
        fake_add_box(&w, fake_vec(1, -3, 1.3), fake_vec(4, 3, 3));
        rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
        r.input.crouch = 1;
        r.input.move = fake_vec(1, 0, 0);
        while (r.state.position.x < 2.5) {
            rig_step(&r, dt);
        }
        double low = foot(&r);
        r.input.crouch = 0;
        r.input.move = fake_vec(0, 0, 0);
        rig_steps(&r, (int)rig_rates[i], dt); /* brakes */
        double x = r.state.position.x;
        for (int k = 0; k < 50; k++) {
            rig_step(&r, dt);
            assert_true(r.report.flags & TAHR_REPORT_SHAPE_REFUSED);
            assert_int_equal(r.status, TAHR_OK);
            assert_null(rig_event(&r, TAHR_EVENT_SHAPE));
            assert_int_equal(rig_decision(&r, TAHR_RULE_SHAPE)->accepted, 0);
            assert_true(r.state.position.x == x && foot(&r) == low);
        }
        r.input.move = fake_vec(1, 0, 0);
        while (r.state.half_height < STANDING && r.state.position.x < 6) {
            before_x = r.state.position.x;
            rig_step(&r, dt);
            assert_true(room_around(&r, &w) > 0.999 * SKIN - 1e-9);
        }
        assert_near(r.state.half_height, STANDING, 0);
        /* Looked for at the begin of a step: free there, and not yet a step before. The cap of the standing shape is a
         * ball of 0.35 m around z = 1.4625, over the ceiling's edge at 1.3: the whole of its width in the way. */
        double exit = 4 + 0.35 + 0.999 * SKIN;
        assert_true(before_x >= exit - 1e-9);
        assert_true(before_x <= exit + 3 * dt + 1e-9);
        rig_close(&r);
    }
}

static void crouching_in_the_air_draws_the_foot_up(void **unused)
{
    (void)unused;
    /* A jump rises 4.2^2 / (2 9.81) = 0.899 m. A wall of 1.15 m is too high for it by 0.25 m, and is cleared with the
     * foot drawn up by 0.9 - 0.55 = 0.35 m. */
    for (int crouches = 0; crouches < 2; crouches++) {
        for (int i = 1; i < RIG_RATES; i++) {
            fake_world w;
            rig r;
            fake_world_flat(&w);
            fake_add_box(&w, fake_vec(1.2, -3, 0), fake_vec(6, 3, 1.15));
            rig_stand(&r, &w, NULL, fake_vec(-1.5, 0, 1));
            r.state.velocity = fake_vec(6, 0, 0); /* at the wall 0.39 s after the jump, 0.04 s before its apex */
            r.input.jump = 1;
            r.input.move = fake_vec(1, 0, 0);
            rig_step(&r, 1 / rig_rates[i]);
            double before = r.state.position.z;
            r.input.crouch = (uint32_t)crouches;
            rig_step(&r, 1 / rig_rates[i]);
            double t = 1 / rig_rates[i], rise = 4.2 * t - 0.5 * 9.81 * (4 - 1) * t * t;
            assert_near(r.state.position.z, before + rise, 1e-9); /* the centre goes on along its arc */
            rig_steps(&r, (int)rig_rates[i], 1 / rig_rates[i]);
            assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
            assert_int_equal(foot(&r) > 1, crouches);
            rig_close(&r);
        }
    }
}

static void growing_in_the_air_gives_way_to_floor_and_ceiling(void **unused)
{
    const double gap = 0.1; /* between the crouched shape and what is near */
    (void)unused;
    for (int ceiling = 0; ceiling < 2; ceiling++) {
        fake_world w;
        rig r;
        tahr_config c = rig_config();
        c.gravity = fake_vec(0, 0, 0);
        fake_world_flat(&w);
        fake_add_plane(&w, fake_vec(0, 0, -1), -6);
        double z = ceiling ? 6 - gap - CROUCHED : gap + CROUCHED;
        rig_open(&r, &w, &c, fake_vec(0, 0, z));
        r.state.half_height = CROUCHED;
        rig_step(&r, 1.0 / 60);
        assert_near(r.state.half_height, STANDING, 0);
        assert_near(r.state.position.z, ceiling ? 6 - SKIN - STANDING : SKIN + STANDING, 1e-9);
        assert_int_equal(r.report.contact_queries, 2);
        rig_close(&r);
    }
}

static void growing_in_the_air_is_refused_between_floor_and_ceiling(void **unused)
{
    (void)unused;
    for (int fits = 0; fits < 2; fits++) {
        fake_world w;
        rig r;
        tahr_config c = rig_config();
        double height = 2 * (STANDING + SKIN) + (fits ? 0.001 : -0.001);
        c.gravity = fake_vec(0, 0, 0);
        fake_world_flat(&w);
        fake_add_plane(&w, fake_vec(0, 0, -1), -height);
        rig_open(&r, &w, &c, fake_vec(0, 0, 0.6));
        r.state.half_height = CROUCHED;
        tahr_vec3 before = r.state.position;
        rig_step(&r, 1.0 / 60);
        assert_int_equal((r.report.flags & TAHR_REPORT_SHAPE_REFUSED) == 0, fits);
        assert_near(r.state.half_height, fits ? STANDING : CROUCHED, 0);
        assert_near(r.state.position.z, fits ? SKIN + STANDING : before.z, 1e-9);
        rig_close(&r);
    }
}

static void crouched_characters_stop_at_ledges_if_told_so(void **unused)
{
    (void)unused;
    for (int crouch = 0; crouch < 2; crouch++) {
        fake_world w;
        rig r;
        tahr_config c = rig_config();
        c.walk_off_ledges_crouched = 0;
        fake_world_init(&w);
        fake_add_box(&w, fake_vec(-3, -3, -1), fake_vec(2, 3, 0));
        rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
        r.input.crouch = (uint32_t)crouch;
        r.input.move = fake_vec(1, 0, 0);
        rig_steps(&r, 120, 1.0 / 60);
        assert_int_equal(r.state.mode, crouch ? TAHR_MODE_WALKING : TAHR_MODE_FALLING);
        assert_int_equal(r.state.position.x < 2.35, crouch);
        rig_close(&r);
    }
}

static void crouching_never_makes_it_taller_and_never_less_than_round(void **unused)
{
    (void)unused;
    const double asked[] = {0.1, 0.35, 0.6, 0.9, 5};
    const double got[] = {0.35, 0.35, 0.6, 0.9, 0.9};
    for (int i = 0; i < 5; i++) {
        fake_world w;
        rig r;
        tahr_config c = rig_config();
        c.crouched_half_height = asked[i];
        fake_world_flat(&w);
        rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
        r.input.crouch = 1;
        rig_step(&r, 1.0 / 60);
        assert_near(r.state.half_height, got[i], 0);
        assert_int_equal((r.state.flags & TAHR_STATE_CROUCHED) != 0, got[i] < STANDING);
        rig_close(&r);
    }
}

/* Pulled back from contacts instead of keeping a skin: the clearance under the foot may be used up to stand up. */
static void standing_up_uses_the_gap_under_the_foot_where_no_skin_is_kept(void **unused)
{
    (void)unused;
    for (int pulled_back = 0; pulled_back < 2; pulled_back++) {
        fake_world w;
        rig r;
        tahr_config c = rig_config();
        c.separation = pulled_back ? TAHR_SEPARATION_PULL_BACK : TAHR_SEPARATION_MARGIN;
        fake_world_flat(&w);
        rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
        r.input.crouch = 1;
        rig_steps(&r, 2, 1.0 / 60);
        fake_add_plane(&w, fake_vec(0, 0, -1), -(2 * STANDING + 0.008)); /* a gap of 10 to 15 mm does not fit */
        r.input.crouch = 0;
        rig_step(&r, 1.0 / 60);
        assert_int_equal((r.report.flags & TAHR_REPORT_SHAPE_REFUSED) == 0, pulled_back);
        assert_near(r.state.half_height, pulled_back ? STANDING : CROUCHED, 0);
        assert_true(room_around(&r, &w) > 1e-5 - 1e-9);
        rig_close(&r);
    }
}

static void spheres_and_frozen_characters_do_not_crouch(void **unused)
{
    (void)unused;
    fake_world w;
    rig r;
    tahr_config c = rig_config();
    c.shape = (tahr_shape){.type = TAHR_SHAPE_SPHERE, .radius = 0.35, .half_height = 0.35};
    c.step_height = 0.3;
    fake_world_flat(&w);
    rig_stand(&r, &w, &c, fake_vec(0, 0, 1));
    r.input.crouch = 1;
    rig_step(&r, 1.0 / 60);
    assert_near(r.state.half_height, 0.35, 0);
    assert_false(r.state.flags & TAHR_STATE_CROUCHED);
    rig_close(&r);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
    r.state.mode = TAHR_MODE_NONE;
    r.input.crouch = 1;
    tahr_state before = r.state;
    rig_step(&r, 1.0 / 60);
    assert_memory_equal(&before, &r.state, sizeof before);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(crouching_keeps_the_foot_and_asks_nothing),
        cmocka_unit_test(standing_up_asks_once_and_keeps_the_foot),
        cmocka_unit_test(a_crouched_character_sleeps_and_so_does_one_that_may_not_stand_up),
        cmocka_unit_test(crouched_speed_is_walked_at_every_rate),
        cmocka_unit_test(stands_up_right_after_the_crawl_space_and_not_before),
        cmocka_unit_test(crouching_in_the_air_draws_the_foot_up),
        cmocka_unit_test(growing_in_the_air_gives_way_to_floor_and_ceiling),
        cmocka_unit_test(growing_in_the_air_is_refused_between_floor_and_ceiling),
        cmocka_unit_test(crouched_characters_stop_at_ledges_if_told_so),
        cmocka_unit_test(crouching_never_makes_it_taller_and_never_less_than_round),
        cmocka_unit_test(standing_up_uses_the_gap_under_the_foot_where_no_skin_is_kept),
        cmocka_unit_test(spheres_and_frozen_characters_do_not_crouch)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
