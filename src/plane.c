/* SPDX-License-Identifier: MIT
 * plane.c: motion held in one plane (config.plane), as in a side-scroller.
 *
 * Wishes, gravity, velocities and the normals of what is met are laid into the plane before anything is worked out from
 * them, so that every rule works in the plane; what is taken off at the end of a step is rounding. The plane is the one
 * that the character is in: a teleport moves it to another. */
#include "plane.h"

/* Shorter than this a normal laid into the plane is rounding and has no direction. */
static const double FACES_OUT = 1e-6;

/* Who overlaps what faces out of the plane more than this is not pushed away twenty times as far in the plane:
 * crushed. */
static const double PUSHES = 0.05;

int tahr__plane_surface(const tahr__step *step, vec3 *normal, double *offset)
{
    vec3 flat = along_plane(step->limits, *normal);
    double size = length(flat);
    if (size < (*offset > 0 ? PUSHES : FACES_OUT)) {
        *normal = vec(0, 0, 0); /* a half-space that forbids nothing */
        *offset = 0;
        return 0;
    }
    *normal = scale(flat, 1.0 / size);
    *offset /= size;
    return 1;
}

void tahr__plane_begin(tahr__step *step)
{
    const tahr__limits *l = step->limits;
    tahr_input *flat = &step->own_input;
    step->given = step->input;
    step->began = step->state.position;
    *flat = *step->input;
    flat->move = along_plane(l, flat->move);
    flat->launch = along_plane(l, flat->launch);
    flat->impulse = along_plane(l, flat->impulse);
    flat->drive = along_plane(l, flat->drive);
    step->input = flat;
    step->state.velocity = along_plane(l, step->state.velocity);
}

void tahr__plane_end(tahr__step *step)
{
    tahr_state *s = &step->state;
    const vec3 n = step->limits->plane;
    vec3 at = add_scaled(s->position, n, -dot(n, sub(s->position, step->began)));
    if (vec_equal(s->floor_position, s->position)) {
        s->floor_position = at;
    }
    s->position = at;
    s->velocity = along_plane(step->limits, s->velocity);
    step->input = step->given;
}
