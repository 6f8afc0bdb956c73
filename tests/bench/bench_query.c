/* SPDX-License-Identifier: MIT
 * bench_query.c: asks what wandering characters asked, one query at a time, and times and scores the answers.
 *
 * A hit is right if the exact backend stops there too, with the margin asked for or one a micrometre off: fractions
 * alone say nothing where a graze turns rounding into a long way. How right it is says the backward error: how far from
 * its margin the shape is where the answer stops it, measured by the contacts of the exact backend at that place. A
 * one-way body counts there only if it is what stopped the sweep. */
#include "bench_query.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { WALKERS = 16, RECORDS = 320, MAX_TICKS = 4000, ROUNDS = 5, NEAR = 64 };

static const double DT = 1.0 / 60;
static const double TAU = 1e-6; /* m: what another margin of as much also says is neither a miss nor a false hit */

static double processor_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void keep(bench_queries *b, const tahr_query_record *r, const tahr_state *s)
{
    if (r->type == TAHR_QUERY_SWEEP && r->margin > 0 && b->sweep_count < BENCH_MAX_QUERIES) {
        b->sweeps[b->sweep_count++] = (tahr_sweep){.shape = r->shape,
                                                   .position = r->position,
                                                   .up = s->up,
                                                   .orientation = s->orientation,
                                                   .motion = r->motion,
                                                   .margin = r->margin,
                                                   .mask = 0xFFFFFFFFu,
                                                   .ignore_body = TAHR_NO_BODY};
    } else if (r->type == TAHR_QUERY_CONTACTS && b->contact_count < BENCH_MAX_QUERIES) {
        b->contacts[b->contact_count++] = (tahr_contact_query){.shape = r->shape,
                                                               .position = r->position,
                                                               .up = s->up,
                                                               .orientation = s->orientation,
                                                               .margin = r->margin,
                                                               .mask = 0xFFFFFFFFu,
                                                               .ignore_body = TAHR_NO_BODY};
    }
}

static int record(bench_queries *b, const tahr_config *config, tahr_mover *mover, char *error)
{
    static tahr_query_record records[RECORDS];
    uint64_t seed = 23;
    for (uint32_t i = 0; i < WALKERS; i++) {
        scene_wanderer wanderer;
        tahr_state state;
        if (!scene_wander_spawn(b->exact, config, &b->world->spawn, &seed, &state)) {
            snprintf(error, 256, "no place to start at");
            return 0;
        }
        scene_wander_start(&wanderer, 1, i);
        for (uint32_t t = 0; t < MAX_TICKS && b->sweep_count < (i + 1) * BENCH_MAX_QUERIES / WALKERS; t++) {
            tahr_report report = {.struct_size = sizeof report, .queries = records, .query_capacity = RECORDS};
            if (tahr_mover_step(mover, bench_world_wish(b->world, &wanderer, DT), DT, &state, &report) < 0) {
                snprintf(error, 256, "a step failed");
                return 0;
            }
            for (uint32_t k = 0; k < report.query_count; k++) {
                keep(b, &records[k], &state);
            }
        }
    }
    return 1;
}

/* A world of the same bodies that block from all sides. */
static tahr_status open_plain(bench_queries *b, const scene_backend *exact)
{
    const bench_world *w = b->world;
    tahr_body_desc *bodies = malloc(w->body_count * sizeof *bodies);
    if (!bodies) {
        return TAHR_E_MEMORY;
    }
    memcpy(bodies, bench_world_bodies(w, exact), w->body_count * sizeof *bodies);
    for (uint32_t i = 0; i < w->body_count; i++) {
        bodies[i].flags &= ~(uint32_t)TAHR_BODY_ONE_WAY;
    }
    tahr_status status = scene_backend_open(exact, bodies, w->body_count, NULL, &b->plain);
    free(bodies);
    return status;
}

int bench_queries_make(bench_queries *b, const bench_world *world, char *error)
{
    static const scene_backend exact = {.name = "exact", .get = tahr_backend_v1_native, .native = 1};
    tahr_config config;
    tahr_mover *mover = NULL;
    memset(b, 0, sizeof *b);
    b->world = world;
    bench_world_config(world, &config);
    tahr_status status =
        scene_backend_open(&exact, bench_world_bodies(world, &exact), world->body_count, NULL, &b->exact);
    if (status >= 0) {
        status = open_plain(b, &exact);
    }
    if (status >= 0) {
        status = tahr_mover_create(b->exact, &config, &mover);
    }
    if (status < 0) {
        snprintf(error, 256, "%s", tahr_status_name(status));
    }
    int ok = status >= 0 && record(b, &config, mover, error);
    tahr_mover_destroy(mover);
    if (!ok) {
        bench_queries_free(b);
    }
    return ok;
}

