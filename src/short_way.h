/* SPDX-License-Identifier: MIT
 * short_way.h: the steps that most steps are, in one go: a walk with nothing in its way (stroll.h), a fall with nothing
 * below (plummet.h). What is left out of the long way (mover.c, walking.c, falling.c) is what finds nothing to do in
 * such a step; what is decided here is decided there by the same operations, so that the bits are the same; and
 * whatever is not plainly so goes there. */
#ifndef TAHR_SHORT_WAY_H
#define TAHR_SHORT_WAY_H

#include "core.h"
#include "neighbours.h"
#include "report.h"
#include "turning.h"

/* Of an arc that falling.c cuts into more chords than this the long way is no detour: 10 Hz are 5 at most. */
enum { TAHR__MOST_CHORDS = 6 };

/* May steps of this mover be such, where nothing special is near (calm.h)? Asked once. No query. */
int tahr__may_go_short_way(const tahr_world *world, const tahr_config *config, const tahr__limits *limits);

/* What a stroll asks of them, and a plummet. */
tahr__pace tahr__pace_of(const tahr_config *config, const tahr__limits *limits);
tahr__dive tahr__dive_of(const tahr_config *config, const tahr__limits *limits);

/* A step of a state that remembers nothing and faces where it will, with an input that asks for nothing but a
 * direction, both checked. [out] state, report (or NULL). Returns 1; 0: it is not such a step, or it is not known to
 * be; nothing was written. What counts as two sweeps, and as one. */
int tahr__stroll(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state, tahr_report *report);
int tahr__plummet(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state, tahr_report *report);

/* tahr_mover_step, input and state not NULL, of who takes quick steps (tahr__is_quick). */
tahr_status tahr__quick_step(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                             tahr_report *report);
/* The same where the processor has 32-byte vectors (tahr__is_wide). */
tahr_status tahr__quick_step_wide(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                                  tahr_report *report);

/* The long way, of arguments that are checked. plain: the state remembers nothing, and nothing was asked for but to go
 * and to jump. */
tahr_status tahr__take_step(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                            tahr_report *report, int plain);

/* The announcement of the long way, before it is known to be short. Returns 1; 0: that failed, and will again. */
int tahr__announce_early(tahr_mover *mover, double dt, const tahr_state *state, tahr_query_context *context);

/* Has a short walk come to no other place? Seldom asked, and therefore far away. */
int tahr__stays(const tahr_vec3 *from, const tahr_vec3 *to);

/* Along walls and on rough ground steps are like the ones before: who went the long way and asked for more than a short
 * one knows is likely to do so again. And where the short way was tried in vain it is not for a while. */
static inline void tahr__note_long_way(tahr_mover *mover, const tahr_report *r, uint32_t mode)
{
    const uint32_t most = mode == TAHR_MODE_WALKING ? 2 : TAHR__MOST_CHORDS;
    mover->long_way = r->sweeps > most || r->slides > 0 || r->contact_queries > 0 || r->rays > 0;
}

/* Is the next step likely to be a short one like the last one? In one branch. */
static inline int tahr__is_quick(const tahr_mover *mover)
{
    return (mover->busy | mover->not_quick | mover->long_way | mover->short_way.rest) == 0;
}

/* All is in order, but the step is not ready to be a quick one. */
static inline int tahr__go_short_way(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                                     tahr_report *report)
{
    const int watched = mover->world->recording || (report && (report->decisions || report->queries));
    if (!mover->may_go_short_way || mover->long_way || watched || (mover->company && mover->company->neighbours) ||
        (state->mode != TAHR_MODE_FALLING && (input->jump | state->flags)) || !backoff_tries(&mover->short_way)) {
        return 0;
    }
    const tahr_quat before = state->orientation;
    if (input->flags) {
        tahr__turn_toward(input->facing, mover->config.turn_rate * dt, state);
    }
    const int done = state->mode == TAHR_MODE_WALKING   ? tahr__stroll(mover, input, dt, state, report)
                     : state->mode == TAHR_MODE_FALLING ? tahr__plummet(mover, input, dt, state, report)
                                                        : 0;
    if (!done) {
        state->orientation = before;
    }
    if (backoff_note(&mover->short_way, done)) {
        mover_wake(mover);
    }
    return done;
}

/* In a crowd others count on how far it goes. */
static inline int goes_astray(const tahr_mover *mover, vec3 position)
{
    return mover->company && company_strays(mover->company, position);
}

/* Of a step that asked for so many sweeps, and nothing came of them. shortcut: what spares them. */
static inline void tahr__report_short_way(tahr_report *r, uint32_t sweeps, uint32_t shortcut,
                                          const tahr_query_context *context)
{
    if (!r) {
        return;
    }
    tahr__report_clear(r);
    r->sweeps = sweeps;
    r->slices = 1;
    r->triangle_tests = context->narrow_tests;
    r->narrow_iterations = context->narrow_iterations;
    r->gathers = context->gathers;
    r->saved[shortcut] = (uint32_t)context->spared;
    if (shortcut == TAHR_SHORTCUT_KNOWN_FLOOR) { /* else no foot was asked for */
        r->saved[TAHR_SHORTCUT_CACHE] = (uint32_t)context->cached;
        r->saved[TAHR_SHORTCUT_CAPSULE_END] = (uint32_t)context->ends;
    }
}

#endif
