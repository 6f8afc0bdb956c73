/* SPDX-License-Identifier: MIT
 * scene.h: what the parts of the box2d backend share: bodies, the pieces they are made of, a query's view of them. */
#ifndef TAHR_BOX2D_SCENE_H
#define TAHR_BOX2D_SCENE_H

#include "../common/fluid.h"
#include "../common/vec.h"
#include "engine.h"

/* A contact whose normal leans behind a one-sided segment by more than this came from behind and is none. */
#define TAHR__B2_BEHIND (-1e-6)

typedef struct tahr__b2_body {
    tahr__surface owner;
    uint32_t type, first, count; /* its items */
    uint32_t vertex_count, vertex_capacity;
    tahr_vec3 position;
    tahr__vec2 turn;      /* cosine and sine */
    double radius;        /* circles, capsules */
    tahr__vec2 *vertices; /* local; the ends of the axis of a capsule */
} tahr__b2_body;

/* What is in the tree: a whole body, or a segment of a chain. */
typedef struct tahr__b2_item {
    uint32_t body, segment;
    int32_t proxy;
} tahr__b2_item;

typedef struct tahr__b2_scene {
    const tahr_host *host;
    const tahr__b2_engine *engine;
    tahr_box2d_desc desc;
    int attached;
    void *tree;
    tahr__b2_body *bodies;
    tahr__b2_item *items;
    uint32_t body_count, item_count, item_capacity;
    tahr__vec2 origin; /* of the tree */
    tahr__fluids fluids;
} tahr__b2_scene;

/* One query: the shape, where it starts, where it goes. */
typedef struct tahr__b2_probe {
    const tahr__b2_scene *scene;
    tahr_query_context *context;
    tahr__flat_shape shape;
    tahr_vec3 origin;
    tahr__vec2 up, motion;
    double margin, motion_length;
    tahr__filter filter;
} tahr__b2_probe;

static inline tahr_vec3 tahr__b2_lift(tahr__vec2 v, double z)
{
    return v_make(v.x, v.y, z);
}

/* scene.c: slots. */
tahr_status tahr__b2_open(const tahr_host *host, const tahr_world_desc *desc, void **self);
void tahr__b2_close(void *self);
tahr_status tahr__b2_place(void *self, const tahr_body_pose *poses, uint32_t count);

/* body.c: one described body. */
tahr_status tahr__b2_body_open(const tahr_host *host, const tahr_body_desc *desc, uint32_t id, tahr__b2_body *body);
void tahr__b2_body_close(const tahr_host *host, tahr__b2_body *body);
/* The turn of a body's corners in the plane. Returns NULL, or why it cannot be there. */
const char *tahr__b2_body_turn(uint32_t type, int is_point, tahr_quat orientation, tahr__vec2 *turn);
const char *tahr__b2_body_place(tahr__b2_body *body, const tahr_pose *pose);
/* Logs an error: "bodies[3].<text>". */
void tahr__b2_log(const tahr_host *host, uint32_t body, const char *text);
/* How many pieces it has. */
uint32_t tahr__b2_body_items(const tahr__b2_body *body);
/* A piece of it, relative to an origin. */
void tahr__b2_body_piece(const tahr__b2_body *body, uint32_t segment, tahr__vec2 origin, tahr__b2_piece *piece);

/* probe.c: from queries to probes. TAHR_OK, TAHR_E_UNSUPPORTED (out of the plane, a shape that is none of three),
 * TAHR_E_ARGUMENT (not finite). */
tahr_status tahr__b2_probe_shape(tahr__b2_probe *probe, const tahr_shape *shape, tahr_vec3 up);
tahr_status tahr__b2_probe_check(const tahr__b2_probe *probe, tahr_vec3 motion);
/* Every piece that may be within reach of the shape on its motion: what the query does not want is left out. */
void tahr__b2_each(const tahr__b2_probe *probe, tahr__b2_take_fn take, void *user);
/* Likewise within reach of a point relative to the start. */
void tahr__b2_each_at(const tahr__b2_probe *probe, tahr__vec2 point, double reach, tahr__b2_take_fn take, void *user);

/* seam.c: what neighbours at the same place have to say about a contact. Returns 1 if it is not to be felt: it lies
 * on a seam, and a neighbour that leads from there toward the shape is nearer. Of segments that meet there the face
 * along direction, if more than *face is. */
int tahr__b2_is_seam(const tahr__b2_probe *probe, const tahr__b2_piece *piece, const tahr__flat_near *near,
                     tahr__vec2 direction, tahr__vec2 *face);
/* The way out of what is overlapped, past the faces that a neighbour closes. */
void tahr__b2_leave(const tahr__b2_probe *probe, const tahr__b2_piece *piece, tahr__flat_near *near);
/* Can it be felt from here at all? One-sided segments are not there for what is behind them. */
int tahr__b2_in_front(const tahr__b2_piece *piece, const tahr__flat_near *near);
/* The face along direction among those of the piece at the nearest point. */
tahr__vec2 tahr__b2_face(const tahr__b2_piece *piece, const tahr__flat_near *near, tahr__vec2 direction);
uint32_t tahr__b2_feature(const tahr__b2_piece *piece, const tahr__flat_near *near);

/* The slots. */
tahr_status tahr__b2_sweep(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                           uint32_t capacity, uint32_t *count);
tahr_status tahr__b2_contacts(void *self, tahr_query_context *context, const tahr_contact_query *query,
                              tahr_contact *contacts, uint32_t capacity, uint32_t *count);
tahr_status tahr__b2_ray(void *self, tahr_query_context *context, const tahr_ray *query, tahr_hit *hit,
                         uint32_t *count);

#endif
