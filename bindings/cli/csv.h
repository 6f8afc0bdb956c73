/* SPDX-License-Identifier: MIT
 * csv.h: one row per character and step. */
#ifndef TAHR_CLI_CSV_H
#define TAHR_CLI_CSV_H

#include <stdio.h>
#include <tahr/tahr.h>

struct csv_row {
    uint64_t step;
    double time; /* s, at the end of the step */
    uint32_t character;
    const tahr_state *state;
    const tahr_report *report;
};

void csv_header(FILE *file);
void csv_write(FILE *file, const struct csv_row *row);

#endif
