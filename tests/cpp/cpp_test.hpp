/* SPDX-License-Identifier: MIT
 * cpp_test.hpp: what the tests of the C++ headers share: cmocka, a plane as an engine, a floor as a scene. */
#ifndef TAHR_CPP_TEST_HPP
#define TAHR_CPP_TEST_HPP

/* Before cmocka, which has macros of names that the standard library uses. */
#include <array>
#include <cmath>
#include <memory>
#include <new>
#include <string>
#include <thread>
#include <vector>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

extern "C" {
#include <cmocka.h>
}

#include <tahr/native.h>
#include <tahr/tahr.hpp>

constexpr double DT = 1.0 / 60;

/* The plane z = 0. */
inline void meet_plane(const tahr_sweep &q, tahr_hit &hit)
{
    double gap = q.position.z - q.shape.half_height - q.margin, drop = -q.motion.z;
    hit.normal = hit.surface_normal = {0, 0, 1};
    if (gap < -q.margin) {
        hit.start_overlap = 1;
        hit.depth = -gap - q.margin;
    } else if (drop > 0 && gap <= drop) {
        hit.blocking = 1;
        hit.fraction = gap > 0 ? gap / drop : 0;
    }
}

inline tahr_status meet_plane_c(void *, const tahr_sweep *query, tahr_hit *hit)
{
    meet_plane(*query, *hit);
    return TAHR_OK;
}

inline tahr_config precise()
{
    return tahr::make_config().value();
}

inline tahr_state standing(double x = 0, double y = 0)
{
    return tahr::make_state(precise(), {x, y, 0.92}).value();
}

inline tahr_input wish(double x, double y)
{
    tahr_input input = tahr::make_input();
    input.move = {x, y, 0};
    return input;
}

inline tahr_sweep fall_from(double height)
{
    tahr_sweep q{};
    q.shape = {TAHR_SHAPE_SPHERE, 0, 0.5, 0.5, 0, 0};
    q.position = {0, 0, height};
    q.up = {0, 0, 1};
    q.orientation = {0, 0, 0, 1};
    q.motion = {0, 0, -2 * height};
    q.mask = 0xFFFFFFFFu;
    q.ignore_body = TAHR_NO_BODY;
    return q;
}

/* A floor whose top is z = 0, on native. */
inline tahr::world open_floor()
{
    const tahr_body_desc bodies[] = {tahr::box_body({50, 50, 1}, {0, 0, -1})};
    return tahr::world::open(tahr_backend_v1_native(), bodies).value();
}

/* A walk with a jump in it, hashed after every step. */
inline uint64_t walk(tahr_mover *mover)
{
    tahr_state state = standing();
    uint64_t hash = 0;
    for (int i = 0; i < 120; i++) {
        tahr_input input = wish(i < 80 ? 1 : 0, 0.3);
        input.jump = i == 30;
        assert_int_equal(tahr_mover_step(mover, &input, DT, &state, nullptr), TAHR_OK);
        hash = hash * 31 + tahr_state_hash(&state);
    }
    return hash;
}

inline uint64_t walk(tahr::mover &mover)
{
    tahr_state state = standing();
    uint64_t hash = 0;
    for (int i = 0; i < 120; i++) {
        tahr_input input = wish(i < 80 ? 1 : 0, 0.3);
        input.jump = i == 30;
        assert_int_equal(mover.step(input, DT, state).code(), TAHR_OK);
        hash = hash * 31 + tahr::hash(state);
    }
    return hash;
}

inline void assert_near(double value, double expected, double error)
{
    if (!(std::fabs(value - expected) <= error)) fail_msg("%.17g is not within %g of %.17g", value, error, expected);
}

inline void assert_says(tahr::status s, tahr_status code, const char *text)
{
    assert_int_equal(s.code(), code);
    if (!strstr(s.message(), text)) fail_msg("the message is '%s', expected '%s' in it", s.message(), text);
}

/* Counts what is alive of it. */
struct counted {
    int *alive;
    explicit counted(int &count) : alive(&count)
    {
        ++*alive;
    }
    counted(counted &&other) noexcept : alive(other.alive)
    {
        ++*alive;
    }
    counted(const counted &) = delete;
    counted &operator=(const counted &) = delete;
    ~counted()
    {
        --*alive;
    }
};

#endif
