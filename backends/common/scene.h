/* SPDX-License-Identifier: MIT
 * scene.h: the bodies of a scene in space: who they are, what they are made of, where they are. A backend whose engine
 * only finds them keeps the rest here. Slots take a scene that begins with a tahr__scene for self. */
#ifndef TAHR_COMMON_SCENE_H
#define TAHR_COMMON_SCENE_H

#include "fluid.h"
#include "piece.h"
#include "surface.h"

typedef struct tahr__scene_body {
    tahr__surface surface;
    uint32_t kind;      /* TAHR_BODY_*, or one of the backend's own */
    uint32_t two_sided; /* of a mesh */
    tahr_pose pose;
    tahr__mat turn;         /* local to world */
    tahr_vec3 half_extents; /* of a box, an ellipsoid */
    double radius;          /* of a sphere, capsule, cylinder, cone */
    double reach;           /* along z: half the axis of a capsule, half the height of a cylinder, a cone */
    tahr__hull hull;
    const tahr__mesh *mesh;     /* of the scene */
    tahr_vec3 surface_velocity; /* local */
    double mass;
} tahr__scene_body;

typedef struct tahr__scene {
    const tahr_host *host;
    tahr__scene_body *bodies;
    tahr__mesh *meshes;
    uint32_t body_count, mesh_count, capacity;
    uint32_t described; /* the first of the bodies: those that the core described, whose ids are their places */
    tahr__fluids fluids;
} tahr__scene;

/* The bodies and fluids of desc, and room for more bodies. scene: zeroed; to be closed in any case. TAHR_OK,
 * TAHR_E_UNSUPPORTED, TAHR_E_GEOMETRY, TAHR_E_MEMORY. */
tahr_status tahr__scene_open(tahr__scene *scene, const tahr_host *host, const tahr_world_desc *desc, uint32_t more);
void tahr__scene_close(tahr__scene *scene);

/* The next body as it is described, but for a mesh or a hull. NULL: there is no room. */
tahr__scene_body *tahr__scene_add(tahr__scene *scene, const tahr_body_desc *desc, uint32_t id);
/* The next mesh. NULL: [out] status says why. */
const tahr__mesh *tahr__scene_mesh(tahr__scene *scene, const tahr__mesh_source *source, tahr_status *status);
/* The place slot: of all the bodies or of none. TAHR_OK; TAHR_E_NOT_FOUND, TAHR_E_ARGUMENT (not movable, not finite or
 * beyond 1e8 m), and says why in the log of the host. */
tahr_status tahr__scene_place(void *self, const tahr_body_pose *poses, uint32_t count);

/* The body of that name, or NULL. */
const tahr__scene_body *tahr__scene_find(const tahr__scene *scene, uint32_t id);
static inline int tahr__bounds_meet(const tahr_bounds *a, const tahr_bounds *b)
{
    return a->min.x <= b->max.x && b->min.x <= a->max.x && a->min.y <= b->max.y && b->min.y <= a->max.y &&
           a->min.z <= b->max.z && b->min.z <= a->max.z;
}
/* World bounds; those of round sides are their box's. */
tahr_bounds tahr__scene_bounds(const tahr__scene_body *body);
/* Of a TAHR_SHAPE_HULL the body that lends it its vertices, or NULL. */
const tahr__hull *tahr__scene_hull(const tahr__scene *scene, const tahr_shape *shape);
/* The piece that a body is, or of a mesh one of its triangles. */
void tahr__scene_piece(const tahr__scene_body *body, const tahr__placement *frame, uint32_t triangle,
                       tahr__piece *piece);

/* Of the describe slot: a line of how many bodies of which kinds, the backend's own about the way that its queries
 * take, and one of each mesh. name: of the backend. */
void tahr__scene_describe(const tahr__scene *scene, const char *name, const char *path, const tahr_log *to);

/* The fluid slot. */
tahr_status tahr__scene_fluid(void *self, tahr_query_context *context, const tahr_fluid_query *query,
                              tahr_fluid *answer);

#endif
