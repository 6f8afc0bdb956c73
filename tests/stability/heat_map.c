/* SPDX-License-Identifier: MIT
 * heat_map.c: the matrix as a picture. One map says which variations are clean, one how far off the worst of them
 * was. */
#include "table.h"

#include <math.h>
#include <string.h>

/* Points of the picture. */
enum { CELL_WIDE = 17, CELL_HIGH = 15, GAP = 6, LEFT = 118, TOP = 132, BETWEEN = 46, RIGHT = 150, BELOW = 64 };

static int column_of(int column, uint32_t preset)
{
    return column * (MATRIX_PRESETS * CELL_WIDE + GAP) + (int)(preset - 1) * CELL_WIDE;
}

/* Liars come last, and of them there is no worst. */
static int columns(const matrix *m, int second)
{
    int count = 0;
    while (count < m->subjects && !(second && SUBJECTS[count].lie))
        count++;
    return count;
}

static int map_wide(const matrix *m, int second)
{
    return columns(m, second) * (MATRIX_PRESETS * CELL_WIDE + GAP);
}

/* Escapes what XML does not take as it is. */
static void write_text(FILE *out, const char *text)
{
    for (; *text; text++) {
        if (*text == '<')
            fputs("&lt;", out);
        else if (*text == '&')
            fputs("&amp;", out);
        else if (*text == '"')
            fputs("&quot;", out);
        else
            fputc(*text, out);
    }
}

static const char *clean_colour(const cell *c)
{
    double broken = c->runs ? (double)c->failures / c->runs : 0;
    if (c->what == CELL_NOT_POSSIBLE) return "#eeeeee";
    if (c->what != CELL_DONE) return "#000000";
    if (broken == 0) return c->subject->lie ? "#b9dcf2" : "#8fd19e";
    if (broken < 0.002) return "#ffe9a8";
    if (broken < 0.02) return "#ffc46b";
    return broken < 0.2 ? "#f58d55" : "#d7473f";
}

/* m, by decades from 1e-12 on. */
static const char *worst_colour(const cell *c)
{
    static const char *const shades[] = {"#f1f8f3", "#dff0e3", "#cbe7d3", "#e9ecb8",
                                         "#f8e39a", "#ffc46b", "#f58d55", "#d7473f"};
    double off = fmax(c->worst.deepest, c->worst.apart);
    int let_off = c->preset == TAHR_PRESET_UNREAL && (c->family->unreal_loses & KEEPS_RELATION);
    if (c->what == CELL_NOT_POSSIBLE || c->subject->lie || let_off) return "#eeeeee";
    if (c->what != CELL_DONE) return "#000000";
    int decade = off > 0 ? (int)floor(log10(off)) : -99;
    int shade = decade < -14 ? 0 : decade < -11 ? 1 : decade < -8 ? 2 : decade + 11;
    return shades[shade < 0 ? 0 : shade > 7 ? 7 : shade];
}

static void write_title(FILE *out, const cell *c)
{
    fprintf(out, "<title>");
    write_text(out, c->family->name);
    fprintf(out, ", %s, %s: ", c->subject->name, tahr_preset_name((int32_t)c->preset));
    if (c->what == CELL_NOT_POSSIBLE) {
        fprintf(out, "n/a: %s", c->why);
    } else if (c->what != CELL_DONE) {
        fprintf(out, "%s at seed %llu", c->what == CELL_CRASHED ? "crashed" : "hangs", (unsigned long long)c->seed);
    } else {
        fprintf(out, "%u of %u clean, worst %.1e m, %u queries, %.0f microseconds", c->runs - c->failures, c->runs,
                fmax(c->worst.deepest, c->worst.apart), c->worst.queries, 1e6 * c->slowest);
        if (c->failures) {
            fprintf(out, "; first seed %llu: %s: ", (unsigned long long)c->first_seed, watch_name(c->first.kept));
            write_text(out, c->first.text);
        }
    }
    fprintf(out, "</title>");
}

static void write_map(FILE *out, const matrix *m, int left, int second)
{
    for (int f = 0; f < m->families; f++) {
        for (int s = 0; s < columns(m, second); s++) {
            for (uint32_t p = 1; p <= MATRIX_PRESETS; p++) {
                const cell *c = matrix_cell(m, f, s, p);
                int x = left + column_of(s, p), y = TOP + f * CELL_HIGH;
                fprintf(out, "<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" fill=\"%s\">", x, y, CELL_WIDE - 1,
                        CELL_HIGH - 1, second ? worst_colour(c) : clean_colour(c));
                write_title(out, c);
                fprintf(out, "</rect>\n");
                if (!second && c->what == CELL_DONE && c->failures) {
                    fprintf(out, "<text x=\"%d\" y=\"%d\" class=\"n\">%.0f</text>\n", x + CELL_WIDE / 2, y + 11,
                            ceil(1000.0 * c->failures / c->runs));
                }
            }
        }
    }
}

