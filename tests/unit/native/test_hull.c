/* SPDX-License-Identifier: MIT
 * test_hull.c: convex hulls as bodies: what is built, and what they answer. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "native/orient.h"
#include "native/scene.h"
#include "rig.h"
#include "soup.h"

enum { POINTS = 256 };

static tahr_body_desc hull_of(const tahr_vec3 *points, uint32_t count)
{
    tahr_body_desc d = fixture_body(TAHR_BODY_HULL);
    d.vertices = &points[0].x;
    d.vertex_count = count;
    return d;
}

/* Small integers: everything here is exact in long long. */
static void sides_are_decided_exactly(void **state)
{
    (void)state;
    oracle_random r = {3};
    uint32_t flat = 0;
    for (int n = 0; n < 20000; n++) {
        long long p[4][3];
        tahr_vec3 v[4];
        int range = n % 2 ? 3 : 100000;
        for (int i = 0; i < 4; i++) {
            for (int k = 0; k < 3; k++)
                p[i][k] = (long long)oracle_below(&r, (uint32_t)(2 * range + 1)) - range;
            if (n % 3 == 0 && i == 3) { /* in the plane of the others */
                for (int k = 0; k < 3; k++)
                    p[3][k] = p[0][k] + 2 * (p[1][k] - p[0][k]) - (p[2][k] - p[0][k]);
            }
            v[i] = v_make((double)p[i][0], (double)p[i][1], (double)p[i][2]);
        }
        long long a[3][3];
        for (int i = 0; i < 3; i++) {
            for (int k = 0; k < 3; k++)
                a[i][k] = p[i + 1][k] - p[0][k];
        }
        long long volume = (a[0][1] * a[1][2] - a[0][2] * a[1][1]) * a[2][0] +
                           (a[0][2] * a[1][0] - a[0][0] * a[1][2]) * a[2][1] +
                           (a[0][0] * a[1][1] - a[0][1] * a[1][0]) * a[2][2];
        flat += volume == 0;
        assert_int_equal(tahr__orient(v[0], v[1], v[2], v[3]), (volume > 0) - (volume < 0));
        /* Moved far away, which is exact: what is left of the determinant is below the error of its terms. */
        tahr_vec3 far = {0x1p52, -0x1p51, 0x1p50};
        for (int i = 0; i < 4; i++)
            v[i] = v_scale(v_add(v[i], far), 0x1p-30);
        assert_int_equal(tahr__orient(v[0], v[1], v[2], v[3]), (volume > 0) - (volume < 0));
    }
    assert_true(flat > 5000);
}

/* Closed, and no point lies beyond a face: exactly. */
static void assert_is_hull(const tahr__mesh *m, const tahr_vec3 *points, uint32_t count)
{
    assert_true(m->triangle_count == 2 * m->vertex_count - 4); /* Euler, of a closed surface of triangles */
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        const tahr__triangle *t = &m->triangles[i];
        for (int k = 0; k < 3; k++) {
            assert_true(t->ring[k] != i);
            const tahr__triangle *o = &m->triangles[t->ring[k]];
            assert_true(o->ring[0] == i || o->ring[1] == i || o->ring[2] == i);
        }
        for (uint32_t p = 0; p < count; p++)
            assert_true(tahr__orient(m->vertices[t->vertex[0]], m->vertices[t->vertex[1]], m->vertices[t->vertex[2]],
                                     points[p]) <= 0);
    }
}

