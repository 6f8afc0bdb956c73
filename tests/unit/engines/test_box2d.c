/* SPDX-License-Identifier: MIT
 * test_box2d.c: the contract of the box2d backend on both engines: closed forms at every gap, grazing, corners, sides
 * of chains, order, sensors, one-way bodies, placing, fluids, and what it refuses. How exact it is at random,
 * test_box2d_truth.c says; seams, test_box2d_seams.c. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "box2d_rig.h"

#ifndef TAHR_HAVE_BOX2D
int main(void)
{
    puts("SKIP: unit_engines_box2d: built without Box2D");
    return 77;
}
#else
#include "near.h"

#include <tahr/box2d.h>

static uint32_t engines[2];
static int engine_count;

static const double H = 0.70710678118654757; /* sqrt(1/2) */

/* Circle r 0.35; capsule of that radius and half height 0.9; box 0.35 by 0.9. */
static tahr_shape shape_of(uint32_t type)
{
    tahr_shape s = {type, 0, type == TAHR_SHAPE_BOX ? 0 : 0.35, type == TAHR_SHAPE_SPHERE ? 0.35 : 0.9, 0, 0};
    s.half_x = s.half_y = type == TAHR_SHAPE_BOX ? 0.35 : 0;
    return s;
}

static tahr_sweep sweep_of(uint32_t type, double x, double y, double dx, double dy, double margin)
{
    return (tahr_sweep){.shape = shape_of(type),
                        .position = {x, y, 3},
                        .up = {0, 1, 0},
                        .orientation = {-H, 0, 0, H},
                        .motion = {dx, dy, 0},
                        .margin = margin,
                        .mask = 0xFFFFFFFFu,
                        .ignore_body = TAHR_NO_BODY};
}

static uint32_t ask(tahr_world *world, const tahr_sweep *q, tahr_hit *hits, uint32_t capacity)
{
    uint32_t count = 0;
    tahr_status status = tahr_world_sweep(world, q, hits, capacity, &count);
    assert_true(status == TAHR_OK || status == TAHR_TRUNCATED);
    return count;
}

static uint32_t touch(tahr_world *world, const tahr_sweep *at, double margin, tahr_contact contacts[8])
{
    tahr_contact_query q = {.shape = at->shape,
                            .position = at->position,
                            .up = at->up,
                            .orientation = at->orientation,
                            .margin = margin,
                            .mask = 0xFFFFFFFFu,
                            .ignore_body = TAHR_NO_BODY};
    uint32_t count = 0;
    assert_int_equal(tahr_world_contacts(world, &q, contacts, 8, &count), TAHR_OK);
    return count;
}

/* A block with its top at y = 0, a circle and an edge with theirs. */
static tahr_body_desc floor_of(int kind)
{
    static const double edge[6] = {50, 0, 0, -50, 0, 0};
    tahr_body_desc b = box2d_box(0, -1, 50, 1);
    if (kind == 1) {
        return box2d_chain(edge, 2);
    }
    if (kind == 2) {
        assert_int_equal(tahr_body_desc_init(&b, sizeof b, TAHR_BODY_CAPSULE), TAHR_OK);
        b.pose.position.y = -0.5;
        b.pose.orientation = (tahr_quat){0, H, 0, H}; /* its axis, z, along x */
        b.radius = 0.5;
        b.half_height = 50;
    }
    return b;
}

/* Box2D's own cast stops at once within 1 cm, whatever the motion. */
static void parallel_and_parting_motion_is_free_at_every_gap(void **unused)
{
    const double gaps[] = {1e-6, 1e-5, 1e-4, 1e-3, 0.005, 0.01, 0.02, 0.05, 0.1};
    (void)unused;
    for (int k = 0; k < engine_count * 3 * 3 * 9; k++) {
        fake_log log = {0};
        tahr_body_desc body = floor_of(k / 27 % 3);
        uint32_t type = 1 + (uint32_t)k / 9 % 3;
        double gap = gaps[k % 9];
        tahr_world *world = box2d_open(engines[k / 81], &body, 1, &log);
        tahr_hit hit;
        tahr_sweep q = sweep_of(type, -10, shape_of(type).half_height + gap, 20, 0, 0);
        for (int i = 0; i < 3; i++) {
            q.margin = i == 1 ? 0.01 : 0;
            q.motion.y = i == 2 ? 1e-3 : 0;
            assert_int_equal(ask(world, &q, &hit, 1), 0);
        }
        q.motion = (tahr_vec3){0, -0.5, 0};
        assert_int_equal(ask(world, &q, &hit, 1), 1);
        assert_near(0.5 * hit.fraction, gap, 2e-9);
        assert_near(hit.normal.y, 1, 0);
        assert_near(hit.point.y, 0, 2e-9);
        assert_near(hit.point.z, 3, 0);
        tahr_world_close(world);
    }
}

