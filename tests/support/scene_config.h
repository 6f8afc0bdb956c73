/* SPDX-License-Identifier: MIT
 * scene_config.h: the "config" of a scene file. */
#ifndef TAHR_TEST_SCENE_CONFIG_H
#define TAHR_TEST_SCENE_CONFIG_H

#include "scene_file.h"

/* Fills s->config. Returns 0 if something is malformed: s->error says why. */
int scene_config_read(scene *s);

#endif
