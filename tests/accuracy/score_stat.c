/* SPDX-License-Identifier: MIT
 * score_stat.c: values and what is said of all of them together. */
#include "score.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

void score_stat_add(score_stat *stat, double value)
{
    if (!isfinite(value)) {
        stat->not_finite++;
        return;
    }
    if (stat->count == stat->capacity) {
        stat->capacity = stat->capacity > 0 ? 2 * stat->capacity : 64;
        stat->values = realloc(stat->values, stat->capacity * sizeof *stat->values);
        if (!stat->values) {
            fprintf(stderr, "score: out of memory for %u values\n", stat->capacity);
            abort();
        }
    }
    stat->min = stat->count == 0 || value < stat->min ? value : stat->min;
    stat->max = stat->count == 0 || value > stat->max ? value : stat->max;
    stat->values[stat->count++] = value;
    stat->sum += value;
    stat->sum_of_squares += value * value;
    stat->sorted = 0;
}

void score_stat_merge(score_stat *stat, const score_stat *other)
{
    for (uint32_t i = 0; i < other->count; i++) {
        score_stat_add(stat, other->values[i]);
    }
    stat->not_finite += other->not_finite;
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double score_stat_quantile(score_stat *stat, double q)
{
    if (stat->count == 0) {
        return 0;
    }
    if (!stat->sorted) {
        qsort(stat->values, stat->count, sizeof *stat->values, by_size);
        stat->sorted = 1;
    }
    double rank = ceil(q * stat->count) - 1;
    return stat->values[rank <= 0 ? 0 : rank >= stat->count ? stat->count - 1 : (uint32_t)rank];
}

double score_stat_mean(const score_stat *stat)
{
    return stat->count > 0 ? stat->sum / stat->count : 0;
}

double score_stat_rms(const score_stat *stat)
{
    return stat->count > 0 ? sqrt(stat->sum_of_squares / stat->count) : 0;
}

void score_stat_free(score_stat *stat)
{
    free(stat->values);
    *stat = (score_stat){0};
}
