/* SPDX-License-Identifier: MIT
 * test_slides.c: bending a motion in the unreal preset, row by row in centimetres: TwoWallAdjust of the base (T)
 * and of a character on the ground (U), SlideAlongSurface of the base (S) and of a character (C). */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"
#include "parity.h"
#include "slide.h"

/* Slopes of the table: 30 and 60 degrees, rising toward +x. */
#define N30                         \
    {                               \
        -0.5, 0, 0.8660254037844386 \
    }
#define N60                         \
    {                               \
        -0.8660254037844386, 0, 0.5 \
    }
#define DIAGONAL                                   \
    {                                              \
        -0.7071067811865476, 0.7071067811865476, 0 \
    }

static tahr_hit hit_of(vec3 normal, double fraction)
{
    tahr_hit hit = {.blocking = 1, .fraction = fraction, .normal = normal, .surface_normal = normal};
    hit.body = TAHR_NO_BODY;
    return hit;
}

static void open_empty(parity *p)
{
    parity_scene empty = {.count = 0};
    parity_open(p, &empty, PARITY_FAKE, NULL, 0, 0, 0);
}

static const uint32_t STANDING = TAHR_FLOOR_BLOCKING | TAHR_FLOOR_WALKABLE | TAHR_FLOOR_FACE;

typedef struct wall_row {
    const char *id;
    uint32_t mode;
    vec3 delta, normal;
    double time;
    vec3 old, expected;
    double floor, tolerance; /* 0: no floor; 1e-4 */
} wall_row;

static void run_wall_rows(const wall_row *rows, size_t count, const char *name)
{
    parity_table t;
    parity p;
    parity_begin(&t, name);
    open_empty(&p);
    for (size_t i = 0; i < count; i++) {
        const wall_row *r = &rows[i];
        tahr_hit hit = hit_of(r->normal, r->time);
        parity_put(&p, 0, 0, 0);
        p.step.state.mode = r->mode;
        if (r->floor > 0) {
            parity_floor(&p, r->floor, vec(0, 0, 1), STANDING);
        }
        vec3 bent = tahr__two_wall_adjust(&p.step, scale(r->delta, 0.01), &hit, r->old);
        parity_row(&t, r->id, NULL);
        parity_vector(&t, "motion", bent, r->expected.x, r->expected.y, r->expected.z,
                      r->tolerance > 0 ? r->tolerance : 1e-4);
        parity_count(&t, "queries", p.step.queries, 0);
    }
    parity_close(&p);
    parity_end(&t);
}

static void two_wall_base_rows(void **unused)
{
    static const wall_row rows[] = {
        {"T1", TAHR_MODE_FLYING, {10, 10, -5}, {0, -1, 0}, 0.25, {-1, 0, 0}, {0, 0, -3.75}, 0, 0},
        {"T2", TAHR_MODE_FLYING, {10, 4, 0}, {-0.5, -0.8660254, 0}, 0, {-1, 0, 0}, {5.76795, -3.33013, 0}, 0, 0},
        {"T3", TAHR_MODE_FLYING, {10, 2, 6}, {0.5, -0.8660254, 0}, 0.5, {-1, 0, 0}, {0, 0, 3}, 0, 0},
        {"T4", TAHR_MODE_FLYING, {0, 10, 0}, {-0.7071068, -0.7071068, 0}, 0.5, {-1, 0, 0}, {-2.5, 2.5, 0}, 0, 0},
        {"T5", TAHR_MODE_FLYING, {3, 10, 0}, {-1, 0, 0}, 0.2, {-1, 0, 0}, {-0.01, 8, 0}, 0, 0},
        {"T6", TAHR_MODE_FLYING, {10, 0, 0}, {-1, 0, 0}, 0, {-1, 0, 0}, {0, 0, 0}, 0, 0}};
    (void)unused;
    run_wall_rows(rows, sizeof rows / sizeof rows[0], "TwoWallAdjust, base");
}

