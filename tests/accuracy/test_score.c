/* SPDX-License-Identifier: MIT
 * test_score.c: the judge judged: known wrong answers must be found wrong, by exactly as much as they are. All numbers
 * come from plane geometry by hand. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "score.h"

/* A floor z = 0, a wall x = 1 that looks to -x, 20 m wide; a cube of side 2 around (0, 0, 10). */
static const double floor_vertices[] = {-10, -10, 0, 10, -10, 0, 10, 10, 0, -10, 10, 0};
static const double wall_vertices[] = {1, -10, -10, 1, 10, -10, 1, 10, 10, 1, -10, 10};
static const uint32_t quad[] = {0, 1, 2, 0, 2, 3};
static const double cube_vertices[] = {-1, -1, 9,  1, -1, 9,  1, 1, 9,  -1, 1, 9,
                                       -1, -1, 11, 1, -1, 11, 1, 1, 11, -1, 1, 11};
static const uint32_t cube[] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};
static const score_body bodies[] = {{floor_vertices, quad, 4, 2, 0, 0},
                                    {wall_vertices, quad, 4, 2, 0, 0},
                                    {cube_vertices, cube, 8, 12, SCORE_SOLID, 0}};
static const score_scene ground = {bodies, 1}, gutter = {bodies, 2}, solid = {bodies + 2, 1};

static tahr_sweep sphere_at(double x, double y, double z)
{
    tahr_sweep q = {.shape = {.type = TAHR_SHAPE_SPHERE, .radius = 0.5, .half_height = 0.5},
                    .position = {x, y, z},
                    .up = {0, 0, 1},
                    .orientation = {0, 0, 0, 1},
                    .margin = 0.01};
    return q;
}

static void quantiles_are_of_all_values_and_nothing_else(void **state)
{
    score_stat stat = {0}, more = {0};
    (void)state;

    assert_true(score_stat_quantile(&stat, 0.5) == 0 && score_stat_mean(&stat) == 0 && score_stat_rms(&stat) == 0);
    for (int i = 100; i > 0; i--) {
        score_stat_add(&stat, i);
    }
    score_stat_add(&stat, NAN);
    score_stat_add(&stat, INFINITY);
    assert_int_equal(stat.count, 100);
    assert_int_equal(stat.not_finite, 2);
    assert_true(score_stat_quantile(&stat, 0.5) == 50 && score_stat_quantile(&stat, 0.99) == 99);
    assert_true(score_stat_quantile(&stat, 0) == 1 && score_stat_quantile(&stat, 1) == 100);
    assert_true(stat.min == 1 && stat.max == 100 && score_stat_mean(&stat) == 50.5);
    score_stat_add(&more, 1000);
    score_stat_merge(&more, &stat);
    assert_true(more.count == 101 && more.not_finite == 2 && score_stat_quantile(&more, 1) == 1000);
    assert_true(fabs(score_stat_rms(&stat) - sqrt(338350.0 / 100)) < 1e-12);
    score_stat_free(&stat);
    score_stat_free(&more);
}

static void distance_is_that_of_each_shape(void **state)
{
    tahr_sweep q = sphere_at(0, 0, 3);
    (void)state;

    assert_true(fabs(score_distance(&ground, &q, 0, 100) - 2.5) < 1e-15);
    q.shape = (tahr_shape){.type = TAHR_SHAPE_CAPSULE, .radius = 0.25, .half_height = 1};
    assert_true(fabs(score_distance(&ground, &q, 0, 100) - 2) < 1e-15);
    q.up = (tahr_vec3){1, 0, 0};
    assert_true(fabs(score_distance(&ground, &q, 0, 100) - 2.75) < 1e-15);
    q.shape = (tahr_shape){.type = TAHR_SHAPE_BOX, .half_height = 1, .half_x = 0.5, .half_y = 0.25};
    q.orientation = (tahr_quat){0, sqrt(0.5), 0, sqrt(0.5)}; /* a quarter turn: x points down */
    assert_true(fabs(score_distance(&ground, &q, 0, 100) - 2.5) < 1e-15);
    q = sphere_at(0, 0, 3);
    q.motion = (tahr_vec3){0, 0, -2};
    assert_true(fabs(score_distance(&ground, &q, 0.5, 100) - 1.5) < 1e-15);
    assert_true(score_distance(&(score_scene){bodies, 0}, &q, 0, 100) == INFINITY);
    assert_true(score_distance(&ground, &q, 0, 1) >= 1); /* beyond the reach */
}

