/* SPDX-License-Identifier: MIT
 * fuzz_route.c: the shell's route files: any bytes are refused with a message, or are inputs that a step accepts. */
#include "../bindings/cli/route.h"
#include "scratch.h"
#include "target.h"

#include <math.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct route route;
    memset(&route, 0, sizeof route);
    const char *path = scratch_file(data, size, "json");
    scratch_quiet();
    int status = route_load(&route, path);
    scratch_loud();
    if (status == 0) {
        for (int i = 0; i < 200; i++) {
            tahr_input input = {.struct_size = sizeof input};
            route_input(&route, i / 20.0, &input);
            double size_of_move = fabs(input.move.x) + fabs(input.move.y) + fabs(input.move.z);
            FUZZ_CHECK(size_of_move <= 3e7 && isfinite(input.launch.x + input.launch.y + input.launch.z), "move of %g",
                       size_of_move);
        }
        FUZZ_CHECK(!route.has_start || isfinite(route.start.x + route.start.y + route.start.z), "start");
        route_close(&route);
    }
    return 0;
}
