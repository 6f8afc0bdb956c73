/* SPDX-License-Identifier: MIT
 * test_base_callbacks.c: bases behind a user's own functions. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "rig.h"

static const tahr_quat LEVEL = {0, 0, 0, 1};

/* A user's engine: the box of a fake world is where `motion` says. */
typedef struct engine {
    fake_world world; /* first: what the sweeps get */
    tahr_body_motion motion;
    tahr_status status;
    int asked;
} engine;

static tahr_status tell(void *user, uint32_t body, tahr_body_motion *motion)
{
    engine *e = user;
    assert_near(motion->pose.orientation.w, 1, 0); /* at rest at the origin */
    assert_int_equal(body, 0);
    e->asked++;
    *motion = e->motion;
    return e->status;
}

static void put_platform(engine *e, tahr_vec3 at)
{
    e->motion.pose.position = at;
    e->world.solids[0].min = fake_vec(at.x - 3, at.y - 3, at.z - 1);
    e->world.solids[0].max = fake_vec(at.x + 3, at.y + 3, at.z);
}

static void open_engine_falling(engine *e, rig *r, const tahr_config *config)
{
    memset(e, 0, sizeof *e);
    fake_world_init(&e->world);
    fake_add_box(&e->world, fake_vec(-3, -3, -1), fake_vec(3, 3, 0));
    e->motion.pose.orientation = LEVEL;
    tahr_callbacks callbacks = fake_callbacks(&e->world);
    callbacks.user = e;
    callbacks.body = tell;
    rig_open_callbacks(r, &callbacks, config, fake_vec(1, 0, 1));
}

static void open_engine(engine *e, rig *r)
{
    open_engine_falling(e, r, NULL);
    rig_settle(r);
}

static void landing_on_a_base_behind_callbacks_takes_its_velocity_off(void **unused)
{
    engine e;
    rig r;
    tahr_config c = rig_config();
    (void)unused;
    c.braking_deceleration = c.braking_drag = 0;
    open_engine_falling(&e, &r, &c);
    e.motion.velocity = fake_vec(2, 0, 5);
    e.motion.surface_velocity = fake_vec(0, 0.5, 0);
    r.state.velocity = fake_vec(0, 0, -1);
    for (int n = 0; r.state.mode != TAHR_MODE_WALKING; n++) {
        rig_step(&r, 1.0 / 60);
        assert_true(n < 60);
    }
    const tahr_event *landed = rig_event(&r, TAHR_EVENT_LANDED);
    assert_non_null(landed);
    assert_near(landed->value, 5 + sqrt(1 + 2 * 9.81 * 0.09), 1e-5); /* relative to what it lands on, 9 cm below */
    assert_near(r.state.velocity.x, -2, 1e-12);
    assert_near(r.state.velocity.y, -0.5, 1e-12);
    assert_near(r.state.velocity.z, 0, 0);
    assert_int_equal(r.state.base.body, 0);
    rig_close(&r);
}

static void a_base_behind_callbacks_carries_and_hands_over_its_velocity(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        engine e;
        rig r;
        double dt = 1 / rig_rates[i], t = 0;
        open_engine(&e, &r);
        double height = r.state.position.z;
        e.motion.velocity = fake_vec(2, 0, -15);
        for (int n = 1; t < 0.5; n++) {
            t = n * dt;
            put_platform(&e, fake_vec(2 * t, 0, -15 * t));
            e.asked = 0;
            rig_step(&r, dt);
            assert_true(e.asked > 0);
            assert_near(r.state.position.x, 1 + 2 * t, 1e-9);
            assert_near(r.state.position.z, height - 15 * t, 1e-9);
        }
        r.input.jump = 1;
        put_platform(&e, fake_vec(2 * (t + dt), 0, -15 * (t + dt)));
        rig_step(&r, dt);
        assert_near(r.state.velocity.x, 2, 1e-9);
        assert_near(r.state.velocity.z, 4.2 - 15 - 9.81 * dt, 1e-9);
        rig_close(&r);
    }
}

static void an_idle_character_notices_that_its_base_begins_to_move(void **unused)
{
    engine e;
    rig r;
    (void)unused;
    open_engine(&e, &r);
    rig_steps(&r, 10, 1.0 / 60);
    put_platform(&e, fake_vec(0.1, 0, 0));
    rig_step(&r, 1.0 / 60);
    assert_near(r.state.position.x, 1.1, 1e-9);
    e.motion.teleported = 1;
    put_platform(&e, fake_vec(0.5, 0, 0));
    rig_step(&r, 1.0 / 60);
    assert_near(r.state.position.x, 1.1, 1e-9);
    rig_close(&r);
}

static void who_stood_on_a_base_that_is_gone_falls_with_its_velocity(void **unused)
{
    engine e;
    rig r;
    (void)unused;
    open_engine(&e, &r);
    e.motion.velocity = fake_vec(0, 3, 0);
    put_platform(&e, fake_vec(0, 0.05, 0));
    rig_step(&r, 1.0 / 60);
    e.status = TAHR_E_NOT_FOUND;
    e.world.count = 0;
    assert_int_equal(rig_step(&r, 1.0 / 60), TAHR_OK);
    assert_int_equal(r.state.mode, TAHR_MODE_FALLING);
    assert_int_equal(r.state.base.body, TAHR_NO_BODY);
    assert_near(r.state.velocity.y, 3, 1e-12);
    const tahr_event *event = rig_event(&r, TAHR_EVENT_BASE);
    assert_non_null(event);
    assert_int_equal(event->body, TAHR_NO_BODY);
    rig_close(&r);
}

static void bad_answers_about_a_base_are_errors_and_leave_the_state_alone(void **unused)
{
    static const char *const fields[] = {
        "pose.position", "pose.orientation", "velocity", "angular_velocity", "surface_velocity", "mass", "status"};
    (void)unused;
    for (int k = 0; k < 7; k++) {
        engine e;
        rig r;
        tahr_body_motion m;
        open_engine(&e, &r);
        const tahr_state before = r.state;
        double *const bad[] = {&e.motion.pose.position.y,    &e.motion.pose.orientation.x, &e.motion.velocity.z,
                               &e.motion.angular_velocity.x, &e.motion.surface_velocity.y, &e.motion.mass};
        if (k < 6) {
            *bad[k] = NAN;
        } else {
            e.status = TAHR_E_GEOMETRY;
        }
        r.log.text[0] = 0;
        assert_int_equal(tahr_mover_step(r.mover, &r.input, 1.0 / 60, &r.state, NULL), TAHR_E_BACKEND);
        assert_non_null(strstr(r.log.text, fields[k]));
        assert_memory_equal(&before, &r.state, sizeof before);
        assert_int_equal(tahr_world_body(r.world, 0, &m), TAHR_E_BACKEND);
        rig_close(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(landing_on_a_base_behind_callbacks_takes_its_velocity_off),
                                       cmocka_unit_test(a_base_behind_callbacks_carries_and_hands_over_its_velocity),
                                       cmocka_unit_test(an_idle_character_notices_that_its_base_begins_to_move),
                                       cmocka_unit_test(who_stood_on_a_base_that_is_gone_falls_with_its_velocity),
                                       cmocka_unit_test(bad_answers_about_a_base_are_errors_and_leave_the_state_alone)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