static void a_core_inside_of_a_solid_has_no_distance_from_it(void **state)
{
    tahr_sweep q = sphere_at(0, 0, 10);
    (void)state;

    assert_true(score_distance(&solid, &q, 0, 100) == -0.5);
    q = sphere_at(3, 0, 10);
    assert_true(fabs(score_distance(&solid, &q, 0, 100) - 1.5) < 1e-15);
    q = sphere_at(2, 2, 10); /* beside an edge */
    assert_true(fabs(score_distance(&solid, &q, 0, 100) - (sqrt(2) - 0.5)) < 1e-15);
}

static tahr_vec3 leaning(double degrees)
{
    double a = degrees * 0.017453292519943295;
    return (tahr_vec3){0, sin(a), cos(a)};
}

static void normals_are_wrong_by_their_angle_to_the_cone(void **state)
{
    tahr_sweep flat = sphere_at(0, 0, 0.5), corner = sphere_at(0.49, 0, 0.51);
    tahr_vec3 between = {-0.6, 0, 0.8}, outside = {-sin(0.1), 0, cos(0.1)};
    (void)state;

    assert_true(score_normal_error(&ground, &flat, 0, 1e-9, leaning(0)) < 1e-12);
    assert_true(fabs(score_normal_error(&ground, &flat, 0, 1e-9, leaning(3)) - 3) < 1e-12);
    assert_true(fabs(score_normal_error(&ground, &flat, 0, 1e-9, leaning(-90)) - 90) < 1e-12);
    assert_true(fabs(score_normal_error(&ground, &flat, 0, 1e-9, leaning(180)) - 180) < 1e-12);
    /* Both the floor and the wall touch: every direction between theirs is right, and none across. */
    assert_true(score_normal_error(&gutter, &corner, 0, 1e-9, between) < 1e-12);
    assert_true(score_normal_error(&gutter, &corner, 0, 1e-9, (tahr_vec3){-1, 0, 0}) < 1e-12);
    assert_true(fabs(score_normal_error(&gutter, &corner, 0, 1e-9, leaning(2)) - 2) < 1e-12);
    assert_true(fabs(score_normal_error(&gutter, &corner, 0, 1e-9, (tahr_vec3){1, 0, 0}) - 90) < 1e-12);
    corner.position.x = 0.48; /* the wall is a centimetre further off: only the floor counts, unless slack says so */
    assert_true(fabs(score_normal_error(&gutter, &corner, 0, 1e-9, outside) - 0.1 * 57.29577951308232) < 1e-12);
    assert_true(score_normal_error(&gutter, &corner, 0, 0.02, outside) < 1e-12);
    assert_true(score_normal_error(&(score_scene){bodies, 0}, &flat, 0, 1, leaning(0)) == 180);
}

static void cones_of_three_hold_what_lies_within(void **state)
{
    static const double side[] = {-10, 1, -10, -10, 1, 10, 10, 1, 10, 10, 1, -10};
    const score_body three[] = {bodies[0], bodies[1], {side, quad, 4, 2, 0, 0}};
    const score_scene corner = {three, 3};
    tahr_sweep q = sphere_at(0.5, 0.5, 0.5);
    (void)state;

    assert_true(score_normal_error(&corner, &q, 0, 1e-9, (tahr_vec3){-0.48, -0.6, 0.64}) == 0);
    assert_true(fabs(score_normal_error(&corner, &q, 0, 1e-9, (tahr_vec3){0.6, -0.8, 0}) - 36.86989764584402) < 1e-9);
}

