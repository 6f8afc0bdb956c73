/* SPDX-License-Identifier: MIT
 * export.h: the bundled playground as a file. */
#ifndef TAHR_CLI_EXPORT_H
#define TAHR_CLI_EXPORT_H

#include <stdio.h>

/* Writes what stands still of it as a Wavefront OBJ; the caller looks for errors of the file. */
void export_playground(FILE *file);

#endif
