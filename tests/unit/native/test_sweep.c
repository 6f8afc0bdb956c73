/* SPDX-License-Identifier: MIT
 * test_sweep.c: sweeps of the native backend against brute force, at their start, among sensors. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "native_world.h"

enum { SOUP = 32 };

typedef struct soup {
    double vertices[SOUP * 9];
    uint32_t indices[SOUP * 3];
    double offset[3];
} soup;

static void soup_make(soup *s, oracle_random *r, double size, double far)
{
    for (int k = 0; k < 3; k++)
        s->offset[k] = far;
    for (uint32_t i = 0; i < SOUP; i++) {
        double middle[3];
        for (int k = 0; k < 3; k++)
            middle[k] = oracle_uniform(r, -2, 2);
        for (int k = 0; k < 9; k++)
            s->vertices[9 * i + (uint32_t)k] = middle[k % 3] + oracle_uniform(r, -size, size);
        for (uint32_t k = 0; k < 3; k++)
            s->indices[3 * i + k] = 3 * i + k;
    }
}

static oracle_core core_of(const tahr_shape *shape, tahr_vec3 position, const double offset[3])
{
    oracle_core core;
    memset(&core, 0, sizeof core);
    core.centre[0] = position.x - offset[0];
    core.centre[1] = position.y - offset[1];
    core.centre[2] = position.z - offset[2];
    if (shape->type == TAHR_SHAPE_CAPSULE) {
        core.axis_count = 1;
        core.axis[0][2] = shape->half_height - shape->radius;
    } else if (shape->type == TAHR_SHAPE_BOX) {
        core.axis_count = 3;
        core.axis[0][0] = shape->half_x;
        core.axis[1][1] = shape->half_y;
        core.axis[2][2] = shape->half_height;
    }
    return core;
}

static double soup_distance(const soup *s, const oracle_core *core, const double motion[3], double t)
{
    long double best = 1e30L;
    for (uint32_t i = 0; i < SOUP; i++) {
        double tri[3][3];
        memcpy(tri, &s->vertices[9 * i], sizeof tri);
        long double d = oracle_distance(core, motion, t, tri);
        if (d < best) best = d;
    }
    return (double)best;
}

static double soup_smallest(const soup *s, const oracle_core *core, const double motion[3])
{
    long double best = 1e30L;
    for (uint32_t i = 0; i < SOUP; i++) {
        double tri[3][3];
        memcpy(tri, &s->vertices[9 * i], sizeof tri);
        long double d = oracle_smallest(core, motion, tri);
        if (d < best) best = d;
    }
    return (double)best;
}

/* Gap error of hits and misses: the distance at the reported place, against the target. Two-sided soup, nothing
 * shared. */
static void sweep_against_truth(int kind, double size, double far)
{
    const double tolerance = 1e-9;
    oracle_random r = {(uint64_t)kind * 77 + 1 + (uint64_t)far + (uint64_t)size};
    int hits = 0, misses = 0;
    for (int scene = 0; scene < 3; scene++) {
        soup s;
        fixture f;
        soup_make(&s, &r, size, far);
        tahr_body_desc body = fixture_mesh(s.vertices, SOUP * 3, s.indices, SOUP);
        body.flags = TAHR_BODY_TWO_SIDED;
        body.pose.position = v_make(far, far, far);
        native_open(&f, &body, 1, 1);
        for (int n = 0; n < (kind == 2 ? 10 : 40); n++) {
            tahr_shape shape = native_shape(kind);
            tahr_vec3 p = dice_vec(&r, far - 4, far + 4), to = dice_vec(&r, far - 2, far + 2);
            double motion[3] = {to.x - p.x, to.y - p.y, to.z - p.z};
            tahr_sweep q = fixture_sweep(shape, p, v_make(motion[0], motion[1], motion[2]), n % 2 ? 0.01 : 0.05);
            fixture_announce(&f, p, 2);
            tahr_hit h = fixture_hit(&f, &q);
            oracle_core core = core_of(&shape, p, s.offset);
            double target = shape.radius + q.margin;
            double start = soup_distance(&s, &core, motion, 0) - shape.radius;
            if (h.start_overlap || start < -tolerance) {
                assert_true(h.blocking == 1 && h.start_overlap == 1 && h.fraction == 0 && h.depth == -h.distance);
                /* A crossed core is at distance 0, which the oracle only nears. */
                if (start > 1e-6 - shape.radius) assert_true(fabs(h.depth + start) <= tolerance);
            } else if (start <= q.margin) {
                continue; /* blocks or not by the direction: another test */
            } else if (h.blocking) {
                double gap = soup_distance(&s, &core, motion, h.fraction) - target;
                if (fabs(gap) > tolerance) fail_msg("kind %d gap error %g at %.17g", kind, gap, h.fraction);
                assert_true(v_dot(h.normal, q.motion) < 0 && fabs(v_dot(h.normal, h.normal) - 1) < 1e-9);
                hits++;
            } else {
                double gap = soup_smallest(&s, &core, motion) - target;
                if (gap < -tolerance) fail_msg("kind %d missed by %g", kind, gap);
                misses++;
            }
        }
        native_close(&f);
    }
    assert_true(hits >= 8 && misses >= 4); /* else nothing was tested */
}