static uint32_t make_points(oracle_random *r, int kind, tahr_vec3 p[POINTS])
{
    uint32_t n = 4 + oracle_below(r, kind == 4 ? POINTS - 4 : 60);
    for (uint32_t i = 0; i < n; i++) {
        if (kind == 0) p[i] = dice_vec(r, -1, 1);
        if (kind == 1) p[i] = dice_direction(r); /* all on the hull but for rounding */
        if (kind == 2)                           /* a lattice: many in one plane, on one edge, twice the same */
            p[i] = v_make(oracle_below(r, 4), oracle_below(r, 4), oracle_below(r, 4));
        if (kind == 3) p[i] = v_add(v_scale(dice_vec(r, -1, 1), 1e-3), v_make(1e6, -1e6, 3e5));
        if (kind == 4) { /* a prism with round ends, turned */
            double a = 6.283185307179586 * (i / 2) / (n / 2 + 1);
            tahr_vec3 q = v_make(cos(a), sin(a), i % 2);
            p[i] = v_make(0.6 * q.x - 0.8 * q.y, 0.8 * q.x + 0.6 * q.y, q.z);
        }
        if (kind == 5) p[i] = v_make(oracle_uniform(r, -1, 1), oracle_uniform(r, -1, 1), oracle_uniform(r, 0, 1e-9));
    }
    return n;
}

static void hulls_are_closed_and_hold_all_their_points(void **state)
{
    (void)state;
    oracle_random r = {9};
    fixture f;
    uint32_t built = 0;
    fixture_init(&f);
    for (int n = 0; n < 600; n++) {
        tahr_vec3 p[POINTS];
        tahr__mesh mesh;
        uint32_t count = make_points(&r, n % 6, p);
        tahr_body_desc d = hull_of(p, count);
        tahr_status status = tahr__hull_build(&f.host, &d, 0, &mesh);
        if (status != TAHR_OK) { /* few points of a lattice may be in one plane */
            assert_int_equal(status, TAHR_E_GEOMETRY);
            assert_true(n % 6 == 2 && count < 10);
            continue;
        }
        assert_is_hull(&mesh, p, count);
        tahr__mesh_free(&f.host, &mesh);
        built++;
    }
    assert_true(built > 590 && f.bytes == 0);
}

static void hulls_without_volume_or_with_bad_points_are_refused(void **state)
{
    (void)state;
    const tahr_vec3 good[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int n = 0; n < 6; n++) {
        tahr_vec3 p[5] = {good[0], good[1], good[2], good[3], {0.1, 0.1, 0.1}};
        fixture f;
        if (n == 0) p[3] = v_make(0.3, 0.7, 0), p[4] = v_make(5, 5, 0); /* all in a plane */
        for (int i = 0; i < 5 && n == 1; i++)
            p[i] = v_make(i, 2 * i, 3 * i);
        for (int i = 0; i < 5 && n == 2; i++)
            p[i] = good[1];
        if (n == 3) p[2].y = NAN;
        if (n == 4) p[4].z = 2e7;
        if (n == 5) p[0].x = -INFINITY;
        tahr_body_desc d = hull_of(p, 5);
        fixture_init(&f);
        assert_int_equal(fixture_open(&f, &d, 1, NULL, 0), TAHR_E_GEOMETRY);
        assert_non_null(strstr(f.message, n < 3    ? "in one plane"
                                          : n == 3 ? "vertex 2: y"
                                          : n == 4 ? "vertex 4: z"
                                                   : "vertex 0: x"));
        assert_int_equal(f.bytes, 0);
    }
}