/* At 1 and 0.1 degrees: gap / sin of the way. */
static void grazing_motion_stops_where_the_gap_is_the_margin(void **unused)
{
    const double degrees[] = {1, 0.1};
    (void)unused;
    for (int k = 0; k < engine_count * 3 * 3 * 2; k++) {
        fake_log log = {0};
        tahr_body_desc body = floor_of(k / 6 % 3);
        uint32_t type = 1 + (uint32_t)k / 2 % 3;
        double angle = degrees[k % 2] * 3.14159265358979323846 / 180, gap = 0.015, margin = 0.01, way = 10;
        tahr_world *world = box2d_open(engines[k / 18], &body, 1, &log);
        tahr_hit hit;
        tahr_sweep q =
            sweep_of(type, -10, shape_of(type).half_height + gap, way * cos(angle), -way * sin(angle), margin);
        assert_int_equal(ask(world, &q, &hit, 1), 1);
        assert_near(way * hit.fraction * sin(angle), gap - margin, 2e-9);
        assert_near(hit.normal.y, 1, 0);
        assert_near(hit.distance, margin, 2e-9);
        tahr_world_close(world);
    }
}

/* A circle that passes below the top corner of a block is stopped at sqrt((r + m)^2 - h^2) before it; the surface
 * normal is that of the face that the motion runs into. */
static void corners_are_round_for_round_shapes(void **unused)
{
    (void)unused;
    for (int k = 0; k < engine_count * 2; k++) {
        fake_log log = {0};
        tahr_body_desc body = box2d_box(2, -1, 1, 1);
        tahr_world *world = box2d_open(engines[k / 2], &body, 1, &log);
        double margin = k % 2 ? 0.01 : 0, reach = 0.35 + margin, height = 0.2;
        double x = 1 - sqrt(reach * reach - height * height);
        tahr_hit hit;
        tahr_sweep q = sweep_of(TAHR_SHAPE_SPHERE, -2, height, 4, 0, margin);
        assert_int_equal(ask(world, &q, &hit, 1), 1);
        assert_near(-2 + 4 * hit.fraction, x, 1e-8);
        assert_near(hit.normal.x, (x - 1) / reach, 1e-7);
        assert_near(hit.normal.y, height / reach, 1e-7);
        assert_near(hit.surface_normal.x, -1, 0);
        assert_near(hit.point.x, 1, 1e-12);
        q = sweep_of(TAHR_SHAPE_SPHERE, 0.9, 2, 0, -4, margin);
        assert_int_equal(ask(world, &q, &hit, 1), 1);
        assert_near(2 - 4 * hit.fraction, sqrt(reach * reach - 0.1 * 0.1), 1e-8);
        assert_near(hit.surface_normal.y, 1, 0);
        tahr_world_close(world);
    }
}

static void an_overlap_at_the_start_says_the_shortest_way_out(void **unused)
{
    (void)unused;
    for (int e = 0; e < engine_count; e++) {
        fake_log log = {0};
        tahr_body_desc body = box2d_box(0, -1, 50, 1);
        tahr_world *world = box2d_open(engines[e], &body, 1, &log);
        tahr_hit hit;
        for (uint32_t type = 1; type <= 3; type++) {
            const double depths[] = {1e-6, 0.01, 0.3, 0.8};
            for (int i = 0; i < 4; i++) {
                tahr_sweep q = sweep_of(type, 0, shape_of(type).half_height - depths[i], 1, 0, 0.01);
                assert_int_equal(ask(world, &q, &hit, 1), 1);
                assert_int_equal(hit.start_overlap, 1);
                assert_near(hit.depth, depths[i], 1e-12);
                assert_near(hit.normal.y, 1, 0);
                assert_near(hit.fraction, 0, 0);
                q.flags = TAHR_SWEEP_LEAVE_OVERLAP;
                assert_int_equal(ask(world, &q, &hit, 1), 0);
                q.motion = (tahr_vec3){0, -1, 0};
                assert_int_equal(ask(world, &q, &hit, 1), 1);
            }
        }
        tahr_world_close(world);
    }
}

