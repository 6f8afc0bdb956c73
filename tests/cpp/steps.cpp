/* SPDX-License-Identifier: MIT
 * steps.cpp: the same loop of steps in C and in C++, for a tool that counts instructions (cost.sh). A character sleeps
 * on a floor, so that a step is as little as it can be and what a wrapper adds shows. Usage: steps c|cpp STEPS */
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <tahr/native.h>
#include <tahr/tahr.hpp>

static int steps_c(tahr_mover *mover, const tahr_input *input, tahr_state *state, int steps)
{
    int failed = 0;
    for (int i = 0; i < steps; i++) {
        if (tahr_mover_step(mover, input, 1.0 / 60, state, nullptr) < 0) failed++;
    }
    return failed;
}

static int steps_cpp(tahr::mover &mover, const tahr_input &input, tahr_state &state, int steps)
{
    int failed = 0;
    for (int i = 0; i < steps; i++) {
        if (!mover.step(input, 1.0 / 60, state)) failed++;
    }
    return failed;
}

int main(int argc, char **argv)
{
    const int steps = argc == 3 ? atoi(argv[2]) : 0;
    if (steps <= 0) {
        fprintf(stderr, "usage: steps c|cpp STEPS\n");
        return 2;
    }
    const tahr_body_desc floor[] = {tahr::box_body({50, 50, 1}, {0, 0, -1})};
    tahr::world world = tahr::world::open(tahr_backend_v1_native(), floor).value();
    const tahr_config config = tahr::make_config().value();
    tahr::mover mover = tahr::mover::create(world, config).value();
    tahr_state state = tahr::make_state(config, {0, 0, 0.92}).value();
    const tahr_input input = tahr::make_input();
    int failed = strcmp(argv[1], "c") == 0 ? steps_c(mover.handle(), &input, &state, steps)
                                           : steps_cpp(mover, input, state, steps);
    printf("%s\n", tahr_mode_name(state.mode));
    return failed ? 1 : 0;
}
