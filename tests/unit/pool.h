/* SPDX-License-Identifier: MIT
 * pool.h: a fake world with a sea in it: water below z = 0, everywhere. */
#ifndef POOL_H
#define POOL_H

#include "rig.h"

typedef struct pool {
    fake_world world; /* first: its callbacks take the pool for it */
    tahr_fluid water; /* friction and current; immersion follows from the place */
    int lie;          /* POOL_* */
    uint32_t asked;
} pool;

/* What is wrong with every answer. NOISE: any depth anywhere, without a surface. */
enum { POOL_TRUE, POOL_NAN, POOL_NEGATIVE, POOL_DEEP, POOL_FRICTION, POOL_CURRENT, POOL_STATUS, POOL_LIES, POOL_NOISE };
/* The field that a message about it names. */
extern const char *const pool_fields[POOL_LIES];

/* Water and nothing else. */
void pool_init(pool *p);
void pool_open(rig *r, pool *p, const tahr_config *config, tahr_vec3 at);

/* Part of the preset's capsule (1.8 m) that is under water with its centre at this height. */
double pool_immersion(double z);

/* Steps until `seconds` have passed; counts the changes of mode. */
int pool_run(rig *r, double seconds, double dt);

#endif
