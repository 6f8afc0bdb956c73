/* SPDX-License-Identifier: MIT
 * floor_end.c: where on a way a floor ends.
 *
 * Mostly that is where something that a look measures passes a limit of the rules: the level distance of an edge from
 * the axis, the place on an edge where a face begins, the depth at which a foot meets one thing before another. What is
 * straight and flat then says the very place, and a look on either side of it proves it; where it bends every look
 * brings a better one, as in Newton's method. What ends for another reason (a level foot, a backend that lies) is found
 * by halving. Predictions are held near the middle as the ITP method does (Oliveira and Takahashi 2020), so that all
 * the wrong ones together cost no more than a few looks. */
#include "floor_end.h"

#include <math.h>

#include "floor_look.h"
#include "nearby.h"
#include "perch.h"

/* Half widths of the character (1e-9 m of one 0.7 m wide) beside a predicted place that is looked at, above the
 * rounding of an exact sweep past an edge; times FARTHER where that came out on the wrong side (what is exact to 1e-6 m
 * is found at once then), and by NEARER less where it did not. */
static const double BESIDE = 3e-9, FARTHER = 1024, NEARER = 32;

/* The place is known to 2^-ROUNDS of the way: that many looks by halving, and no more than LOST and PROOFS besides. */
enum { ROUNDS = 20, LOST = 2, PROOFS = 2 };

/* As many looks seldom are all. A backend that could not keep what is near the whole step may keep what is near this
 * way: from here on it is worth asking. */
enum { MANY = 6 };

/* Predictions that change by no more than this part of the way that is left agree. */
static const double STEADILY = 0.03;

/* What looks tell changes by less than this of how far they are apart, where it leads to anything: half at a place that
 * is touched and not passed. */
static const double STEEPEST = 0.8, EVENLY = 0.1;

typedef struct search {
    looks seen;
    double least;         /* of the parts of the way beside a prediction, the smallest */
    double predicted;     /* by what was known before the last look */
    double proven[2];     /* the predictions that the nearest outside and inside came out by; NOWHERE: by none */
    double told, told_at; /* what the last look but one told, and where it was */
    double rate;          /* at which that changed with the place */
    double latest;        /* part of the way of the last look */
    int surprised;        /* 1: it came out on the other side of that */
    int proves;           /* 1: it is beside that */
    int tried;            /* 1: right behind the begin was looked at */
    int doubts;           /* 1: what straight edges tell was wrong */
    int measured;         /* 1: by what changes evenly instead */
    uint32_t steady;      /* looks that changed nothing about the prediction */
    uint32_t lost;        /* looks that may still be lost */
} search;

/* Beside the predicted place, on the side that less is known of; else in the middle. But who has gone down where a
 * floor ended, and goes on from there, is at the end of the next one already: if the floor held nowhere so far, right
 * behind the begin. */
static double next_look(search *s, uint32_t taken)
{
    enum { STEADY = 2 };
    double a = s->seen.inside.at, b = s->seen.outside.at, middle = 0.5 * (a + b), at = middle, asked;
    s->proves = 0;
    int at_begin = !s->seen.inside.known && !s->tried;
    if (s->predicted == NOWHERE ? at_begin && taken >= LOST : at_begin && s->predicted - s->seen.beside <= a) {
        s->tried = 1;
        return 0.5 / (1 << ROUNDS);
    }
    if (s->predicted != NOWHERE) {
        double part = clamp(s->predicted, a, b);
        at = part - a > b - part || !s->seen.inside.known ? part - s->seen.beside : part + s->seen.beside;
    }
    asked = at;
    if (s->steady >= STEADY && s->lost < LOST + PROOFS) { /* what so many looks agree on is proven anyway */
        s->lost++;
    } else { /* after n looks no more than 2^(lost - n) may be left */
        double most = (double)(1u << s->lost) / (2.0 * (double)(1u << taken)) - 0.5 * (b - a);
        at = clamp(at, middle - most, middle + most);
    }
    s->proves = s->predicted != NOWHERE && at == asked;
    return at > a && at < b ? at : middle;
}

/* Does a look see another kind of thing than the last one on its side? What was wrong of that may be right of this. */
static int sees_another(const look *now, const look *before)
{
    return now->perching != before->perching || now->has_inner != before->has_inner ||
           now->outer.kind != before->outer.kind || (now->has_inner && now->inner.kind != before->inner.kind);
}

