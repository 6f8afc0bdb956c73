/* SPDX-License-Identifier: MIT
 * steps.cpp: the same loops of steps in C and in C++, for a tool that counts instructions (cost.sh). asleep: on a
 * floor, so that a step is as little as it can be and what a wrapper adds shows. walk: over an engine of the user's,
 * which each step asks, so that what carries the questions shows. Usage: steps c|cpp asleep|walk STEPS */
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <tahr/native.h>
#include <tahr/tahr.hpp>

namespace
{

/* The plane z = 0. */
inline void meet_plane(const tahr_sweep &q, tahr_hit &hit)
{
    double gap = q.position.z - q.shape.half_height - q.margin, drop = -q.motion.z;
    hit.normal = hit.surface_normal = {0, 0, 1};
    hit.blocking = drop > 0 && gap <= drop;
    hit.fraction = hit.blocking && gap > 0 ? gap / drop : 0;
}

tahr_status meet_plane_c(void *, const tahr_sweep *query, tahr_hit *hit)
{
    meet_plane(*query, *hit);
    return TAHR_OK;
}

int steps_c(tahr_mover *mover, const tahr_input *input, tahr_state *state, int steps)
{
    int failed = 0;
    for (int i = 0; i < steps; i++) {
        if (tahr_mover_step(mover, input, 1.0 / 60, state, nullptr) < 0) failed++;
    }
    return failed;
}

int steps_cpp(tahr::mover &mover, const tahr_input &input, tahr_state &state, int steps)
{
    int failed = 0;
    for (int i = 0; i < steps; i++) {
        if (!mover.step(input, 1.0 / 60, state)) failed++;
    }
    return failed;
}

int run_c(const tahr_backend *backend, const tahr_world_desc &floor, const tahr_input &input, tahr_state &state,
          int steps)
{
    tahr_callbacks callbacks = {sizeof callbacks, 0,       nullptr, meet_plane_c, nullptr,
                                nullptr,          nullptr, nullptr, nullptr};
    const tahr_config config = tahr::make_config().value();
    tahr_world *world = nullptr;
    tahr_mover *mover = nullptr;
    if ((backend ? tahr_world_open(backend, &floor, &world) : tahr_world_open_callbacks(&callbacks, nullptr, &world)) <
            0 ||
        tahr_mover_create(world, &config, &mover) < 0) {
        return 1;
    }
    int failed = steps_c(mover, &input, &state, steps);
    tahr_mover_destroy(mover);
    tahr_world_close(world);
    return failed;
}

int run_cpp(const tahr_backend *backend, const tahr_world_desc &floor, const tahr_input &input, tahr_state &state,
            int steps)
{
    tahr::world world =
        (backend ? tahr::world::open(backend, floor) : tahr::world::open([](const tahr_sweep &q, tahr_hit &hit) {
            meet_plane(q, hit);
        })).value();
    tahr::mover mover = tahr::mover::create(world, tahr::make_config().value()).value();
    return steps_cpp(mover, input, state, steps);
}

} // namespace

int main(int argc, char **argv)
{
    const int steps = argc == 4 ? atoi(argv[3]) : 0;
    if (steps <= 0) {
        fprintf(stderr, "usage: steps c|cpp asleep|walk STEPS\n");
        return 2;
    }
    const tahr_body_desc box = tahr::box_body({50, 50, 1}, {0, 0, -1});
    tahr_world_desc floor = tahr::make_world_desc();
    floor.bodies = &box;
    floor.body_count = 1;
    tahr_state state = tahr::make_state(tahr::make_config().value(), {0, 0, 0.92}).value();
    tahr_input input = tahr::make_input();
    const bool walk = strcmp(argv[2], "walk") == 0;
    input.move.x = walk ? 1 : 0;
    const tahr_backend *backend = walk ? nullptr : tahr_backend_v1_native();
    int failed = strcmp(argv[1], "c") == 0 ? run_c(backend, floor, input, state, steps)
                                           : run_cpp(backend, floor, input, state, steps);
    printf("%s at %.3f\n", tahr_mode_name(state.mode), state.position.x);
    return failed ? 1 : 0;
}
