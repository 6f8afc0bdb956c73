/* SPDX-License-Identifier: MIT
 * scene.h: what the parts of the ccd backend share: bodies, their convex pieces, a query's view of them. */
#ifndef TAHR_CCD_SCENE_H
#define TAHR_CCD_SCENE_H

#include "../common/core.h"
#include "../common/fluid.h"
#include "../common/mesh.h"

#include <tahr/ccd.h>

/* A contact whose normal leans behind a one-sided face by more than this came from behind and is none. */
#define TAHR__CCD_BEHIND (-1e-6)
/* Relative: the core's projection leaves 1e-16 by rounding; motion flatter than this to a surface is parallel. */
#define TAHR__CCD_PARALLEL 1e-12

typedef struct tahr__ccd_body {
    uint32_t type, flags, mask, walkable_rule, surface, id;
    double walkable_angle;
    tahr_vec3 position;
    tahr__mat turn;         /* local to world */
    tahr_vec3 half_extents; /* boxes */
    double radius;          /* spheres, capsules */
    double reach;           /* capsules: half the length of the axis */
    tahr_bounds bounds;     /* world */
    tahr__mesh mesh;
} tahr__ccd_body;

typedef struct tahr__ccd_scene {
    const tahr_host *host;
    tahr__ccd_body *bodies;
    uint32_t body_count;
    uint32_t reserved;
    tahr__fluids fluids;
} tahr__ccd_scene;

/* A convex piece of a body: a triangle of a mesh, or a whole box, sphere or capsule. Corners are relative to the
 * query's start, so that float-sized numbers reach libccd wherever the scene lies. */
typedef struct tahr__ccd_piece {
    const tahr__ccd_body *body;
    tahr_vec3 corner[8];
    int corner_count;
    uint32_t triangle; /* of a mesh, in leaf order */
    double radius;
} tahr__ccd_piece;

/* What a query may not want to meet. */
enum { TAHR__CCD_SOLIDS = 1, TAHR__CCD_SENSORS = 2 };

/* One query: the shape, where it starts, where it goes. */
typedef struct tahr__ccd_probe {
    const tahr__ccd_scene *scene;
    tahr_query_context *context;
    tahr__core core;
    double radius, margin;
    tahr_vec3 origin, motion;
    double motion_length;
    uint32_t mask, ignore_body;
    int only_body;       /* 1: nothing is there but ignore_body */
    uint32_t leaves_out; /* 0, or TAHR__CCD_SOLIDS or _SENSORS */
    tahr_vec3 up;        /* of the query */
    uint32_t flags;      /* TAHR_SWEEP_* */
    uint32_t sinks;      /* 1: the foot has sunk into a one-way body (one_way.h) */
} tahr__ccd_probe;

/* The nearest points of the shape and a piece. */
typedef struct tahr__ccd_near {
    double distance;  /* signed, between the surfaces */
    tahr_vec3 normal; /* unit, from the piece to the shape, or the way out */
    tahr_vec3 point;  /* on the piece's surface, relative to the query's start */
    uint32_t part;    /* of a mesh triangle: TAHR__FACE, TAHR__EDGE + i, TAHR__CORNER + i */
    uint32_t reserved;
} tahr__ccd_near;

/* scene.c */
tahr_status tahr__ccd_scene_open(tahr__ccd_scene *scene, const tahr_host *host, const tahr_world_desc *desc);
void tahr__ccd_scene_close(tahr__ccd_scene *scene);
tahr_status tahr__ccd_scene_place(tahr__ccd_scene *scene, const tahr_body_pose *poses, uint32_t count);

/* walk.c: every piece that may be within reach of a box around the start, in a fixed order. */
typedef struct tahr__ccd_walk {
    const tahr__ccd_probe *probe;
    tahr_bounds box; /* relative to the start */
    tahr__bvh_walk tree;
    uint32_t body, inside, first, count;
} tahr__ccd_walk;

void tahr__ccd_walk_begin(tahr__ccd_walk *walk, const tahr__ccd_probe *probe, tahr_vec3 motion, double reach);
int tahr__ccd_walk_next(tahr__ccd_walk *walk, tahr__ccd_piece *piece);
void tahr__ccd_triangle(const tahr__ccd_probe *probe, const tahr__ccd_body *body, uint32_t triangle,
                        tahr__ccd_piece *piece);

/* measure.c: everything that core distance decides. */
void tahr__ccd_measure(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, tahr_vec3 centre,
                       tahr__ccd_near *near);
/* Can it be felt from here at all? One-sided triangles are not there for what is behind them. */
int tahr__ccd_in_front(const tahr__ccd_piece *piece, const tahr__ccd_near *near);
/* The face along direction among those at the nearest point; the contact normal becomes the face's if it is that up to
 * rounding. Returns 0 if a neighbour at a shared edge or corner is nearer: an internal edge, not to be felt. */
int tahr__ccd_face(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, tahr_vec3 direction,
                   tahr__ccd_near *near, tahr_vec3 *face);
uint32_t tahr__ccd_feature(const tahr__ccd_piece *piece, const tahr__ccd_near *near);

/* impact.c: the first fraction in [*fraction, limit] at which the shape comes within its margin of a piece. */
typedef enum tahr__ccd_verdict { TAHR__CCD_FREE, TAHR__CCD_HIT, TAHR__CCD_UNKNOWN } tahr__ccd_verdict;

tahr__ccd_verdict tahr__ccd_impact(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, double limit,
                                   double *fraction, tahr__ccd_near *near);
/* From a fraction known to be free, by tangents of the convex distance; never late. */
tahr__ccd_verdict tahr__ccd_advance(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, double limit,
                                    double *fraction, tahr__ccd_near *near);

/* one_way.c: is a one-way body there where it is met at a fraction of the motion? Others always are. */
typedef struct tahr__ccd_one_way {
    int edge;  /* it is, on an edge */
    int sinks; /* it is not, and the foot sinks into it */
} tahr__ccd_one_way;

int tahr__ccd_is_one_way(const tahr__ccd_body *body);
int tahr__ccd_one_way_blocks(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, const tahr__ccd_near *near,
                             tahr_vec3 face, double fraction, tahr__ccd_one_way *out);

/* gjk.c: libccd's boolean. 1: swept shape and piece overlap, 0: they do not, -1: libccd used up its iterations. */
int tahr__ccd_swept_overlap(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, double fraction);

/* The slots. */
tahr_status tahr__ccd_sweep(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                            uint32_t capacity, uint32_t *count);
tahr_status tahr__ccd_contacts(void *self, tahr_query_context *context, const tahr_contact_query *query,
                               tahr_contact *contacts, uint32_t capacity, uint32_t *count);
tahr_status tahr__ccd_ray(void *self, tahr_query_context *context, const tahr_ray *query, tahr_hit *hit,
                          uint32_t *count);

/* probe.c: from queries to probes. Returns 0 if something is not finite: libccd crashes on that. */
int tahr__ccd_probe_shape(tahr__ccd_probe *probe, const tahr_shape *shape, tahr_vec3 up, tahr_quat orientation);
int tahr__ccd_probe_finite(const tahr__ccd_probe *probe);

#endif