static void sweeps_are_within_a_nanometre(void **state)
{
    (void)state;
    for (int kind = 0; kind < NATIVE_KINDS; kind++) {
        sweep_against_truth(kind, 0.5, 0);
        sweep_against_truth(kind, 30, 0);
    }
    sweep_against_truth(1, 0.5, 1048576);
}

static void start_follows_the_contract(void **state)
{
    (void)state;
    fixture f;
    static native_grid grid;
    tahr_body_desc body = native_grid_body(&grid, 4, 1, NULL);
    native_open(&f, &body, 1, 0);
    tahr_shape shape = fixture_shape(TAHR_SHAPE_CAPSULE, 0.3, 0.9);
    tahr_sweep q = fixture_sweep(shape, v_make(2.1, 2.2, 0.9), v_make(1, 0, 0), 0.01);
    /* Touching, parallel and away: free. */
    q.position.z = 0.905;
    assert_int_equal(fixture_hit(&f, &q).blocking, 0);
    q.motion = v_make(1, 0, 0.1);
    assert_int_equal(fixture_hit(&f, &q).blocking, 0);
    /* Within the margin and approaching: fraction 0 at the distance it has. */
    q.motion = v_make(1, 0, -0.1);
    tahr_hit h = fixture_hit(&f, &q);
    assert_true(h.blocking == 1 && h.fraction == 0 && h.start_overlap == 0 && fabs(h.distance - 0.005) < 1e-12);
    assert_true(h.normal.x == 0 && h.normal.y == 0 && h.normal.z == 1);
    /* Overlap: reported whatever the motion; with LEAVE_OVERLAP only a motion deeper is. */
    q.position.z = 0.85;
    q.motion = v_make(1, 0, 0.1);
    h = fixture_hit(&f, &q);
    assert_true(h.start_overlap == 1 && h.blocking == 1 && fabs(h.depth - 0.05) < 1e-12 && h.distance == -h.depth);
    q.flags = TAHR_SWEEP_LEAVE_OVERLAP;
    assert_int_equal(fixture_hit(&f, &q).blocking, 0);
    q.motion = v_make(1, 0, -0.1);
    assert_int_equal(fixture_hit(&f, &q).start_overlap, 1);
    /* Core through the floor: out of the front. */
    q.position.z = 0.2;
    h = fixture_hit(&f, &q);
    assert_true(h.start_overlap == 1 && fabs(h.depth - 0.7) < 1e-12 && h.normal.z == 1);
    /* From behind a one-sided face: free, up to and through it. */
    q.position.z = -2;
    q.motion = v_make(0, 0, 4);
    assert_int_equal(fixture_hit(&f, &q).blocking, 0);
    /* No motion at all: only overlaps count. */
    q.position.z = 0.905;
    q.motion = v_make(0, 0, 0);
    assert_int_equal(fixture_hit(&f, &q).blocking, 0);
    native_close(&f);
}

/* The same box three times, the first of them movable: which one is found first must not matter. */
/* Into a corner of two walls: which one is met first by less than a hair changes nothing but the fraction's last
 * bits. */
