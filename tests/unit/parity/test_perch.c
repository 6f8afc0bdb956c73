/* SPDX-License-Identifier: MIT
 * test_perch.c: perch radius, perch test, perch floor and the floor with a perch of TAHR_FLOOR_PROBE_SHRUNK
 * against numbers worked out by hand, in centimetres, with their queries. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "floor_distance.h"
#include "parity.h"
#include "perch.h"

static const parity_scene nothing;

/* The foot rests on an edge 25 cm off its axis: its cap is 34 - sqrt(34^2 - 25^2) = 10.9566 above its end there. */
static const double EDGE = 25, ABOVE = 10.9566;

static void perch_radius_leaves_a_ring(void **unused)
{
    const struct {
        const char *id;
        double threshold, radius;
    } rows[] = {{"P1", 0, 34}, {"P2", 15, 19}, {"P3", 33.95, 0.11}, {"P4", 40, 0.11}, {"P5", -5, 34}};
    parity_table t;
    parity p;
    (void)unused;
    parity_begin(&t, "perch radius");
    parity_open(&p, &nothing, PARITY_FAKE, NULL, 0, 0, 88);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        p.config.perch_threshold = parity_cm(rows[i].threshold);
        parity_row(&t, rows[i].id, NULL);
        parity_length(&t, "radius", tahr__valid_perch_radius(&p.step), rows[i].radius, 1e-4);
        parity_count(&t, "queries", p.step.queries, 0);
    }
    parity_close(&p);
    parity_end(&t);
}

static void perch_is_asked_for_in_the_ring_only(void **unused)
{
    const struct {
        const char *id;
        double threshold, off;
        uint32_t flags;
        int check_radius, should;
    } rows[] = {{"H1", 15, 18.9, TAHR_FLOOR_BLOCKING, 1, 0}, {"H2", 15, 19, TAHR_FLOOR_BLOCKING, 1, 0},
                {"H3", 15, 19.1, TAHR_FLOOR_BLOCKING, 1, 1}, {"H3", 15, 19.1, 0, 1, 0},
                {"H4", 0.15, 30, TAHR_FLOOR_BLOCKING, 1, 0}, {"H4", 0.15, 30, TAHR_FLOOR_BLOCKING, 0, 0},
                {"H5", 15, 18.9, TAHR_FLOOR_BLOCKING, 0, 1}};
    parity_table t;
    parity p;
    (void)unused;
    parity_begin(&t, "perch test");
    parity_open(&p, &nothing, PARITY_FAKE, NULL, 3, 0, 88);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        tahr_floor floor = {.flags = rows[i].flags, .point = parity_vec(3, rows[i].off, -500)};
        p.config.perch_threshold = parity_cm(rows[i].threshold);
        if (rows[i].threshold == 0.15) { /* the bound itself, however 0.15 cm is rounded to metres */
            p.config.perch_threshold = p.config.edge_tolerance;
        }
        parity_row(&t, rows[i].id, NULL);
        int should = tahr__should_compute_perch(&p.step, &floor, p.step.state.position, rows[i].check_radius);
        parity_count(&t, "should", (uint32_t)should, (uint32_t)rows[i].should);
        parity_count(&t, "queries", p.step.queries, 0);
    }
    parity_close(&p);
    parity_end(&t);
}

/* A ledge whose edge is EDGE from the axis, its top at z = 0, and a floor `below` it; >= 1e3: none. */
static void open_edge(parity *p, int backend, double below, double z)
{
    parity_scene scene = {0};
    tahr_config c = parity_config();
    c.perch_threshold = 0.15;
    parity_box(&scene, fake_vec(EDGE, -300, -300), fake_vec(EDGE + 300, 300, 0));
    if (below < 1e3) {
        parity_plane(&scene, 0, 0, 1, -below);
    }
    parity_open(p, &scene, backend, &c, 0, 0, z);
    p->step.state.mode = TAHR_MODE_WALKING;
}

static void perch_needs_a_floor_within_reach(void **unused)
{
    const struct {
        const char *id;
        double below, deepest, distance; /* distance < 0: not asked */
        int perches;
        uint32_t queries;
    } rows[] = {{"K1", 30, 87.4001, 19.0434, 1, 1}, {"K2", 100, 87.4001, 89.0434, 0, 1},
                {"K3", 30, 42.6, 19.0434, 1, 1},    {"K3", 30, 29.9, 19.0434, 0, 1},
                {"K1", 30, 30.01, 19.0434, 1, 1}, /* the sum is 30 */
                {"K1", 30, 29.99, 19.0434, 0, 1},   {"K3", 30, 0, -1, 0, 0},
                {"K4", 1e9, 87.4001, -1, 0, 1}};
    parity_table t;
    (void)unused;
    parity_begin(&t, "perch floor");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        for (int backend = 0; backend < PARITY_BACKENDS; backend++) {
            tahr_floor floor;
            parity p;
            if (!parity_has(backend)) {
                continue;
            }
            open_edge(&p, backend, rows[i].below, 88 - ABOVE);
            tahr__perch_look look = {.radius = tahr__valid_perch_radius(&p.step),
                                     .point = parity_vec(EDGE, 0, 0),
                                     .location = p.step.state.position,
                                     .deepest = parity_cm(rows[i].deepest)};
            parity_row(&t, rows[i].id, parity_backend_name(backend));
            int perches = tahr__compute_perch(&p.step, &look, &floor);
            parity_count(&t, "perches", (uint32_t)perches, (uint32_t)rows[i].perches);
            parity_count(&t, "queries", p.step.queries, rows[i].queries);
            if (rows[i].distance >= 0) {
                parity_length(&t, "distance", floor.distance, rows[i].distance, parity_tolerance(backend));
            }
            parity_close(&p);
        }
    }
    parity_end(&t);
}

