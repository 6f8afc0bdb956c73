/* SPDX-License-Identifier: MIT
 * engine_v3.c: the geometry of a Box2D world, version 3. */
#include <box2d/box2d.h>

extern int tahr__box2d_engine_v3;
int tahr__box2d_engine_v3 = 1;
