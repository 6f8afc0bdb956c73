/* SPDX-License-Identifier: MIT
 * slide.c: bending a motion along everything that was touched.
 *
 * The set of planes grows by what sweeps run into and by nothing else. Asking for the contacts around would bring the
 * tilted planes of edges that are near but not in the way, which as planes block what the edges themselves let pass. */
#include "slide.h"

#include "plane.h"

/* Parts of a motion: what it is lifted off a plane by; and what it has to leave it by at the least: five times what a
 * backend takes for parallel (1e-12), so that no sweep meets again what the motion was bent along. */
static const double LIFT = 1e-10, LEAST_LIFT = 5e-12;

/* By how much x leaves the plane that it leaves least; < 0: it approaches one. */
static double least_lift(const tahr__plane *planes, uint32_t count, vec3 x)
{
    double least = INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        least = min_of(least, dot(planes[i].normal, x));
    }
    return least;
}

/* The normals of faces that face each other cancel out: their sum leaves neither. What does is the nearest point a lift
 * away from all planes. Where planes leave but a line there is none, and on the line it must stay. */
static vec3 lift_between(const tahr__plane *planes, uint32_t count, vec3 x, double lift)
{
    tahr__plane lifted[TAHR__MAX_PLANES];
    vec3 y;
    for (uint32_t i = 0; i < count; i++) {
        lifted[i].normal = planes[i].normal;
        lifted[i].offset = lift;
    }
    return tahr__project(lifted, count, x, &y) ? y : x;
}

/* A millionth of the wish is rounding in a corner, not a way out. */
static int is_rounding(vec3 x, double size)
{
    return length_squared(x) < 1e-12 * size * size;
}

/* Along one plane, which is what most motions are bent along: the same operations, and so the same bits, without the
 * loops and the lists. */
static vec3 bend_once(const tahr__plane *plane, vec3 motion)
{
    const vec3 n = plane->normal;
    const double into = dot(n, motion), size = length(motion);
    const vec3 x = into < plane->offset ? add_scaled(motion, n, plane->offset - into) : motion;
    if (is_rounding(x, size)) {
        return vec(0, 0, 0);
    }
    const vec3 off = dot(n, x) < LIFT * size ? n : vec(0, 0, 0);
    const vec3 lifted = add_scaled(x, add(vec(0, 0, 0), off), LIFT * size);
    return dot(n, lifted) >= LEAST_LIFT * size ? lifted : lift_between(plane, 1, x, LIFT * size);
}

vec3 tahr__bend(const tahr__plane *planes, uint32_t count, vec3 motion)
{
    vec3 x, off = vec(0, 0, 0);
    if (count == 1) {
        return bend_once(planes, motion);
    }
    tahr__project(planes, count, motion, &x);
    double size = length(motion);
    if (is_rounding(x, size)) {
        return vec(0, 0, 0);
    }
    for (uint32_t i = 0; i < count; i++) {
        if (dot(planes[i].normal, x) < LIFT * size) {
            off = add(off, planes[i].normal);
        }
    }
    vec3 lifted = add_scaled(x, off, LIFT * size);
    return least_lift(planes, count, lifted) >= LEAST_LIFT * size ? lifted
                                                                  : lift_between(planes, count, x, LIFT * size);
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
