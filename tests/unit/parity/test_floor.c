/* SPDX-License-Identifier: MIT
 * test_floor.c: edge tolerance, floor sweep test, floor distance, find floor and height adjustment of
 * TAHR_FLOOR_PROBE_SHRUNK against numbers worked out by hand, in centimetres, with their queries. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "floor_distance.h"
#include "parity.h"

static const double DEGREE = 0.017453292519943295;

static void open_at(parity *p, const parity_scene *scene, int backend, const tahr_config *config, double z)
{
    parity_open(p, scene, backend, config, 0, 0, z);
    p->step.state.mode = TAHR_MODE_WALKING;
}

static void edge_tolerance_is_strict_and_ignores_height(void **unused)
{
    const struct {
        const char *id;
        double radius, x, y, z;
        int within;
    } rows[] = {{"E1", 34, 33.84, 0, 0, 1},   {"E2", 34, 33.849, 0, 0, 1}, {"E2", 34, 33.851, 0, 0, 0},
                {"E2", 34, 0, -33.849, 0, 1}, {"E2", 34, 0, 33.851, 0, 0}, {"E3", 34, 33.9, 0, 0, 0},
                {"E4", 0.2, 0.150, 0, 0, 1},  {"E4", 0.2, 0.151, 0, 0, 0}, {"E5", 34, 20, 20, 1000, 1},
                {"E5", 34, 20, 20, -1000, 1}};
    parity_scene empty = {0};
    parity_table t;
    parity p;
    (void)unused;
    parity_begin(&t, "edge tolerance");
    parity_open(&p, &empty, PARITY_FAKE, NULL, 5, -7, 88);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        vec3 point = parity_vec(5 + rows[i].x, -7 + rows[i].y, 88 + rows[i].z);
        parity_row(&t, rows[i].id, NULL);
        int within = tahr__is_within_edge_tolerance(&p.step, p.step.state.position, point, parity_cm(rows[i].radius));
        parity_count(&t, "within", (uint32_t)within, (uint32_t)rows[i].within);
        parity_count(&t, "queries", p.step.queries, 0);
    }
    parity_close(&p);
    parity_end(&t);
}

/* A ledge whose edge is `from` cm from the axis; azimuth: the direction toward it, in degrees. */
static void open_ledge(parity *p, int backend, const tahr_config *config, double from, double azimuth)
{
    parity_scene scene = {0};
    parity_solid *ledge = parity_box(&scene, fake_vec(from, -100, -50), fake_vec(from + 200, 100, -5));
    ledge->flags = TAHR_BODY_MOVABLE;
    open_at(p, &scene, backend, config, 88);
    if (azimuth != 0) {
        double a = azimuth * DEGREE, out = from + 100;
        tahr_body_pose pose = {.body = 0,
                               .pose = {.position = parity_vec(out * cos(a), out * sin(a), -27.5),
                                        .orientation = {0, 0, sin(0.5 * a), cos(0.5 * a)}}};
        assert_int_equal(tahr_world_set(p->world, &pose, 1), TAHR_OK);
    }
}

static void floor_sweep_turns_the_flat_base_before_it_gives_up(void **unused)
{
    const struct {
        const char *id;
        int flat;
        double from, azimuth;
        int met;
        uint32_t queries;
    } rows[] = {{"G1", 0, -50, 0, 1, 1}, {"G1", 1, -50, 0, 1, 1}, {"G2", 1, 33.9, 0, 1, 1},
                {"G3", 1, 30, 45, 1, 2}, {"G3", 1, 24, 45, 1, 1}, {"G4", 1, 34.05, 0, 0, 2}};
    parity_table t;
    (void)unused;
    parity_begin(&t, "floor sweep test");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        for (int backend = PARITY_NATIVE; backend < PARITY_BACKENDS; backend++) {
            parity p;
            tahr_hit hit;
            tahr_config c = parity_config();
            c.flat_base = (uint32_t)rows[i].flat;
            if (!parity_has(backend)) {
                continue;
            }
            open_ledge(&p, backend, &c, rows[i].from, rows[i].azimuth);
            tahr__foot whole = {p.step.limits->shape, 0};
            parity_row(&t, rows[i].id, parity_backend_name(backend));
            int met = tahr__floor_sweep_test(&p.step, &whole, p.step.state.position, parity_cm(10), &hit);
            parity_count(&t, "met", (uint32_t)met, (uint32_t)rows[i].met);
            parity_count(&t, "queries", p.step.queries, rows[i].queries);
            if (met) {
                parity_number(&t, "fraction", hit.fraction, 0.5, 1e-4);
            }
            parity_close(&p);
        }
    }
    parity_end(&t);
}

