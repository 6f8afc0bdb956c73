/* SPDX-License-Identifier: MIT
 * test_floor_answers.c: TAHR_FLOOR_PROBE_SHRUNK and what backends can do and say: shapes they lack, points of contact
 * that are none, answers that they do not have, rays, and wedges. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fake_backend.h"
#include "floor_distance.h"
#include "near.h"
#include "parity.h"

/* A floor whose backend names a corner of the box, 33.995 cm off the axis, as the point of contact. */
static tahr_status meet_a_corner(void *user, const tahr_sweep *query, tahr_hit *hit)
{
    double end = query->position.z - query->shape.half_height;
    (void)user;
    hit->blocking = 1;
    hit->fraction = end / -query->motion.z;
    hit->normal = hit->surface_normal = vec(0, 0, 1);
    hit->point = vec(query->position.x + 0.24038, query->position.y + 0.24038, 0);
    return TAHR_OK;
}

static void corner_of_a_flat_base_is_no_rim(void **unused)
{
    tahr_callbacks callbacks = {.struct_size = sizeof callbacks, .sweep = meet_a_corner};
    tahr_config c = parity_config();
    tahr_floor floor;
    parity p;
    (void)unused;
    for (uint32_t flat = 0; flat < 2; flat++) {
        c.flat_base = flat;
        parity_open_callbacks(&p, &callbacks, &c);
        parity_put(&p, 0, 0, 90.15);
        tahr__find_floor(&p.step, c.snap_distance, NULL, &floor);
        assert_near(100 * floor.distance, 2.15, 1e-9);
        assert_int_equal(p.step.queries, flat ? 1 : 2); /* a round foot doubts it */
        parity_close(&p);
    }
}

/* A backend that gives up, and a step that has used up its queries: the character stays where it is. */
static tahr_status give_up(void *user, const tahr_sweep *query, tahr_hit *hit)
{
    (void)query;
    hit->unknown = 1;
    hit->fraction = *(const double *)user;
    return TAHR_OK;
}

static void what_is_not_known_never_lifts(void **unused)
{
    double fraction = 0;
    tahr_callbacks callbacks = {.struct_size = sizeof callbacks, .user = &fraction, .sweep = give_up};
    tahr_floor floor;
    parity p;
    (void)unused;
    for (int i = 0; i < 3; i++) {
        fraction = i * 0.3;
        parity_open_callbacks(&p, &callbacks, NULL);
        p.step.state.mode = TAHR_MODE_WALKING;
        p.step.queries = i == 2 ? TAHR_MAX_QUERIES_PER_STEP : 0;
        tahr__find_floor(&p.step, p.config.snap_distance, NULL, &floor);
        assert_true(floor.distance >= p.config.floor_target * p.config.skin);
        tahr__keep_floor(&p.step, &floor);
        assert_true(tahr__adjust_height(&p.step) <= 0);
        parity_close(&p);
    }
}

/* A backend that calls the floor absurdly deep, and meets nothing on the way up. */
static tahr_status meet_an_abyss(void *user, const tahr_sweep *query, tahr_hit *hit)
{
    if (query->motion.z < 0) {
        hit->blocking = hit->start_overlap = 1;
        hit->depth = *(const double *)user;
        hit->normal = hit->surface_normal = vec(0, 0, 1);
        hit->point = vec(query->position.x, query->position.y, 0);
        hit->fraction = 0;
    }
    return TAHR_OK;
}

