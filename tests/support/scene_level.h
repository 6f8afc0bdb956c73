/* SPDX-License-Identifier: MIT
 * scene_level.h: whole levels by name, and a mesh as the body of a world. */
#ifndef TAHR_TEST_SCENE_LEVEL_H
#define TAHR_TEST_SCENE_LEVEL_H

#include <tahr/tahr.h>

#include "scene_mesh.h"

enum { SCENE_LEVELS = 4 };
/* What is walked at length: the two shared levels, and "playground" and "hills", which are generated. */
extern const char *const SCENE_LEVEL_NAMES[SCENE_LEVELS];

/* Makes the mesh of a level: a generated one, or the shared file of this name. Returns 0 and says why (capacity 256) if
 * it is not there or cannot be read. */
int scene_level_make(const char *name, scene_mesh *mesh, char *why);

/* A mesh body that borrows the arrays of the mesh. */
void scene_level_body(const scene_mesh *mesh, tahr_body_desc *body);

#endif