static void a_hair_does_not_decide_which_surface_is_met(void **state)
{
    (void)state;
    for (int cached = 0; cached < 2; cached++) {
        fixture f;
        tahr_body_desc bodies[2] = {native_box(v_make(3, 0, 0), v_make(1, 5, 5)),
                                    native_box(v_make(0, 3, 0), v_make(5, 1, 5))};
        native_open(&f, bodies, 2, cached);
        for (int k = -6; k <= 6; k++) {
            double off = k * 1e-10; /* nearer to the second wall, if positive */
            tahr_sweep q = fixture_sweep(native_shape(0), v_make(0, off, 0), v_make(3, 3, 0), 0.01);
            if (cached) fixture_announce(&f, q.position, 5);
            tahr_hit h = fixture_hit(&f, &q);
            double x = (2 - q.shape.radius - q.margin) / 3, y = x - off / 3;
            assert_true(h.blocking && h.body == 0 && h.normal.x == -1);
            assert_true(fabs(h.fraction - d_min(x, y)) < 1e-10);
        }
        /* Beyond a hair the one that is met first is reported. */
        tahr_sweep q = fixture_sweep(native_shape(0), v_make(0, 1e-7, 0), v_make(3, 3, 0), 0.01);
        if (cached) fixture_announce(&f, q.position, 5);
        assert_int_equal(fixture_hit(&f, &q).body, 1);
        native_close(&f);
    }
}

static void ties_go_to_the_lowest_body(void **state)
{
    (void)state;
    for (int cached = 0; cached < 2; cached++) {
        fixture f;
        tahr_body_desc bodies[3];
        tahr_contact contact;
        uint32_t count = 0;
        for (int i = 0; i < 3; i++)
            bodies[i] = native_box(v_make(3, 0, 0), v_make(1, 1, 1));
        bodies[0].flags = TAHR_BODY_MOVABLE;
        native_open(&f, bodies, 3, cached);
        for (int kind = 0; kind < NATIVE_KINDS; kind++) {
            tahr_shape shape = native_shape(kind);
            /* Onto the top's face, the edge of faces 1 and 5, and the corner of faces 1, 3 and 5. */
            for (int n = 0; n < 3; n++) {
                const tahr_vec3 at[3] = {{3, 0, 4}, {4.1, 0, 4}, {4.1, 1.1, 4}};
                tahr_sweep q = fixture_sweep(shape, at[n], v_make(0, 0, -3), 0.01);
                if (cached) fixture_announce(&f, q.position, 5);
                tahr_hit h = fixture_hit(&f, &q);
                assert_true(h.blocking && h.body == 0);
                assert_true(h.feature == 5 || (n > 0 && h.feature % 2 == 1)); /* of the faces that meet there */
            }
            tahr_contact_query c = fixture_contacts(shape, v_make(3, 0, 1.005 + shape.half_height), 0.01);
            tahr_backend_v1_native()->contacts(f.self, &f.context, &c, &contact, 1, &count);
            assert_true(count == 1 && contact.body == 0 && contact.feature == 5);
        }
        native_close(&f);
    }
}

static void sensors_come_before_the_blocking_hit(void **state)
{
    (void)state;
    fixture f;
    tahr_body_desc bodies[3];
    for (int i = 0; i < 3; i++) {
        bodies[i] = native_box(v_make(6 - 2 * i, 0, 0), v_make(0.5, 2, 2));
        bodies[i].flags = i ? TAHR_BODY_SENSOR : 0;
        bodies[i].mask = 1u << i;
    }
    native_open(&f, bodies, 3, 0);
    tahr_hit hits[4];
    uint32_t count = 0;
    tahr_sweep q = fixture_sweep(fixture_shape(TAHR_SHAPE_SPHERE, 0.3, 0.3), v_make(0, 0, 0), v_make(10, 0, 0), 0.01);
    const tahr_backend *b = tahr_backend_v1_native();
    assert_int_equal(b->sweep(f.self, &f.context, &q, hits, 4, &count), TAHR_OK);
    assert_int_equal(count, 3);
    assert_true(hits[0].body == 2 && hits[0].sensor && !hits[0].blocking);
    assert_true(hits[1].body == 1 && hits[2].body == 0 && hits[2].blocking);
    assert_true(hits[0].fraction < hits[1].fraction && hits[1].fraction < hits[2].fraction);
    assert_int_equal(b->sweep(f.self, &f.context, &q, hits, 2, &count), TAHR_TRUNCATED);
    assert_true(count == 2 && hits[0].body == 2 && hits[1].body == 0);
    assert_int_equal(b->sweep(f.self, &f.context, &q, hits, 1, &count), TAHR_OK);
    assert_true(count == 1 && hits[0].body == 0);
    q.mask = 2;
    assert_int_equal(b->sweep(f.self, &f.context, &q, hits, 4, &count), TAHR_OK);
    assert_true(count == 1 && hits[0].body == 1);
    q.mask = 7;
    q.ignore_body = 0;
    b->sweep(f.self, &f.context, &q, hits, 4, &count);
    assert_true(count == 2 && hits[1].body == 1);
    native_close(&f);
}

