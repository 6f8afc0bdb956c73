/* SPDX-License-Identifier: MIT
 * test_fcl.c: the FCL backend: its contract at the start of a sweep, its order, its limits, that its settings change no
 * bit, and its agreement with the native backend on scenes of every kind of body. How exact it is, test_sweep_truth.c
 * says; octrees, attaching and FCL's own distance are in tests/fcl. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <tahr/native.h>
#include <tahr/tahr.h>

#ifndef TAHR_HAVE_FCL
int main(void)
{
    puts("SKIP: unit_engines_fcl: built without FCL");
    return 77;
}
#else
#include <tahr/fcl.h>

#include "native_fixture.h"
#include "dice.h"
#include "fake_host.h"
#include "fake_world.h"

enum { GRID = 8 };

static double grid_vertices[(GRID + 1) * (GRID + 1) * 3];
static uint32_t grid_indices[GRID * GRID * 6];
static oracle_random dice;

static double uniform(double low, double high)
{
    return oracle_uniform(&dice, low, high);
}

static double dot(tahr_vec3 a, tahr_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static double apart(tahr_vec3 a, tahr_vec3 b)
{
    tahr_vec3 d = {a.x - b.x, a.y - b.y, a.z - b.z};
    return sqrt(dot(d, d));
}

/* GRID x GRID cells of 0.5 m around the origin, faces up, heights up to the given one. */
static tahr_body_desc grid_body(double height)
{
    tahr_body_desc body;
    uint32_t *index = grid_indices;

    for (int i = 0; i < (GRID + 1) * (GRID + 1); i++) {
        grid_vertices[i * 3] = (i % (GRID + 1) - GRID / 2) * 0.5;
        grid_vertices[i * 3 + 1] = (double)(i / (GRID + 1) - GRID / 2) * 0.5;
        grid_vertices[i * 3 + 2] = uniform(0, height);
    }
    for (uint32_t i = 0; i < GRID * GRID; i++) {
        uint32_t a = i / GRID * (GRID + 1) + i % GRID,
                 quad[6] = {a, a + 1, a + GRID + 2, a, a + GRID + 2, a + GRID + 1};
        for (int j = 0; j < 6; j++)
            *index++ = quad[j];
    }
    tahr_body_desc_init(&body, sizeof body, TAHR_BODY_MESH);
    body.vertices = grid_vertices;
    body.indices = grid_indices;
    body.vertex_count = (GRID + 1) * (GRID + 1);
    body.triangle_count = GRID * GRID * 2;
    return body;
}

static tahr_body_desc box_body(tahr_vec3 at, double half)
{
    tahr_body_desc body;

    tahr_body_desc_init(&body, sizeof body, TAHR_BODY_BOX);
    body.pose.position = at;
    body.half_extents = (tahr_vec3){half, half, half};
    return body;
}

static tahr_world *open_on(const tahr_backend *backend, const tahr_body_desc *bodies, uint32_t count,
                           const void *options)
{
    tahr_world_desc desc;
    tahr_world *world = NULL;

    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bodies;
    desc.body_count = count;
    desc.options = options;
    assert_int_equal(tahr_world_open(backend, &desc, &world), TAHR_OK);
    return world;
}

static tahr_world *open_fcl(const tahr_body_desc *bodies, uint32_t count)
{
    return open_on(tahr_backend_v1_fcl(), bodies, count, NULL);
}

static tahr_sweep capsule_sweep(tahr_vec3 at, tahr_vec3 motion)
{
    return fixture_sweep(fixture_shape(TAHR_SHAPE_CAPSULE, 0.35, 0.9), at, motion, 0.01);
}

static uint32_t sweep(tahr_world *world, const tahr_sweep *query, tahr_hit *hit)
{
    uint32_t count = 0;
    tahr_status status = tahr_world_sweep(world, query, hit, 1, &count);

    assert_true(status == TAHR_OK || status == TAHR_TRUNCATED);
    return count;
}

static void sweep_feels_no_internal_edges_of_a_flat_floor(void **state)
{
    tahr_body_desc body = grid_body(0);
    tahr_world *world = open_fcl(&body, 1);
    tahr_hit hit;

    (void)state;
    dice.state = 5;
    for (int i = 0; i < 2000; i++) {
        /* On the lattice, where edges and corners lie below the axis, and off it; from just inside the margin up. */
        double x = i % 2 ? uniform(-1, 1) : 0.25 * floor(uniform(-4, 4)), above = i % 3 ? 0.01 : 0.01 - 1e-6;
        tahr_sweep q = capsule_sweep((tahr_vec3){x, 0.25 * floor(uniform(-4, 4)), 0.9 + above},
                                     (tahr_vec3){0.3, uniform(-1, 1), 0});
        assert_int_equal(sweep(world, &q, &hit), 0);
    }
    tahr_world_close(world);
}