/* Sunk a nanometre into flush tiles, the end of each is no way out. */
static void tiles_are_left_upward_only(void **unused)
{
    (void)unused;
    for (int e = 0; e < engine_count; e++) {
        fake_log log = {0};
        tahr_body_desc bodies[20];
        tahr_contact contacts[8];
        for (int i = 0; i < 20; i++) {
            bodies[i] = box2d_box(i, -0.5, 0.5, 0.5);
        }
        tahr_world *world = box2d_open(engines[e], bodies, 20, &log);
        for (uint32_t type = 1; type <= 3; type++) {
            for (int i = 0; i < 40; i++) {
                tahr_sweep q =
                    sweep_of(type, 8 + 0.0257 * i, shape_of(type).half_height - (i % 2 ? 1e-9 : 1e-2), 1, 0, 0);
                uint32_t count = touch(world, &q, 0, contacts);
                assert_true(count >= 1);
                for (uint32_t n = 0; n < count; n++) {
                    assert_near(contacts[n].normal.y, 1, 1e-6);
                }
            }
        }
        tahr_world_close(world);
    }
}

static void a_chain_has_its_front_on_the_right_hand(void **unused)
{
    static const double line[6] = {3, 0, 0, -3, 0, 0}, ring[12] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    (void)unused;
    for (int k = 0; k < engine_count * 3; k++) {
        fake_log log = {0};
        uint32_t type = 1 + (uint32_t)k % 3;
        tahr_body_desc body = box2d_chain(line, 2);
        tahr_hit hit;
        tahr_sweep down = sweep_of(type, 0, 3, 0, -6, 0.01), up = sweep_of(type, 0, -3, 0, 6, 0.01);
        tahr_world *world = box2d_open(engines[k / 3], &body, 1, &log);
        assert_int_equal(ask(world, &down, &hit, 1), 1);
        assert_int_equal(ask(world, &up, &hit, 1), 0);
        tahr_world_close(world);
        body.flags = TAHR_BODY_TWO_SIDED;
        world = box2d_open(engines[k / 3], &body, 1, &log);
        assert_int_equal(ask(world, &up, &hit, 1), 1);
        assert_near(hit.normal.y, -1, 0);
        assert_near(6 * hit.fraction, 3 - shape_of(type).half_height - 0.01, 2e-9);
        tahr_world_close(world);
        body = box2d_chain(ring, 4); /* counter-clockwise: solid from outside */
        body.flags = TAHR_BODY_LOOP;
        world = box2d_open(engines[k / 3], &body, 1, &log);
        assert_int_equal(ask(world, &down, &hit, 1), 1);
        assert_int_equal(hit.feature, 2);
        assert_int_equal(ask(world, &up, &hit, 1), 1);
        assert_int_equal(hit.feature, 0);
        tahr_world_close(world);
    }
}

/* Two blocks at one place and one behind; three sensors on the way. */
static void answers_come_in_order(void **unused)
{
    tahr_body_desc bodies[6] = {box2d_box(3, 0, 0.1, 1), box2d_box(5, 0, 1, 1), box2d_box(5, 0, 1, 1),
                                box2d_box(2, 0, 0.1, 1), box2d_box(8, 0, 1, 1), box2d_box(3, 0.5, 0.1, 1)};
    (void)unused;
    bodies[0].flags = bodies[3].flags = bodies[5].flags = TAHR_BODY_SENSOR;
    for (int e = 0; e < engine_count; e++) {
        fake_log log = {0};
        tahr_world *world = box2d_open(engines[e], bodies, 6, &log);
        tahr_hit hits[8];
        const uint32_t order[] = {3, 0, 5, 1};
        tahr_sweep q = sweep_of(TAHR_SHAPE_SPHERE, 0, 0, 10, 0, 0);
        assert_int_equal(ask(world, &q, hits, 8), 4);
        for (int i = 0; i < 4; i++) {
            assert_int_equal(hits[i].body, order[i]);
            assert_int_equal(hits[i].sensor, i < 3);
        }
        assert_int_equal(hits[3].feature, 0); /* its face toward -x, as of a box in space */
        assert_int_equal(ask(world, &q, hits, 1), 1);
        assert_int_equal(hits[0].body, 1);
        assert_int_equal(ask(world, &q, hits, 2), 2); /* the last sensors are dropped */
        assert_true(hits[0].body == 3 && hits[1].body == 1);
        q.ignore_body = 1;
        assert_int_equal(ask(world, &q, hits, 1), 1);
        assert_int_equal(hits[0].body, 2);
        q.flags = TAHR_SWEEP_ONLY_BODY;
        q.ignore_body = 4;
        assert_int_equal(ask(world, &q, hits, 1), 1);
        assert_int_equal(hits[0].body, 4);
        q.flags = TAHR_SWEEP_SENSORS;
        q.ignore_body = TAHR_NO_BODY;
        assert_int_equal(ask(world, &q, hits, 8), 3);
        tahr_world_close(world);
    }
}

