/* SPDX-License-Identifier: MIT
 * test_heights.c: a field of heights answers as the mesh of its triangles, bit for bit. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <tahr/tahr.h>

#include "soup.h"

enum { COLUMNS = 41, ROWS = 31, CELLS = (COLUMNS - 1) * (ROWS - 1) };

typedef struct field {
    double heights[COLUMNS * ROWS], vertices[COLUMNS * ROWS * 3];
    uint32_t indices[CELLS * 6];
    tahr_body_desc heights_body, mesh_body;
} field;

static int is_hole(const field *f, uint32_t vertex)
{
    return f->heights[vertex] != f->heights[vertex];
}

/* The mesh that world.h describes: triangles with a hole at a corner are one without area instead, which is dropped, so
 * that the others keep their numbers. */
static void make(field *f, oracle_random *r, double rough, uint32_t holes)
{
    const double half_x = 9.3, half_y = 7.1;
    for (uint32_t i = 0; i < COLUMNS * ROWS; i++)
        f->heights[i] = oracle_uniform(r, -rough, rough);
    for (uint32_t i = 0; i < holes; i++)
        f->heights[oracle_below(r, COLUMNS * ROWS)] = NAN;
    for (uint32_t row = 0; row < ROWS; row++) {
        for (uint32_t column = 0; column < COLUMNS; column++) {
            uint32_t i = row * COLUMNS + column;
            f->vertices[3 * i] = (2.0 * column / (COLUMNS - 1) - 1) * half_x;
            f->vertices[3 * i + 1] = (2.0 * row / (ROWS - 1) - 1) * half_y;
            f->vertices[3 * i + 2] = is_hole(f, i) ? 0 : f->heights[i];
        }
    }
    for (uint32_t cell = 0; cell < CELLS; cell++) {
        uint32_t a = cell / (COLUMNS - 1) * COLUMNS + cell % (COLUMNS - 1), d = a + COLUMNS + 1;
        const uint32_t corners[6] = {a, a + 1, d, a, d, a + COLUMNS};
        for (uint32_t k = 0; k < 6; k += 3) {
            int hole = is_hole(f, corners[k]) || is_hole(f, corners[k + 1]) || is_hole(f, corners[k + 2]);
            for (uint32_t i = k; i < k + 3; i++)
                f->indices[6 * cell + i] = hole ? a : corners[i];
        }
    }
    f->mesh_body = fixture_mesh(f->vertices, COLUMNS * ROWS, f->indices, 2 * CELLS);
    f->heights_body = fixture_body(TAHR_BODY_HEIGHTS);
    f->heights_body.heights = f->heights;
    f->heights_body.columns = COLUMNS;
    f->heights_body.rows = ROWS;
    f->heights_body.half_extents = v_make(half_x, half_y, 0);
}

static void set_both(field *f, uint32_t flags, tahr_pose pose)
{
    f->mesh_body.flags = f->heights_body.flags = flags;
    f->mesh_body.pose = f->heights_body.pose = pose;
    f->mesh_body.surface = f->heights_body.surface = 7;
}

static void a_field_answers_as_its_mesh_bit_for_bit(void **state)
{
    (void)state;
    static field f;
    oracle_random r = {23};
    const tahr_pose poses[] = {{{0, 0, 0}, {0, 0, 0, 1}}, {{0.3, -0.2, 0.1}, {0.02, 0.01, 0.3, 0.95367709}}};
    for (uint32_t n = 0; n < 8; n++) {
        /* Rolling, rough, spikes so steep that some are slivers, spikes so steep that they have no area. */
        const double rough[] = {0.15, 0.8, 3e4, 1e7};
        const uint32_t holes[] = {0, 100, 3, 900};
        make(&f, &r, rough[n / 2], holes[n % 4]);
        uint32_t flags = (n % 3 == 1 ? TAHR_BODY_TWO_SIDED : 0u) | (n % 3 == 2 ? TAHR_BODY_MOVABLE : 0u);
        set_both(&f, flags, poses[n % 2]);
        soup s; /* says where to ask */
        soup_make(&s, &f.mesh_body, 0);
        fixture worlds[5];
        for (uint32_t i = 0; i < 5; i++) {
            tahr_native_desc o = fixture_options();
            o.no_fields = i == 0;
            o.no_cache = i == 1;
            o.no_simd = i == 2;
            o.cache_triangles = i == 3 ? 64 : 1500;
            fixture_init(&worlds[i]);
            assert_int_equal(fixture_open(&worlds[i], i % 4 ? &f.heights_body : &f.mesh_body, 1, &o, 1), TAHR_OK);
        }
        /* The fifth is a mesh that has been found to be a field. */
        assert_int_equal(holes[n % 4] == 0, 4 * worlds[4].bytes < worlds[0].bytes);
        uint32_t hits = soup_compare(worlds, 5, &s, rough[n / 2] > 1 ? 60 : 400);
        if (rough[n / 2] < 1 && holes[n % 4] < 900) assert_true(hits > 80);
        for (int i = 0; i < 5; i++)
            native_close(&worlds[i]);
        soup_free(&s);
    }
}

