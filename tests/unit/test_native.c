/* SPDX-License-Identifier: MIT
 * test_native.c: the native backend against brute force, its contract, and its promise that caches and lanes change no
 * bit. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "../support/native_fixture.h"
#include "../support/oracle.h"

enum { SOUP = 32 };

static tahr_vec3 vec(double x, double y, double z)
{
    return (tahr_vec3){x, y, z};
}

static double dot(tahr_vec3 a, tahr_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* In a fixed order, which the arguments of one call would not have. */
static tahr_vec3 random_vec(oracle_random *r, double low, double high)
{
    tahr_vec3 v;
    v.x = oracle_uniform(r, low, high);
    v.y = oracle_uniform(r, low, high);
    v.z = oracle_uniform(r, low, high);
    return v;
}

typedef struct soup {
    double vertices[SOUP * 9];
    uint32_t indices[SOUP * 3];
    double offset[3];
} soup;

static void soup_make(soup *s, oracle_random *r, double size, double far)
{
    for (int k = 0; k < 3; k++) s->offset[k] = far;
    for (uint32_t i = 0; i < SOUP; i++) {
        double middle[3];
        for (int k = 0; k < 3; k++) middle[k] = oracle_uniform(r, -2, 2);
        for (int k = 0; k < 9; k++) s->vertices[9 * i + (uint32_t)k] = middle[k % 3] + oracle_uniform(r, -size, size);
        for (uint32_t k = 0; k < 3; k++) s->indices[3 * i + k] = 3 * i + k;
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

static tahr_shape any_shape(oracle_random *r, int kind)
{
    if (kind == 0) return fixture_shape(TAHR_SHAPE_SPHERE, 0.3, 0.3);
    if (kind == 1) return fixture_shape(TAHR_SHAPE_CAPSULE, 0.3, 0.9);
    (void)r;
    return fixture_shape(TAHR_SHAPE_BOX, 0.25, 0.6);
}

/* Gap error of hits and misses: the distance at the reported place, against the target. Two-sided soup, nothing shared.
 * Returns how many hits and misses there were to judge. */
static int sweep_against_truth(uint32_t precision, int kind, double size, double far, double tolerance)
{
    oracle_random r = {(uint64_t)kind * 77 + precision + (uint64_t)far + (uint64_t)size};
    int hits = 0, misses = 0;
    for (int scene = 0; scene < 3; scene++) {
        soup s;
        fixture f;
        soup_make(&s, &r, size, far);
        tahr_body_desc body = fixture_mesh(s.vertices, SOUP * 3, s.indices, SOUP);
        body.flags = TAHR_BODY_TWO_SIDED;
        body.pose.position = vec(far, far, far);
        tahr_native_desc options = fixture_options(precision);
        fixture_init(&f);
        assert_int_equal(fixture_open(&f, &body, 1, &options, 1), TAHR_OK);
        for (int n = 0; n < (kind == 2 ? 10 : 40); n++) {
            tahr_shape shape = any_shape(&r, kind);
            tahr_vec3 p = random_vec(&r, far - 4, far + 4), to = random_vec(&r, far - 2, far + 2);
            double motion[3] = {to.x - p.x, to.y - p.y, to.z - p.z};
            tahr_sweep q = fixture_sweep(shape, p, vec(motion[0], motion[1], motion[2]), n % 2 ? 0.01 : 0.05);
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
                assert_true(dot(h.normal, q.motion) < 0 && fabs(dot(h.normal, h.normal) - 1) < 1e-9);
                hits++;
            } else {
                double gap = soup_smallest(&s, &core, motion) - target;
                if (gap < -tolerance) fail_msg("kind %d missed by %g", kind, gap);
                misses++;
            }
        }
        fixture_close(&f);
        assert_int_equal(f.bytes, 0);
    }
    return hits + misses;
}

static void sweeps_are_exact_in_double(void **state)
{
    (void)state;
    for (int kind = 0; kind < 3; kind++) {
        int judged = sweep_against_truth(TAHR_NATIVE_DOUBLE, kind, 0.5, 0, 1e-9);
        judged += sweep_against_truth(TAHR_NATIVE_DOUBLE, kind, 30, 0, 1e-9);
        assert_true(judged >= 8);
    }
    assert_true(sweep_against_truth(TAHR_NATIVE_DOUBLE, 1, 0.5, 1048576, 1e-9) > 20);
}

static void sweeps_are_within_two_micrometres_in_float(void **state)
{
    (void)state;
    for (int kind = 0; kind < 3; kind++) assert_true(sweep_against_truth(TAHR_NATIVE_FLOAT, kind, 0.5, 0, 2e-6) >= 8);
    assert_true(sweep_against_truth(TAHR_NATIVE_FLOAT, 1, 0.5, 1048576, 2e-6) > 20);
}

static double hills(double x, double y)
{
    return 0.2 * sin(x * 1.3) * cos(y * 0.9) + 0.1 * sin(3 * x);
}

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
    b->sweep(f->self, &f->context, sweep, a->hits, 4, &a->hit_count);
    b->contacts(f->self, &f->context, &c, a->contacts, 16, &a->contact_count);
    b->ray(f->self, &f->context, &ray, &a->ray, &a->ray_count);
}