/* A floor at x < 0 and a ramp of 15 degrees from x = 0. A ball of 0.3 m begins 4 mm above the floor and 0.1 m before
 * the ramp: nearest of the ramp is its foot, 2 cm away and hidden by the floor. It leaves the floor, flatter than the
 * ramp: the ramp holds it, within the margin of 5 cm and no nearer than the floor was. */
static void a_ramp_is_met_whose_foot_a_floor_hides(void **state)
{
    static const double corners[] = {
        -2, -2, 0, 0, -2, 0, 0, 2, 0, -2, 2, 0, 4, -2, 4 * 0.26794919243112270, 4, 2, 4 * 0.26794919243112270};
    static const uint32_t indices[] = {0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2};
    const double sine = 0.25881904510252074, cosine = 0.96592582628906831;
    tahr_body_desc body;
    tahr_hit hit = {0};

    (void)state;
    tahr_body_desc_init(&body, sizeof body, TAHR_BODY_MESH);
    body.vertices = corners, body.vertex_count = 6;
    body.indices = indices, body.triangle_count = 4;
    tahr_world *world = open_fcl(&body, 1);
    tahr_sweep q = fixture_sweep(fixture_shape(TAHR_SHAPE_SPHERE, 0.3, 0.3), (tahr_vec3){-0.1, 0.3, 0.304},
                                 (tahr_vec3){2, 0, 0.2}, 0.05);
    assert_int_equal(sweep(world, &q, &hit), 1);
    double gap = (0.1 - 2 * hit.fraction) * sine + (0.304 + 0.2 * hit.fraction) * cosine - 0.3;
    assert_true(gap < 0.05 && gap > 0.004 - 1e-6);
    assert_true(fabs(hit.normal.x + sine) < 1e-9 && fabs(hit.normal.z - cosine) < 1e-9);
    tahr_world_close(world);
}

static void sweep_decides_touching_starts_by_direction(void **state)
{
    tahr_body_desc body = box_body((tahr_vec3){0, 0, -1}, 1);
    tahr_world *world = open_fcl(&body, 1);
    tahr_sweep q = capsule_sweep((tahr_vec3){0, 0, 0.905}, (tahr_vec3){0, 0, -0.1});
    tahr_hit hit;

    (void)state;
    assert_int_equal(sweep(world, &q, &hit), 1);
    assert_true(hit.blocking && !hit.start_overlap && hit.fraction == 0);
    assert_true(fabs(hit.distance - 0.005) < 1e-12 && hit.normal.z > 1 - 1e-12);
    q.motion = (tahr_vec3){1, 0, 0};
    assert_int_equal(sweep(world, &q, &hit), 0);
    q.motion = (tahr_vec3){0, 0, 1};
    assert_int_equal(sweep(world, &q, &hit), 0);
    q.position.z = 0.85;
    assert_int_equal(sweep(world, &q, &hit), 1);
    assert_true(hit.start_overlap && hit.fraction == 0 && fabs(hit.depth - 0.05) < 1e-12 && hit.normal.z > 1 - 1e-12);
    q.flags = TAHR_SWEEP_LEAVE_OVERLAP;
    assert_int_equal(sweep(world, &q, &hit), 0);
    q.motion.z = -1;
    assert_int_equal(sweep(world, &q, &hit), 1);
    assert_true(hit.start_overlap);
    tahr_world_close(world);
}

static void sweep_meets_one_sided_faces_from_the_front_only(void **state)
{
    tahr_body_desc body = grid_body(0);
    tahr_world *world = open_fcl(&body, 1);
    tahr_sweep down = capsule_sweep((tahr_vec3){0.1, 0.2, 1.5}, (tahr_vec3){0, 0, -1});
    tahr_sweep up = capsule_sweep((tahr_vec3){0.1, 0.2, -1.5}, (tahr_vec3){0, 0, 0.5});
    tahr_hit hit;

    (void)state;
    up.motion.z = 1;
    assert_int_equal(sweep(world, &down, &hit), 1);
    assert_true(fabs(hit.fraction - 0.59) < 1e-8);
    assert_int_equal(sweep(world, &up, &hit), 0);
    tahr_world_close(world);
}

