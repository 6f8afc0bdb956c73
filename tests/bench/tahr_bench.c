/* SPDX-License-Identifier: MIT
 * tahr_bench.c: the benchmark: wandering characters on every world and backend, as a table and as CSV. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench_clock.h"
#include "bench_quiet.h"
#include "bench_query.h"
#include "bench_run.h"
#include "bench_telemetry.h"

typedef struct options {
    const char *csv, *world, *backend;
    uint32_t characters; /* 0: all counts */
    int queries;         /* 1: single queries instead of steps */
    int telemetry;       /* 1: what it adds to a step */
    int stalled;         /* 1: to a sink that does not return */
} options;

typedef struct plan {
    uint32_t characters, ticks;
} plan;

enum { PLANS = 3 };

/* Enough steps for a 99th percentile, few enough for the whole run to stay under three minutes. */
static const plan NATIVE_PLANS[PLANS] = {{1, 20000}, {256, 300}, {10000, 20}};
static const plan OTHER_PLANS[PLANS] = {{1, 600}, {16, 60}, {0, 0}};

static const char OPTIONS[] = "  --csv FILE (build/bench.csv)  --world NAME  --backend NAME  --characters N  --queries "
                              " --telemetry [--stalled]  --help\n";

static int usage(const char *wrong)
{
    fprintf(stderr, "tahr_bench: '%s' is no option or lacks its value\n%s", wrong, OPTIONS);
    return 2;
}

/* Everything that can be asked for. */
static int help(void)
{
    printf("tahr_bench: wandering characters, timed, on every world and backend or on those asked for\n%s", OPTIONS);
    printf("worlds:");
    for (int i = 0; i < BENCH_WORLDS; i++) {
        printf(" %s", bench_world_name(i));
    }
    for (int i = 0; i < BENCH_QUIET; i++) {
        printf(" %s", bench_quiet_name(i));
    }
    printf("\nbackends:");
    for (int i = 0; i < SCENE_BACKEND_COUNT; i++) {
        printf(" %s", SCENE_BACKENDS[i].name);
    }
    printf("\nbackends of a plane (worlds named _2d):");
    for (int i = 0; i < SCENE_PLANAR_BACKEND_COUNT; i++) {
        printf(" %s", SCENE_PLANAR_BACKENDS[i].name);
    }
    printf("\n");
    return 0;
}

/* Whether a world and a backend, if both are named, go together: what costs next to nothing is measured on native, and
 * backends of a plane need one. */
static int measures(const options *o)
{
    int quiet = 0, planar = 0;
    if (!o->world || !o->backend) return 1;
    for (int i = 0; i < BENCH_QUIET; i++) {
        quiet = quiet || strcmp(o->world, bench_quiet_name(i)) == 0;
    }
    for (int i = 0; i < SCENE_PLANAR_BACKEND_COUNT; i++) {
        planar = planar || strcmp(o->backend, SCENE_PLANAR_BACKENDS[i].name) == 0;
    }
    return quiet ? strcmp(o->backend, "native") == 0 && !o->queries : !planar || strstr(o->world, "_2d") != NULL;
}

static int known(const options *o)
{
    int world = o->world == NULL, backend = o->backend == NULL;
    for (int i = 0; i < BENCH_WORLDS; i++) {
        world = world || strcmp(o->world, bench_world_name(i)) == 0;
    }
    for (int i = 0; i < BENCH_QUIET; i++) {
        world = world || strcmp(o->world, bench_quiet_name(i)) == 0;
    }
    for (int i = 0; i < SCENE_BACKEND_COUNT; i++) {
        backend = backend || strcmp(o->backend, SCENE_BACKENDS[i].name) == 0;
    }
    for (int i = 0; i < SCENE_PLANAR_BACKEND_COUNT; i++) {
        backend = backend || strcmp(o->backend, SCENE_PLANAR_BACKENDS[i].name) == 0;
    }
    if (world && backend && !measures(o)) {
        fprintf(stderr, "tahr_bench: world '%s' has no backend '%s'\n", o->world, o->backend);
        return 0;
    }
    if (!world || !backend) {
        fprintf(stderr, "tahr_bench: no such %s: '%s'\n", world ? "backend" : "world", world ? o->backend : o->world);
    }
    return world && backend;
}