/* Bodies of every kind over hills. */
static uint32_t mixed_scene(double *vertices, uint32_t *indices, tahr_body_desc *bodies)
{
    fixture_grid(24, 0.5, hills, vertices, indices);
    bodies[0] = fixture_mesh(vertices, 625, indices, 1152);
    bodies[1] = fixture_body(TAHR_BODY_BOX);
    bodies[1].half_extents = vec(1, 0.5, 0.7);
    bodies[1].pose.position = vec(4, 5, 0.6);
    bodies[1].pose.orientation = (tahr_quat){0, 0, 0.6, 0.8};
    bodies[2] = fixture_body(TAHR_BODY_SPHERE);
    bodies[2].radius = 0.8;
    bodies[2].pose.position = vec(7, 6, 0.5);
    bodies[3] = fixture_body(TAHR_BODY_CAPSULE);
    bodies[3].radius = 0.4;
    bodies[3].half_height = 1.5;
    bodies[3].flags = TAHR_BODY_MOVABLE;
    bodies[3].pose.position = vec(5, 8, 0.5);
    bodies[3].pose.orientation = (tahr_quat){0.6, 0, 0, 0.8};
    bodies[4] = bodies[1];
    bodies[4].flags = TAHR_BODY_MOVABLE;
    bodies[4].pose.position = vec(8, 3, 0.4);
    bodies[5] = bodies[2];
    bodies[5].flags = TAHR_BODY_SENSOR;
    bodies[5].pose.position = vec(6, 4, 0.3);
    return 6;
}