/* What of a scene matters to a floor distance. The base of the shape is at z = 0. */
typedef struct distance_row {
    const char *id;
    double tilt, gap;        /* a plane: degrees, and cm below the base on the axis */
    double edge, top;        /* a ledge from there on, this high; 0: none */
    double wall;             /* x of a wall that faces the character; 0: none */
    double distance, impact; /* cm; impact < 0: not asked */
    uint32_t flags, queries; /* of BLOCKING, WALKABLE, LINE */
} distance_row;

static void make_scene(const distance_row *row, parity_scene *scene)
{
    memset(scene, 0, sizeof *scene);
    if (row->gap < 1e3) {
        double a = row->tilt * DEGREE;
        parity_plane(scene, sin(a), 0, cos(a), -row->gap * cos(a));
    }
    if (row->edge != 0) {
        parity_box(scene, fake_vec(row->edge, -300, -400), fake_vec(row->edge + 300, 300, row->top));
    }
    if (row->wall != 0) {
        parity_plane(scene, -1, 0, 0, -row->wall);
    }
}

static void floor_distance_in_three_stages(void **unused)
{
    enum { B = TAHR_FLOOR_BLOCKING, W = TAHR_FLOOR_WALKABLE, FLOOR = B | W };
    const distance_row rows[] = {
        {"D1", 0, 2.15, 0, 0, 0, 2.15, -1, FLOOR, 1},
        {"D2", 30, 10, 0, 0, 0, 4.74018, 17, FLOOR, 1},
        {"D3", 44, 20, 0, 0, 0, 6.73444, 23.6184, FLOOR, 1},
        {"D4", 0, 20, 33.9, 20, 0, 20, -1, FLOOR, 2},
        {"D5", 0, 2.15, 0, 0, 33.98, 2.15, -1, FLOOR, 2},
        {"D6", 0, -3, 0, 0, 0, -3, -1, FLOOR, 1},
        {"D6", 0, -10, 0, 0, 0, -10, -1, FLOOR, 2},
        {"D6", 0, -45, 0, 0, 0, -34, -1, FLOOR, 2}, /* 48.6 > 45: found, and cut at the radius */
        {"D8", 0, 1e9, 0, 0, 0, 47.4001, -1, 0, 1},
        {"D9", 60, 40, 0, 0, 0, 6, 29.4449, B, 2},
    };
    parity_table t;
    (void)unused;
    parity_begin(&t, "floor distance");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        for (int backend = 0; backend < PARITY_BACKENDS; backend++) {
            double tolerance = parity_tolerance(backend);
            parity_scene scene;
            tahr_floor floor;
            parity p;
            if (!parity_has(backend)) {
                continue;
            }
            make_scene(&rows[i], &scene);
            open_at(&p, &scene, backend, NULL, 88);
            tahr__floor_look look = {p.step.state.position, parity_cm(47.4001), parity_cm(47.4001), parity_cm(34),
                                     NULL};
            parity_row(&t, rows[i].id, parity_backend_name(backend));
            tahr__compute_floor_distance(&p.step, &look, &floor);
            parity_length(&t, "distance", floor.distance, rows[i].distance, tolerance);
            parity_count(&t, "flags", floor.flags & (B | W | TAHR_FLOOR_LINE), rows[i].flags);
            parity_count(&t, "queries", p.step.queries, rows[i].queries);
            if (rows[i].impact >= 0) {
                parity_length(&t, "impact off the axis", hypot(floor.point.x, floor.point.y), rows[i].impact,
                              10 * tolerance);
            }
            parity_close(&p);
        }
    }
    parity_end(&t);
}

static void supplied_sweep_counts_if_it_went_straight_down(void **unused)
{
    const struct {
        const char *id;
        double down, tilt, off; /* cm that the supplied sweep went; aside; cm of its impact off the axis */
        uint32_t overlap, queries;
        double distance;
    } rows[] = {{"D7", 20, 0, 0, 0, 0, 4},       {"D7", 0, 0, 0, 0, 1, 2.15},   {"D7", -20, 0, 0, 0, 1, 2.15},
                {"D7", 20, 0.02, 0, 0, 1, 2.15}, {"D7", 20, 0.009, 0, 0, 0, 4}, {"D7", 20, 0, 33.9, 0, 1, 2.15},
                {"D7", 20, 0, 33.8, 0, 0, 4},    {"D7", 20, 0, 0, 1, 1, 2.15}};
    parity_table t;
    (void)unused;
    parity_begin(&t, "supplied sweep");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        parity_scene scene = {0};
        tahr_floor floor;
        parity p;
        parity_plane(&scene, 0, 0, 1, -2.15);
        open_at(&p, &scene, PARITY_FAKE, NULL, 88);
        tahr_hit hit = {.blocking = 1, .start_overlap = rows[i].overlap, .normal = {0, 0, 1}};
        hit.surface_normal = hit.normal;
        hit.point = parity_vec(rows[i].off, 0, -4);
        tahr__supplied supplied = {&hit, parity_vec(rows[i].tilt, 0, -rows[i].down), parity_vec(0, 0, 84)};
        tahr__floor_look look = {p.step.state.position, parity_cm(47.4001), parity_cm(47.4001), parity_cm(34),
                                 &supplied};
        parity_row(&t, rows[i].id, NULL);
        tahr__compute_floor_distance(&p.step, &look, &floor);
        parity_length(&t, "distance", floor.distance, rows[i].distance, 1e-4);
        parity_count(&t, "walkable", (uint32_t)floor_is_walkable(&floor), 1);
        parity_count(&t, "queries", p.step.queries, rows[i].queries);
        parity_close(&p);
    }
    parity_end(&t);
}

