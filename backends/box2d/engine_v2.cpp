/* SPDX-License-Identifier: MIT
 * engine_v2.cpp: the geometry of a Box2D world, version 2. */
#include <box2d/box2d.h>

extern int tahr__box2d_engine_v2;
int tahr__box2d_engine_v2 = 1;
