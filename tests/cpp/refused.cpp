/* SPDX-License-Identifier: MIT
 * refused.cpp: mistakes that a compiler has to find, one for each value of MISTAKE; none with 0 (refused.sh). */
#include <vector>

#include <tahr/tahr.hpp>

struct engine {
    void sweep(const tahr_sweep &, tahr_hit &)
    {
    }
#if MISTAKE == 1 /* answers would go to a copy of the hit, or nowhere */
    void ray(const tahr_ray &, tahr_hit *)
    {
    }
#endif
};

int main()
{
    tahr::world world = tahr::world::open(engine{}).value();
    const std::vector<uint32_t> corners = {0, 1, 2};
    const std::vector<double> vertices(9);
    tahr_body_desc body = tahr::mesh_body(vertices, corners).value();
    world.touch().value();
#if MISTAKE == 2 /* true would be TAHR_TRUNCATED */
    tahr::world other = tahr::world::open([](const tahr_sweep &, tahr_hit &) { return true; }).value();
#elif MISTAKE == 3 /* the vertices are gone before a world is opened */
    body = tahr::mesh_body(std::vector<double>(9), corners).value();
#elif MISTAKE == 4
    tahr::world copy = world;
#elif MISTAKE == 5
    world.touch();
#elif MISTAKE == 6 /* indices are unsigned 32 bits */
    body = tahr::mesh_body(vertices, std::vector<int>{0, 1, 2}).value();
#elif MISTAKE == 7
    tahr::world other = tahr::world::open(tahr::gathering([](const tahr_bounds &) {})).value();
#endif
    return static_cast<int>(body.vertex_count) - 3;
}