/* Returns 1 if the floor holds there. */
static int look_at(tahr__step *step, search *s, double at, tahr_floor *floor)
{
    tahr__inner inner = {.asked = 0};
    step->inner = &inner;
    step->state.position = add_scaled(s->seen.from, s->seen.way, at);
    tahr__find_floor(step, step->config->snap_distance, NULL, floor);
    int inside = floor_is_walkable(floor);
    look *side = inside ? &s->seen.inside : &s->seen.outside;
    s->seen.further[inside] = *side;
    tahr__look_note(step, floor, at, side);
    tahr__looks_compare(side, &s->seen.further[inside]);
    s->doubts = s->doubts && !sees_another(side, &s->seen.further[inside]);
    tahr__looks_compare(side, inside ? &s->seen.outside : &s->seen.inside);
    step->inner = NULL;
    s->latest = at;
    s->surprised = s->predicted != NOWHERE && inside != (at < s->predicted);
    s->proven[inside] = s->proves && !s->surprised ? s->predicted : NOWHERE;
    return inside;
}

/* What looks tell may change evenly with where they are, as the last three show: then the place is where a look would
 * tell of itself, as Steffensen's method has it. told: by the last one. */
static double refine(search *s, double told)
{
    double moved = s->latest - s->told_at, change = told - s->told, at = s->latest, least = 100 * s->least;
    int both = told != NOWHERE && s->told != NOWHERE && (moved > least || moved < -least);
    s->told = told;
    s->told_at = at;
    double rate = change / moved, before = s->rate;
    s->rate = both ? rate : s->rate;
    if (!both || rate * rate > STEEPEST * STEEPEST || (rate - before) * (rate - before) > EVENLY * EVENLY) {
        return told;
    }
    double part = (told - rate * at) / (1 - rate), off = FARTHER * s->least;
    if (!is_between(&s->seen, part) && is_between(&s->seen, told) && s->seen.outside.at - s->seen.inside.at > 4 * off) {
        return clamp(part, s->seen.inside.at + off, s->seen.outside.at - off); /* it bends: near that end */
    }
    return is_between(&s->seen, part) ? part : told;
}

/* Goes farther beside where the same place is predicted that was proven wrong. */
static void predict_again(const tahr__step *step, search *s)
{
    double part = refine(s, tahr__looks_predict(step, &s->seen));
    s->doubts = s->doubts && !(s->measured && s->surprised);
    double seen = part == NOWHERE || s->doubts ? tahr__looks_measure(step, &s->seen) : NOWHERE;
    s->measured = seen != NOWHERE;
    part = s->measured ? seen : part;
    double change = part - s->predicted, gap = s->seen.outside.at - s->seen.inside.at, little = STEADILY * gap;
    s->steady = change <= little && change >= -little && part != NOWHERE ? s->steady + 1 : 0;
    if (!s->surprised) {
        s->seen.beside = s->proves ? max_of(s->seen.beside / NEARER, s->least) : s->seen.beside;
    } else if (change <= 4 * s->seen.beside && change >= -4 * s->seen.beside) { /* it may move with the look */
        s->seen.beside =
            s->seen.beside > NEARER * s->least ? gap : min_of(s->seen.beside * FARTHER, sqrt(s->seen.beside * gap));
        s->doubts = 1;
    }
    if (s->seen.beside > 0.25 * gap) { /* it is somewhere else */
        s->seen.beside = s->least;
        part = NOWHERE;
    }
    /* Where nothing else is known, it may be where it was predicted before, if that was proven from one side. */
    part = part == NOWHERE ? max_of(s->proven[0], s->proven[1]) : part;
    s->predicted = part;
}

void tahr__floor_end(tahr__step *step, const tahr__path *w, const tahr_floor *beyond, tahr__floor_border *border)
{
    enum { LOOKS = ROUNDS + LOST + PROOFS, MOST = TAHR_MAX_QUERIES_PER_STEP * 5 / 8 };
    search s = {.seen = {.from = w->from, .way = sub(step->state.position, w->from)},
                .predicted = NOWHERE,
                .proven = {NOWHERE, NOWHERE},
                .told = NOWHERE,
                .rate = INFINITY,
                .lost = LOST};
    tahr_floor floor;
    double size = length(s.seen.way);
    s.seen.beside = s.least = BESIDE * step->limits->width / max_of(size, 1e-300);
    const double least = max_of(1.0 / (1 << ROUNDS), 2.1 * s.least); /* of the way, to be known */
    s.latest = 1;
    tahr__look_note(step, beyond, 1, &s.seen.outside);
    for (uint32_t i = 0; i < LOOKS && s.seen.outside.at - s.seen.inside.at > least && step->queries < MOST; i++) {
        if (i == (step_goes_far(step) ? 0 : MANY)) {
            tahr__announce_near(step, s.seen.from, s.seen.way);
        }
        predict_again(step, &s);
        if (look_at(step, &s, next_look(&s, i), &floor)) {
            border->floor = floor;
        }
        if (step->error < 0) {
            break;
        }
    }
    border->outside = s.seen.outside.at;
    if (!s.seen.inside.known) {
        look_at(step, &s, 0, &border->floor);
    }
    border->inside = s.seen.inside.at;
    step->state.position = add_scaled(w->from, s.seen.way, s.seen.inside.at);
}