static void sweep_lists_sensors_before_the_blocking_hit(void **state)
{
    tahr_body_desc bodies[4] = {box_body((tahr_vec3){5, 0, 0}, 0.5), box_body((tahr_vec3){3, 0, 0}, 0.5),
                                box_body((tahr_vec3){2, 0, 0}, 0.25), box_body((tahr_vec3){7, 0, 0}, 0.5)};
    tahr_sweep q = capsule_sweep((tahr_vec3){0, 0, 0}, (tahr_vec3){10, 0, 0});
    tahr_hit hits[4];
    uint32_t count;

    (void)state;
    bodies[1].flags = bodies[2].flags = bodies[3].flags = TAHR_BODY_SENSOR;
    bodies[0].mask = 2;
    tahr_world *world = open_fcl(bodies, 4);
    assert_int_equal(tahr_world_sweep(world, &q, hits, 4, &count), TAHR_OK);
    assert_int_equal(count, 3);
    assert_true(hits[0].body == 2 && hits[0].sensor && hits[1].body == 1 && hits[1].sensor && hits[2].body == 0 &&
                hits[2].blocking);
    assert_int_equal(tahr_world_sweep(world, &q, hits, 2, &count), TAHR_TRUNCATED);
    assert_true(count == 2 && hits[0].body == 2 && hits[1].body == 0);
    assert_int_equal(tahr_world_sweep(world, &q, hits, 1, &count), TAHR_OK);
    assert_true(count == 1 && hits[0].body == 0);
    q.mask = 1;
    assert_int_equal(tahr_world_sweep(world, &q, hits, 4, &count), TAHR_OK);
    assert_true(count == 3 && hits[2].sensor && hits[2].body == 3);
    q.mask = 0xFFFFFFFFu;
    q.ignore_body = 0;
    assert_int_equal(tahr_world_sweep(world, &q, hits, 1, &count), TAHR_OK);
    assert_int_equal(count, 0);
    q.flags = TAHR_SWEEP_ONLY_BODY; /* now the other way round */
    assert_int_equal(tahr_world_sweep(world, &q, hits, 4, &count), TAHR_OK);
    assert_true(count == 1 && hits[0].body == 0);
    q.ignore_body = TAHR_NO_BODY;
    assert_int_equal(tahr_world_sweep(world, &q, hits, 1, &count), TAHR_OK);
    assert_int_equal(count, 0);
    tahr_world_close(world);
}

static void placing_moves_movable_bodies_all_or_nothing(void **state)
{
    tahr_body_desc bodies[2] = {box_body((tahr_vec3){5, 0, 0}, 0.5), box_body((tahr_vec3){0, 5, 0}, 0.5)};
    tahr_body_pose poses[2] = {{.body = 0, .pose = {{4, 0, 0}, {0, 0, 0, 1}}},
                               {.body = 1, .pose = {{0, 4, 0}, {0, 0, 0, 1}}}};
    tahr_sweep q = capsule_sweep((tahr_vec3){0, 0, 0}, (tahr_vec3){10, 0, 0});
    tahr_hit hit;

    (void)state;
    bodies[0].flags = TAHR_BODY_MOVABLE;
    tahr_world *world = open_fcl(bodies, 2);
    assert_int_equal(sweep(world, &q, &hit), 1);
    assert_true(fabs(hit.fraction - 0.414) < 1e-8);
    assert_int_equal(tahr_world_set(world, poses, 2), TAHR_E_ARGUMENT);
    assert_int_equal(sweep(world, &q, &hit), 1);
    assert_true(fabs(hit.fraction - 0.414) < 1e-8);
    assert_int_equal(tahr_world_set(world, poses, 1), TAHR_OK);
    assert_int_equal(sweep(world, &q, &hit), 1);
    assert_true(fabs(hit.fraction - 0.314) < 1e-8);
    tahr_world_close(world);
}

static void contacts_come_in_order_and_say_when_more_existed(void **state)
{
    tahr_body_desc bodies[3] = {box_body((tahr_vec3){0, 0, -1.5}, 0.5), box_body((tahr_vec3){0.9, 0, 0}, 0.5),
                                box_body((tahr_vec3){0, 9, 0}, 1)};
    tahr_contact_query q = fixture_contacts(fixture_shape(TAHR_SHAPE_CAPSULE, 0.35, 0.9), fake_vec(0, 0, 0), 0.2);
    tahr_world *world = open_fcl(bodies, 3);
    tahr_contact contacts[4];
    uint32_t count;

    (void)state;
    assert_int_equal(tahr_world_contacts(world, &q, contacts, 4, &count), TAHR_OK);
    assert_int_equal(count, 2);
    assert_true(contacts[0].body == 1 && fabs(contacts[0].distance - 0.05) < 1e-12);
    assert_true(contacts[0].normal.x < -1 + 1e-12);
    assert_true(contacts[1].body == 0 && fabs(contacts[1].distance - 0.1) < 1e-12 && contacts[1].normal.z > 1 - 1e-12);
    assert_int_equal(contacts[0].feature, 0);
    assert_int_equal(contacts[1].feature, 5);
    assert_int_equal(tahr_world_contacts(world, &q, contacts, 1, &count), TAHR_TRUNCATED);
    assert_true(count == 1 && contacts[0].body == 1);
    q.margin = 0;
    q.position.x = 0.1;
    assert_int_equal(tahr_world_contacts(world, &q, contacts, 4, &count), TAHR_OK);
    assert_true(count == 1 && fabs(contacts[0].distance + 0.05) < 1e-12);
    tahr_world_close(world);
}

