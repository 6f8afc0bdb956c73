/* SPDX-License-Identifier: MIT
 * test_wrong_step.c: settings and states that are none are refused by name, whatever is written into a state; what a
 * step returns is always one that a step takes. (Wrong answers of callbacks: test_query_answers.c, test_world_move.c,
 * test_water_line.c, test_sensor_queries.c, test_custom_mode.c; wrong requests: test_launch.c, test_stance.c,
 * test_gravity.c; wrong motions of bodies: test_world_move.c.) */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "chaos.h"
#include "stage.h"

#include <tahr/native.h>

static uint64_t factor = 1; /* the first argument: look longer */

typedef struct place {
    const char *name;
    size_t offset;
    double low, high; /* the nearest that are out of range; NAN: there is none */
} place;

#define NUMBER(field, low, high)                        \
    {                                                   \
#field, offsetof(tahr_config, field), low, high \
    }

/* h = 0.9 m of the preset; the ranges are those of config.h. */
static const place numbers[] = {NUMBER(pull_back, 0.89e-6, 0.091),
                                NUMBER(max_depenetration_character, -1e-9, 1.1e4),
                                NUMBER(mass, 0.9e-3, 1.1e6),
                                NUMBER(push_force, -1e-9, 1.1e9),
                                NUMBER(stop_speed, -1e-9, 1.1e4),
                                NUMBER(air_boost, -1e-9, 101),
                                NUMBER(air_boost_speed, -1e-9, 1.1e4),
                                NUMBER(imparted_half_life, -1e-9, 1.1e3),
                                NUMBER(crouched_half_height, 0.9e-6, 1.1e4),
                                NUMBER(crouched_speed, -1e-9, 1.1e4),
                                NUMBER(swim_speed, -1e-9, 1.1e4),
                                NUMBER(swim_immersion, 0.0099, 1.001),
                                NUMBER(buoyancy, -1e-9, 10.1),
                                NUMBER(fluid_friction, -1e-9, 1.1e4),
                                NUMBER(water_exit_speed, -1e-9, 1.1e4),
                                NUMBER(fly_speed, -1e-9, 1.1e4),
                                NUMBER(fly_drag, -1e-9, 1.1e4),
                                NUMBER(coyote_time, -1e-9, 1.1e3),
                                NUMBER(jump_buffer, -1e-9, 1.1e3),
                                NUMBER(jump_release_gravity, 0.099, 101),
                                NUMBER(fall_gravity, 0.099, 101),
                                NUMBER(wall_slide_speed, -1e-9, 1.1e4),
                                NUMBER(wall_jump_speed, -1e-9, 1.1e4),
                                NUMBER(wall_coyote_time, -1e-9, 1.1e3),
                                NUMBER(ledge_grab, -1e-9, 1.81),
                                NUMBER(corner_correction, -1e-9, 1.81),
                                NUMBER(lift_momentum, -1e-9, 1.1e3),
                                NUMBER(max_substep, 0.9e-3, 10.1),
                                NUMBER(braking_substep, 0.9e-3, 10.1)};

#define SWITCH(field, low, high)                        \
    {                                                   \
#field, offsetof(tahr_config, field), low, high \
    }
static const place switches[] = {SWITCH(integrator, 0, 3),     SWITCH(slide_solver, 0, 3),
                                 SWITCH(separation, 0, 3),     SWITCH(floor_probe, 0, 3),
                                 SWITCH(depenetration, 0, 3),  SWITCH(step_rule, 0, 3),
                                 SWITCH(flat_base, 2, 99),     SWITCH(keep_level_speed, 2, 99),
                                 SWITCH(barred_steps, 2, 99),  SWITCH(walk_off_ledges_crouched, 2, 99),
                                 SWITCH(apex_substep, 2, 99),  SWITCH(jump_hold_gravity, 2, 99),
                                 SWITCH(impart, 8, 99),        SWITCH(turn_with_base, 2, 99),
                                 SWITCH(air_jumps, 1001, 4e9), SWITCH(reserved_feel, 1, 99),
                                 SWITCH(max_substeps, 0, 65),  SWITCH(sleep, 2, 99)};

static void expect_named(const tahr_config *c, const char *name)
{
    const char *field = NULL;
    assert_int_equal(tahr_config_check(c, &field), TAHR_E_ARGUMENT);
    assert_non_null(field);
    assert_string_equal(field, name);
}