static void two_wall_character_rows(void **unused)
{
    static const wall_row rows[] = {
        {"U1", TAHR_MODE_WALKING, {20, 0, 0}, N30, 0.25, {-0.6, -0.8, 0}, {15, 0, 8.66025}, 2.15, 0},
        {"U1", TAHR_MODE_FLYING, {20, 0, 0}, N30, 0.25, {-0.6, -0.8, 0}, {11.25, 0, 6.49519}, 2.15, 0},
        {"U2", TAHR_MODE_WALKING, {20, 5, 0}, N60, 0.25, {-0.6, -0.8, 0}, {3.75, 3.75, 0}, 2.15, 0},
        {"U3", TAHR_MODE_WALKING, {20, 5, -8}, {-0.8, 0, -0.6}, 0, {-0.6, -0.8, 0}, {11.04, 5, 0}, 1.5, 0},
        {"U4", TAHR_MODE_WALKING, {20, 5, -8}, {-0.8, 0, -0.6}, 0, {-0.6, -0.8, 0}, {11.04, 5, -14.72}, 2.15, 0},
        {"U5",
         TAHR_MODE_WALKING,
         {80, 0, 0},
         {-0.7042016756583302, 0, 0.71},
         0,
         {-0.6, -0.8, 0},
         {45.3705, 0, 45},
         2.15,
         1e-3},
        {"U6", TAHR_MODE_FLYING, {20, 5, 0}, N60, 0.25, {-0.6, -0.8, 0}, {3.75, 3.75, 6.49519}, 2.15, 0},
        {"U6", TAHR_MODE_FALLING, {20, 5, 0}, N60, 0.25, {-0.6, -0.8, 0}, {0, 3.75, 0}, 2.15, 0}};
    (void)unused;
    run_wall_rows(rows, sizeof rows / sizeof rows[0], "TwoWallAdjust, character");
}

/* An edge met from the side has an upright contact normal and a walkable face: it is no ramp to go up along. */
static void an_upright_contact_of_a_walkable_face_is_no_ramp(void **unused)
{
    tahr_hit hit = hit_of(unit(vec(-1, 0, 0.00005)), 0);
    parity p;
    (void)unused;
    open_empty(&p);
    p.step.state.mode = TAHR_MODE_WALKING;
    parity_floor(&p, 2.15, vec(0, 0, 1), STANDING);
    hit.surface_normal = vec(0, 0, 1);
    vec3 bent = tahr__two_wall_adjust(&p.step, parity_vec(20, 5, 0), &hit, vec(-0.6, -0.8, 0));
    assert_near(bent.x, 0, 1e-8);
    assert_near(bent.y, 0.05, 1e-8);
    assert_near(bent.z, 0, 0);
    parity_close(&p);
}

/* Answers of sweeps, one after the other; fraction 2: free. */
typedef struct script {
    struct {
        double fraction;
        vec3 normal;
    } answers[4];
    uint32_t asked;
} script;

static tahr_status scripted_sweep(void *user, const tahr_sweep *query, tahr_hit *hit)
{
    script *s = user;
    (void)query;
    assert_true(s->asked < 4);
    double fraction = s->answers[s->asked].fraction;
    if (fraction <= 1) {
        hit->blocking = 1;
        hit->fraction = fraction;
        hit->normal = s->answers[s->asked].normal;
    }
    s->asked++;
    return TAHR_OK;
}

static void slide_base_rows(void **unused)
{
    parity_table t;
    parity p;
    tahr__swept swept = {.hit = hit_of((vec3)DIAGONAL, 0.25)};
    (void)unused;
    parity_begin(&t, "SlideAlongSurface, base");
    for (int backend = 0; backend < PARITY_BACKENDS; backend++) { /* the wall that it slides along is there */
        parity_scene wall = {.count = 0};
        if (!parity_has(backend)) {
            continue;
        }
        parity_plane(&wall, -1, 1, 0, -34.5);
        parity_open(&p, &wall, backend, NULL, 0, 0, 0);
        parity_row(&t, "S1", parity_backend_name(backend));
        swept.hit = hit_of((vec3)DIAGONAL, 0.25);
        double part = tahr__slide_along_surface(&p.step, parity_vec(10, 0, 0), 0.75, swept.hit.normal, &swept);
        parity_number(&t, "part", part, 1, 1e-12);
        parity_vector(&t, "position", p.step.state.position, 3.75, 3.75, 0, parity_tolerance(backend));
        parity_count(&t, "queries", p.step.queries, 1);
        parity_close(&p);
    }
    open_empty(&p);
    parity_row(&t, "S2", NULL);
    swept.hit = hit_of((vec3)DIAGONAL, 1);
    swept.hit.blocking = 0;
    parity_number(&t, "part", tahr__slide_along_surface(&p.step, parity_vec(10, 0, 0), 0.75, swept.hit.normal, &swept),
                  0, 0);
    parity_count(&t, "queries", p.step.queries, 0);
    parity_row(&t, "S3", NULL);
    swept.hit = hit_of(vec(-1, 0, 0), 0.25);
    parity_number(&t, "part", tahr__slide_along_surface(&p.step, parity_vec(10, 0, 0), 0.75, vec(-1, 0, 0), &swept), 0,
                  0);
    parity_count(&t, "queries", p.step.queries, 0);
    parity_vector(&t, "position", p.step.state.position, 0, 0, 0, 0);
    parity_close(&p);
    parity_end(&t);
}

