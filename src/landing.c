/* SPDX-License-Identifier: MIT
 * landing.c: what a fall may end on. For config.slide_solver JOINT see falling.c. */
#include "landing.h"

#include "base_motion.h"
#include "floor_distance.h"
#include "launch.h"
#include "modes.h"
#include "report.h"
#include "shape.h"

/* A normal that rises less is a wall's; normals that differ by no more along every axis are one. */
static const double SMALL = 1e-4;

/* Cosine: what is met by a normal nearer to up than this lies level under a flat base. */
static const double LEVEL = 1 - 1e-6;

static int is_edge(vec3 normal, vec3 surface_normal)
{
    vec3 d = sub(normal, surface_normal);
    return max_of(max_of(d.x, -d.x), max_of(max_of(d.y, -d.y), max_of(d.z, -d.z))) > SMALL;
}

/* Does what a flat base met carry it, whichever point of the contact is named? A face meets it always from below, at
 * its rim if it slopes; and what it meets flat lies under all of it, be it the crest of a roof. */
static int carries_flat(const tahr__step *step, vec3 normal, vec3 surface_normal)
{
    return shape_is_flat(&step->limits->shape) &&
           (!is_edge(normal, surface_normal) || dot(normal, step->state.up) > LEVEL);
}

/* Is the point on the lower cap of the shape at `centre`, and well inside its rim? Of a flat base: on its lower
 * face. */
static int is_under_foot(const tahr__step *step, vec3 centre, vec3 point)
{
    const tahr_shape *s = &step->limits->shape;
    double cap = shape_is_flat(s) ? step->config->edge_tolerance : shape_cap(s);
    double height = dot(sub(point, centre), step->state.up);
    return height < cap - s->half_height && tahr__is_within_edge_tolerance(step, centre, point, step->limits->width);
}

int tahr__is_valid_landing_spot(tahr__step *step, const tahr__swept *swept)
{
    const tahr_hit *hit = &swept->hit;
    tahr_floor floor;
    if (!hit->blocking || hit->unknown) {
        return 0;
    }
    double rise = dot(hit->normal, step->state.up);
    int stands = hit->start_overlap
                     ? rise >= SMALL
                     : tahr__is_walkable(step, hit, 0) && (carries_flat(step, hit->normal, hit->surface_normal) ||
                                                           is_under_foot(step, swept->location, hit->point));
    if (!stands) {
        return tahr__decide(step, TAHR_RULE_LANDING, 0, hit, rise, SMALL, "too steep, or not under the foot");
    }
    tahr__supplied supplied = supplied_by(swept);
    tahr__find_floor(step, step->config->snap_distance, &supplied, &floor);
    return tahr__decide(step, TAHR_RULE_LANDING, floor_is_walkable(&floor), hit, floor.distance, 0,
                        "floor where it fell");
}

int tahr__should_check_landing_spot(const tahr__step *step, const tahr_hit *hit)
{
    return is_edge(hit->normal, hit->surface_normal) && !hit->start_overlap && !hit->unknown &&
           dot(hit->normal, step->state.up) > SMALL &&
           tahr__is_within_edge_tolerance(step, step->state.position, hit->point, step->limits->width);
}

int tahr__finds_landing_spot(tahr__step *step)
{
    tahr_floor floor;
    tahr__find_floor(step, step->config->snap_distance, NULL, &floor);
    vec3 at_contact = add_scaled(step->state.position, step->state.up, -floor.distance);
    int ok = floor_is_walkable(&floor) &&
             (carries_flat(step, floor.normal, floor.surface_normal) || is_under_foot(step, at_contact, floor.point));
    return tahr__decide(step, TAHR_RULE_LANDING, ok, NULL, floor.distance, 0, "floor straight below an edge");
}

void tahr__process_landed(tahr__step *step, const tahr_hit *hit)
{
    tahr_floor floor;
    tahr_state *s = &step->state;
    tahr__land_on(step, hit->body);
    tahr__event(step, TAHR_EVENT_LANDED, hit, max_of(-dot(whole_velocity(step), s->up), 0));
    s->velocity = step_level(step, s->velocity);
    s->flags &= ~(uint32_t)TAHR_STATE_JUMPING;
    s->jump_hold = 0;
    tahr__change_mode(step, TAHR_MODE_WALKING);
    tahr__find_floor(step, step->config->snap_distance, NULL, &floor);
    tahr__keep_floor(step, &floor);
    tahr__adjust_height(step);
}