/* An ellipsoid with equal semi-axes is a ball, and where a ball meets a ridge is a square root. Beyond the ridge lies a
 * triangle whose front is far away: an answer by the way out would be early by a micrometre. */
static void an_ellipsoid_without_a_margin_meets_a_ridge_to_the_nanometre(void **state)
{
    static const double roof[] = {-4, -4, -4, 0, -4, 0, 0, 4, 0, -4, 4, -4, 4, -4, -4, 4, 4, -4};
    static const uint32_t triangles[] = {0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2};
    tahr_body_desc body = fixture_mesh(roof, 6, triangles, 4);
    tahr_world *world = open_fcl(&body, 1);
    tahr_hit hit;

    (void)state;
    dice.state = 9;
    for (int i = 0; i < 1000; i++) {
        double a = uniform(0.2, 0.6), beside = uniform(-0.5, 0.5) * a, height = sqrt(a * a - beside * beside);
        tahr_sweep q =
            fixture_sweep(fixture_shape(TAHR_SHAPE_ELLIPSOID, 0, a), (tahr_vec3){beside, uniform(-2, 2), uniform(1, 2)},
                          (tahr_vec3){0, uniform(-1, 1), -3}, 0);
        q.shape.half_x = q.shape.half_y = a;
        assert_int_equal(sweep(world, &q, &hit), 1);
        double late =
            hit.fraction * 3 - (q.position.z - height); /* m along the fall; height / a of it closes the gap */
        assert_true(fabs(late) * height / a < 2e-9 && fabs(hit.distance) < 2e-9 && !hit.start_overlap);
    }
    tahr_world_close(world);
}

static void rays_meet_faces_and_never_start_inside(void **state)
{
    tahr_body_desc bodies[2] = {box_body((tahr_vec3){2, 0, 0}, 0.5), box_body((tahr_vec3){0, 0, 5}, 0.5)};
    tahr_ray ray = {.motion = {4, 0, 0}, .mask = 0xFFFFFFFFu, .ignore_body = TAHR_NO_BODY};
    tahr_hit hit;
    uint32_t count;

    (void)state;
    bodies[1].type = TAHR_BODY_SPHERE;
    bodies[1].radius = 0.5;
    tahr_world *world = open_fcl(bodies, 2);
    assert_int_equal(tahr_world_ray(world, &ray, &hit, &count), TAHR_OK);
    assert_true(count == 1 && fabs(hit.fraction - 0.375) < 1e-9 && hit.normal.x < -1 + 1e-9 && hit.feature == 0);
    ray.origin.x = 2;
    assert_int_equal(tahr_world_ray(world, &ray, &hit, &count), TAHR_OK);
    assert_int_equal(count, 0);
    ray = (tahr_ray){.motion = {0, 0, 10}, .mask = 0xFFFFFFFFu, .ignore_body = TAHR_NO_BODY};
    assert_int_equal(tahr_world_ray(world, &ray, &hit, &count), TAHR_OK);
    assert_true(count == 1 && hit.body == 1 && fabs(hit.fraction - 0.45) < 1e-9);
    tahr_world_close(world);
}

/* --- Directly through the table: what the core would never let through, and memory --- */

