/* SPDX-License-Identifier: MIT
 * scene.h: what the parts of the fcl backend share: bodies, and a query with the pieces that FCL finds for it. */
#ifndef TAHR_FCL_SCENE_H
#define TAHR_FCL_SCENE_H

#include "engine.h"

#include "../common/fluid.h"
#include "../common/piece.h"
#include "../common/surface.h"

typedef struct tahr__fcl_body {
    tahr__surface surface;
    uint32_t kind; /* TAHR_BODY_* or TAHR__FCL_* */
    uint32_t mesh; /* index of its mesh in the scene */
    tahr_vec3 position;
    tahr__mat turn;
    tahr_pose pose;
    tahr_vec3 half_extents; /* of a box, an ellipsoid, a hull; normal of a half space */
    double radius, reach;   /* see tahr__fcl_geometry */
    tahr__hull hull;
    uint32_t two_sided, reserved;
    tahr_vec3 surface_velocity; /* octrees and attached bodies: the core does not know them */
    double mass;
} tahr__fcl_body;

typedef struct tahr__fcl_scene {
    const tahr_host *host;
    tahr_fcl_desc desc;
    tahr__fcl_engine *engine;
    tahr__fcl_body *bodies;
    tahr__mesh *meshes;
    const void **identities; /* of the geometries that the meshes are of, attached ones */
    uint32_t body_count, body_capacity, mesh_count, described; /* bodies that the core described */
    uint64_t revision;                                         /* of placing: what was gathered before is void */
    tahr__fluids fluids;
} tahr__fcl_scene;

/* Candidates on the stack, 16 bytes each. */
enum { TAHR__FCL_ROOM = 256 };

/* One query: the shape, where it starts, where it goes, and its candidates. */
typedef struct tahr__fcl_query {
    const tahr__fcl_scene *scene;
    tahr_query_context *context;
    tahr__shape shape;
    double margin;
    tahr_vec3 origin, motion;
    double motion_length;
    tahr__filter filter;
    tahr_bounds box; /* relative to the start */
    const tahr__fcl_part *parts;
    uint32_t count, frame_body; /* whose frame it is, or UINT32_MAX */
    tahr__placement frame;
    tahr__fcl_list list;
    tahr__fcl_part room[TAHR__FCL_ROOM];
} tahr__fcl_query;

/* scene.c */
tahr_status tahr__fcl_scene_open(tahr__fcl_scene *scene, const tahr_host *host, const tahr_world_desc *desc);
void tahr__fcl_scene_close(tahr__fcl_scene *scene);
tahr_status tahr__fcl_scene_place(tahr__fcl_scene *scene, const tahr_body_pose *poses, uint32_t count);

/* The next body of a scene that is being opened, with its defaults from desc, or NULL without memory. */
tahr__fcl_body *tahr__fcl_scene_new(tahr__fcl_scene *scene, const tahr_body_desc *desc, uint32_t id);
/* Builds the mesh of a geometry as the next of the scene. */
tahr_status tahr__fcl_scene_mesh(tahr__fcl_scene *scene, const tahr__fcl_geometry *geometry, uint32_t id,
                                 uint32_t *mesh);

/* attached.c: bodies from the objects of a user's manager. */
tahr_status tahr__fcl_scene_attach(tahr__fcl_scene *scene);

/* query.c: the shape of a query, whose hull is looked up; statuses as tahr__shape_make. Then the query ready for its
 * pieces. Returns a negative status for a shape or number that cannot be asked about; to
 * be ended in any case. The box that is gathered is that of the motion, grown by reach. */
tahr_status tahr__fcl_query_shape(tahr__fcl_query *query, const tahr__shape_source *source);
tahr_status tahr__fcl_query_begin(tahr__fcl_query *query, tahr_query_context *context, double reach);
void tahr__fcl_query_end(tahr__fcl_query *query);
/* The piece that part i of the query is; 0 if it is not to be met or out of reach. Valid until another body's. */
int tahr__fcl_query_piece(tahr__fcl_query *query, uint32_t i, tahr__piece *piece);
static inline const tahr__fcl_body *tahr__fcl_query_body(const tahr__fcl_query *query, uint32_t i)
{
    return &query->scene->bodies[query->parts[i].body];
}

/* Nearest points of the shape at centre, with the way out of a whole octree. */
void tahr__fcl_measure(const tahr__fcl_query *query, uint32_t i, const tahr__piece *piece, tahr_vec3 centre,
                       tahr__near *near);
/* Is there such a contact: from the front, no internal edge, no seam of cells? [out] the face along direction. */
int tahr__fcl_felt(const tahr__fcl_query *query, uint32_t i, const tahr__piece *piece, tahr_vec3 direction,
                   tahr__near *near, tahr_vec3 *face);
uint32_t tahr__fcl_feature(const tahr__fcl_query *query, uint32_t i, const tahr__piece *piece, tahr_vec3 normal);

/* cell.c: the rules of occupied cells. */
void tahr__fcl_cell_box(const tahr__fcl_body *body, const tahr__fcl_part *cell, tahr_vec3 *middle, tahr_vec3 *half);
int tahr__fcl_cell_felt(const tahr__fcl_query *query, uint32_t i, const tahr__piece *piece, const tahr__near *near);
void tahr__fcl_cell_way_out(const tahr__fcl_query *query, uint32_t i, const tahr__piece *piece, tahr_vec3 centre,
                            tahr__near *near);

/* cache.c: what was gathered before a step. */
size_t tahr__fcl_cache_size(void *self);
tahr_status tahr__fcl_prepare(void *self, tahr_query_context *context, const tahr_prepare *announcement);
/* The parts for a world box from the cache; 0 if it is not in there. */
int tahr__fcl_cache_find(const tahr__fcl_query *query, const tahr_bounds *box, const tahr__fcl_part **parts,
                         uint32_t *count);

/* The slots. */
tahr_status tahr__fcl_sweep(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                            uint32_t capacity, uint32_t *count);
tahr_status tahr__fcl_contacts(void *self, tahr_query_context *context, const tahr_contact_query *query,
                               tahr_contact *contacts, uint32_t capacity, uint32_t *count);
tahr_status tahr__fcl_ray(void *self, tahr_query_context *context, const tahr_ray *query, tahr_hit *hit,
                          uint32_t *count);

#endif
