/* SPDX-License-Identifier: MIT
 * plane_sweeps.c: the backends of two dimensions beside those of three: sweeps that wanderers ask for on the level of
 * 1002 tiles. There is no stored truth of a plane: they are judged by the distances of native in double, which is
 * within 1e-9 m of the truth where there is one (bench_query.h says how). */
#include <stdio.h>
#include <string.h>

#include "bench_query.h"
#include "run.h"
#include "setting.h"
#include "sweeps.h"

/* Names as those of the other sweeps have them (subject.c). */
static void name_row(chart_row *row, const char *backend)
{
    static const char *const names[][4] = {{"native", "native float", "native float", CHART_DEFAULT},
                                           {"native-double", "native double", "native double", CHART_KNOB},
                                           {"ccd", "ccd advance", "ccd advance", CHART_DEFAULT},
                                           {"fcl", "fcl descend", "fcl AABB; descend", CHART_DEFAULT},
                                           {"box2d", "box2d", "box2d", CHART_ONLY},
                                           {"box2d-2", "box2d 2.4", "box2d 2.4", CHART_ONLY}};
    row->curve = row->setting = backend;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (strcmp(backend, names[i][0]) == 0) {
            row->curve = names[i][1];
            row->setting = names[i][2];
            row->role = names[i][3];
        }
    }
}

static void fill(chart_row *row, const scene_backend *backend, const bench_query_result *r)
{
    row->scene = "tiles_2d";
    name_row(row, backend->name);
    row->reference = "native double";
    row->samples = r->sweeps;
    row->failed = r->misses + r->false_hits;
    if (row->failed) snprintf(row->why, sizeof row->why, "%u missed; %u false", r->misses, r->false_hits);
    row->error_p50 = r->gap_p50;
    row->error_p99 = r->gap_p99;
    row->error_max = r->gap_max;
    row->ns_p50 = row->ns_mean = r->sweep_ns; /* one clock over all of them */
    row->ns_p99 = r->sweep_ns;
    row->queries = 1;
}

static void measure(chart_run *run, const bench_world *level, const scene_backend *backend, bench_queries *queries)
{
    bench_query_result result;
    chart_row row;
    tahr_status status = bench_queries_run(queries, level, backend, &result);
    chart_row_clear(&row);
    if (status < 0) {
        chart_run_fail(run, backend->name, tahr_status_name(status));
        return;
    }
    fill(&row, backend, &result);
    chart_run_write(run, &row);
}

void chart_plane_sweeps(chart_run *run)
{
    static bench_queries queries; /* megabytes */
    bench_world level = {.planar = 1};
    char why[256] = "";
    if (!run->counting) chart_level_make(&level, "tiles_2d");
    int ok = run->counting || (!level.missing[0] && bench_queries_make(&queries, &level, why));
    if (!ok) chart_run_fail(run, "tiles_2d", level.missing[0] ? level.missing : why);
    const scene_backend *backend;
    for (int i = 0; (backend = bench_world_backend(&level, i)) != NULL; i++) {
        if (chart_run_next(run, "tiles_2d", backend->name) && ok) measure(run, &level, backend, &queries);
    }
    if (!run->counting && ok) bench_queries_free(&queries);
    if (!run->counting) bench_world_free(&level);
}
