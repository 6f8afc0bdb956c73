/* SPDX-License-Identifier: MIT
 * tahr_stability.c: the stability matrix as a program. */
#include "table.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SEEDS = 1000, QUICK_SEEDS = 30, MOST_SEEDS = 100000000 };

typedef struct options {
    matrix_request request;
    const char *csv, *svg;
    uint64_t seed;
    int one, trace; /* one: a single run */
} options;

static int help(void)
{
    printf("tahr_stability: characters in hard cases, on every backend, judged by geometry of its own\n"
           "  --family NAME --backend NAME --preset NAME   only these (precise, unreal, platformer)\n"
           "  --seeds N        variations of each cell, default %d\n"
           "  --quick          %d of each\n"
           "  --jobs N         processes, default the processors of this machine\n"
           "  --csv FILE --svg FILE   default build/stability.csv and .svg; \"\" for none\n"
           "  --seed N         one run of one cell; with --trace every step of it\n"
           "Ends with 1 if native breaks a promise anywhere, or a backend makes the movement insane.\nfamilies:",
           SEEDS, QUICK_SEEDS);
    for (const family *f = FAMILIES; f->name; f++)
        printf(" %s", f->name);
    printf("\nbackends:");
    for (const subject *s = SUBJECTS; s->name; s++)
        printf(" %s", s->name);
    printf("\n");
    return 0;
}

static int usage(const char *what, const char *value)
{
    fprintf(stderr, "tahr_stability: %s: '%s' is not known; --help tells what is\n", what, value);
    return 2;
}

static int not_a_number(const char *name, const char *value, uint64_t most)
{
    fprintf(stderr, "tahr_stability: %s '%s': expected a whole number from 1 to %llu\n", name, value,
            (unsigned long long)most);
    return 2;
}

static int number(const char *text, uint64_t most, uint64_t *value)
{
    char *end = NULL;
    errno = 0;
    unsigned long long n = strtoull(text, &end, 10);
    if (errno || *text < '0' || *text > '9' || *end || n < 1 || n > most) return 0;
    *value = n;
    return 1;
}

static uint32_t preset_named(const char *name)
{
    for (uint32_t p = 1; p <= MATRIX_PRESETS; p++) {
        if (strcmp(tahr_preset_name((int32_t)p), name) == 0) return p;
    }
    return 0;
}

/* Options with a value. 0: taken; else the exit code. */
static int read_value(options *o, const char *name, const char *value)
{
    uint64_t n = 0;
    matrix_request *r = &o->request;
    if (strcmp(name, "--csv") == 0) {
        o->csv = value;
    } else if (strcmp(name, "--svg") == 0) {
        o->svg = value;
    } else if (strcmp(name, "--family") == 0) {
        r->family = value;
        return family_named(value) ? 0 : usage(name, value);
    } else if (strcmp(name, "--backend") == 0) {
        r->subject = value;
        return subject_named(value) ? 0 : usage(name, value);
    } else if (strcmp(name, "--preset") == 0) {
        r->preset = preset_named(value);
        return r->preset ? 0 : usage(name, value);
    } else if (strcmp(name, "--seeds") == 0) {
        if (!number(value, MOST_SEEDS, &n)) return not_a_number(name, value, MOST_SEEDS);
        r->seeds = (uint32_t)n;
    } else if (strcmp(name, "--jobs") == 0) {
        if (!number(value, MATRIX_JOBS, &n)) return not_a_number(name, value, MATRIX_JOBS);
        r->jobs = (int)n;
    } else if (strcmp(name, "--seed") == 0) {
        if (!number(value, UINT64_MAX, &o->seed)) return not_a_number(name, value, UINT64_MAX);
        o->one = 1;
    } else {
        return usage("option", name);
    }
    return 0;
}

static int read_options(options *o, int argc, char **argv)
{
    long processors = sysconf(_SC_NPROCESSORS_ONLN);
    *o = (options){.csv = "build/stability.csv", .svg = "build/stability.svg"};
    o->request =
        (matrix_request){.seeds = SEEDS, .first_seed = 1, .timed = 1, .jobs = processors > 0 ? (int)processors : 1};
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--quick") == 0) {
            o->request.seeds = QUICK_SEEDS;
            o->request.timed = 0;
        } else if (strcmp(argv[i], "--trace") == 0) {
            o->trace = 1;
        } else if (i + 1 < argc) {
            int wrong = read_value(o, argv[i], argv[i + 1]);
            if (wrong) return wrong;
            i++;
        } else {
            fprintf(stderr, "tahr_stability: '%s' is no option or lacks its value; --help tells what is\n", argv[i]);
            return 2;
        }
    }
    return 0;
}

