/* SPDX-License-Identifier: MIT
 * test_velocity.c: the closed forms against the laws integrated in long double with tiny steps. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "near.h"
#include "velocity.h"

typedef struct oracle {
    long double x, y, vx, vy; /* x along the wish */
} oracle;

/* The law with a wish along x, at most at the asked speed, by Runge-Kutta on q and by Simpson on p = min(p0 + A t,
 * cap). */
static oracle wish_oracle(const tahr__law *law, double p0, double q0, double t)
{
    const int steps = 200000;
    long double h = (long double)t / steps, x = 0, y = 0, p = p0, V = law->speed, q = q0, f = law->turn_friction;
    int capped = 0;
    for (int i = 0; i < steps; i++) {
        long double now = h * i, value[3];
        for (int k = 0; k < 3; k++) {
            long double s = now + h * k / 2, qs = q0 * expl(-f * s);
            long double cap = sqrtl(fmaxl(V * V - qs * qs, 0)), line = p0 + (long double)law->acceleration * s;
            /* Once on the cap it stays: the free line is steeper there. */
            value[k] = capped || line >= cap ? cap : line;
            capped = capped || (line >= cap && s > 0);
        }
        x += h * (value[0] + 4 * value[1] + value[2]) / 6;
        p = value[2];
        long double k1 = -f * q, k2 = -f * (q + h / 2 * k1), k3 = -f * (q + h / 2 * k2), k4 = -f * (q + h * k3);
        long double next = q + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        y += h * (q + next) / 2 - h * h / 12 * (-f * next + f * q); /* Hermite */
        q = next;
    }
    oracle o = {x, y, p, q};
    return o;
}

static tahr__law preset_law(double speed)
{
    tahr__law law = {
        .wish = {1, 0, 0}, .speed = speed, .acceleration = 20.48, .turn_friction = 8, .braking = 20.48, .drag = 16};
    return law;
}

static void acceleration_and_turning_follow_the_law(void **unused)
{
    const double p0[] = {0, -4, -6, 2, 5.9, 0, 0, 3}, q0[] = {0, 1, 0, 3, 1, 6, 5.9, 5.19};
    const double times[] = {0.001, 0.0166, 0.1, 0.37, 1};
    (void)unused;
    for (size_t i = 0; i < sizeof p0 / sizeof p0[0]; i++) {
        for (size_t k = 0; k < sizeof times / sizeof times[0]; k++) {
            tahr__law law = preset_law(6);
            oracle o = wish_oracle(&law, p0[i], q0[i], times[k]);
            tahr__motion m = tahr__law_advance(&law, vec(p0[i], q0[i], 0), times[k]);
            assert_near(m.displacement.x, (double)o.x, 1e-9);
            assert_near(m.displacement.y, (double)o.y, 1e-9);
            assert_near(m.velocity.x, (double)o.vx, 1e-9);
            assert_near(m.velocity.y, (double)o.vy, 1e-9);
        }
    }
}

/* v' = -F v - B by Runge-Kutta. */
static void braking_follows_the_law(void **unused)
{
    const double drags[] = {0, 1e-9, 1e-5, 0.01, 16, 300}, brakes[] = {0, 1e-3, 20.48};
    (void)unused;
    for (int d = 0; d < 6; d++) {
        for (int b = 0; b < 3; b++) {
            tahr__law law = preset_law(0);
            law.wish = vec(0, 0, 0);
            law.drag = drags[d];
            law.braking = brakes[b];
            const int steps = 100000;
            long double v = 5, x = 0, h = 0.1L / steps, F = law.drag, B = law.braking;
            for (int i = 0; i < steps && v > 0; i++) {
                long double k1 = -F * v - B, k2 = -F * (v + h / 2 * k1) - B, k3 = -F * (v + h / 2 * k2) - B,
                            k4 = -F * (v + h * k3) - B;
                long double next = v + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
                x += next > 0 ? h * (v + next) / 2 - h * h / 12 * (F * v - F * next) : v * v / (2 * (F * v + B));
                v = next > 0 ? next : 0;
            }
            tahr__motion m = tahr__law_advance(&law, vec(3, 0, 4), 0.1);
            assert_near(length(m.displacement), (double)x, 1e-9);
            assert_near(length(m.velocity), (double)v, 1e-9);
        }
    }
}

static void stop_time_is_the_logarithm(void **unused)
{
    tahr__law law = preset_law(6);
    (void)unused;
    law.wish = vec(0, 0, 0);
    double truth = (double)(log1pl(16.0L * 6 / 20.48L) / 16),
           place = (double)(6 / 16.0L - 20.48L / 16 * log1pl(16.0L * 6 / 20.48L) / 16);
    tahr__motion m = tahr__law_advance(&law, vec(6, 0, 0), 1);
    assert_near(m.stop_time, truth, 1e-14);
    assert_near(m.displacement.x, place, 1e-13);
    assert_true(m.velocity.x == 0);
    law.drag = 0;
    m = tahr__law_advance(&law, vec(6, 0, 0), 1);
    assert_near(m.stop_time, 6 / 20.48, 1e-14);
    assert_near(m.displacement.x, 36 / (2 * 20.48), 1e-14);
    m = tahr__law_advance(&law, vec(6, 0, 0), 0.1);
    assert_true(m.stop_time < 0);
}

