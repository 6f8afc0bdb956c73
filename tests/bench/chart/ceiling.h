/* SPDX-License-Identifier: MIT
 * ceiling.h: what more processors give on this machine at all. */
#ifndef TAHR_CHART_CEILING_H
#define TAHR_CHART_CEILING_H

#include "throng.h"

/* Times ticks of a crowd on one thread while others like it, each in a process, a memory and on a processor of its own,
 * do the same: count crowds, that of the caller among them. They share nothing but what the machine makes them share, so
 * that one crowd on count threads cannot be faster than all of them together. [out] ns: of a character in every tick,
 * count of them as one: 1/count of the time of the caller's. Returns NULL, or what went wrong. */
const char *chart_ceiling(const bench_world *level, uint32_t characters, uint32_t count, double *ns, uint32_t ticks);

#endif
