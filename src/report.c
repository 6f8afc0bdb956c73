/* SPDX-License-Identifier: MIT
 * report.c: writing events, decisions and queries into the caller's arrays; what does not fit is counted. */
#include "report.h"

#include "push.h"

void tahr__event(tahr__step *step, uint32_t type, const tahr_hit *hit, double value)
{
    tahr_report *r = &step->report;
    if (!r->events) {
        return;
    }
    int push = type == TAHR_EVENT_HIT && hit && step->world->has & TAHR__HAS_BASES;
    if (r->event_count == r->event_capacity) {
        r->events_lost++;
        r->flags |= TAHR_REPORT_TRUNCATED;
        if (push) {
            tahr__report_push(step, hit, value); /* counts as lost too */
        }
        return;
    }
    tahr_event event = {.type = type,
                        .body = hit ? hit->body : TAHR_NO_BODY,
                        .feature = hit ? hit->feature : 0,
                        .surface = hit ? hit->surface : 0,
                        .time = min_of(step->time + step->ahead, step->dt), /* a sum of slices may be off by rounding */
                        .value = value,
                        .position = step->state.position};
    if (hit) {
        event.normal = hit->normal;
    }
    if (type == TAHR_EVENT_PUSHED) {
        event.position = hit->point;
    }
    /* A world whose answers contradict each other may let a floor end before something that was met on it. */
    if (r->event_count > 0) {
        event.time = max_of(event.time, r->events[r->event_count - 1].time);
    }
    r->events[r->event_count++] = event;
    if (push) {
        tahr__report_push(step, hit, value);
    }
}

void tahr__event_at(tahr__step *step, const tahr_event *event)
{
    tahr_report *r = &step->report;
    if (!r->events) {
        return;
    }
    const double time = min_of(event->time, step->dt);
    uint32_t at = r->event_count;
    while (at > 0 && r->events[at - 1].time > time) {
        at--;
    }
    if (r->event_count == r->event_capacity) {
        r->events_lost++;
        r->flags |= TAHR_REPORT_TRUNCATED;
        if (at == r->event_count) {
            return;
        }
    } else {
        r->event_count++;
    }
    for (uint32_t i = r->event_count - 1; i > at; i--) {
        r->events[i] = r->events[i - 1];
    }
    r->events[at] = *event;
    r->events[at].time = time;
}

void tahr__record(tahr__step *step, const tahr_query_record *record)
{
    tahr_report *r = &step->report;
    if (r->query_count == r->query_capacity) {
        r->queries_lost++;
        r->flags |= TAHR_REPORT_TRUNCATED;
        return;
    }
    r->queries[r->query_count++] = *record;
}

int tahr__trace(tahr__step *step, uint32_t rule, int accepted, const tahr_hit *hit, double value, double limit,
                const char *reason)
{
    tahr_report *r = &step->report;
    if (r->decision_count == r->decision_capacity) {
        r->decisions_lost++;
        r->flags |= TAHR_REPORT_TRUNCATED;
        return accepted;
    }
    tahr_decision decision = {.rule = rule,
                              .accepted = accepted != 0,
                              .body = hit ? hit->body : TAHR_NO_BODY,
                              .feature = hit ? hit->feature : 0,
                              .value = value,
                              .limit = limit,
                              .reason = reason};
    if (hit) {
        decision.normal = hit->normal;
        decision.point = hit->point;
    }
    r->decisions[r->decision_count++] = decision;
    return accepted;
}
