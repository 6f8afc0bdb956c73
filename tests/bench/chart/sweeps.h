/* SPDX-License-Identifier: MIT
 * sweeps.h: what belongs to the family of sweeps beside sweeps.c. */
#ifndef TAHR_CHART_SWEEPS_H
#define TAHR_CHART_SWEEPS_H

#include "run.h"

/* Sweeps in a plane, with the backends of two dimensions. */
void chart_plane_sweeps(chart_run *run);

#endif
