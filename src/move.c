/* SPDX-License-Identifier: MIT
 * move.c: moving the character's shape: sweep with the skin as a margin, and depenetration by a joint solve. */
#include "move.h"

#include <string.h>

#include "plane.h"
#include "query.h"
#include "report.h"

/* An overlap of less is rounding of the backend, not worth a push (robustness: native float 2e-6 m). */
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

int tahr__move(tahr__step *step, vec3 motion, tahr_hit *hit)
{
    const tahr_shape *shape = &step->limits->shape;
    double skin = step->config->skin;
    tahr__sweep(step, shape, step->state.position, motion, skin, 0, hit);
    int overlapped = hit->start_overlap != 0;
    if (overlapped) {
        tahr__depenetrate(step);
        /* What is still overlapped may be left, never entered deeper. */
        tahr__sweep(step, shape, step->state.position, motion, skin, TAHR_SWEEP_LEAVE_OVERLAP, hit);
    }
    tahr__decide(step, TAHR_RULE_SWEEP, !hit->blocking, hit, hit->fraction, 1, outcome(hit));
    advance(step, motion, hit);
    return overlapped;
}

enum { CONTACTS = TAHR__MAX_PLANES };

static double deepest(const tahr_contact *contacts, uint32_t count)
{
    return count > 0 && contacts[0].distance < 0 ? -contacts[0].distance : 0;
}

/* The shortest push that leaves `skin` to everything, or the least-squares one. Returns 1 if it suffices. */
static int joint_push(const tahr__step *step, const tahr_contact *contacts, uint32_t count, vec3 *push)
{
    tahr__plane planes[TAHR__MAX_PLANES];
    uint32_t used = 0;
    for (uint32_t i = 0; i < count; i++) {
        tahr__plane plane = {.normal = contacts[i].normal,
                             .offset = step->config->skin - contacts[i].distance,
                             .body = contacts[i].body,
                             .feature = contacts[i].feature};
        if (!is_in_plane(step) || tahr__plane_surface(step, &plane.normal, &plane.offset)) {
            tahr__planes_add(planes, &used, &plane);
        }
    }
    return tahr__project(planes, used, vec(0, 0, 0), push);
}

/* Moves along a push that frees: only what is not overlapped yet can stop it. */
static void push_out(tahr__step *step, vec3 push)
{
    tahr_hit hit;
    tahr__sweep(step, &step->limits->shape, step->state.position, push, step->config->skin, TAHR_SWEEP_LEAVE_OVERLAP,
                &hit);
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
    if (residual > TOUCHING) {
        step->report.flags |= TAHR_REPORT_CRUSHED;
        step->report.residual = max_of(step->report.residual, residual);
        tahr__event(step, TAHR_EVENT_CRUSHED, &hit, residual);
    }
    tahr__decide(step, TAHR_RULE_DEPENETRATION, residual <= TOUCHING, &hit, residual, TOUCHING,
                 "depth left after the joint push");
}

int tahr__depenetrate(tahr__step *step)
{
    tahr_contact contacts[CONTACTS];
    double skin = step->config->skin;
    vec3 start = step->state.position;
    uint32_t count = tahr__contacts(step, step->state.position, skin, contacts, CONTACTS);
    tahr_contact first;
    memset(&first, 0, sizeof first);
    first.body = TAHR_NO_BODY;
    if (count > 0) {
        first = contacts[0];
    }
    double depth = deepest(contacts, count);
    for (int round = 0; round < TAHR__DEPENETRATION_ROUNDS && depth > TOUCHING && step->push_left > 0; round++) {
        vec3 push, before = step->state.position;
        int frees = joint_push(step, contacts, count, &push);
        double size = length(push);
        if (size > step->push_left) {
            push = scale(push, step->push_left / size);
            size = step->push_left;
        }
        if (frees) {
            push_out(step, push);
        } else {
            step->state.position = add(step->state.position, push);
        }
        count = tahr__contacts(step, step->state.position, skin, contacts, CONTACTS);
        double now = deepest(contacts, count);
        if (now >= depth) { /* no better: stay where it was least bad */
            step->state.position = before;
            break;
        }
        depth = now;
        step->push_left -= size;
    }
    emit(step, start, depth, &first);
    return depth <= TOUCHING;
}
