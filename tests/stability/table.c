/* SPDX-License-Identifier: MIT
 * table.c: the matrix as text and as CSV. */
#include "table.h"

#include <string.h>

/* What a column is called; subjects' names are longer. */
static const char *short_name(const subject *s)
{
    static const char *const names[][2] = {
        {"sweep-only", "sweeps"},  {"callbacks", "callb."},    {"liar-numbers", "l.nan"}, {"liar-late", "l.late"},
        {"liar-false", "l.false"}, {"liar-normals", "l.norm"}, {"liar-garbage", "l.garb"}};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (strcmp(names[i][0], s->name) == 0) return names[i][1];
    }
    return s->name;
}

void table_head(FILE *out, int subjects)
{
    fprintf(out, "%-13s %-10s", "family", "preset");
    for (int i = 0; i < subjects; i++)
        fprintf(out, " %8s", short_name(&SUBJECTS[i]));
    fprintf(out, " %7s %9s\n", "queries", "worst");
}

static void write_cell(FILE *out, const cell *c)
{
    char text[16] = ".";
    switch (c->what) {
    case CELL_DONE:
        if (c->failures == 0)
            snprintf(text, sizeof text, "ok");
        else
            snprintf(text, sizeof text, "%.4g%%", 100 * (1 - (double)c->failures / c->runs));
        break;
    case CELL_CRASHED: snprintf(text, sizeof text, "CRASH"); break;
    case CELL_HUNG: snprintf(text, sizeof text, "HANGS"); break;
    default: break;
    }
    fprintf(out, " %8s", text);
}

void table_family(FILE *out, const matrix *m, int row)
{
    for (uint32_t p = 1; p <= MATRIX_PRESETS; p++) {
        int any = 0;
        uint32_t queries = 0;
        double worst = 0;
        for (int s = 0; s < m->subjects; s++) {
            const cell *c = matrix_cell(m, row, s, p);
            double off = c->worst.deepest > c->worst.apart ? c->worst.deepest : c->worst.apart;
            any = any || c->what != CELL_NOT_POSSIBLE;
            queries = c->worst.queries > queries ? c->worst.queries : queries;
            worst = strcmp(c->subject->name, "native") == 0 && off > worst ? off : worst;
        }
        if (!any) continue;
        fprintf(out, "%-13s %-10s", FAMILIES[row].name, tahr_preset_name((int32_t)p));
        for (int s = 0; s < m->subjects; s++)
            write_cell(out, matrix_cell(m, row, s, p));
        fprintf(out, " %7u %9.1e\n", queries, worst);
    }
    fflush(out);
}

static void write_broken(FILE *out, const cell *c)
{
    uint64_t seed = c->what == CELL_DONE ? c->first_seed : c->seed;
    fprintf(out, "%s, %s, %s: ", c->family->name, c->subject->name, tahr_preset_name((int32_t)c->preset));
    if (c->what == CELL_DONE) {
        fprintf(out, "%u of %u, first seed %llu, step %d: %s: %s (%.6g, at most %.6g)\n", c->failures, c->runs,
                (unsigned long long)seed, c->first.step, watch_name(c->first.kept), c->first.text, c->first.value,
                c->first.bound);
    } else {
        fprintf(out, "%s at seed %llu\n", c->what == CELL_CRASHED ? "crashed" : "hangs", (unsigned long long)seed);
    }
    fprintf(out, "    tahr_stability --family %s --backend %s --preset %s --seed %llu --trace\n", c->family->name,
            c->subject->name, tahr_preset_name((int32_t)c->preset), (unsigned long long)seed);
}

void table_broken(FILE *out, const matrix *m)
{
    int broken = 0;
    for (uint32_t i = 0; i < m->count; i++)
        broken += !cell_clean(&m->cells[i]);
    if (broken > 0) fprintf(out, "\nbroken:\n");
    for (uint32_t i = 0; i < m->count; i++) {
        if (!cell_clean(&m->cells[i])) write_broken(out, &m->cells[i]);
    }
}

void table_csv(FILE *out, const matrix *m)
{
    fprintf(out, "family,backend,preset,state,runs,failures,insane,first_seed,step,kept,value,bound,nearer_m,apart_m,"
                 "queries,slowest_us,steps,walking,errors,text\n");
    for (uint32_t i = 0; i < m->count; i++) {
        static const char *const states[] = {"open", "done", "n/a", "crashed", "hung"};
        const cell *c = &m->cells[i];
        const measure *w = &c->worst;
        fprintf(out, "%s,%s,%s,%s,%u,%u,%u,%llu,%d,%s,%.9g,%.9g,%.3g,%.3g,%u,%.1f,%u,%u,%u,\"%s\"\n", c->family->name,
                c->subject->name, tahr_preset_name((int32_t)c->preset), states[c->what], c->runs, c->failures,
                c->insane, (unsigned long long)(c->what == CELL_DONE ? c->first_seed : c->seed), c->first.step,
                c->first.kept ? watch_name(c->first.kept) : "", c->first.value, c->first.bound, w->deepest, w->apart,
                w->queries, 1e6 * c->slowest, w->steps, w->walking, w->errors,
                c->what == CELL_NOT_POSSIBLE ? c->why : c->first.text);
    }
}