static void truth_of_a_fall_is_found(void **state)
{
    tahr_sweep q = sphere_at(0.3, 0.2, 2);
    score_truth t;
    (void)state;

    q.motion = (tahr_vec3){0, 0, -2};
    assert_true(score_solve(&ground, &q, &t));
    assert_int_equal(t.status, SCORE_HIT);
    assert_true(fabs(t.fraction - 1.49 / 2) < 1e-15 && fabs(t.start_gap - 1.5) < 1e-15 && t.normal.z == 1);
    assert_true(fabs(t.min_gap + 0.51) < 1e-15); /* the core lies in the floor at the end */
    q.motion = (tahr_vec3){0, 0, -1};
    assert_true(score_solve(&ground, &q, &t) && t.status == SCORE_FREE && fabs(t.min_gap - 0.49) < 1e-15);
    q = sphere_at(0, 0, 0.4);
    assert_true(score_solve(&ground, &q, &t) && t.status == SCORE_OVERLAP && fabs(t.start_gap + 0.1) < 1e-15);
    q = sphere_at(0, 0, 0);
    assert_false(score_solve(&ground, &q, &t)); /* the core touches */
    q = sphere_at(0, 0, 2);
    q.motion = (tahr_vec3){3, 0, 0}; /* into the cube's side above it? no: 9 m below it */
    assert_true(score_solve(&solid, &q, &t) && t.status == SCORE_FREE);
}

static void truth_of_who_rests_meets_walls_but_no_seams(void **state)
{
    tahr_sweep q = sphere_at(-2, 3, 0.505); /* half of the margin above the floor, whose diagonal is x = y */
    score_truth t;
    (void)state;

    q.motion = (tahr_vec3){6, 0, 0};
    assert_true(score_solve(&gutter, &q, &t) && t.status == SCORE_HIT);
    assert_true(fabs(t.fraction - 2.49 / 6) < 1e-15 && fabs(t.normal.x + 1) < 1e-15);
    q.motion = (tahr_vec3){0.1, 0, -0.001};
    assert_true(score_solve(&gutter, &q, &t) && t.status == SCORE_HIT && t.fraction == 0);
    q.motion = (tahr_vec3){0.1, 0, 0.001};
    assert_true(score_solve(&gutter, &q, &t) && t.status == SCORE_FREE);
}

/* The right answer to a fall onto the floor, to be made wrong. */
static tahr_hit landing(const score_truth *t)
{
    return (tahr_hit){.blocking = 1,
                      .fraction = t->fraction,
                      .distance = 0.01,
                      .normal = {0, 0, 1},
                      .surface_normal = {0, 0, 1},
                      .point = {0.3, 0.2, 0}};
}

static void wrong_sweeps_are_wrong_by_as_much_as_they_are(void **state)
{
    tahr_sweep q = sphere_at(0.3, 0.2, 2);
    score_truth t;
    score_answer a;
    (void)state;

    q.motion = (tahr_vec3){0, 0, -2};
    assert_true(score_solve(&ground, &q, &t));
    tahr_hit right = landing(&t), wrong = right;
    a = score_sweep(&ground, &q, &t, TAHR_OK, &right, 1, 1e-9);
    assert_int_equal(a.failure, SCORE_FINE);
    assert_true(a.measured && fabs(a.gap_error) < 1e-15 && a.normal_error < 1e-12);
    assert_true(a.distance_error < 1e-15 && a.point_error < 1e-15);
    wrong.fraction += 0.5e-4; /* of 2 m */
    a = score_sweep(&ground, &q, &t, TAHR_OK, &wrong, 1, 1e-9);
    assert_true(a.measured && fabs(a.gap_error + 1e-4) < 1e-15 && fabs(a.distance_error - 1e-4) < 1e-15);
    wrong.fraction = right.fraction - 0.5e-3;
    a = score_sweep(&ground, &q, &t, TAHR_OK, &wrong, 1, 1e-9);
    assert_true(fabs(a.gap_error - 1e-3) < 1e-15);
    wrong = right;
    wrong.normal = leaning(2);
    a = score_sweep(&ground, &q, &t, TAHR_OK, &wrong, 1, 1e-9);
    assert_true(fabs(a.normal_error - 2) < 1e-12);
    wrong = right;
    wrong.point.z = 0.125;
    a = score_sweep(&ground, &q, &t, TAHR_OK, &wrong, 1, 1e-9);
    assert_true(fabs(a.point_error - 0.125) < 1e-15);
}