void bench_queries_free(bench_queries *b)
{
    tahr_world_close(b->exact);
    tahr_world_close(b->plain);
    b->exact = b->plain = NULL;
}

static int is_one_way(const bench_queries *b, uint32_t body)
{
    const scene_tiles *tiles = b->world->tiles;
    return tiles && body < SCENE_TILE_BODIES && (tiles->bodies[body].flags & TAHR_BODY_ONE_WAY) != 0;
}

/* How far the shape is from the nearest surface after a part of a sweep, of one-way bodies only that of stopped_by;
 * HUGE_VAL if nothing is near. */
static double clearance(const bench_queries *b, const tahr_sweep *q, double fraction, uint32_t stopped_by)
{
    tahr_contact near[NEAR];
    uint32_t count = 0;
    tahr_contact_query c = {.shape = q->shape,
                            .position = {q->position.x + q->motion.x * fraction, q->position.y + q->motion.y * fraction,
                                         q->position.z + q->motion.z * fraction},
                            .up = q->up,
                            .orientation = q->orientation,
                            .margin = q->margin + 0.1,
                            .mask = q->mask,
                            .ignore_body = q->ignore_body};
    if (tahr_world_contacts(b->plain, &c, near, NEAR, &count) < 0) {
        return HUGE_VAL;
    }
    for (uint32_t i = 0; i < count; i++) { /* the nearest first */
        if (near[i].body == stopped_by || !is_one_way(b, near[i].body)) {
            return near[i].distance;
        }
    }
    return HUGE_VAL;
}

/* Beyond the end of every sweep: there was no hit. */
static const double NONE = 2;

/* The exact answer with another margin: the fraction of its hit, NONE if there is none. */
static double exact_fraction(const bench_queries *b, const tahr_sweep *q, double margin, tahr_hit *hit)
{
    tahr_sweep other = *q;
    uint32_t count = 0;
    other.margin = margin > 0 ? margin : 0;
    memset(hit, 0, sizeof *hit);
    hit->body = TAHR_NO_BODY;
    return tahr_world_sweep(b->exact, &other, hit, 1, &count) < 0 || count == 0 ? NONE : hit->fraction;
}

/* What margins that differ by TAU make of the exact answer, and TAU of the way. Not every difference is in the order of
 * the margins: a one-way body is there or not by the distance at the start. */
typedef struct bracket {
    tahr_hit hit;       /* with the margin that was asked for */
    double first, last; /* fractions between which a hit is right within TAU, NONE: it may be free */
} bracket;

