/* SPDX-License-Identifier: MIT
 * fuzz_route.c: the shell's route files: any bytes are refused with a message, or are inputs that a step accepts. */
#include "../bindings/cli/route.h"
#include "scratch.h"
#include "target.h"

#include <math.h>
#include <string.h>

/* What it gave to do. */
static void check_input(const tahr_input *input)
{
    double size_of_move = fabs(input->move.x) + fabs(input->move.y) + fabs(input->move.z);
    FUZZ_CHECK(size_of_move <= 3e7, "move of %g", size_of_move);
    FUZZ_CHECK(isfinite(input->launch.x + input->launch.y + input->launch.z), "launch");
    FUZZ_CHECK(isfinite(input->facing.x + input->facing.y + input->facing.z), "facing");
}

/* The character goes to and fro, so that entries which wait for a place begin too. */
static void follow(struct route *route)
{
    size_t begun = 0;
    for (int i = 0; i < 200; i++) {
        tahr_input input = {.struct_size = sizeof input};
        tahr_vec3 place = {(i % 50 - 25) * 1.0, (i % 20 - 10) * 1.0, 0.0};
        begun += (size_t)route_input(route, i / 20.0, place, &input);
        FUZZ_CHECK(route->next <= route->count && begun <= route->count, "entry %u of %u", (unsigned)route->next,
                   (unsigned)route->count);
        check_input(&input);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const char *path = scratch_file(data, size, "json");
    for (int planar = 0; planar < 2; planar++) {
        struct route route;
        memset(&route, 0, sizeof route);
        scratch_quiet();
        int status = route_load(&route, path, planar);
        scratch_loud();
        if (status < 0) continue;
        follow(&route);
        FUZZ_CHECK(!route.has_start || isfinite(route.start.x + route.start.y + route.start.z), "start");
        route_close(&route);
    }
    return 0;
}
