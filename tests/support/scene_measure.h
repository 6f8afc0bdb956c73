/* SPDX-License-Identifier: MIT
 * scene_measure.h: what can be measured at the end of a step of a scene. */
#ifndef TAHR_TEST_SCENE_MEASURE_H
#define TAHR_TEST_SCENE_MEASURE_H

#include "scene_check.h"

/* A quantity by its name; NAN if there is none. */
double scene_measure(const scene_case *c, const scene_sample *s, const char *of);

/* m/s: the state's, on a base relative to it; with "world" in the expectation, the base's added. */
tahr_vec3 scene_velocity(const scene_case *c, const scene_sample *s);

/* m between two places. */
double scene_way(const scene_sample *a, const scene_sample *b);

#endif
