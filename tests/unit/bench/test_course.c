/* SPDX-License-Identifier: MIT
 * test_course.c: the judge of what is measured side by side catches what it should and nothing else; every method gets
 * the same places and wishes. What is expected here follows from where a puppet is told to go. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "course_level.h"
#include "oracle.h"
#include "puppet.h"

static const double HALF_HEIGHT = 0.9, RADIUS = 0.35, SPEED = 5;

static puppet actor; /* one at a time */

/* A floor at z = 0, 60 x 60 m between walls, and a wall of two faces at x = 0.4 .. 0.6. */
static void make_room(course *c)
{
    scene_mesh mesh = {.failed = 0};
    const double low[3] = {0.4, -5, -1}, high[3] = {0.6, 5, 4};
    scene_mesh_field(&mesh, 12, 12, 5, NULL);
    scene_mesh_box(&mesh, low, high);
    course_yard(&mesh, 29, 29, -1, 6);
    course_make_of(c, "room", &mesh, 0, 1);
    assert_int_equal(c->missing[0], 0);
}

/* Everybody stands on a spot of its own, 1 m apart, this high. */
static void stand(method_place *at, uint32_t i, double z)
{
    at->position[0] = -10;
    at->position[1] = i;
    at->position[2] = z;
    at->grounded = 1;
}

static void walks_as_wished(const puppet *p, uint32_t i, uint32_t tick, const double wish[3], method_place *at)
{
    (void)i;
    at->position[0] += p->dt * wish[0];
    at->position[1] += p->dt * wish[1];
    at->position[2] = HALF_HEIGHT + 0.02;
    at->grounded = tick % 6 < 3; /* changes every three ticks */
    at->queries = tick % 100 == 99 ? 7 : 2;
}

static void honest_walk_is_faultless_and_measured(void **state)
{
    (void)state;
    static course c;
    course_result r;
    scene_mesh mesh = {.failed = 0};
    scene_mesh_field(&mesh, 4, 4, 500, NULL);
    course_make_of(&c, "plain", &mesh, 0, 1);
    puppet_run(&c, &actor, walks_as_wished, 600, &r);
    assert_int_equal(r.steps, 600 * PUPPETS);
    assert_int_equal(r.tunnelled + r.embedded + r.invalid + r.left + r.stuck + r.bad_characters, 0);
    assert_int_equal(r.first_bad_tick, UINT32_MAX);
    assert_true(fabs(r.clearance - 0.02) < 1e-12);
    assert_true(r.deepest == 0);
    assert_true(fabs(r.progress - 1) < 1e-9); /* but for the first step up or down, which is level in x and y */
    assert_true(fabs(r.grounded - 0.5) < 1e-12);
    /* 199 changes in 600 ticks of 1/60 s */
    assert_true(fabs(r.flips - 199 / (600 * c.character.dt)) < 1e-9);
    assert_true(fabs(r.queries - (0.99 * 2 + 0.01 * 7)) < 1e-9);
    /* Half a second and the first two of every 50 ticks are warm-up: 30 of the first batch, 2 of the 11 others. */
    assert_int_equal(r.timed, (600 - 50 + 20 - 11 * 2) * PUPPETS);
    course_free(&c);
}

static void jumps_through_wall(const puppet *p, uint32_t i, uint32_t tick, const double wish[3], method_place *at)
{
    (void)p;
    (void)wish;
    at->position[0] = i == 2 && tick >= 40 ? 1.5 : -0.5;
    at->position[1] = i;
    at->position[2] = HALF_HEIGHT + 0.02;
    if (tick == 0) { /* from its start it would cross walls on the way */
        at->position[2] = 5.5;
    }
}

static void tunnelling_is_caught_and_named(void **state)
{
    (void)state;
    static course c;
    course_result r;
    make_room(&c);
    for (uint32_t i = 0; i < PUPPETS; i++) { /* all start over the floor, so the way to the first spot is free */
        c.spawns[i][0] = -0.5;
        c.spawns[i][1] = i;
        c.spawns[i][2] = 5.5;
    }
    puppet_run(&c, &actor, jumps_through_wall, 100, &r);
    assert_int_equal(r.tunnelled, 1); /* one step through both faces of the wall is one step */
    assert_int_equal(r.embedded, 0);
    assert_int_equal(r.bad_characters, 1);
    assert_int_equal(r.first_bad_character, 2);
    assert_int_equal(r.first_bad_tick, 40);
    assert_true(r.first_bad[0] == 1.5 && r.first_bad[1] == 2);
    course_free(&c);
}

