/* SPDX-License-Identifier: MIT
 * move.c: moving the character's shape: one sweep with a skin or a pull-back, and the depenetration by a joint
 * solve. */
#include "move.h"

#include <string.h>

#include "plane.h"
#include "push.h"
#include "query.h"
#include "report.h"
#include "trail.h"

/* An overlap of less is rounding of the backend, not worth a push (native 1e-9 m, and positions 1e7 m out have steps of
 * 2e-9 m). */
static const double TOUCHING = 1e-7;

static void advance(tahr__step *step, vec3 motion, const tahr_hit *hit)
{
    if (!hit->start_overlap) {
        double f = hit->blocking ? hit->fraction : 1;
        step->state.position = add_scaled(step->state.position, motion, f);
    }
}

static const char *outcome(const tahr_hit *hit)
{
    if (hit->unknown) {
        return "undecided, taken for a wall";
    }
    if (hit->start_overlap) {
        return "overlaps something already";
    }
    return hit->blocking ? "kept the skin to something" : "nothing in the way";
}

/* A motion of less is skipped: 4e-4 cm in the field, the rounding of a float's centimetres. With a skin none is too
 * short: at 1000 Hz a slow character would never start. */
static double least_motion(const tahr_config *c)
{
    return c->separation == TAHR_SEPARATION_PULL_BACK ? 0.004 * c->pull_back : 0;
}

/* In the field's centimetres: clamp(0.1, 0.1 / D, 1 / D) + 0.001. So a short motion ends 0.1 cm before the contact, a
 * long one at most 1 cm and a thousandth of itself. */
double tahr__pull_back_part(const tahr_config *config, double length)
{
    double least = config->pull_back / length;
    return clamp(0.1, least, 10 * least) + 0.001;
}

double tahr__pull_back(const tahr_config *config, double t, double length)
{
    return clamp(t - tahr__pull_back_part(config, length), 0, 1);
}

/* Nothing was asked, and nothing met. */
static void skip(tahr__swept *swept)
{
    memset(&swept->hit, 0, sizeof swept->hit);
    swept->hit.fraction = 1;
    swept->hit.body = TAHR_NO_BODY;
    swept->location = swept->start;
}

/* The field picks of several overlaps the one whose face opposes the motion most; the seam's answer is the deepest of
 * those that count. */
int tahr__move_updated(tahr__step *step, vec3 motion, uint32_t flags, tahr__swept *swept)
{
    const tahr_config *c = step->config;
    int pulls = c->separation == TAHR_SEPARATION_PULL_BACK;
    tahr_hit *hit = &swept->hit;
    double least = least_motion(c);
    swept->start = step->state.position;
    swept->overlapped = 0;
    swept->motion = motion = along_plane(step->limits, motion);
    double size2 = length_squared(motion);
    if (size2 <= least * least) {
        skip(swept);
        return 1;
    }
    tahr__trail_go(step);
    tahr__sweep(step, &step->limits->shape, swept->start, motion, pulls ? 0 : c->skin, flags, hit);
    tahr__decide(step, TAHR_RULE_SWEEP, !hit->blocking, hit, hit->fraction, 1, outcome(hit));
    double contact = hit->start_overlap ? 0 : hit->fraction;
    swept->location = add_scaled(swept->start, motion, contact);
    hit->fraction = contact;
    if (hit->blocking && pulls) {
        hit->fraction = tahr__pull_back(c, contact, sqrt(size2));
        if (hit->fraction * hit->fraction * size2 <= least * least) {
            hit->fraction = 0;
        }
        tahr__decide(step, TAHR_RULE_PULL_BACK, hit->fraction > 0, hit, contact, hit->fraction, "kept off the contact");
    }
    step->state.position = add_scaled(swept->start, motion, hit->fraction);
    return hit->fraction > 0;
}

int tahr__safe_move(tahr__step *step, vec3 motion, tahr__swept *swept)
{
    int moved = tahr__move_updated(step, motion, 0, swept);
    if (!swept->hit.start_overlap) {
        return moved;
    }
    swept->overlapped = 1;
    if (step->config->depenetration == TAHR_DEPENETRATION_JOINT) {
        tahr__depenetrate(step);
        step->just_teleported |= !vec_equal(step->state.position, swept->start);
    } else if (!tahr__resolve_penetration(step, tahr__penetration_adjustment(step, &swept->hit), swept)) {
        return moved;
    }
    /* What is still overlapped may be left, never entered deeper. */
    moved = tahr__move_updated(step, motion, TAHR_SWEEP_LEAVE_OVERLAP, swept);
    swept->overlapped = 1;
    return moved;
}

static int is_otherwise(const tahr_config *c)
{
    return c->separation != TAHR_SEPARATION_MARGIN || c->depenetration != TAHR_DEPENETRATION_JOINT;
}

