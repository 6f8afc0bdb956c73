/* SPDX-License-Identifier: MIT
 * tahr_peers.c: Tahr beside the controllers of other engines: the same levels, starts, wishes and judge in one run, by
 * turns, so that whatever else this machine does hits all alike. A table on the output, every number in a CSV file. */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <tahr/native.h>
#ifdef TAHR_HAVE_BOX2D
#include <tahr/box2d.h>
#endif

#include "course_run.h"
#include "method_tahr.h"
#include "peer.h"

enum { MAX_METHODS = 16, REASON = 512, BATCH = 20 }; /* BATCH: ticks of one method before it is the next one's turn */

typedef struct options {
    const char *csv, *folder, *course, *method;
    uint32_t characters, ticks;
    double seconds;
} options;

typedef struct entrant {
    const char *name;
    const method *method; /* NULL: left out */
    method own;
    char reason[REASON]; /* why */
} entrant;

typedef struct field {
    entrant entrants[MAX_METHODS];
    int count;
} field;

static const method_tahr TAHR_NATIVE = {.backend = tahr_backend_v1_native, .box = 1};
#ifdef TAHR_HAVE_BOX2D
static const method_tahr TAHR_BOX2D = {.backend = tahr_backend_v1_box2d};
#endif

#define TAHR_SAYS "preset precise, skin 0.01; the wish is the velocity at once, as it is with the peers; plane as a box"

static const char OPTIONS[] =
    "  --csv FILE (build/peers.csv)  --peers FOLDER (of peer_NAME.so)  --course NAME  --method "
    "NAME\n  --characters N (256)  --ticks N (600)  --seconds S (20: of a method on a course)"
    "  --quick  --help\n";

static int usage(const char *wrong)
{
    fprintf(stderr, "tahr_peers: '%s' is no option or lacks its value\n%s", wrong, OPTIONS);
    return 2;
}

static int read_count(const char *name, const char *text, uint32_t *out)
{
    char *end = NULL;
    unsigned long n = strtoul(text, &end, 10);
    *out = (uint32_t)n;
    if (*text >= '0' && *text <= '9' && !*end && n >= 1 && n <= 100000) {
        return 0;
    }
    fprintf(stderr, "tahr_peers: %s '%s': expected a whole number from 1 to 100000\n", name, text);
    return 2;
}

static int read_seconds(const char *name, const char *text, double *out)
{
    char *end = NULL;
    *out = strtod(text, &end);
    if (*text && !*end && *out > 0 && *out <= 1e6) {
        return 0;
    }
    fprintf(stderr, "tahr_peers: %s '%s': expected a number above 0, at most 1e6\n", name, text);
    return 2;
}

/* 0: taken; else what to exit with. */
static int read_value(options *o, const char *name, const char *value)
{
    const char **text = strcmp(name, "--csv") == 0      ? &o->csv
                        : strcmp(name, "--peers") == 0  ? &o->folder
                        : strcmp(name, "--course") == 0 ? &o->course
                        : strcmp(name, "--method") == 0 ? &o->method
                                                        : NULL;
    if (text) {
        *text = value;
        return 0;
    }
    if (strcmp(name, "--characters") == 0) {
        return read_count(name, value, &o->characters);
    }
    if (strcmp(name, "--ticks") == 0) {
        return read_count(name, value, &o->ticks);
    }
    return strcmp(name, "--seconds") == 0 ? read_seconds(name, value, &o->seconds) : usage(name);
}

/* 0, or what to exit with, less one. */
static int read_options(options *o, int argc, char **argv)
{
    *o = (options){.csv = "build/peers.csv", .folder = ".", .characters = 256, .ticks = 600, .seconds = 20};
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0) {
            printf("tahr_peers: Tahr and the controllers of other engines on the same courses\n%s", OPTIONS);
            return 1;
        }
        if (strcmp(argv[i], "--quick") == 0) {
            o->characters = 64;
            o->ticks = 150;
            o->seconds = 0.2;
        } else {
            int wrong = i + 1 < argc ? read_value(o, argv[i], argv[i + 1]) : usage(argv[i]);
            if (wrong) {
                return 1 + wrong;
            }
            i++;
        }
    }
    return 0;
}

static void enter_tahr(field *f, const char *name, const char *settings, const method_tahr *knobs)
{
    entrant *e = &f->entrants[f->count++];
    e->name = name;
    e->own = method_of_tahr(name, settings, knobs);
    e->method = &e->own;
}