static void caches_and_lanes_change_no_bit(void **state)
{
    (void)state;
    static double vertices[625 * 3];
    static uint32_t indices[1152 * 3];
    tahr_body_desc bodies[6];
    uint32_t count = mixed_scene(vertices, indices, bodies);
    uint64_t escapes = 0, gathers = 0;
    for (uint32_t precision = 0; precision < 2; precision++) {
        fixture f[5];
        for (uint32_t i = 0; i < 5; i++) {
            tahr_native_desc o = fixture_options(precision);
            o.no_cache = i == 0;
            o.no_simd = i == 2;
            o.cache_triangles = i == 3 ? 16 : i == 4 ? 4096 : 400;
            o.cache_margin = i == 4 ? 3 : 0.5;
            fixture_init(&f[i]);
            assert_int_equal(fixture_open(&f[i], bodies, count, &o, 1), TAHR_OK);
        }
        oracle_random r = {precision + 3};
        tahr_vec3 p = vec(6, 6, 1.2);
        for (int n = 0; n < 6000; n++) {
            tahr_sweep q = fixture_sweep(any_shape(&r, n % 11 == 0 ? 2 : n % 3 == 0 ? 0 : 1), p, vec(0, 0, 0), 0.01);
            q.motion = random_vec(&r, -0.5, 0.4);
            if (n % 50 == 0) q.motion.x = 4;
            if ((n / 500) % 2) q.up = vec(0.6, 0, 0.8);
            q.flags = n % 2 ? TAHR_SWEEP_LEAVE_OVERLAP : 0;
            answers first, other;
            for (uint32_t i = 0; i < 5; i++) {
                tahr_prepare a;
                memset(&a, 0, sizeof a);
                a.position = p;
                a.up = q.up;
                a.mask = 0xFFFFFFFFu;
                a.bounds.min = vec(p.x - 1.6, p.y - 1.6, p.z - 1.6);
                a.bounds.max = vec(p.x + 1.6, p.y + 1.6, p.z + 1.6);
                tahr_backend_v1_native()->prepare(f[i].self, &f[i].context, &a);
                ask(&f[i], &q, i == 0 ? &first : &other);
                if (i > 0) assert_memory_equal(&first, &other, sizeof first);
            }
            p = vec(p.x + 0.3 * q.motion.x, p.y + 0.3 * q.motion.y, p.z + 0.3 * q.motion.z);
            if (p.x < 2 || p.x > 10 || p.y < 2 || p.y > 10 || p.z < 0 || p.z > 2.5) p = vec(6, 6, 1.2);
        }
        assert_int_equal(f[0].context.gathers, 0);
        for (int i = 0; i < 5; i++) {
            escapes += f[i].context.escapes;
            gathers += f[i].context.gathers;
            fixture_close(&f[i]);
            assert_int_equal(f[i].bytes, 0);
        }
    }
    assert_true(escapes > 100 && gathers > 100);
}

static void start_follows_the_contract(void **state)
{
    (void)state;
    fixture f;
    static double vertices[25 * 3];
    static uint32_t indices[32 * 3];
    fixture_grid(4, 1, NULL, vertices, indices);
    tahr_body_desc body = fixture_mesh(vertices, 25, indices, 32);
    tahr_native_desc options = fixture_options(TAHR_NATIVE_DOUBLE);
    fixture_init(&f);
    assert_int_equal(fixture_open(&f, &body, 1, &options, 0), TAHR_OK);
    tahr_shape shape = fixture_shape(TAHR_SHAPE_CAPSULE, 0.3, 0.9);
    tahr_sweep q = fixture_sweep(shape, vec(2.1, 2.2, 0.9), vec(1, 0, 0), 0.01);
    /* Touching, parallel and away: free. */
    q.position.z = 0.905;
    assert_int_equal(fixture_hit(&f, &q).blocking, 0);
    q.motion = vec(1, 0, 0.1);
    assert_int_equal(fixture_hit(&f, &q).blocking, 0);
    /* Within the margin and approaching: fraction 0 at the distance it has. */
    q.motion = vec(1, 0, -0.1);
    tahr_hit h = fixture_hit(&f, &q);
    assert_true(h.blocking == 1 && h.fraction == 0 && h.start_overlap == 0 && fabs(h.distance - 0.005) < 1e-12);
    assert_true(h.normal.x == 0 && h.normal.y == 0 && h.normal.z == 1);
    /* Overlap: reported whatever the motion; with LEAVE_OVERLAP only a motion deeper is. */
    q.position.z = 0.85;
    q.motion = vec(1, 0, 0.1);
    h = fixture_hit(&f, &q);
    assert_true(h.start_overlap == 1 && h.blocking == 1 && fabs(h.depth - 0.05) < 1e-12 && h.distance == -h.depth);
    q.flags = TAHR_SWEEP_LEAVE_OVERLAP;
    assert_int_equal(fixture_hit(&f, &q).blocking, 0);
    q.motion = vec(1, 0, -0.1);
    assert_int_equal(fixture_hit(&f, &q).start_overlap, 1);
    /* Core through the floor: out of the front. */
    q.position.z = 0.2;
    h = fixture_hit(&f, &q);
    assert_true(h.start_overlap == 1 && fabs(h.depth - 0.7) < 1e-12 && h.normal.z == 1);
    /* From behind a one-sided face: free, up to and through it. */
    q.position.z = -2;
    q.motion = vec(0, 0, 4);
    assert_int_equal(fixture_hit(&f, &q).blocking, 0);
    /* No motion at all: only overlaps count. */
    q.position.z = 0.905;
    q.motion = vec(0, 0, 0);
    assert_int_equal(fixture_hit(&f, &q).blocking, 0);
    fixture_close(&f);
}

