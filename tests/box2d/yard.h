/* SPDX-License-Identifier: MIT
 * yard.h: a Box2D world of the test's own, in either version, behind one set of functions: bodies of one shape, named
 * by the ids that Tahr will give them. */
#ifndef TAHR_TEST_YARD_H
#define TAHR_TEST_YARD_H

#include <tahr/box2d.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { YARD_STATIC, YARD_KINEMATIC, YARD_DYNAMIC };
enum { YARD_BOX, YARD_CIRCLE, YARD_CAPSULE, YARD_EDGE, YARD_CHAIN };

typedef struct yard_body {
    int type, shape, sensor;
    double x, y, angle;
    double a, b; /* box: half sizes; circle: radius; capsule, edge: half length along local y, x; and radius */
    const double *corners; /* of a chain: 2 per corner, the first and the last are ghosts */
    int corner_count;
    int group;
    uint64_t category, mask; /* 0: 1 and all */
} yard_body;

typedef struct yard {
    const char *name;
    int has_capsule;
    void *(*open)(void);
    void (*close)(void *world);
    void (*attach)(void *world, tahr_box2d_desc *options);
    uint32_t (*add)(void *world, const yard_body *body); /* returns its id */
    void (*remove)(void *world, uint32_t id);
    void (*drive)(void *world, uint32_t id, double vx, double vy, double turn);
    void (*step)(void *world, double dt);
    void (*where)(void *world, uint32_t id, double at[3]); /* x, y, angle */
} yard;

#ifdef TAHR_BOX2D_HAS_2
extern const yard yard_2;
#endif
#ifdef TAHR_BOX2D_HAS_3
extern const yard yard_3;
#endif

#ifdef __cplusplus
}
#endif
#endif