static void sinks(const puppet *p, uint32_t i, uint32_t tick, const double wish[3], method_place *at)
{
    static const double GAPS[PUPPETS] = {0.01, -0.0009, -0.005, 0.01};
    (void)p;
    (void)wish;
    stand(at, i, HALF_HEIGHT + (tick >= 10 ? GAPS[i] : 0.03));
}

static void start_above(course *c)
{
    for (uint32_t i = 0; i < PUPPETS; i++) {
        c->spawns[i][0] = -10;
        c->spawns[i][1] = i;
        c->spawns[i][2] = 3;
    }
}

static void penetration_beyond_a_millimetre_is_counted_and_its_depth_told(void **state)
{
    (void)state;
    static course c;
    course_result r;
    make_room(&c);
    start_above(&c);
    puppet_run(&c, &actor, sinks, 60, &r);
    assert_int_equal(r.embedded, 50); /* of the one that is 5 mm deep, not of the one at 0.9 mm */
    assert_int_equal(r.tunnelled, 0);
    assert_int_equal(r.bad_characters, 1);
    assert_int_equal(r.first_bad_character, 2);
    assert_int_equal(r.first_bad_tick, 10);
    assert_true(fabs(r.deepest - 0.005) < 1e-12);
    assert_true(fabs(r.clearance + 0.005) < 1e-12);
    course_free(&c);
}

static void lies_in_the_floor(const puppet *p, uint32_t i, uint32_t tick, const double wish[3], method_place *at)
{
    (void)p;
    (void)wish;
    (void)tick;
    stand(at, i, i == 0 ? 0.2 : 2);
}

static void core_line_through_a_triangle_counts_as_the_radius(void **state)
{
    (void)state;
    static course c;
    course_result r;
    make_room(&c);
    start_above(&c);
    puppet_run(&c, &actor, lies_in_the_floor, 30, &r);
    assert_int_equal(r.embedded, 30);
    assert_true(fabs(r.deepest - RADIUS) < 1e-12);
    course_free(&c);
}

static void falls_out_or_gets_lost(const puppet *p, uint32_t i, uint32_t tick, const double wish[3], method_place *at)
{
    (void)p;
    (void)wish;
    stand(at, i, 2);
    if (i == 1 && (tick == 19 || tick == 20)) {
        at->position[0] = at->position[1] = 1000; /* beside the level, so nothing was crossed */
        at->position[2] = tick == 20 ? -1000 : 2;
    }
    if (i == 3 && (tick == 30 || tick == 31)) {
        at->position[0] = NAN;
    }
}

static void who_leaves_or_is_no_number_is_counted_and_put_back(void **state)
{
    (void)state;
    static course c;
    course_result r;
    scene_mesh mesh = {.failed = 0};
    scene_mesh_field(&mesh, 4, 4, 10, NULL);
    course_make_of(&c, "plate", &mesh, 0, 1);
    puppet_run(&c, &actor, falls_out_or_gets_lost, 60, &r);
    assert_int_equal(r.left, 1);
    assert_int_equal(r.invalid, 2);
    assert_int_equal(r.tunnelled, 0);
    assert_int_equal(r.embedded, 0);
    assert_int_equal(r.bad_characters, 1); /* to leave is no failure where a level has borders */
    assert_int_equal(r.first_bad_character, 3);
    assert_int_equal(r.first_bad_tick, 30);
    course_free(&c);
}

static void stands_still(const puppet *p, uint32_t i, uint32_t tick, const double wish[3], method_place *at)
{
    (void)p;
    (void)wish;
    stand(at, i, 2);
    at->position[0] += i == 0 ? 0.02 * (tick % 2) : i == 1 ? 0.06 * (tick / 299) : 0.001 * tick;
}

static void who_goes_nowhere_for_five_seconds_is_stuck(void **state)
{
    (void)state;
    static course c;
    course_result r;
    make_room(&c);
    start_above(&c);
    puppet_run(&c, &actor, stands_still, 610, &r);
    /* 5 s are 300 ticks, the first of a stretch is where it begins. 0: two stretches within 2 cm. 1: a jump of 6 cm in
     * each of them, at ticks 299 and 598. 2 and 3: 30 cm. */
    assert_int_equal(r.stuck, 2);
    assert_int_equal(r.bad_characters, 0);
    course_free(&c);
}