static void one_way_bodies_are_stood_on_and_passed(void **unused)
{
    (void)unused;
    for (int k = 0; k < engine_count * 3; k++) {
        fake_log log = {0};
        uint32_t type = 1 + (uint32_t)k % 3;
        double half = shape_of(type).half_height;
        tahr_body_desc body = box2d_box(0, -0.1, 2, 0.1);
        tahr_contact contacts[8];
        tahr_hit hit;
        body.flags = TAHR_BODY_ONE_WAY;
        tahr_world *world = box2d_open(engines[k / 3], &body, 1, &log);
        tahr_sweep down = sweep_of(type, 0, half + 1, 0, -3, 0.01), up = sweep_of(type, 0, -3, 0, 6, 0.01);
        assert_int_equal(ask(world, &down, &hit, 1), 1);
        assert_near(3 * hit.fraction, 0.99, 2e-9);
        assert_int_equal(ask(world, &up, &hit, 1), 0);
        up.motion = (tahr_vec3){6, 0, 0};
        up.position = (tahr_vec3){-5, -0.1, 0};
        assert_int_equal(ask(world, &up, &hit, 1), 0);
        down.position.y = half - 0.05; /* in it already: falls on */
        assert_int_equal(ask(world, &down, &hit, 1), 0);
        assert_int_equal(touch(world, &down, 0.02, contacts), 0);
        down.position.y = half + 0.01; /* on it: drops through when asked to */
        assert_int_equal(ask(world, &down, &hit, 1), 1);
        assert_int_equal(touch(world, &down, 0.02, contacts), 1);
        down.flags = TAHR_SWEEP_DROP;
        assert_int_equal(ask(world, &down, &hit, 1), 0);
        down.position.y = half + 0.5; /* the next layer holds */
        assert_int_equal(ask(world, &down, &hit, 1), 1);
        tahr_world_close(world);
    }
}

static void rays_meet_what_is_first(void **unused)
{
    static const double line[6] = {3, 2, 0, -3, 2, 0};
    tahr_body_desc bodies[4] = {box2d_box(3, 0, 1, 1), box2d_box(1, 0, 0.1, 5), box2d_chain(line, 2), floor_of(2)};
    (void)unused;
    bodies[1].flags = TAHR_BODY_SENSOR;
    bodies[3].pose.position.y = -5;
    for (int e = 0; e < engine_count; e++) {
        fake_log log = {0};
        tahr_world *world = box2d_open(engines[e], bodies, 4, &log);
        const struct {
            double x, y, dx, dy, at, nx, ny;
            uint32_t body;
        } rows[] = {{0, 0, 10, 0, 2, -1, 0, 0},   {0, 5, 0, -4, 3, 0, 1, 2},  {0, 0, 0, 5, -1, 0, 0, 0},
                    {0, 0, 0, -10, 4.5, 0, 1, 3}, {3, 0, 10, 0, -1, 0, 0, 0}, {0, 0, 1.5, 0, -1, 0, 0, 0},
                    {6, 0.5, -10, 0, 2, 1, 0, 0}};
        for (int i = 0; i < 7; i++) {
            tahr_hit hit;
            uint32_t count = 7;
            tahr_ray q = {{rows[i].x, rows[i].y, 1}, {rows[i].dx, rows[i].dy, 0}, 0xFFFFFFFFu, TAHR_NO_BODY};
            assert_int_equal(tahr_world_ray(world, &q, &hit, &count), TAHR_OK);
            assert_int_equal(count, rows[i].at >= 0);
            if (count) {
                assert_int_equal(hit.body, rows[i].body);
                assert_near(hit.fraction * hypot(rows[i].dx, rows[i].dy), rows[i].at, 1e-12);
                assert_true(hit.normal.x == rows[i].nx && hit.normal.y == rows[i].ny && hit.point.z == 1);
            }
        }
        tahr_world_close(world);
    }
}

