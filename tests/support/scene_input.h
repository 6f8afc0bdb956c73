/* SPDX-License-Identifier: MIT
 * scene_input.h: the "inputs" of a scene file. */
#ifndef TAHR_TEST_SCENE_INPUT_H
#define TAHR_TEST_SCENE_INPUT_H

#include "scene_file.h"

/* Reads one of them. Returns 0 if something is malformed: s->error says why. */
int scene_input_read(scene *s, json_t *item, scene_input *in);

/* What is asked for in the step that begins at this time: launches, impulses and modes only in the first step of their
 * input. */
tahr_input scene_input_at(const scene *s, double time);

#endif