static void over_speed_brakes_to_the_asked_speed_and_keeps_it(void **unused)
{
    tahr__law law = preset_law(3);
    (void)unused;
    tahr__motion m = tahr__law_advance(&law, vec(10, 0, 0), 2);
    assert_near(m.velocity.x, 3, 1e-12);
    double t = (double)(log1pl(16.0L * 7 / (20.48L + 48)) / 16); /* from 10 to 3 */
    long double braked = (10 - 3) / 16.0L - 20.48L / 16 * t;
    assert_near(m.displacement.x, (double)(braked + 3 * (2 - t)), 1e-12);
    assert_true(m.stop_time < 0);
}

static void halves_compose_to_the_whole(void **unused)
{
    oracle_random seed = {7};
    (void)unused;
    for (int i = 0; i < 20000; i++) {
        tahr__law law = {.wish = unit(vec(oracle_uniform(&seed, -1, 1), oracle_uniform(&seed, -1, 1), 0)),
                         .speed = oracle_uniform(&seed, 0, 8),
                         .acceleration = i % 5 ? oracle_uniform(&seed, 0, 40) : 0,
                         .turn_friction = i % 7 ? oracle_uniform(&seed, 0, 20) : 0,
                         .braking = i % 3 ? oracle_uniform(&seed, 0, 30) : 0,
                         .drag = i % 4 ? oracle_uniform(&seed, 0, 20) : 0};
        vec3 v = vec(oracle_uniform(&seed, -10, 10), oracle_uniform(&seed, -10, 10), 0);
        double t = oracle_uniform(&seed, 0, 0.6), split = t * oracle_uniform(&seed, 0, 1);
        tahr__motion whole = tahr__law_advance(&law, v, t);
        tahr__motion a = tahr__law_advance(&law, v, split);
        tahr__motion b = tahr__law_advance(&law, a.velocity, t - split);
        vec3 sum = add(a.displacement, b.displacement);
        if (length(sub(sum, whole.displacement)) > 1e-9 || length(sub(b.velocity, whole.velocity)) > 1e-9) {
            print_error("case %d: wish %g %g speed %g A %g f %g B %g F %g v %g %g t %g split %g: place off %g velocity "
                        "off %g\n",
                        i, law.wish.x, law.wish.y, law.speed, law.acceleration, law.turn_friction, law.braking,
                        law.drag, v.x, v.y, t, split, length(sub(sum, whole.displacement)),
                        length(sub(b.velocity, whole.velocity)));
            fail();
        }
    }
}

static void speed_never_exceeds_the_larger_of_start_and_wish(void **unused)
{
    oracle_random seed = {11};
    (void)unused;
    for (int i = 0; i < 20000; i++) {
        tahr__law law = preset_law(oracle_uniform(&seed, 0, 8));
        vec3 v = vec(oracle_uniform(&seed, -10, 10), oracle_uniform(&seed, -10, 10), 0);
        double t = oracle_uniform(&seed, 0, 1), most = max_of(length(v), law.speed);
        tahr__motion m = tahr__law_advance(&law, v, t);
        assert_true(length(m.velocity) <= most * (1 + 1e-12));
        assert_true(length(m.displacement) <= most * t * (1 + 1e-9) + 1e-15);
    }
}

/* |a| t^2 / 8, the largest distance of a curve from its chord at the same time, where no acceleration is more than a. */
static void a_way_lies_off_its_chord_by_an_eighth_of_its_bending(void **unused)
{
    oracle_random seed = {88};
    double most = 0;
    (void)unused;
    for (int i = 0; i < 4000; i++) {
        tahr__law law = {.wish = unit(vec(oracle_uniform(&seed, -1, 1), oracle_uniform(&seed, -1, 1), 0)),
                         .speed = oracle_uniform(&seed, 1, 8),
                         .acceleration = i % 5 ? oracle_uniform(&seed, 0, 40) : 0,
                         .turn_friction = i % 7 ? oracle_uniform(&seed, 0, 20) : 0};
        double slow = oracle_uniform(&seed, 0, 0.7) * law.speed, t = oracle_uniform(&seed, 0.01, 0.3);
        vec3 v = vec(oracle_uniform(&seed, -slow, slow), oracle_uniform(&seed, -slow, slow), 0); /* does not brake */
        vec3 whole = tahr__law_advance(&law, v, t).displacement;
        double bound = tahr__law_bending(&law, v) * t * t / 8;
        for (int k = 1; k < 16; k++) {
            vec3 at = tahr__law_advance(&law, v, t * k / 16).displacement;
            double off = length(reject(sub(at, scale(whole, k / 16.0)), unit(whole)));
            assert_true(off <= bound * (1 + 1e-9) + 1e-12);
            most = fmax(most, bound > 0 ? off / bound : 0);
        }
    }
    assert_true(most > 0.5); /* and is no empty bound */
}