static void every_setting_out_of_range_is_named(void **unused)
{
    (void)unused;
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        const double bad[] = {numbers[i].low, numbers[i].high, NAN, INFINITY, -INFINITY};
        for (int k = 0; k < 5; k++) {
            tahr_config c = rig_config();
            memcpy((char *)&c + numbers[i].offset, &bad[k], sizeof bad[k]);
            expect_named(&c, numbers[i].name);
        }
    }
    for (size_t i = 0; i < sizeof switches / sizeof switches[0]; i++) {
        const uint32_t bad[] = {(uint32_t)switches[i].low, (uint32_t)switches[i].high};
        for (int k = 0; k < 2; k++) {
            tahr_config c = rig_config();
            memcpy((char *)&c + switches[i].offset, &bad[k], sizeof bad[k]);
            expect_named(&c, switches[i].name);
        }
    }
    const tahr_vec3 planes[] = {{0, 2, 0}, {0, NAN, 0}, {INFINITY, 0, 0}, {1e-9, 0, 0}};
    for (int k = 0; k < 4; k++) {
        tahr_config c = rig_config();
        c.plane = planes[k];
        expect_named(&c, "plane");
    }
}

#define MEMORY(name, field)                                    \
    {                                                          \
        "state." name, offsetof(tahr_state, field), -1e-9, 1e7 \
    }
static void every_memory_of_a_state_is_checked(void **unused)
{
    static const place fields[] = {MEMORY("radius", radius),
                                   MEMORY("half_height", half_height),
                                   MEMORY("coyote_left", coyote_left),
                                   MEMORY("buffer_left", buffer_left),
                                   MEMORY("lift_left", lift_left),
                                   MEMORY("wall_left", wall_left),
                                   {"state.base.pose", offsetof(tahr_state, base.pose.position.x), NAN, NAN},
                                   {"state.base.pose", offsetof(tahr_state, base.pose.position.z), NAN, NAN},
                                   {"state.base.pose", offsetof(tahr_state, base.pose.orientation.x), NAN, NAN},
                                   {"state.base.pose", offsetof(tahr_state, base.pose.orientation.w), NAN, NAN},
                                   {"state.base.velocity", offsetof(tahr_state, base.velocity.y), -1.1e6, 1.1e6},
                                   {"state.wall_normal", offsetof(tahr_state, wall_normal.x), -1.1, 1.1},
                                   {"state.wall_normal", offsetof(tahr_state, wall_normal.z), -1.1, 1.1}};
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
    const tahr_state good = r.state;
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; i++) {
        const double bad[] = {NAN, INFINITY, -INFINITY, fields[i].low, fields[i].high};
        for (int k = 0; k < 5; k++) {
            r.state = good;
            memcpy((char *)&r.state + fields[i].offset, &bad[k], sizeof bad[k]);
            const tahr_state before = r.state;
            r.log.text[0] = 0;
            assert_int_equal(tahr_mover_step(r.mover, &r.input, 0.1, &r.state, NULL), TAHR_E_ARGUMENT);
            assert_memory_equal(&before, &r.state, sizeof before);
            if (!strstr(r.log.text, fields[i].name)) {
                fail_msg("%s: \"%s\"", fields[i].name, r.log.text);
            }
        }
    }
    r.state = good;
    r.state.touched_count = TAHR_MAX_TOUCHED + 1;
    assert_int_equal(tahr_mover_step(r.mover, &r.input, 0.1, &r.state, NULL), TAHR_E_ARGUMENT);
    rig_close(&r);
}

/* One word of a state: numbers near and far, ids, and any bits at all. */
static uint64_t garbage(oracle_random *dice)
{
    double number = oracle_uniform(dice, -2, 2);
    const double odd[] = {NAN, INFINITY, -1e300, 1e-310, 0, -0.0, 1, -1, 1e5, 1e6, -1e7};
    uint64_t word;
    switch (oracle_below(dice, 5)) {
    case 0: number = odd[oracle_below(dice, 11)]; break;
    case 1: return (uint64_t)oracle_below(dice, 64) << 32 | oracle_below(dice, 512);
    case 2: return (uint64_t)oracle_below(dice, 0xFFFFFFFFu) << 32 | oracle_below(dice, 0xFFFFFFFFu);
    default: break;
    }
    memcpy(&word, &number, sizeof word);
    return word;
}

static int is_finite_state(const tahr_state *s)
{
    const tahr_vec3 p = s->position, v = s->velocity, u = s->up;
    const tahr_quat q = s->orientation;
    return isfinite(p.x + p.y + p.z + v.x + v.y + v.z + u.x + u.y + u.z) != 0 && isfinite(q.x + q.y + q.z + q.w) != 0;
}

