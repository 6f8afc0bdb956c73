/* SPDX-License-Identifier: MIT
 * test_stepped.c: one step of the velocity, against the sums that it is made of. SI units. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "parity.h"
#include "rig.h"
#include "stepped.h"

/* The unreal preset on ground: V 6, A = B 20.48, f 8, F 16. */
static tahr__law whole_stick(tahr_vec3 wish)
{
    tahr__law law = {wish, 6, 20.48, 8, {0, 0}, 20.48, 16};
    return law;
}

static void acceleration_is_added_and_capped_at_the_asked_speed(void **unused)
{
    const tahr_config c = parity_config();
    const tahr__law law = whole_stick(vec(1, 0, 0));
    (void)unused;
    assert_near(tahr__calc_velocity(&c, &law, 0, vec(0, 0, 0), 0.05).x, 1.024, 1e-15);
    assert_near(tahr__calc_velocity(&c, &law, 0, vec(5.5, 0, 0), 0.05).x, 6, 1e-15);
    assert_near(tahr__calc_velocity(&c, &law, 0, vec(6.02, 0, 0), 0.05).x, 6, 1e-14); /* within 1 % is not over */
}

static void turning_takes_speed_to_the_wish(void **unused)
{
    const tahr_config c = parity_config();
    const tahr__law law = whole_stick(vec(1, 0, 0));
    (void)unused;
    vec3 v = tahr__calc_velocity(&c, &law, 0, vec(0, 3, 0), 0.05); /* 3 - 3 * 0.4 across, 3 * 0.4 + 1.024 along */
    assert_near(v.x, 2.224, 1e-14);
    assert_near(v.y, 1.8, 1e-14);
    v = tahr__calc_velocity(&c, &law, 0, vec(0, 3, 0), 0.5); /* f t > 1 turns at once, not farther */
    assert_near(v.x, 6, 1e-14);
    assert_near(v.y, 0, 1e-14);
}

static void above_the_asked_speed_it_brakes_down_to_it(void **unused)
{
    const tahr_config c = parity_config();
    const tahr__law law = whole_stick(vec(1, 0, 0));
    double braked = 7 - (16 * 7 + 20.48) / 60;
    (void)unused;
    assert_near(tahr__calc_velocity(&c, &law, 0, vec(7, 0, 0), 1.0 / 60).x, 6, 1e-14); /* never below, pushing on */
    assert_near(tahr__calc_velocity(&c, &law, 0, vec(-7, 0, 0), 1.0 / 60).x, 20.48 / 60 - braked, 1e-14);
    double fast = 30 - (16 * 30 + 20.48) / 60; /* still above: no faster by pushing */
    assert_near(tahr__calc_velocity(&c, &law, 0, vec(30, 0, 0), 1.0 / 60).x, fast, 1e-13);
}

static void braking_ends_at_rest(void **unused)
{
    tahr_config c = parity_config();
    tahr__law law = {.braking = 20.48, .drag = 0};
    (void)unused;
    assert_near(tahr__velocity_braking(&c, &law, vec(0, 3, 0), 0.1).y, 3 - 2.048, 1e-15);
    assert_true(tahr__velocity_braking(&c, &law, vec(0, 3, 0), 0.2).y == 0); /* would turn round */
    assert_true(tahr__velocity_braking(&c, &law, vec(0, 0.15, 0), 0.0025).y == 0);
    assert_near(tahr__velocity_braking(&c, &law, vec(0, 0.152, 0), 0.0025).y, 0.1008, 1e-15); /* stop_speed 0.1 */
    law.braking = 0;
    assert_near(tahr__velocity_braking(&c, &law, vec(0.09, 0, 0), 0.01).x, 0.09, 0); /* nothing brakes */
    law.drag = 16;
    assert_near(tahr__velocity_braking(&c, &law, vec(0.09, 0, 0), 0.01).x, 0.09 * 0.84, 1e-15); /* drag alone: to 0.1
                                                                                                 * mm/s */
    assert_true(tahr__velocity_braking(&c, &law, vec(1.1e-4, 0, 0), 0.01).x == 0);
}

static void fluids_take_their_part(void **unused)
{
    const tahr_config c = parity_config();
    const tahr__law law = whole_stick(vec(1, 0, 0));
    (void)unused;
    assert_near(tahr__calc_velocity(&c, &law, 0.5, vec(4, 0, 0), 0.1).x, 4 * 0.95 + 2.048, 1e-14);
    assert_near(tahr__calc_velocity(&c, &law, 100, vec(4, 0, 0), 0.1).x, 2.048, 1e-14);
}

