/* SPDX-License-Identifier: MIT
 * one_way.c: the rule of one-way bodies, for users' own queries. It is written a second time in
 * backends/common/one_way.h: a plugin never links libtahr, the core never includes backends, and public headers have no
 * inline functions. A test asks both the same. */
#include <tahr/world.h>

#include "vec.h"

int32_t tahr_one_way_blocks(const tahr_vec3 *up, const tahr_vec3 *normal, double distance, double margin,
                            uint32_t flags)
{
    if (!up || !normal) {
        return 0;
    }
    if (flags & TAHR_SWEEP_WHOLE) {
        return 1;
    }
    int dropped = (flags & TAHR_SWEEP_PASS) || ((flags & TAHR_SWEEP_DROP) && distance <= 2 * margin);
    double rounding = max_of(1e-3 * margin, 2e-6); /* of who was put exactly onto it; without a margin that of floats */
    return distance >= -rounding && dot(*up, *normal) >= 0.5 && !dropped;
}
