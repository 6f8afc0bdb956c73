/* SPDX-License-Identifier: MIT
 * scene_bodies.h: the "bodies" of a scene file. */
#ifndef TAHR_TEST_SCENE_BODIES_H
#define TAHR_TEST_SCENE_BODIES_H

#include "scene_file.h"

/* Fills s->bodies and s->meshes. Returns 0 if something is malformed: s->error says why. */
int scene_bodies_read(scene *s);

#endif