static void failures_are_told_apart(void **state)
{
    tahr_sweep q = sphere_at(0.3, 0.2, 2);
    score_truth hit, none;
    tahr_hit right, wrong;
    score_answer a;
    (void)state;

    q.motion = (tahr_vec3){0, 0, -2};
    assert_true(score_solve(&ground, &q, &hit));
    right = wrong = landing(&hit);
    a = score_sweep(&ground, &q, &hit, TAHR_OK, &right, 0, 1e-9);
    assert_true(a.failure == SCORE_MISS && !a.measured && fabs(a.beyond - 0.51) < 1e-15);
    wrong.normal.y = NAN;
    assert_int_equal(score_sweep(&ground, &q, &hit, TAHR_OK, &wrong, 1, 1e-9).failure, SCORE_NOT_FINITE);
    wrong = right;
    wrong.unknown = 1;
    assert_int_equal(score_sweep(&ground, &q, &hit, TAHR_UNKNOWN, &wrong, 1, 1e-9).failure, SCORE_UNKNOWN);
    wrong = right;
    wrong.start_overlap = 1;
    assert_int_equal(score_sweep(&ground, &q, &hit, TAHR_OK, &wrong, 1, 1e-9).failure, SCORE_START);
    assert_int_equal(score_sweep(&ground, &q, &hit, TAHR_E_BACKEND, &right, 1, 1e-9).failure, SCORE_ERROR);
    q.motion = (tahr_vec3){0, 0, -1};
    assert_true(score_solve(&ground, &q, &none));
    a = score_sweep(&ground, &q, &none, TAHR_OK, &right, 1, 1e-9);
    assert_true(a.failure == SCORE_FALSE_HIT && fabs(a.beyond - 0.49) < 1e-15);
    q = sphere_at(0, 0, 0.505); /* leaves: nothing blocks */
    q.motion = (tahr_vec3){0.5, 0, 0.5};
    assert_true(score_solve(&ground, &q, &none));
    assert_int_equal(score_sweep(&ground, &q, &none, TAHR_OK, &right, 1, 1e-9).failure, SCORE_FALSE_HIT);
}

/* A graze that goes 5e-7 m, 1e-5 m and 2e-3 m into the margin. */
static void hit_or_miss_counts_only_beyond_tau(void **state)
{
    static const double into[] = {5e-7, 1e-5, 2e-3};
    score_sweeps sum = {0};
    (void)state;

    for (int i = 0; i < 3; i++) {
        tahr_sweep q = sphere_at(0, 0, 1.51 - into[i]);
        score_truth t;
        q.motion = (tahr_vec3){0, 0, -1};
        assert_true(score_solve(&ground, &q, &t));
        score_answer a = score_sweep(&ground, &q, &t, TAHR_OK, NULL, 0, 1e-9);
        score_sweeps_add(&sum, &a);
    }
    assert_int_equal(sum.cases, 3);
    assert_int_equal(sum.misses[0], 2);
    assert_int_equal(sum.misses[1], 1);
    assert_int_equal(sum.failures[SCORE_MISS], 2);
    assert_int_equal(sum.gap.count, 0);
    assert_true(fabs(sum.deepest_miss - 2e-3) < 1e-12);
    score_sweeps_free(&sum);
}

static void sums_keep_late_and_early_and_leave_failures_out(void **state)
{
    static const score_answer answers[] = {{.failure = SCORE_FINE, .measured = 1, .gap_error = -3e-3},
                                           {.failure = SCORE_FINE, .measured = 1, .gap_error = 1e-3, .normal_error = 4},
                                           {.failure = SCORE_FALSE_HIT, .beyond = 1e-4, .gap_error = 7},
                                           {.failure = SCORE_FINE, .gap_error = 9}};
    score_sweeps sum = {0};
    (void)state;

    for (size_t i = 0; i < sizeof answers / sizeof *answers; i++) {
        score_sweeps_add(&sum, &answers[i]);
    }
    assert_true(sum.late == 3e-3 && sum.early == 1e-3 && sum.gap.max == 3e-3 && sum.normal.max == 4);
    assert_int_equal(sum.gap.count, 2);
    assert_int_equal(sum.false_hits[0], 1);
    assert_int_equal(sum.false_hits[1], 0);
    score_sweeps_free(&sum);
}

/* ---- Paths ---- */

/* 1 m/s along x for a second, then 2 m/s along y for a second. */
static const score_knot bend[] = {
    {0, {0, 0, 1}, {1, 0, 0}}, {1, {1, 0, 1}, {1, 0, 0}}, {1, {1, 0, 1}, {0, 2, 0}}, {2, {1, 2, 1}, {0, 2, 0}}};
static const score_reference bent = {bend, 4};

