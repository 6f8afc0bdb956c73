/* SPDX-License-Identifier: MIT
 * bodies.hpp: the bodies of a scene. Each is a tahr_body_desc with what makes its shape set; flags, mask, surface and
 * all else are fields of it. Metres, in the body's own frame unless it says world. */
#ifndef TAHR_BODIES_HPP
#define TAHR_BODIES_HPP

#include <tahr/world.h>

#include "view.hpp"

namespace tahr
{
inline namespace TAHR_CPP_KIND
{

/* A body of a kind (TAHR_BODY_MESH, ...), its position in the world; nothing else is set. */
inline tahr_body_desc make_body(std::uint32_t type, const tahr_vec3 &position = {0, 0, 0}) noexcept
{
    tahr_body_desc body{};
    body.struct_size = sizeof body;
    body.type = type;
    body.mask = 0xFFFFFFFFu;
    body.pose = {position, {0, 0, 0, 1}};
    return body;
}

inline tahr_body_desc box_body(const tahr_vec3 &half_extents, const tahr_vec3 &position = {0, 0, 0}) noexcept
{
    tahr_body_desc body = make_body(TAHR_BODY_BOX, position);
    body.half_extents = half_extents;
    return body;
}

inline tahr_body_desc ellipsoid_body(const tahr_vec3 &semi_axes, const tahr_vec3 &position = {0, 0, 0}) noexcept
{
    tahr_body_desc body = make_body(TAHR_BODY_ELLIPSOID, position);
    body.half_extents = semi_axes;
    return body;
}

inline tahr_body_desc sphere_body(double radius, const tahr_vec3 &position = {0, 0, 0}) noexcept
{
    tahr_body_desc body = make_body(TAHR_BODY_SPHERE, position);
    body.radius = radius;
    return body;
}

/* type: TAHR_BODY_CAPSULE (half_height with the caps in it), _CYLINDER or _CONE. */
inline tahr_body_desc round_body(std::uint32_t type, double radius, double half_height,
                                 const tahr_vec3 &position = {0, 0, 0}) noexcept
{
    tahr_body_desc body = make_body(type, position);
    body.radius = radius;
    body.half_height = half_height;
    return body;
}

namespace detail
{

inline view<const double> numbers_of(view<const double> numbers) noexcept
{
    return numbers;
}

inline view<const double> numbers_of(view<const tahr_vec3> points) noexcept
{
    static_assert(sizeof(tahr_vec3) == 3 * sizeof(double));
    return {points.empty() ? nullptr : &points.data()->x, 3 * points.size()};
}

/* A body points to its arrays until its world is open: a container that dies before is refused. */
template <class Container> constexpr bool stays() noexcept
{
    return std::is_lvalue_reference_v<Container> || std::is_trivially_destructible_v<std::decay_t<Container>>;
}

/* [out] count: of groups of three. */
inline status triples(const char *function, const char *what, std::size_t size, std::uint32_t &count) noexcept
{
    if (size % 3 != 0 || size / 3 > 0xFFFFFFFFu) {
        return complain(TAHR_E_ARGUMENT, "%s: %s has %zu numbers, expected 3 each of at most %u", function, what, size,
                        0xFFFFFFFFu);
    }
    count = static_cast<std::uint32_t>(size / 3);
    return TAHR_OK;
}

inline result<tahr_body_desc> vertex_body(const char *function, std::uint32_t type,
                                          view<const double> vertices) noexcept
{
    tahr_body_desc body = make_body(type);
    status s = triples(function, "vertices", vertices.size(), body.vertex_count);
    if (!s) return s;
    body.vertices = vertices.data();
    return {s, body};
}

} // namespace detail

/* Vertices are containers of double, 3 each, or of tahr_vec3; indices of uint32_t, 3 a triangle. All are read when the
 * world is opened, and have to be there until then. TAHR_E_ARGUMENT where there are no threes. */
template <class Vertices, class Indices>
result<tahr_body_desc> mesh_body(Vertices &&vertices, Indices &&indices) noexcept
{
    static_assert(detail::stays<Vertices>() && detail::stays<Indices>(), "the body would point into what is gone");
    const view<const std::uint32_t> corners(indices);
    result<tahr_body_desc> body = detail::vertex_body("tahr::mesh_body", TAHR_BODY_MESH, detail::numbers_of(vertices));
    if (!body) return body;
    status s = detail::triples("tahr::mesh_body", "indices", corners.size(), body->triangle_count);
    if (!s) return s;
    body->indices = corners.data();
    return body;
}

template <class Vertices> result<tahr_body_desc> hull_body(Vertices &&vertices) noexcept
{
    static_assert(detail::stays<Vertices>(), "the body would point into what is gone");
    return detail::vertex_body("tahr::hull_body", TAHR_BODY_HULL, detail::numbers_of(vertices));
}

template <class Vertices> result<tahr_body_desc> chain_body(Vertices &&vertices) noexcept
{
    static_assert(detail::stays<Vertices>(), "the body would point into what is gone");
    return detail::vertex_body("tahr::chain_body", TAHR_BODY_CHAIN, detail::numbers_of(vertices));
}

/* heights: rows of so many columns, doubles; half the size of the field along x and y. TAHR_E_ARGUMENT where the last
 * row is not whole. */
template <class Heights>
result<tahr_body_desc> heights_body(Heights &&heights, std::uint32_t columns, double half_x, double half_y) noexcept
{
    static_assert(detail::stays<Heights>(), "the body would point into what is gone");
    const view<const double> all(heights);
    tahr_body_desc body = make_body(TAHR_BODY_HEIGHTS);
    if (columns == 0 || all.size() % columns != 0 || all.size() / columns > 0xFFFFFFFFu) {
        return detail::complain(TAHR_E_ARGUMENT, "tahr::heights_body: heights has %zu numbers, expected rows of %u",
                                all.size(), columns);
    }
    body.heights = all.data();
    body.columns = columns;
    body.rows = static_cast<std::uint32_t>(all.size() / columns);
    body.half_extents = {half_x, half_y, 0};
    return {TAHR_OK, body};
}

} // namespace TAHR_CPP_KIND
} // namespace tahr
#endif