static void nobody_rises_out_of_a_floor_by_more_than_his_height(void **unused)
{
    const double depths[] = {0.1, 3, 1e6, 1e300};
    double depth;
    tahr_callbacks callbacks = {.struct_size = sizeof callbacks, .user = &depth, .sweep = meet_an_abyss};
    (void)unused;
    for (int i = 0; i < 4; i++) {
        parity p;
        tahr_floor floor;
        tahr_config c = parity_config();
        c.floor_probe = TAHR_FLOOR_PROBE_WHOLE;
        c.separation = TAHR_SEPARATION_MARGIN;
        depth = depths[i];
        parity_open_callbacks(&p, &callbacks, &c);
        p.step.state.mode = TAHR_MODE_WALKING;
        tahr__find_floor(&p.step, c.snap_distance, NULL, &floor);
        p.step.state.floor = floor;
        p.step.state.floor.flags |= TAHR_FLOOR_WALKABLE; /* as a wedge may be */
        double least = min_of(depth, 2 * c.shape.half_height);
        assert_near(tahr__adjust_height(&p.step), least + c.floor_target * c.skin, 1e-9);
        parity_close(&p);
    }
}

/* A backend that meets nothing and remembers what was swept. */
static tahr_sweep swept;

static tahr_status remember(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                            uint32_t capacity, uint32_t *count)
{
    (void)self, (void)context, (void)hits, (void)capacity;
    swept = *query;
    *count = 0;
    return TAHR_OK;
}

static void probe_is_what_the_backend_can_sweep(void **unused)
{
    const struct {
        uint32_t capabilities, flat_base, type;
        double half_height;
    } rows[] = {{FAKE_BACKEND_ALL, 0, TAHR_SHAPE_CAPSULE, 0.826},
                {FAKE_BACKEND_ALL, 1, TAHR_SHAPE_BOX, 0.826},
                {FAKE_BACKEND_ALL & ~(uint32_t)TAHR_CAP_BOX, 1, TAHR_SHAPE_CAPSULE, 0.826},
                {FAKE_BACKEND_ALL & ~(uint32_t)TAHR_CAP_CAPSULE, 0, TAHR_SHAPE_SPHERE, 0.34}};
    (void)unused;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        fake_backend backend;
        tahr_world_desc desc;
        tahr_config c = parity_config();
        parity_scene nothing = {0};
        tahr_world *world = NULL;
        tahr_floor floor;
        parity p;
        c.flat_base = rows[i].flat_base;
        fake_backend_init(&backend, rows[i].capabilities);
        backend.table.sweep = remember;
        assert_int_equal(tahr_world_desc_init(&desc, sizeof desc), TAHR_OK);
        desc.options = &backend;
        assert_int_equal(tahr_world_open(&backend.table, &desc, &world), TAHR_OK);
        parity_open(&p, &nothing, PARITY_FAKE, &c, 0, 0, 88);
        p.step.world = world;
        tahr__find_floor(&p.step, c.snap_distance, NULL, &floor);
        assert_int_equal(swept.shape.type, rows[i].type);
        assert_near(swept.shape.half_height, rows[i].half_height, 1e-12);
        assert_near(swept.position.z - swept.shape.half_height, 0.054, 1e-12); /* 5.4 cm above the end of the shape */
        assert_near(swept.margin, 0, 0);
        assert_int_equal(p.step.queries, 1 + rows[i].flat_base * (rows[i].type == TAHR_SHAPE_BOX));
        tahr_world_close(world);
        parity_close(&p);
    }
}

/* A wall in the way of the sweep, and a ray from inside of something. */
static tahr_status meet_a_wall(void *user, const tahr_sweep *query, tahr_hit *hit)
{
    (void)user, (void)query;
    hit->blocking = 1;
    hit->fraction = 0.5;
    hit->normal = hit->surface_normal = vec(1, 0, 0);
    return TAHR_OK;
}

static tahr_status meet_at(void *user, const tahr_ray *query, tahr_hit *hit)
{
    (void)query;
    hit->blocking = 1;
    hit->fraction = *(const double *)user;
    hit->normal = vec(0, 0, 1);
    return TAHR_OK;
}