static int read_options(options *o, int argc, char **argv)
{
    *o = (options){.csv = "build/bench.csv"};
    for (int i = 1; i < argc; i++) {
        const char **text = strcmp(argv[i], "--csv") == 0       ? &o->csv
                            : strcmp(argv[i], "--world") == 0   ? &o->world
                            : strcmp(argv[i], "--backend") == 0 ? &o->backend
                                                                : NULL;
        char *end = NULL;
        if (i + 1 < argc && text) {
            *text = argv[++i];
        } else if (i + 1 < argc && strcmp(argv[i], "--characters") == 0) {
            const char *value = argv[++i];
            unsigned long n = strtoul(value, &end, 10);
            if (*value < '0' || *value > '9' || *end || n < 1 || n > 100000) {
                fprintf(stderr, "tahr_bench: --characters '%s': expected a whole number from 1 to 100000\n", value);
                return 2;
            }
            o->characters = (uint32_t)n;
        } else if (strcmp(argv[i], "--queries") == 0) {
            o->queries = 1;
        } else if (strcmp(argv[i], "--telemetry") == 0) {
            o->telemetry = 1;
        } else if (strcmp(argv[i], "--stalled") == 0) {
            o->stalled = o->telemetry = 1;
        } else {
            return usage(argv[i]);
        }
    }
    return known(o) ? 0 : 2;
}

static void print_row(FILE *csv, const char *world, const char *backend, const bench_result *r)
{
    const int digits = r->ns_median < 100; /* after the point: a sleeper costs a few nanoseconds */
    printf("%-12s %-13s %6u %9.*f %9.*f %9.*f %7.2f %8.2f %6.3f %8.2f %8.2f %8.4f %5.0f%%\n", world, backend,
           r->characters, digits, r->ns_median, digits, r->ns_p99, digits, r->ns_cpu, r->sweeps, r->contact_queries,
           r->rays, r->triangle_tests, r->iterations, r->gathers, 100 * r->walking);
    fflush(stdout);
    fprintf(csv, "%s,%s,%u,%llu,%.1f,%.1f,%.1f,%.4f,%.4f,%.4f,%.3f,%.3f,%.5f,%.5f,%.4f,%llu,%llu\n", world, backend,
            r->characters, (unsigned long long)r->steps, r->ns_median, r->ns_p99, r->ns_cpu, r->sweeps,
            r->contact_queries, r->rays, r->triangle_tests, r->iterations, r->gathers, r->escapes, r->walking,
            (unsigned long long)r->bytes_per_mover, (unsigned long long)r->lost);
}

static void print_build(const bench_world *w, const scene_backend *b, const bench_opened *opened)
{
    if (w->mesh.triangle_count > 0) {
        printf("%-12s %-13s %u triangles, opened in %.0f ms, %.1f bytes per triangle\n", w->name, b->name,
               w->mesh.triangle_count, 1e3 * opened->build_seconds, (double)opened->bytes / w->mesh.triangle_count);
        fflush(stdout);
    } else if (w->body_count > 1) {
        printf("%-12s %-13s %u bodies, opened in %.1f ms, %.0f bytes per body\n", w->name, b->name, w->body_count,
               1e3 * opened->build_seconds, (double)opened->bytes / w->body_count);
        fflush(stdout);
    }
}

static int measure_backend(FILE *csv, const bench_world *w, const scene_backend *b, const options *o)
{
    static bench_opened opened;                                              /* the allocator points at it */
    const plan *plans = b->native || w->planar ? NATIVE_PLANS : OTHER_PLANS; /* boxes are cheap on all */
    fprintf(stderr, "%s on %s ...\n", w->name, b->name);
    tahr_status status = bench_open(&opened, w, b);
    if (status < 0) {
        printf("%-12s %-13s cannot be opened: %s\n", w->name, b->name, tahr_status_name(status));
        return 0;
    }
    print_build(w, b, &opened);
    int ok = 1;
    for (int i = 0; i < PLANS; i++) {
        plan p = plans[i];
        char error[256] = "";
        bench_result result;
        if (o->characters) { /* about as many steps as the plan for one character has */
            p = (plan){i == 0 ? o->characters : 0, plans[0].ticks / o->characters + 20};
        }
        if (p.characters == 0) {
            continue;
        }
        if (bench_run(&opened, w, p.characters, p.ticks, &result, error)) {
            print_row(csv, w->name, b->name, &result);
        } else {
            printf("%-12s %-13s %6u failed: %s\n", w->name, b->name, p.characters, error);
            ok = 0;
        }
    }
    bench_close(&opened);
    return ok;
}

