/* SPDX-License-Identifier: MIT
 * worlds.h: opening worlds and asking them, for the tests that speak to FCL themselves. */
#ifndef TAHR_TEST_WORLDS_H
#define TAHR_TEST_WORLDS_H

#include <cmath>
#include <csetjmp>
#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

extern "C" {
#include <cmocka.h>
}
#undef fail /* a member of streams */
#include <tahr/fcl.h>
#include <tahr/native.h>
#include <tahr/tahr.h>

/* The same numbers everywhere (splitmix64). */
struct Dice {
    uint64_t state;
    double uniform(double low, double high)
    {
        uint64_t z = state += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return low + (high - low) * static_cast<double>((z ^ (z >> 31)) >> 11) / 9007199254740992.0;
    }
    tahr_vec3 vec(double low, double high)
    {
        double x = uniform(low, high), y = uniform(low, high), z = uniform(low, high);
        return {x, y, z};
    }
    tahr_quat turn()
    {
        tahr_quat q = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(0.1, 1)};
        double n = 1 / std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
        return {q.x * n, q.y * n, q.z * n, q.w * n};
    }
};

/* Keeps the last message. */
struct Log {
    std::string text;
    static void write(void *user, int32_t, const char *message)
    {
        static_cast<Log *>(user)->text = message;
    }
};

static inline tahr_body_desc make_body(uint32_t type)
{
    tahr_body_desc body;
    assert_int_equal(tahr_body_desc_init(&body, sizeof body, type), TAHR_OK);
    return body;
}

static inline tahr_status try_open(const tahr_backend *backend, const std::vector<tahr_body_desc> &bodies,
                                   const void *options, Log *log, tahr_world **world)
{
    tahr_world_desc desc;
    tahr_log to = {log, Log::write};
    *world = nullptr;
    assert_int_equal(tahr_world_desc_init(&desc, sizeof desc), TAHR_OK);
    desc.bodies = bodies.data();
    desc.body_count = static_cast<uint32_t>(bodies.size());
    desc.options = options;
    desc.log = log ? &to : nullptr;
    return tahr_world_open(backend, &desc, world);
}

static inline tahr_world *open_fcl(const std::vector<tahr_body_desc> &bodies, const tahr_fcl_desc *options)
{
    tahr_world *world;
    Log log;
    tahr_status status = try_open(tahr_backend_v1_fcl(), bodies, options, &log, &world);
    if (status != TAHR_OK) print_message("    %s\n", log.text.c_str());
    assert_int_equal(status, TAHR_OK);
    return world;
}

static inline tahr_world *open_native(const std::vector<tahr_body_desc> &bodies)
{
    tahr_world *world;
    assert_int_equal(try_open(tahr_backend_v1_native(), bodies, nullptr, nullptr, &world), TAHR_OK);
    return world;
}

static inline tahr_shape round_shape(double radius, double half_height)
{
    tahr_shape shape = {};
    shape.type = half_height > radius ? TAHR_SHAPE_CAPSULE : TAHR_SHAPE_SPHERE;
    shape.radius = radius;
    shape.half_height = half_height;
    return shape;
}

static inline tahr_sweep make_sweep(const tahr_shape &shape, tahr_vec3 at, tahr_vec3 motion)
{
    tahr_sweep q = {};
    q.shape = shape;
    q.position = at;
    q.up.z = q.orientation.w = 1;
    q.motion = motion;
    q.margin = 0.01;
    q.mask = 0xFFFFFFFFu;
    q.ignore_body = TAHR_NO_BODY;
    return q;
}

static inline tahr_contact_query make_contacts(const tahr_shape &shape, tahr_vec3 at, double margin)
{
    tahr_contact_query q = {};
    q.shape = shape;
    q.position = at;
    q.up.z = q.orientation.w = 1;
    q.margin = margin;
    q.mask = 0xFFFFFFFFu;
    q.ignore_body = TAHR_NO_BODY;
    return q;
}

static inline uint32_t sweep(tahr_world *world, const tahr_sweep &q, tahr_hit *hit)
{
    uint32_t count = 0;
    memset(hit, 0, sizeof *hit);
    assert_int_equal(tahr_world_sweep(world, &q, hit, 1, &count), TAHR_OK);
    return count;
}

/* The nearest contact, or a distance above the margin. */
static inline double nearest(tahr_world *world, const tahr_contact_query &q, tahr_contact *contact)
{
    tahr_contact contacts[64];
    uint32_t count = 0;
    assert_true(tahr_world_contacts(world, &q, contacts, 64, &count) >= 0);
    if (count > 0 && contact) *contact = contacts[0];
    return count > 0 ? contacts[0].distance : 1e300;
}

static inline double dot(tahr_vec3 a, tahr_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline double apart(tahr_vec3 a, tahr_vec3 b)
{
    tahr_vec3 d = {a.x - b.x, a.y - b.y, a.z - b.z};
    return std::sqrt(dot(d, d));
}

/* The same stop, judged by the gap: the time has no bound at a graze. */
static inline bool same_stop(const tahr_sweep &q, const tahr_hit &a, const tahr_hit &b)
{
    double along = std::fabs(a.fraction - b.fraction) * std::fabs(dot(q.motion, a.normal));
    if (a.start_overlap || b.start_overlap)
        return a.start_overlap && b.start_overlap && std::fabs(a.depth - b.depth) < 1e-8;
    return along < 1e-7 && std::fabs(a.fraction - b.fraction) < 1e-3 && apart(a.normal, b.normal) < 1e-4;
}

#endif
