/* SPDX-License-Identifier: MIT
 * test_slide.c: bending a motion, making walls level, forgetting what was left behind. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "rig.h"
#include "slide.h"

static void slide_leaves_every_plane_and_never_lengthens(void **unused)
{
    double a = 0.3;
    tahr__plane planes[3] = {{.normal = {0, 0, 1}},
                             {.normal = {-cos(a), sin(a), 0}, .feature = 1},
                             {.normal = {-0.6, 0, 0.8}, .feature = 2}};
    (void)unused;
    for (uint32_t count = 1; count <= 3; count++) {
        vec3 x = tahr__slide(planes, count, vec(3, 0.5, -1));
        for (uint32_t i = 0; i < count; i++) {
            assert_true(dot(planes[i].normal, x) > 0);
        }
        assert_true(length(x) <= length(vec(3, 0.5, -1)) * (1 + 1e-9));
    }
}

/* Two faces that lean out by `a`, a gutter along y between them: sweeps take 1e-12 of a motion for parallel. The least
 * way off both, each by 1e-10 of the motion's length, is that over sin a, upward. */
static void both_sides_of_a_gutter_are_left_down_to_a_degree(void **unused)
{
    const double some[] = {0.5, 0.2, 0.1, 0.01};
    (void)unused;
    for (int i = 0; i < 4; i++) {
        double a = some[i], part = 1e-10 / sin(a);
        tahr__plane sides[2] = {{.normal = {cos(a), 0, sin(a)}}, {.normal = {-cos(a), 0, sin(a)}, .feature = 1}};
        vec3 motion = vec(0.3, 1, -1), x = tahr__slide(sides, 2, motion);
        double size = length(motion);
        assert_true(dot(sides[0].normal, x) > 5e-12 * size && dot(sides[1].normal, x) > 5e-12 * size);
        assert_near(x.x, 0, 1e-11);
        assert_near(x.y, 1, 1e-15);
        assert_true(x.z > 0 && x.z < 1.1 * part * size);
    }
}

static void no_plane_keeps_the_motion_and_a_dead_end_stops_it(void **unused)
{
    tahr__plane wall = {.normal = {-1, 0, 0}};
    (void)unused;
    assert_true(vec_equal(tahr__slide(NULL, 0, vec(1, 2, 3)), vec(1, 2, 3)));
    assert_true(vec_equal(tahr__slide(&wall, 1, vec(1, 0, 0)), vec(0, 0, 0)));
    assert_true(vec_equal(tahr__slide(&wall, 1, vec(1, 1e-9, 0)), vec(0, 0, 0)));
}

static void planes_are_forgotten_beyond_a_skin(void **unused)
{
    tahr_config c = rig_config();
    tahr__step step;
    tahr__plane planes[2] = {{.normal = {1, 0, 0}, .anchor = {0, 0, 0}},
                             {.normal = {0, 1, 0}, .anchor = {0, 0, 0}, .feature = 1}};
    uint32_t count = 2;
    (void)unused;
    memset(&step, 0, sizeof step);
    step.config = &c;
    step.state.position = vec(0.009, 0.009, 0);
    tahr__planes_forget(&step, planes, &count);
    assert_int_equal(count, 2);
    step.state.position = vec(0.009, 0.011, 0);
    tahr__planes_forget(&step, planes, &count);
    assert_int_equal(count, 1);
    assert_true(planes[0].normal.x == 1);
}

static void leaning_walls_become_level_and_parallel_ceilings_nothing(void **unused)
{
    tahr__step step;
    tahr__plane wall = {.normal = {-0.8, 0, 0.6}}, ceiling = {.normal = {0, 0, -1}};
    (void)unused;
    memset(&step, 0, sizeof step);
    step.state.up = vec(0, 0, 1);
    assert_int_equal(tahr__level_wall(&step, vec(0, 0, 1), &wall), 1);
    assert_near(wall.normal.x, -1, 1e-15);
    assert_near(wall.normal.z, 0, 0);
    assert_int_equal(tahr__level_wall(&step, vec(0, 0, 1), &ceiling), 0);
    ceiling.normal = vec(0, 0, -1); /* going up a ramp runs into a level ceiling */
    assert_int_equal(tahr__level_wall(&step, vec(-0.6, 0, 0.8), &ceiling), 1);
    assert_near(ceiling.normal.x, -1, 1e-15);
}

/* A floor that rises toward -x below a ceiling that comes down to it, and an upright plane across: what they leave is
 * the line along y and nothing beside it, and any way off one of them is a way into another. */
static void on_the_line_that_planes_leave_nothing_is_lifted(void **unused)
{
    tahr__plane planes[3] = {{.normal = {0.28, 0, 0.96}},
                             {.normal = {-0.352, 0, -0.936}, .feature = 1},
                             {.normal = {1, 0, 0}, .feature = 2}};
    (void)unused;
    vec3 motion = vec(-1.4, -0.7, 0.4), x = tahr__slide(planes, 3, motion);
    for (int i = 0; i < 3; i++) {
        assert_true(dot(planes[i].normal, x) >= -1e-12 * length(x));
    }
    assert_near(x.x, 0, 1e-12);
    assert_near(x.y, -0.7, 1e-12);
    assert_near(x.z, 0, 1e-12);
}

/* The edges of a gap, a hair narrower ahead: who pushes in falls along the line that both leave, and no farther in. */
static void between_edges_that_face_each_other_there_is_the_way_down(void **unused)
{
    (void)unused;
    for (double lean = 1e-3; lean > 3e-7; lean *= 0.37) {
        const double across = sqrt(1 - lean * lean);
        const tahr__plane edges[2] = {{.normal = {-lean, -across, 0}, .feature = 1},
                                      {.normal = {-lean, across, 0}, .feature = 2}};
        for (int i = -3; i <= 3; i++) {
            const vec3 push = vec(0.1, 0.02 * i, -0.05), way = tahr__bend(edges, 2, push);
            assert_true(fabs(way.z - push.z) < 1e-9);
            assert_true(way.x < 1e-9 && fabs(way.y) < 1e-9);
            for (int k = 0; k < 2; k++)
                assert_true(dot(way, edges[k].normal) > -1e-13);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(on_the_line_that_planes_leave_nothing_is_lifted),
                                       cmocka_unit_test(slide_leaves_every_plane_and_never_lengthens),
                                       cmocka_unit_test(between_edges_that_face_each_other_there_is_the_way_down),
                                       cmocka_unit_test(both_sides_of_a_gutter_are_left_down_to_a_degree),
                                       cmocka_unit_test(no_plane_keeps_the_motion_and_a_dead_end_stops_it),
                                       cmocka_unit_test(planes_are_forgotten_beyond_a_skin),
                                       cmocka_unit_test(leaning_walls_become_level_and_parallel_ceilings_nothing)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