static void find_floor_reaches_a_step_and_the_band(void **unused)
{
    const struct {
        const char *id;
        uint32_t mode;
        double gap; /* >= 1e3: nothing below */
        double distance;
        int walkable;
    } rows[] = {{"F1", TAHR_MODE_WALKING, 2.15, 2.15, 1},   {"F1", TAHR_MODE_FALLING, 2.15, 2.15, 1},
                {"F1", TAHR_MODE_WALKING, 1e9, 47.4001, 0}, {"F1", TAHR_MODE_FALLING, 1e9, 42.6, 0},
                {"F5", TAHR_MODE_WALKING, 47.4, 47.4, 1},   {"F5", TAHR_MODE_WALKING, 47.41, 47.4001, 0},
                {"F5", TAHR_MODE_FALLING, 42.59, 42.59, 1}, {"F5", TAHR_MODE_FALLING, 42.61, 42.6, 0}};
    parity_table t;
    (void)unused;
    parity_begin(&t, "find floor");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        for (int backend = 0; backend < PARITY_BACKENDS; backend++) {
            parity_scene scene = {0};
            tahr_floor floor;
            parity p;
            if (!parity_has(backend)) {
                continue;
            }
            if (rows[i].gap < 1e3) {
                parity_plane(&scene, 0, 0, 1, 0);
            }
            open_at(&p, &scene, backend, NULL, 88 + (rows[i].gap < 1e3 ? rows[i].gap : 0));
            p.step.state.mode = rows[i].mode;
            parity_row(&t, rows[i].id, parity_backend_name(backend));
            tahr__find_floor(&p.step, p.config.snap_distance, NULL, &floor);
            parity_length(&t, "distance", floor.distance, rows[i].distance,
                          rows[i].gap < 1e3 ? parity_tolerance(backend) : 1e-9); /* a sum of settings */
            parity_count(&t, "walkable", (uint32_t)floor_is_walkable(&floor), (uint32_t)rows[i].walkable);
            parity_count(&t, "queries", p.step.queries, 1);
            parity_close(&p);
        }
    }
    parity_end(&t);
}

static void floor_is_looked_for_again_only_where_it_may_have_changed(void **unused)
{
    const struct {
        const char *id;
        uint32_t cached, flags; /* config.cached_floor; of the body */
        int force, displaced, touched, teleported, lost;
        uint32_t queries;
    } rows[] = {
        {"F2", 1, 0, 0, 0, 0, 0, 0, 0}, {"F2", 0, 0, 0, 0, 0, 0, 0, 1}, {"F2", 1, TAHR_BODY_MOVABLE, 0, 0, 0, 0, 0, 1},
        {"F2", 1, 0, 1, 0, 0, 0, 0, 1}, {"F2", 1, 0, 0, 1, 0, 0, 0, 1}, {"F2", 1, 0, 0, 0, 1, 0, 0, 1},
        {"F2", 1, 0, 0, 0, 0, 1, 0, 1}, {"F2", 1, 0, 0, 0, 0, 0, 1, 1}};
    parity_table t;
    (void)unused;
    parity_begin(&t, "cached floor");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        parity_scene scene = {0};
        tahr_config c = parity_config();
        tahr_floor floor;
        parity p;
        c.cached_floor = rows[i].cached;
        parity_box(&scene, fake_vec(-300, -300, -40), fake_vec(300, 300, -2.15))->flags = rows[i].flags;
        open_at(&p, &scene, PARITY_NATIVE, &c, 88);
        tahr__step *s = &p.step;
        parity_row(&t, rows[i].id, NULL);
        tahr__find_floor(s, c.snap_distance, NULL, &floor);
        parity_count(&t, "queries of the first look", s->queries, 1);
        tahr__keep_floor(s, &floor);
        s->queries = 0;
        s->state.flags |= rows[i].force ? TAHR_STATE_FLOOR_MOVED : 0u;
        s->state.position.x += rows[i].displaced ? 0.01 : 0;
        s->just_teleported = (uint32_t)rows[i].teleported;
        s->state.floor.flags &= rows[i].lost ? ~(uint32_t)TAHR_FLOOR_WALKABLE : ~0u;
        if (rows[i].touched) {
            assert_int_equal(tahr_world_touch(p.world), TAHR_OK);
        }
        tahr__find_floor(s, c.snap_distance, NULL, &floor);
        parity_count(&t, "queries", s->queries, rows[i].queries);
        parity_length(&t, "distance", floor.distance, 2.15, 1e-3);
        tahr__keep_floor(s, &floor);
        parity_true(&t, "force flag cleared", !(s->state.flags & TAHR_STATE_FLOOR_MOVED));
        parity_close(&p);
    }
    parity_end(&t);
}