static void opening_returns_all_memory_when_any_allocation_fails(void **state)
{
    tahr_body_desc bodies[2] = {grid_body(0.2), box_body((tahr_vec3){0, 0, 5}, 1)};
    const tahr_backend *b = tahr_backend_v1_fcl();
    tahr_world_desc desc;
    fake_memory memory = {.fail_once = 1};
    fake_log log;
    tahr_host host = {sizeof host, TAHR_ABI, fake_allocator(&memory), fake_log_of(&log)};
    void *self = NULL;

    (void)state;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bodies;
    desc.body_count = 2;
    for (memory.fail_at = 1; memory.fail_at < 100; memory.fail_at++) {
        memory.requests = 0;
        tahr_status status = b->open(&host, &desc, &self);
        if (status == TAHR_OK) break;
        assert_int_equal(status, TAHR_E_MEMORY);
        assert_null(self);
        assert_int_equal(memory.live_bytes, 0);
    }
    assert_true(memory.fail_at > 2 && self != NULL);

    tahr_query_context context = {0};
    tahr_sweep q = capsule_sweep((tahr_vec3){0, 0, 1.5}, (tahr_vec3){0.1, 0, -1});
    tahr_hit hit;
    uint32_t count = 7;
    uint64_t requests = memory.requests;
    assert_int_equal(b->sweep(self, &context, &q, &hit, 1, &count), TAHR_OK);
    assert_int_equal(count, 1);
    assert_true(context.narrow_tests > 0 && context.narrow_iterations > 0);
    q.position.x = NAN;
    assert_int_equal(b->sweep(self, &context, &q, &hit, 1, &count), TAHR_E_ARGUMENT);
    assert_int_equal(count, 0);
    q.position.x = 0;
    q.shape.radius = INFINITY;
    assert_int_equal(b->sweep(self, &context, &q, &hit, 1, &count), TAHR_E_ARGUMENT);
    q.shape.type = 77;
    assert_int_equal(b->sweep(self, &context, &q, &hit, 1, &count), TAHR_E_UNSUPPORTED);
    assert_int_equal(memory.requests, requests);
    b->close(self);
    assert_int_equal(memory.live_bytes, 0);
    assert_int_equal(memory.mismatches, 0);
}

/* --- Against the native backend --- */

static tahr_quat random_turn(void)
{
    tahr_quat q = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(0.1, 1)};
    double n = 1 / sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    return (tahr_quat){q.x * n, q.y * n, q.z * n, q.w * n};
}

static tahr_body_desc random_body(uint32_t type)
{
    tahr_body_desc body = type == TAHR_BODY_MESH ? grid_body(0.4) : box_body((tahr_vec3){0, 0, 0}, 1);

    body.type = type;
    body.half_extents = (tahr_vec3){uniform(0.1, 1), uniform(0.1, 1), uniform(0.1, 1)};
    body.radius = uniform(0.1, 0.6);
    body.half_height = body.radius + uniform(0, 0.8);
    body.pose.position = dice_vec(&dice, -2.5, 2.5);
    body.pose.orientation = random_turn();
    body.flags = uniform(0, 1) < 0.5 ? TAHR_BODY_TWO_SIDED : 0;
    return body;
}

static tahr_sweep random_sweep(int kind)
{
    tahr_sweep q = capsule_sweep(dice_vec(&dice, -3, 3), dice_vec(&dice, -1.5, 1.5));
    double angle = uniform(0, 3);

    q.shape.type = TAHR_SHAPE_SPHERE + (uint32_t)kind;
    q.shape.radius = kind == 2 ? 0 : uniform(0.1, 0.4);
    q.shape.half_height = kind == 0 ? q.shape.radius : q.shape.radius + uniform(0.05, 0.6);
    if (kind == 2) {
        q.shape.half_x = uniform(0.1, 0.4);
        q.shape.half_y = uniform(0.1, 0.4);
        q.orientation = (tahr_quat){0, 0, sin(angle / 2), cos(angle / 2)};
    }
    return q;
}

/* Time differs without bound at a graze: the gap does not. */
static int same_hit(const tahr_sweep *q, const tahr_hit *a, const tahr_hit *b)
{
    double along = fabs(a->fraction - b->fraction), slope = fabs(dot(q->motion, a->normal));

    if (a->start_overlap || b->start_overlap)
        return a->start_overlap && b->start_overlap && fabs(a->depth - b->depth) < 1e-8;
    return along * slope < 1e-7 && along < 1e-3 && (a->body != b->body || apart(a->normal, b->normal) < 1e-4);
}

static void sweeps_agree_with_native_on_every_kind_of_body(void **state)
{
    int hits = 0, differ = 0;

    (void)state;
    dice.state = 11;
    for (int scene = 0; scene < 200; scene++) {
        tahr_body_desc bodies[6];
        for (uint32_t i = 0; i < 6; i++)
            bodies[i] = random_body(i == 0 ? TAHR_BODY_MESH : TAHR_BODY_BOX + (i - 1) % 3);
        tahr_world *fcl = open_fcl(bodies, 6), *native = open_on(tahr_backend_v1_native(), bodies, 6, NULL);
        for (int i = 0; i < 100; i++) {
            tahr_sweep q = random_sweep(i % 3);
            tahr_hit a = {0}, b = {0};
            uint32_t found_a = sweep(fcl, &q, &a), found_b = sweep(native, &q, &b);
            /* Round the rim of a one-sided mesh from behind native feels the front later, already inside. */
            if (found_b && !b.start_overlap && b.distance < -1e-6) continue;
            hits += (int)found_a;
            differ += found_a != found_b || (found_a && !same_hit(&q, &a, &b));
        }
        tahr_world_close(fcl);
        tahr_world_close(native);
    }
    print_message("    %d hits, %d differ\n", hits, differ);
    assert_true(hits > 4000);
    assert_int_equal(differ, 0);
}