static score_step step_at(double time, double x, double y, double z)
{
    score_step s = {.time = time, .place = sphere_at(x, y, z)};
    return s;
}

static void references_are_exact_on_lines_and_parabolas(void **state)
{
    static const score_knot fall[] = {{0, {0, 0, 5}, {1, 0, 2}}, {2, {2, 0, 5 + 4 - 20}, {1, 0, 2 - 20}}};
    const score_reference thrown = {fall, 2};
    tahr_vec3 p = score_reference_at(&bent, 1.25);
    (void)state;

    assert_true(p.x == 1 && p.y == 0.5 && p.z == 1);
    p = score_reference_at(&bent, 0.5);
    assert_true(p.x == 0.5 && p.y == 0);
    p = score_reference_at(&bent, 1);
    assert_true(p.x == 1 && p.y == 0);
    p = score_reference_at(&bent, 7);
    assert_true(p.x == 1 && p.y == 2);
    p = score_reference_at(&bent, -1);
    assert_true(p.x == 0);
    p = score_reference_at(&thrown, 0.5); /* 5 + 2 t - 5 t^2 */
    assert_true(fabs(p.x - 0.5) < 1e-15 && fabs(p.z - 4.75) < 1e-14);
}

static void paths_are_as_far_off_as_they_were_put(void **state)
{
    const score_path_desc desc = {.reference = &bent};
    score_path path;
    score_step s = step_at(0, 0, 0, 1);
    (void)state;

    score_path_start(&path, &desc, &s);
    s = step_at(0.5, 0.5, 0, 1), s.queries = 2;
    score_path_add(&path, &s);
    s = step_at(1, 1, 0.3, 1), s.queries = 4;
    score_path_add(&path, &s);
    s = step_at(2, 1, 2, 1.4), s.queries = 9;
    score_path_add(&path, &s);
    assert_true(fabs(path.error.max - 0.4) < 1e-15 && fabs(path.end_error - 0.4) < 1e-15);
    assert_true(fabs(score_stat_rms(&path.error) - 0.5 / sqrt(3)) < 1e-15);
    assert_true(path.queries.max == 9 && score_stat_mean(&path.queries) == 5 && path.failed_steps == 0);
    assert_true(path.clearance == INFINITY && path.deepest == 0 && path.steps == 3 && path.duration == 2);
    score_path_free(&path);
}

static void clearance_and_depth_are_the_worst_of_all_steps(void **state)
{
    const score_path_desc desc = {.scene = &ground};
    score_path path;
    score_step s = step_at(0, 0, 0, 0.75);
    (void)state;

    score_path_start(&path, &desc, &s);
    assert_true(fabs(path.clearance - 0.25) < 1e-15);
    s = step_at(1, 0, 0, 0.375);
    score_path_add(&path, &s);
    s = step_at(2, 0, 0, 0.625);
    score_path_add(&path, &s);
    assert_true(fabs(path.clearance + 0.125) < 1e-15 && fabs(path.deepest - 0.125) < 1e-15);
    score_path_free(&path);
}

static void energy_out_of_nothing_is_found(void **state)
{
    const score_path_desc desc = {.gravity = {0, 0, -10}};
    score_path path;
    score_step s = step_at(0, 0, 0, 5);
    (void)state;

    score_path_start(&path, &desc, &s);
    s = step_at(0.1, 0, 0, 4), s.velocity.z = -sqrt(20); /* a fall keeps it */
    score_path_add(&path, &s);
    assert_true(path.energy_excess < 1e-14);
    s = step_at(0.2, 0, 0, 4), s.velocity.z = 0; /* a landing loses 10 J/kg */
    score_path_add(&path, &s);
    s = step_at(0.3, 0, 0, 4.5), s.velocity.x = 1; /* 5 of height and 0.5 of speed from nowhere */
    score_path_add(&path, &s);
    assert_true(fabs(path.energy_excess - 5.5) < 1e-12);
    s = step_at(0.4, 0, 0, 4.5), s.velocity.x = 3, s.work = 4; /* which was paid for */
    score_path_add(&path, &s);
    assert_true(fabs(path.energy_excess - 5.5) < 1e-12);
    score_path_free(&path);
}

