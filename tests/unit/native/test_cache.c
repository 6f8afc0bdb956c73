/* SPDX-License-Identifier: MIT
 * test_cache.c: what makes the native backend fast, caches and lanes, changes no bit. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "native/scene.h"
#include "native_world.h"

typedef struct answers {
    tahr_hit hits[4];
    tahr_contact contacts[16];
    uint32_t hit_count, contact_count, ray_count;
    tahr_hit ray;
} answers;

static void ask(fixture *f, const tahr_sweep *sweep, answers *a)
{
    const tahr_backend *b = tahr_backend_v1_native();
    tahr_contact_query c = fixture_contacts(sweep->shape, sweep->position, 0.02);
    tahr_ray ray = {sweep->position, sweep->motion, 0xFFFFFFFFu, TAHR_NO_BODY};
    memset(a, 0, sizeof *a);
    c.up = sweep->up;
    c.mask = ray.mask = sweep->mask;
    b->sweep(f->self, &f->context, sweep, a->hits, 4, &a->hit_count);
    b->contacts(f->self, &f->context, &c, a->contacts, 16, &a->contact_count);
    b->ray(f->self, &f->context, &ray, &a->ray, &a->ray_count);
}

/* The reach of a runner's step, under any up. */
static void announce(fixture *f, tahr_vec3 at, tahr_vec3 up, uint32_t mask)
{
    const tahr_vec3 reach = {1.6, 1.6, 1.6};
    tahr_prepare a;
    memset(&a, 0, sizeof a);
    a.position = at;
    a.up = up;
    a.mask = mask;
    a.bounds.min = v_sub(at, reach);
    a.bounds.max = v_add(at, reach);
    tahr_backend_v1_native()->prepare(f->self, &f->context, &a);
}

static void caches_and_lanes_change_no_bit(void **state)
{
    (void)state;
    static native_grid grid;
    tahr_body_desc bodies[NATIVE_HILLS];
    native_hills(&grid, bodies);
    for (uint32_t i = 1; i < NATIVE_HILLS; i++)
        bodies[i].mask = 1 + i % 2;
    uint64_t escapes = 0, gathers = 0, hits = 0, contacts = 0, rays = 0;
    fixture f[5];
    for (uint32_t i = 0; i < 5; i++) {
        tahr_native_desc o = fixture_options();
        o.no_cache = i == 0;
        o.no_simd = i == 2;
        o.cache_triangles = i == 3 ? 16 : i == 4 ? 4096 : 400;
        o.cache_margin = i == 4 ? 3 : 0.5;
        fixture_init(&f[i]);
        assert_int_equal(fixture_open(&f[i], bodies, NATIVE_HILLS, &o, 1), TAHR_OK);
    }
    oracle_random r = {3};
    tahr_vec3 p = v_make(6, 6, 1.2);
    for (int n = 0; n < 12000; n++) {
        tahr_sweep q = fixture_sweep(native_shape(n % 11 == 0 ? 2 : n % 3 == 0 ? 0 : 1), p, v_make(0, 0, 0), 0.01);
        q.motion = dice_vec(&r, -0.5, 0.4);
        if (n % 50 == 0) q.motion.x = 4;
        if ((n / 500) % 2) q.up = v_make(0.6, 0, 0.8);
        q.flags = n % 2 ? TAHR_SWEEP_LEAVE_OVERLAP : 0;
        q.mask = n % 9 == 0 ? 1 : n % 9 == 1 ? 2 : 0xFFFFFFFFu;
        uint32_t announced = (n / 700) % 2 ? 1 : 0xFFFFFFFFu; /* less than is asked for: still the same answers */
        answers first, other;
        for (uint32_t i = 0; i < 5; i++) {
            announce(&f[i], p, q.up, announced);
            ask(&f[i], &q, i == 0 ? &first : &other);
            if (i > 0) assert_memory_equal(&first, &other, sizeof first);
        }
        hits += first.hit_count, contacts += first.contact_count, rays += first.ray_count;
        p = v_add(p, v_scale(q.motion, 0.3));
        if (p.x < 2 || p.x > 10 || p.y < 2 || p.y > 10 || p.z < 0 || p.z > 2.5) p = v_make(6, 6, 1.2);
    }
    assert_int_equal(f[0].context.gathers, 0);
    for (int i = 0; i < 5; i++) {
        escapes += f[i].context.escapes;
        gathers += f[i].context.gathers;
        native_close(&f[i]);
    }
    assert_true(escapes > 100 && gathers > 100);
    assert_true(hits > 1000 && contacts > 1000 && rays > 1000); /* else nothing was compared */
}

/* A query near a place, of any kind that a step asks. */
static tahr_sweep near_place(oracle_random *r, tahr_vec3 place, double reach, int n)
{
    tahr_vec3 at = v_add(place, dice_vec(r, -reach, reach));
    tahr_sweep q = fixture_sweep(native_shape(n % 11 == 0 ? 2 : n % 3 == 0 ? 0 : 1), at, v_make(0, 0, 0), 0.01);
    q.motion = dice_vec(r, -0.5, 0.4);
    if ((n / 50) % 2) q.up = v_make(0.6, 0, 0.8);
    return q;
}

