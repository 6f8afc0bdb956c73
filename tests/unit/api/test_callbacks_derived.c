/* SPDX-License-Identifier: MIT
 * test_callbacks_derived.c: contacts of users who have only a sweep, and sweeps that know no margin. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <tahr/record.h>

#include "native_fixture.h"
#include "dice.h"
#include "rig.h"

/* A world of planes n . x = d, free where n . x > d. What a sweep of a capsule or sphere finds there has a closed form:
 * with e the reach of the shape against n, the gap is n . p - d - e, and it changes by n . motion. */
enum { PLANES = 6 };
typedef struct planes {
    tahr_vec3 n[PLANES];
    double d[PLANES];
    uint32_t count, calls, margins;
    oracle_random random; /* of the liar */
} planes;

static double dot3(tahr_vec3 a, tahr_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static double gap_of(const planes *w, uint32_t i, const tahr_shape *s, tahr_vec3 up, tahr_vec3 at)
{
    double core = s->type == TAHR_SHAPE_CAPSULE ? s->half_height - s->radius : 0;
    return dot3(w->n[i], at) - w->d[i] - s->radius - core * fabs(dot3(w->n[i], up));
}

static tahr_status sweep_planes(void *user, const tahr_sweep *q, tahr_hit *hit)
{
    planes *w = user;
    double deepest = 0, first = 2;
    w->calls++;
    w->margins += q->margin != 0;
    for (uint32_t i = 0; i < w->count; i++) {
        double gap = gap_of(w, i, &q->shape, q->up, q->position), rate = dot3(w->n[i], q->motion);
        int leaves = (q->flags & TAHR_SWEEP_LEAVE_OVERLAP) && rate >= 0;
        if (gap < deepest && !leaves) {
            deepest = gap;
            hit->start_overlap = 1;
            hit->depth = -gap;
            hit->normal = w->n[i];
            hit->body = i;
        }
        double t = gap <= q->margin ? 0 : (gap - q->margin) / -rate;
        if (gap < 0 || rate >= -1e-12 || t > 1 || t >= first || hit->start_overlap) continue;
        first = t;
        hit->blocking = 1;
        hit->fraction = t;
        hit->normal = w->n[i];
        hit->body = i;
    }
    if (hit->start_overlap) {
        hit->blocking = 0;
        hit->fraction = 0;
    }
    return TAHR_OK;
}

static tahr_world *open_planes(planes *w, uint32_t flags)
{
    tahr_callbacks c = {.struct_size = sizeof c, .flags = flags, .user = w, .sweep = sweep_planes};
    tahr_world *world = NULL;
    assert_int_equal(tahr_world_open_callbacks(&c, NULL, &world), TAHR_OK);
    return world;
}

/* Three unit vectors at right angles. */
static void make_corner(oracle_random *r, tahr_vec3 n[3])
{
    tahr_vec3 a = dice_direction(r), b = dice_direction(r);
    n[0] = a;
    n[1] = (tahr_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    double l = sqrt(dot3(n[1], n[1]));
    n[1] = (tahr_vec3){n[1].x / l, n[1].y / l, n[1].z / l};
    n[2] = (tahr_vec3){a.y * n[1].z - a.z * n[1].y, a.z * n[1].x - a.x * n[1].z, a.x * n[1].y - a.y * n[1].x};
}

/* Corners whose planes lie at given gaps from a capsule at the origin. */
static void place_corner(planes *w, oracle_random *r, const tahr_shape *s, const double gap[3])
{
    memset(w, 0, sizeof *w);
    w->count = 3;
    make_corner(r, w->n);
    for (uint32_t i = 0; i < 3; i++)
        w->d[i] = gap_of(w, i, s, (tahr_vec3){0, 0, 1}, (tahr_vec3){0, 0, 0}) - gap[i];
}

static void assert_all_found(const planes *w, const double gap[3], const tahr_contact *c, uint32_t count)
{
    assert_int_equal(count, 3);
    for (uint32_t i = 0; i < 3; i++) {
        assert_near(c[i].distance, gap[c[i].body], 1e-12);
        assert_near(dot3(c[i].normal, w->n[c[i].body]), 1, 1e-12);
        if (i > 0) assert_true(c[i - 1].distance <= c[i].distance);
    }
    assert_true(c[0].body != c[1].body && c[1].body != c[2].body && c[2].body != c[0].body);
}

static void all_overlaps_of_a_corner_are_found_one_after_the_other(void **unused)
{
    oracle_random r = {4};
    const tahr_shape s = fixture_shape(TAHR_SHAPE_CAPSULE, 0.35, 0.9);
    (void)unused;
    for (int n = 0; n < 500; n++) {
        planes w;
        tahr_contact c[8];
        uint32_t count = 0;
        const double gap[3] = {-oracle_uniform(&r, 0, 0.1), -oracle_uniform(&r, 0, 0.1), -oracle_uniform(&r, 0, 0.1)};
        place_corner(&w, &r, &s, gap);
        tahr_world *world = open_planes(&w, 0);
        tahr_contact_query q = fixture_contacts(s, (tahr_vec3){0, 0, 0}, 0);
        assert_int_equal(tahr_world_contacts(world, &q, c, 8, &count), TAHR_OK);
        assert_all_found(&w, gap, c, count);
        assert_int_equal(w.calls, 4); /* the last finds nothing */
        assert_int_equal(tahr_world_contacts(world, &q, c, 2, &count), TAHR_TRUNCATED);
        assert_int_equal(count, 2);
        tahr_world_close(world);
    }
}

/* At every turn of the corner: no plane within the margin slips between the directions. */
static void probing_finds_what_is_near_too(void **unused)
{
    oracle_random r = {6};
    const tahr_shape s = fixture_shape(TAHR_SHAPE_CAPSULE, 0.35, 0.9);
    (void)unused;
    for (int n = 0; n < 2000; n++) {
        planes w;
        tahr_contact c[8];
        uint32_t count = 0;
        double gap[3];
        for (int i = 0; i < 3; i++)
            gap[i] = oracle_uniform(&r, n % 2 ? -0.01 : 0, 0.0199);
        place_corner(&w, &r, &s, gap);
        tahr_contact_query q = fixture_contacts(s, (tahr_vec3){0, 0, 0}, 0.02);
        tahr_world *world = open_planes(&w, TAHR_CALLBACKS_PROBE);
        assert_int_equal(tahr_world_contacts(world, &q, c, 8, &count), TAHR_OK);
        assert_all_found(&w, gap, c, count);
        assert_true(w.calls <= 46);
        tahr_world_close(world);
        w.calls = 0;
        world = open_planes(&w, 0); /* without it only what is overlapped */
        assert_int_equal(tahr_world_contacts(world, &q, c, 8, &count), TAHR_OK);
        assert_int_equal(count, (gap[0] < 0) + (gap[1] < 0) + (gap[2] < 0));
        tahr_world_close(world);
    }
}

/* Beyond the margin there is nothing, and nothing is made up. */
static void probing_finds_nothing_beyond_the_margin(void **unused)
{
    oracle_random r = {8};
    const tahr_shape s = fixture_shape(TAHR_SHAPE_SPHERE, 0.35, 0.35);
    (void)unused;
    for (int n = 0; n < 300; n++) {
        planes w;
        tahr_contact c[8];
        uint32_t count = 9;
        const double gap[3] = {oracle_uniform(&r, 0.0201, 0.03), oracle_uniform(&r, 0.0201, 0.03), 1};
        place_corner(&w, &r, &s, gap);
        tahr_contact_query q = fixture_contacts(s, (tahr_vec3){0, 0, 0}, 0.02);
        tahr_world *world = open_planes(&w, TAHR_CALLBACKS_PROBE);
        assert_int_equal(tahr_world_contacts(world, &q, c, 8, &count), TAHR_OK);
        assert_int_equal(count, 0);
        tahr_world_close(world);
    }
}

/* A gutter of two planes at 45 degrees and the ground below: who begins 5 cm deep in both is out in one step, and every
 * call of the user's sweep has been counted. */
static void who_is_in_two_walls_gets_out_and_every_sweep_is_counted(void **unused)
{
    (void)unused;
    for (uint32_t flags = 0; flags < 4; flags++) {
        planes w = {.n = {{0.8, 0, 0.6}, {-0.8, 0, 0.6}}, .count = 2};
        tahr_callbacks c = {.struct_size = sizeof c, .flags = flags, .user = &w, .sweep = sweep_planes};
        rig r;
        rig_open_callbacks(&r, &c, NULL, fake_vec(0, 0, 0));
        for (uint32_t i = 0; i < 2; i++)
            w.d[i] = gap_of(&w, i, &r.config.shape, (tahr_vec3){0, 0, 1}, (tahr_vec3){0, 0, 0}) + 0.05;
        for (int i = 0; i < 30; i++) {
            w.calls = 0;
            assert_true(rig_step(&r, 1.0 / 60) >= 0);
            assert_int_equal(w.calls, r.report.sweeps + r.report.contact_queries + r.report.rays);
            for (uint32_t k = 0; k < 2; k++)
                assert_true(gap_of(&w, k, &r.config.shape, (tahr_vec3){0, 0, 1}, r.state.position) > 0);
        }
        assert_int_equal(w.margins > 0, !(flags & TAHR_CALLBACKS_NO_MARGIN));
        rig_close(&r);
    }
}

/* A recorder that hands every question on through a table of its own. */
static tahr_status watch(void *user, tahr_record_world *world)
{
    tahr_backend *table = user;
    *table = *world->backend;
    world->backend = table;
    return TAHR_OK;
}

static void who_watches_changes_no_count_of_derived_sweeps(void **unused)
{
    (void)unused;
    tahr_backend table;
    tahr_recorder recorder = {.struct_size = sizeof recorder, .user = &table, .begin = watch};
    planes w = {.n = {{0, 0, 1}, {-1, 0, 0}}, .d = {0, 2}, .count = 2};
    tahr_callbacks c = {.struct_size = sizeof c, .flags = TAHR_CALLBACKS_PROBE, .user = &w, .sweep = sweep_planes};
    rig r;
    uint32_t contacts = 0;
    rig_open_callbacks(&r, &c, NULL, fake_vec(0, 0, 1));
    assert_int_equal(tahr_world_record(r.world, &recorder), TAHR_OK);
    for (int i = 0; i < 120; i++) {
        w.calls = 0;
        r.input.move = fake_vec(1, 0.2, 0);
        assert_true(rig_step(&r, 1.0 / 60) >= 0);
        assert_int_equal(w.calls, r.report.sweeps + r.report.contact_queries + r.report.rays);
        contacts += r.report.contact_queries;
    }
    assert_true(contacts > 0);
    rig_close(&r);
}

static tahr_status lying_sweep(void *user, const tahr_sweep *q, tahr_hit *hit)
{
    planes *w = user;
    (void)q;
    w->calls++;
    hit->start_overlap = 1;
    hit->depth = oracle_uniform(&w->random, 0, 0.2);
    hit->normal = dice_direction(&w->random);
    return TAHR_OK;
}

static void derived_contacts_keep_the_cap_of_queries(void **unused)
{
    (void)unused;
    for (uint32_t flags = 0; flags < 4; flags++) {
        planes w = {.random = {flags + 1}};
        tahr_callbacks c = {.struct_size = sizeof c, .flags = flags, .user = &w, .sweep = lying_sweep};
        rig r;
        rig_open_callbacks(&r, &c, NULL, fake_vec(0, 0, 0));
        for (int i = 0; i < 60; i++) {
            w.calls = 0;
            r.input.move = fake_vec(1, 0, 0);
            assert_true(rig_step(&r, 1.0 / 60) >= 0);
            assert_true(w.calls <= TAHR_MAX_QUERIES_PER_STEP);
        }
        rig_close(&r);
    }
}

static tahr_status broken_sweep(void *user, const tahr_sweep *q, tahr_hit *hit)
{
    (void)q;
    hit->start_overlap = 1;
    hit->depth = *(int *)user == 0 ? NAN : 0.1;
    hit->normal = *(int *)user == 1 ? fake_vec(NAN, 0, 1) : *(int *)user == 2 ? fake_vec(9, 0, 0) : fake_vec(0, 0, 1);
    return *(int *)user == 3 ? TAHR_E_MEMORY : TAHR_OK;
}

static void bad_answers_behind_derived_contacts_are_refused(void **unused)
{
    (void)unused;
    for (int kind = 0; kind < 4; kind++) {
        tahr_callbacks c = {.struct_size = sizeof c, .user = &kind, .sweep = broken_sweep};
        tahr_contact_query q = fixture_contacts(fixture_shape(TAHR_SHAPE_SPHERE, 1, 1), fake_vec(0, 0, 0), 0);
        tahr_contact out[4];
        uint32_t count = 0;
        tahr_world *world = NULL;
        assert_int_equal(tahr_world_open_callbacks(&c, NULL, &world), TAHR_OK);
        assert_int_equal(tahr_world_contacts(world, &q, out, 4, &count), TAHR_E_BACKEND);
        tahr_world_close(world);
    }
}

/* The same course, once with the margin left to the core. On planes a grown capsule tells the same. */
static void a_sweep_without_margin_walks_like_one_with(void **unused)
{
    (void)unused;
    rig r[2];
    planes w[2];
    for (uint32_t i = 0; i < 2; i++) {
        /* The ground, a slope of 20 degrees from x = 3 on, a wall at x = 12. */
        w[i] = (planes){.n = {{0, 0, 1}, {-0.3420201433256687, 0, 0.9396926207859084}, {-1, 0, 0}},
                        .d = {0, -3 * 0.3420201433256687, -12},
                        .count = 3};
        tahr_callbacks c = {.struct_size = sizeof c, .flags = i, .user = &w[i], .sweep = sweep_planes};
        rig_open_callbacks(&r[i], &c, NULL, fake_vec(0, 0, 1.2));
    }
    for (int n = 0; n < 300; n++) {
        for (int i = 0; i < 2; i++) {
            r[i].input.move = fake_vec(n < 150 ? 1 : -0.5, 0.3, 0);
            r[i].input.jump = n == 60 || n == 200;
            assert_int_equal(rig_step(&r[i], 1.0 / 60), TAHR_OK);
        }
        assert_near(r[0].state.position.x, r[1].state.position.x, 1e-6);
        assert_near(r[0].state.position.y, r[1].state.position.y, 1e-6);
        assert_near(r[0].state.position.z, r[1].state.position.z, 1e-6);
        assert_int_equal(r[0].state.mode, r[1].state.mode);
    }
    assert_true(w[0].margins > 0 && w[1].margins == 0);
    rig_close(&r[0]);
    rig_close(&r[1]);
}

static void unknown_flags_of_callbacks_are_refused(void **unused)
{
    planes w = {.count = 0};
    tahr_callbacks c = {.struct_size = sizeof c, .flags = 4, .user = &w, .sweep = sweep_planes};
    tahr_world *world = NULL;
    (void)unused;
    assert_int_equal(tahr_world_open_callbacks(&c, NULL, &world), TAHR_E_UNSUPPORTED);
    assert_null(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_overlaps_of_a_corner_are_found_one_after_the_other),
        cmocka_unit_test(probing_finds_what_is_near_too),
        cmocka_unit_test(probing_finds_nothing_beyond_the_margin),
        cmocka_unit_test(who_is_in_two_walls_gets_out_and_every_sweep_is_counted),
        cmocka_unit_test(who_watches_changes_no_count_of_derived_sweeps),
        cmocka_unit_test(derived_contacts_keep_the_cap_of_queries),
        cmocka_unit_test(bad_answers_behind_derived_contacts_are_refused),
        cmocka_unit_test(a_sweep_without_margin_walks_like_one_with),
        cmocka_unit_test(unknown_flags_of_callbacks_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
