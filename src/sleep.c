/* SPDX-License-Identifier: MIT
 * sleep.c: a step that left everything as it was is not computed again.
 *
 * A step is a function of world, config, input, dt and state. If it returned the state it was given, it will again, for
 * as long as none of the others changes: no threshold, no timer, no drift. */
#include "sleep.h"

#include <string.h>

int tahr__sleeps_on(const tahr_mover *mover, const tahr_input *input, double dt, const tahr_state *state,
                    const tahr_report *report)
{
    const tahr__sleep *s = &mover->sleep;
    uint32_t capacity = report && report->events ? report->event_capacity : 0;
    if (!s->noted || dt != s->dt || tahr_world_revision(mover->world) != s->revision ||
        capacity != s->report.event_capacity) {
        return 0;
    }
    if (report && (report->decisions || report->queries)) {
        return 0; /* a trace wants to see the step */
    }
    return memcmp(state, &s->state, sizeof *state) == 0 && memcmp(input, &s->input, sizeof *input) == 0;
}

void tahr__sleep_report(const tahr_mover *mover, tahr_report *report)
{
    const tahr__sleep *s = &mover->sleep;
    tahr_report r = s->report;
    r.struct_size = report->struct_size;
    r.events = report->events;
    if (r.event_count > 0) {
        memcpy(r.events, s->events, r.event_count * sizeof s->events[0]);
    }
    *report = r;
}

/* Input of a newer caller may have a tail, which is zero. */
void tahr__sleep_note(tahr_mover *mover, const tahr__step *step, double dt, const tahr_state *state, int changed)
{
    tahr__sleep *s = &mover->sleep;
    const tahr_report *r = &step->report;
    /* Where a base that the core has no note of is, only the next step asks. */
    uint32_t base = step->state.base.body;
    changed |= base != TAHR_NO_BODY && base >= mover->world->body_count;
    /* A caller's own mode may depend on what the core cannot see. */
    changed |= mover->custom.run && (state->mode == TAHR_MODE_CUSTOM || (step->input->flags & TAHR_INPUT_MODE));
    s->noted = !changed && mover->config.sleep && !r->decisions && !r->queries && r->event_count <= TAHR__SLEEP_EVENTS;
    if (!s->noted) {
        return;
    }
    s->dt = dt;
    s->revision = tahr_world_revision(mover->world);
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
                              .time_lost = r->time_lost};
    if (r->event_count > 0) {
        memcpy(s->events, r->events, r->event_count * sizeof s->events[0]);
    }
}
