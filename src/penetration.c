/* SPDX-License-Identifier: MIT
 * penetration.c: out of one overlap at a time: the push that one surface asks for, tried where a little more than the
 * shape fits, and swept where it does not. For the joint solve see tahr__depenetrate in move.c. */
#include "move.h"
#include "plane.h"
#include "query.h"
#include "report.h"
#include "shape.h"
#include "trail.h"

/* Added to the depth, and the depth itself where that is not known: 0.125 cm in the field
 * (PenetrationPullbackDistance). */
static double extra_push(const tahr_config *c)
{
    return 1.25 * c->pull_back;
}

/* What the shape is larger by in the test whether it fits: 0.1 cm in the field (PenetrationOverlapCheckInflation). Less
 * than the extra push, so that a single plane always lets the shape out at once. */
static double fit_inflation(const tahr_config *c)
{
    return c->pull_back;
}

vec3 tahr__penetration_adjustment(const tahr__step *step, const tahr_hit *hit)
{
    const tahr_config *c = step->config;
    if (!hit->start_overlap) {
        return vec(0, 0, 0);
    }
    double depth = hit->depth > 0 ? min_of(hit->depth, 1e6) : extra_push(c); /* m: no body is larger */
    vec3 push = along_plane(step->limits, scale(hit->normal, depth + extra_push(c)));
    int character = (world_body_flags(step->world, hit->body) & TAHR_BODY_CHARACTER) != 0;
    double most = character ? c->max_depenetration_character : c->max_depenetration;
    double size = length(push);
    return size > most ? scale(push, most / size) : push;
}

static int fits(tahr__step *step, vec3 position)
{
    tahr_contact contact[TAHR__MAX_PLANES]; /* sensors among them do not count */
    double more = fit_inflation(step->config), margin = 0;
    tahr_shape s = step->limits->shape;
    if (s.type == TAHR_SHAPE_HULL) { /* what is within that is not there for a larger one either */
        margin = more;
    } else {
        shape_grow(&s, more);
    }
    return tahr__contacts_of(step, &s, position, margin, contact, TAHR__MAX_PLANES) == 0 && step->error >= 0 &&
           !(step->report.flags & TAHR_REPORT_QUERY_CAP);
}

static int sweep_out(tahr__step *step, vec3 push, const tahr__swept *from)
{
    tahr__swept swept;
    int moved = tahr__move_updated(step, push, TAHR_SWEEP_LEAVE_OVERLAP, &swept);
    if (!moved && swept.hit.start_overlap) {
        vec3 second = tahr__penetration_adjustment(step, &swept.hit);
        vec3 both = add(push, second);
        if (!vec_equal(second, push) && length_squared(both) > 0) {
            moved = tahr__move_updated(step, both, TAHR_SWEEP_LEAVE_OVERLAP, &swept);
        }
    }
    if (!moved) {
        moved = tahr__move_updated(step, add(push, from->motion), TAHR_SWEEP_LEAVE_OVERLAP, &swept);
    }
    if (!moved && dot(from->motion, push) > 0) {
        moved = tahr__move_updated(step, from->motion, TAHR_SWEEP_LEAVE_OVERLAP, &swept);
    }
    return moved;
}

/* What is still overlapped is tried again in the next step; only who could not move at all is crushed. */
static void tell(tahr__step *step, const tahr__swept *swept, int moved)
{
    double size = length(sub(step->state.position, swept->start));
    if (moved) {
        tahr__event(step, TAHR_EVENT_DEPENETRATED, &swept->hit, size);
    } else {
        step->report.flags |= TAHR_REPORT_CRUSHED;
        step->state.flags |= TAHR_STATE_CRUSHED;
        step->report.residual = max_of(step->report.residual, swept->hit.depth);
        tahr__event(step, TAHR_EVENT_CRUSHED, &swept->hit, swept->hit.depth);
    }
    tahr__decide(step, TAHR_RULE_DEPENETRATION, moved, &swept->hit, swept->hit.depth, size,
                 "pushed out of one surface");
}

int tahr__resolve_penetration(tahr__step *step, vec3 adjustment, const tahr__swept *swept)
{
    vec3 push = along_plane(step->limits, adjustment);
    if (length_squared(push) == 0) {
        return 0;
    }
    vec3 to = add(swept->start, push);
    int moved = fits(step, to);
    if (moved) {
        tahr__trail_go(step);
        step->state.position = to;
    } else {
        moved = sweep_out(step, push, swept);
    }
    step->just_teleported |= moved != 0;
    tell(step, swept, moved);
    return moved;
}

int tahr__move_otherwise(tahr__step *step, vec3 motion, tahr_hit *hit)
{
    tahr__swept swept;
    tahr__safe_move(step, motion, &swept);
    *hit = swept.hit;
    return (int)swept.overlapped;
}
