/* SPDX-License-Identifier: MIT
 * scene_solid.h: an independent look at a mesh: how near it is, whether a segment went through it. It shares
 * no code with the library: its own grid, its own geometry. */
#ifndef TAHR_TEST_SCENE_SOLID_H
#define TAHR_TEST_SCENE_SOLID_H

#include <tahr/types.h>

#include "scene_mesh.h"

typedef struct scene_solid scene_solid;

/* mesh must stay as it is. NULL: out of memory. */
scene_solid *scene_solid_open(const scene_mesh *mesh, int two_sided);
void scene_solid_close(scene_solid *solid);

/* The nearest triangle (one-sided: of those that face the middle of the segment a b): its distance, at most limit.
 * index may be NULL. */
double scene_solid_distance(const scene_solid *solid, tahr_vec3 a, tahr_vec3 b, double limit, uint32_t *index);

/* Whether the way from a to b leads through a triangle (one-sided: from its front to its back). index may be NULL. */
int scene_solid_crossed(const scene_solid *solid, tahr_vec3 a, tahr_vec3 b, uint32_t *index);

#endif
