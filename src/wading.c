/* SPDX-License-Identifier: MIT
 * wading.c: one slice of walking in a world with fluids. */
#include "swimming.h"

#include "floor.h"
#include "report.h"
#include "scope.h"
#include "walking.h"

/* Of the immersion: nearer to the line than this is on it (0.2 mm of a character of two metres). */
static const double ON_THE_LINE = 1e-4;

/* Walks from the begin to the line at most, by the rule of false position. */
enum { TRIES = 6 };

/* What a walk that leads too deep must forget. */
typedef struct before {
    tahr__scope scope;
    double time, time_lost;
    uint32_t just_teleported, iterations, apexes; /* STEPPED */
} before;

static void remember(tahr__step *step, before *b)
{
    tahr__scope_open(step, &b->scope);
    b->time = step->time;
    b->time_lost = step->report.time_lost;
    b->just_teleported = step->just_teleported;
    b->iterations = step->iterations;
    b->apexes = step->apexes;
}

static void go_back(tahr__step *step, const before *b)
{
    tahr__scope_revert(step, &b->scope);
    step->time = b->time;
    step->report.time_lost = b->time_lost;
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
static tahr__next walk_to_line(tahr__step *step, const before *begin, double time, double line, double deep)
{
    double shallow = tahr__standing_immersion(step);
    double from = 0, to = time, t = 0;
    tahr__next next;
    for (int i = 0; i < TRIES && shallow < line; i++) {
        go_back(step, begin);
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
    before begin;
    double line = tahr__swim_line(step->config);
    remember(step, &begin);
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
    return walk_to_line(step, &begin, time, line, m);
}
