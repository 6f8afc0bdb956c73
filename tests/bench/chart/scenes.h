/* SPDX-License-Identifier: MIT
 * scenes.h: ground of any size, for who measures what its size costs. */
#ifndef TAHR_CHART_SCENES_H
#define TAHR_CHART_SCENES_H

#include "bench_world.h"

/* Hills of about so many triangles: of 0.5 m each, or on 100 m by 100 m however fine. To be freed with
 * bench_world_free, also after a failure. 0: out of memory. */
int chart_hills_make(bench_world *level, uint32_t triangles, int constant_area);

#endif