/* Opens the mesh of a field, with a cache: as it is, or as a mesh whatever it is. Returns the bytes of the scene. */
static size_t open_mesh(fixture *w, const field *f, uint32_t no_fields)
{
    tahr_native_desc o = fixture_options();
    o.no_fields = no_fields;
    o.cache_triangles = 1500;
    fixture_init(w);
    assert_int_equal(fixture_open(w, &f->mesh_body, 1, &o, 1), TAHR_OK);
    return w->bytes;
}

/* Somewhere, on a grid that is no more even than it must be: a thousandth of a cell either way. */
static void a_mesh_on_an_uneven_grid_answers_as_a_mesh_bit_for_bit(void **state)
{
    (void)state;
    static field f;
    oracle_random r = {29};
    for (uint32_t n = 0; n < 4; n++) {
        make(&f, &r, n < 2 ? 0.2 : 0.7, 0);
        set_both(&f, n % 2 ? (uint32_t)TAHR_BODY_TWO_SIDED : 0u, (tahr_pose){{-3, 1, 0}, {0, 0, 0, 1}});
        double off[COLUMNS];
        for (uint32_t i = 0; i < COLUMNS; i++)
            off[i] = 3.7 + (i % (COLUMNS - 1) ? oracle_uniform(&r, -0.0004, 0.0004) : 0); /* cells of 0.465 m */
        for (uint32_t i = 0; i < COLUMNS * ROWS; i++) {
            f.vertices[3 * i] += off[i % COLUMNS];
            f.vertices[3 * i + 1] -= 1.3;
        }
        soup s;
        fixture worlds[2];
        soup_make(&s, &f.mesh_body, 0);
        size_t as_mesh = open_mesh(&worlds[0], &f, 1), as_field = open_mesh(&worlds[1], &f, 0);
        assert_true(4 * as_field < as_mesh);
        assert_true(soup_compare(worlds, 2, &s, 400) > 80);
        native_close(&worlds[0]);
        native_close(&worlds[1]);
        soup_free(&s);
    }
}

/* One thing after the other that no field has. */
static void what_is_not_quite_a_field_stays_a_mesh(void **state)
{
    (void)state;
    static field f;
    oracle_random r = {31};
    fixture w;
    for (int n = 0; n < 8; n++) {
        make(&f, &r, 0.2, 0);
        uint32_t *t = f.indices + 6 * 77, first = t[0];
        double *v = f.vertices + 3 * 200;
        if (n == 1) v[0] = nextafter(v[0], 100);            /* a corner beside its column */
        if (n == 2) t[0] = t[1], t[1] = t[2], t[2] = first; /* corners in another order */
        if (n == 3) t[1] = t[4], t[4] = t[1];               /* a triangle turned over */
        if (n == 4) f.mesh_body.triangle_count -= 1;
        if (n == 5) f.mesh_body.vertex_count -= COLUMNS, f.mesh_body.triangle_count = 2 * (COLUMNS - 1) * (ROWS - 3);
        for (uint32_t i = 0; n >= 6 && i < COLUMNS * ROWS; i++) {
            double *c = f.vertices + 3 * i + (n == 6 ? 0 : 1);
            *c += 0.01 * *c * *c; /* cells that grow */
        }
        size_t as_mesh = open_mesh(&w, &f, 1);
        native_close(&w);
        size_t as_found = open_mesh(&w, &f, 0);
        native_close(&w);
        assert_int_equal(as_found == as_mesh, n > 0);
    }
}