static void height_is_put_right_outside_the_band(void **unused)
{
    const struct {
        const char *id;
        double gap;            /* of the plane z = 0 below the base */
        double ceiling;        /* above the head; 0: none */
        double distance, line; /* of the state's floor; line > 0: found by a ray */
        double moved, after;   /* cm up; distance afterwards */
        uint32_t queries;
        int teleported;
        uint32_t slope_speed; /* 1: config.keep_level_speed off */
    } rows[] = {{"A1", 1, 0, 1, 0, 1.15, 2.15, 1, 0, 0},
                {"A1", 1, 0, 1, 0, 1.15, 2.15, 1, 1, 1},
                {"A2", 1.9, 0, 1.9, 0, 0, 1.9, 0, 0, 0},
                {"A3", 2.4, 0, 2.4, 0, 0, 2.4, 0, 0, 0},
                {"A4", 2.5, 0, 2.5, 0, -0.35, 2.15, 1, 0, 0},
                {"A5", -3, 0, -3, 0, 5.15, 2.15, 1, 1, 0},
                {"A6", 1, 0.5, 1, 0, 0.38385, 1.38385, 1, 0, 0},
                {"A7", 1, 0, 1, 5, 0, 1, 0, 0, 0},
                {"A7", 5, 0, 3, 5, -2.85, 0.15, 1, 0, 0},
                {"A7", 5, 0, 2, 5, -2.85, -0.85, 1, 0, 0}, /* in the band, were it not for the ray */
                /* A floor in the way down: contact after 2 of 2.85, from there 0.101 of 2.85 taken back. */
                {"A7", 2, 0, 3, 5, -1.71215, 0.28785, 1, 0, 0}};
    parity_table t;
    (void)unused;
    parity_begin(&t, "height adjustment");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        for (int backend = 0; backend < PARITY_BACKENDS; backend++) {
            double tolerance = parity_tolerance(backend), z = 88 + rows[i].gap;
            parity_scene scene = {0};
            parity p;
            if (!parity_has(backend)) {
                continue;
            }
            parity_plane(&scene, 0, 0, 1, 0);
            if (rows[i].ceiling > 0) {
                parity_plane(&scene, 0, 0, -1, -(z + 88 + rows[i].ceiling));
            }
            tahr_config c = parity_config();
            c.keep_level_speed = !rows[i].slope_speed;
            open_at(&p, &scene, backend, &c, z);
            parity_floor(&p, rows[i].distance, vec(0, 0, 1),
                         TAHR_FLOOR_BLOCKING | TAHR_FLOOR_WALKABLE | (rows[i].line > 0 ? TAHR_FLOOR_LINE : 0u));
            p.step.state.floor.perch_distance = parity_cm(rows[i].line);
            parity_row(&t, rows[i].id, parity_backend_name(backend));
            parity_true(&t, "a ray's floor is in no band", rows[i].line == 0 || !floor_is_in_band(&p.step));
            double height = tahr__adjust_height(&p.step);
            parity_length(&t, "height", height, rows[i].moved, tolerance);
            parity_length(&t, "z", p.step.state.position.z, z + rows[i].moved, tolerance);
            parity_length(&t, "distance", p.step.state.floor.distance, rows[i].after, tolerance);
            parity_count(&t, "queries", p.step.queries, rows[i].queries);
            parity_count(&t, "just teleported", p.step.just_teleported, (uint32_t)rows[i].teleported);
            parity_true(&t, "looks again after a change",
                        ((p.step.state.flags & TAHR_STATE_FLOOR_MOVED) != 0) == (rows[i].moved != 0));
            parity_close(&p);
        }
    }
    parity_end(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(edge_tolerance_is_strict_and_ignores_height),
                                       cmocka_unit_test(floor_sweep_turns_the_flat_base_before_it_gives_up),
                                       cmocka_unit_test(floor_distance_in_three_stages),
                                       cmocka_unit_test(supplied_sweep_counts_if_it_went_straight_down),
                                       cmocka_unit_test(find_floor_reaches_a_step_and_the_band),
                                       cmocka_unit_test(floor_is_looked_for_again_only_where_it_may_have_changed),
                                       cmocka_unit_test(height_is_put_right_outside_the_band)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