/* The eight corners of a box, in any order, with more points inside: the box. */
static void a_hull_of_a_boxs_corners_answers_as_the_box(void **state)
{
    (void)state;
    oracle_random r = {77};
    const tahr_vec3 half = {0.8, 0.5, 0.3};
    tahr_vec3 p[40];
    for (uint32_t i = 0; i < 40; i++) {
        p[i] = dice_vec(&r, -1, 1);
        if (i % 5 == 0) p[i] = v_make(i / 5 & 1 ? 1 : -1, i / 10 & 1 ? 1 : -1, i / 20 & 1 ? 1 : -1);
        p[i] = v_make(p[i].x * half.x, p[i].y * half.y, p[i].z * half.z);
    }
    tahr_body_desc hull = hull_of(p, 40), box = native_box(v_make(1, 2, 0.5), half);
    box.pose.orientation = hull.pose.orientation = (tahr_quat){0.1, 0.2, 0.3, 0.9273618495495704};
    hull.pose.position = box.pose.position;
    fixture f[2];
    native_open(&f[0], &box, 1, 0);
    native_open(&f[1], &hull, 1, 0);
    uint32_t hits = 0, overlaps = 0;
    for (int n = 0; n < 6000; n++) {
        tahr_vec3 at = v_add(box.pose.position, dice_vec(&r, -1.5, 1.5));
        tahr_sweep q = fixture_sweep(native_shape(n % 3), at, dice_vec(&r, -1.5, 1.5), n % 2 ? 0.01 : 0);
        tahr_hit a = fixture_hit(&f[0], &q), b = fixture_hit(&f[1], &q);
        assert_int_equal(a.blocking, b.blocking);
        assert_int_equal(a.start_overlap, b.start_overlap);
        assert_true(fabs(a.fraction - b.fraction) < 1e-9 && fabs(a.depth - b.depth) < 1e-9);
        hits += a.blocking;
        overlaps += a.start_overlap;
        tahr_ray ray = {at, q.motion, 0xFFFFFFFFu, TAHR_NO_BODY};
        uint32_t counts[2] = {0, 0};
        const tahr_backend *native = tahr_backend_v1_native();
        native->ray(f[0].self, &f[0].context, &ray, &a, &counts[0]);
        native->ray(f[1].self, &f[1].context, &ray, &b, &counts[1]);
        assert_int_equal(counts[0], counts[1]);
        if (counts[0]) assert_true(fabs(a.fraction - b.fraction) < 1e-9);
    }
    assert_true(hits > 2000 && overlaps > 1000);
    native_close(&f[0]);
    native_close(&f[1]);
}

/* How far the shape must go along n to leave the points: the sum of what both reach. */
static double way_out(const tahr_vec3 *p, uint32_t count, const tahr_sweep *q, tahr_vec3 n)
{
    double most = -1e30, reach = q->shape.radius;
    for (uint32_t i = 0; i < count; i++)
        most = d_max(most, v_dot(p[i], n));
    if (q->shape.type == TAHR_SHAPE_CAPSULE) reach += fabs(n.z) * (q->shape.half_height - q->shape.radius);
    if (q->shape.type == TAHR_SHAPE_BOX)
        reach = fabs(n.x) * q->shape.half_x + fabs(n.y) * q->shape.half_y + fabs(n.z) * q->shape.half_height;
    return most + reach - v_dot(q->position, n);
}

/* The depth is what leaving along the normal takes, and no direction of the sphere, searched by random steps downhill,
 * takes less. */
static void the_way_out_of_a_hull_is_the_shortest(void **state)
{
    (void)state;
    oracle_random r = {15};
    uint32_t overlaps = 0;
    for (int n = 0; n < 90; n++) {
        tahr_vec3 p[POINTS];
        fixture f;
        uint32_t count = make_points(&r, n % 2, p);
        if (count < 8) continue;
        tahr_body_desc d = hull_of(p, count);
        native_open(&f, &d, 1, 0);
        for (int k = 0; k < 6; k++) {
            tahr_sweep q = fixture_sweep(native_shape(k % 3), dice_vec(&r, -0.9, 0.9), v_make(0, 0, 0), 0);
            tahr_hit h = fixture_hit(&f, &q);
            double least = 1e30, step = 1;
            tahr_vec3 best = v_make(0, 0, 1);
            for (int i = 0; i < 3000; i++) {
                tahr_vec3 to = i < 1500 ? dice_direction(&r) : v_unit(v_mad(best, dice_direction(&r), step));
                double way = way_out(p, count, &q, to);
                if (way < least) least = way, best = to;
                if (i >= 1500 && i % 50 == 0) step *= 0.6;
            }
            if (least < -1e-3) assert_int_equal(h.start_overlap, 0);
            if (!h.start_overlap) {
                assert_true(least < 1e-3); /* found to be apart, or nearly */
                continue;
            }
            overlaps++;
            assert_true(fabs(way_out(p, count, &q, h.normal) - h.depth) < 1e-9);
            assert_true(h.depth <= least + 1e-9);
        }
        native_close(&f);
    }
    assert_true(overlaps > 200);
}