/* The slide of (10, 10, 0) along a wall that faces -x is 10 cm along y: its pull-back is 0.101. Of the 6 cm left a
 * second wall, 60 degrees to the first one, leaves 5.2 cm: its pull-back is 0.101 again. */
static void slide_into_a_second_wall_row(void **unused)
{
    script s = {.answers = {{0.501, {-0.8660254037844386, -0.5, 0}}, {0.601, {-1, 0, 0}}}};
    tahr_callbacks callbacks = {.struct_size = sizeof callbacks, .user = &s, .sweep = scripted_sweep};
    tahr__swept swept = {.hit = hit_of(vec(-1, 0, 0), 0)};
    parity_table t;
    parity p;
    (void)unused;
    parity_begin(&t, "SlideAlongSurface, second wall");
    parity_open_callbacks(&p, &callbacks, NULL);
    p.step.state.velocity = vec(1, 1, 0);
    parity_row(&t, "S4", NULL);
    double part = tahr__slide_along_surface(&p.step, parity_vec(10, 10, 0), 1, vec(-1, 0, 0), &swept);
    parity_number(&t, "part", part, 0.4 + 0.5 * 0.6, 1e-9);
    parity_count(&t, "queries", p.step.queries, 2);
    /* (0, 6, 0) - n (n . (0, 6, 0)) = (-2.598, 4.5, 0) */
    parity_vector(&t, "position", p.step.state.position, -0.5 * 2.598076, 4 + 0.5 * 4.5, 0, 1e-4);
    parity_count(&t, "hits told", p.step.report.event_count, 2);
    parity_number(&t, "speed into the first", p.events[0].value, 0.5 + 0.8660254037844386, 1e-12);
    parity_row(&t, "S4", "a second wall that leads back");
    s.asked = 0;
    s.answers[0].normal = vec(-0.5, -0.8660254037844386, 0);
    swept.hit = hit_of(vec(-1, 0, 0), 0);
    parity_put(&p, 0, 0, 0);
    part = tahr__slide_along_surface(&p.step, parity_vec(10, 10, 0), 1, vec(-1, 0, 0), &swept);
    parity_number(&t, "part", part, 0.4, 1e-9);
    parity_count(&t, "queries", p.step.queries, 1);
    parity_close(&p);
    parity_end(&t);
}

static void slide_in_the_air_rows(void **unused)
{
    static const struct {
        vec3 delta, expected;
    } rows[] = {{{10, 0, -3}, {0, 0, 0}}, {{10, 0, 2}, {1.1547, 0, 2}}, {{1, 0, -10}, {-4.08013, 0, -7.06699}}};
    const vec3 n60 = N60;
    parity_table t;
    parity p;
    (void)unused;
    parity_begin(&t, "SlideAlongSurface, falling");
    open_empty(&p);
    p.step.state.mode = TAHR_MODE_FALLING;
    parity_row(&t, "S5", NULL);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        vec3 e = rows[i].expected;
        vec3 slide = tahr__slide_vector(&p.step, scale(rows[i].delta, 0.01), 1, n60);
        parity_vector(&t, "slide", slide, e.x, e.y, e.z, 1e-4);
    }
    /* Under an overhang it rises less than asked: nothing to take away. */
    parity_vector(&t, "slide", tahr__slide_vector(&p.step, parity_vec(10, 0, 10), 1, vec(-0.8, 0, -0.6)), -1.2, 0, 1.6,
                  1e-9);
    parity_count(&t, "queries", p.step.queries, 0);
    parity_close(&p);
    parity_end(&t);
}

