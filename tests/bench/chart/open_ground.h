/* SPDX-License-Identifier: MIT
 * open_ground.h: speeding up, braking and a jump on a plane, against their closed forms
 * (tests/accuracy/forms.h). */
#ifndef TAHR_CHART_OPEN_GROUND_H
#define TAHR_CHART_OPEN_GROUND_H

#include "row.h"
#include "setting.h"

/* Fills in the errors of a row: of the place every 0.1 s. Returns 0 and says why (capacity 256). */
int chart_open_ground_score(const bench_world *plane, const chart_setting *setting, chart_row *row, char *why);

#endif
