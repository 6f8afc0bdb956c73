/* SPDX-License-Identifier: MIT
 * floor_measure.c: what changes evenly from look to look, whatever the form of what is touched, and passes a limit of
 * the rules. */
#include <math.h>

#include "floor_look.h"
#include "rim.h"

/* Sine: a face that a contact leans no more than this behind may be met from either side. */
static const double BEHIND = 2e-6;

/* What changes evenly with the place, and passes 0 where a rule says something else. */
typedef enum measured { TURNS_TO, TURNS_FROM, TILTS, NEARS_RIM, SINKS } measured;

static const contact *contact_in(const look *l, int thin)
{
    return thin ? &l->inner : &l->outer;
}

static double measure(const tahr__step *step, const looks *s, const look *l, int thin, measured what)
{
    const contact *c = contact_in(l, thin), *in = contact_in(&s->inside, thin), *out = contact_in(&s->outside, thin);
    int touches = l->known && (!thin || l->has_inner) && c->kind != FREE;
    if (!touches || (what == TILTS && (c->kind != EDGE || in->kind == out->kind || out->kind == FREE)) ||
        (what == SINKS && out->kind != FREE) || (what <= TURNS_FROM && in->kind == FACE && out->kind == FACE)) {
        return NAN;
    }
    switch (what) {
    case TURNS_TO: return dot(c->normal, in->face) - BEHIND;
    case TURNS_FROM: return dot(c->normal, out->face) - BEHIND;
    case TILTS: return length(cross(c->normal, c->face)) - ON_FACE;
    case NEARS_RIM: return inside_rim(step, l->position, c->point) - step->config->perch_threshold - step->config->skin;
    default: return c->depth - out->depth;
    }
}

/* By two looks; NOWHERE if one of them does not tell. */
static double by_two(const looks *s, const look *a, double at_a, const look *b, double at_b)
{
    double part = a->at + (b->at - a->at) * (at_a / (at_a - at_b));
    return part > s->inside.at && part < s->outside.at ? part : NOWHERE;
}

/* By two looks on the same side, or else by one on either. */
static double by_measure(const tahr__step *step, const looks *s, int thin, measured what)
{
    const look *in = &s->inside, *out = &s->outside;
    double at_in = measure(step, s, in, thin, what), at_out = measure(step, s, out, thin, what);
    if (at_in * at_out > 0) {
        return NOWHERE;
    }
    double part = by_two(s, in, at_in, &s->further[1], measure(step, s, &s->further[1], thin, what));
    if (part == NOWHERE) {
        part = by_two(s, out, at_out, &s->further[0], measure(step, s, &s->further[0], thin, what));
    }
    return part == NOWHERE ? by_two(s, in, at_in, out, at_out) : part;
}

double tahr__looks_measure(const tahr__step *step, const looks *s)
{
    double part = NOWHERE;
    for (int thin = 0; s->inside.known && thin < 2; thin++) {
        for (int what = TURNS_TO; what <= SINKS && part == NOWHERE; what++) {
            part = by_measure(step, s, thin, (measured)what);
        }
    }
    return part;
}