static void write_heads(FILE *out, const matrix *m, int left, int second)
{
    fprintf(out, "<text x=\"%d\" y=\"46\" class=\"h\">%s</text>\n", left,
            second ? "worst of all steps: nearer than it may be, or off its twin (m)"
                   : "variations that break a promise, per 1000 (none: no number)");
    for (int s = 0; s < columns(m, second); s++) {
        int x = left + column_of(s, 1);
        fprintf(out, "<text transform=\"translate(%d,%d) rotate(-40)\">%s</text>\n", x + 12, TOP - 18,
                SUBJECTS[s].name);
        for (uint32_t p = 1; p <= MATRIX_PRESETS; p++)
            fprintf(out, "<text x=\"%d\" y=\"%d\" class=\"n\">%c</text>\n", left + column_of(s, p) + CELL_WIDE / 2,
                    TOP - 4, tahr_preset_name((int32_t)p)[p == TAHR_PRESET_PLATFORMER ? 1 : 0]);
    }
}

/* What a step may cost at most, of native: a number of queries, and the clock of this machine. */
static void write_costs(FILE *out, const matrix *m, int left)
{
    fprintf(out, "<text x=\"%d\" y=\"%d\" class=\"n\">most</text><text x=\"%d\" y=\"%d\" class=\"n\">queries</text>\n",
            left + 24, TOP - 18, left + 24, TOP - 4);
    fprintf(out,
            "<text x=\"%d\" y=\"%d\" class=\"n\">slowest step</text>"
            "<text x=\"%d\" y=\"%d\" class=\"n\">of native, us</text>\n",
            left + 92, TOP - 18, left + 92, TOP - 4);
    for (int f = 0; f < m->families; f++) {
        uint32_t queries = 0;
        double slowest = 0;
        for (int s = 0; s < m->subjects; s++) {
            for (uint32_t p = 1; p <= MATRIX_PRESETS; p++) {
                const cell *c = matrix_cell(m, f, s, p);
                int native = strcmp(c->subject->name, "native") == 0;
                queries = c->worst.queries > queries ? c->worst.queries : queries;
                slowest = native && c->slowest > slowest ? c->slowest : slowest;
            }
        }
        int y = TOP + f * CELL_HIGH + 11;
        fprintf(out, "<text x=\"%d\" y=\"%d\" class=\"n\">%u</text>\n", left + 24, y, queries);
        if (slowest > 0) fprintf(out, "<text x=\"%d\" y=\"%d\" class=\"n\">%.0f</text>\n", left + 92, y, 1e6 * slowest);
    }
}

void heat_map_svg(FILE *out, const matrix *m, uint32_t seeds)
{
    int second = LEFT + map_wide(m, 0) + BETWEEN, costs = second + map_wide(m, 1);
    int width = costs + RIGHT, height = TOP + m->families * CELL_HIGH + BELOW;
    fprintf(out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\">\n"
            "<style>text{font:11px sans-serif;fill:#222}.n{font-size:9px;text-anchor:middle}"
            ".h{font-size:13px;font-weight:bold}.t{font-size:16px;font-weight:bold}.r{text-anchor:end}</style>\n"
            "<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n"
            "<text x=\"%d\" y=\"24\" class=\"t\">Where methods fail: %u random variations of each hard case</text>\n",
            width, height, width, height, LEFT, seeds);
    write_heads(out, m, LEFT, 0);
    write_heads(out, m, second, 1);
    for (int f = 0; f < m->families; f++)
        fprintf(out, "<text x=\"%d\" y=\"%d\" class=\"r\">%s</text>\n", LEFT - 6, TOP + f * CELL_HIGH + 11,
                FAMILIES[f].name);
    write_map(out, m, LEFT, 0);
    write_map(out, m, second, 1);
    write_costs(out, m, costs);
    int y = TOP + m->families * CELL_HIGH + 22;
    fprintf(
        out,
        "<text x=\"%d\" y=\"%d\">p precise, u unreal, l platformer (seen from the side). Green: clean. Blue: a liar, "
        "and the movement stayed sane. Grey: not possible, or no such number. Black: crashed.</text>\n"
        "<text x=\"%d\" y=\"%d\">Worst, from pale to red: up to 1e-14, 1e-11, 1e-8, then a decade each up to 1 mm "
        "and more. A cell tells its numbers where the picture is opened in a browser.</text>\n</svg>\n",
        LEFT, y, LEFT, y + 18);
}