static void ray_that_starts_inside_finds_nothing(void **unused)
{
    double fraction = 0;
    tahr_callbacks callbacks = {
        .struct_size = sizeof callbacks, .user = &fraction, .sweep = meet_a_wall, .ray = meet_at};
    tahr_floor floor;
    parity p;
    (void)unused;
    for (int i = 0; i < 2; i++) {
        fraction = i * 0.7;
        parity_open_callbacks(&p, &callbacks, NULL);
        p.step.state.mode = TAHR_MODE_WALKING;
        tahr__find_floor(&p.step, p.config.snap_distance, NULL, &floor);
        assert_int_equal(floor_is_walkable(&floor), i);
        assert_near(floor.perch_distance, i ? 0.7 * (0.88 + 0.474001) - 0.88 : 0, 1e-12);
        parity_close(&p);
    }
}

/* Between two faces of 60 degrees: for a solver that rests between walls a floor, for one that slides off none. */
static void wedge_is_a_floor_for_the_joint_solver(void **unused)
{
    (void)unused;
    for (uint32_t solver = TAHR_SLIDE_JOINT; solver <= TAHR_SLIDE_TWO_WALLS; solver++) {
        double side = sqrt(0.75);
        parity_scene scene = {0};
        tahr_config c = parity_config();
        tahr_floor floor;
        parity p;
        c.slide_solver = solver;
        parity_plane(&scene, -side, 0, 0.5, 0);
        parity_plane(&scene, side, 0, 0.5, 0);
        parity_open(&p, &scene, PARITY_FAKE, &c, 0, 0, 88 - 34 + 68 + 1); /* 68: touches both */
        p.step.state.mode = TAHR_MODE_WALKING;
        tahr__find_floor(&p.step, c.snap_distance, NULL, &floor);
        assert_near(100 * floor.distance, 1, 1e-9);
        assert_int_equal(floor_is_walkable(&floor), solver == TAHR_SLIDE_JOINT);
        assert_int_equal(floor.flags & TAHR_FLOOR_WEDGED, solver == TAHR_SLIDE_JOINT ? TAHR_FLOOR_WEDGED : 0);
        parity_close(&p);
    }
}

static void ray_finds_the_floor_inside_a_rim_that_is_none(void **unused)
{
    (void)unused;
    for (int backend = PARITY_NATIVE; backend < PARITY_BACKENDS; backend++) {
        parity_scene scene = {0};
        tahr_floor floor;
        parity p;
        if (!parity_has(backend)) {
            continue;
        }
        /* The edge of a rock that may never be stood on, 20 cm off the axis: met 6.505 lower than its top. */
        parity_box(&scene, fake_vec(20, -300, -100), fake_vec(300, 300, 0))->walkable_rule = TAHR_WALKABLE_NEVER;
        parity_plane(&scene, 0, 0, 1, -20);
        parity_open(&p, &scene, backend, NULL, 0, 0, 88);
        p.step.state.mode = TAHR_MODE_WALKING;
        tahr__find_floor(&p.step, p.config.snap_distance, NULL, &floor);
        assert_int_equal(floor.flags, TAHR_FLOOR_BLOCKING | TAHR_FLOOR_WALKABLE | TAHR_FLOOR_LINE);
        assert_near(100 * floor.distance, 34 - sqrt(34 * 34 - 20 * 20), parity_tolerance(backend));
        assert_near(100 * floor.perch_distance, 20, parity_tolerance(backend));
        assert_int_equal(floor.body, 1);
        assert_int_equal(p.step.queries, 2);
        parity_close(&p);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(corner_of_a_flat_base_is_no_rim),
                                       cmocka_unit_test(what_is_not_known_never_lifts),
                                       cmocka_unit_test(nobody_rises_out_of_a_floor_by_more_than_his_height),
                                       cmocka_unit_test(probe_is_what_the_backend_can_sweep),
                                       cmocka_unit_test(ray_that_starts_inside_finds_nothing),
                                       cmocka_unit_test(wedge_is_a_floor_for_the_joint_solver),
                                       cmocka_unit_test(ray_finds_the_floor_inside_a_rim_that_is_none)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
