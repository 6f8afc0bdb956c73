/* SPDX-License-Identifier: MIT
 * test_corner.c: who comes to a corner over one of its triangles has weighed it for all of them: the same bits as by
 * each of them (no_vicinity), and less work. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "native_fixture.h"
#include "oracle.h"

/* Dents and peaks whose heights are often equal, so that faces at a corner often oppose a motion alike. */
static double peaks(double x, double y)
{
    return 0.25 * (double)(((int)floor(x) * 5 + (int)floor(y) * 3) & 3);
}

/* Sweeps of spheres and capsules past, at and onto corners, some exactly and some a little beside. Returns how much
 * less was measured, of all. */
static double compare(const tahr_body_desc *body, const tahr_vec3 *corners, uint32_t corner_count, uint64_t seed)
{
    oracle_random random = {.state = seed};
    tahr_native_desc options = fixture_options();
    fixture with, without;
    uint32_t hits = 0;
    fixture_init(&with);
    fixture_init(&without);
    assert_int_equal(fixture_open(&with, body, 1, &options, 0), TAHR_OK);
    options.no_vicinity = 1;
    assert_int_equal(fixture_open(&without, body, 1, &options, 0), TAHR_OK);
    for (int i = 0; i < 4000; i++) {
        const tahr_vec3 c = corners[oracle_below(&random, corner_count)];
        const double off = oracle_below(&random, 2) ? 0.3 : 0;
        tahr_shape shape = fixture_shape(i % 3 ? TAHR_SHAPE_SPHERE : TAHR_SHAPE_CAPSULE, 0.35, i % 3 ? 0.35 : 0.9);
        tahr_vec3 from = {c.x + oracle_uniform(&random, -off, off), c.y + oracle_uniform(&random, -off, off),
                          c.z + oracle_uniform(&random, 0.9, 1.6)};
        tahr_vec3 motion = {oracle_uniform(&random, -off, off), oracle_uniform(&random, -off, off), -1.5};
        tahr_sweep sweep = fixture_sweep(shape, from, motion, 0.01);
        tahr_hit a = fixture_hit(&with, &sweep), b = fixture_hit(&without, &sweep);
        assert_memory_equal(&a, &b, sizeof a);
        hits += a.blocking;
    }
    assert_true(hits > 1000);
    double less = 1 - (double)with.context.narrow_iterations / (double)without.context.narrow_iterations;
    fixture_close(&with);
    fixture_close(&without);
    return less;
}

static void the_corners_of_a_box_are_met_alike_over_any_triangle(void **unused)
{
    tahr_body_desc box = fixture_body(TAHR_BODY_BOX);
    tahr_vec3 corners[4];
    (void)unused;
    for (int i = 0; i < 4; i++)
        corners[i] = (tahr_vec3){i & 1 ? 1 : -1, i & 2 ? 1 : -1, 1};
    box.half_extents = (tahr_vec3){1, 1, 1};
    assert_true(compare(&box, corners, 4, 1) > 0);
}

static void the_corners_of_a_mesh_are_met_alike_over_any_triangle(void **unused)
{
    enum { CELLS = 6 };
    double vertices[3 * (CELLS + 1) * (CELLS + 1)];
    uint32_t indices[6 * CELLS * CELLS], kept = 0;
    tahr_vec3 corners[(CELLS + 1) * (CELLS + 1)];
    (void)unused;
    fixture_grid(CELLS, 1, peaks, vertices, indices);
    for (uint32_t i = 0; i < (CELLS + 1) * (CELLS + 1); i++) {
        corners[kept++] = (tahr_vec3){vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]};
    }
    tahr_body_desc mesh = fixture_mesh(vertices, kept, indices, 2 * CELLS * CELLS - 1); /* and so no field of heights */
    assert_true(compare(&mesh, corners, kept, 2) > 0);
    mesh.flags |= TAHR_BODY_TWO_SIDED;
    compare(&mesh, corners, kept, 3);
}