/* What build.sh wrote beside a peer that it could not build, or what the loader says. */
static void read_reason(const options *o, entrant *e)
{
    char path[1024];
    const char *why = dlerror();
    snprintf(e->reason, sizeof e->reason, "%s", why ? why : "it exports no method");
    snprintf(path, sizeof path, "%s/peer_%s.reason", o->folder, e->name);
    FILE *file = fopen(path, "r");
    if (file) {
        if (fgets(e->reason, sizeof e->reason, file)) {
            e->reason[strcspn(e->reason, "\n")] = 0;
        }
        fclose(file);
    }
}

static void enter_peer(field *f, const options *o, const char *name)
{
    entrant *e = &f->entrants[f->count++];
    char path[1024];
    e->name = name;
    snprintf(path, sizeof path, "%s/peer_%s.so", o->folder, name);
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL); /* for good: some engines leave threads and handlers behind */
    snprintf(path, sizeof path, "method_%s", name);
    void *symbol = library ? dlsym(library, path) : NULL;
    if (symbol) {
        peer_entry *entry;
        memcpy(&entry, &symbol, sizeof entry); /* POSIX lets it be called; C does not let it be cast */
        e->method = entry();
    } else {
        read_reason(o, e);
    }
}

static void enter_all(field *f, const options *o)
{
    static const char *const PEERS[] = {"physx", "jolt", "rapier", "bullet", "box2d"};
    enter_tahr(f, "tahr", "native; " TAHR_SAYS, &TAHR_NATIVE);
#ifdef TAHR_HAVE_BOX2D
    enter_tahr(f, "tahr-box2d", "backend box2d, outline as chains; " TAHR_SAYS, &TAHR_BOX2D);
#endif
    for (int i = 0; i < 5; i++) {
        enter_peer(f, o, PEERS[i]);
    }
}

static void print_head(FILE *csv)
{
    printf("%-11s %-12s %9s %9s %9s %7s %7s %9s %6s %6s %6s %9s %9s %6s %6s\n", "course", "method", "ns median",
           "ns p99", "ns cpu", "queries", "tunnel", "embedded", "NaN", "left", "stuck", "deep mm", "clear mm", "way %",
           "flips/s");
    fprintf(csv, "course,method,version,left_out,characters,steps,timed,ns_median,ns_p99,ns_worst,ns_cpu_mean,"
                 "open_seconds,queries,queries_p99,tunnelled,embedded,invalid,left,stuck,bad_characters,deepest,"
                 "clearance,progress,flips,grounded,first_bad_character,first_bad_tick,first_bad_x,first_bad_y,"
                 "first_bad_z,settings\n");
}

/* CSV has its own idea of quotes; a reason may hold any text. */
static void print_quoted(FILE *csv, const char *text)
{
    fputc('"', csv);
    for (; *text; text++) {
        fputs(*text == '"' ? "\"\"" : (char[]){*text, 0}, csv);
    }
    fputc('"', csv);
}

static void print_left_out(FILE *csv, const char *place, const char *who, const char *reason)
{
    printf("%-11s %-12s left out: %s\n", place, who, reason);
    fprintf(csv, "%s,%s,,", place, who);
    print_quoted(csv, reason);
    fprintf(csv, ",,,,,,,,,,,,,,,,,,,,,,,,,,,\n");
}

static void print_row(FILE *csv, const course *c, const method *m, const course_result *r)
{
    printf("%-11s %-12s %9.0f %9.0f %9.0f %7.2f %7llu %9llu %6llu %6llu %6llu %9.3f %9.3f %6.1f %6.2f\n", c->name,
           m->name, r->ns_median, r->ns_p99, r->ns_cpu, r->queries, (unsigned long long)r->tunnelled,
           (unsigned long long)r->embedded, (unsigned long long)r->invalid, (unsigned long long)r->left,
           (unsigned long long)r->stuck, 1e3 * r->deepest, 1e3 * r->clearance, 1e2 * r->progress, r->flips);
    fflush(stdout);
    fprintf(csv, "%s,%s,%s,,%u,%llu,%llu,%.1f,%.1f,%.1f,%.1f,%.6f,%.4f,%.0f,%llu,%llu,%llu,%llu,%llu,%u,", c->name,
            m->name, m->version, r->characters, (unsigned long long)r->steps, (unsigned long long)r->timed,
            r->ns_median, r->ns_p99, r->ns_worst, r->ns_cpu, r->open_seconds, r->queries, r->queries_p99,
            (unsigned long long)r->tunnelled, (unsigned long long)r->embedded, (unsigned long long)r->invalid,
            (unsigned long long)r->left, (unsigned long long)r->stuck, r->bad_characters);
    fprintf(csv, "%.6f,%.6f,%.5f,%.5f,%.5f,", r->deepest, r->clearance, r->progress, r->flips, r->grounded);
    if (r->bad_characters) {
        fprintf(csv, "%u,%u,%.4f,%.4f,%.4f,", r->first_bad_character, r->first_bad_tick, r->first_bad[0],
                r->first_bad[1], r->first_bad[2]);
    } else {
        fprintf(csv, ",,,,,");
    }
    print_quoted(csv, m->settings);
    fputc('\n', csv);
}

