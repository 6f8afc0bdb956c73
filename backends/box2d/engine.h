/* SPDX-License-Identifier: MIT
 * engine.h: what an engine (Box2D 2.4 or 3) does for the backend: find what is near, in its own trees or in a world of
 * the user's. C and C++. */
#ifndef TAHR_BOX2D_ENGINE_H
#define TAHR_BOX2D_ENGINE_H

#include "../common/surface.h"
#include "flat.h"

#include <tahr/box2d.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct tahr__b2_box {
    tahr__vec2 low, high;
} tahr__b2_box;

enum { TAHR__B2_NO_GHOST = 0, TAHR__B2_GHOST_BEFORE = 1, TAHR__B2_GHOST_AFTER = 2 };

/* A convex piece of a body, relative to the query's start. */
typedef struct tahr__b2_piece {
    tahr__surface owner; /* mask: to be matched with the query's */
    uint32_t feature;    /* of face 0; the next faces count up */
    uint32_t is_box;     /* faces are named as those of a box: -x 0, +x 1, -y 2, +y 3 */
    uint32_t ghosts;     /* of a segment: where its line goes on though nothing is there */
    uint32_t reserved;
    tahr__vec2 before, after;
    tahr__flat flat;
} tahr__b2_piece;

typedef void (*tahr__b2_take_fn)(void *user, tahr__b2_piece *piece);

/* What a query asks an attached world for. */
typedef struct tahr__b2_search {
    tahr__b2_box box;  /* world */
    tahr__vec2 origin; /* pieces are relative to it */
    tahr__b2_take_fn take;
    void *user;
} tahr__b2_search;

typedef void (*tahr__b2_found_fn)(void *user, uint32_t item);

typedef struct tahr__b2_engine {
    const char *version;

    /* A tree of boxes, each with a number. open: NULL without memory; add: the proxy, negative without memory; move:
     * the new proxy. */
    void *(*tree_open)(void);
    void (*tree_close)(void *tree);
    int32_t (*tree_add)(void *tree, const tahr__b2_box *box, uint32_t item);
    int32_t (*tree_move)(void *tree, int32_t proxy, const tahr__b2_box *box, uint32_t item);
    void (*tree_ask)(const void *tree, const tahr__b2_box *box, tahr__b2_found_fn found, void *user);

    /* A world of the user's. check: NULL, or what is wrong with it. */
    const char *(*world_check)(const tahr_box2d_desc *desc);
    void (*world_ask)(const tahr_box2d_desc *desc, const tahr__b2_search *search);
    tahr_status (*world_motion)(const tahr_box2d_desc *desc, uint32_t body, tahr_body_motion *motion);
} tahr__b2_engine;

/* NULL where the library was built without. */
#ifdef TAHR_BOX2D_HAS_2
extern const tahr__b2_engine tahr__b2_engine_2;
#endif
#ifdef TAHR_BOX2D_HAS_3
extern const tahr__b2_engine tahr__b2_engine_3;
#endif

/* What both engines share about attached worlds. */

/* Category and mask as Box2D matches them, with the group's exception. */
static inline int tahr__b2_filter(const tahr_box2d_desc *desc, uint64_t category, uint64_t mask, int32_t group)
{
    uint64_t own = desc->category_bits ? desc->category_bits : 1u,
             wants = desc->mask_bits ? desc->mask_bits : ~(uint64_t)0;

    if (group != 0 && group == desc->group_index) return group > 0;
    return (wants & category) != 0 && (mask & own) != 0;
}

/* A quaternion about z from the cosine and sine of a rotation. */
static inline tahr_quat tahr__b2_quat(double c, double s)
{
    double size = sqrt(c * c + s * s), w, z;
    tahr_quat q = {0, 0, 0, 1};

    if (!(size > 0)) return q;
    c /= size;
    s /= size;
    if (c >= 0) {
        w = sqrt(0.5 * (1 + c));
        z = s / (2 * w);
    } else {
        z = s < 0 ? -sqrt(0.5 * (1 - c)) : sqrt(0.5 * (1 - c));
        w = s / (2 * z);
    }
    q.z = z;
    q.w = w;
    return q;
}

/* A float not above (down) or not below (up) a double. */
static inline float tahr__b2_down(double x)
{
    return (float)(x - (fabs(x) * 2.4e-7 + 1e-30));
}

static inline float tahr__b2_up(double x)
{
    return (float)(x + (fabs(x) * 2.4e-7 + 1e-30));
}

#ifdef __cplusplus
}
#endif
#endif