/* A quarter turn makes a wall of a shelf. */
static void placed_bodies_are_where_they_were_placed(void **unused)
{
    (void)unused;
    for (int e = 0; e < engine_count; e++) {
        fake_log log = {0};
        tahr_body_desc body = box2d_box(0, 0, 4, 0.25);
        tahr_hit hit;
        body.flags = TAHR_BODY_MOVABLE;
        tahr_world *world = box2d_open(engines[e], &body, 1, &log);
        tahr_body_pose pose = {0, 0, {{100, 0, 0}, {0, 0, H, H}}}, tilted = {0, 0, {{0, 0, 0}, {H, 0, 0, H}}};
        assert_int_equal(tahr_world_set(world, &pose, 1), TAHR_OK);
        tahr_sweep q = sweep_of(TAHR_SHAPE_SPHERE, 95, 3, 10, 0, 0);
        assert_int_equal(ask(world, &q, &hit, 1), 1);
        assert_near(10 * hit.fraction, 5 - 0.25 - 0.35, 2e-9);
        assert_int_equal(tahr_world_set(world, &tilted, 1), TAHR_E_ARGUMENT);
        assert_non_null(strstr(log.text, "pose.orientation"));
        assert_int_equal(ask(world, &q, &hit, 1), 1);
        pose.pose.position.x = 3e6; /* as far as Box2D's own trees never reach */
        assert_int_equal(tahr_world_set(world, &pose, 1), TAHR_OK);
        assert_int_equal(ask(world, &q, &hit, 1), 0);
        q.position.x = 3e6 - 5;
        assert_int_equal(ask(world, &q, &hit, 1), 1);
        assert_near(10 * hit.fraction, 5 - 0.25 - 0.35, 2e-9);
        tahr_world_close(world);
    }
}

/* Half a character in water, wherever z is. */
static void fluids_fill_the_plane(void **unused)
{
    (void)unused;
    for (int e = 0; e < engine_count; e++) {
        fake_log log = {0};
        tahr_body_desc body = box2d_box(0, -1, 5, 1);
        tahr_fluid fluid;
        body.flags = TAHR_BODY_FLUID;
        body.pose.position.z = 50;
        tahr_world *world = box2d_open(engines[e], &body, 1, &log);
        tahr_fluid_query q = {{0, 0, 7}, {0, 1, 0}, 0.35, 0.9, 0xFFFFFFFFu, 0};
        assert_int_equal(tahr_world_fluid(world, &q, &fluid), TAHR_OK);
        assert_int_equal(fluid.body, 0);
        assert_near(fluid.immersion, 0.5, 1e-12);
        tahr_world_close(world);
    }
}

