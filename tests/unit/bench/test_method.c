/* SPDX-License-Identifier: MIT
 * test_method.c: Tahr as a method keeps to the seam, and a planar level has the outline it was drawn out of. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>
#include <tahr/native.h>
#ifdef TAHR_HAVE_BOX2D
#include <tahr/box2d.h>
#endif

#include "course_level.h"
#include "course_run.h"
#include "method_outline.h"
#include "method_tahr.h"

static const method_tahr NATIVE = {.backend = tahr_backend_v1_native};

static int find(const char *name)
{
    int i = 0;
    while (course_name(i) && strcmp(course_name(i), name) != 0) {
        i++;
    }
    return i;
}

static course_result walk(const char *name, const method *m, uint32_t characters, uint32_t ticks)
{
    static course c;
    char error[METHOD_ERROR];
    course_plan plan = {.characters = characters, .ticks = ticks};
    course_result r;
    course_make(&c, find(name));
    course_run *run = course_open(&c, m, &plan, error);
    assert_non_null(run);
    while (course_advance(run, 20) > 0) {
    }
    assert_int_equal(course_judge(run, &r), 1);
    course_close(run);
    course_free(&c);
    return r;
}

/* The promise of the preset, seen by the judge: 1 cm of skin, as deep as float near the character is exact. */
static void assert_sound(const course_result *r)
{
    assert_int_equal(r->tunnelled + r->embedded + r->invalid, 0);
    assert_true(r->clearance > 0.01 - 1e-5);
}

static void wishes_are_followed_at_once_on_a_plane(void **state)
{
    (void)state;
    method m = method_of_tahr("tahr", "", &NATIVE);
    course_result r = walk("plane", &m, 8, 300);
    assert_sound(&r);
    /* 1e6 m/s2: 5 m/s after 5 us of a step of 17 ms, and a turn about is twice that */
    assert_true(r.progress > 1 - 2e-3 && r.progress < 1 + 1e-9);
    assert_true(r.queries > 0 && r.grounded > 0.5);
}

static void stairs_and_ramps_are_walked_without_a_fault(void **state)
{
    (void)state;
    method m = method_of_tahr("tahr", "", &NATIVE);
    course_result stairs = walk("stairs", &m, 16, 200), ramps = walk("ramps", &m, 16, 200);
    assert_sound(&stairs);
    assert_sound(&ramps);
    assert_int_equal(stairs.left + ramps.left, 0);
}

static void side_scroller_is_walked_on_both_kinds_of_backend(void **state)
{
    (void)state;
    method m = method_of_tahr("tahr", "", &NATIVE);
    course_result native = walk("side_2d", &m, 16, 200);
    assert_sound(&native);
#ifdef TAHR_HAVE_BOX2D
    static const method_tahr box2d = {.backend = tahr_backend_v1_box2d};
    m = method_of_tahr("tahr-box2d", "", &box2d);
    course_result planar = walk("side_2d", &m, 16, 200);
    assert_sound(&planar);
    assert_true(fabs(planar.progress - native.progress) < 1e-3); /* the same world, whoever holds it */
#endif
}

static void make_slow(tahr_config *config, const void *tuning)
{
    config->max_speed = 5;
    config->step_height = *(const double *)tuning;
}

static void knobs_reach_the_config_and_wrong_ones_are_named(void **state)
{
    (void)state;
    static const double WRONG = -1;
    static const method_tahr BAD = {.backend = tahr_backend_v1_native, .tune = make_slow, .tuning = &WRONG};
    static course c;
    char error[METHOD_ERROR] = "";
    course_plan plan = {.characters = 1, .ticks = 1};
    method m = method_of_tahr("bad", "", &BAD);
    course_make(&c, find("plane"));
    assert_null(course_open(&c, &m, &plan, error));
    assert_non_null(strstr(error, "step_height"));
    course_free(&c);
}

/* The outline of one profile and one block. */
static void outline_is_what_was_drawn_out(void **state)
{
    (void)state;
    static const double PROFILE[4][2] = {{0, 0}, {3, 0}, {5, 1}, {9, 1}};
    static const double BLOCK[4][2] = {{2, 4}, {3, 4}, {3, 5}, {2, 5}};
    scene_mesh mesh = {.failed = 0};
    method_outline outline;
    scene_mesh_profile(&mesh, PROFILE, 4, 2);
    course_prism(&mesh, BLOCK, 4, -1, 1);
    for (uint32_t i = 0; i < mesh.vertex_count; i++) { /* y up */
        double *v = mesh.vertices + 3 * (size_t)i, y = v[1];
        v[1] = v[2];
        v[2] = -y;
    }
    method_level level = {.vertices = mesh.vertices,
                          .indices = mesh.indices,
                          .vertex_count = mesh.vertex_count,
                          .triangle_count = mesh.triangle_count,
                          .planar = 1};
    assert_int_equal(method_outline_make(&outline, &level), 1);
    assert_int_equal(outline.line_count, 2);
    assert_int_equal(outline.lines[0].count, 4);
    assert_int_equal(outline.lines[0].loop, 0);
    for (int i = 0; i < 4; i++) { /* the floor is in front on the right hand: from right to left */
        assert_true(outline.points[2 * i] == PROFILE[3 - i][0] && outline.points[2 * i + 1] == PROFILE[3 - i][1]);
    }
    assert_int_equal(outline.lines[1].count, 4);
    assert_int_equal(outline.lines[1].loop, 1);
    double area = 0; /* twice; positive: counter-clockwise, so that the outside is on the right hand */
    const double *p = outline.points + 2 * (size_t)outline.lines[1].first;
    for (int i = 0; i < 4; i++) {
        int k = (i + 1) % 4;
        area += p[2 * i] * p[2 * k + 1] - p[2 * k] * p[2 * i + 1];
    }
    assert_true(area == 2);
    method_outline_free(&outline);
    scene_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wishes_are_followed_at_once_on_a_plane),
        cmocka_unit_test(stairs_and_ramps_are_walked_without_a_fault),
        cmocka_unit_test(side_scroller_is_walked_on_both_kinds_of_backend),
        cmocka_unit_test(knobs_reach_the_config_and_wrong_ones_are_named),
        cmocka_unit_test(outline_is_what_was_drawn_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