static double ridge(double x, double y)
{
    (void)y;
    return x < 2 ? 0 : (x - 2) * 0.5;
}

static double slope(double x, double y)
{
    return 0.37 * x + 0.21 * y;
}

/* Walks a plane that is made of triangles, projecting each motion on the plane: never blocked, never closer. */
static void walk_plane(double (*height)(double, double), tahr_vec3 normal, uint32_t precision)
{
    fixture f;
    static double vertices[81 * 3];
    static uint32_t indices[128 * 3];
    fixture_grid(8, 0.5, height, vertices, indices);
    tahr_body_desc body = fixture_mesh(vertices, 81, indices, 128);
    body.pose.position = vec(100.0 / 3, -7.0 / 3, 0.1);
    tahr_native_desc options = fixture_options(precision);
    fixture_init(&f);
    assert_int_equal(fixture_open(&f, &body, 1, &options, 1), TAHR_OK);
    double length = sqrt(dot(normal, normal));
    normal = vec(normal.x / length, normal.y / length, normal.z / length);
    tahr_shape shape = fixture_shape(TAHR_SHAPE_CAPSULE, 0.3, 0.9);
    oracle_random r = {4};
    tahr_vec3 o = body.pose.position, p = vec(o.x + 2, o.y + 2, o.z + 4);
    fixture_announce(&f, p, 5);
    tahr_sweep q = fixture_sweep(shape, p, vec(0, 0, -4), 0.01);
    tahr_hit h = fixture_hit(&f, &q);
    assert_int_equal(h.blocking, 1);
    p.z -= 4 * h.fraction;
    for (int n = 0; n < 100000; n++) {
        tahr_vec3 m = random_vec(&r, -0.1, 0.1);
        if (fabs(p.x - o.x - 2) > 0.9) m.x = (p.x > o.x + 2 ? -1 : 1) * fabs(m.x);
        if (fabs(p.y - o.y - 2) > 0.9) m.y = (p.y > o.y + 2 ? -1 : 1) * fabs(m.y);
        double into = dot(m, normal);
        m = vec(m.x - normal.x * into, m.y - normal.y * into, m.z - normal.z * into);
        if (n % 4 == 0) fixture_announce(&f, p, 2);
        q.position = p;
        q.motion = m;
        h = fixture_hit(&f, &q);
        if (h.blocking) fail_msg("step %d blocked at %g, normal %g %g", n, h.fraction, h.normal.x, h.normal.y);
        p = vec(p.x + m.x, p.y + m.y, p.z + m.z);
    }
    double foot = p.z - 0.6 - o.z;
    double clearance = normal.z * foot + normal.x * (p.x - o.x) + normal.y * (p.y - o.y) - 0.3;
    assert_true(fabs(clearance - 0.01) < 1e-5);
    fixture_close(&f);
}

static void a_walker_neither_sticks_nor_creeps(void **state)
{
    (void)state;
    for (uint32_t precision = 0; precision < 2; precision++) {
        walk_plane(NULL, vec(0, 0, 1), precision);
        walk_plane(slope, vec(-0.37, -0.21, 1), precision);
    }
}

