/* SPDX-License-Identifier: MIT
 * test_side_check.c: the checker on levels of two dimensions against closed forms: walls, slopes, boxes with their
 * corners, and who sinks through what blocks from above only. */
#include "check.h"
#include "side.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static const tahr_shape capsule = {.type = TAHR_SHAPE_CAPSULE, .radius = 0.35, .half_height = 0.9};
static const tahr_shape box = {.type = TAHR_SHAPE_BOX, .half_x = 0.35, .half_y = 0.35, .half_height = 0.9};
static const tahr_vec3 up = {0, 1, 0};

static void add(struct side *side, enum side_kind kind, enum side_form form, size_t count, const double *xy)
{
    struct side_point points[8];
    for (size_t i = 0; i < count; i++) {
        points[i] = (struct side_point){xy[2 * i], xy[2 * i + 1]};
    }
    side_add(side, &(struct side_piece){.kind = kind, .form = form, .points = points, .count = count, .both = 1});
}

/* A floor at 0 with a wall at x = 10, a slope of 45 degrees from (-2, 0) up to the left, a plank from 2 to 4 at 2 m,
 * and one that leans from (5, 1) up to (7, 2). */
static struct checker *open_level(struct level *level)
{
    const double ground[] = {-4, 2, -2, 0, 10, 0, 10, 8}, plank[] = {2, 1.8, 4, 2}, leaning[] = {7, 2, 5, 1};
    struct side side = {0};
    add(&side, SIDE_SOLID, SIDE_LINE, 4, ground);
    add(&side, SIDE_ONE_WAY, SIDE_BOX, 2, plank);
    add(&side, SIDE_ONE_WAY, SIDE_LINE, 2, leaning);
    side_build(level, &side, "test", 0);
    return checker_open(level);
}

static void assert_near(double x, double expected)
{
    if (!(fabs(x - expected) < 1e-12)) {
        fail_msg("%.17g instead of %.17g", x, expected);
    }
}

static double clearance(struct checker *checker, const tahr_shape *shape, double x, double y)
{
    return checker_clearance(checker, shape, (tahr_vec3){x, y, 0}, up);
}

static void clearance_is_the_distance_to_floor_wall_and_slope(void **state)
{
    struct level level;
    struct checker *checker = open_level(&level);
    (void)state;
    assert_near(clearance(checker, &capsule, 0, 0.92), 0.02);
    assert_near(clearance(checker, &capsule, 0, 0.89), -0.01);
    assert_near(clearance(checker, &capsule, 9.62, 3), 0.03);
    assert_near(clearance(checker, &capsule, 9.67, 3), -0.02);
    /* The lower cap's middle is 0.55 below the centre; its distance to the line x + y + 2 = 0 less the radius. */
    assert_near(clearance(checker, &capsule, -2.5, 1.57), (-2.5 + 1.57 - 0.55 + 2) / sqrt(2) - 0.35);
    assert_near(clearance(checker, &capsule, 0, 5), CHECK_REACH);
    assert_near(clearance(checker, &box, 0, 0.92), 0.02);
    assert_near(clearance(checker, &box, 9.62, 3), 0.03);
    /* The lower left corner above the slope. */
    assert_near(clearance(checker, &box, -2.5, 1.8), (-2.5 - 0.35 + 1.8 - 0.9 + 2) / sqrt(2));
    checker_close(checker);
    level_close(&level);
}

static void a_corner_of_a_box_in_a_slope_is_an_overlap(void **state)
{
    struct level level;
    struct checker *checker = open_level(&level);
    (void)state;
    /* The inner capsule is 13 cm off the slope: (-2.5 + 1.73 - 0.55 + 2) / sqrt(2) - 0.35. */
    double deep = clearance(checker, &box, -2.5, 1.75 - 0.02), grazing = clearance(checker, &box, -2.5, 1.75 - 0.002);
    assert_near(deep, -CHECK_BOX_DEPTH);
    assert_true(grazing <= 0 && grazing > -CHECK_BOX_DEPTH);
    checker_close(checker);
    level_close(&level);
}

static int sinks(struct checker *checker, double x0, double y0, double x1, double y1)
{
    /* Given by the feet. */
    return checker_sinks(checker, &capsule, (tahr_vec3){x0, y0 + 0.9, 0}, &capsule, (tahr_vec3){x1, y1 + 0.9, 0});
}