static void flicker_and_creep_are_counted(void **state)
{
    static const double heights[] = {1, 1, 1, 1, 1 + 0x1p-20, 1, 1};
    const score_path_desc desc = {0};
    score_path path;
    score_step s = step_at(0, 0, 0, 2);
    (void)state;

    score_path_start(&path, &desc, &s);
    for (int i = 0; i < 7; i++) {
        s = step_at((i + 1) * 0.25, 0, 0, heights[i]);
        s.idle = 1;
        s.grounded = i % 2 == 0;
        score_path_add(&path, &s);
    }
    assert_int_equal(path.rest_changes, 2); /* steps 5 and 6 */
    assert_true(path.jitter == 0x1p-19);    /* up and down again */
    assert_int_equal(path.ground_flips, 7);
    assert_true(score_path_flips_per_second(&path) == 4);
    score_path_free(&path);
}

static void broken_steps_are_counted_and_never_averaged(void **state)
{
    const score_path_desc desc = {.reference = &bent, .scene = &ground};
    score_path path;
    score_step s = step_at(0, 0, 0, 1);
    (void)state;

    score_path_start(&path, &desc, &s);
    s = step_at(0.5, NAN, 0, 1);
    score_path_add(&path, &s);
    s = step_at(1, 1, 0, 1), s.failures = 1u << SCORE_CAP | 1u << SCORE_STUCK;
    score_path_add(&path, &s);
    assert_int_equal(path.failed_steps, 2);
    assert_int_equal(path.failures[SCORE_NOT_FINITE], 1);
    assert_int_equal(path.failures[SCORE_CAP], 1);
    assert_int_equal(path.failures[SCORE_STUCK], 1);
    assert_true(path.error.count == 1 && path.error.max < 1e-15 && fabs(path.clearance - 0.5) < 1e-15);
    score_path_free(&path);
}

static void steps_of_tahr_are_read_as_they_are(void **state)
{
    const tahr_shape box = {.type = TAHR_SHAPE_BOX, .half_height = 1, .half_x = 0.25, .half_y = 0.5};
    tahr_state character = {
        .position = {1, 2, 3}, .velocity = {4, 5, 6}, .mode = TAHR_MODE_WALKING, .half_height = 0.5};
    tahr_report report = {.flags = TAHR_REPORT_CRUSHED | TAHR_REPORT_UNKNOWN, .sweeps = 3, .rays = 1};
    score_step s = score_step_of(&character, &box, 7, TAHR_CRUSHED, &report);
    (void)state;

    assert_int_equal(s.failures, 1u << SCORE_CRUSHED | 1u << SCORE_UNKNOWN);
    assert_true(s.queries == 4 && s.grounded == 1 && s.time == 7 && s.place.position.y == 2 && s.velocity.z == 6);
    assert_true(s.place.shape.half_height == 0.5 && s.place.shape.half_x == 0.25 && s.place.motion.x == 0);
    assert_int_equal(score_step_of(&character, &box, 0, TAHR_E_BACKEND, NULL).failures, 1u << SCORE_ERROR);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quantiles_are_of_all_values_and_nothing_else),
        cmocka_unit_test(distance_is_that_of_each_shape),
        cmocka_unit_test(a_core_inside_of_a_solid_has_no_distance_from_it),
        cmocka_unit_test(normals_are_wrong_by_their_angle_to_the_cone),
        cmocka_unit_test(cones_of_three_hold_what_lies_within),
        cmocka_unit_test(truth_of_a_fall_is_found),
        cmocka_unit_test(truth_of_who_rests_meets_walls_but_no_seams),
        cmocka_unit_test(wrong_sweeps_are_wrong_by_as_much_as_they_are),
        cmocka_unit_test(failures_are_told_apart),
        cmocka_unit_test(hit_or_miss_counts_only_beyond_tau),
        cmocka_unit_test(sums_keep_late_and_early_and_leave_failures_out),
        cmocka_unit_test(references_are_exact_on_lines_and_parabolas),
        cmocka_unit_test(paths_are_as_far_off_as_they_were_put),
        cmocka_unit_test(clearance_and_depth_are_the_worst_of_all_steps),
        cmocka_unit_test(energy_out_of_nothing_is_found),
        cmocka_unit_test(flicker_and_creep_are_counted),
        cmocka_unit_test(broken_steps_are_counted_and_never_averaged),
        cmocka_unit_test(steps_of_tahr_are_read_as_they_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
