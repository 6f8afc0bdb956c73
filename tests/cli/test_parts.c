/* SPDX-License-Identifier: MIT
 * test_parts.c: the parts of the shell that the word of a run rests on: the independent checker against brute force,
 * the random numbers and headings of wandering against published and libm values, and the histogram of step times.
 * Build: with bindings/cli as an include directory and its check.c, level.c, progress.c, say.c, stats.c, wander.c. */
#include "check.h"
#include "progress.h"
#include "say.h"
#include "stats.h"
#include "vec.h"
#include "wander.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

static struct pcg random_numbers;

static double uniform(double low, double high)
{
    return low + (high - low) * pcg_unit(&random_numbers);
}

static tahr_vec3 random_point(double reach)
{
    return (tahr_vec3){uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach)};
}

static tahr_vec3 between(tahr_vec3 a, tahr_vec3 b, double t)
{
    return vec_add(a, vec_scale(vec_sub(b, a), t));
}

/* The minimum of a convex function on [0, 1] by ternary search. */
struct line {
    tahr_vec3 from, to;
    const tahr_vec3 *triangle;
};

static double minimum(double (*distance)(const struct line *line, double t), const struct line *line)
{
    double low = 0, high = 1;
    for (int i = 0; i < 60; i++) {
        double a = low + (high - low) / 3, b = high - (high - low) / 3;
        if (distance(line, a) < distance(line, b)) {
            high = b;
        } else {
            low = a;
        }
    }
    return least(least(distance(line, (low + high) / 2), distance(line, 0)), distance(line, 1));
}

/* Distance of line->from to the segment of the triangle that lies parallel to its last side, t of the way to it. */
static double to_stripe(const struct line *line, double t)
{
    tahr_vec3 a = between(line->triangle[0], line->triangle[1], t),
              b = between(line->triangle[0], line->triangle[2], t);
    tahr_vec3 along = vec_sub(b, a), rest = vec_sub(line->from, a);
    double squared = vec_dot(along, along), s = squared > 0 ? clamp(vec_dot(rest, along) / squared, 0, 1) : 0;
    return vec_length(vec_sub(rest, vec_scale(along, s)));
}

static double point_to_triangle(const struct line *line, double t)
{
    struct line point = {.from = between(line->from, line->to, t), .triangle = line->triangle};
    return minimum(to_stripe, &point);
}

static double brute_distance(tahr_vec3 p, tahr_vec3 q, const tahr_vec3 *triangle)
{
    struct line line = {.from = p, .to = q, .triangle = triangle};
    return minimum(point_to_triangle, &line);
}

static void add_triangle(struct level *level, tahr_vec3 a, tahr_vec3 b, tahr_vec3 c)
{
    double *vertices = memory_new(9, sizeof *vertices);
    uint32_t *indices = memory_new(3, sizeof *indices);
    const double values[9] = {a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z};
    for (uint32_t i = 0; i < 9; i++) {
        vertices[i] = values[i];
        indices[i % 3] = i % 3;
    }
    level_add_mesh(level, vertices, 3, indices, 1);
}

static void clearance_equals_brute_force_over_all_triangles(void **unused)
{
    const tahr_shape shape = {.type = TAHR_SHAPE_CAPSULE, .radius = 0.35, .half_height = 0.9};
    struct level level = {0};
    int close = 0;
    (void)unused;
    pcg_start(&random_numbers, 7, 1);
    for (int i = 0; i < 60; i++) {
        tahr_vec3 a = random_point(3), size = random_point(1);
        double factor = i % 5 == 0 ? 6 : 1; /* some larger than many cells */
        add_triangle(&level, a, vec_add(a, vec_scale(random_point(1), factor)), vec_add(a, vec_scale(size, factor)));
    }
    struct checker *checker = checker_open(&level);
    for (int i = 0; i < 100; i++) {
        tahr_vec3 position = random_point(3.5), up = {0, 0, 1}, axis = {0, 0, 0.55};
        double expected = CHECK_REACH;
        for (size_t t = 0; t < level.triangle_count; t++) {
            double d = brute_distance(vec_sub(position, axis), vec_add(position, axis), &level.corners[3 * t]);
            expected = least(expected, d - shape.radius);
        }
        close += expected < CHECK_REACH;
        assert_true(fabs(checker_clearance(checker, &shape, position, up) - expected) < 1e-7);
    }
    assert_true(close > 20 && close < 100);
    checker_close(checker);
    level_close(&level);
}

