/* SPDX-License-Identifier: MIT
 * score_sweep.c: answers of sweeps judged against truth. */
#include "score_distance.h"

const double SCORE_TAU[SCORE_TAUS] = {1e-6, 1e-3};

const char *score_failure_name(int failure)
{
    static const char *const names[SCORE_FAILURES] = {"miss",    "false hit", "start", "not finite", "error",
                                                      "unknown", "cap",       "stuck", "crushed"};
    return failure >= 0 && failure < SCORE_FAILURES ? names[failure] : "?";
}

static int finite_vec(tahr_vec3 v)
{
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

static int finite_hit(const tahr_hit *hit)
{
    return isfinite(hit->fraction) && isfinite(hit->distance) && isfinite(hit->depth) && finite_vec(hit->normal) &&
           finite_vec(hit->surface_normal) && finite_vec(hit->point);
}

static double point_error(const score_scene *scene, const tahr_hit *hit)
{
    tahr_sweep at = {.shape = {.type = TAHR_SHAPE_SPHERE}, .position = hit->point};
    return fabs(score_distance(scene, &at, 0, INFINITY));
}

/* How far beyond the margin is what a free answer did not see; 0 or less: nothing that counts. */
static double missed(const score_truth *truth)
{
    if (truth->status == SCORE_OVERLAP) {
        return -truth->start_gap;
    }
    return truth->status == SCORE_HIT ? -truth->min_gap : 0;
}

static void measure(const score_scene *scene, const tahr_sweep *query, const score_truth *truth, const tahr_hit *hit,
                    double slack, score_answer *out)
{
    double gap = score_distance(scene, query, hit->fraction, INFINITY);
    double due = truth->start_gap < query->margin ? truth->start_gap : query->margin;

    out->measured = 1;
    if (truth->status == SCORE_OVERLAP) { /* stays where it is: what counts is the way out */
        out->gap_error = -hit->depth - truth->start_gap;
        out->distance_error = fabs(hit->depth + truth->start_gap);
    } else {
        out->gap_error = gap - due;
        out->distance_error = fabs(hit->distance - gap);
    }
    out->normal_error = score_normal_error(scene, query, hit->fraction, slack, hit->normal);
    out->point_error = point_error(scene, hit);
}

static score_answer failed(int failure, double beyond)
{
    return (score_answer){.failure = failure, .beyond = beyond};
}

score_answer score_sweep(const score_scene *scene, const tahr_sweep *query, const score_truth *truth,
                         tahr_status status, const tahr_hit *hit, uint32_t count, double slack)
{
    score_answer out = {.failure = SCORE_FINE};
    double miss = missed(truth);

    if (status < 0) {
        return failed(SCORE_ERROR, 0);
    }
    if (count == 0) {
        return miss > SCORE_TAU[0] ? failed(SCORE_MISS, miss) : out;
    }
    if (!finite_hit(hit)) {
        return failed(SCORE_NOT_FINITE, 0);
    }
    if (hit->unknown) {
        return failed(SCORE_UNKNOWN, 0);
    }
    if ((hit->start_overlap != 0) != (truth->status == SCORE_OVERLAP)) {
        double beyond = fabs(truth->start_gap);
        return beyond > SCORE_TAU[0] ? failed(SCORE_START, beyond) : out;
    }
    if (truth->status == SCORE_FREE) {
        /* Within the margin from the start and not approaching: no distance tells how wrong a hit is. */
        double beyond = truth->start_gap <= query->margin ? INFINITY : truth->min_gap;
        return beyond > SCORE_TAU[0] ? failed(SCORE_FALSE_HIT, beyond) : out;
    }
    measure(scene, query, truth, hit, slack, &out);
    return out;
}

void score_sweeps_add(score_sweeps *sweeps, const score_answer *answer)
{
    sweeps->cases++;
    if (answer->failure != SCORE_FINE) {
        sweeps->failures[answer->failure]++;
        for (int i = 0; i < SCORE_TAUS; i++) {
            sweeps->misses[i] += answer->failure == SCORE_MISS && answer->beyond > SCORE_TAU[i];
            sweeps->false_hits[i] += answer->failure == SCORE_FALSE_HIT && answer->beyond > SCORE_TAU[i];
        }
        if (answer->failure == SCORE_MISS && answer->beyond > sweeps->deepest_miss) {
            sweeps->deepest_miss = answer->beyond;
        }
        return;
    }
    if (!answer->measured) {
        return;
    }
    score_stat_add(&sweeps->gap, fabs(answer->gap_error));
    score_stat_add(&sweeps->normal, answer->normal_error);
    sweeps->late = fmax(sweeps->late, -answer->gap_error);
    sweeps->early = fmax(sweeps->early, answer->gap_error);
    sweeps->distance = fmax(sweeps->distance, answer->distance_error);
    sweeps->point = fmax(sweeps->point, answer->point_error);
}

void score_sweeps_free(score_sweeps *sweeps)
{
    score_stat_free(&sweeps->gap);
    score_stat_free(&sweeps->normal);
}