/* What is asked for, if none of it is possible: says why, of the first. */
static int is_empty(const matrix_request *r)
{
    const char *why = "", *first = NULL;
    for (const family *f = FAMILIES; f->name; f++) {
        for (const subject *s = SUBJECTS; s->name; s++) {
            for (uint32_t p = 1; p <= MATRIX_PRESETS; p++) {
                int asked = (!r->family || strcmp(r->family, f->name) == 0) &&
                            (!r->subject || strcmp(r->subject, s->name) == 0) && (!r->preset || r->preset == p);
                if (asked && run_possible(f, s, p, &why)) return 0;
                if (asked && !first) first = why;
            }
        }
    }
    fprintf(stderr, "tahr_stability: nothing of what is asked for is possible: %s\n", first ? first : "");
    return 1;
}

/* Before hours of work: can it be written at the end? What is there stays as it is. */
static int can_write(const char *path)
{
    if (!*path) return 1;
    FILE *file = fopen(path, "a");
    if (file) fclose(file);
    if (!file) fprintf(stderr, "tahr_stability: '%s' cannot be written\n", path);
    return file != NULL;
}

/* One run of one cell, told in full. */
static int run_one(const options *o)
{
    const matrix_request *r = &o->request;
    const char *why;
    outcome out;
    if (!r->family || !r->subject || !r->preset) {
        fprintf(stderr, "tahr_stability: --seed needs --family, --backend and --preset\n");
        return 2;
    }
    run_request q = {family_named(r->family), subject_named(r->subject), r->preset, o->seed, o->trace};
    if (!run_possible(q.family, q.subject, q.preset, &why)) {
        printf("n/a: %s\n", why);
        return 0;
    }
    run(&q, &out);
    int slowest;
    double seconds = outcome_slowest(&out, &slowest);
    printf(
        "%u steps, %u of them walking, at most %u queries, %.3g m nearer than it may be, %.3g m off its twin, slowest "
        "step %d: %.1f us\n",
        out.worst.steps, out.worst.walking, out.worst.queries, out.worst.deepest, out.worst.apart, slowest,
        1e6 * seconds);
    if (!out.first.kept) {
        printf("clean\n");
        return 0;
    }
    printf("step %d: %s: %s (%.9g, at most %.9g)\n", out.first.step, watch_name(out.first.kept), out.first.text,
           out.first.value, out.first.bound);
    return 1;
}

static void show(const matrix *m, int row)
{
    table_family(stdout, m, row);
}

static int write_file(const char *path, const matrix *m, uint32_t seeds)
{
    if (!*path) return 1;
    FILE *file = fopen(path, "w");
    size_t length = strlen(path);
    int good = file != NULL;
    if (good && length > 4 && strcmp(path + length - 4, ".svg") == 0)
        heat_map_svg(file, m, seeds);
    else if (good)
        table_csv(file, m);
    good = file && fclose(file) == 0 && good;
    fprintf(stderr, good ? "written: %s\n" : "tahr_stability: '%s' cannot be written\n", path);
    return good;
}

/* Native keeps everything, everybody stays sane. */
static int verdict(const matrix *m)
{
    int broken = 0, insane = 0, others = 0;
    for (uint32_t i = 0; i < m->count; i++) {
        const cell *c = &m->cells[i];
        int native = strcmp(c->subject->name, "native") == 0;
        broken += native && !cell_clean(c);
        others += !native && !cell_clean(c);
        insane += !cell_sane(c);
    }
    printf("\ncells of native that break a promise: %d; of others: %d; cells that are not sane: %d\n", broken, others,
           insane);
    return broken + insane > 0;
}

int main(int argc, char **argv)
{
    options o;
    matrix m;
    char why[256] = "";
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0) return help();
    }
    int wrong = read_options(&o, argc, argv);
    if (wrong) return wrong;
    if (o.one) return run_one(&o);
    if (is_empty(&o.request)) return 2;
    if (!can_write(o.csv) || !can_write(o.svg)) return 1;
    printf("%u variations of each cell; ok: none breaks a promise; else how many keep all; '.': not possible\n",
           o.request.seeds);
    table_head(stdout, subject_count());
    if (!matrix_run(&m, &o.request, show, why)) {
        fprintf(stderr, "tahr_stability: %s\n", why);
        return 1;
    }
    table_broken(stdout, &m);
    int failed = verdict(&m);
    int written = write_file(o.csv, &m, o.request.seeds) & write_file(o.svg, &m, o.request.seeds);
    matrix_free(&m);
    return failed || !written;
}
