/* SPDX-License-Identifier: MIT
 * matrix.c: see matrix.h. Workers take the next open cell from a counter in shared memory and write their results
 * there. */
#include "matrix.h"

#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* A cell of thousands of runs takes seconds; who takes this long hangs. */
enum { CELL_SECONDS = 600, SLOW_RUNS = 6, REPETITIONS = 4 };

typedef struct shared {
    atomic_uint next;
    cell cells[];
} shared;

/* Zeroed memory that workers write for their parent; NULL: none. */
static void *share(size_t size)
{
    FILE *file = tmpfile();
    void *memory = MAP_FAILED;
    if (file && ftruncate(fileno(file), (off_t)size) == 0)
        memory = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED, fileno(file), 0);
    if (file) fclose(file);
    return memory == MAP_FAILED ? NULL : memory;
}

static size_t shared_size(uint32_t count)
{
    return sizeof(shared) + count * sizeof(cell);
}

typedef struct slow {
    double seconds;
    uint64_t seed;
} slow;

static void remember_slow(slow *list, double seconds, uint64_t seed)
{
    int least = 0;
    for (int i = 1; i < SLOW_RUNS; i++)
        least = list[i].seconds < list[least].seconds ? i : least;
    if (seconds > list[least].seconds) list[least] = (slow){seconds, seed};
}

/* A clock on a busy machine tells of the machine: of each step the fastest of some repetitions tells of the step. */
static double time_slowest(const cell *c, const slow *list)
{
    double most = 0;
    for (int i = 0; i < SLOW_RUNS && list[i].seconds > 0; i++) {
        outcome best, again;
        run_request q = {c->family, c->subject, c->preset, list[i].seed, 0};
        run(&q, &best);
        for (int k = 1; k < REPETITIONS; k++) {
            run(&q, &again);
            for (int n = 0; n < best.steps; n++)
                best.took[n] = again.took[n] < best.took[n] ? again.took[n] : best.took[n];
        }
        double slowest = outcome_slowest(&best, NULL);
        most = slowest > most ? slowest : most;
    }
    return most;
}

static void add(cell *c, const outcome *out, uint64_t seed)
{
    const measure *w = &out->worst;
    measure *sum = &c->worst;
    c->runs++;
    sum->deepest = w->deepest > sum->deepest ? w->deepest : sum->deepest;
    sum->apart = w->apart > sum->apart ? w->apart : sum->apart;
    sum->used = w->used > sum->used ? w->used : sum->used;
    sum->queries = w->queries > sum->queries ? w->queries : sum->queries;
    sum->steps += w->steps;
    sum->walking += w->walking;
    sum->errors += w->errors;
    if (!out->first.kept) return;
    c->insane += (out->first.kept & KEEPS_SANE) != 0;
    if (c->failures++ == 0) {
        c->first = out->first;
        c->first_seed = seed;
    }
}

static void run_cell(cell *c, const matrix_request *request)
{
    slow list[SLOW_RUNS] = {{0, 0}};
    for (uint64_t seed = request->first_seed; seed < request->first_seed + request->seeds; seed++) {
        run_request q = {c->family, c->subject, c->preset, seed, 0};
        outcome out;
        c->seed = seed;
        run(&q, &out);
        add(c, &out, seed);
        remember_slow(list, outcome_slowest(&out, NULL), seed);
    }
    if (request->timed) c->slowest = time_slowest(c, list);
    c->what = CELL_DONE;
}

static void work(shared *s, uint32_t count, const matrix_request *request, uint32_t *mine)
{
    for (;;) {
        *mine = atomic_fetch_add(&s->next, 1);
        if (*mine >= count) return;
        if (s->cells[*mine].what != CELL_OPEN) continue;
        alarm(CELL_SECONDS);
        run_cell(&s->cells[*mine], request);
    }
}

/* Which cell each worker is at: written by it, read by its parent when it is gone. */
typedef struct crew {
    pid_t pid[MATRIX_JOBS];
    uint32_t *at;
    int jobs;
} crew;

static int hire(crew *c, int i, shared *s, uint32_t count, const matrix_request *request)
{
    fflush(NULL);
    c->pid[i] = fork();
    if (c->pid[i] == 0) {
        work(s, count, request, &c->at[i]);
        _exit(0);
    }
    return c->pid[i] > 0;
}