/* Two bodies with up to two cones each, all with the same tip: cones of a body share no edge, those of two nothing. */
enum { RING = 40, VERTICES = 2 * (RING + 1), TRIANGLES = 2 * RING };
typedef struct spikes {
    tahr_body_desc bodies[2];
    double vertices[2][3 * VERTICES];
    uint32_t indices[2][3 * TRIANGLES], count[2], triangles[2];
} spikes;

/* Around the tip at the origin; heights that are often equal, and rings of more triangles than are looked at. */
static void add_cone(spikes *s, int body, int turned, oracle_random *r)
{
    const uint32_t sides = oracle_below(r, 8) ? 3 + oracle_below(r, 6) : RING, first = s->count[body];
    for (uint32_t i = 0; i < sides; i++) {
        const double angle = 6.283185307179586 * (i + (turned ? 0.25 : 0)) / sides;
        double *v = s->vertices[body] + 3 * (size_t)(first + i);
        v[0] = cos(angle);
        v[1] = sin(angle);
        v[2] = sides == RING ? -0.5 : -0.25 * (double)(1 + oracle_below(r, 3));
        uint32_t *t = s->indices[body] + 3 * (size_t)s->triangles[body]++;
        t[0] = 0, t[1] = first + i, t[2] = first + (i + 1) % sides;
    }
    s->count[body] += sides;
}

static void make_spikes(spikes *s, oracle_random *r)
{
    memset(s, 0, sizeof *s);
    for (int b = 0; b < 2; b++) {
        s->count[b] = 1;
        add_cone(s, b, b, r);
        if (oracle_below(r, 2)) add_cone(s, b, (int)oracle_below(r, 2), r);
        s->bodies[b] = fixture_mesh(s->vertices[b], s->count[b], s->indices[b], s->triangles[b]);
        s->bodies[b].flags |= oracle_below(r, 2) ? (uint32_t)TAHR_BODY_TWO_SIDED : 0;
    }
}

/* What has been found at one tip says nothing of another at the same place, nor of a cone that is not connected, nor of
 * one of which not all has been seen. */
static void tips_at_one_place_are_told_apart(void **unused)
{
    oracle_random r = {.state = 4};
    static spikes s;
    uint32_t hits = 0;
    (void)unused;
    for (int run = 0; run < 600; run++) {
        tahr_native_desc options = fixture_options();
        fixture with, without;
        make_spikes(&s, &r);
        fixture_init(&with);
        fixture_init(&without);
        const uint32_t bodies = oracle_below(&r, 4) ? 2 : 1;
        assert_int_equal(fixture_open(&with, s.bodies, bodies, &options, 0), TAHR_OK);
        options.no_vicinity = 1;
        assert_int_equal(fixture_open(&without, s.bodies, bodies, &options, 0), TAHR_OK);
        for (int i = 0; i < 200; i++) {
            const int round = (int)oracle_below(&r, 2);
            const double radius = oracle_below(&r, 2) ? 0.35 : 0.05, off = oracle_below(&r, 3) ? 0.2 : 0;
            const tahr_shape shape =
                fixture_shape(round ? TAHR_SHAPE_SPHERE : TAHR_SHAPE_CAPSULE, radius, round ? radius : 0.9);
            const tahr_vec3 from = {oracle_uniform(&r, -off, off), oracle_uniform(&r, -off, off),
                                    oracle_uniform(&r, 0.95, 1.6)};
            const double side = oracle_below(&r, 3) ? 0.5 : 0;
            const tahr_vec3 motion = {oracle_uniform(&r, -side, side) - from.x,
                                      oracle_uniform(&r, -side, side) - from.y, -1.6};
            const tahr_sweep sweep = fixture_sweep(shape, from, motion, 0.01);
            const tahr_hit a = fixture_hit(&with, &sweep), b = fixture_hit(&without, &sweep);
            assert_memory_equal(&a, &b, sizeof a);
            hits += a.blocking;
        }
        fixture_close(&with);
        fixture_close(&without);
    }
    assert_true(hits > 30000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_corners_of_a_box_are_met_alike_over_any_triangle),
                                       cmocka_unit_test(the_corners_of_a_mesh_are_met_alike_over_any_triangle),
                                       cmocka_unit_test(tips_at_one_place_are_told_apart)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