/* Also where the turn is over in a hair's breadth of the step, and then by little. */
static void a_way_lies_off_its_chord_by_its_sagitta(void **unused)
{
    oracle_random seed = {21};
    int sharp = 0;
    (void)unused;
    for (int i = 0; i < 6000; i++) {
        tahr__law law = {.wish = unit(vec(oracle_uniform(&seed, -1, 1), oracle_uniform(&seed, -1, 1), 0)),
                         .speed = oracle_uniform(&seed, 1, 8),
                         .acceleration = pow(10, oracle_uniform(&seed, -1, 6)),
                         .turn_friction = pow(10, oracle_uniform(&seed, -1, 4)),
                         .braking = 10};
        double most = oracle_uniform(&seed, 0, 1.2) * law.speed, t = oracle_uniform(&seed, 0.005, 0.3);
        vec3 v = vec(oracle_uniform(&seed, -most, most), oracle_uniform(&seed, -most, most), 0);
        vec3 whole = tahr__law_advance(&law, v, t).displacement;
        double bound = tahr__law_sagitta(&law, v, t);
        sharp += bound < 1e-3 && bound < 0.1 * tahr__law_bending(&law, v) * t * t / 8;
        for (int k = 1; k < 32; k++) {
            vec3 at = tahr__law_advance(&law, v, t * pow(k / 32.0, 4)).displacement;
            assert_true(length(reject(at, unit(whole))) <= bound * (1 + 1e-9) + 1e-12 ||
                        tahr__law_bending(&law, v) == 0);
        }
    }
    assert_true(sharp > 300);
}

static void zero_time_and_zero_velocity_change_nothing(void **unused)
{
    tahr__law law = preset_law(6);
    (void)unused;
    tahr__motion m = tahr__law_advance(&law, vec(1, 2, 0), 0);
    assert_true(m.displacement.x == 0 && m.displacement.y == 0 && m.stop_time < 0);
    assert_near(m.velocity.x, 1, 1e-15);
    law.wish = vec(0, 0, 0);
    m = tahr__law_advance(&law, vec(0, 0, 0), 0.1);
    assert_true(length(m.displacement) == 0 && length(m.velocity) == 0 && m.stop_time < 0);
}

static void fall_is_the_parabola_up_to_terminal_speed(void **unused)
{
    double v, g = 9.81, to_terminal = (40 + 4.2) / 9.81;
    (void)unused;
    assert_near(tahr__fall_advance(4.2, g, 40, 0, 1, &v), 4.2 - g / 2, 1e-14);
    assert_near(v, 4.2 - g, 1e-14);
    double drop = tahr__fall_advance(4.2, g, 40, 0, to_terminal + 2, &v);
    assert_near(drop, 4.2 * to_terminal - g / 2 * to_terminal * to_terminal - 80, 1e-12);
    assert_true(v == -40);
}

static void held_jump_coasts_before_it_falls(void **unused)
{
    double v;
    (void)unused;
    assert_near(tahr__fall_advance(4, 10, 40, 0.25, 0.2, &v), 0.8, 1e-15);
    assert_true(v == 4);
    assert_near(tahr__fall_advance(4, 10, 40, 0.25, 0.65, &v), 1 + 1.6 - 0.8, 1e-14);
    assert_near(v, 0, 1e-14);
}

static void weightless_flight_is_straight(void **unused)
{
    double v;
    (void)unused;
    assert_near(tahr__fall_advance(3, 0, 40, 0, 2, &v), 6, 0);
    assert_true(v == 3);
}

static void thrown_down_faster_than_terminal_is_held_to_terminal(void **unused)
{
    double v;
    (void)unused;
    assert_near(tahr__fall_advance(-90, 9.81, 40, 0, 0.5, &v), -20, 1e-12);
    assert_true(v == -40);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(acceleration_and_turning_follow_the_law),
                                       cmocka_unit_test(braking_follows_the_law),
                                       cmocka_unit_test(stop_time_is_the_logarithm),
                                       cmocka_unit_test(over_speed_brakes_to_the_asked_speed_and_keeps_it),
                                       cmocka_unit_test(halves_compose_to_the_whole),
                                       cmocka_unit_test(speed_never_exceeds_the_larger_of_start_and_wish),
                                       cmocka_unit_test(a_way_lies_off_its_chord_by_an_eighth_of_its_bending),
                                       cmocka_unit_test(a_way_lies_off_its_chord_by_its_sagitta),
                                       cmocka_unit_test(zero_time_and_zero_velocity_change_nothing),
                                       cmocka_unit_test(fall_is_the_parabola_up_to_terminal_speed),
                                       cmocka_unit_test(held_jump_coasts_before_it_falls),
                                       cmocka_unit_test(weightless_flight_is_straight),
                                       cmocka_unit_test(thrown_down_faster_than_terminal_is_held_to_terminal)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
