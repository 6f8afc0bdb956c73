/* SPDX-License-Identifier: MIT
 * tahr_chart.c: measures what `make chart` draws: one CSV per family. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "run.h"

typedef struct family {
    const char *name;
    void (*measure)(chart_run *run);
} family;

static const family FAMILIES[] = {
    {"sweeps", chart_sweeps}, {"movement", chart_movement}, {"shortcuts", chart_shortcuts},
    {"crowds", chart_crowds}, {"scenes", chart_scenes},
};
enum { FAMILY_COUNT = sizeof FAMILIES / sizeof FAMILIES[0] };

typedef struct options {
    const char *out, *family;
    const chart_budget *budget;
    int quiet;
} options;

static const char OPTIONS[] = "  --out FOLDER (.)  --family NAME  --budget tiny|quick|full (full)  --quiet  --help\n";

static int usage(const char *option, const char *wrong)
{
    fprintf(stderr, "tahr_chart: %s '%s' is not known, or its value is missing\n%s", option, wrong, OPTIONS);
    return 2;
}

static int help(void)
{
    printf("tahr_chart: measures speed against accuracy, FOLDER/FAMILY.csv each, and FOLDER/machine.csv\n%s", OPTIONS);
    printf("families:");
    for (int i = 0; i < FAMILY_COUNT; i++) {
        printf(" %s", FAMILIES[i].name);
    }
    printf("\n");
    return 0;
}

static const chart_budget *budget_of(const char *name)
{
    const chart_budget *const all[] = {&CHART_TINY, &CHART_QUICK, &CHART_FULL};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        if (strcmp(name, all[i]->name) == 0) return all[i];
    }
    return NULL;
}

static int is_family(const char *name)
{
    for (int i = 0; i < FAMILY_COUNT; i++) {
        if (strcmp(name, FAMILIES[i].name) == 0) return 1;
    }
    return 0;
}

/* 0: go on; else what main returns, less one. */
static int read_options(options *o, int argc, char **argv)
{
    *o = (options){".", NULL, &CHART_FULL, 0};
    for (int i = 1; i < argc; i++) {
        const char *value = i + 1 < argc ? argv[i + 1] : NULL;
        if (strcmp(argv[i], "--help") == 0) return 1 + help();
        if (strcmp(argv[i], "--quiet") == 0) {
            o->quiet = 1;
            continue;
        }
        if (value && strcmp(argv[i], "--out") == 0) {
            o->out = value;
        } else if (value && strcmp(argv[i], "--family") == 0) {
            if (!is_family(value)) return 1 + usage("--family", value);
            o->family = value;
        } else if (value && strcmp(argv[i], "--budget") == 0) {
            o->budget = budget_of(value);
            if (!o->budget) return 1 + usage("--budget", value);
        } else {
            return 1 + usage("option", argv[i]);
        }
        i++;
    }
    return 0;
}

static FILE *open_csv(const char *folder, const char *name)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s.csv", folder, name);
    FILE *csv = fopen(path, "w");
    if (!csv) fprintf(stderr, "tahr_chart: '%s' cannot be written\n", path);
    return csv;
}

static int measure(chart_run *run, const family *f, const char *folder)
{
    run->csv = open_csv(folder, f->name);
    if (!run->csv) return 0;
    run->family = f->name;
    chart_row_head(run->csv);
    f->measure(run);
    int ok = !ferror(run->csv);
    if (fclose(run->csv) != 0 || !ok) {
        fprintf(stderr, "tahr_chart: '%s/%s.csv' could not be written in full\n", folder, f->name);
        return 0;
    }
    return 1;
}

int main(int argc, char **argv)
{
    options o;
    int stop = read_options(&o, argc, argv);
    if (stop) return stop - 1;
    FILE *machine = open_csv(o.out, "machine");
    if (!machine) return 1;
    chart_machine(machine);
    fclose(machine);
    chart_run run = {.budget = o.budget, .counting = 1, .bar = o.quiet ? NULL : stderr, .lines = !isatty(2)};
    for (int i = 0; i < FAMILY_COUNT; i++) {
        if (!o.family || strcmp(o.family, FAMILIES[i].name) == 0) FAMILIES[i].measure(&run);
    }
    run.counting = 0;
    run.started = chart_monotonic();
    int ok = 1;
    for (int i = 0; i < FAMILY_COUNT; i++) {
        if (!o.family || strcmp(o.family, FAMILIES[i].name) == 0) ok = measure(&run, &FAMILIES[i], o.out) && ok;
    }
    if (run.bar)
        fprintf(run.bar, "%stahr_chart: %u points in %.0f s\n", run.lines ? "" : "\n", run.done,
                chart_monotonic() - run.started);
    return !(ok && !run.failed);
}
