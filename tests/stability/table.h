/* SPDX-License-Identifier: MIT
 * table.h: the matrix as text, as CSV and as a picture. */
#ifndef STABILITY_TABLE_H
#define STABILITY_TABLE_H

#include "matrix.h"

#include <stdio.h>

void table_head(FILE *out, int subjects);
/* One line for each preset that a family was run with. */
void table_family(FILE *out, const matrix *m, int row);
/* What is broken, and the command that shows it; what is left out, and why. */
void table_broken(FILE *out, const matrix *m);
void table_csv(FILE *out, const matrix *m);

/* A heat map: how many of the variations are clean, and how far off the worst was. */
void heat_map_svg(FILE *out, const matrix *m, uint32_t seeds);

#endif
