/* SPDX-License-Identifier: MIT
 * engine.h: FCL behind a C seam. The engine holds FCL's objects and finds candidates; everything that decides is C and
 * knows nothing of FCL. No exception leaves these functions. Bodies are named by their index, in the order in which
 * they were added. */
#ifndef TAHR_FCL_ENGINE_H
#define TAHR_FCL_ENGINE_H

#ifdef __cplusplus
extern "C" {
#endif

#include "../common/mesh.h"

#include <tahr/fcl.h>

typedef struct tahr__fcl_engine tahr__fcl_engine;

/* What may be near: a body, and of a mesh the triangle (in the order in which the engine was given them), of an octree
 * the cell: depth levels below the root, key of its lowest corner at the finest level. */
typedef struct tahr__fcl_part {
    uint32_t body;
    uint32_t triangle;
    uint16_t key[3];
    uint16_t depth;
} tahr__fcl_part;

/* Octrees have this many levels, and keys in the middle of their range at the origin. */
enum { TAHR__FCL_LEVELS = 16, TAHR__FCL_ORIGIN = 1 << 15 };

/* Geometry of an attached object; whole is the body's own kind or 0 for what none of them is. */
enum { TAHR__FCL_OCTREE = 100, TAHR__FCL_HALF_SPACE, TAHR__FCL_PLANE };

typedef struct tahr__fcl_geometry {
    uint32_t kind;          /* TAHR_BODY_MESH to _HULL or one of the above; 0: not held */
    uint32_t two_sided;     /* of a mesh */
    tahr_vec3 half_extents; /* of a box, an ellipsoid; normal of a half space */
    double radius, reach;   /* of a half space its offset; of an octree its resolution */
    const double *vertices; /* of a mesh, a hull */
    const uint32_t *indices;
    uint32_t vertex_count, triangle_count;
    const void *identity; /* equal for objects that share their geometry */
    const char *name;     /* for messages */
} tahr__fcl_geometry;

/* What to ask: everything that may reach into box, of the bodies for which wants(user, body) is not 0. */
typedef struct tahr__fcl_question {
    tahr_bounds box;                               /* world */
    int (*wants)(const void *user, uint32_t body); /* NULL: everything */
    const void *user;
} tahr__fcl_question;

/* The answer: room for capacity parts; more make the list grow by the host's allocator. */
typedef struct tahr__fcl_list {
    const tahr_host *host;
    tahr__fcl_part *parts; /* own, or grown */
    uint32_t count, capacity;
    uint32_t grown; /* parts were allocated */
    tahr_status status;
} tahr__fcl_list;

/* list.c */
void tahr__fcl_list_begin(tahr__fcl_list *list, const tahr_host *host, tahr__fcl_part *room, uint32_t capacity);
void tahr__fcl_list_add(tahr__fcl_list *list, const tahr__fcl_part *part);
/* By (body, triangle, cell): FCL's order depends on how its trees came about. */
void tahr__fcl_list_sort(tahr__fcl_list *list);
void tahr__fcl_list_free(tahr__fcl_list *list);

/* engine.cpp: life cycle. Statuses: TAHR_OK, TAHR_E_MEMORY, TAHR_E_BACKEND (an exception). */
tahr_status tahr__fcl_engine_open(const tahr_host *host, const tahr_fcl_desc *desc, tahr__fcl_engine **engine);
void tahr__fcl_engine_close(tahr__fcl_engine *engine);
tahr_status tahr__fcl_engine_add(tahr__fcl_engine *engine, const tahr__fcl_geometry *geometry, const tahr_pose *pose);
tahr_status tahr__fcl_engine_finish(tahr__fcl_engine *engine);
tahr_status tahr__fcl_engine_place(tahr__fcl_engine *engine, uint32_t body, const tahr_pose *pose);
tahr_status tahr__fcl_engine_update(tahr__fcl_engine *engine);

/* gather.cpp */
tahr_status tahr__fcl_engine_gather(const tahr__fcl_engine *engine, const tahr__fcl_question *question,
                                    tahr__fcl_list *list);
/* Does FCL find this triangle of a mesh at a place (local) that it has, or this whole body at all? A known overlap. */
int tahr__fcl_engine_finds(const tahr__fcl_engine *engine, uint32_t body, uint32_t triangle, const tahr_vec3 *at);

/* octree.cpp: octrees by file or points; then added like any other geometry (kind TAHR__FCL_OCTREE, identity = the
 * handle, resolution = radius). */
tahr_status tahr__fcl_octree_read(tahr__fcl_engine *engine, const tahr_host *host, const tahr_fcl_octree *desc,
                                  tahr__fcl_geometry *geometry);
/* Is the cell of the finest level with this key occupied? Keys out of range are free. */
int tahr__fcl_engine_occupied(const tahr__fcl_engine *engine, uint32_t body, const int32_t key[3]);
/* Tells visit about every occupied cell. */
void tahr__fcl_engine_cells(const tahr__fcl_engine *engine, uint32_t body,
                            void (*visit)(void *user, const tahr__fcl_part *cell), void *user);

/* attach.cpp: the objects of a user's manager, which the engine takes over in the order of its list. */
tahr_status tahr__fcl_engine_attach(tahr__fcl_engine *engine, uint32_t *count);
/* The i-th of them; vertices and indices are in the engine's memory until the next call. */
tahr_status tahr__fcl_engine_object(tahr__fcl_engine *engine, uint32_t i, const void **object,
                                    tahr__fcl_geometry *geometry);
/* Takes the i-th object in as the next body. Of a mesh order[source triangle] is the triangle, or UINT32_MAX. */
tahr_status tahr__fcl_engine_adopt(tahr__fcl_engine *engine, uint32_t i, const tahr__fcl_geometry *geometry,
                                   const uint32_t *order);
/* Where an attached body is now. */
void tahr__fcl_engine_pose(const tahr__fcl_engine *engine, uint32_t body, tahr_pose *pose, tahr__mat *turn);
const void *tahr__fcl_engine_object_of(const tahr__fcl_engine *engine, uint32_t body);

#ifdef __cplusplus
}
#endif
#endif
