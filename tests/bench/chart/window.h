/* SPDX-License-Identifier: MIT
 * window.h: how far whole movement is off its path. From many places of a level a character sets off, one way for one
 * second, some with a jump; where it is every 0.1 s is compared with a reference from the very same start: the same
 * numbers by the exact methods on native at a high rate (chart_setting_reference). Short pieces, because two
 * runs that differ by a micrometre at a ledge are metres apart soon afterwards, and that would say nothing about
 * either. A start from which the reference disagrees with itself at half its rate by more than a millimetre decides
 * nothing, and is left out. */
#ifndef TAHR_CHART_WINDOW_H
#define TAHR_CHART_WINDOW_H

#include "row.h"
#include "setting.h"

typedef struct chart_windows chart_windows;

/* Places of a level. Returns NULL and says why (capacity 256). */
chart_windows *chart_windows_make(const bench_world *level, uint32_t count, char *why);
void chart_windows_free(chart_windows *windows);

/* Fills in the errors of a row: of each window the largest distance from the reference. Returns 0 and says why. */
int chart_windows_score(chart_windows *windows, const chart_setting *setting, chart_row *row, char *why);

/* The same of the reference itself at half its rate: what errors below mean nothing. */
int chart_windows_doubt(chart_windows *windows, const chart_setting *setting, chart_row *row, char *why);

#endif