static void what_is_out_of_the_plane_is_refused(void **unused)
{
    (void)unused;
    for (int e = 0; e < engine_count; e++) {
        tahr_box2d_desc options = {.struct_size = sizeof options, .engine = engines[e]};
        fake_log log = {0};
        const tahr_log messages = fake_log_of(&log);
        tahr_body_desc body = box2d_box(0, 0, 1, 1);
        tahr_world_desc desc;
        tahr_world *world = NULL;
        tahr_hit hit;
        uint32_t count;
        tahr_world_desc_init(&desc, sizeof desc);
        desc.bodies = &body;
        desc.body_count = 1;
        desc.options = &options;
        desc.log = &messages;
        body.pose.orientation = (tahr_quat){H, 0, 0, H};
        assert_int_equal(tahr_world_open(tahr_backend_v1_box2d(), &desc, &world), TAHR_E_UNSUPPORTED);
        assert_non_null(strstr(log.text, "bodies[0].pose.orientation"));
        tahr_body_desc_init(&body, sizeof body, TAHR_BODY_CAPSULE);
        body.radius = 0.5;
        body.half_height = 1;
        assert_int_equal(tahr_world_open(tahr_backend_v1_box2d(), &desc, &world), TAHR_E_UNSUPPORTED);
        assert_non_null(strstr(log.text, "capsule"));
        body.half_height = 0.5; /* a ball has no axis */
        assert_int_equal(tahr_world_open(tahr_backend_v1_box2d(), &desc, &world), TAHR_OK);
        tahr_sweep q = sweep_of(TAHR_SHAPE_CAPSULE, 5, 0, -3, 0, 0);
        q.motion.z = 0.5;
        assert_true(tahr_world_sweep(world, &q, &hit, 1, &count) < 0);
        q.motion.z = 0;
        q.up = (tahr_vec3){0, 0, 1};
        q.orientation = (tahr_quat){0, 0, 0, 1};
        assert_true(tahr_world_sweep(world, &q, &hit, 1, &count) < 0);
        q = sweep_of(TAHR_SHAPE_CAPSULE, NAN, 0, 1, 0, 0);
        assert_int_equal(tahr_world_sweep(world, &q, &hit, 1, &count), TAHR_E_ARGUMENT);
        tahr_world_close(world);
    }
}

/* Asked without the library: no number that is none reaches Box2D. */
static void numbers_that_are_none_are_refused_by_the_slots(void **unused)
{
    const tahr_backend *b = tahr_backend_v1_box2d();
    tahr_host host = {.struct_size = sizeof host, .abi = TAHR_ABI};
    fake_memory memory = {0};
    fake_log log = {0};
    (void)unused;
    host.allocator = fake_allocator(&memory);
    host.log = fake_log_of(&log);
    for (int e = 0; e < engine_count; e++) {
        tahr_box2d_desc options = {.struct_size = sizeof options, .engine = engines[e]};
        tahr_body_desc body = box2d_box(0, 0, 1, 1);
        tahr_world_desc desc;
        tahr_query_context context = {0};
        void *self = NULL;
        tahr_world_desc_init(&desc, sizeof desc);
        desc.bodies = &body;
        desc.body_count = 1;
        desc.options = &options;
        uint64_t before = memory.requests;
        assert_int_equal(b->open(&host, &desc, &self), TAHR_OK);
        uint64_t asked = memory.requests;
        for (int i = 0; i < 6; i++) {
            tahr_sweep q = sweep_of(TAHR_SHAPE_BOX, 0, 3, 0, -2, 0.01);
            double *fields[] = {&q.position.x, &q.motion.y, &q.margin, &q.shape.half_height, &q.shape.half_x, &q.up.y};
            tahr_hit hits[2];
            uint32_t count = 0;
            *fields[i] = i % 2 ? NAN : INFINITY;
            assert_true(b->sweep(self, &context, &q, hits, 2, &count) < 0);
            assert_int_equal(count, 0);
        }
        assert_int_equal(memory.requests, asked);
        b->close(self);
        assert_int_equal(memory.live_blocks, 0);
        for (uint64_t n = asked - before; n > 0; n--) { /* without memory nothing is kept */
            memory.fail_at = memory.requests + n;
            assert_int_equal(b->open(&host, &desc, &self), TAHR_E_MEMORY);
            assert_int_equal(memory.live_blocks, 0);
        }
        memory.fail_at = 0;
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parallel_and_parting_motion_is_free_at_every_gap),
        cmocka_unit_test(grazing_motion_stops_where_the_gap_is_the_margin),
        cmocka_unit_test(corners_are_round_for_round_shapes),
        cmocka_unit_test(an_overlap_at_the_start_says_the_shortest_way_out),
        cmocka_unit_test(tiles_are_left_upward_only),
        cmocka_unit_test(a_chain_has_its_front_on_the_right_hand),
        cmocka_unit_test(answers_come_in_order),
        cmocka_unit_test(one_way_bodies_are_stood_on_and_passed),
        cmocka_unit_test(rays_meet_what_is_first),
        cmocka_unit_test(placed_bodies_are_where_they_were_placed),
        cmocka_unit_test(fluids_fill_the_plane),
        cmocka_unit_test(what_is_out_of_the_plane_is_refused),
        cmocka_unit_test(numbers_that_are_none_are_refused_by_the_slots),
    };
    engine_count = box2d_engines(engines);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
#endif