static void a_ramp_is_met_when_standing_closer_than_the_margin(void **state)
{
    (void)state;
    fixture f;
    static double vertices[81 * 3];
    static uint32_t indices[128 * 3];
    fixture_grid(8, 0.5, ridge, vertices, indices);
    tahr_body_desc body = fixture_mesh(vertices, 81, indices, 128);
    tahr_native_desc options = fixture_options(TAHR_NATIVE_DOUBLE);
    fixture_init(&f);
    assert_int_equal(fixture_open(&f, &body, 1, &options, 0), TAHR_OK);
    tahr_shape shape = fixture_shape(TAHR_SHAPE_CAPSULE, 0.3, 0.9);
    double s = sqrt(1.25);
    for (int n = 0; n < 200; n++) {
        double gap = 0.01 * (n + 1) / 200.0, y = 1.7 + n * 0.003;
        tahr_sweep q = fixture_sweep(shape, vec(1, y, 0.9 + gap), vec(1.5, 0, 0), 0.01);
        tahr_hit h = fixture_hit(&f, &q);
        assert_int_equal(h.blocking, 1);
        double x = 1 + 1.5 * h.fraction - 2, z = 0.3 + gap;
        double clearance = (-0.5 * x + z) / s - 0.3;
        /* Where the ramp's face is as near as the margin asks, or, if the floor is nearer still, where it is that near. */
        assert_true(clearance <= 0.01 + 1e-9 && clearance >= gap - 1e-8);
        assert_true(fabs(h.normal.x + 0.5 / s) < 1e-6 && fabs(h.surface_normal.x + 0.5 / s) < 1e-6);
    }
    fixture_close(&f);
}

static void edges_report_the_face_that_opposes(void **state)
{
    (void)state;
    fixture f;
    tahr_body_desc body = fixture_body(TAHR_BODY_BOX);
    body.half_extents = vec(1, 1, 0.5);
    tahr_native_desc options = fixture_options(TAHR_NATIVE_DOUBLE);
    fixture_init(&f);
    assert_int_equal(fixture_open(&f, &body, 1, &options, 0), TAHR_OK);
    /* The lower cap meets the upper edge of the box from the side: riser; from above: tread. */
    tahr_sweep q = fixture_sweep(fixture_shape(TAHR_SHAPE_CAPSULE, 0.3, 0.9), vec(-3, 0, 1.3), vec(3, 0, 0), 0.0);
    tahr_hit h = fixture_hit(&f, &q);
    assert_true(h.blocking && h.normal.x < -0.5 && h.normal.z > 0.5);
    assert_true(h.surface_normal.x == -1 && h.surface_normal.z == 0);
    q.position = vec(-1.1, 0, 3);
    q.motion = vec(0, 0, -3);
    h = fixture_hit(&f, &q);
    assert_true(h.blocking && h.normal.x < 0 && h.surface_normal.z == 1);
    assert_true(h.feature == 5 || h.feature == 0);
    fixture_close(&f);
}

static void contacts_report_each_surface_once(void **state)
{
    (void)state;
    fixture f;
    static double vertices[25 * 3];
    static uint32_t indices[64 * 3];
    fixture_grid(4, 0.25, NULL, vertices, indices);
    memcpy(indices + 96, indices, 96 * sizeof *indices); /* every triangle twice */
    tahr_body_desc bodies[2] = {fixture_mesh(vertices, 25, indices, 64), fixture_body(TAHR_BODY_BOX)};
    bodies[1].half_extents = vec(0.5, 2, 2);
    bodies[1].pose.position = vec(1.305, 0.5, 0);
    tahr_native_desc options = fixture_options(TAHR_NATIVE_DOUBLE);
    fixture_init(&f);
    assert_int_equal(fixture_open(&f, bodies, 2, &options, 0), TAHR_OK);
    tahr_contact contacts[16];
    uint32_t count = 0;
    for (int kind = 0; kind < 3; kind++) {
        oracle_random r = {1};
        tahr_shape shape = any_shape(&r, kind);
        double radius = kind == 2 ? 0.25 : 0.3;
        /* On a corner of the grid, on an edge, on a diagonal, inside. */
        for (int n = 0; n < 4; n++) {
            double y = n == 0 ? 0.5 : n == 1 ? 0.6 : 0.55;
            tahr_contact_query q = fixture_contacts(shape, vec(0.805 - radius - 0.01, y, shape.half_height + 0.01), 0.02);
            assert_int_equal(tahr_backend_v1_native()->contacts(f.self, &f.context, &q, contacts, 16, &count), TAHR_OK);
            assert_int_equal(count, 2);
            for (uint32_t i = 0; i < 2; i++) {
                assert_true(fabs(contacts[i].distance - 0.01) < 1e-12);
                assert_true(contacts[i].body == 0 ? contacts[i].normal.z == 1 : contacts[i].normal.x == -1);
                assert_true(contacts[i].body == 0 ? contacts[i].feature < 32 : contacts[i].feature == 0);
            }
        }
    }
    fixture_close(&f);
}

