/* SPDX-License-Identifier: MIT
 * test_margin.c: how far around a character is gathered is its surroundings' doing, and changes no bit. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <tahr/tahr.h>

#include "native/scene.h"
#include "native_world.h"

/* Squares of 4 m to 5 cm under everybody's feet: on 24 x 24 of them there is half a metre around the middle in all. */
static const double CELLS[] = {4, 0.5, 0.25, 0.15, 0.1, 0.05};
enum { DENSITIES = 6, WAYS = 4, STEPS = 150 };

static double waves(double x, double y)
{
    double a = x - floor(x) - 0.5, b = y - floor(y) - 0.5;
    return 0.1 * a * a + 0.2 * b * b;
}

/* Up and down before the middle of the grid; [out] path: all states. Returns the gathers. */
static uint64_t walk(const tahr_body_desc *body, const tahr_native_desc *options, double middle, tahr_state path[STEPS])
{
    tahr_world_desc desc;
    tahr_world *world = NULL;
    tahr_config config;
    tahr_mover *mover = NULL;
    tahr_input input;
    uint64_t gathers = 0;
    tahr_vec3 start = {middle, middle, 1};
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = body;
    desc.body_count = 1;
    desc.options = options;
    assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &world), TAHR_OK);
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    memset(&input, 0, sizeof input);
    input.struct_size = sizeof input;
    assert_int_equal(tahr_mover_create(world, &config, &mover), TAHR_OK);
    assert_int_equal(tahr_state_init(&path[0], &config, &start), TAHR_OK);
    for (int i = 0; i < STEPS; i++) {
        tahr_report report = {.struct_size = sizeof report};
        if (i > 0) path[i] = path[i - 1];
        input.move = i % 12 < 6 ? v_make(1, 0.5, 0) : v_make(-1, -0.5, 0);
        assert_true(tahr_mover_step(mover, &input, 1.0 / 60, &path[i], &report) >= 0);
        gathers += report.gathers;
    }
    tahr_mover_destroy(mover);
    tahr_world_close(world);
    return gathers;
}

static void no_margin_changes_a_bit(void **state)
{
    (void)state;
    static native_grid grid;
    static tahr_state paths[WAYS][STEPS];
    for (int d = 0; d < DENSITIES; d++) {
        tahr_body_desc body = native_grid_body(&grid, NATIVE_CELLS, CELLS[d], waves);
        tahr_native_desc ways[WAYS];
        uint64_t gathers[WAYS];
        for (int i = 0; i < WAYS; i++)
            ways[i] = fixture_options();
        ways[1].no_cache = 1;
        ways[2].cache_margin = 1;
        ways[2].no_simd = 1;
        ways[3].cache_triangles = 16;
        for (int i = 0; i < WAYS; i++) {
            gathers[i] = walk(&body, &ways[i], CELLS[d] * NATIVE_CELLS / 2, paths[i]);
            assert_memory_equal(paths[0], paths[i], sizeof paths[0]);
        }
        assert_true(gathers[0] > 0 && gathers[1] == 0);
        assert_int_equal(paths[0][STEPS - 1].mode, TAHR_MODE_WALKING);
    }
}

/* What is chosen for a box of 1 m x 1 m x 2 m over the middle of a grid; counted: by a loop over its triangles. */
typedef struct choice {
    double margin;
    int fits;
    uint32_t counted;
} choice;

static uint32_t count(const native_grid *grid, const tahr_body_desc *body, const tahr_bounds *box)
{
    uint32_t found = 0;
    for (uint32_t i = 0; i < body->triangle_count; i++) {
        tahr_vec3 low = {1e9, 1e9, 1e9}, high = {-1e9, -1e9, -1e9};
        for (int k = 0; k < 3; k++) {
            const double *v = grid->vertices + 3 * (size_t)grid->indices[3 * i + (uint32_t)k];
            low = v_min(low, v_make(v[0], v[1], v[2]));
            high = v_max(high, v_make(v[0], v[1], v[2]));
        }
        found += low.x <= box->max.x && high.x >= box->min.x && low.y <= box->max.y && high.y >= box->min.y &&
                 low.z <= box->max.z && high.z >= box->min.z;
    }
    return found;
}

static tahr_prepare announcement(tahr_vec3 at)
{
    tahr_prepare p;
    const tahr_vec3 half = {0.5, 0.5, 1};
    memset(&p, 0, sizeof p);
    p.position = at;
    p.bounds = (tahr_bounds){v_sub(at, half), v_add(at, half)};
    p.up = v_make(0, 0, 1);
    p.mask = 0xFFFFFFFFu;
    return p;
}