static void falls_are_no_faster_than_terminal_and_keep_their_level_speed(void **unused)
{
    const tahr__pull pull = {{0, 0, -9.8}, 9.8, {0, 0, 1}};
    (void)unused;
    vec3 v = tahr__new_fall_velocity(&pull, 40, vec(3, 0, 5), 0.5);
    assert_near(v.z, 0.1, 1e-15);
    v = tahr__new_fall_velocity(&pull, 40, vec(30, 0, -39), 0.5);
    assert_near(v.z, -40, 1e-14);
    assert_near(v.x, 30, 0);
    v = tahr__new_fall_velocity(&pull, 40, vec(50, 0, -1), 0.5); /* fast, but not along gravity */
    assert_near(v.z, -5.9, 1e-14);
    const tahr__pull none = {{0, 0, 0}, 0, {0, 0, 0}};
    v = tahr__new_fall_velocity(&none, 40, vec(1, 2, -60), 0.5);
    assert_near(v.z, -60, 0);
}

static void the_constant_law_keeps_a_velocity(void **unused)
{
    const tahr__law law = tahr__constant_law();
    tahr__motion m = tahr__law_advance(&law, vec(3, -4, 0), 0.25);
    (void)unused;
    assert_near(m.velocity.x, 3, 1e-15);
    assert_near(m.displacement.y, -1, 1e-15);
    assert_true(m.stop_time < 0);
    assert_near(tahr__law_time(&law, vec(3, -4, 0), 0.25, m.displacement, 0.3), 0.075, 1e-15);
}

static void sticks_and_air_control_make_the_law(void **unused)
{
    parity p;
    parity_scene scene = {.count = 0};
    (void)unused;
    parity_open(&p, &scene, PARITY_FAKE, NULL, 0, 0, 0);
    p.input.move = vec(0, 0.5, 3); /* the part along up does not count */
    tahr__law law = tahr__walking_law(&p.step);
    assert_near(law.wish.y, 1, 0);
    assert_near(law.speed, 3, 0);
    assert_near(law.acceleration, 10.24, 1e-15);
    p.step.state.velocity = vec(0.24, 0, -9); /* slow: control 0.05 * 2 */
    assert_near(tahr__falling_law(&p.step).acceleration, 1.024, 1e-15);
    p.step.state.velocity = vec(0.26, 0, 0);
    assert_near(tahr__falling_law(&p.step).acceleration, 0.512, 1e-15);
    p.config.air_control = 0.7;
    p.step.state.velocity = vec(0, 0, 0);
    assert_near(tahr__falling_law(&p.step).acceleration, 10.24, 1e-15); /* no more than all of it */
    p.config.integrator = TAHR_INTEGRATOR_EXACT; /* half a stick asks for half the speed with the whole acceleration */
    assert_near(tahr__walking_law(&p.step).acceleration, 20.48, 1e-15);
    parity_close(&p);
}

static void level_velocities_are_level_parts_or_keep_their_size(void **unused)
{
    parity p;
    parity_scene scene = {.count = 0};
    (void)unused;
    parity_open(&p, &scene, PARITY_FAKE, NULL, 0, 0, 0);
    assert_near(tahr__level_velocity(&p.step, vec(3, 0, 4)).x, 3, 0);
    p.config.keep_level_speed = 0;
    assert_near(tahr__level_velocity(&p.step, vec(3, 0, 4)).x, 5, 1e-15);
    assert_near(length(tahr__level_velocity(&p.step, vec(0, 0, 4))), 0, 0);
    parity_close(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(acceleration_is_added_and_capped_at_the_asked_speed),
        cmocka_unit_test(turning_takes_speed_to_the_wish),
        cmocka_unit_test(above_the_asked_speed_it_brakes_down_to_it),
        cmocka_unit_test(braking_ends_at_rest),
        cmocka_unit_test(fluids_take_their_part),
        cmocka_unit_test(falls_are_no_faster_than_terminal_and_keep_their_level_speed),
        cmocka_unit_test(the_constant_law_keeps_a_velocity),
        cmocka_unit_test(sticks_and_air_control_make_the_law),
        cmocka_unit_test(level_velocities_are_level_parts_or_keep_their_size),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