static void a_box_pushes_out_what_is_inside(void **state)
{
    (void)state;
    fixture f;
    tahr_body_desc body = fixture_body(TAHR_BODY_BOX);
    body.half_extents = vec(2, 3, 4);
    tahr_native_desc options = fixture_options(TAHR_NATIVE_FLOAT);
    fixture_init(&f);
    assert_int_equal(fixture_open(&f, &body, 1, &options, 0), TAHR_OK);
    for (int kind = 0; kind < 3; kind++) {
        oracle_random r = {1};
        tahr_shape shape = any_shape(&r, kind);
        double half = kind == 2 ? 0.25 : 0.3;
        tahr_sweep q = fixture_sweep(shape, vec(1.5, 0.1, 0.2), vec(0.1, 0, 0), 0.01);
        tahr_hit h = fixture_hit(&f, &q);
        assert_true(h.start_overlap == 1 && h.normal.x == 1 && fabs(h.depth - 0.5 - half) < 1e-12);
        tahr_contact_query c = fixture_contacts(shape, q.position, 0);
        tahr_contact contact;
        uint32_t count = 0;
        tahr_backend_v1_native()->contacts(f.self, &f.context, &c, &contact, 1, &count);
        assert_true(count == 1 && contact.normal.x == 1 && fabs(contact.distance + 0.5 + half) < 1e-12);
        assert_int_equal(contact.feature, 1);
    }
    fixture_close(&f);
}

static void sensors_come_before_the_blocking_hit(void **state)
{
    (void)state;
    fixture f;
    tahr_body_desc bodies[3];
    for (int i = 0; i < 3; i++) {
        bodies[i] = fixture_body(TAHR_BODY_BOX);
        bodies[i].half_extents = vec(0.5, 2, 2);
        bodies[i].pose.position = vec(6 - 2 * i, 0, 0);
        bodies[i].flags = i ? TAHR_BODY_SENSOR : 0;
        bodies[i].mask = 1u << i;
    }
    fixture_init(&f);
    assert_int_equal(fixture_open(&f, bodies, 3, NULL, 0), TAHR_OK);
    tahr_hit hits[4];
    uint32_t count = 0;
    tahr_sweep q = fixture_sweep(fixture_shape(TAHR_SHAPE_SPHERE, 0.3, 0.3), vec(0, 0, 0), vec(10, 0, 0), 0.01);
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
    fixture_close(&f);
}

static void rays_hit_fronts_and_slip_through_no_seam(void **state)
{
    (void)state;
    fixture f;
    static double vertices[625 * 3];
    static uint32_t indices[1152 * 3];
    tahr_body_desc bodies[6];
    uint32_t n = mixed_scene(vertices, indices, bodies);
    fixture_init(&f);
    assert_int_equal(fixture_open(&f, bodies, n, NULL, 0), TAHR_OK);
    const tahr_backend *b = tahr_backend_v1_native();
    tahr_hit hit;
    uint32_t count = 0;
    for (int i = 1; i < 96; i++) {
        for (int j = 1; j < 96; j++) {
            /* Down, exactly on lattice lines and diagonals. */
            tahr_ray ray = {vec(i * 0.125, j * 0.125, 5), vec(0, 0, -10), 1, TAHR_NO_BODY};
            b->ray(f.self, &f.context, &ray, &hit, &count);
            assert_int_equal(count, 1);
            assert_true(hit.blocking && hit.normal.z > 0 && hit.fraction > 0 && hit.fraction < 1);
            ray.origin.z = -5;
            ray.motion.z = 4;
            b->ray(f.self, &f.context, &ray, &hit, &count);
            assert_int_equal(count, 0);
        }
    }
    tahr_ray ray = {vec(7, 6, 5), vec(0, 0, -10), 0xFFFFFFFFu, TAHR_NO_BODY};
    b->ray(f.self, &f.context, &ray, &hit, &count);
    assert_true(count == 1 && hit.body == 2 && fabs(hit.point.z - 1.3) < 1e-9 && fabs(hit.fraction - 0.37) < 1e-9);
    fixture_close(&f);
}

