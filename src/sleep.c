/* SPDX-License-Identifier: MIT
 * sleep.c: a step that left everything as it was is not computed again.
 *
 * A step is a function of world, config, input, dt and state. If it returned the state it was given, it will again, for
 * as long as none of the others changes: no threshold, no timer, no drift. */
#include "sleep.h"

#include <string.h>

#include "arguments.h"
#include "neighbours.h"

/* Can what was noted be told in this report, which may be NULL? A trace wants to see the step. */
static int report_suits(const tahr__sleep *s, const tahr_report *report)
{
    if (!report || !s->noted) {
        return s->noted == 1;
    }
    const uint32_t capacity = report->events ? report->event_capacity : 0;
    return report->struct_size >= sizeof *report && !report->decisions && !report->queries && capacity == s->noted - 1;
}

/* All that the noted step told but queries. */
static void tell(const tahr__sleep *s, tahr_report *report)
{
    if (!report) {
        return;
    }
    const size_t counts = offsetof(tahr_report, event_capacity); /* the arrays before it are the caller's */
    report->flags = s->report.flags;
    memcpy((char *)report + counts, (const char *)&s->report + counts, sizeof *report - counts);
    for (uint32_t i = 0; i < s->report.event_count; i++) {
        report->events[i] = s->events[i];
    }
}

int tahr__sleep_again(const tahr__sleep *s, tahr_report *report, tahr_status *status)
{
    if (!report_suits(s, report)) {
        return 0;
    }
    tell(s, report);
    *status = s->status;
    return 1;
}

/* What equals the arguments of the noted step was checked with them; only a longer input or report may hold something
 * else. */
tahr_status tahr__step_same(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                            tahr_report *report)
{
    const tahr__sleep *s = &mover->sleep;
    if (!report_suits(s, report)) {
        return tahr__step_awake(mover, input, dt, state, report);
    }
    if (input->struct_size != sizeof *input || (report && report->struct_size != sizeof *report)) {
        tahr_status status = tahr__check_arguments(mover, input, dt, state, report);
        if (status < 0) {
            return status;
        }
    }
    tell(s, report);
    return s->status;
}

tahr_status tahr__step_noted(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                             tahr_report *report)
{
    const tahr_world *world = mover->world;
    const int alone = !world->recording && !(mover->company && mover->company->neighbours);
    return alone && sleeps_on(&mover->sleep, world_revision(world), input, dt, state)
               ? tahr__step_same(mover, input, dt, state, report)
               : tahr__step_awake(mover, input, dt, state, report);
}

/* Input of a newer caller may have a tail, which is zero. */
void tahr__sleep_note(tahr_mover *mover, const tahr__step *step, double dt, const tahr_state *state, int changed)
{
    tahr__sleep *s = &mover->sleep;
    const tahr_report *r = &step->report;
    const size_t base_at = offsetof(tahr_state, base);
    /* Where a base that the core has no note of is, only the next step asks. */
    uint32_t base = step->state.base.body;
    changed |= base != TAHR_NO_BODY && base >= mover->world->body_count;
    /* A caller's own mode may depend on what the core cannot see. */
    changed |= mover->custom.run && (state->mode == TAHR_MODE_CUSTOM || (step->input->flags & TAHR_INPUT_MODE));
    if (changed || !mover->config.sleep || r->decisions || r->queries || r->event_count > TAHR__SLEEP_EVENTS ||
        r->event_capacity == UINT32_MAX) {
        return;
    }
    s->blank =
        memcmp((const char *)state + base_at, (const char *)&tahr__blank + base_at, sizeof *state - base_at) == 0;
    mover->dozes =
        s->wide && s->blank && step->input->struct_size == sizeof s->input && step->input->flags == 0 ? 2 : 1;
    s->noted = 1 + r->event_capacity;
    s->dt = dt;
    s->revision = world_revision(mover->world);
    s->status = (int16_t)tahr__step_status(r->flags);
    s->state = *state;
    s->input = *step->input;
    s->report = (tahr_report){.flags = r->flags | TAHR_REPORT_ASLEEP,
                              .event_capacity = r->event_capacity,
                              .event_count = r->event_count,
                              .events_lost = r->events_lost,
                              .slides = r->slides,
                              .arcs = r->arcs,
                              .slices = r->slices,
                              .step_offset = r->step_offset,
                              .residual = r->residual,
                              .time_lost = r->time_lost,
                              .saved[TAHR_SHORTCUT_SLEEP] = 1};
    if (r->event_count > 0) {
        memcpy(s->events, r->events, r->event_count * sizeof s->events[0]);
    }
}
