/* SPDX-License-Identifier: MIT
 * wading.c: one slice of walking in a world with fluids. */
#include "swimming.h"

#include "floor.h"
#include "report.h"
#include "walking.h"

/* Of the immersion: nearer to the line than this is on it (0.2 mm of a character of two metres). */
static const double ON_THE_LINE = 1e-4;

/* Walks from the begin to the line at most, by the rule of false position. */
enum { TRIES = 6 };

/* What a walk that leads too deep must forget. Queries stay counted. */
typedef struct before {
    tahr_state state;
    tahr_report report;
    double time, push_left;
    uint32_t just_teleported, iterations, apexes; /* STEPPED */
} before;

static before before_of(const tahr__step *step)
{
    before b = {.state = step->state,
                .report = step->report,
                .time = step->time,
                .push_left = step->push_left,
                .just_teleported = step->just_teleported,
                .iterations = step->iterations,
                .apexes = step->apexes};
    return b;
}

static void go_back(tahr__step *step, const before *b)
{
    const tahr_report now = step->report;
    step->state = b->state;
    step->report = b->report;
    step->report.sweeps = now.sweeps;
    step->report.contact_queries = now.contact_queries;
    step->report.rays = now.rays;
    step->report.fluid_queries = now.fluid_queries;
    step->report.query_count = now.query_count;
    step->report.queries_lost = now.queries_lost;
    step->report.decision_count = now.decision_count;
    step->report.decisions_lost = now.decisions_lost;
    step->report.flags |= now.flags & (TAHR_REPORT_UNKNOWN | TAHR_REPORT_QUERY_CAP);
    step->time = b->time;
    step->push_left = b->push_left;
    step->just_teleported = b->just_teleported;
    step->iterations = b->iterations;
    step->apexes = b->apexes;
    step->ahead = 0;
}

/* On the edge of a ledge the foot still hangs below it. */
double tahr__standing_immersion(tahr__step *step)
{
    const tahr_floor *floor = &step->state.floor;
    vec3 up = step->state.up, n = floor->surface_normal;
    double m = tahr__fluid(step, step->state.position).immersion;
    if (m <= 0 || !floor_is_walkable(floor) || dot(n, up) < 0.1) {
        return m;
    }
    double lift = dot(n, sub(floor->point, step_foot(step))) / dot(n, up);
    return m - max_of(lift, 0) / (2 * step->limits->shape.half_height);
}

static tahr__next swim_on(tahr__step *step, double left)
{
    tahr__next next = {TAHR_MODE_SWIMMING, left};
    tahr__begin_swimming(step);
    return next;
}

/* Walks again, and only as far as the line. deep: the immersion where the whole walk ends. */
static tahr__next walk_to_line(tahr__step *step, double time, double line, double deep)
{
    const before begin = before_of(step);
    double shallow = tahr__standing_immersion(step);
    double from = 0, to = time, t = 0;
    tahr__next next;
    for (int i = 0; i < TRIES && shallow < line; i++) {
        go_back(step, &begin);
        t = from + (to - from) * (line - shallow) / (deep - shallow);
        next = tahr__walk(step, t);
        if (next.mode != TAHR_MODE_WALKING) {
            next.time_left += time - t;
            return next;
        }
        double m = tahr__standing_immersion(step);
        if (step->error < 0 || (m - line < ON_THE_LINE && line - m < ON_THE_LINE)) {
            break;
        }
        if (m < line) {
            from = t;
            shallow = m;
        } else {
            to = t;
            deep = m;
        }
    }
    return swim_on(step, time - t);
}

tahr__next tahr__wade(tahr__step *step, double time)
{
    const before begin = before_of(step);
    double line = tahr__swim_line(step->config);
    tahr__next next = tahr__walk(step, time);
    if (next.mode != TAHR_MODE_WALKING || (step->report.flags & TAHR_REPORT_CACHED_FLOOR)) {
        return next; /* what stands where it stood is where it was */
    }
    double m = tahr__standing_immersion(step);
    if (m < line || step->error < 0 || (step->report.flags & TAHR_REPORT_QUERY_CAP)) {
        return next;
    }
    tahr__decide(step, TAHR_RULE_FLUID, 1, NULL, m, line, "deep enough to swim");
    go_back(step, &begin);
    return walk_to_line(step, time, line, m);
}
