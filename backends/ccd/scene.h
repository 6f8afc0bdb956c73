/* SPDX-License-Identifier: MIT
 * scene.h: what the parts of the ccd backend share: bodies, their convex pieces, a query's view of them. */
#ifndef TAHR_CCD_SCENE_H
#define TAHR_CCD_SCENE_H

#include "../common/body_tree.h"
#include "../common/convex_near.h"
#include "../common/fluid.h"
#include "../common/hull.h"
#include "../common/mesh.h"
#include "../common/one_way.h"
#include "../common/surface.h"

#include <tahr/ccd.h>

/* A contact whose normal leans behind a one-sided face by more than this came from behind and is none. */
#define TAHR__CCD_BEHIND (-1e-6)

typedef struct tahr__ccd_body {
    tahr__surface surface;
    uint32_t type, reserved;
    tahr_vec3 position;
    tahr__mat turn;         /* local to world */
    tahr_vec3 half_extents; /* boxes, ellipsoids */
    double radius;          /* spheres, capsules, cylinders, cones */
    double reach;           /* capsules: half the length of the axis; cylinders, cones: half height */
    tahr_bounds bounds;     /* world */
    tahr__mesh mesh;
    tahr__hull hull;
} tahr__ccd_body;

typedef struct tahr__ccd_scene {
    const tahr_host *host;
    tahr__ccd_body *bodies;
    uint32_t body_count;
    uint32_t sweep, boolean, max_iterations; /* tahr_ccd_desc */
    tahr__body_tree tree;
    tahr__fluids fluids;
} tahr__ccd_scene;

/* A convex piece of a body: a triangle of a mesh, or a whole body. Corners are relative to the query's start and in the
 * query's unit, so that numbers of a usual size reach libccd wherever the scene lies and however small the shape is. */
typedef struct tahr__ccd_piece {
    const tahr__ccd_body *body;
    tahr_vec3 corner[8];
    int corner_count;
    uint32_t triangle; /* of a mesh, in leaf order */
    double radius;
} tahr__ccd_piece;

/* One query: the shape, where it starts, where it goes. All lengths but origin are in the query's unit. */
typedef struct tahr__ccd_probe {
    const tahr__ccd_scene *scene;
    tahr_query_context *context;
    double unit;                /* of them in a metre: 1, or a power of two that makes the shape about 1 in size */
    tahr__core core;            /* spheres, capsules, boxes */
    tahr__convex shape;         /* all: without the radius, around the start */
    tahr__mat turn;             /* of its frame */
    const tahr__ccd_body *hull; /* hulls: who lends the vertices; else NULL */
    int is_core;                /* 1: core says it all */
    double size;                /* half the longest extent of the shape */
    double radius, margin;
    tahr_vec3 origin, motion;
    double motion_length;
    tahr__filter filter;
} tahr__ccd_probe;

/* The nearest points of the shape and a piece, relative to the query's start. */
typedef tahr__near tahr__ccd_near;

/* scene.c */
tahr_status tahr__ccd_scene_open(tahr__ccd_scene *scene, const tahr_host *host, const tahr_world_desc *desc);
void tahr__ccd_scene_close(tahr__ccd_scene *scene);
tahr_status tahr__ccd_scene_place(tahr__ccd_scene *scene, const tahr_body_pose *poses, uint32_t count);

/* walk.c: every piece that may be within reach of a box around the start, in a fixed order. */
typedef struct tahr__ccd_walk {
    const tahr__ccd_probe *probe;
    tahr_bounds box; /* m, relative to the start */
    tahr__body_walk bodies;
    tahr__bvh_walk tree; /* of a mesh */
    uint32_t body, inside, first, count;
} tahr__ccd_walk;

void tahr__ccd_walk_begin(tahr__ccd_walk *walk, const tahr__ccd_probe *probe, tahr_vec3 motion, double reach);
int tahr__ccd_walk_next(tahr__ccd_walk *walk, tahr__ccd_piece *piece);
void tahr__ccd_triangle(const tahr__ccd_probe *probe, const tahr__ccd_body *body, uint32_t triangle,
                        tahr__ccd_piece *piece);