/* Of two flat faces that meet without a margin no point is the nearest; the hit still names the upper face, and a point
 * of it under the box, also where the side of the ledge is met at the same time. */
static void box_without_a_margin_names_the_face_it_lands_on(void **unused)
{
    (void)unused;
    const double tolerance = 1e-9;
    oracle_random r = {91};
    for (int i = 0; i < 300; i++) {
        fixture f;
        double edge = oracle_uniform(&r, -0.5, 0.2), half_yaw = oracle_uniform(&r, 0, 3),
               drop = oracle_uniform(&r, 0.01, 2);
        tahr_body_desc ledge = native_box(v_make(edge + 3, 0, -1), v_make(3, 4, 1));
        tahr_sweep q =
            fixture_sweep(fixture_shape(TAHR_SHAPE_BOX, 0.25, 0.6), v_make(0, 0, 0.6 + drop), v_make(0, 0, -3), 0);
        native_open(&f, &ledge, 1, i % 2);
        q.orientation = (tahr_quat){0, 0, sin(half_yaw), cos(half_yaw)};
        tahr_hit hit = fixture_hit(&f, &q);
        assert_true(hit.blocking && !hit.start_overlap);
        assert_true(fabs(hit.fraction * 3 - drop) <= tolerance);
        assert_true(hit.surface_normal.z > 1 - 1e-9 && hit.normal.z > 1 - 1e-9);
        assert_true(fabs(hit.point.z) <= tolerance && hit.point.x >= edge - tolerance);
        assert_true(hypot(hit.point.x, hit.point.y) <= 0.25 * sqrt(2.0) + tolerance);
        native_close(&f);
    }
}

/* Past an edge, or past a corner, at almost the distance that is asked for: the distance is a root with a double zero
 * nearly, which Newton's method halves its way to. Met where the closed form says, and found out in a few measurements,
 * whichever it is. */
static void what_grazes_is_met_or_passed_and_soon_known(void **unused)
{
    (void)unused;
    static const double edge[9] = {0, -5, 0, 0, 5, 0, 0, 0, -5}, corner[9] = {0, 0, 0, 0.5, 5, -5, -0.5, 5, -5};
    static const uint32_t names[3] = {0, 1, 2};
    const double target = 0.31, tolerance = 1e-9;
    for (int n = 0; n < 36; n++) {
        const double off = pow(10, -2 - 0.4 * (n / 2)), by = n % 2 ? -off : off, height = target + by;
        for (int k = 0; k < 4; k++) {
            fixture f;
            tahr_body_desc body = fixture_mesh(k % 2 ? corner : edge, 3, names, 1);
            body.flags = TAHR_BODY_TWO_SIDED;
            native_open(&f, &body, 1, 1);
            tahr_shape shape = fixture_shape(k / 2 ? TAHR_SHAPE_CAPSULE : TAHR_SHAPE_SPHERE, 0.3, k / 2 ? 0.9 : 0.3);
            double middle = height + (k / 2 ? 0.6 : 0);
            tahr_sweep q = fixture_sweep(shape, v_make(-1, 0, middle), v_make(2, 0, 0), 0.01);
            uint64_t before = f.context.narrow_iterations;
            tahr_hit h = fixture_hit(&f, &q);
            uint64_t looks = f.context.narrow_iterations - before;
            if (off > tolerance) assert_int_equal(h.blocking, by < 0);
            if (h.blocking) assert_true(fabs(hypot(2 * h.fraction - 1, height) - target) <= tolerance);
            if (by > tolerance) assert_true(looks <= 8); /* by halving: one for every factor of four */
            native_close(&f);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sweeps_are_within_a_nanometre),
        cmocka_unit_test(start_follows_the_contract),
        cmocka_unit_test(a_hair_does_not_decide_which_surface_is_met),
        cmocka_unit_test(box_without_a_margin_names_the_face_it_lands_on),
        cmocka_unit_test(what_grazes_is_met_or_passed_and_soon_known),
        cmocka_unit_test(ties_go_to_the_lowest_body),
        cmocka_unit_test(sensors_come_before_the_blocking_hit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