/* Takes note of who ended; one that did not end well is replaced. Returns how many are at work. */
static int look_after(crew *c, shared *s, uint32_t count, const matrix_request *request)
{
    int working = 0;
    for (int i = 0; i < c->jobs; i++) {
        int status = 0;
        if (c->pid[i] <= 0) continue;
        if (waitpid(c->pid[i], &status, WNOHANG) != c->pid[i]) {
            working++;
            continue;
        }
        c->pid[i] = 0;
        if (WIFEXITED(status) && WEXITSTATUS(status) == 0) continue;
        if (c->at[i] < count) {
            cell *lost = &s->cells[c->at[i]];
            lost->what = WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM ? CELL_HUNG : CELL_CRASHED;
        }
        working += hire(c, i, s, count, request);
    }
    return working;
}

static int family_done(const matrix *m, int row)
{
    uint32_t size = (uint32_t)m->subjects * MATRIX_PRESETS;
    for (uint32_t i = 0; i < size; i++) {
        if (m->cells[(uint32_t)row * size + i].what == CELL_OPEN) return 0;
    }
    return 1;
}

static void show_progress(const matrix *m, int *last)
{
    uint32_t open = 0;
    for (uint32_t i = 0; i < m->count; i++)
        open += m->cells[i].what == CELL_OPEN;
    int percent = (int)(100 * (m->count - open) / m->count);
    if (percent != *last && isatty(STDERR_FILENO)) fprintf(stderr, "\r%3d %%\r", percent);
    *last = percent;
}

static void direct(matrix *m, shared *s, const matrix_request *request, void (*done)(const matrix *, int), uint32_t *at)
{
    crew c = {.at = at, .jobs = request->jobs};
    int reported = 0, percent = -1, working = 0;
    for (int i = 0; i < c.jobs; i++)
        working += hire(&c, i, s, m->count, request);
    while (working > 0) {
        const struct timespec nap = {0, 20000000};
        nanosleep(&nap, NULL);
        working = look_after(&c, s, m->count, request);
        for (; reported < m->families && family_done(m, reported); reported++) {
            if (done) done(m, reported);
        }
        if (!request->quiet) show_progress(m, &percent);
    }
    for (; reported < m->families; reported++) {
        if (done) done(m, reported);
    }
}

static int wanted(const char *name, const char *asked)
{
    return !asked || strcmp(name, asked) == 0;
}

static void lay_out(matrix *m, const matrix_request *request)
{
    cell *c = m->cells;
    for (const family *f = FAMILIES; f->name; f++) {
        for (const subject *s = SUBJECTS; s->name; s++) {
            for (uint32_t p = 1; p <= MATRIX_PRESETS; p++, c++) {
                *c = (cell){.family = f, .subject = s, .preset = p};
                int asked = wanted(f->name, request->family) && wanted(s->name, request->subject) &&
                            (request->preset == 0 || request->preset == p);
                if (!asked || !run_possible(f, s, p, &c->why)) c->what = CELL_NOT_POSSIBLE;
                if (!asked) c->why = "not asked for";
            }
        }
    }
}

int matrix_run(matrix *m, const matrix_request *request, void (*done)(const matrix *m, int row), char *why)
{
    matrix_request own = *request;
    uint32_t count = (uint32_t)family_count() * (uint32_t)subject_count() * MATRIX_PRESETS;
    own.jobs = own.jobs < 1 ? 1 : own.jobs > MATRIX_JOBS ? MATRIX_JOBS : own.jobs;
    size_t size = shared_size(count), crew_size = MATRIX_JOBS * sizeof(uint32_t);
    shared *s = share(size + crew_size);
    if (!s) {
        snprintf(why, 256, "no shared memory");
        return 0;
    }
    atomic_init(&s->next, 0);
    *m = (matrix){.cells = s->cells, .count = count, .subjects = subject_count(), .families = family_count()};
    lay_out(m, &own);
    uint32_t *at = (uint32_t *)((char *)s + size);
    direct(m, s, &own, done, at);
    cell *kept = calloc(count, sizeof *kept);
    if (kept) memcpy(kept, s->cells, count * sizeof *kept);
    munmap(s, size + crew_size);
    m->cells = kept;
    if (!kept) snprintf(why, 256, "out of memory");
    return kept != NULL;
}

void matrix_free(matrix *m)
{
    free(m->cells);
    m->cells = NULL;
}

const cell *matrix_cell(const matrix *m, int row, int column, uint32_t preset)
{
    return &m->cells[((uint32_t)row * (uint32_t)m->subjects + (uint32_t)column) * MATRIX_PRESETS + preset - 1];
}

int cell_clean(const cell *c)
{
    return c->what == CELL_NOT_POSSIBLE || (c->what == CELL_DONE && c->failures == 0);
}

int cell_sane(const cell *c)
{
    return c->what == CELL_NOT_POSSIBLE || (c->what == CELL_DONE && c->insane == 0);
}
