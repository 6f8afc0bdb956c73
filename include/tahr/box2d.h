/* SPDX-License-Identifier: MIT
 * box2d.h: the backend on Box2D, in two dimensions. Not part of libtahr: link libtahr_box2d. */
#ifndef TAHR_BOX2D_H
#define TAHR_BOX2D_H

#include <tahr/backend.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Which Box2D: the newest that this library was built with, 2.4 (C++) or 3 (C). An engine that it was built without is
 * TAHR_E_UNSUPPORTED. */
enum { TAHR_BOX2D_NEWEST = 0, TAHR_BOX2D_2 = 2, TAHR_BOX2D_3 = 3 };

/* What Tahr knows of a fixture (2.4) or a shape (3) of an attached world. */
typedef struct tahr_box2d_shape {
    const void *shape;      /* the b2Fixture of 2.4, a b2ShapeId of 3; valid during the call */
    uint32_t body;          /* its body's id, see tahr_box2d_desc */
    uint32_t flags;         /* TAHR_BODY_SENSOR as Box2D says; ONE_WAY and TWO_SIDED may be added */
    uint32_t surface;       /* handed back in hits and contacts; of 3 the low half of its user material, else 0 */
    uint32_t hidden;        /* 1: not there for characters */
    uint32_t walkable_rule; /* TAHR_WALKABLE_DEFAULT */
    uint32_t reserved;
    double walkable_angle; /* rad */
} tahr_box2d_shape;

/* [in,out] shape: as above, to be changed. Called in queries, for each fixture or shape near a character, from the
 * thread that steps it; must answer the same as long as nothing changes. */
typedef void (*tahr_box2d_shape_fn)(void *user, tahr_box2d_shape *shape);

/* [in] body, the b2Body of 2.4 (not changed). Returns its id: unique, not TAHR_NO_BODY, and always the same. */
typedef uint32_t (*tahr_box2d_body_fn)(void *user, const void *body);

/* Zero means default for every field but struct_size.
 *
 * With world2 or world3 Tahr attaches to a world of yours instead of building one; then desc.bodies must be empty. The
 * world stays yours: Tahr reads it and never changes it, and it must live until tahr_world_close (a world destroyed
 * before that is a crash, and your error). Step it, and create, move and destroy bodies in it, while no step or query
 * of Tahr runs; call tahr_world_touch afterwards, so that who stands still looks again. Characters are carried by
 * kinematic and dynamic bodies as their positions and velocities say; TAHR_EVENT_PUSHED tells which dynamic body to
 * push, and how hard.
 *
 * Ids of bodies in an attached world. 3: (index1 - 1) | (generation & 0xFFF) << 20 of the b2BodyId, for up to 1 048 575
 * bodies. 2.4: what body_id returns, or without it the low 32 bits of b2BodyUserData.pointer: number your bodies from
 * 0. Two bodies of one number are TAHR_E_ARGUMENT when the world is opened. */
typedef struct tahr_box2d_desc {
    uint32_t struct_size;
    uint32_t engine; /* TAHR_BOX2D_* */

    void *world2;    /* b2World of 2.4 */
    uint32_t world3; /* b2StoreWorldId(b2WorldId) of 3 */

    /* Of attached worlds: characters meet what they would as a fixture with this filter: category_bits 0 means 1,
     * mask_bits 0 all; a group as in Box2D, 0 none. Beyond that config.mask chooses among the categories of fixtures
     * (those of 3 folded: bit 32 counts as bit 0). */
    int32_t group_index;
    uint64_t category_bits;
    uint64_t mask_bits;

    void *user;                 /* for the functions */
    tahr_box2d_shape_fn shape;  /* or NULL */
    tahr_box2d_body_fn body_id; /* 2.4 only, or NULL */
} tahr_box2d_desc;

/* The Box2D backend, of one name for both engines; for tahr_world_open, whose desc.options is a tahr_box2d_desc or
 * NULL. The plane is x and y: tahr_mover_create wants config.plane (0, 0, 1) and a gravity without z, as
 * TAHR_PRESET_PLATFORMER has them. Bodies turn about z only. Circles, capsules and boxes as characters; boxes, spheres
 * (circles), capsules, hulls of up to 256 corners, chains as bodies; sensors, fluids, one-way bodies. Box2D finds what
 * is near, distances are computed in double; opened worlds keep the description's doubles, attached ones have Box2D's
 * floats. Queries allocate nothing but what Box2D does beyond 256 open nodes of its tree, and may run on several
 * threads. Static memory. Since 0.1. */
TAHR_API const tahr_backend *tahr_backend_v1_box2d(void);

#ifdef __cplusplus
}
#endif
#endif
