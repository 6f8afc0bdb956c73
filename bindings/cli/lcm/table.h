/* SPDX-License-Identifier: MIT
 * table.h: who is heard, as a table that stays where it is on a terminal. */
#ifndef TAHR_CLI_LCM_TABLE_H
#define TAHR_CLI_LCM_TABLE_H

#include "roster.h"

struct table {
    int drawn;         /* lines that are on the terminal, */
    int columns, rows; /* when it had this size */
};

/* Draws it where it was drawn before; title: its first line. */
void table_draw(struct table *table, const struct roster *roster, const char *title, double rate);

#endif
