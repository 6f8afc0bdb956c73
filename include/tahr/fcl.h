/* SPDX-License-Identifier: MIT
 * fcl.h: the backend on FCL, the Flexible Collision Library. Not part of libtahr: link libtahr_fcl. */
#ifndef TAHR_FCL_H
#define TAHR_FCL_H

#include <tahr/backend.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The bounding volumes of a mesh's tree (of those that Tahr builds; an attached model keeps its own). */
enum { TAHR_FCL_AABB = 0, TAHR_FCL_OBBRSS = 1 };

/* How the triangles near a shape are found. DESCEND: FCL's tree is descended by its volumes' overlap test. COLLIDE:
 * fcl::collide lists the triangles that meet a box. The same answers; COLLIDE is slower and allocates. An attached
 * model of RSS, which have no cheap overlap test, is always asked by COLLIDE, one of AABB or KDOP never (FCL would copy
 * it). */
enum { TAHR_FCL_DESCEND = 0, TAHR_FCL_COLLIDE = 1 };

/* A map of voxels: the union of its occupied cells is solid, unknown is free. From a file of OctoMap (.bt, or .ot with
 * plain nodes), or from points: every cell with a point in it is occupied. Read at open only. Of body (NULL: all
 * defaults) are read flags (SENSOR, ONE_WAY, NO_BASE, NO_STEP), mask, pose, walkable_rule, walkable_angle, surface and
 * surface_velocity. */
typedef struct tahr_fcl_octree {
    const char *path;           /* NULL: from points */
    const double *points;       /* 3 per point, m, local, finite */
    uint32_t point_count;       /* at least 1, without a path */
    uint32_t reserved;          /* 0 */
    double resolution;          /* m, edge of a cell, 1e-3..1e3; of a file 0 */
    const tahr_body_desc *body; /* or NULL */
} tahr_fcl_octree;

/* Who an attached object is. [in] object: the fcl::CollisionObject<double>. [in,out] *body: its id, preset to its place
 * in the manager's list; each id once. [in,out] desc, preset to tahr_body_desc_init's defaults: flags, mask,
 * walkable_rule, walkable_angle, surface, surface_velocity, mass. A negative status fails the opening with it;
 * TAHR_E_NOT_FOUND leaves the object out. Called once per object by tahr_world_open, in its thread. */
typedef tahr_status (*tahr_fcl_object_fn)(void *user, const void *object, uint32_t *body, tahr_body_desc *desc);

/* How an attached object moves, as tahr_body_fn; *motion comes with the object's pose, at rest, and what desc said. */
typedef tahr_status (*tahr_fcl_motion_fn)(void *user, const void *object, uint32_t body, tahr_body_motion *motion);

/* An occupied cell of octrees[octree], local. */
typedef void (*tahr_fcl_cell_fn)(void *user, uint32_t octree, const tahr_bounds *cell);

/* Zero means default for every field but struct_size.
 *
 * Attaching: manager is a fcl::DynamicAABBTreeCollisionManager<double> with its objects registered and set up,
 * borrowed: it, its objects and their geometries must stay until the world is closed. Meshes are copied (FCL's tree is
 * not); all else is read where it is, by every query. The world then has no bodies of its own. While queries run
 * nothing may change the manager; before they do again: whoever moved an object has called its computeAABB and
 * manager.update, and then tahr_world_touch. Objects unregistered are gone at once (their memory must stay); objects
 * registered later are not seen, and geometries must not change, but octrees may. Held are BVHModels of triangles with
 * volumes of every kind, Box, Sphere, Capsule, Cylinder, Cone, Ellipsoid, Convex, TriangleP, Halfspace, Plane and
 * OcTree, of 1e-6 to 1e6 m; what else there is, or is not placed by a rotation and a finite place, is
 * TAHR_E_UNSUPPORTED unless the callback leaves it out. */
typedef struct tahr_fcl_desc {
    uint32_t struct_size;
    uint32_t volumes;     /* TAHR_FCL_AABB or _OBBRSS */
    uint32_t search;      /* TAHR_FCL_DESCEND or _COLLIDE */
    uint32_t no_cache;    /* 1: every query asks FCL; same bits */
    uint32_t cache_parts; /* per character, default 256, at most 65536, 16 bytes each; what exceeds it is slower */
    uint32_t octree_count;
    double cache_margin;            /* m around the announced box, default 0.5; 0..1000 */
    const tahr_fcl_octree *octrees; /* their ids follow those of the bodies */
    tahr_fcl_cell_fn cell;          /* told about every cell of octrees at open, or NULL */
    void *cell_user;
    void *manager;
    tahr_fcl_object_fn object; /* NULL: the presets */
    tahr_fcl_motion_fn motion; /* NULL: objects are at rest wherever they are */
    void *user;                /* of object and motion */
} tahr_fcl_desc;

/* The FCL backend: FCL finds the candidates (its AABB tree of bodies, its BVH of triangles, its octrees), the core
 * distance decides. Bodies: triangle meshes, boxes, spheres, capsules, cylinders, cones, ellipsoids and convex hulls;
 * characters: all but meshes. For tahr_world_open, whose desc.options is a tahr_fcl_desc or NULL. Queries may run on
 * several threads; they allocate where backends/fcl/README.md says so. Statuses of opening beside tahr_world_open's:
 * TAHR_E_NOT_FOUND (octree file), TAHR_E_GEOMETRY (octree file or points; a model that is no tree of triangles),
 * TAHR_E_ARGUMENT (a field out of range; bodies beside a manager; an id twice), TAHR_E_UNSUPPORTED (geometry that
 * cannot be held, or that FCL does not find where it is). Static memory. Since 0.1. */
TAHR_API const tahr_backend *tahr_backend_v1_fcl(void);

#ifdef __cplusplus
}
#endif
#endif