static int measure_queries(FILE *csv, const bench_world *w, const options *o)
{
    static bench_queries queries;
    char error[256] = "";
    int ok = bench_queries_make(&queries, w, error);
    if (!ok) {
        printf("%-11s failed: %s\n", w->name, error);
    }
    const scene_backend *b;
    for (int i = 0; ok && (b = bench_world_backend(w, i)) != NULL; i++) {
        bench_query_result r;
        if (o->backend && strcmp(o->backend, b->name) != 0) {
            continue;
        }
        fprintf(stderr, "%s on %s ...\n", w->name, b->name);
        tahr_status status = bench_queries_run(&queries, w, b, &r);
        if (status < 0) {
            printf("%-12s %-13s cannot be asked: %s\n", w->name, b->name, tahr_status_name(status));
            ok = 0;
            continue;
        }
        printf("%-12s %-13s %9.0f %9.0f %9.1e %9.1e %9.1e %7u %7u %7u %7u %9.1e %7u %7u\n", w->name, b->name,
               r.sweep_ns, r.contacts_ns, r.gap_p50, r.gap_p99, r.gap_max, r.sweeps, r.hits, r.at_start, r.overlaps,
               r.depth_max, r.misses, r.false_hits);
        fflush(stdout);
        fprintf(csv, "%s,%s,%u,%u,%.1f,%.1f,%.3e,%.3e,%.3e,%u,%u,%u,%.3e,%u,%u\n", w->name, b->name, r.sweeps,
                r.contact_queries, r.sweep_ns, r.contacts_ns, r.gap_p50, r.gap_p99, r.gap_max, r.hits, r.at_start,
                r.overlaps, r.depth_max, r.misses, r.false_hits);
    }
    bench_queries_free(&queries);
    return ok;
}

/* Native alone: what telemetry adds does not depend on who answers the queries. */
static int measure_telemetry(FILE *csv, const bench_world *w, const options *o)
{
    static bench_opened opened; /* the allocator points at it */
    static const uint32_t counts[] = {1, 16, 256};
    int ok = bench_open(&opened, w, bench_world_backend(w, 0)) == TAHR_OK;
    for (int i = 0; ok && i < (o->characters ? 1 : 3); i++) {
        bench_telemetry_result r;
        char error[256] = "";
        fprintf(stderr, "%s with telemetry ...\n", w->name);
        if (bench_telemetry_run(&opened, w, o->characters ? o->characters : counts[i], o->stalled, &r, error)) {
            printf("%-12s %6u %7.0f %7.0f %7.0f   %7.0f %7.0f %7.0f   %7.0f %7llu\n", w->name, r.characters,
                   r.off_median, r.off_p99, r.off_p999, r.on_median, r.on_p99, r.on_p999, r.alone,
                   (unsigned long long)r.dropped);
            fflush(stdout);
            fprintf(csv, "%s,%u,%llu,%.1f,%.1f,%.1f,%.1f,%.1f,%.1f,%.1f,%llu\n", w->name, r.characters,
                    (unsigned long long)r.steps, r.off_median, r.off_p99, r.off_p999, r.on_median, r.on_p99, r.on_p999,
                    r.alone, (unsigned long long)r.dropped);
        } else {
            printf("%-12s failed: %s\n", w->name, error);
            ok = 0;
        }
    }
    bench_close(&opened);
    return ok;
}

/* One world on the backends that were asked for. */
static int measure_world(FILE *csv, const bench_world *w, const options *o)
{
    int ok = 1;
    if (o->queries) {
        return measure_queries(csv, w, o);
    }
    if (o->telemetry) {
        return measure_telemetry(csv, w, o);
    }
    const scene_backend *b;
    for (int i = 0; (b = bench_world_backend(w, i)) != NULL; i++) {
        if (!o->backend || strcmp(o->backend, b->name) == 0) {
            ok = measure_backend(csv, w, b, o) && ok;
        }
    }
    return ok;
}

