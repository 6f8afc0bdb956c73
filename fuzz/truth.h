/* SPDX-License-Identifier: MIT
 * truth.h: how far a round shape is from a scene, by brute force in double: nothing of it is shared with any
 * backend. */
#ifndef TAHR_FUZZ_TRUTH_H
#define TAHR_FUZZ_TRUTH_H

#include "scene.h"

/* Whether truth_gap can tell of this shape in this scene: a sphere or a capsule, and nothing moves. */
int truth_knows(const scene *s, const tahr_shape *shape);

/* m from an upright shape to what blocks on both sides: solids and two-sided meshes; at most `reach`. Below 0 it is in
 * something: by how much only as long as its axis is not. */
double truth_gap(const scene *s, const tahr_shape *shape, tahr_vec3 position, tahr_vec3 up, double reach);

#endif
