/* SPDX-License-Identifier: MIT
 * dice.c: see dice.h. */
#include <math.h>

#include "dice.h"

tahr_vec3 dice_vec(oracle_random *random, double low, double high)
{
    tahr_vec3 v; /* one axis after the other: the arguments of one call have no order */
    v.x = oracle_uniform(random, low, high);
    v.y = oracle_uniform(random, low, high);
    v.z = oracle_uniform(random, low, high);
    return v;
}

tahr_vec3 dice_direction(oracle_random *random)
{
    for (;;) {
        tahr_vec3 v = dice_vec(random, -1, 1);
        double s = sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
        if (s > 0.1 && s < 1) {
            v.x /= s, v.y /= s, v.z /= s;
            return v;
        }
    }
}