static choice choose(double cell, const tahr_native_desc *options)
{
    static native_grid grid;
    fixture f;
    tahr_body_desc body = native_grid_body(&grid, NATIVE_CELLS, cell, waves);
    double middle = cell * NATIVE_CELLS / 2;
    tahr_prepare p = announcement(v_make(middle, middle, 0.5));
    choice c;
    fixture_init(&f);
    assert_int_equal(fixture_open(&f, &body, 1, options, 1), TAHR_OK);
    assert_int_equal(tahr_backend_v1_native()->prepare(f.self, &f.context, &p), TAHR_OK);
    const tahr__cache *cache = f.context.cache;
    c.fits = !cache->overflow;
    c.margin = p.bounds.min.x - cache->bounds.min.x;
    c.counted = count(&grid, &body, &cache->bounds);
    assert_true(!c.fits || c.counted <= cache->count);
    fixture_close(&f);
    return c;
}

/* 128 triangles are room for 64 squares: eight times eight of them. The least margin that is tried is an eighth of a
 * metre: 1.25 m lie on eight squares at most if six of them are as long, and on more if eight are shorter. */
static void what_is_gathered_fits_the_cache(void **state)
{
    (void)state;
    double before = 2;
    for (int d = 0; d < DENSITIES; d++) {
        tahr_native_desc options = fixture_options();
        choice c = choose(CELLS[d], &options);
        assert_int_equal(c.fits, CELLS[d] > 1.25 / 6);
        assert_true(c.fits || CELLS[d] < 1.25 / 8);
        if (!c.fits) continue;
        assert_true(c.counted <= 128);
        assert_true(c.margin <= before && c.margin >= 0.125 && c.margin <= 1);
        before = c.margin;
    }
    assert_true(before < 0.5); /* of the densest that fitted */
}

static void a_margin_that_is_given_is_taken(void **state)
{
    (void)state;
    tahr_native_desc options = fixture_options();
    options.cache_margin = 0.7;
    for (int d = 0; d < DENSITIES; d++) {
        choice c = choose(CELLS[d], &options);
        assert_true(fabs(c.margin - 0.7) < 1e-12);
    }
}

/* How far the box of what has been gathered reaches beyond what was announced. */
typedef struct sides {
    tahr_vec3 low, high;
} sides;

static sides gather_at(fixture *f, tahr_vec3 at)
{
    const tahr_prepare p = announcement(at);
    const tahr__cache *cache = f->context.cache;
    assert_int_equal(tahr_backend_v1_native()->prepare(f->self, &f->context, &p), TAHR_OK);
    return (sides){v_sub(p.bounds.min, cache->bounds.min), v_sub(cache->bounds.max, p.bounds.max)};
}

static void assert_sides(sides s, tahr_vec3 low, tahr_vec3 high)
{
    assert_true(v_length(v_sub(s.low, low)) < 1e-12);
    assert_true(v_length(v_sub(s.high, high)) < 1e-12);
}

/* Over squares of 4 m the margin is all that is allowed. */
static void a_gather_reaches_farther_the_way_that_was_gone(void **state)
{
    (void)state;
    static native_grid grid;
    tahr_body_desc body = native_grid_body(&grid, NATIVE_CELLS, 4, waves);
    const tahr_vec3 even = {1, 1, 1};
    for (int given = 0; given < 2; given++) {
        fixture f;
        tahr_native_desc options = fixture_options();
        options.cache_margin = given;
        fixture_init(&f);
        assert_int_equal(fixture_open(&f, &body, 1, &options, 1), TAHR_OK);
        assert_sides(gather_at(&f, v_make(40.5, 40.5, 0.5)), even, even);
        sides s = gather_at(&f, v_make(43.5, 40.5, 0.5));
        assert_sides(s, given ? even : v_make(0.25, 1, 1), given ? even : v_make(1.75, 1, 1));
        /* 3 m that way and 4 m across it: three fifths and four of 0.75. */
        s = gather_at(&f, v_make(40.5, 36.5, 0.5));
        assert_sides(s, given ? even : v_make(1.45, 1.6, 1), given ? even : v_make(0.55, 0.4, 1));
        /* Nobody walked here. */
        assert_sides(gather_at(&f, v_make(60.5, 36.5, 0.5)), even, even);
        assert_int_equal(f.context.gathers, 4);
        fixture_close(&f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_margin_changes_a_bit),
        cmocka_unit_test(what_is_gathered_fits_the_cache),
        cmocka_unit_test(a_margin_that_is_given_is_taken),
        cmocka_unit_test(a_gather_reaches_farther_the_way_that_was_gone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