static void open_hills(fixture *f, native_grid *grid)
{
    tahr_body_desc bodies[NATIVE_HILLS];
    tahr_native_desc o = fixture_options();
    native_hills(grid, bodies);
    o.cache_triangles = 400;
    fixture_init(f);
    assert_int_equal(fixture_open(f, bodies, NATIVE_HILLS, &o, 1), TAHR_OK);
}

/* A ray has no up: without an announcement it is +z. */
static void forget_ray(answers *a)
{
    memset(&a->ray, 0, sizeof a->ray);
    a->ray_count = 0;
}

/* The third word of backend.h on caches. */
static void without_a_cache_a_query_is_its_own_announcement(void **state)
{
    static native_grid grid;
    (void)state;
    fixture f;
    open_hills(&f, &grid);
    void *cache = f.context.cache;
    oracle_random r = {11};
    uint64_t hits = 0;
    for (int n = 0; n < 3000; n++) {
        answers with, without, unannounced;
        const tahr_sweep q = near_place(&r, v_make(6, 6, 1.2), 3.5, n);
        announce(&f, q.position, q.up, 0xFFFFFFFFu);
        ask(&f, &q, &with);
        f.context.cache = NULL;
        ask(&f, &q, &without);
        f.context.cache = cache;
        if (q.up.z < 1) forget_ray(&with), forget_ray(&without);
        assert_memory_equal(&with, &without, sizeof with);
        if (n % 100 == 0) {
            memset(cache, 0, tahr_backend_v1_native()->cache_size(f.self));
            ask(&f, &q, &unannounced);
            if (q.up.z < 1) forget_ray(&unannounced);
            assert_memory_equal(&with, &unannounced, sizeof with);
        }
        hits += with.hit_count;
    }
    assert_true(hits > 300);
    native_close(&f);
}

/* And its second: also where the query begins in another cell than that of the place. */
static void only_the_place_last_announced_counts(void **state)
{
    static native_grid grid;
    (void)state;
    fixture fresh, used;
    open_hills(&fresh, &grid);
    open_hills(&used, &grid);
    const size_t size = tahr_backend_v1_native()->cache_size(fresh.self);
    oracle_random r = {23};
    uint64_t hits = 0, across = 0, differ = 0;
    for (int n = 0; n < 3000; n++) {
        answers a, b, none;
        const tahr_vec3 place = v_add(v_make(6, 6, 1.2), dice_vec(&r, -3, 3));
        const tahr_vec3 before = v_add(place, dice_vec(&r, -2, 2));
        const tahr_sweep q = near_place(&r, place, 2, n), other = near_place(&r, before, 2, n);
        memset(fresh.context.cache, 0, size);
        announce(&fresh, place, q.up, 0xFFFFFFFFu);
        ask(&fresh, &q, &a);
        announce(&used, before, other.up, 1 + (uint32_t)(n % 2));
        ask(&used, &other, &b);
        announce(&used, place, q.up, 1 + (uint32_t)(n % 3));
        ask(&used, &other, &b);
        ask(&used, &q, &b);
        assert_memory_equal(&a, &b, sizeof a);
        fixture alone = used;
        alone.context.cache = NULL;
        ask(&alone, &q, &none);
        hits += a.hit_count;
        across += floor(place.x / 4) != floor(q.position.x / 4);
        differ += memcmp(&a, &none, sizeof a) != 0;
    }
    print_message("    %d of 3000 answers depend on the place announced\n", (int)differ);
    assert_true(hits > 300 && across > 300);
    native_close(&fresh);
    native_close(&used);
}

static void only_what_was_gathered_for_fewer_bodies_is_gathered_anew(void **state)
{
    (void)state;
    static native_grid grid;
    fixture f;
    tahr_body_desc bodies[NATIVE_HILLS];
    tahr_native_desc o = fixture_options();
    const tahr_vec3 at = {6, 6, 1.2}, up = {0, 0, 1};
    native_hills(&grid, bodies);
    o.cache_triangles = 400;
    fixture_init(&f);
    assert_int_equal(fixture_open(&f, bodies, NATIVE_HILLS, &o, 1), TAHR_OK);
    const struct {
        uint32_t mask, gathers;
    } steps[] = {{1, 1}, {1, 1}, {3, 2}, {1, 2}, {2, 2}, {0xFFFFFFFFu, 3}, {1, 3}};
    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++) {
        tahr_sweep q = fixture_sweep(native_shape(1), at, v_make(0.2, 0, -0.5), 0.01);
        q.mask = steps[i].mask;
        announce(&f, at, up, steps[i].mask);
        (void)fixture_hit(&f, &q);
        assert_int_equal(f.context.gathers, steps[i].gathers);
        assert_int_equal(f.context.escapes, 0); /* answered from what was gathered */
    }
    native_close(&f);
}