static void moved_bodies_are_found_where_they_are(void **state)
{
    (void)state;
    fixture f;
    enum { MANY = 1000 };
    static tahr_body_desc bodies[MANY];
    for (uint32_t i = 0; i < MANY; i++) {
        bodies[i] = fixture_body(TAHR_BODY_SPHERE);
        bodies[i].radius = 0.5;
        bodies[i].flags = i % 2 ? TAHR_BODY_MOVABLE : 0;
        bodies[i].pose.position = vec(3.0 * (i % 40), 3.0 * (i / 40), 0);
    }
    fixture_init(&f);
    assert_int_equal(fixture_open(&f, bodies, MANY, NULL, 1), TAHR_OK);
    tahr_sweep q = fixture_sweep(fixture_shape(TAHR_SHAPE_SPHERE, 0.25, 0.25), vec(9, 6, 3), vec(0, 0, -4), 0.01);
    fixture_announce(&f, q.position, 5);
    tahr_hit h = fixture_hit(&f, &q);
    assert_true(h.body == 83 && fabs(h.fraction - 2.24 / 4) < 1e-9);
    tahr_body_pose move = {83, 0, {vec(9, 6, 1), {0, 0, 0, 1}}};
    const tahr_backend *b = tahr_backend_v1_native();
    assert_int_equal(b->place(f.self, &move, 1), TAHR_OK);
    h = fixture_hit(&f, &q);
    assert_true(h.body == 83 && fabs(h.fraction - 1.24 / 4) < 1e-9);
    move.pose.position.x = 500;
    assert_int_equal(b->place(f.self, &move, 1), TAHR_OK);
    assert_int_equal(fixture_hit(&f, &q).blocking, 0);
    move.body = 82;
    assert_int_equal(b->place(f.self, &move, 1), TAHR_E_ARGUMENT);
    move.body = MANY;
    assert_int_equal(b->place(f.self, &move, 1), TAHR_E_NOT_FOUND);
    move.body = 83;
    move.pose.position.x = NAN;
    assert_int_equal(b->place(f.self, &move, 1), TAHR_E_ARGUMENT);
    fixture_close(&f);
}

static tahr_status open_broken(double *vertices, uint32_t vertex_count, uint32_t *indices, uint32_t triangles,
                               const char *expected)
{
    fixture f;
    fixture_init(&f);
    tahr_body_desc body = fixture_mesh(vertices, vertex_count, indices, triangles);
    tahr_status status = fixture_open(&f, &body, 1, NULL, 0);
    assert_null(f.self);
    assert_int_equal(f.bytes, 0);
    if (!strstr(f.message, expected)) fail_msg("message was '%s'", f.message);
    return status;
}

static void broken_geometry_is_named(void **state)
{
    (void)state;
    double v[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 2, 2};
    uint32_t good[3] = {0, 1, 2}, far[3] = {0, 1, 9}, flat[6] = {0, 1, 1, 2, 2, 2};
    assert_int_equal(open_broken(v, 4, good, 0, "triangle_count is 0"), TAHR_E_GEOMETRY);
    assert_int_equal(open_broken(v, 4, far, 1, "index 9"), TAHR_E_GEOMETRY);
    assert_int_equal(open_broken(v, 4, flat, 2, "area"), TAHR_E_GEOMETRY);
    assert_int_equal(open_broken(NULL, 4, good, 1, "NULL"), TAHR_E_NULL);
    v[4] = NAN;
    assert_int_equal(open_broken(v, 4, good, 1, "vertex 1: y is"), TAHR_E_GEOMETRY);
    v[4] = 2e7;
    assert_int_equal(open_broken(v, 4, good, 1, "vertex 1: y is 2e+07"), TAHR_E_GEOMETRY);
}

