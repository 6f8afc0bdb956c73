/* SPDX-License-Identifier: MIT
 * arc.c: the way of a fall between contacts, and where it meets a plane. */
#include "arc.h"

#include "falling.h"
#include "launch.h"
#include "slide.h"
#include "stepped.h"

/* Air control is not limited by what rises less: a push along an upright wall lifts nobody
 * (VERTICAL_SLOPE_NORMAL_Z). */
static const double UPRIGHT = 0.001;

/* Less than this part of a push along a face is the rounding of one straight into it. */
static const double ALONG = 1e-9;

/* The drive is the velocity, and gravity acts where the drive leaves falling alone. */
static void drive_arc(const tahr__step *step, tahr__arc *a)
{
    vec3 drive = drive_of(step);
    double rise = dot(drive, a->axis);
    a->level = add_scaled(drive, a->axis, -rise);
    a->law = drive_law(a->level);
    if (!(step->input->flags & TAHR_INPUT_DRIVE_LEVEL)) {
        a->rise = rise;
        a->gravity = a->hold = 0;
        a->terminal = max_of(a->terminal, -rise);
    }
}

/* LimitAirControl: of a push into a face that rises only what goes along it is left. The rest would carry the character
 * up, or hold it there against gravity. */
static void limit_control(const tahr__plane *planes, uint32_t plane_count, vec3 axis, tahr__law *law)
{
    tahr__plane walls[TAHR__MAX_PLANES];
    uint32_t count = 0;
    for (uint32_t i = 0; i < plane_count; i++) {
        double rise = dot(planes[i].normal, axis);
        vec3 level = add_scaled(planes[i].normal, axis, -rise);
        if (rise > UPRIGHT && length_squared(level) > 1e-12) {
            walls[count] = planes[i];
            walls[count++].normal = unit(level);
        }
    }
    if (count > 0) {
        vec3 along = tahr__bend(walls, count, law->wish);
        double part = length(along);
        law->wish = part > ALONG ? scale(along, 1.0 / part) : vec(0, 0, 0);
        law->acceleration *= part;
    }
}

/* An arc is asked at many times: what they have in common. */
static void prepare_law(tahr__arc *a)
{
    const double most = a->law.speed;
    a->wishes = law_wishes(&a->law);
    a->along = dot(a->level, a->law.wish);
    a->across = add_scaled(a->level, a->law.wish, -a->along);
    a->turns =
        a->wishes && !law_brakes(&a->law, a->level) && !(length_squared(a->across) <= TAHR__STRAIGHT * most * most);
}

tahr__arc tahr__arc_of(const tahr__step *step, const tahr__plane *planes, uint32_t count)
{
    const tahr_config *c = step->config;
    tahr__arc a = {.gravity = step->pull->size, .terminal = c->terminal_speed};
    a.axis = a.gravity > 1e-6 ? step->pull->up : step->state.up;
    if (vec_equal(a.axis, step->state.up) || dot(a.axis, step->state.up) > 1 - 1e-15) {
        a.axis = step->state.up;
    }
    a.law = tahr__arc_law(c, reject(step->input->move, a.axis));
    limit_control(planes, count, a.axis, &a.law);
    if (c->integrator == TAHR_INTEGRATOR_STEPPED) { /* the slice began with its velocity across up */
        a.law = tahr__constant_law();
    }
    a.rise = dot(step->state.velocity, a.axis);
    a.level = add_scaled(step->state.velocity, a.axis, -a.rise);
    int holds = (step->state.flags & TAHR_STATE_JUMPING) && step->input->jump && !c->jump_hold_gravity;
    a.hold = holds ? step->state.jump_hold : 0;
    a.drifts = is_drifting(step);
    if (a.drifts) {
        a.drift = drive_of(step);
    }
    if (is_driven(step)) {
        drive_arc(step, &a);
    }
    prepare_law(&a);
    return a;
}

vec3 tahr__arc_at(const tahr__arc *a, double t, vec3 *velocity)
{
    double v;
    double rise = a->hold > 0 ? tahr__fall_advance(a->rise, a->gravity, a->terminal, a->hold, t, &v)
                              : fall_for(a->rise, a->gravity, a->terminal, t, &v);
    tahr__motion m =
        a->turns ? tahr__law_turn(&a->law, a->across, a->along, t) : law_advance(&a->law, a->wishes, a->level, t);
    *velocity = add_scaled(m.velocity, a->axis, v);
    vec3 way = add_scaled(m.displacement, a->axis, rise);
    return a->drifts ? add_scaled(way, a->drift, t) : way;
}

static tahr__arc_point read_arc(const tahr__arc *a, double t)
{
    tahr__arc_point r = {.t = t};
    r.way = tahr__arc_at(a, t, &r.velocity);
    return r;
}

enum { MEETING_ROUNDS = 24 };

/* Its end is rounding, which may go back and forth between two times for good. */
tahr__arc_point tahr__arc_meet(const tahr__arc *a, vec3 normal, vec3 touch, double t)
{
    double low = 0, high = t, s = 0.5 * t, goal = dot(normal, touch);
    tahr__arc_point last[2] = {{.t = -1}, {.t = -1}};
    int again = 0;
    for (int i = 0; i < MEETING_ROUNDS; i++) {
        tahr__arc_point *r = &last[i & 1];
        again = r->t == s ? again + 1 : 0;
        if (!again) {
            *r = read_arc(a, s);
        }
        double value = dot(normal, r->way) - goal;
        double slope = dot(normal, a->drifts ? add(r->velocity, a->drift) : r->velocity);
        *(value > 0 ? &low : &high) = s;
        double next = slope < 0 ? s - value / slope : 0.5 * (low + high);
        next = next >= low && next <= high ? next : 0.5 * (low + high);
        if (next == s) {
            return *r;
        }
        if (again > 1 && next == last[(i + 1) & 1].t) { /* so it would end */
            return last[MEETING_ROUNDS & 1];
        }
        s = next;
    }
    return read_arc(a, s);
}

vec3 tahr__arc_place(const void *self, double t)
{
    vec3 v;
    return tahr__arc_at(self, t, &v);
}
