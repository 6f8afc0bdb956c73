/* SPDX-License-Identifier: MIT
 * test_flying.c: flying against closed forms, at every rate; along walls; asked to land. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "pool.h"

static void open_sky(rig *r, fake_world *w, const tahr_config *config)
{
    rig_open(r, w, config, fake_vec(0, 0, 20));
    r->state.mode = TAHR_MODE_FLYING;
}

static void a_flyer_gains_its_speed_in_any_direction_and_weighs_nothing(void **unused)
{
    const double way = 6 * 2 - 36 / (2 * 20.48);
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        fake_world_flat(&w);
        open_sky(&r, &w, NULL);
        tahr_state before = r.state;
        assert_int_equal(pool_run(&r, 1, 1 / rig_rates[i]), 0); /* no input: hangs where it is */
        assert_memory_equal(&before, &r.state, sizeof before);
        r.input.move = fake_vec(-2.0 / 3, 1.0 / 3, 2.0 / 3);
        pool_run(&r, 2, 1 / rig_rates[i]);
        assert_near(r.state.position.x, -way * 2 / 3, 1e-9);
        assert_near(r.state.position.y, way / 3, 1e-9);
        assert_near(r.state.position.z, 20 + way * 2 / 3, 1e-9);
        assert_near(r.state.velocity.z, 4, 1e-9);
        assert_int_equal(r.report.sweeps, 1);
        assert_int_equal(r.report.contact_queries + r.report.rays + r.report.fluid_queries, 0);
        rig_close(&r);
    }
}

/* v' = -F v - F s with s = 1 mm/s: v + s = (v0 + s) e^-Ft, at rest after ln((v0 + s) / s) / F. */
static void without_input_drag_brings_it_to_rest_at_an_exact_time(void **unused)
{
    const double f = 0.8, s = 1e-3, v0 = 5, t = 2, stop = log((v0 + s) / s) / f;
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        tahr_config c = rig_config();
        fake_world w;
        rig r;
        double at = -1, dt = 1 / rig_rates[i];
        c.fly_drag = f;
        fake_world_flat(&w);
        open_sky(&r, &w, &c);
        r.state.velocity = fake_vec(3, 0, 4);
        pool_run(&r, t, dt);
        assert_near(r.state.velocity.x, 0.6 * ((v0 + s) * exp(-f * t) - s), 1e-9);
        assert_near(r.state.position.x, 0.6 * ((v0 + s) * (1 - exp(-f * t)) / f - s * t), 1e-9);
        for (double now = t; now < stop + 1; now += dt) {
            rig_step(&r, dt);
            const tahr_event *e = rig_event(&r, TAHR_EVENT_STOPPED);
            assert_true(!e || at < 0);
            at = e ? now + e->time : at;
        }
        assert_near(at, stop, 1e-7);
        assert_near(r.state.position.z, 20 + 0.8 * (v0 / f - s * stop), 1e-7);
        assert_true(r.state.velocity.x == 0 && r.state.velocity.z == 0);
        rig_close(&r);
    }
}

static void a_flyer_slides_along_what_it_meets_and_stops_in_corners(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        fake_world w;
        rig r;
        fake_world_flat(&w);
        fake_add_plane(&w, fake_vec(-1, 0, 0), -3);
        fake_add_plane(&w, fake_vec(0, -0.6, -0.8), -20); /* a ceiling that leans */
        open_sky(&r, &w, NULL);
        r.input.move = fake_vec(0.6, 0, -0.8);
        pool_run(&r, 3, 1 / rig_rates[i]);
        assert_near(r.state.position.x, 3 - 0.36, 1e-6);
        assert_near(r.state.velocity.z, -4.8, 1e-6); /* what the wall leaves of the wish */
        pool_run(&r, 4, 1 / rig_rates[i]);
        assert_near(r.state.position.z, 0.91, 1e-6);
        assert_int_equal(r.state.mode, TAHR_MODE_FLYING); /* lands only when asked */
        assert_near(r.state.velocity.x, 0, 1e-6);
        r.input.move = fake_vec(0.3, 0.5, 0.8);
        pool_run(&r, 12, 1 / rig_rates[i]);
        assert_true(fake_clearance(&w, &r.config.shape, r.state.position) > 0.01 - 1e-6);
        rig_close(&r);
    }
}

static void stepped_flying_is_the_step_of_the_field(void **unused)
{
    const double h = 1.0 / 30;
    tahr_config c;
    fake_world w;
    rig r;
    (void)unused;
    assert_int_equal(tahr_config_init(&c, sizeof c, TAHR_PRESET_UNREAL), TAHR_OK);
    fake_world_flat(&w);
    open_sky(&r, &w, &c);
    r.input.move = fake_vec(0, 0, 0.5);
    rig_step(&r, h);
    assert_near(r.state.velocity.z, 0.5 * 20.48 * h, 1e-12);
    assert_near(r.state.position.z, 20 + 0.5 * 20.48 * h * h, 1e-12);
    r.input.move = fake_vec(0, 0, 0);
    r.state.velocity = fake_vec(2, 0, 0);
    rig_step(&r, h); /* two pieces of braking by 0.15 / s, then the air's 0.075 / s */
    assert_near(r.state.velocity.x, 2 * (1 - 0.15 * h / 2) * (1 - 0.15 * h / 2) * (1 - 0.075 * h), 1e-12);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_flyer_gains_its_speed_in_any_direction_and_weighs_nothing),
        cmocka_unit_test(without_input_drag_brings_it_to_rest_at_an_exact_time),
        cmocka_unit_test(a_flyer_slides_along_what_it_meets_and_stops_in_corners),
        cmocka_unit_test(stepped_flying_is_the_step_of_the_field),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
