/* SPDX-License-Identifier: MIT
 * table.c: who is heard, as a table that stays where it is on a terminal (ECMA-48: CSI A up, K and J erase). */
#include "table.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <tahr/tahr.h>
#include <unistd.h>

enum { LINE_MOST = 512 };

#define COLUMNS "%4s %-8s %23s %5s %-6s %-18s " /* with what follows them 79 letters, on a terminal of 80 */

static void take_size(struct table *t)
{
    struct winsize size = {0};
    const int known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 && size.ws_row > 0;
    const int columns = known ? size.ws_col : 80, rows = known ? size.ws_row : 24;
    if (t->drawn > 0 && (columns != t->columns || rows != t->rows)) {
        fputs("\033[H\033[J", stdout); /* lines may have been broken: nobody knows where they are */
        t->drawn = 0;
    }
    t->columns = columns;
    t->rows = rows;
}

/* One line, cut to the width of the terminal, that a longer one from before is not seen behind. */
static void line(struct table *t, const char *format, ...)
{
    char text[LINE_MOST];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    for (char *c = text; *c != '\0'; c++) {
        *c = (unsigned char)*c < ' ' || *c == 127 ? '?' : *c; /* names come from others */
    }
    printf("%.*s\033[K\n", t->columns - 1, text);
    t->drawn++;
}

static double length_of(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static void row_line(struct table *t, const char *prefix, size_t id, const struct roster_row *row)
{
    char name[80], place[64] = "", speed[24] = "", floor[32] = "-", event[64] = "";
    const tahr_state_t *s = &row->state;
    snprintf(name, sizeof name, "%s%zu", prefix, id);
    if (row->has_state) {
        snprintf(place, sizeof place, "%7.2f %7.2f %7.2f", s->position[0], s->position[1], s->position[2]);
        snprintf(speed, sizeof speed, "%.2f", length_of(s->velocity));
        if (s->floor_blocking) {
            snprintf(floor, sizeof floor, "%.3f%s", s->floor_distance, s->floor_walkable ? "" : "^");
        }
    }
    if (row->has_event) {
        const double ago = row->has_state ? (double)(s->time_ns - row->event.time_ns) * 1e-9 : 0;
        snprintf(event, sizeof event, "%s %.1fs", tahr_event_name((uint32_t)row->event.type), ago > 0 ? ago : 0);
    }
    line(t, COLUMNS "%4.0f %4" PRIu64, name, row->has_state ? tahr_mode_name((uint32_t)s->mode) : "", place, speed,
         floor, event, row->rate, row->lost);
}

static void publisher_line(struct table *t, const struct roster_publisher *p)
{
    if (p->has_world) {
        line(t, "%s%slevel '%s' on %s, %" PRId32 " characters; dropped %" PRId64 ", failed %" PRId64, p->prefix,
             *p->prefix ? ": " : "", p->level, p->backend, p->characters, p->dropped, p->failed);
    } else {
        line(t, "%s%snothing is known of its level yet", p->prefix, *p->prefix ? ": " : "");
    }
}

static size_t characters_of(const struct roster *roster)
{
    size_t count = 0;
    for (size_t p = 0; p < roster->publisher_count; p++) {
        for (size_t i = 0; i < roster->publishers[p].row_count; i++) {
            count += roster->publishers[p].rows[i] != NULL;
        }
    }
    return count;
}

/* As many as there is room for. */
static void all_rows(struct table *t, const struct roster *roster)
{
    const size_t count = characters_of(roster);
    const size_t room = t->rows > t->drawn + 2 ? (size_t)(t->rows - t->drawn - 2) : 0; /* "more", and the cursor's */
    size_t shown = 0;
    for (size_t p = 0; p < roster->publisher_count; p++) {
        const struct roster_publisher *publisher = &roster->publishers[p];
        for (size_t i = 0; i < publisher->row_count && shown < room; i++) {
            if (publisher->rows[i] != NULL) {
                row_line(t, publisher->prefix, i, publisher->rows[i]);
                shown++;
            }
        }
    }
    if (shown < count) {
        line(t, "%4s and %zu more", "...", count - shown);
    }
}

void table_draw(struct table *t, const struct roster *roster, const char *title, double rate)
{
    take_size(t);
    if (t->drawn > 0) {
        printf("\033[%dA\r", t->drawn);
    }
    t->drawn = 0;
    line(t, "%s", title);
    for (size_t p = 0; p < roster->publisher_count && t->drawn + 5 < t->rows; p++) {
        publisher_line(t, &roster->publishers[p]);
    }
    line(t, "%" PRIu64 " messages, %.0f/s, %" PRIu64 " lost, %" PRIu64 " of another package or version",
         roster->messages, rate, roster->lost, roster->foreign);
    line(t, COLUMNS "%4s %4s", "id", "mode", "position, m", "m/s", "floor", "last event, ago", "Hz", "lost");
    all_rows(t, roster);
    fputs("\033[J", stdout);
    fflush(stdout);
}