/* --- One-way bodies, through the table --- */

typedef struct platform {
    const tahr_backend *backend;
    fake_memory memory;
    fake_log log;
    tahr_host host;
    void *self;
} platform;

/* A one-way box, 2 x 2 m, its top at z = 0.1. */
static void open_platform(platform *p)
{
    tahr_body_desc body = box_body((tahr_vec3){0, 0, 0}, 1);
    tahr_world_desc desc;

    *p = (platform){.backend = tahr_backend_v1_fcl()};
    p->host = (tahr_host){sizeof p->host, TAHR_ABI, fake_allocator(&p->memory), fake_log_of(&p->log)};
    body.half_extents.z = 0.1;
    body.flags = TAHR_BODY_ONE_WAY;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = &body;
    desc.body_count = 1;
    assert_int_equal(p->backend->open(&p->host, &desc, &p->self), TAHR_OK);
}

static uint32_t platform_sweep(platform *p, tahr_vec3 at, tahr_vec3 motion, uint32_t flags, tahr_hit *hit)
{
    tahr_query_context context = {0};
    tahr_sweep q = capsule_sweep(at, motion);
    uint32_t count;

    q.flags = flags;
    assert_int_equal(p->backend->sweep(p->self, &context, &q, hit, 1, &count), TAHR_OK);
    return count;
}

static uint32_t platform_contacts(platform *p, double z, uint32_t flags, tahr_contact *contact)
{
    tahr_query_context context = {0};
    tahr_contact_query q = fixture_contacts(fixture_shape(TAHR_SHAPE_CAPSULE, 0.35, 0.9), fake_vec(0, 0, z), 0.02);
    uint32_t count;

    q.flags = flags;
    assert_int_equal(p->backend->contacts(p->self, &context, &q, contact, 1, &count), TAHR_OK);
    return count;
}

static void one_way_boxes_are_there_from_above_only(void **state)
{
    const tahr_vec3 down = {0, 0, -3};
    tahr_query_context context = {0};
    tahr_ray ray = {.origin = {0, 0, 2}, .motion = {0, 0, -4}, .mask = 0xFFFFFFFFu, .ignore_body = TAHR_NO_BODY};
    tahr_contact contact;
    tahr_hit hit;
    uint32_t count;
    platform p;

    (void)state;
    open_platform(&p);
    assert_int_equal(platform_sweep(&p, fake_vec(0, 0, 2), down, 0, &hit), 1);
    assert_true(fabs(hit.fraction - (2 - 0.9 - 0.1 - 0.01) / 3) < 1e-8);
    assert_int_equal(platform_sweep(&p, fake_vec(0, 0, -2), fake_vec(0, 0, 3), 0, &hit), 0);
    assert_int_equal(platform_sweep(&p, fake_vec(-3, 0, 0), fake_vec(3, 0, 0), 0, &hit), 0);
    assert_int_equal(platform_sweep(&p, fake_vec(0, 0, 0.5), down, 0, &hit), 0); /* in it */
    /* At rest on it, at the margin of 0.01 m: dropped; not from farther above. */
    assert_int_equal(platform_sweep(&p, fake_vec(0, 0, 1.01), down, 0, &hit), 1);
    assert_int_equal(platform_sweep(&p, fake_vec(0, 0, 1.01), down, TAHR_SWEEP_DROP, &hit), 0);
    assert_int_equal(platform_sweep(&p, fake_vec(0, 0, 1.05), down, TAHR_SWEEP_DROP, &hit), 1);
    assert_int_equal(platform_contacts(&p, 1.005, 0, &contact), 1);
    assert_true(fabs(contact.distance - 0.005) < 1e-12);
    assert_int_equal(platform_contacts(&p, 1.005, TAHR_CONTACTS_DROP, &contact), 0);
    assert_int_equal(platform_contacts(&p, 0.9, 0, &contact), 0);
    assert_int_equal(p.backend->ray(p.self, &context, &ray, &hit, &count), TAHR_OK);
    assert_true(count == 1 && fabs(hit.fraction - 1.9 / 4) < 1e-9);
    ray.origin = fake_vec(-2, 0, 0.6); /* onto the top, but 76 degrees off its normal */
    ray.motion = fake_vec(2.4, 0, -0.6);
    assert_int_equal(p.backend->ray(p.self, &context, &ray, &hit, &count), TAHR_OK);
    assert_int_equal(count, 0);
    p.backend->close(p.self);
}