/* Outside: a point's way to a tetrahedron, by the oracle over its faces. */
static void distances_to_a_hull_are_those_to_its_faces(void **state)
{
    (void)state;
    oracle_random r = {41};
    uint32_t near = 0;
    for (int n = 0; n < 60; n++) {
        tahr_vec3 p[4];
        fixture f;
        for (int i = 0; i < 4; i++)
            p[i] = dice_vec(&r, -1, 1);
        tahr_body_desc d = hull_of(p, 4);
        native_open(&f, &d, 1, 0);
        for (int k = 0; k < 10; k++) {
            tahr_vec3 at = dice_vec(&r, -2, 2);
            tahr_shape shape = native_shape(k % 2);
            tahr_contact_query q = fixture_contacts(shape, at, 1);
            tahr_contact c[16];
            uint32_t count = 0;
            tahr_backend_v1_native()->contacts(f.self, &f.context, &q, c, 16, &count);
            oracle_core core = {.axis_count = k % 2, .centre = {at.x, at.y, at.z}, .axis = {{0, 0, 0.6}}};
            const double still[3] = {0, 0, 0};
            long double least = 1e9;
            for (int skip = 0; skip < 4; skip++) {
                double t[3][3];
                for (int i = 0, m = 0; i < 4; i++) {
                    if (i == skip) continue;
                    t[m][0] = p[i].x, t[m][1] = p[i].y, t[m][2] = p[i].z;
                    m++;
                }
                long double way = oracle_distance(&core, still, 0, t);
                least = way < least ? way : least;
            }
            if (count == 0 || c[0].distance < -shape.radius + 1e-9) continue; /* too far, or the core is inside */
            near++;
            assert_true(fabsl(least - shape.radius - c[0].distance) < 1e-9);
        }
        native_close(&f);
    }
    assert_true(near > 100);
}

static void coplanar_triangles_of_a_hull_are_one_face(void **state)
{
    (void)state;
    tahr_vec3 p[8];
    uint32_t faces = 0, seen[12] = {0};
    fixture f;
    tahr__mesh mesh;
    for (int i = 0; i < 8; i++)
        p[i] = v_make(i & 1, i >> 1 & 1, i >> 2);
    tahr_body_desc d = hull_of(p, 8);
    fixture_init(&f);
    assert_int_equal(tahr__hull_build(&f.host, &d, 0, &mesh), TAHR_OK);
    assert_int_equal(mesh.triangle_count, 12);
    for (uint32_t i = 0; i < 12; i++) {
        uint32_t face = tahr__triangle_source(&mesh.triangles[i]);
        assert_true(face < 6);
        faces += seen[face]++ == 0;
    }
    assert_int_equal(faces, 6);
    tahr__mesh_free(&f.host, &mesh);
}