static void floor_at_an_edge_is_one_with_a_perch(void **unused)
{
    const struct {
        const char *id;
        double below;
        uint32_t mode;
        int walkable;
    } rows[] = {{"F3", 30, TAHR_MODE_WALKING, 1},
                {"F3", 60, TAHR_MODE_WALKING, 1}, /* 87.4 */
                {"F3", 30, TAHR_MODE_FALLING, 1},
                {"F4", 60, TAHR_MODE_FALLING, 0}, /* 42.6 */
                {"F4", 100, TAHR_MODE_WALKING, 0}};
    parity_table t;
    (void)unused;
    parity_begin(&t, "find floor with a perch");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        for (int backend = 0; backend < PARITY_BACKENDS; backend++) {
            tahr_floor floor;
            parity p;
            if (!parity_has(backend)) {
                continue;
            }
            open_edge(&p, backend, rows[i].below, 88 - ABOVE + 2.2);
            p.step.state.mode = rows[i].mode;
            parity_row(&t, rows[i].id, parity_backend_name(backend));
            tahr__find_floor(&p.step, p.config.snap_distance, NULL, &floor);
            parity_length(&t, "distance", floor.distance, 2.2, parity_tolerance(backend));
            parity_count(&t, "walkable", (uint32_t)floor_is_walkable(&floor), (uint32_t)rows[i].walkable);
            parity_count(&t, "perching", (floor.flags & TAHR_FLOOR_PERCHING) != 0, (uint32_t)rows[i].walkable);
            parity_count(&t, "queries", p.step.queries, 2);
            parity_close(&p);
        }
    }
    parity_end(&t);
}

/* What the foot found on an edge and on the floor below it; everything from K1 and the rules of the perch.
 * replaced: the edge may never be stood on, and 60 cm is out of a ray's reach: the floor below it becomes the floor, as
 * if a ray had found it, with the distance to the edge, so that the foot does not drop through it.
 * kept: rising to 2.15 would put the floor below, 87.3 under the edge, out of reach: the distance is called right. */
static void perch_replaces_what_is_no_floor_and_keeps_the_height(void **unused)
{
    const struct {
        const char *id;
        double threshold, edge, below, gap;
        uint32_t rule;
        double distance, line; /* line < 0: not asked */
        uint32_t flags, body, queries;
    } rows[] = {{"replaced", 15, 25, 60, 2.2, TAHR_WALKABLE_NEVER, 2.2, 2.2,
                 TAHR_FLOOR_BLOCKING | TAHR_FLOOR_WALKABLE | TAHR_FLOOR_LINE, 1, 3},
                {"replaced, low", 15, 25, 60, 1.2, TAHR_WALKABLE_NEVER, 1.2, 1.9,
                 TAHR_FLOOR_BLOCKING | TAHR_FLOOR_WALKABLE | TAHR_FLOOR_LINE, 1, 3},
                {"kept", 33, 2, 87.3, 0.5, TAHR_WALKABLE_DEFAULT, 2.15, -1,
                 TAHR_FLOOR_BLOCKING | TAHR_FLOOR_WALKABLE | TAHR_FLOOR_FACE | TAHR_FLOOR_PERCHING, 0, 2}};
    parity_table t;
    (void)unused;
    parity_begin(&t, "what a perch changes");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        for (int backend = 0; backend < PARITY_BACKENDS; backend++) {
            double edge = rows[i].edge, above = 34 - sqrt(34 * 34 - edge * edge);
            parity_scene scene = {0};
            tahr_config c = parity_config();
            tahr_floor floor;
            parity p;
            if (!parity_has(backend)) {
                continue;
            }
            c.perch_threshold = parity_cm(rows[i].threshold);
            parity_box(&scene, fake_vec(edge, -300, -300), fake_vec(edge + 300, 300, 0))->walkable_rule = rows[i].rule;
            parity_plane(&scene, 0, 0, 1, -rows[i].below);
            parity_open(&p, &scene, backend, &c, 0, 0, 88 - above + rows[i].gap);
            p.step.state.mode = TAHR_MODE_WALKING;
            parity_row(&t, rows[i].id, parity_backend_name(backend));
            tahr__find_floor(&p.step, c.snap_distance, NULL, &floor);
            parity_length(&t, "distance", floor.distance, rows[i].distance, parity_tolerance(backend));
            if (rows[i].line >= 0) {
                parity_length(&t, "line distance", floor.perch_distance, rows[i].line, parity_tolerance(backend));
            }
            parity_count(&t, "flags", floor.flags, rows[i].flags);
            parity_count(&t, "body", floor.body, rows[i].body);
            parity_count(&t, "queries", p.step.queries, rows[i].queries);
            parity_close(&p);
        }
    }
    parity_end(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(perch_radius_leaves_a_ring), cmocka_unit_test(perch_is_asked_for_in_the_ring_only),
        cmocka_unit_test(perch_needs_a_floor_within_reach), cmocka_unit_test(floor_at_an_edge_is_one_with_a_perch),
        cmocka_unit_test(perch_replaces_what_is_no_floor_and_keeps_the_height)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
