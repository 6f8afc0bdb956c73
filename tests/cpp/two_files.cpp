/* SPDX-License-Identifier: MIT
 * two_files.cpp: one program of two files, this one compiled as ONE and as TWO; both use what the headers define. */
#include <tahr/tahr.hpp>

namespace
{

bool walks()
{
    auto plane = [](const tahr_sweep &q, tahr_hit &hit) {
        double gap = q.position.z - q.shape.half_height - q.margin;
        hit.normal = {0, 0, 1};
        hit.blocking = -q.motion.z > 0 && gap <= -q.motion.z;
        hit.fraction = hit.blocking && gap > 0 ? gap / -q.motion.z : 0;
    };
    tahr::world world = tahr::world::open(plane).value();
    const tahr_config config = tahr::make_config().value();
    tahr::mover mover = tahr::mover::create(world, config).value();
    tahr_state state = tahr::make_state(config, {0, 0, 1}).value();
    tahr_crowd_desc desc = tahr::make_crowd_desc();
    desc.capacity = desc.config_count = 1;
    desc.configs = &config;
    tahr::crowd crowd = tahr::crowd::create(world, desc).value();
    tahr_input input = tahr::make_input();
    input.move = {1, 0, 0};
    for (int i = 0; i < 60; i++) {
        if (!mover.step(input, 1.0 / 60, state)) return false;
    }
    double x = state.position.x;
    bool failed = !mover.step(input, -1, state);
    return failed && x > 1 && crowd.step(1.0 / 60, {&input, 1}, {&state, 1}).ok() && state.position.x > x;
}

} // namespace

#ifdef ONE
bool other_walks();

int main()
{
    return walks() && other_walks() ? 0 : 1;
}
#else
bool other_walks();

bool other_walks()
{
    return walks();
}
#endif