/* A closed box: whatever segment leaves it crosses it, also through its edges and corners. */
static void every_segment_out_of_a_closed_box_is_a_crossing(void **unused)
{
    struct level level = {0};
    (void)unused;
    level_add_box(&level, (tahr_vec3){0.3, -0.2, 5}, (tahr_vec3){2, 1, 3}, (tahr_quat){0, 0, 0, 1});
    struct checker *checker = checker_open(&level);
    pcg_start(&random_numbers, 8, 1);
    for (int i = 0; i < 20000; i++) {
        tahr_vec3 inside = {0.3 + uniform(-1.9, 1.9), -0.2 + uniform(-0.9, 0.9), 5 + uniform(-2.9, 2.9)};
        tahr_vec3 also = {0.3 + uniform(-1.9, 1.9), -0.2 + uniform(-0.9, 0.9), 5 + uniform(-2.9, 2.9)};
        tahr_vec3 out = {i & 1 ? 3.5 : -3, i & 2 ? 1.5 : -2, i & 4 ? 9 : 1};
        /* Through the diagonal of a face, an edge or a corner, from the middle. */
        tahr_vec3 middle = {0.3, -0.2, 5}, exact = {0.3 + (i % 3) * 4.0, -0.2 + (i % 2) * 2.0, 5 + (i % 5) * 6.0};
        assert_true(checker_crosses(checker, inside, out));
        assert_true(checker_crosses(checker, out, inside));
        assert_false(checker_crosses(checker, inside, also));
        assert_true(vec_length(vec_sub(exact, middle)) == 0 || checker_crosses(checker, middle, exact));
    }
    checker_close(checker);
    level_close(&level);
}

static void a_crossing_of_a_terrain_is_seen_whatever_the_edge_it_goes_through(void **unused)
{
    struct level level = {0};
    (void)unused;
    pcg_start(&random_numbers, 9, 1);
    double height[13][13];
    for (int i = 0; i < 169; i++) {
        height[i / 13][i % 13] = uniform(-0.3, 0.3);
    }
    for (int i = 0; i < 12; i++) {
        for (int j = 0; j < 12; j++) {
            tahr_vec3 a = {i, j, height[i][j]}, b = {i + 1, j, height[i + 1][j]};
            tahr_vec3 c = {i + 1, j + 1, height[i + 1][j + 1]}, d = {i, j + 1, height[i][j + 1]};
            add_triangle(&level, a, b, c);
            add_triangle(&level, a, c, d);
        }
    }
    struct checker *checker = checker_open(&level);
    for (int i = 0; i < 20000; i++) {
        int x = 1 + (int)uniform(0, 10.99), y = 1 + (int)uniform(0, 10.99);
        double t = i % 3 == 0 ? 0 : uniform(0, 1); /* a vertex, or somewhere on the edge to the next */
        tahr_vec3 on = between((tahr_vec3){x, y, height[x][y]}, (tahr_vec3){x + 1, y, height[x + 1][y]}, t);
        tahr_vec3 way = {uniform(-0.2, 0.2), uniform(-0.2, 0.2), 1};
        assert_true(checker_crosses(checker, vec_add(on, way), vec_sub(on, way)));
        assert_false(checker_crosses(checker, vec_add(on, way), vec_add(on, vec_scale(way, 1.2))));
    }
    checker_close(checker);
    level_close(&level);
}

static void round_bodies_count_from_their_surface(void **unused)
{
    const tahr_shape shape = {.type = TAHR_SHAPE_CAPSULE, .radius = 0.35, .half_height = 0.9};
    const tahr_vec3 up = {0, 0, 1};
    struct level level = {0};
    (void)unused;
    level_add_sphere(&level, (tahr_vec3){0, 0, 0}, 1);
    level_add_capsule(&level, (tahr_vec3){10, 0, 0}, 0.5, 2);
    struct checker *checker = checker_open(&level);
    assert_true(fabs(checker_clearance(checker, &shape, (tahr_vec3){1.36, 0, 0}, up) - 0.01) < 1e-12);
    assert_true(fabs(checker_clearance(checker, &shape, (tahr_vec3){0, 0, 1.87}, up) + 0.03) < 1e-12);
    assert_true(fabs(checker_clearance(checker, &shape, (tahr_vec3){10, -0.84, 1}, up) + 0.01) < 1e-12);
    assert_true(checker_clearance(checker, &shape, (tahr_vec3){5, 0, 0}, up) == CHECK_REACH);
    assert_true(checker_crosses(checker, (tahr_vec3){-2, 0, 0.9}, (tahr_vec3){2, 0, 0.9}));
    assert_false(checker_crosses(checker, (tahr_vec3){-2, 0, 1.1}, (tahr_vec3){2, 0, 1.1}));
    checker_close(checker);
    level_close(&level);
}

/* Output of the author's own demonstration program for seed 42, stream 54. */
static void random_numbers_are_those_of_pcg32(void **unused)
{
    static const uint32_t published[6] = {0xa15c02b7, 0x7b47f409, 0xba1d3330, 0x83d2f293, 0xbfa4784b, 0xcbed606e};
    struct pcg random;
    (void)unused;
    pcg_start(&random, 42, 54);
    for (int i = 0; i < 6; i++) {
        assert_int_equal(pcg_next(&random), published[i]);
    }
}

