/* SPDX-License-Identifier: MIT
 * turning.c: which way is up, and which way the character faces. */
#include "turning.h"

#include "elementary.h"
#include "plane.h"
#include "query.h"
#include "report.h"

/* Asked before the announcement: the cache still belongs to another step, perhaps of another character. */
static int overlaps(tahr__step *step)
{
    tahr_contact contact;
    void *cache = step->context.cache;
    step->context.cache = NULL;
    uint32_t touched = tahr__contacts(step, step->state.position, 0, &contact, 1);
    step->context.cache = cache;
    return touched > 0 && contact.distance < 0;
}

void tahr__right(tahr__step *step)
{
    tahr_state *s = &step->state;
    vec3 up = step->pull->up;
    tahr_state before = *s;
    vec3 foot = step_foot(step);
    tahr_quat turn = quat_between(s->up, up);
    s->orientation = quat_unit(quat_multiply(turn, s->orientation));
    s->up = up;
    s->position = add_scaled(foot, up, step->limits->shape.half_height);
    s->floor_revision = 0;
    if (s->mode == TAHR_MODE_WALKING && dot(before.up, up) > 0) { /* on round ground the speed stays, along it */
        s->velocity = rotate(turn, s->velocity);
    }
    if (overlaps(step)) { /* on a floor the foot has no room to turn by more than 15 degrees */
        s->position = before.position;
        if (overlaps(step)) {
            *s = before;
            step->report.flags |= TAHR_REPORT_UP_REFUSED;
        }
    }
}

/* Seen from the side there are two ways to face, and no box turns from one to the other through the third dimension:
 * at once. */
static void mirror(tahr__step *step)
{
    tahr_state *s = &step->state;
    vec3 goal = along_plane(step->limits, step_level(step, step->input->facing));
    vec3 forward = unit(step_level(step, rotate(s->orientation, vec(1, 0, 0))));
    double c = dot(forward, unit(goal));
    if (length_squared(goal) == 0 || length_squared(forward) == 0) {
        return;
    }
    if (c < -1 + 1e-12) {
        s->orientation = quat_multiply((tahr_quat){s->up.x, s->up.y, s->up.z, 0}, s->orientation);
    } else if (c < 1 - 1e-12) { /* put askew by its user */
        s->orientation = quat_multiply(quat_between(forward, unit(goal)), s->orientation);
    }
    s->orientation = quat_unit(s->orientation);
}

void tahr__face(tahr__step *step, double dt)
{
    if (is_flat(step)) {
        mirror(step);
    } else {
        tahr__turn_toward(step->input->facing, step->config->turn_rate * dt, &step->state);
    }
}

void tahr__turn_toward(vec3 facing, double most, tahr_state *s)
{
    vec3 goal = unit(reject(facing, s->up));
    vec3 forward = unit(reject(rotate(s->orientation, vec(1, 0, 0)), s->up));
    if (length_squared(goal) == 0 || length_squared(forward) == 0) {
        return;
    }
    double c = dot(forward, goal);
    double side = dot(cross(forward, goal), s->up);
    double sine, cosine;
    if (most >= 3.141592653589793) {
        most = 3.141592653589793;
    }
    tahr__sincos(most, &sine, &cosine);
    if (c < cosine) { /* farther than one step turns */
        double half_sine, half_cosine;
        tahr__sincos(0.5 * most, &half_sine, &half_cosine);
        half_sine = side < 0 ? -half_sine : half_sine;
        tahr_quat turn = {s->up.x * half_sine, s->up.y * half_sine, s->up.z * half_sine, half_cosine};
        s->orientation = quat_unit(quat_multiply(turn, s->orientation));
    } else if (side != 0 || c < 0) {
        tahr_quat turn = {s->up.x * side, s->up.y * side, s->up.z * side, 1 + c};
        s->orientation = quat_unit(quat_multiply(quat_unit(turn), s->orientation));
    }
}