static void whatever_is_written_into_a_state_is_refused_or_harmless(void **unused)
{
    static chaos_scene scene;
    long refused = 0, taken = 0;
    (void)unused;
    for (uint64_t seed = 1; seed <= 30 * factor; seed++) {
        oracle_random dice = {seed * 7919};
        tahr_config config;
        rig r;
        do {
            config = chaos_config(&dice);
        } while (tahr_config_check(&config, NULL) < 0);
        chaos_build(&scene, &dice, 1);
        rig_open_bodies(&r, scene.bodies, CHAOS_BODIES, &config, fake_vec(1, 1, 0));
        tahr_state good = r.state;
        for (int n = 0; n < 200; n++) {
            tahr_body_pose moves[CHAOS_MOVABLES];
            uint32_t count = chaos_drift(&scene, &dice, 0.02, moves);
            assert_int_equal(tahr_world_move(r.world, moves, count, 0.02), TAHR_OK);
            tahr_input input = chaos_input(&dice, 1, &config, &good);
            tahr_state bad = good;
            for (uint32_t k = 0; k <= oracle_below(&dice, 3); k++) {
                uint64_t word = garbage(&dice);
                memcpy((char *)&bad + 8 * oracle_below(&dice, sizeof bad / 8), &word, sizeof word);
            }
            const tahr_state before = bad;
            tahr_status status = tahr_mover_step(r.mover, &input, 0.02, &bad, NULL);
            if (status < 0) {
                assert_int_equal(status, TAHR_E_ARGUMENT);
                assert_memory_equal(&before, &bad, sizeof before);
                refused++;
            } else {
                taken++;
                tahr_status next = tahr_mover_step(r.mover, &input, 0, &bad, NULL);
                if (!is_finite_state(&bad) || next < 0) {
                    fail_msg("seed %llu, step %d: %s", (unsigned long long)seed, n, r.log.text);
                }
            }
            assert_true(tahr_mover_step(r.mover, &input, 0.02, &good, NULL) >= 0);
            if (fabs(good.position.x) + fabs(good.position.y) + fabs(good.position.z) > 50) {
                tahr_vec3 home = {0, 0, 0};
                assert_int_equal(tahr_state_teleport(&good, &home), TAHR_OK);
            }
        }
        rig_close(&r);
    }
    assert_true(refused > 500 && taken > 500);
}

/* The floor that it leaves stands upright then: a slope without an end. */
static void a_jump_while_gravity_turns_aside_stays_finite(void **unused)
{
    (void)unused;
    for (int method = 0; method < 2; method++) {
        fake_world w;
        rig r;
        tahr_config c = rig_config();
        c.slide_solver = method ? TAHR_SLIDE_TWO_WALLS : TAHR_SLIDE_JOINT;
        fake_world_flat(&w);
        rig_stand(&r, &w, &c, fake_vec(0, 0, 0.9125));
        r.input.move = fake_vec(1, 0.5, 0);
        rig_steps(&r, 10, 1.0 / 60);
        r.input.jump = 1;
        r.input.flags = TAHR_INPUT_GRAVITY;
        r.input.gravity = fake_vec(-3, 6, 0);
        rig_step(&r, 0.001);
        assert_true(is_finite_state(&r.state));
        rig_steps(&r, 10, 1.0 / 60);
        rig_close(&r);
    }
}

/* A box of 1 m is put into who flies: 0.3 m out of it in 0.1 ms would be 3 km/s. */
static void the_way_out_of_an_overlap_is_no_velocity_of_who_flies(void **unused)
{
    (void)unused;
    for (uint32_t method = 0; method < 8; method++) {
        rig r;
        tahr_body_desc bodies[2] = {stage_ground(), stage_box(fake_vec(20, 0, 5), fake_vec(0.5, 0.5, 2))};
        tahr_config c;
        assert_int_equal(tahr_config_init(&c, sizeof c, TAHR_PRESET_UNREAL), TAHR_OK);
        c.slide_solver = 1 + method % 2;
        c.separation = 1 + method / 2 % 2;
        c.depenetration = 1 + method / 4;
        rig_open_bodies(&r, bodies, 2, &c, fake_vec(0, 0, 5));
        r.input.flags = TAHR_INPUT_MODE;
        r.input.mode = TAHR_MODE_FLYING;
        r.input.move = fake_vec(0, 1, 0);
        rig_step(&r, 1.0 / 60);
        r.input.flags = 0;
        tahr_body_pose pose = {1, 0, {{-0.54, 0, 5}, {0, 0, 0, 1}}};
        assert_int_equal(tahr_world_set(r.world, &pose, 1), TAHR_OK);
        rig_step(&r, 1e-4);
        tahr_vec3 v = r.state.velocity;
        assert_true(r.state.position.x > 0.2);
        assert_true(v.x * v.x + v.y * v.y + v.z * v.z <= c.fly_speed * c.fly_speed * (1 + 1e-9));
        rig_close(&r);
    }
}

int main(int argc, char **argv)
{
    factor = argc > 1 ? strtoull(argv[1], NULL, 10) : 1;
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_setting_out_of_range_is_named),
                                       cmocka_unit_test(every_memory_of_a_state_is_checked),
                                       cmocka_unit_test(whatever_is_written_into_a_state_is_refused_or_harmless),
                                       cmocka_unit_test(a_jump_while_gravity_turns_aside_stays_finite),
                                       cmocka_unit_test(the_way_out_of_an_overlap_is_no_velocity_of_who_flies)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