/* 8 bytes a sample, and a page for all else (the grid of the test has 1271 samples). */
static void a_field_takes_little_more_than_its_heights(void **state)
{
    (void)state;
    static field f;
    oracle_random r = {2};
    fixture w;
    make(&f, &r, 0.2, 0);
    native_open(&w, &f.heights_body, 1, 0);
    assert_true(w.bytes < sizeof f.heights + 4096);
    native_close(&w);
}

/* On a plane z = 0.1 x + 0.05 y a sphere of radius 0.5 comes down to: centre 0.51 along the normal from the plane. */
static void a_sphere_rests_on_a_slope_of_heights(void **state)
{
    (void)state;
    double heights[4] = {-0.15, 0.05, -0.05, 0.15}; /* at (-1, -1), (1, -1), (-1, 1), (1, 1) */
    tahr_body_desc d = fixture_body(TAHR_BODY_HEIGHTS);
    fixture w;
    d.heights = heights;
    d.columns = d.rows = 2;
    d.half_extents = v_make(1, 1, 0);
    native_open(&w, &d, 1, 0);
    tahr_sweep q =
        fixture_sweep(fixture_shape(TAHR_SHAPE_SPHERE, 0.5, 0.5), v_make(0.1, 0.2, 2), v_make(0, 0, -2), 0.01);
    tahr_hit h = fixture_hit(&w, &q);
    double tilt = sqrt(1 + 0.1 * 0.1 + 0.05 * 0.05), height = 0.1 * 0.1 + 0.05 * 0.2 + 0.51 * tilt;
    assert_true(h.blocking && fabs(h.fraction - (2 - height) / 2) < 1e-10);
    assert_true(fabs(h.normal.z - 1 / tilt) < 1e-12 && fabs(h.normal.x + 0.1 / tilt) < 1e-12);
    assert_int_equal(h.feature, 1); /* x < y */
    native_close(&w);
}

static void bad_fields_are_refused(void **state)
{
    (void)state;
    const char *const named[] = {"heights",        "heights",        "columns", "rows",
                                 "half_extents.x", "half_extents.y", "heights"};
    double heights[9] = {0};
    for (int n = 0; n < 8; n++) {
        tahr_body_desc d;
        tahr_world *world = NULL;
        tahr_world_desc scene;
        fixture f;
        fixture_init(&f);
        tahr_body_desc_init(&d, sizeof d, TAHR_BODY_HEIGHTS);
        d.heights = n == 0 ? NULL : heights;
        d.columns = n == 2 ? 1 : 3;
        d.rows = n == 3 ? 65537 : 3;
        d.half_extents = v_make(n == 4 ? 0 : 1, n == 5 ? NAN : 1, 0);
        for (int i = 0; i < 9; i++)
            heights[i] = n == 7 ? NAN : 0; /* nothing but holes */
        if (n == 1) heights[5] = INFINITY;
        if (n == 6) heights[5] = -1.1e7;
        tahr_world_desc_init(&scene, sizeof scene);
        scene.bodies = &d;
        scene.body_count = 1;
        scene.log = &f.host.log;
        tahr_status status = tahr_world_open(tahr_backend_v1_native(), &scene, &world);
        assert_int_equal(status, n == 7 ? TAHR_E_GEOMETRY : TAHR_E_ARGUMENT);
        assert_non_null(strstr(f.message, n == 7 ? "without a hole" : named[n]));
        assert_null(world);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_field_answers_as_its_mesh_bit_for_bit),
        cmocka_unit_test(a_mesh_on_an_uneven_grid_answers_as_a_mesh_bit_for_bit),
        cmocka_unit_test(what_is_not_quite_a_field_stays_a_mesh),
        cmocka_unit_test(a_field_takes_little_more_than_its_heights),
        cmocka_unit_test(a_sphere_rests_on_a_slope_of_heights),
        cmocka_unit_test(bad_fields_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
