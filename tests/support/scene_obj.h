/* SPDX-License-Identifier: MIT
 * scene_obj.h: the shared levels, if they are there: a minimal reader of Wavefront OBJ files. */
#ifndef TAHR_TEST_SCENE_OBJ_H
#define TAHR_TEST_SCENE_OBJ_H

#include <stddef.h>

#include "scene_mesh.h"

/* Adds the vertices and faces (fans of triangles) of a Y-up file to a Z-up mesh. Returns 0 and an explanation in error
 * (capacity 256) if it cannot be read. */
int scene_obj_read(const char *path, scene_mesh *mesh, char *error);

/* Where a level of this name would be: in $TAHR_LEVELS, or beside the sources in ../shared/levels. Returns 0 if no such
 * file can be opened. */
int scene_obj_find(const char *name, char *path, size_t capacity);

#endif