static void every_method_is_asked_for_the_same(void **state)
{
    (void)state;
    static course c;
    static puppet first;
    course_result r;
    uint32_t jumps = 0;
    make_room(&c);
    puppet_run(&c, &actor, stands_still, 600, &r);
    memcpy(&first, &actor, sizeof first);
    puppet_run(&c, &actor, walks_as_wished, 600, &r);
    assert_memory_equal(first.wishes, actor.wishes, sizeof first.wishes);
    assert_memory_equal(first.jumps, actor.jumps, sizeof first.jumps);
    for (int i = 0; i < PUPPETS; i++) {
        int headings = 1;
        for (int t = 0; t < 600; t++) {
            assert_true(fabs(hypot(first.wishes[i][t][0], first.wishes[i][t][1]) - SPEED) < 1e-9);
            headings += t > 0 && first.wishes[i][t][0] != first.wishes[i][t - 1][0];
            jumps += first.jumps[i][t] != 0;
        }
        assert_in_range(headings, 10 / 2, 10 / 0.5 + 1); /* 10 s of 0.5 to 2 s each */
        assert_true(i == 0 || memcmp(first.wishes[i], first.wishes[0], sizeof first.wishes[0]) != 0);
    }
    assert_in_range(jumps, 0, 15);
    course_free(&c);
}

/* The least distance of a character to any triangle, by an oracle that shares nothing with the judge. */
static double oracle_gap(const course *c, const double position[3])
{
    double best = HUGE_VAL;
    const double still[3] = {0, 0, 0};
    oracle_core core = {.axis_count = 1, .centre = {position[0], position[1], position[2]}};
    core.axis[0][course_up(c)] = HALF_HEIGHT - RADIUS;
    for (uint32_t i = 0; i < c->level.triangle_count; i++) {
        double triangle[3][3];
        for (int k = 0; k < 3; k++) {
            memcpy(triangle[k], c->level.vertices + 3 * (size_t)c->level.indices[3 * (size_t)i + (size_t)k],
                   sizeof triangle[k]);
        }
        best = fmin(best, (double)oracle_distance(&core, still, 0, triangle) - RADIUS);
    }
    return best;
}

static void generated_courses_start_everybody_in_free_space(void **state)
{
    (void)state;
    static course c;
    for (int i = 0; i < COURSES; i++) {
        const char *name = course_name(i);
        if (strcmp(name, "stairs") != 0 && strcmp(name, "ramps") != 0 && strcmp(name, "side_2d") != 0) {
            continue; /* the others are too large for an oracle */
        }
        course_make(&c, i);
        assert_int_equal(c.missing[0], 0);
        assert_int_equal(c.spawn_count, COURSE_SPAWNS);
        for (uint32_t k = 0; k < 20; k++) {
            double gap = oracle_gap(&c, c.spawns[k * 100]);
            assert_true(gap >= 0.05 - 1e-9);
        }
        course_free(&c);
    }
    assert_null(course_name(COURSES));
}

/* Six times the volume that a closed surface holds, faces outward. */
static double volume_of(const scene_mesh *mesh)
{
    double sum = 0;
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        const double *a = mesh->vertices + 3 * (size_t)mesh->indices[3 * (size_t)i];
        const double *b = mesh->vertices + 3 * (size_t)mesh->indices[3 * (size_t)i + 1];
        const double *c = mesh->vertices + 3 * (size_t)mesh->indices[3 * (size_t)i + 2];
        sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
               a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    return sum;
}

static void prisms_are_closed_and_face_outward(void **state)
{
    (void)state;
    static const double TRAPEZOID[4][2] = {{0, 0}, {6, 0}, {4, 2}, {1, 2}}; /* area (6 + 3) / 2 * 2 = 9 */
    scene_mesh mesh = {.failed = 0};
    course_prism(&mesh, TRAPEZOID, 4, 10, 15);
    assert_true(fabs(volume_of(&mesh) - 6 * 9 * 5) < 1e-9);
    scene_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(honest_walk_is_faultless_and_measured),
        cmocka_unit_test(tunnelling_is_caught_and_named),
        cmocka_unit_test(penetration_beyond_a_millimetre_is_counted_and_its_depth_told),
        cmocka_unit_test(core_line_through_a_triangle_counts_as_the_radius),
        cmocka_unit_test(who_leaves_or_is_no_number_is_counted_and_put_back),
        cmocka_unit_test(who_goes_nowhere_for_five_seconds_is_stuck),
        cmocka_unit_test(every_method_is_asked_for_the_same),
        cmocka_unit_test(generated_courses_start_everybody_in_free_space),
        cmocka_unit_test(prisms_are_closed_and_face_outward),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