static void broken_bodies_and_options_are_refused(void **state)
{
    (void)state;
    fixture f;
    for (int n = 0; n < 9; n++) {
        tahr_body_desc body = fixture_body(TAHR_BODY_CAPSULE);
        tahr_native_desc options = fixture_options(0);
        body.radius = 0.5;
        body.half_height = 1;
        if (n == 0) body.radius = -1;
        if (n == 1) body.half_height = 0.4;
        if (n == 2) body.pose.position.y = INFINITY;
        if (n == 3) body.pose.orientation.w = 2;
        if (n == 4) body.type = 9;
        if (n == 5) options.precision = 7;
        if (n == 6) options.cache_triangles = 5000;
        if (n == 7) options.cache_margin = NAN;
        if (n == 8) body.flags = 64;
        fixture_init(&f);
        assert_int_equal(fixture_open(&f, &body, 1, &options, 0), TAHR_E_ARGUMENT);
        assert_true(f.message[0] != 0 && f.bytes == 0 && !f.self);
    }
    tahr_native_desc small = fixture_options(0);
    small.struct_size = 8;
    fixture_init(&f);
    assert_int_equal(fixture_open(&f, NULL, 0, &small, 0), TAHR_E_STRUCT_SIZE);
}

static void every_failed_allocation_leaves_nothing(void **state)
{
    (void)state;
    static double vertices[625 * 3];
    static uint32_t indices[1152 * 3];
    tahr_body_desc bodies[6];
    uint32_t n = mixed_scene(vertices, indices, bodies);
    for (size_t at = 1;; at++) {
        fixture f;
        fixture_init(&f);
        f.fail_at = at;
        tahr_status status = fixture_open(&f, bodies, n, NULL, 0);
        if (status == TAHR_OK) {
            fixture_close(&f);
            assert_int_equal(f.bytes, 0);
            if (f.asked >= at) continue; /* the exact copy of a tree is optional */
            assert_true(at > 20);
            return;
        }
        assert_int_equal(status, TAHR_E_MEMORY);
        assert_int_equal(f.bytes, 0);
    }
}

static void an_empty_world_is_free(void **state)
{
    (void)state;
    fixture f;
    fixture_init(&f);
    assert_int_equal(fixture_open(&f, NULL, 0, NULL, 1), TAHR_OK);
    tahr_sweep q = fixture_sweep(fixture_shape(TAHR_SHAPE_SPHERE, 0.25, 0.25), vec(9, 6, 3), vec(0, 0, -4), 0.01);
    assert_int_equal(fixture_hit(&f, &q).blocking, 0);
    fixture_announce(&f, q.position, 5);
    assert_int_equal(fixture_hit(&f, &q).blocking, 0);
    fixture_close(&f);
    assert_int_equal(f.bytes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sweeps_are_exact_in_double),
        cmocka_unit_test(sweeps_are_within_two_micrometres_in_float),
        cmocka_unit_test(caches_and_lanes_change_no_bit),
        cmocka_unit_test(start_follows_the_contract),
        cmocka_unit_test(a_walker_neither_sticks_nor_creeps),
        cmocka_unit_test(a_ramp_is_met_when_standing_closer_than_the_margin),
        cmocka_unit_test(edges_report_the_face_that_opposes),
        cmocka_unit_test(contacts_report_each_surface_once),
        cmocka_unit_test(a_box_pushes_out_what_is_inside),
        cmocka_unit_test(sensors_come_before_the_blocking_hit),
        cmocka_unit_test(rays_hit_fronts_and_slip_through_no_seam),
        cmocka_unit_test(moved_bodies_are_found_where_they_are),
        cmocka_unit_test(broken_geometry_is_named),
        cmocka_unit_test(broken_bodies_and_options_are_refused),
        cmocka_unit_test(every_failed_allocation_leaves_nothing),
        cmocka_unit_test(an_empty_world_is_free),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