/* A batch of everybody in turn until all are done. */
static void run_in_turn(course_run **runs, const entrant *const *entrants, int count, const course_plan *plan)
{
    uint32_t tick = 0;
    int more = 1;
    for (; more; tick += BATCH) {
        more = 0;
        for (int i = 0; i < count; i++) {
            if (isatty(STDERR_FILENO)) {
                fprintf(stderr, "  tick %u of %u: %-12s\r", tick < plan->ticks ? tick : plan->ticks, plan->ticks,
                        entrants[i]->name);
            }
            more = course_advance(runs[i], BATCH) == BATCH || more;
        }
    }
}

static int measure(FILE *csv, const course *c, const field *f, const options *o)
{
    course_run *runs[MAX_METHODS] = {NULL};
    const entrant *open[MAX_METHODS];
    int count = 0, ok = 1;
    course_plan plan = {o->characters, o->ticks, o->seconds};
    for (int i = 0; i < f->count; i++) {
        const entrant *e = &f->entrants[i];
        char error[METHOD_ERROR] = "";
        if (o->method && strcmp(o->method, e->name) != 0) {
            continue;
        }
        if (!e->method) {
            print_left_out(csv, c->name, e->name, e->reason);
            continue;
        }
        runs[count] = course_open(c, e->method, &plan, error);
        if (runs[count]) {
            open[count++] = e;
        } else if (!strstr(error, "dimensions only")) {
            print_left_out(csv, c->name, e->method->name, error);
        }
    }
    run_in_turn(runs, open, count, &plan);
    for (int i = 0; i < count; i++) {
        course_result r;
        if (course_judge(runs[i], &r)) {
            print_row(csv, c, open[i]->method, &r);
        } else {
            print_left_out(csv, c->name, open[i]->method->name, "no memory for the judge");
            ok = 0;
        }
        course_close(runs[i]);
    }
    return ok;
}

/* Whether what was asked for is there. */
static int knows(const field *f, const options *o)
{
    int chosen = o->method == NULL, there = o->course == NULL;
    for (int i = 0; i < f->count; i++) {
        chosen = chosen || strcmp(o->method, f->entrants[i].name) == 0;
    }
    for (int i = 0; i < COURSES; i++) {
        there = there || strcmp(o->course, course_name(i)) == 0;
    }
    if (!chosen || !there) {
        fprintf(stderr, "tahr_peers: no such %s: '%s'\n", chosen ? "course" : "method", chosen ? o->course : o->method);
    }
    return chosen && there;
}

static int measure_all(FILE *csv, const field *f, const options *o)
{
    static course c;
    int ok = 1;
    for (int i = 0; i < COURSES; i++) {
        if (o->course && strcmp(o->course, course_name(i)) != 0) {
            continue;
        }
        fprintf(stderr, "%s (%d of %d) ...\n", course_name(i), i + 1, (int)COURSES);
        course_make(&c, i);
        if (c.missing[0]) {
            print_left_out(csv, c.name, "all", c.missing);
        } else {
            ok = measure(csv, &c, f, o) && ok;
        }
        course_free(&c);
    }
    return ok;
}

int main(int argc, char **argv)
{
    static field f;
    options o;
    int stop = read_options(&o, argc, argv);
    if (stop) {
        return stop - 1;
    }
    enter_all(&f, &o);
    if (!knows(&f, &o)) {
        return 2;
    }
    FILE *csv = fopen(o.csv, "w");
    if (!csv) {
        fprintf(stderr, "tahr_peers: '%s' cannot be written\n", o.csv);
        return 1;
    }
    for (int i = 0; i < f.count; i++) {
        const entrant *e = &f.entrants[i];
        printf("%-12s %s: %s\n", e->name, e->method ? e->method->version : "left out",
               e->method ? e->method->settings : e->reason);
    }
    print_head(csv);
    int ok = measure_all(csv, &f, &o);
    if (fclose(csv) != 0) {
        fprintf(stderr, "tahr_peers: '%s' could not be written in full\n", o.csv);
        ok = 0;
    }
    fprintf(stderr, "written: %s\n", o.csv);
    return !ok;
}