static void headings_lie_on_the_unit_circle(void **unused)
{
    (void)unused;
    for (int i = 0; i < 4096; i++) {
        double turn = i / 4096.0;
        tahr_vec3 v = unit_vector(turn);
        assert_true(fabs(v.x - cos(turn * 6.283185307179586)) < 3e-15 &&
                    fabs(v.y - sin(turn * 6.283185307179586)) < 3e-15);
    }
}

/* By definition every 0.5 to 2 s, 5 % with a jump; and the same whatever the rate of the steps. */
static void wandering_does_not_depend_on_the_step_rate(void **unused)
{
    tahr_input slow = {0}, fast = {0};
    struct wander a, b;
    int changes = 0, jumps = 0, jumped_since = 0;
    (void)unused;
    wander_start(&a, 3, 5);
    wander_start(&b, 3, 5);
    for (int i = 0; i < 100000; i++) {
        changes += wander_input(&a, i / 10.0, &slow);
        jumps += (int)slow.jump;
        jumped_since = 0;
        for (int k = i == 0 ? 10 : 1; k <= 10; k++) { /* (i - 1, i] in tenths */
            wander_input(&b, i == 0 ? 0 : (i - 1) / 10.0 + k / 100.0, &fast);
            jumped_since |= (int)fast.jump;
        }
        assert_int_equal(jumped_since, slow.jump);
        assert_true(slow.move.x == fast.move.x && slow.move.y == fast.move.y);
    }
    assert_true(fabs(10000.0 / changes - 1.25) < 0.02);
    assert_true(fabs((double)jumps / changes - 0.05) < 0.01);
}

static void quantiles_are_exact_below_65_us_and_within_two_percent_above(void **unused)
{
    struct times times;
    (void)unused;
    times_open(&times);
    assert_true(times_quantile(&times, 0.5) == 0);
    for (uint64_t ns = 1; ns <= 1000; ns++) {
        times_add(&times, ns);
    }
    assert_true(times_quantile(&times, 0.5) == 500 && times_quantile(&times, 0.99) == 990 &&
                times_mean(&times) == 500.5);
    for (uint64_t ns = 70000; ns < 400000000; ns += ns / 7) {
        struct times one;
        times_open(&one);
        times_add(&one, ns);
        assert_true(fabs(times_quantile(&one, 0.5) / (double)ns - 1) < 0.02);
        times_close(&one);
    }
    times_close(&times);
}

/* Steps of 10 Hz; returns how often it was told to hang. */
static int hangs(uint32_t mode, double rise, double gravity, double seconds)
{
    struct progress progress;
    tahr_state state = {.mode = mode, .up = {0, 0, 1}};
    int found = 0;
    progress_start(&progress, &state, 0);
    for (int i = 1; i <= seconds * 10 + 0.5; i++) {
        double t = i / 10.0;
        state.position.z = rise * t - gravity * t * t / 2;
        found += progress_hangs(&progress, &state, t);
    }
    return found;
}

static void who_falls_and_stays_where_it_is_hangs_in_the_air(void **state)
{
    (void)state;
    assert_int_equal(hangs(TAHR_MODE_FALLING, 0, 0, 0.4), 0);
    assert_int_equal(hangs(TAHR_MODE_FALLING, 0, 0, 0.5), 1);
    assert_int_equal(hangs(TAHR_MODE_FALLING, 0, 0, 2), 4);
    assert_int_equal(hangs(TAHR_MODE_WALKING, 0, 0, 2), 0);
    assert_int_equal(hangs(TAHR_MODE_FALLING, 0, 9.81, 2), 0);
    assert_int_equal(hangs(TAHR_MODE_FALLING, 4.905, 9.81, 2), 0); /* an apex */
    assert_int_equal(hangs(TAHR_MODE_FALLING, -0.019, 0, 2), 4);   /* 9.5 mm in half a second */
    assert_int_equal(hangs(TAHR_MODE_FALLING, -0.021, 0, 2), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(clearance_equals_brute_force_over_all_triangles),
        cmocka_unit_test(every_segment_out_of_a_closed_box_is_a_crossing),
        cmocka_unit_test(a_crossing_of_a_terrain_is_seen_whatever_the_edge_it_goes_through),
        cmocka_unit_test(round_bodies_count_from_their_surface),
        cmocka_unit_test(who_falls_and_stays_where_it_is_hangs_in_the_air),
        cmocka_unit_test(random_numbers_are_those_of_pcg32),
        cmocka_unit_test(headings_lie_on_the_unit_circle),
        cmocka_unit_test(wandering_does_not_depend_on_the_step_rate),
        cmocka_unit_test(quantiles_are_exact_below_65_us_and_within_two_percent_above),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
