/* SPDX-License-Identifier: MIT
 * csv.c: one row per character and step. */
#include "csv.h"

#include <inttypes.h>

void csv_header(FILE *file)
{
    fputs("step,time,character,x,y,z,vx,vy,vz,mode,floor_blocking,floor_walkable,floor_perching,floor_wedged,floor_"
          "distance,"
          "sweeps,contact_queries,rays,triangle_tests,step_offset,events\n",
          file);
}

void csv_write(FILE *file, const struct csv_row *row)
{
    const tahr_state *s = row->state;
    const tahr_report *r = row->report;
    uint32_t floor = s->floor.flags;
    /* 12 digits: a micrometre at 1000 km, and files of a bearable size. */
    fprintf(file, "%" PRIu64 ",%.12g,%u,%.12g,%.12g,%.12g,%.12g,%.12g,%.12g,%s,", row->step, row->time, row->character,
            s->position.x, s->position.y, s->position.z, s->velocity.x, s->velocity.y, s->velocity.z,
            tahr_mode_name(s->mode));
    fprintf(file, "%d,%d,%d,%d,", (floor & TAHR_FLOOR_BLOCKING) != 0, (floor & TAHR_FLOOR_WALKABLE) != 0,
            (floor & TAHR_FLOOR_PERCHING) != 0, (floor & TAHR_FLOOR_WEDGED) != 0);
    if (floor & TAHR_FLOOR_BLOCKING) {
        fprintf(file, "%.12g", s->floor.distance);
    }
    fprintf(file, ",%u,%u,%u,%" PRIu64 ",%.12g,", r->sweeps, r->contact_queries, r->rays, r->triangle_tests,
            r->step_offset);
    for (uint32_t i = 0; i < r->event_count; i++) {
        /* name@seconds into the step, separated by blanks */
        fprintf(file, "%s%s@%.9g", i ? " " : "", tahr_event_name(r->events[i].type), r->events[i].time);
    }
    fputc('\n', file);
}