/* What costs next to nothing, on native, whose step it is. */
static int measure_quiet(FILE *csv, const options *o)
{
    static const uint32_t counts[] = {1, 256, 10000};
    int ok = 1;
    for (int i = 0; i < 3 * BENCH_QUIET; i++) {
        const char *name = bench_quiet_name(i / 3);
        const uint32_t count = o->characters ? o->characters : counts[i % 3];
        char error[256] = "";
        bench_result result;
        if ((o->world && strcmp(o->world, name) != 0) || (o->characters && i % 3 > 0)) {
            continue;
        }
        fprintf(stderr, "%s ...\n", name);
        if (bench_quiet_run(i / 3, count, &result, error)) {
            print_row(csv, name, "native", &result);
        } else {
            printf("%-12s %-13s %6u failed: %s\n", name, "native", count, error);
            ok = 0;
        }
    }
    return ok;
}

static int measure(FILE *csv, const options *o)
{
    int ok = 1;
    for (int i = 0; i < BENCH_WORLDS; i++) {
        bench_world world;
        if (o->world && strcmp(o->world, bench_world_name(i)) != 0) {
            continue;
        }
        bench_world_make(&world, i);
        if (world.missing[0]) {
            printf("skipped: %s %s\n", world.name, world.missing);
        }
        ok = (world.missing[0] || measure_world(csv, &world, o)) && ok;
        bench_world_free(&world);
    }
    if (!o->queries && !o->telemetry && (!o->backend || strcmp(o->backend, "native") == 0)) {
        ok = measure_quiet(csv, o) && ok;
    }
    return ok;
}

static void print_telemetry_heads(FILE *csv, const options *o)
{
    printf("ns of a step at 60 Hz without and with telemetry to a sink that %s, by turns; reading the clock costs "
           "%.0f ns, subtracted;\nalone: what is added, begin and push by themselves in batches\n",
           o->stalled ? "hangs" : "counts", bench_clock_cost());
    printf("%-12s %6s %7s %7s %7s   %7s %7s %7s   %7s %7s\n", "world", "chars", "off p50", "p99", "p99.9", "on p50",
           "p99", "p99.9", "alone", "dropped");
    fprintf(csv, "world,characters,steps,off_p50,off_p99,off_p999,on_p50,on_p99,on_p999,alone,dropped\n");
}

static void print_heads(FILE *csv, const options *o)
{
    if (o->telemetry) {
        print_telemetry_heads(csv, o);
        return;
    }
    if (o->queries) {
        printf(
            "sweeps and contacts that 16 wanderers asked for, asked again one by one without a cache; gap: m, off the "
            "margin where a sweep stops;\nat 0: of the hits; overlap: the same half a margin deep, depth: m, off "
            "native, whose answers with the margin\nand 1 um beside it say what was missed or false\n");
        printf("%-12s %-13s %9s %9s %9s %9s %9s %7s %7s %7s %7s %9s %7s %7s\n", "world", "backend", "ns sweep",
               "contacts", "gap p50", "gap p99", "gap max", "sweeps", "hits", "at 0", "overlap", "depth", "missed",
               "false");
        fprintf(csv, "world,backend,sweeps,contact_queries,ns_sweep,ns_contacts,gap_p50,gap_p99,gap_max,hits,at_start,"
                     "overlaps,depth_max,misses,false_hits\n");
        return;
    }
    printf("60 Hz; reading the clock costs %.0f ns, subtracted; columns from 'sweeps' to 'gathers' are per step\n",
           bench_clock_cost());
    printf("%-12s %-13s %6s %9s %9s %9s %7s %8s %6s %8s %8s %8s %6s\n", "world", "backend", "chars", "ns median",
           "ns p99", "ns cpu", "sweeps", "contacts", "rays", "tests", "iters", "gathers", "walk");
    fprintf(csv,
            "world,backend,characters,steps,ns_median,ns_p99,ns_cpu_mean,sweeps,contact_queries,rays,triangle_tests,"
            "narrow_iterations,gathers,escapes,walking,bytes_per_mover,respawned\n");
}

int main(int argc, char **argv)
{
    options o;
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0) {
            return help();
        }
    }
    int wrong = read_options(&o, argc, argv);
    if (wrong) {
        return wrong;
    }
    FILE *csv = fopen(o.csv, "w");
    if (!csv) {
        fprintf(stderr, "tahr_bench: '%s' cannot be written\n", o.csv);
        return 1;
    }
    print_heads(csv, &o);
    int ok = measure(csv, &o);
    if (fclose(csv) != 0) {
        fprintf(stderr, "tahr_bench: '%s' could not be written in full\n", o.csv);
        ok = 0;
    }
    fprintf(stderr, "written: %s\n", o.csv);
    return !ok;
}
