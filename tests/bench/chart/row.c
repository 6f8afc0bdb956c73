/* SPDX-License-Identifier: MIT
 * row.c: writes points as CSV. */
#include "row.h"

#include <math.h>
#include <stdlib.h>

void chart_row_clear(chart_row *row)
{
    *row = (chart_row){.scene = "", .curve = "", .setting = "", .role = CHART_KNOB, .reference = ""};
    double *const empty[] = {&row->value,         &row->rate,   &row->error_p50,  &row->error_p99, &row->error_max,
                             &row->penetration,   &row->ns_p50, &row->ns_p99,     &row->ns_mean,   &row->ns_second,
                             &row->queries,       &row->tests,  &row->iterations, &row->saved,     &row->bytes,
                             &row->build_seconds, &row->threads};
    for (size_t i = 0; i < sizeof empty / sizeof empty[0]; i++) {
        *empty[i] = NAN;
    }
}

void chart_row_head(FILE *csv)
{
    fprintf(csv, "family,scene,curve,setting,value,rate_hz,role,reference,samples,failed,why,error_p50_m,error_p99_m,"
                 "error_max_m,penetration_m,ns_p50,ns_p99,ns_mean,ns_per_second,queries,tests,iterations,saved,bytes,"
                 "build_s,threads\n");
}

static void number(FILE *csv, double value)
{
    if (isnan(value)) {
        fputc(',', csv);
    } else {
        fprintf(csv, ",%.6g", value);
    }
}

void chart_row_write(FILE *csv, const char *family, const chart_row *r)
{
    const double measured[] = {r->error_p50,  r->error_p99, r->error_max, r->penetration,   r->ns_p50,
                               r->ns_p99,     r->ns_mean,   r->ns_second, r->queries,       r->tests,
                               r->iterations, r->saved,     r->bytes,     r->build_seconds, r->threads};
    fprintf(csv, "%s,%s,%s,%s", family, r->scene, r->curve, r->setting);
    number(csv, r->value);
    number(csv, r->rate);
    fprintf(csv, ",%s,%s,%llu,%llu,%s", r->role, r->reference, (unsigned long long)r->samples,
            (unsigned long long)r->failed, r->why);
    for (size_t i = 0; i < sizeof measured / sizeof measured[0]; i++) {
        number(csv, measured[i]);
    }
    fputc('\n', csv);
    fflush(csv);
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void chart_row_errors(chart_row *row, double *errors, uint32_t count)
{
    if (count == 0) return;
    qsort(errors, count, sizeof errors[0], by_value);
    row->error_p50 = errors[(count - 1) / 2];
    row->error_p99 = errors[count - 1 - (count - 1) / 100];
    row->error_max = errors[count - 1];
}
