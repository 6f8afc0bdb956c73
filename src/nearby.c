/* SPDX-License-Identifier: MIT
 * nearby.c: see nearby.h. */
#include "nearby.h"

#include "query.h"

static double size_of(double x)
{
    return max_of(x, -x);
}

void tahr__announce_near(tahr__step *step, vec3 from, vec3 way)
{
    const tahr__limits *l = step->limits;
    vec3 up = step->state.up, away = vec(size_of(up.x), size_of(up.y), size_of(up.z));
    double around = l->around + l->beside, rise = step->config->step_height;
    vec3 half = add_scaled(vec(around, around, around), away, l->axis + 0.5 * (rise + l->below));
    vec3 a = add_scaled(from, up, 0.5 * (rise - l->below)), b = add(a, way);
    vec3 low = vec(min_of(a.x, b.x), min_of(a.y, b.y), min_of(a.z, b.z));
    vec3 high = vec(max_of(a.x, b.x), max_of(a.y, b.y), max_of(a.z, b.z));
    /* Of one step all is asked from one place: what is asked again is answered again, bit for bit. */
    tahr_prepare p = {
        .bounds = {sub(low, half), add(high, half)}, .position = step->announced, .up = up, .mask = step->config->mask};
    tahr__announce(step, &p);
}