/* --- Settings --- */

static void no_setting_changes_a_bit(void **state)
{
    static const tahr_fcl_desc settings[] = {
        {.struct_size = sizeof(tahr_fcl_desc), .no_cache = 1},
        {.struct_size = sizeof(tahr_fcl_desc), .volumes = TAHR_FCL_OBBRSS},
        {.struct_size = sizeof(tahr_fcl_desc), .volumes = TAHR_FCL_OBBRSS, .search = TAHR_FCL_COLLIDE},
        {.struct_size = sizeof(tahr_fcl_desc), .cache_parts = 8, .cache_margin = 2},
    };
    enum { COUNT = sizeof settings / sizeof *settings };
    int hits = 0;

    (void)state;
    dice.state = 12;
    for (int scene = 0; scene < 40; scene++) {
        tahr_body_desc bodies[6];
        tahr_world *worlds[COUNT];
        for (uint32_t i = 0; i < 6; i++)
            bodies[i] = random_body(i == 0 ? TAHR_BODY_MESH : TAHR_BODY_BOX + (i - 1) % 3);
        tahr_world *plain = open_fcl(bodies, 6);
        for (int k = 0; k < COUNT; k++)
            worlds[k] = open_on(tahr_backend_v1_fcl(), bodies, 6, &settings[k]);
        for (int i = 0; i < 50; i++) {
            tahr_sweep q = random_sweep(i % 3);
            tahr_hit a = {0}, b;
            uint32_t found = sweep(plain, &q, &a);
            hits += (int)found;
            for (int k = 0; k < COUNT; k++) {
                memset(&b, 0, sizeof b);
                assert_int_equal(sweep(worlds[k], &q, &b), found);
                assert_memory_equal(&a, &b, sizeof a);
            }
        }
        tahr_world_close(plain);
        for (int k = 0; k < COUNT; k++)
            tahr_world_close(worlds[k]);
    }
    assert_true(hits > 200);
}

/* A step announces; the queries of a mover then come from its cache, and from FCL where they leave it. */
static void the_cache_changes_no_bit_of_a_walk(void **state)
{
    static const tahr_fcl_desc settings[] = {{.struct_size = sizeof(tahr_fcl_desc)},
                                             {.struct_size = sizeof(tahr_fcl_desc), .no_cache = 1},
                                             {.struct_size = sizeof(tahr_fcl_desc), .cache_margin = 1e-9}};
    tahr_state end[3];

    (void)state;
    for (int k = 0; k < 3; k++) {
        dice.state = 31;
        tahr_body_desc bodies[2] = {grid_body(0.3), box_body((tahr_vec3){0.8, 0.3, 0.4}, 0.3)};
        bodies[1].flags = TAHR_BODY_MOVABLE;
        tahr_world *world = open_on(tahr_backend_v1_fcl(), bodies, 2, &settings[k]);
        tahr_config config;
        tahr_mover *mover;
        tahr_input input = {.struct_size = sizeof input};
        tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
        tahr_state_init(&end[k], &config, &(tahr_vec3){-0.5, 0, 1.5});
        assert_int_equal(tahr_mover_create(world, &config, &mover), TAHR_OK);
        for (int i = 0; i < 300; i++) {
            tahr_body_pose pose = {.body = 1, .pose = {{0.8 - 0.002 * i, 0.3, 0.4}, {0, 0, 0, 1}}};
            assert_int_equal(tahr_world_move(world, &pose, 1, 1.0 / 60), TAHR_OK);
            input.move = (tahr_vec3){i % 97 < 50 ? 1 : -1, i % 61 < 30 ? 0.5 : -0.5, 0};
            assert_true(tahr_mover_step(mover, &input, 1.0 / 60, &end[k], NULL) >= 0);
        }
        tahr_mover_destroy(mover);
        tahr_world_close(world);
    }
    assert_memory_equal(&end[0], &end[1], sizeof end[0]);
    assert_memory_equal(&end[0], &end[2], sizeof end[0]);
}

