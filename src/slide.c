/* SPDX-License-Identifier: MIT
 * slide.c: bending a motion along everything that was touched.
 *
 * The set of planes grows by what sweeps run into and by nothing else. Asking for the contacts around would bring the
 * tilted planes of edges that are near but not in the way, which as planes block what the edges themselves let pass. */
#include "slide.h"

#include "plane.h"

vec3 tahr__bend(const tahr__plane *planes, uint32_t count, vec3 motion)
{
    vec3 x, off = vec(0, 0, 0);
    tahr__project(planes, count, motion, &x);
    double size = length(motion);
    if (length_squared(x) < 1e-12 * size * size) { /* a millionth of the wish is rounding in a corner, not a way out */
        return vec(0, 0, 0);
    }
    for (uint32_t i = 0; i < count; i++) {
        if (dot(planes[i].normal, x) < 1e-10 * size) {
            off = add(off, planes[i].normal);
        }
    }
    return add_scaled(x, off, 1e-10 * size);
}

tahr__plane tahr__plane_of(const tahr__step *step, const tahr_hit *hit)
{
    tahr__plane plane = {
        .normal = hit->normal, .anchor = step->state.position, .body = hit->body, .feature = hit->feature};
    if (is_in_plane(step)) {
        tahr__plane_surface(step, &plane.normal, &plane.offset);
    }
    return plane;
}

void tahr__planes_forget(const tahr__step *step, tahr__plane *planes, uint32_t *count)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < *count; i++) {
        if (dot(planes[i].normal, sub(step->state.position, planes[i].anchor)) <= step->config->skin) {
            planes[kept++] = planes[i];
        }
    }
    *count = kept;
}

int tahr__level_wall(const tahr__step *step, vec3 floor_normal, tahr__plane *wall)
{
    vec3 up = step->state.up;
    double rise = dot(wall->normal, up);
    vec3 level = add_scaled(reject(wall->normal, up), reject(floor_normal, up), -rise / dot(floor_normal, up));
    if (length_squared(level) < 1e-12) {
        return 0;
    }
    wall->normal = unit(level);
    return 1;
}
