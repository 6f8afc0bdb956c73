/* SPDX-License-Identifier: MIT
 * scene.h: what the parts of the fcl backend share: its scene, and a query with the pieces that FCL finds for it. */
#ifndef TAHR_FCL_SCENE_H
#define TAHR_FCL_SCENE_H

#include "engine.h"

#include "../common/piece_query.h"

/* Octrees and attached bodies follow those that the core described; it does not know them. Half spaces have their
 * normal in half_extents and their offset as radius, octrees their resolution as radius. */
typedef struct tahr__fcl_scene {
    tahr__scene scene;
    tahr_fcl_desc desc;
    tahr__fcl_engine *engine;
    const void **identities; /* of the geometries that the meshes are of, attached ones */
    uint64_t revision;       /* of placing: what was gathered before is void */
} tahr__fcl_scene;

/* Candidates on the stack, 16 bytes each. */
enum { TAHR__FCL_ROOM = 256 };

/* One query with its candidates. */
typedef struct tahr__fcl_query {
    tahr__piece_query query;
    const tahr__fcl_part *parts;
    uint32_t count, at; /* the next one */
    tahr__fcl_list list;
    tahr__fcl_part room[TAHR__FCL_ROOM];
} tahr__fcl_query;

static inline const tahr__fcl_scene *tahr__fcl_scene_of(const tahr__piece_query *query)
{
    return (const tahr__fcl_scene *)query->scene;
}

/* scene.c: slots. */
tahr_status tahr__fcl_open(const tahr_host *host, const tahr_world_desc *desc, void **self);
void tahr__fcl_close(void *self);
tahr_status tahr__fcl_place(void *self, const tahr_body_pose *poses, uint32_t count);

/* octrees.c: the octrees of the options, as the next bodies. */
tahr_status tahr__fcl_scene_octrees(tahr__fcl_scene *scene);

/* attached.c: bodies from the objects of a user's manager. */
tahr_status tahr__fcl_scene_attach(tahr__fcl_scene *scene);

/* query.c: what FCL finds. */
extern const tahr__piece_finder tahr__fcl_finder;
/* A candidate of a query, by name. */
static inline const tahr__fcl_part *tahr__fcl_query_part(const tahr__piece_query *query, uint64_t name)
{
    return &((const tahr__fcl_query *)query)->parts[name];
}

/* cell.c: the rules of occupied cells. */
void tahr__fcl_cell_box(const tahr__scene_body *body, const tahr__fcl_part *cell, tahr_vec3 *middle, tahr_vec3 *half);
int tahr__fcl_cell_felt(const tahr__piece_query *query, const tahr__piece_found *found, const tahr__near *near);
void tahr__fcl_cell_way_out(const tahr__piece_query *query, const tahr__piece_found *found, tahr__near *near);

/* cache.c: what was gathered before a step. */
size_t tahr__fcl_cache_size(void *self);
tahr_status tahr__fcl_prepare(void *self, tahr_query_context *context, const tahr_prepare *announcement);
/* The parts for a world box from the cache; 0 if it is not in there. */
int tahr__fcl_cache_find(const tahr__fcl_query *query, const tahr_bounds *box, const tahr__fcl_part **parts,
                         uint32_t *count);

#endif