static void slide_character_rows(void **unused)
{
    static const struct {
        const char *id;
        vec3 delta, normal;
        double distance;
        vec3 floor, expected;
    } rows[] = {{"C1", {10, 5, 0}, N60, 2.15, {0, 0, 1}, {-1, 0, 0}},
                {"C2", {10, 0, 0}, {-0.6, 0.3, -0.5}, 1.5, {0, 0, 1}, {-0.894427, 0.447214, 0}},
                {"C2", {10, 0, -1}, {-0.6, 0.3, -0.5}, 1.5, {0, 0, 1}, {-0.894427, 0.447214, 0}},
                {"C3", {-10, 0, 0}, {-0.6, 0.3, -0.5}, 1.5, N30, {-0.894427, 0.447214, 0}}, /* not against the floor */
                {"C3", {10, 0, 0}, {-0.8, 0.6, 0}, 1.5, N30, {-0.8, 0.6, 0}},               /* upright */
                {"C3", {10, 0, 0}, {-0.6, 0.3, -0.5}, 1.5, N30, {-1, 0, 0}},
                {"C4", {10, 0, 0}, {-0.6, 0.3, -0.5}, 2.15, {0, 0, 1}, {-0.717137, 0.358569, -0.597614}}};
    parity_table t;
    parity p;
    (void)unused;
    parity_begin(&t, "SlideAlongSurface, character");
    open_empty(&p);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        vec3 e = rows[i].expected, n = unit(rows[i].normal), delta = scale(rows[i].delta, 0.01);
        tahr_hit hit = hit_of(n, 0.5);
        parity_put(&p, 0, 0, 0);
        p.step.state.mode = TAHR_MODE_WALKING;
        parity_floor(&p, rows[i].distance, rows[i].floor, STANDING);
        parity_row(&t, rows[i].id, NULL);
        parity_vector(&t, "normal / 100", scale(tahr__slide_normal(&p.step, delta, n, &hit), 0.01), e.x, e.y, e.z,
                      1e-6);
        parity_count(&t, "queries", p.step.queries, 0);
        /* What it slides along is what it moves along: level in all but the last. */
        tahr__swept swept = {.hit = hit};
        vec3 slide = scale(sub(rows[i].delta, scale(e, dot(rows[i].delta, e))), 0.5);
        double part = tahr__slide_along_surface(&p.step, delta, 0.5, n, &swept);
        int goes = dot(slide, rows[i].delta) > 1e-3; /* C3: the wall is head-on */
        parity_number(&t, "part", part, goes, 1e-12);
        parity_count(&t, "queries of the slide", p.step.queries, (uint32_t)goes);
        parity_vector(&t, "position", p.step.state.position, goes ? slide.x : 0, goes ? slide.y : 0, goes ? slide.z : 0,
                      1e-4);
        p.step.state.mode = TAHR_MODE_FLYING;
        parity_vector(&t, "normal / 100 of the base", scale(tahr__slide_normal(&p.step, delta, n, &hit), 0.01), n.x,
                      n.y, n.z, 1e-9);
    }
    parity_close(&p);
    parity_end(&t);
}

/* Constrained to y = 0 the slide along a wall that would lead out of it is the one along the wall's trace in it. */
static void plane_constraint_flattens_the_slide(void **unused)
{
    parity p;
    (void)unused;
    open_empty(&p);
    parity_hold_to(&p, vec(0, 1, 0));
    vec3 slide = tahr__slide_vector(&p.step, vec(1, 0, -1), 1, unit(vec(-1, 5, 2)));
    vec3 trace = unit(vec(2, 0, 1)); /* across (-1, 0, 2) */
    vec3 expected = scale(trace, dot(vec(1, 0, -1), trace));
    assert_true(length(sub(slide, expected)) < 1e-15);
    parity_close(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(two_wall_base_rows),
                                       cmocka_unit_test(two_wall_character_rows),
                                       cmocka_unit_test(an_upright_contact_of_a_walkable_face_is_no_ramp),
                                       cmocka_unit_test(slide_base_rows),
                                       cmocka_unit_test(slide_into_a_second_wall_row),
                                       cmocka_unit_test(slide_in_the_air_rows),
                                       cmocka_unit_test(slide_character_rows),
                                       cmocka_unit_test(plane_constraint_flattens_the_slide)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
