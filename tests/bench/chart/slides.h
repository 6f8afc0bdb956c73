/* SPDX-License-Identifier: MIT
 * slides.h: whole movement along walls, edges and gutters, against the stored exact slides (tests/accuracy). */
#ifndef TAHR_CHART_SLIDES_H
#define TAHR_CHART_SLIDES_H

#include "row.h"
#include "setting.h"

/* Whether a setting matters there. */
int chart_slides_concern(const chart_setting *setting);

/* Flies every stride-th slide, and fills in everything of a row but its names. Settings of the curve "skin" go along bare walls, a skin off the path
 * that is right there; all others along walls with the slides' own skin, which is right. Returns 0 and says why
 * (capacity 256). */
int chart_slides_measure(const chart_setting *setting, uint32_t stride, chart_row *row, char *why);

#endif