/* piece.c */
static inline int tahr__ccd_is_round(const tahr__ccd_piece *piece)
{
    return piece->body->type == TAHR_BODY_SPHERE || piece->body->type == TAHR_BODY_CAPSULE;
}
/* Is it a cylinder, cone, ellipsoid or hull, for which there is no core distance? */
static inline int tahr__ccd_is_convex(const tahr__ccd_piece *piece)
{
    return piece->body->type > TAHR_BODY_CAPSULE;
}
void tahr__ccd_whole_body(const tahr__ccd_probe *probe, const tahr__ccd_body *body, tahr__ccd_piece *piece);
/* The piece by its support function, without its radius. */
void tahr__ccd_convex(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, tahr__convex *convex);
/* The same with all that the distance of convex shapes asks for. */
void tahr__ccd_side(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, tahr__convex_side *side);
/* By which sides a triangle is left, see core.h. */
uint32_t tahr__ccd_ways_out(const tahr__ccd_piece *piece);

/* measure.c: everything that the distance decides. */
void tahr__ccd_measure(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, tahr_vec3 centre,
                       tahr__ccd_near *near);
/* The same within the margin; beyond it as well as a tangent needs: a plane between the two that the motion does not
 * cross before near->distance and near->normal say so. The rest of near is not sure there. */
void tahr__ccd_measure_far(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, tahr_vec3 centre,
                           tahr__ccd_near *near);
/* Can it be felt from here at all? One-sided triangles are not there for what is behind them. */
int tahr__ccd_in_front(const tahr__ccd_piece *piece, const tahr__ccd_near *near);

/* surface.c */
/* The face along direction among those at the nearest point; the contact normal becomes the face's if it is that up to
 * rounding. Returns 0 if a neighbour at a shared edge or corner is nearer: an internal edge, not to be felt. */
int tahr__ccd_face(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, tahr_vec3 direction,
                   tahr__ccd_near *near, tahr_vec3 *face);
uint32_t tahr__ccd_feature(const tahr__ccd_piece *piece, const tahr__ccd_near *near);

/* impact.c: the first fraction in [*fraction, limit] at which the shape comes within its margin of a piece. *fraction is
 * 0 or the root of the tangent at *near. */
typedef enum tahr__ccd_verdict { TAHR__CCD_FREE, TAHR__CCD_HIT, TAHR__CCD_UNKNOWN } tahr__ccd_verdict;

tahr__ccd_verdict tahr__ccd_impact(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, double limit,
                                   double *fraction, tahr__ccd_near *near);
/* The same by tangents of the convex distance alone; never late. */
tahr__ccd_verdict tahr__ccd_advance(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, double limit,
                                    double *fraction, tahr__ccd_near *near);

/* gjk.c: libccd's boolean. 1: swept shape and piece overlap, 0: they do not, -1: libccd used up its iterations. */
int tahr__ccd_swept_overlap(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, double fraction);

/* The slots. */
tahr_status tahr__ccd_sweep(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                            uint32_t capacity, uint32_t *count);
tahr_status tahr__ccd_contacts(void *self, tahr_query_context *context, const tahr_contact_query *query,
                               tahr_contact *contacts, uint32_t capacity, uint32_t *count);
tahr_status tahr__ccd_ray(void *self, tahr_query_context *context, const tahr_ray *query, tahr_hit *hit,
                          uint32_t *count);

/* probe.c: from queries to probes: probe comes with its lengths in metres, shape NULL is a point. TAHR_OK;
 * TAHR_E_ARGUMENT if something is not finite or beyond 1e8 m: libccd crashes on that; TAHR_E_UNSUPPORTED. */
tahr_status tahr__ccd_probe_shape(tahr__ccd_probe *probe, const tahr_shape *shape, tahr_vec3 up, tahr_quat orientation);
/* A place of the query in the world. */
static inline tahr_vec3 tahr__ccd_world(const tahr__ccd_probe *probe, tahr_vec3 p)
{
    return v_add(probe->origin, v_scale(p, 1 / probe->unit));
}

#endif