int tahr__move(tahr__step *step, vec3 motion, tahr_hit *hit)
{
    const tahr_shape *shape = &step->limits->shape;
    double skin = step->config->skin;
    if (!step->limits->usual && is_otherwise(step->config)) {
        return tahr__move_otherwise(step, motion, hit);
    }
    tahr__trail_go(step);
    tahr__sweep(step, shape, step->state.position, motion, skin, 0, hit);
    int overlapped = hit->start_overlap != 0;
    if (overlapped) {
        tahr__depenetrate(step);
        /* What is still overlapped may be left, never entered deeper. */
        tahr__sweep(step, shape, step->state.position, motion, skin, TAHR_SWEEP_LEAVE_OVERLAP, hit);
    }
    if (step->report.decisions) { /* the words are looked for only then */
        tahr__decide(step, TAHR_RULE_SWEEP, !hit->blocking, hit, hit->fraction, 1, outcome(hit));
    }
    advance(step, motion, hit);
    return overlapped;
}

enum { CONTACTS = TAHR__MAX_PLANES };

static double deepest(const tahr_contact *contacts, uint32_t count)
{
    return count > 0 && contacts[0].distance < 0 ? -contacts[0].distance : 0;
}

/* The shortest push that leaves `skin` to everything, or the least-squares one. Returns 1 if it suffices. */
static int joint_push(const tahr__step *step, const tahr_contact *contacts, uint32_t count, double skin, vec3 *push)
{
    tahr__plane planes[TAHR__MAX_PLANES];
    uint32_t used = 0;
    for (uint32_t i = 0; i < count; i++) {
        tahr__plane plane = {.normal = contacts[i].normal,
                             .offset = skin - contacts[i].distance,
                             .body = contacts[i].body,
                             .feature = contacts[i].feature};
        if (!is_in_plane(step) || tahr__plane_surface(step, &plane.normal, &plane.offset)) {
            tahr__planes_add(planes, &used, &plane);
        }
    }
    return tahr__project(planes, used, vec(0, 0, 0), push);
}

/* Moves along a push that frees: only what is not overlapped yet can stop it. */
static void push_out(tahr__step *step, vec3 push, double skin)
{
    tahr_hit hit;
    tahr__sweep(step, &step->limits->shape, step->state.position, push, skin, TAHR_SWEEP_LEAVE_OVERLAP, &hit);
    advance(step, push, &hit);
    if (hit.start_overlap &&
        hit.blocking) { /* a curved neighbour looks deeper for a moment: the push is still the joint one */
        step->state.position = add(step->state.position, push);
    }
}

static void emit(tahr__step *step, vec3 start, double residual, const tahr_contact *contact)
{
    tahr_hit hit;
    memset(&hit, 0, sizeof hit);
    hit.body = contact->body;
    hit.feature = contact->feature;
    hit.normal = contact->normal;
    hit.point = contact->point;
    double moved = length(sub(step->state.position, start));
    if (moved > 0) {
        tahr__event(step, TAHR_EVENT_DEPENETRATED, &hit, moved);
    }
    step->state.flags &= ~(uint32_t)TAHR_STATE_CRUSHED;
    if (residual > TOUCHING) {
        step->report.flags |= TAHR_REPORT_CRUSHED;
        step->state.flags |= TAHR_STATE_CRUSHED;
        step->report.residual = max_of(step->report.residual, residual);
        tahr__event(step, TAHR_EVENT_CRUSHED, &hit, residual);
    }
    tahr__decide(step, TAHR_RULE_DEPENETRATION, residual <= TOUCHING, &hit, residual, TOUCHING,
                 "depth left after the joint push");
}

/* How far from everything a push ends. */
static double clear_of(const tahr_config *c)
{
    return c->separation == TAHR_SEPARATION_MARGIN ? c->skin : 1.25 * c->pull_back;
}

int tahr__depenetrate(tahr__step *step)
{
    tahr_contact contacts[CONTACTS];
    double skin = clear_of(step->config);
    vec3 start = step->state.position;
    /* A floor is up to 1.5 skin away: pressed from above the character may not be pushed into it, only to be pushed
     * back. */
    int squeezes = step_squeezes(step);
    double near = squeezes ? 1.5 * skin : skin;
    uint32_t count = tahr__contacts(step, step->state.position, near, contacts, CONTACTS);
    tahr_contact first;
    memset(&first, 0, sizeof first);
    first.body = TAHR_NO_BODY;
    if (count > 0) {
        first = contacts[0];
    }
    double depth = deepest(contacts, count);
    for (int round = 0; round < TAHR__DEPENETRATION_ROUNDS && depth > TOUCHING && step->push_left > 0; round++) {
        vec3 push, before = step->state.position;
        int frees = joint_push(step, contacts, count, skin, &push);
        double fixed = 0;
        if (squeezes) {
            fixed = tahr__fixed_depth(step, contacts, count);
            push = frees ? push : tahr__spare_the_fixed(step, contacts, count, push);
        }
        double size = length(push);
        if (size > step->push_left) {
            push = scale(push, step->push_left / size);
            size = step->push_left;
        }
        if (frees) {
            push_out(step, push, skin);
        } else {
            step->state.position = add(step->state.position, push);
        }
        count = tahr__contacts(step, step->state.position, near, contacts, CONTACTS);
        double now = deepest(contacts, count);
        int enters = squeezes && tahr__fixed_depth(step, contacts, count) > fixed + TOUCHING;
        if (now >= depth || enters) { /* no better: stay where it was least bad */
            step->state.position = before;
            break;
        }
        depth = now;
        step->push_left -= size;
    }
    emit(step, start, depth, &first);
    return depth <= TOUCHING;
}