static void options_out_of_range_are_named(void **state)
{
    static const struct {
        tahr_fcl_desc desc;
        tahr_status status;
        const char *name;
    } cases[] = {
        {{.struct_size = 4}, TAHR_E_STRUCT_SIZE, "struct_size"},
        {{.struct_size = sizeof(tahr_fcl_desc), .volumes = 2}, TAHR_E_ARGUMENT, "volumes"},
        {{.struct_size = sizeof(tahr_fcl_desc), .search = 2}, TAHR_E_ARGUMENT, "search"},
        {{.struct_size = sizeof(tahr_fcl_desc), .no_cache = 2}, TAHR_E_ARGUMENT, "no_cache"},
        {{.struct_size = sizeof(tahr_fcl_desc), .cache_parts = 65537}, TAHR_E_ARGUMENT, "cache_parts"},
        {{.struct_size = sizeof(tahr_fcl_desc), .cache_margin = NAN}, TAHR_E_ARGUMENT, "cache_margin"},
        {{.struct_size = sizeof(tahr_fcl_desc), .octree_count = 1}, TAHR_E_ARGUMENT, "octrees"},
        {{.struct_size = sizeof(tahr_fcl_desc), .manager = &dice}, TAHR_E_ARGUMENT, "manager"},
    };
    tahr_body_desc body = box_body((tahr_vec3){0, 0, 0}, 1);

    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        fake_log log = {0};
        tahr_log to = fake_log_of(&log);
        tahr_world_desc desc;
        tahr_world *world = NULL;
        tahr_world_desc_init(&desc, sizeof desc);
        desc.bodies = &body;
        desc.body_count = 1;
        desc.log = &to;
        desc.options = &cases[i].desc;
        assert_int_equal(tahr_world_open(tahr_backend_v1_fcl(), &desc, &world), cases[i].status);
        assert_null(world);
        assert_non_null(strstr(log.text, cases[i].name));
    }
}

/* --- What FCL's assertions would abort on: its narrow phase is never asked about contact --- */

/* Lattice poses, where everything touches exactly: 1/8 m, shapes and bodies alike. */
static void exact_touching_on_a_lattice_is_answered(void **state)
{
    static const tahr_fcl_desc collide = {
        .struct_size = sizeof collide, .volumes = TAHR_FCL_OBBRSS, .search = TAHR_FCL_COLLIDE};
    tahr_body_desc bodies[4] = {grid_body(0), box_body((tahr_vec3){0, 0, 0.5}, 0.5),
                                box_body((tahr_vec3){1, 1, 0}, 0.25), box_body((tahr_vec3){-1, 0, 0}, 0.5)};
    int answered = 0;

    (void)state;
    bodies[2].type = TAHR_BODY_SPHERE;
    bodies[2].radius = 0.25;
    bodies[3].type = TAHR_BODY_CAPSULE;
    bodies[3].radius = 0.25;
    bodies[3].half_height = 0.5;
    tahr_world *world = open_on(tahr_backend_v1_fcl(), bodies, 4, &collide);
    dice.state = 77;
    for (int i = 0; i < 3000; i++) {
        tahr_vec3 at = dice_vec(&dice, -16, 16), to = dice_vec(&dice, -8, 8);
        tahr_sweep q = capsule_sweep((tahr_vec3){floor(at.x) / 8, floor(at.y) / 8, floor(at.z) / 8},
                                     (tahr_vec3){floor(to.x) / 8, floor(to.y) / 8, floor(to.z) / 8});
        tahr_hit hit = {0};
        q.margin = 0;
        q.shape.type = TAHR_SHAPE_SPHERE + (uint32_t)i % 3;
        q.shape.radius = i % 3 == 2 ? 0 : 0.25;
        q.shape.half_height = i % 3 ? 0.5 : 0.25;
        q.shape.half_x = q.shape.half_y = i % 3 == 2 ? 0.25 : 0;
        q.orientation.w = 1;
        answered += (int)sweep(world, &q, &hit);
        assert_false(hit.unknown);
    }
    assert_true(answered > 500);
    tahr_world_close(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sweep_feels_no_internal_edges_of_a_flat_floor),
        cmocka_unit_test(a_ramp_is_met_whose_foot_a_floor_hides),
        cmocka_unit_test(sweep_decides_touching_starts_by_direction),
        cmocka_unit_test(sweep_meets_one_sided_faces_from_the_front_only),
        cmocka_unit_test(sweep_lists_sensors_before_the_blocking_hit),
        cmocka_unit_test(placing_moves_movable_bodies_all_or_nothing),
        cmocka_unit_test(contacts_come_in_order_and_say_when_more_existed),
        cmocka_unit_test(an_ellipsoid_without_a_margin_meets_a_ridge_to_the_nanometre),
        cmocka_unit_test(rays_meet_faces_and_never_start_inside),
        cmocka_unit_test(opening_returns_all_memory_when_any_allocation_fails),
        cmocka_unit_test(sweeps_agree_with_native_on_every_kind_of_body),
        cmocka_unit_test(one_way_boxes_are_there_from_above_only),
        cmocka_unit_test(no_setting_changes_a_bit),
        cmocka_unit_test(the_cache_changes_no_bit_of_a_walk),
        cmocka_unit_test(options_out_of_range_are_named),
        cmocka_unit_test(exact_touching_on_a_lattice_is_answered),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
#endif
