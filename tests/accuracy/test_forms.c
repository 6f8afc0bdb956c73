/* SPDX-License-Identifier: MIT
 * test_forms.c: each closed form of forms.h against a classical Runge-Kutta integration of its law, or against a
 * minimisation that knows only distances. A step of 1e-4 s leaves 1e-13 of a law as mild as these. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "forms.h"

enum { STEPS = 10000 };

typedef struct law {
    long double a, k; /* acceleration, drag */
} law;

static long double slope(const law *l, long double v)
{
    return l->a - l->k * v;
}

/* The way and the speed after a time of a law that holds all the time. */
static form_motion integrate(const law *l, long double v, long double time)
{
    long double h = time / STEPS, x = 0;

    for (int i = 0; i < STEPS; i++) {
        long double k1 = slope(l, v), k2 = slope(l, v + h / 2 * k1), k3 = slope(l, v + h / 2 * k2);
        long double k4 = slope(l, v + h * k3);
        x += h * (v + h / 6 * (k1 + k2 + k3));
        v += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return (form_motion){x, v};
}

static void assert_near(long double a, long double b, long double limit)
{
    if (!(fabsl(a - b) <= limit)) {
        fail_msg("%.21Lg and %.21Lg differ by more than %Lg", a, b, limit);
    }
}

static void assert_motion(form_motion a, form_motion b)
{
    assert_near(a.way, b.way, 1e-12L);
    assert_near(a.speed, b.speed, 1e-12L);
}

static void drag_is_what_integration_says(void **state)
{
    static const long double laws[][3] = {{0, 20, 8}, {5, 0, 8}, {3, -4, 0.3L}, {0, 9.81L, 1e-3L}}; /* v a k */
    (void)state;

    for (int i = 0; i < 4; i++) {
        const law l = {.a = laws[i][1], .k = laws[i][2]};
        for (int j = 1; j <= 4; j++) {
            assert_motion(form_drag(laws[i][0], l.a, l.k, j * 0.25L), integrate(&l, laws[i][0], j * 0.25L));
        }
    }
}

/* The time at which the speed is 0, by bisection of the integral. */
static void braking_ends_where_integration_says(void **state)
{
    static const long double laws[][3] = {{6, 20.48L, 16}, {5, 20, 0}, {5, 2, 0.5L}}; /* v b k */
    (void)state;

    for (int i = 0; i < 3; i++) {
        long double v = laws[i][0], b = laws[i][1], k = laws[i][2], lo = 0, hi = 4;
        const law l = {.a = -b, .k = k};
        for (int j = 0; j < 50; j++) {
            long double mid = (lo + hi) / 2;
            *(integrate(&l, v, mid).speed > 0 ? &lo : &hi) = mid;
        }
        assert_near(form_brake_time(v, b, k), lo, 1e-12L);
        assert_near(form_brake_way(v, b, k), integrate(&l, v, lo).way, 1e-12L);
        assert_motion(form_brake(v, b, k, lo / 3), integrate(&l, v, lo / 3));
        assert_true(form_brake(v, b, k, lo * 2).speed == 0);
        assert_near(form_brake(v, b, k, lo * 2).way, form_brake_way(v, b, k), 0);
    }
}

static void drag_alone_never_ends(void **state)
{
    (void)state;

    assert_true(isinf(form_brake_time(5, 0, 8)));
    assert_near(form_brake_way(5, 0, 8), 0.625L, 1e-18L);
    assert_near(form_brake(5, 0, 8, 100).way, 0.625L, 1e-15L);
}

static void throws_are_what_integration_says(void **state)
{
    const law l = {.a = -9.81L};
    (void)state;

    for (int j = 1; j <= 4; j++) {
        assert_motion(form_thrown(5, 9.81L, j * 0.25L), integrate(&l, 5, j * 0.25L));
    }
    assert_near(form_apex_height(5, 9.81L), form_thrown(5, 9.81L, form_apex_time(5, 9.81L)).way, 1e-15L);
    assert_near(form_thrown(5, 9.81L, form_apex_time(5, 9.81L)).speed, 0, 1e-15L);
    for (int h = -3; h <= 1; h++) {
        long double t = form_landing_time(5, 9.81L, h);
        form_motion end = integrate(&l, 5, t);
        assert_near(end.way, h, 1e-12L);
        assert_true(end.speed < 0);
    }
}

static void speed_caps_are_reached_at_the_right_time(void **state)
{
    const law l = {.a = 20};
    (void)state;

    assert_motion(form_capped(1, 20, 6, 0.1L), integrate(&l, 1, 0.1L));
    form_motion at = integrate(&l, 1, 0.25L);
    assert_near(at.speed, 6, 1e-12L);
    assert_near(form_capped(1, 20, 6, 1).way, at.way + 6 * 0.75L, 1e-12L);
    assert_near(form_capped(1, 20, 6, 1).speed, 6, 0);
}

/* The least height at which nothing is nearer than r, by bisection of the distance from floor, edge and tread. */
static void step_envelope_is_as_low_as_distance_lets(void **state)
{
    static const long double r = 0.35L, h = 0.2L;
    (void)state;

    for (int i = 0; i <= 100; i++) {
        long double x = -0.5L + 0.006L * i, lo = h, hi = 2;
        for (int j = 0; j < 70; j++) {
            long double y = (lo + hi) / 2, floor = x < 0 ? y : 10, step = x >= 0 ? y - h : hypotl(x, y - h);
            *(fminl(floor, step) < r ? &lo : &hi) = y;
        }
        assert_near(form_step_height(r, h, x), hi, 1e-15L);
    }
    assert_near(form_step_height(r, h, form_step_contact(r, h)), r, 1e-15L);
}

/* The foot on the edge of the highest step that is a slope touches the floor too. */
static void highest_slope_step_is_touched_at_its_angle(void **state)
{
    (void)state;

    for (int degrees = 5; degrees < 90; degrees += 5) {
        long double angle = degrees * 0.017453292519943295769237L, h = form_highest_slope_step(0.35L, angle);
        assert_near(-form_step_contact(0.35L, h), form_overhang(0.35L, angle), 1e-16L);
    }
    assert_near(form_highest_slope_step(0.3L, 0.78539816339744830962L), 0.3L * (1 - sqrtl(0.5L)), 1e-17L);
}

static form_vec minus(form_vec a, form_vec b, long double s)
{
    return (form_vec){a.x - b.x * s, a.y - b.y * s, a.z - b.z * s};
}

static long double dot(form_vec a, form_vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* Dykstra's alternating projections: the point of both half-spaces nearest to u, by nothing but projecting on one of
 * them at a time and giving back what the last round took. */
static form_vec nearest_by_turns(form_vec u, const form_vec n[2])
{
    form_vec x = u;
    long double taken[2] = {0, 0};

    for (int i = 0; i < 20000; i++) {
        form_vec back = minus(x, n[i % 2], taken[i % 2]);
        taken[i % 2] = fmaxl(-dot(back, n[i % 2]), 0);
        x = minus(back, n[i % 2], -taken[i % 2]);
    }
    return x;
}

static void slides_are_the_nearest_admissible(void **state)
{
    static const form_vec n[2] = {{0.6L, 0, 0.8L}, {-0.48L, 0.6L, 0.64L}};
    static const form_vec u = {0.5L, -1, -3}, away = {0.1L, 2, 3};
    form_vec a = form_along_crease(u, n[0], n[1]), b = nearest_by_turns(u, n);
    (void)state;

    assert_near(a.x, b.x, 1e-15L);
    assert_near(a.y, b.y, 1e-15L);
    assert_near(a.z, b.z, 1e-15L);
    a = form_along_plane(u, n[0]);
    b = nearest_by_turns(u, (form_vec[2]){n[0], n[0]});
    assert_near(a.x, b.x, 1e-15L);
    assert_near(a.z, b.z, 1e-15L);
    a = form_along_plane(away, n[0]);
    assert_true(a.x == away.x && a.y == away.y && a.z == away.z);
}

static void round_angles_are_what_integration_says(void **state)
{
    long double angle = 0.1L, u = 3, radius = 0.36L, h = 0.2L / STEPS;
    (void)state;

    for (int i = 0; i < STEPS; i++) {
        long double w = u / radius, k1 = w * sinl(angle), k2 = w * sinl(angle + h / 2 * k1);
        long double k3 = w * sinl(angle + h / 2 * k2), k4 = w * sinl(angle + h * k3);
        angle += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    assert_near(form_round_angle(0.1L, u, radius, 0.2L), angle, 1e-12L);
}

static void turntables_are_what_integration_says(void **state)
{
    form_vec p = {3, 1, 2}, start = p;
    long double w = 1.5L, h = 1.0L / STEPS;
    (void)state;

    for (int i = 0; i < STEPS; i++) {
        form_vec k[4], q = p;
        for (int j = 0; j < 4; j++) {
            k[j] = (form_vec){-w * q.y, w * q.x, 0};
            q = minus(p, k[j], -(j == 2 ? h : h / 2));
        }
        p = minus(p, k[0], -h / 6);
        p = minus(p, k[1], -h / 3);
        p = minus(p, k[2], -h / 3);
        p = minus(p, k[3], -h / 6);
    }
    form_vec q = form_turntable(start, w, 1);
    assert_near(q.x, p.x, 1e-12L);
    assert_near(q.y, p.y, 1e-12L);
    assert_near(q.z, 2, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(drag_is_what_integration_says),
        cmocka_unit_test(braking_ends_where_integration_says),
        cmocka_unit_test(drag_alone_never_ends),
        cmocka_unit_test(throws_are_what_integration_says),
        cmocka_unit_test(speed_caps_are_reached_at_the_right_time),
        cmocka_unit_test(step_envelope_is_as_low_as_distance_lets),
        cmocka_unit_test(highest_slope_step_is_touched_at_its_angle),
        cmocka_unit_test(slides_are_the_nearest_admissible),
        cmocka_unit_test(round_angles_are_what_integration_says),
        cmocka_unit_test(turntables_are_what_integration_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