static bracket exact_answer(const bench_queries *b, const tahr_sweep *q)
{
    bracket answer;
    tahr_hit hit;
    double way = sqrt(q->motion.x * q->motion.x + q->motion.y * q->motion.y + q->motion.z * q->motion.z);
    answer.first = answer.last = exact_fraction(b, q, q->margin, &answer.hit);
    for (int sign = -1; sign <= 1; sign += 2) {
        double fraction = exact_fraction(b, q, q->margin + sign * TAU, &hit);
        answer.first = fraction < answer.first ? fraction : answer.first;
        answer.last = fraction > answer.last ? fraction : answer.last;
    }
    answer.first -= way > 0 ? TAU / way : 0;
    answer.last += way > 0 ? TAU / way : 0;
    return answer;
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Whether both say that it overlaps at the start, beyond TAU, and how deep. */
static void score_overlap(const tahr_hit *hit, const tahr_hit *exact, bench_query_result *r)
{
    double depth = hit->start_overlap ? hit->depth : 0, other = exact->start_overlap ? exact->depth : 0;
    double off = fabs(depth - other);
    r->overlaps += exact->start_overlap;
    r->depth_max = off > r->depth_max ? off : r->depth_max;
    r->misses += other > TAU && !hit->start_overlap;
    r->false_hits += depth > TAU && !exact->start_overlap;
}

/* How far off its margin a sweep stops. What was nearer from the start may be as near as it was: not approached, it
 * does not block, and another surface did. */
static double stop_gap(const bench_queries *b, const tahr_sweep *q, const tahr_hit *hit)
{
    double stop = clearance(b, q, hit->fraction, hit->body), start = clearance(b, q, 0, hit->body);
    double off = fabs(stop - q->margin);
    return start < q->margin && fabs(stop - start) < off ? fabs(stop - start) : off;
}

/* Every sweep is scored. One that began within its margin and stops there has no gap to measure. */
static void score(const bench_queries *b, const tahr_hit *hits, const uint32_t *counts, bench_query_result *r)
{
    static double gaps[BENCH_MAX_QUERIES];
    static const tahr_hit nothing;
    uint32_t measured = 0;
    for (uint32_t i = 0; i < b->sweep_count; i++) {
        const tahr_sweep *q = &b->sweeps[i];
        const tahr_hit *hit = counts[i] ? &hits[i] : &nothing;
        double fraction = counts[i] ? hit->fraction : NONE;
        bracket exact = exact_answer(b, q);
        r->hits += fraction < NONE;
        r->at_start += fraction <= 0;
        r->misses += fraction > exact.last;
        r->false_hits += fraction < exact.first;
        double gap = fraction < NONE ? stop_gap(b, q, hit) : 0;
        if (fraction < NONE && (fraction > 0 || gap > 0)) {
            gaps[measured++] = gap;
        }
    }
    qsort(gaps, measured, sizeof gaps[0], by_value);
    r->gap_p50 = measured ? gaps[measured / 2] : 0;
    r->gap_p99 = measured ? gaps[measured - 1 - measured / 100] : 0;
    r->gap_max = measured ? gaps[measured - 1] : 0;
}

/* Wanderers overlap nothing: where the exact answers stop, a margin and a half farther on, they would. */
static tahr_status score_sunk(const bench_queries *b, tahr_world *world, bench_query_result *r)
{
    for (uint32_t i = 0; i < b->sweep_count; i++) {
        tahr_sweep q = b->sweeps[i];
        tahr_hit exact, hit = {0};
        uint32_t count;
        double fraction = exact_fraction(b, &q, q.margin, &exact), sunk = 1.5 * q.margin;
        if (fraction >= NONE) {
            continue;
        }
        q.position.x += q.motion.x * fraction - exact.normal.x * sunk;
        q.position.y += q.motion.y * fraction - exact.normal.y * sunk;
        q.position.z += q.motion.z * fraction - exact.normal.z * sunk;
        q.motion = (tahr_vec3){0, 0, 0};
        exact_fraction(b, &q, q.margin, &exact);
        tahr_status status = tahr_world_sweep(world, &q, &hit, 1, &count);
        if (status < 0) {
            return status;
        }
        score_overlap(&hit, &exact, r);
    }
    return TAHR_OK;
}

/* The least of some rounds: on a machine shared with others the rest is their noise. */
static tahr_status time_sweeps(const bench_queries *b, tahr_world *world, tahr_hit *hits, uint32_t *counts, double *ns)
{
    for (int round = 0; round < ROUNDS; round++) {
        double before = processor_seconds();
        for (uint32_t i = 0; i < b->sweep_count; i++) {
            tahr_status status = tahr_world_sweep(world, &b->sweeps[i], &hits[i], 1, &counts[i]);
            if (status < 0) {
                return status;
            }
        }
        double each = 1e9 * (processor_seconds() - before) / b->sweep_count;
        *ns = round == 0 || each < *ns ? each : *ns;
    }
    return TAHR_OK;
}

static tahr_status time_contacts(const bench_queries *b, tahr_world *world, double *ns)
{
    tahr_contact contacts[16];
    uint32_t count;
    for (int round = 0; round < ROUNDS && b->contact_count > 0; round++) {
        double before = processor_seconds();
        for (uint32_t i = 0; i < b->contact_count; i++) {
            tahr_status status = tahr_world_contacts(world, &b->contacts[i], contacts, 16, &count);
            if (status < 0) {
                return status;
            }
        }
        double each = 1e9 * (processor_seconds() - before) / b->contact_count;
        *ns = round == 0 || each < *ns ? each : *ns;
    }
    return TAHR_OK;
}

tahr_status bench_queries_run(const bench_queries *b, const bench_world *world, const scene_backend *backend,
                              bench_query_result *result)
{
    static tahr_hit hits[BENCH_MAX_QUERIES];
    static uint32_t counts[BENCH_MAX_QUERIES];
    tahr_world *opened = NULL;
    memset(result, 0, sizeof *result);
    tahr_status status =
        scene_backend_open(backend, bench_world_bodies(world, backend), world->body_count, NULL, &opened);
    if (status >= 0) {
        status = time_sweeps(b, opened, hits, counts, &result->sweep_ns);
    }
    if (status >= 0) {
        status = time_contacts(b, opened, &result->contacts_ns);
    }
    if (status >= 0) {
        score(b, hits, counts, result);
        status = score_sunk(b, opened, result);
    }
    tahr_world_close(opened);
    result->sweeps = b->sweep_count;
    result->contact_queries = b->contact_count;
    return status;
}