/* The triangle that stopped the last foot, by its name; TAHR__NONE: it is not in the cache. */
static uint32_t stopper(const fixture *f)
{
    tahr__cache *cache = f->context.cache;
    if (cache->recent[1] >= cache->count) return TAHR__NONE;
    const tahr__prim *p = &tahr__cache_prims(f->self, cache)[cache->recent[1]];
    assert_false(p->kind & TAHR__UNFORMED);
    assert_int_equal(p->body, 0);
    return p->item;
}

/* Over squares of 1 m: as long as its square is gathered, in the same cell of 4 m and in others. */
static void what_stopped_the_last_foot_is_known_after_a_gather(void **state)
{
    (void)state;
    static native_grid grid;
    tahr_body_desc body = native_grid_body(&grid, NATIVE_CELLS, 1, NULL);
    tahr_native_desc o = fixture_options();
    const tahr_vec3 up = {0, 0, 1};
    o.cache_margin = 0.5;
    for (int fields = 0; fields < 2; fields++) {
        fixture f;
        o.no_fields = (uint32_t)fields;
        fixture_init(&f);
        assert_int_equal(fixture_open(&f, &body, 1, &o, 1), TAHR_OK);
        tahr_sweep down =
            fixture_sweep(fixture_shape(TAHR_SHAPE_SPHERE, 0.3, 0.3), v_make(9.7, 9.2, 1), v_make(0, 0, -1), 0.01);
        announce(&f, down.position, up, 0xFFFFFFFFu);
        assert_int_equal(stopper(&f), TAHR__NONE);
        assert_int_equal(fixture_hit(&f, &down).blocking, 1);
        const uint32_t under = stopper(&f);
        assert_int_not_equal(under, TAHR__NONE);
        /* Boxes of 4.2 m: 1 m on it is in the next one, and beyond x = 12 in that of another cell; at 13 m it begins at
         * x = 10.9. */
        const double places[] = {10.7, 11.7, 12.05};
        for (int i = 0; i < 3; i++) {
            announce(&f, v_make(places[i], 9.2, 1), up, 0xFFFFFFFFu);
            assert_int_equal(f.context.gathers, i + 2);
            assert_int_equal(stopper(&f), under);
        }
        announce(&f, v_make(13, 9.2, 1), up, 0xFFFFFFFFu);
        assert_int_equal(f.context.gathers, 5);
        assert_int_equal(stopper(&f), TAHR__NONE);
        fixture_close(&f);
    }
}

static double small_hills(double x, double y)
{
    return 0.1 * sin(x * 1.3) * cos(y * 0.9);
}

/* Over triangles of 0.2 m, a third of a step or more away from the last: what stopped the last foot is seldom under this
 * one, and is not measured then. */
static void a_foot_measures_hardly_more_than_what_it_comes_down_on(void **state)
{
    (void)state;
    static native_grid grid;
    enum { FEET = 200 };
    tahr_body_desc body = native_grid_body(&grid, NATIVE_CELLS, 0.2, small_hills);
    tahr_native_desc o = fixture_options();
    o.cache_triangles = 4096;
    o.no_vicinity = 1;
    for (uint32_t fields = 0; fields < 2; fields++) {
        fixture f;
        o.no_fields = fields;
        fixture_init(&f);
        assert_int_equal(fixture_open(&f, &body, 1, &o, 1), TAHR_OK);
        const tahr_vec3 middle = v_make(0.1 * NATIVE_CELLS, 0.1 * NATIVE_CELLS, 0.6);
        announce(&f, middle, v_make(0, 0, 1), 0xFFFFFFFFu);
        const uint64_t before = f.context.narrow_tests;
        for (int n = 0; n < FEET; n++) {
            const tahr_vec3 at = v_add(middle, v_make(0.8 * sin(0.1 * n), 0.8 * cos(0.1 * n), 0));
            const tahr_sweep down =
                fixture_sweep(fixture_shape(TAHR_SHAPE_SPHERE, 0.35, 0.35), at, v_make(0, 0, -0.6), 0.01);
            assert_int_equal(fixture_hit(&f, &down).blocking, 1);
        }
        assert_int_equal(f.context.escapes, 0);
        assert_true(f.context.narrow_tests - before < 1.2 * FEET);
        fixture_close(&f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_foot_measures_hardly_more_than_what_it_comes_down_on),
        cmocka_unit_test(what_stopped_the_last_foot_is_known_after_a_gather),
        cmocka_unit_test(caches_and_lanes_change_no_bit),
        cmocka_unit_test(without_a_cache_a_query_is_its_own_announcement),
        cmocka_unit_test(only_the_place_last_announced_counts),
        cmocka_unit_test(only_what_was_gathered_for_fewer_bodies_is_gathered_anew),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