static void only_who_was_above_a_plank_and_is_below_it_sank(void **state)
{
    struct level level;
    struct checker *checker = open_level(&level);
    (void)state;
    assert_true(sinks(checker, 3, 2.01, 3, 1.9));
    assert_true(sinks(checker, 3, 2.01, 3.2, -1));
    assert_false(sinks(checker, 3, 2.5, 3, 2.01));   /* still above */
    assert_false(sinks(checker, 3, 1.7, 3, 2.4));    /* up through it */
    assert_false(sinks(checker, 3, 1.9, 3, 1.5));    /* was below already */
    assert_false(sinks(checker, 3.9, 2.01, 4.3, 1)); /* off its end */
    assert_false(sinks(checker, 1.5, 2.01, 1.6, 1)); /* beside it */
    /* The leaning one rises by 1 over 2: with the foot 0.2 over it at x = 6 the cap is clear, with 0.01 it is not, for
     * the cap's middle is (0.35 + h) * 2 / sqrt(5) away: 0.49 and 0.32 against 0.35. */
    assert_true(sinks(checker, 6, 1.7, 6, 1.4));
    assert_false(sinks(checker, 6, 1.51, 6, 1.4));
    checker_close(checker);
    level_close(&level);
}

static void a_plank_that_comes_down_faster_than_its_rider_falls_is_sunk_through(void **state)
{
    struct level level;
    struct side side = {0};
    struct side_point corners[2] = {{0, 0.8}, {4, 1}};
    (void)state;
    side_add(&side, &(struct side_piece){.kind = SIDE_ONE_WAY,
                                         .form = SIDE_BOX,
                                         .points = corners,
                                         .count = 2,
                                         .moves = 1,
                                         .swing = {0, 4},
                                         .period = 4});
    add(&side, SIDE_SOLID, SIDE_BOX, 2, (const double[]){-1, -1, 5, 0});
    side_build(&level, &side, "test", 0);
    struct checker *checker = checker_open(&level);
    /* From one end to the other in 2 s: at 1 s it is half way, its top at 3 m. */
    checker_time(checker, 0, 1);
    assert_true(sinks(checker, 2, 1.01, 2, 2.9));   /* it rose 2 m, the rider 1.89 */
    assert_false(sinks(checker, 2, 1.01, 2, 3.01)); /* carried */
    assert_false(sinks(checker, 2, 0.5, 2, 0.5));   /* passed by it */
    checker_close(checker);
    level_close(&level);
}

static void inside_of_solids_is_inside_of_no_hole_of_them(void **state)
{
    const double ring[] = {0, 0, 9, 0, 9, 9, 0, 9}, hole[] = {3, 3, 3, 6, 6, 6, 6, 3}, post[] = {4, 4, 5, 5};
    struct side side = {0};
    (void)state;
    add(&side, SIDE_SOLID, SIDE_LOOP, 4, ring);
    add(&side, SIDE_SOLID, SIDE_LOOP, 4, hole);
    add(&side, SIDE_SOLID, SIDE_BOX, 2, post);
    add(&side, SIDE_ONE_WAY, SIDE_BOX, 2, (const double[]){20, 0, 30, 1});
    assert_true(side_is_solid(&side, 1, 4.5));
    assert_false(side_is_solid(&side, 3.5, 4.5));
    assert_true(side_is_solid(&side, 4.5, 4.5));
    assert_false(side_is_solid(&side, 5.5, 3.5));
    assert_true(side_is_solid(&side, 8, 8));
    assert_false(side_is_solid(&side, 10, 4.5));
    assert_false(side_is_solid(&side, -1, 3));
    assert_false(side_is_solid(&side, 25, 0.5));
    side_free(&side);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(clearance_is_the_distance_to_floor_wall_and_slope),
        cmocka_unit_test(a_corner_of_a_box_in_a_slope_is_an_overlap),
        cmocka_unit_test(only_who_was_above_a_plank_and_is_below_it_sank),
        cmocka_unit_test(inside_of_solids_is_inside_of_no_hole_of_them),
        cmocka_unit_test(a_plank_that_comes_down_faster_than_its_rider_falls_is_sunk_through),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
