/* SPDX-License-Identifier: MIT
 * scope.c: taking motions back. */
#include "scope.h"

void tahr__scope_revert(tahr__step *step, const tahr__scope *scope)
{
    tahr_state *s = &step->state;
    tahr_report *r = &step->report;
    uint32_t stays = TAHR_REPORT_UNKNOWN | TAHR_REPORT_QUERY_CAP;
    if (r->decisions_lost > 0 || r->queries_lost > 0) {
        stays |= TAHR_REPORT_TRUNCATED;
    }
    s->position = scope->position;
    s->velocity = scope->velocity;
    s->floor_position = scope->floor_position;
    s->floor_revision = scope->floor_revision;
    s->floor = scope->floor;
    s->flags = scope->state_flags;
    r->flags = scope->report_flags | (r->flags & stays);
    r->event_count = scope->event_count;
    r->events_lost = scope->events_lost;
    r->slides = scope->slides;
    r->arcs = scope->arcs;
    r->step_offset = scope->step_offset;
    r->residual = scope->residual;
    step->just_teleported = scope->just_teleported;
    step->ahead = scope->ahead;
    if (step->trail) {
        tahr__trail_forget(step, scope->legs);
    }
}
