/* SPDX-License-Identifier: MIT
 * ready.h: is a step one that the short way is for, and all in order that it is given?
 *
 * What a step begins with is mostly what the one before it ended with. So most of it need not be worked out: its bits
 * are those of what was found to be in order once, and is remembered. Nothing is taken for granted that is not
 * compared, for a mover may be given another character's state at any time. What is not so is not wrong: the checks of
 * arguments.h decide. */
#ifndef TAHR_READY_H
#define TAHR_READY_H

#include "arguments.h"
#include "neighbours.h"
#include "path.h"
#include "words.h"

/* A floor that is all known by its face. */
#define TAHR__READY_FACE ((uint32_t)(TAHR_FLOOR_BLOCKING | TAHR_FLOOR_WALKABLE | TAHR_FLOOR_FACE))

/* What a flight may remember: not that a button went down, if a press does anything in the air. Of those flags that are
 * odd it has those that are held. */
static inline uint32_t odd_flags(const tahr__dive *dive, uint32_t jump)
{
    const uint32_t may = TAHR_STATE_JUMP_HELD | TAHR_STATE_JUMPING | TAHR_STATE_FLOOR_MOVED;
    const uint32_t spent = dive->presses ? TAHR_STATE_JUMP_SPENT : 0u;
    return ~(may | spent) | (dive->presses && jump ? TAHR_STATE_JUMP_HELD : 0u);
}

static inline uint32_t held_flags(const tahr__dive *dive, uint32_t jump)
{
    return dive->presses && jump ? TAHR_STATE_JUMP_HELD : 0;
}

/* 0: a report that asks for no more than counts and events. */
static inline uint64_t other_report(const tahr_report *r)
{
    return r ? (r->struct_size ^ (uint32_t)sizeof *r) | (uint64_t)(uintptr_t)r->decisions |
                   (uint64_t)(uintptr_t)r->queries
             : 0;
}

/* 0 with other_head: the same was asked for, as long. */
static inline uint64_t other_asked(const tahr__asked *asked, const tahr_input *in, double dt)
{
    return (bits_of(in->move.z) ^ bits_of(asked->move.z)) | (bits_of(dt) ^ bits_of(asked->dt)) | in->reserved;
}

static inline tahr__words other_head(const tahr__asked *asked, const tahr_input *in)
{
    _Static_assert(offsetof(tahr_input, move.z) == 32 && offsetof(tahr__asked, move.z) == 32, "a head of 32 bytes");
    return other_words(in, asked, offsetof(tahr_input, move.z));
}

/* 0: nobody is near whom it would meet, and nobody watches. */
static inline uint64_t other_company(const tahr_mover *mover)
{
    const uint64_t watched = (uint64_t)(uintptr_t)mover->world->recording;
    return mover->company ? watched | (uint64_t)(uintptr_t)mover->company->neighbours : watched;
}

/* As arguments_are_usual has them, of sums of squares. */
static inline int are_within(double places, double speeds)
{
    return places <= 4e14 && speeds <= 1e10;
}

/* A walk like the last short one: the same wish for as long, on a face that is known to hold, with all of its floor
 * known. What mover->pace says was checked; the rest is checked here, so that arguments_are_usual and begins_on_face
 * (stroll.h) would say yes, for a mover whose up is +z. */
static inline int ready_to_walk(const tahr_mover *mover, const tahr_input *input, double dt, const tahr_state *s,
                                const tahr_report *report)
{
    const tahr__pace *pace = &mover->pace;
    const tahr_floor *f = &s->floor;
    tahr__words other = words_or(other_memory(s, &pace->bare), other_head(&pace->asked, input));
    other = words_or(other, other_words(&s->orientation, &pace->held, sizeof pace->held));
    other = words_or(other, other_three(&s->floor_position, &s->position));
    uint64_t odd = other_company(mover) | bits_of(s->jump_hold) | bits_of(f->perch_distance);
    odd |= s->floor_revision ^ mover->world->revision;
    odd |= ((f->flags & ~(uint32_t)TAHR_FLOOR_SLOPE) ^ TAHR__READY_FACE) | other_asked(&pace->asked, input, dt);
    odd |= other_report(report);
    if (odd || !words_are_zero(other)) {
        return 0;
    }
    const double places = length_squared(s->position) + (length_squared(f->point) + f->distance * f->distance);
    return are_within(places, length_squared(s->velocity)) &&
           (f->surface_normal.z > TAHR__GENTLE || (f->flags & TAHR_FLOOR_SLOPE));
}

/* A rise or fall like the last short one, over no floor. */
static inline int ready_to_fall(const tahr_mover *mover, const tahr_input *input, double dt, const tahr_state *s,
                                const tahr_report *report)
{
    static const tahr_floor none = {.body = TAHR_NO_BODY};
    const tahr__held *held = &mover->pace.held;
    const tahr__dive *dive = &mover->dive;
    tahr__words other = words_or(other_memory(s, &mover->pace.bare), other_head(&dive->asked, input));
    other = words_or(other, other_words(&s->orientation, held, offsetof(tahr__held, mode)));
    other = words_or(other, other_words(&s->floor, &none, sizeof none));
    uint64_t odd = other_company(mover) | bits_of(s->jump_hold);
    odd |= (s->mode ^ (uint32_t)TAHR_MODE_FALLING) | ((s->flags & dive->odd_flags) ^ dive->held_flags);
    odd |= other_asked(&dive->asked, input, dt) | other_report(report);
    return odd == 0 && words_are_zero(other) &&
           are_within(length_squared(s->position) + length_squared(s->floor_position), length_squared(s->velocity));
}

#endif