static void caches_and_lanes_change_no_bit_of_hulls(void **state)
{
    (void)state;
    enum { HULLS = 24 };
    static tahr_vec3 points[HULLS][POINTS];
    static native_grid grid;
    oracle_random r = {88};
    tahr_body_desc bodies[HULLS + 1];
    soup s; /* says where to ask */
    for (int i = 0; i < HULLS; i++) {
        uint32_t count = make_points(&r, i % 2, points[i]);
        bodies[i] = hull_of(points[i], count < 8 ? 8 : count);
        for (uint32_t k = count; k < 8; k++)
            points[i][k] = dice_vec(&r, -1, 1);
        bodies[i].pose.position = v_make(oracle_uniform(&r, 0, 12), oracle_uniform(&r, 0, 12), 0.5);
        if (i % 3) bodies[i].pose.orientation = (tahr_quat){0.1, 0.2, 0.3, 0.9273618495495704};
        if (i % 4 == 0) bodies[i].flags = TAHR_BODY_MOVABLE;
    }
    bodies[HULLS] = native_grid_body(&grid, NATIVE_CELLS, 0.5, NULL);
    soup_make(&s, &bodies[HULLS], HULLS);
    fixture worlds[4];
    for (uint32_t i = 0; i < 4; i++) {
        tahr_native_desc o = fixture_options();
        o.no_cache = i == 0;
        o.no_simd = i == 2;
        o.cache_triangles = i == 3 ? 64 : 4096;
        fixture_init(&worlds[i]);
        assert_int_equal(fixture_open(&worlds[i], bodies, HULLS + 1, &o, 1), TAHR_OK);
    }
    assert_true(soup_compare(worlds, 4, &s, 600) > 300);
    for (int i = 0; i < 4; i++)
        native_close(&worlds[i]);
    soup_free(&s);
}

/* On a slab whose top is at z = 0.3 and on a roof of 20 degrees: the foot keeps 1 to 1.5 skins along the normal. */
static void a_character_stands_and_walks_on_hulls(void **state)
{
    (void)state;
    const double rise = 4 * 0.3639702342662024; /* over 4 m, at 20 degrees */
    tahr_vec3 p[14];
    for (int i = 0; i < 8; i++)
        p[i] = v_make(i & 1 ? 2 : -2, i & 2 ? 2 : -2, i & 4 ? 0.3 : 0);
    for (int i = 0; i < 6; i++)
        p[8 + i] = v_make(i < 2 ? 2 : 6, i % 2 ? 2 : -2, i >= 4 ? 0.3 + rise : i < 2 ? 0.3 : 0);
    tahr_body_desc bodies[2] = {hull_of(p, 8), hull_of(p + 8, 6)};
    rig r;
    rig_open_bodies(&r, bodies, 2, NULL, v_make(-1, 0, 1.3));
    rig_settle(&r);
    double gap = r.state.position.z - r.config.shape.half_height - 0.3;
    assert_true(gap > r.config.skin - 1e-9 && gap < 1.5 * r.config.skin + 1e-9);
    assert_int_equal(r.state.floor.body, 0);
    r.input.move = v_make(1, 0, 0);
    for (int i = 0; i < 240 && r.state.position.x < 4; i++)
        rig_step(&r, 1.0 / 60);
    assert_true(r.state.position.x >= 4);
    assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
    assert_int_equal(r.state.floor.body, 1);
    /* The lower end of the axis to the plane z = 0.3 + (x - 2) tan 20. */
    double low = r.state.position.z - r.config.shape.half_height + r.config.shape.radius - 0.3;
    double away = (low - (r.state.position.x - 2) * 0.3639702342662024) * 0.9396926207859084 - r.config.shape.radius;
    assert_true(away > r.config.skin - 1e-6 && away < 1.5 * r.config.skin + 1e-6);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sides_are_decided_exactly),
        cmocka_unit_test(hulls_are_closed_and_hold_all_their_points),
        cmocka_unit_test(hulls_without_volume_or_with_bad_points_are_refused),
        cmocka_unit_test(a_hull_of_a_boxs_corners_answers_as_the_box),
        cmocka_unit_test(the_way_out_of_a_hull_is_the_shortest),
        cmocka_unit_test(distances_to_a_hull_are_those_to_its_faces),
        cmocka_unit_test(coplanar_triangles_of_a_hull_are_one_face),
        cmocka_unit_test(caches_and_lanes_change_no_bit_of_hulls),
        cmocka_unit_test(a_character_stands_and_walks_on_hulls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
