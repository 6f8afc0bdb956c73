/* SPDX-License-Identifier: MIT
 * score_path.c: paths against a reference and against what is there. */
#include "score_distance.h"

/* m: how far from a character things are looked for where nobody says. */
static const double DEFAULT_REACH = 1;

/* Idle steps until a character must not move any more. */
enum { SETTLED = 3 };

static tahr_vec3 minus(tahr_vec3 a, tahr_vec3 b)
{
    return (tahr_vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}

static double product(tahr_vec3 a, tahr_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static double length_of(tahr_vec3 v)
{
    return sqrt(product(v, v));
}

static int is_finite(tahr_vec3 v)
{
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

static double hermite(double p0, double p1, double m0, double m1, double s)
{
    double r = 1 - s;
    return p0 * r * r * (1 + 2 * s) + p1 * s * s * (1 + 2 * r) + m0 * s * r * r - m1 * s * s * r;
}

tahr_vec3 score_reference_at(const score_reference *reference, double time)
{
    const score_knot *k = reference->knots;
    uint32_t lo = 0, hi = reference->count - 1;

    if (time <= k[0].time) {
        return k[0].position;
    }
    if (time >= k[hi].time) {
        return k[hi].position;
    }
    while (hi - lo > 1) {
        uint32_t mid = (lo + hi) / 2;
        if (k[mid].time <= time) {
            lo = mid;
        } else {
            hi = mid;
        }
    }
    const score_knot *a = &k[lo], *b = &k[hi];
    double h = b->time - a->time, s = h > 0 ? (time - a->time) / h : 0;
    return (tahr_vec3){hermite(a->position.x, b->position.x, a->velocity.x * h, b->velocity.x * h, s),
                       hermite(a->position.y, b->position.y, a->velocity.y * h, b->velocity.y * h, s),
                       hermite(a->position.z, b->position.z, a->velocity.z * h, b->velocity.z * h, s)};
}

/* J/kg; heights are over origin: those over a far one would cost digits. */
static double energy(const score_path *path, const score_step *step, tahr_vec3 origin)
{
    return 0.5 * product(step->velocity, step->velocity) -
           product(path->desc.gravity, minus(step->place.position, origin));
}

static void take_clearance(score_path *path, const score_step *step)
{
    double reach = path->desc.reach > 0 ? path->desc.reach : DEFAULT_REACH;

    if (!path->desc.scene) {
        return;
    }
    double distance = score_distance(path->desc.scene, &step->place, 0, reach);
    if (distance < path->clearance) {
        path->clearance = distance;
    }
    if (-distance > path->deepest) {
        path->deepest = -distance;
    }
}

void score_path_start(score_path *path, const score_path_desc *desc, const score_step *start)
{
    *path = (score_path){.desc = *desc, .clearance = INFINITY};
    path->last = path->before = *start;
    path->stood = start->grounded;
    take_clearance(path, start);
    path->started = 1;
}

static void take_rest(score_path *path, const score_step *step)
{
    tahr_vec3 now = step->place.position, last = path->last.place.position, before = path->before.place.position;

    path->idle_steps = step->idle ? path->idle_steps + 1 : 0;
    if (path->idle_steps <= SETTLED) {
        return;
    }
    if (now.x != last.x || now.y != last.y || now.z != last.z) {
        path->rest_changes++;
    }
    if (path->idle_steps > SETTLED + 1) {
        path->jitter = fmax(path->jitter, length_of(minus(minus(now, last), minus(last, before))));
    }
}

static void take_failures(score_path *path, const score_step *step)
{
    uint32_t bits = step->failures;

    if (!is_finite(step->place.position) || !is_finite(step->velocity)) {
        bits |= 1u << SCORE_NOT_FINITE;
    }
    for (int i = 0; i < SCORE_FAILURES; i++) {
        path->failures[i] += bits >> i & 1u;
    }
    path->failed_steps += bits != 0;
}

/* The energy of a step is measured along the way from the last one, so that it needs no origin. */
static void take_energy(score_path *path, const score_step *step)
{
    tahr_vec3 last = path->last.place.position;
    double gain = energy(path, step, last) - energy(path, &path->last, last) - step->work;

    path->surplus = fmax(path->surplus + gain, 0); /* over the lowest so far */
    path->energy_excess = fmax(path->energy_excess, path->surplus);
}

void score_path_add(score_path *path, const score_step *step)
{
    path->steps++;
    path->duration = step->time;
    take_failures(path, step);
    score_stat_add(&path->queries, step->queries);
    if (!is_finite(step->place.position) || !is_finite(step->velocity)) {
        return;
    }
    if (path->desc.reference) {
        tahr_vec3 due = score_reference_at(path->desc.reference, step->time);
        path->end_error = length_of(minus(step->place.position, due));
        score_stat_add(&path->error, path->end_error);
    }
    take_clearance(path, step);
    take_rest(path, step);
    take_energy(path, step);
    path->length += length_of(minus(step->place.position, path->last.place.position));
    path->ground_flips += (step->grounded != 0) != (path->stood != 0);
    path->stood = step->grounded;
    path->before = path->last;
    path->last = *step;
}

double score_path_flips_per_second(const score_path *path)
{
    return path->duration > 0 ? path->ground_flips / path->duration : 0;
}

void score_path_free(score_path *path)
{
    score_stat_free(&path->error);
    score_stat_free(&path->queries);
}

static uint32_t failures_of(tahr_status status, const tahr_report *report)
{
    static const struct {
        uint32_t flag;
        int failure;
    } table[] = {{TAHR_REPORT_UNKNOWN, SCORE_UNKNOWN},
                 {TAHR_REPORT_STUCK, SCORE_STUCK},
                 {TAHR_REPORT_CRUSHED, SCORE_CRUSHED},
                 {TAHR_REPORT_QUERY_CAP, SCORE_CAP}};
    uint32_t bits = status < 0 ? 1u << SCORE_ERROR : 0;

    for (size_t i = 0; report && status >= 0 && i < sizeof table / sizeof *table; i++) {
        bits |= report->flags & table[i].flag ? 1u << table[i].failure : 0;
    }
    return bits;
}

score_step score_step_of(const tahr_state *state, const tahr_shape *shape, double time, tahr_status status,
                         const tahr_report *report)
{
    score_step step = {.time = time, .velocity = state->velocity, .failures = failures_of(status, report)};

    step.place.position = state->position;
    step.place.up = state->up;
    step.place.orientation = state->orientation;
    step.place.shape = *shape;
    step.place.shape.radius = state->radius;
    step.place.shape.half_height = state->half_height;
    step.grounded = state->mode == TAHR_MODE_WALKING;
    if (report && status >= 0) {
        step.queries = report->sweeps + report->contact_queries + report->rays + report->fluid_queries;
    }
    return step;
}
