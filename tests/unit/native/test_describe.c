/* SPDX-License-Identifier: MIT
 * test_describe.c: what a world says of itself is so: of scenes that can be counted by hand. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <tahr/tahr.h>

#include "native_world.h"
#include "page.h"

static void describe(const tahr_body_desc *bodies, uint32_t count, const tahr_native_desc *options, page *p)
{
    tahr_world_desc desc;
    tahr_world *world = NULL;
    const tahr_log to = page_log(p);
    memset(p, 0, sizeof *p);
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bodies;
    desc.body_count = count;
    desc.options = options;
    assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &world), TAHR_OK);
    assert_int_equal(tahr_world_describe(world, &to), TAHR_OK);
    tahr_world_close(world);
}

/* A cube of 20 cm, 12 triangles: 36 sides, each with one neighbour, and those of the 6 diagonals, 12 of 36, flat. One
 * triangle more is there twice, one has no area. */
static void a_cube_is_closed_and_a_third_of_its_edges_is_flat(void **state)
{
    (void)state;
    double v[24];
    uint32_t t[42] = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7,
                      2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 4, 6, 1, 1, 2};
    for (int i = 0; i < 24; i++)
        v[i] = i / 3 >> i % 3 & 1 ? 0.1 : -0.1;
    tahr_body_desc bodies[] = {fixture_mesh(v, 8, t, 14), native_box(v_make(9, 0, 0), v_make(1, 1, 1))};
    page p;
    describe(bodies, 2, NULL, &p);
    page_says(&p, "native, 3D");
    page_says(&p, "0 movable and 2 static bodies, 1 meshes, 1 boxes");
    page_says(&p, "boxes and hulls: 1, met as their triangles");
    page_says(&p, "spheres and capsules: 0");
    page_says(&p, "body 0: mesh, 12 triangles (2 more dropped");
    page_says(&p, "8 vertices");
    page_says(&p, "100.0 % with one neighbour (33.3 % flat), 0.0 % open, 0.0 % with several");
    page_says(&p, "densest around a step: 12 primitives; gathered there within");
    assert_true(strstr(p.text, "is a field") == NULL);
}

/* Three triangles at one edge: three of nine sides have several neighbours, the others none. */
static void open_edges_and_edges_of_several_are_counted(void **state)
{
    (void)state;
    const double v[] = {0, 0, 0, 0, 0, 1, 1, 0, 0, -1, 1, 0, -1, -1, 0};
    const uint32_t t[] = {0, 1, 2, 0, 1, 3, 0, 1, 4};
    tahr_body_desc body = fixture_mesh(v, 5, t, 3);
    page p;
    describe(&body, 1, NULL, &p);
    page_says(&p, "0.0 % with one neighbour (0.0 % flat), 66.7 % open, 33.3 % with several");
    assert_true(strstr(p.text, "boxes and hulls") == NULL);
}

/* 24 x 24 cells of 4 cm, cut from their lowest corners, corners in the order of columns: a field that is not known as
 * one. A step's box of 1 m x 1 m holds all of it. */
static void a_grid_is_said_to_be_a_field(void **state)
{
    (void)state;
    static native_grid grid;
    tahr_body_desc body = native_grid_body(&grid, NATIVE_CELLS, 0.04, NULL);
    tahr_native_desc options = fixture_options();
    page p;
    describe(&body, 1, NULL, &p);
    page_says(&p, "is a field of 25 x 25 heights: as TAHR_BODY_HEIGHTS 4.3 bytes per triangle, and the same surface");
    page_says(&p, "densest around a step: 1152 primitives; too many for a cache of 128");
    options.cache_triangles = 2000;
    options.cache_margin = 0.25;
    describe(&body, 1, &options, &p);
    page_says(&p, "gathered there within 0.25 m of it: cache_margin says so");
    options.no_cache = 1;
    describe(&body, 1, &options, &p);
    page_says(&p, "nothing is gathered: no_cache");
}

static void a_field_takes_its_own_path(void **state)
{
    (void)state;
    const double v[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.5};
    const uint32_t t[] = {0, 1, 3, 0, 3, 2};
    tahr_body_desc body = fixture_mesh(v, 4, t, 2);
    tahr_native_desc options = fixture_options();
    page p;
    describe(&body, 1, &options, &p);
    page_says(&p, "body 0: field of 2 x 2 heights, 2 triangles less its holes; path: straight from the grid");
    options.no_fields = 1;
    describe(&body, 1, &options, &p);
    page_says(&p, "body 0: mesh, 2 triangles");
}

static void wrong_arguments_are_refused(void **state)
{
    (void)state;
    tahr_world_desc desc;
    tahr_world *world = NULL;
    tahr_body_desc box = native_box(v_make(0, 0, 0), v_make(1, 1, 1));
    page p = {.lines = 0};
    const tahr_log to = page_log(&p), mute = {&p, NULL};
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = &box;
    desc.body_count = 1;
    assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &world), TAHR_OK);
    assert_int_equal(tahr_world_describe(NULL, &to), TAHR_E_NULL);
    assert_int_equal(tahr_world_describe(world, NULL), TAHR_E_NULL);
    assert_int_equal(tahr_world_describe(world, &mute), TAHR_E_NULL);
    assert_int_equal(p.lines, 0);
    tahr_world_close(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cube_is_closed_and_a_third_of_its_edges_is_flat),
        cmocka_unit_test(open_edges_and_edges_of_several_are_counted),
        cmocka_unit_test(a_grid_is_said_to_be_a_field),
        cmocka_unit_test(a_field_takes_its_own_path),
        cmocka_unit_test(wrong_arguments_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
