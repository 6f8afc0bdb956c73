/* SPDX-License-Identifier: MIT
 * scene.h: what the parts of the native backend share: bodies, the local frame of a query, primitives, the search. */
#ifndef TAHR_NATIVE_SCENE_H
#define TAHR_NATIVE_SCENE_H

#include "../common/core.h"
#include "../common/fluid.h"
#include "../common/mesh.h"
#include "asked.h"
#include "heights.h"
#include "lanes.h"

#include <string.h>
#include <tahr/native.h>

/* Queries whose gap is within this of the target have arrived (m). A tenth of what the narrow phase promises. */
#define TAHR__ARRIVED 1e-10
/* A motion at less than this slope to a surface is parallel to it: a thousand times the rounding of a motion that was
 * projected onto the surface in double, and a creep of 1e-12 of the way. */
#define TAHR__PARALLEL 1e-12
/* Searches reach farther by this: a place within 1e7 m, turned from body to frame and back, comes back up to 2e-7 m off
 * by the sum of its roundings, 1.1e-16 of it each (the worst of three million was 2e-8 m off). */
#define TAHR__SLACK 1e-6

typedef struct tahr__body {
    uint32_t type, flags, mask, walkable_rule, surface;
    uint32_t turned; /* 0: turn is the identity and is skipped, exactly */
    double walkable_angle;
    tahr_vec3 position;
    tahr__mat turn;
    tahr__mesh mesh;        /* meshes; hulls and boxes as triangles whose sources are their faces; of heights, bounds */
    tahr_vec3 half_extents; /* boxes; of hulls, half their local bounds */
    tahr__heights heights;
    double radius;      /* spheres and capsules */
    double reach;       /* capsules: half the length of the axis */
    tahr_bounds bounds; /* world */
} tahr__body;

/* Exact corners of some triangles. */
enum { TAHR__FORMED = 8 };
typedef struct tahr__raw {
    const tahr_vec3 *corner[3][TAHR__FORMED];
} tahr__raw;

/* Forms the lanes of some triangles at a time (form.c). width 1: there is none. */
struct tahr__map;
typedef struct tahr__former {
    void (*form)(const struct tahr__map *map, const tahr__raw *raw, float *lanes);
    uint32_t width, reserved;
} tahr__former;

/* The fastest that this machine can run of those that form at most so many at a time, all of the same bits. */
tahr__former tahr__former_of(uint32_t most);

/* A tree over some of the bodies. */
typedef struct tahr__group {
    tahr__bvh tree;
    uint32_t *order;      /* leaf position -> body */
    tahr__bvh_box *boxes; /* scratch for refitting */
    uint32_t count;
} tahr__group;

typedef struct tahr__native {
    const tahr_host *host;
    tahr__body *bodies;
    uint32_t body_count;
    uint32_t capacity; /* of a cache, a multiple of TAHR__LANES */
    uint32_t no_cache;
    uint32_t fixed_margin; /* 1: cache_margin is the margin, 0: the most it may be */
    uint32_t no_fields;    /* 1: meshes stay meshes */
    uint32_t no_vicinity, no_capsule_ends;
    uint32_t reserved;
    const tahr__lanes_way *lanes;
    tahr__former former;
    double cache_margin;
    tahr__group fixed, movable;
    tahr__fluids fluids;
    tahr_gather_fn gather; /* the user's triangles, or NULL */
    void *gather_user;
    uint64_t revision; /* of them */
    uint64_t placed;   /* how often bodies have been */
} tahr__native;

/* Side of a cell (m). All is relative to its corner, so that what is moved by whole cells keeps its bits, that the
 * float lanes tell as much apart far out as near the origin (2.4e-7 m within a cell), and that the rest is computed
 * with numbers of a few metres. A power of two: places on a grid stay exact. Large enough to be left seldom. */
#define TAHR__CELL 4.0

/* Where a query is computed: relative to the corner of a 4 m cell, up along +z. Everything in a frame is a pure
 * function of (vertex, pose, origin, up), which is why cached and fresh answers are the same bits. */
typedef struct tahr__frame {
    tahr_vec3 origin, up;
    tahr__mat turn; /* world to local */
    uint32_t turned, reserved;
} tahr__frame;

static inline uint64_t tahr__other_bits(const double *a, const double *b)
{
    uint64_t x, y;
    memcpy(&x, a, sizeof x);
    memcpy(&y, b, sizeof y);
    return x ^ y;
}

/* The same bits, where a call of memcmp costs more than it does. */
static inline int tahr__same_vec(const tahr_vec3 *a, const tahr_vec3 *b)
{
    return (tahr__other_bits(&a->x, &b->x) | tahr__other_bits(&a->y, &b->y) | tahr__other_bits(&a->z, &b->z)) == 0;
}

/* Body coordinates to local ones: offset + turn * v. */
typedef struct tahr__map {
    tahr_vec3 offset;
    tahr__mat turn;
    uint32_t turned, reserved;
} tahr__map;

/* Which piece of a body a primitive is: a triangle (in leaf order), a round body, or the inside of a box or hull; or
 * one of the user's triangles, with its place in the cache. */
#define TAHR__ITEM_SOLID 0x40000000u
#define TAHR__ITEM_ROUND 0x20000000u
#define TAHR__ITEM_LOOSE 0x10000000u

/* Of tahr__prim.kind: what a query asks about the body or the triangle before it measures anything. */
enum {
    TAHR__TWO_SIDED = 1,
    TAHR__SENSOR = 2,
    TAHR__PLANELESS = 4, /* round, solid, or so thin that the direction of its plane may be rounding */
    TAHR__OF_BOX = 8,    /* or of a hull: a solid answers for its inside */
    TAHR__ONE_WAY = 16,
    /* A triangle of the user's, kept in the cache (item is its index) or the head of a tahr__loose. */
    TAHR__GATHERED = 64,
    TAHR__FRESH = 128,
    TAHR__FACELESS = 256, /* of a field of heights: its normal is made where it is asked for */
    TAHR__UNFORMED = 512  /* in a cache: nothing but item, kind, body and mask is there yet (form.c) */
};

/* All that a query needs, so that neither mesh nor body is looked up where a primitive is cached. Three lines of
 * memory: what its plane needs, what its edges and the distance to it need, what a contact needs. */
typedef struct tahr__prim {
    uint32_t item, kind;
    tahr__facet facet; /* local; a segment for round bodies, a point for solids */
    double radius;
    uint32_t body, mask; /* mask: of the body */
    tahr_vec3 face;      /* triangles: the unit normal from exact corners, local */
    double walkable_angle;
    uint32_t feature, surface, walkable_rule, reserved[5];
} tahr__prim;

/* A triangle of the user's on its way. */
typedef struct tahr__loose {
    tahr__prim prim;
    tahr_vec3 corner[3]; /* exact, world */
} tahr__loose;

/* One triangle at an edge or corner, of a body without rings. */
typedef struct tahr__near {
    tahr_vec3 corner[3]; /* exact, of the body */
    tahr_vec3 v[3];      /* local */
    tahr_vec3 face;      /* local, unit */
    uint32_t feature, two_sided;
    uint32_t at, to; /* its corner there; the other one of the edge, 3 at a corner */
} tahr__near;

/* Triangles looked at around a corner; a fan larger than this is looked at in part. */
enum { TAHR__FAN = 32 };

/* A floor's plane, its normal up, not unit, and its length; all zero: none. */
typedef struct tahr__level {
    tahr_vec3 normal, at;
    double length;
} tahr__level;

/* All that a walk on the inside of one triangle reads, with a few words of the cache behind it: five lines of memory
 * (footing.c). */
typedef struct tahr__footing {
    tahr_vec3 origin, up; /* of the frame */
    tahr_vec3 at;         /* local, the middle of an upright segment at the place where all has been measured */
    double half;          /* of it */
    double clear; /* m: nothing but what lies in the floor or below it, or behind a fence, is nearer; 0: not known */
    tahr_vec3 cross, on; /* of the triangle under the spot: its normal, up and not unit, and a corner */
    double length, inverse;
    tahr_vec3 spot;   /* on the floor */
    double inside;    /* m: so far around the spot that triangle is alone, well inside of its edges; <= 0: none */
    tahr_vec3 normal; /* the exact one, world, toward the character */
    double walkable_angle;
    uint32_t walkable_rule, surface, body, feature;
    uint32_t under;  /* index of the triangle */
    uint32_t turned; /* as of the frame */
    uint32_t fenced; /* 1: there are fences */
    uint32_t steep;  /* 1: what is said here does not hold for so steep a triangle */
} tahr__footing;

/* Planes between the place that was measured and what is nearest to it (fence.c), rounded to single precision: all of
 * that has x, y, z . p <= far. Those not in use keep nothing off. */
enum { TAHR__FENCES = 8 };
typedef struct tahr__fences {
    float x[TAHR__FENCES], y[TAHR__FENCES], z[TAHR__FENCES], far[TAHR__FENCES];
    uint32_t of[TAHR__FENCES]; /* index */
} tahr__fences;

/* What else is known of the place (vicinity.c, ground.c): the distances are behind the header of the cache. */
typedef struct tahr__vicinity {
    tahr__level floor; /* of this frame: what stopped the last foot */
    double alone; /* m around the spot (<= 0: none) where no triangle of the floor reaches over the edges of `under` */
    double scope; /* m: so far around the next spot others are looked for */
    tahr_vec3 across[3];      /* outward of those edges, not unit; what is on one has this much along it, */
    double border[3], hem[3]; /* and this much less is well inside */
    tahr_vec3 face;           /* the exact normal of that, toward the character */
    uint32_t stood;           /* index of what had stopped the last foot when the floor was found */
    uint32_t known;           /* 0: nothing has been measured */
    uint32_t rest, rests;     /* feet until a spot is looked for again, and after the next that was none */
} tahr__vicinity;

/* Kinds of motions that are stopped by other things: of a segment, of what else there is (most of all feet), of a foot
 * thinner than the last of those, as on the rim of a perch, and of a segment that is lowered. */
enum { TAHR__OF_BODY, TAHR__OF_FOOT, TAHR__OF_THINNER, TAHR__OF_LOWERED, TAHR__KINDS };

/* What stopped the last motions that come less often. */
typedef struct tahr__stopped {
    double foot; /* m, radius of the last foot */
    uint32_t recent[TAHR__KINDS - TAHR__OF_THINNER];
} tahr__stopped;

/* One character's memory (gather.c): */
typedef struct tahr__cache {
    tahr__footing footing;
    uint32_t recent[2]; /* index of what stopped the last motion of a segment, of others: likely to stop the next */
    tahr_bounds local;  /* everything static in it has been gathered */
    uint64_t revision;  /* of the user's triangles in it */
    uint32_t mask, announced;
    tahr__fences fences;
    tahr__frame frame;
    tahr_bounds bounds; /* world: what was announced, grown by the margin */
    double volume;      /* m3, of what was announced */
    tahr_vec3 place;    /* world: where the character was then */
    uint32_t gathered, overflow, count;
    uint32_t level; /* where that overflows: a field that is all there is, and level (level.h), or TAHR_NO_BODY */
    uint32_t plain; /* no sensors: what has been gathered concerns every query of the same mask */
    double margin;  /* to gather with the next time, 0: the most */
    tahr__vicinity vicinity;
    tahr__stopped stopped;
    tahr__asked asked; /* of this frame */
} tahr__cache;

/* Index of what stopped the last motion of a kind (TAHR__OF_*). */
static inline uint32_t *tahr__cache_recent(tahr__cache *cache, uint32_t kind)
{
    return kind < TAHR__OF_THINNER ? &cache->recent[kind] : &cache->stopped.recent[kind - TAHR__OF_THINNER];
}

/* Bytes of the header, whole lines of memory. Behind it, for each primitive there is room for: how far it was from the
 * place of the vicinity (m), and how much more to whom stays above the floor; then its lanes; then itself. All whole
 * blocks of lanes. */
enum { TAHR__HEADER = (sizeof(tahr__cache) + 63) / 64 * 64 };

static inline float *tahr__cache_far(tahr__cache *cache)
{
    return (float *)(void *)((unsigned char *)cache + TAHR__HEADER);
}

static inline float *tahr__cache_lift(const tahr__native *world, tahr__cache *cache)
{
    return tahr__cache_far(cache) + world->capacity;
}

static inline float *tahr__cache_blocks(const tahr__native *world, tahr__cache *cache)
{
    return tahr__cache_lift(world, cache) + world->capacity;
}

static inline tahr__lanes tahr__cache_lanes(const tahr__native *world, tahr__cache *cache)
{
    return (tahr__lanes){tahr__cache_blocks(world, cache), cache->count};
}

static inline tahr__prim *tahr__cache_prims(const tahr__native *world, tahr__cache *cache)
{
    return (tahr__prim *)(void *)(tahr__cache_blocks(world, cache) + (size_t)TAHR__LANE_ROWS * world->capacity);
}

/* Without branches: which side is out is different every time. */
static inline int box_inside(const tahr_bounds *a, const tahr_bounds *b)
{
    int low = (a->min.x >= b->min.x) & (a->min.y >= b->min.y) & (a->min.z >= b->min.z);
    return low & (a->max.x <= b->max.x) & (a->max.y <= b->max.y) & (a->max.z <= b->max.z);
}

/* Does the cache, one that serves, hold everything static within reach of a box? */
static inline int tahr__cache_spans(const tahr__cache *cache, const tahr_bounds *box, double reach)
{
    const double more = reach + 10 * TAHR__SLACK;
    const tahr_vec3 grow = v_make(more, more, more);
    const tahr_bounds grown = {v_sub(box->min, grow), v_add(box->max, grow)};
    return box_inside(&grown, &cache->local);
}

/* Which bodies a query looks at: those that block, all, or sensors alone. */
enum { TAHR__SENSORS_NONE = 0, TAHR__SENSORS_TOO = 1, TAHR__SENSORS_ONLY = 2 };

/* A corner of a mesh that was met, seen from a core, and what it was found to be: all triangles at it that are
 * connected there find the same of it (resolve.c). */
typedef struct tahr__corner_met {
    uint32_t count, body;    /* so many triangles; 0: none was met */
    uint32_t fan[TAHR__FAN]; /* their names */
    tahr_vec3 point, direction;
    double distance;
    tahr_vec3 normal, face, flat;
    double along, tilt2; /* of the face, of what is flat */
    /* How a point came to one (flight.c): from where it was nearest already; flown: 0: none did. */
    uint32_t flown, reserved;
    double from, target, t;
    tahr__witness first, last;
} tahr__corner_met;

typedef struct tahr__query {
    const tahr__native *world;
    tahr__cache *cache; /* or NULL */
    tahr_query_context *context;
    const tahr__frame *frame; /* the cache's, or own_frame */
    tahr__frame own_frame;
    tahr__core core;
    tahr_vec3 extent;        /* half extents of the core along the axes */
    tahr_vec3 start, motion; /* local */
    double motion_length;
    double radius, margin;
    double surplus;                    /* the margin is so much more than was asked for */
    double half;                       /* of an upright segment, 0 for a point */
    uint32_t mask, ignore_body, flags; /* flags: of a sweep; with ONLY_BODY nothing but ignore_body is searched */
    uint32_t sensors;                  /* TAHR__SENSORS_* */
    uint32_t sinks;                    /* 1: the foot has sunk into a one-way body (one_way.h) */
    tahr__corner_met *corner;          /* of this motion, the last one; NULL: nobody keeps it */
    tahr_status *failed;               /* what went wrong while gathering */
} tahr__query;

static inline tahr_vec3 tahr__frame_to_world(const tahr__frame *frame, tahr_vec3 direction)
{
    return frame->turned ? m_unapply(&frame->turn, direction) : direction;
}

/* Around its core up to this fraction of the motion. */
static inline tahr_bounds tahr__query_box(const tahr__query *query, double t)
{
    tahr_vec3 end = v_mad(query->start, query->motion, t);
    tahr_bounds box = {v_sub(v_min(query->start, end), query->extent), v_add(v_max(query->start, end), query->extent)};
    return box;
}

/* In which order primitives are handed over. */
enum { TAHR__NEAREST_FIRST = 0, TAHR__ANY_ORDER = 1, TAHR__IN_BULK = 2 };

/* Visits every primitive that may be within reach of box. The visitor may shrink box (and set narrowed) on the way. */
typedef struct tahr__search {
    const tahr__query *query;
    tahr_bounds box; /* local, around the core */
    double reach;
    uint32_t narrowed;
    uint32_t order; /* TAHR__NEAREST_FIRST, ... */
    uint32_t room;  /* IN_BULK: so many of a body can be taken, at most TAHR__CACHE_MOST */
    uint32_t reserved;
    void (*visit)(struct tahr__search *search, const tahr__prim *prim);
    /* IN_BULK: takes triangles of a mesh by their names; more than there is room for: not all of them are there. */
    void (*take)(struct tahr__search *search, uint32_t body, const uint32_t *items, uint32_t count);
} tahr__search;

/* Static bodies, from the cache if it holds all that is asked for, then movable ones. */
void tahr__search_run(tahr__search *search);
/* Static ones and the user's triangles, from no cache. */
void tahr__search_fixed(tahr__search *search);

/* frame.c */
tahr__frame tahr__frame_make(tahr_vec3 position, tahr_vec3 up);
/* Would the same frame be made again? */
int tahr__frame_holds(const tahr__frame *frame, tahr_vec3 position, tahr_vec3 up);
tahr__map tahr__map_make(const tahr__frame *frame, const tahr__body *body);
/* Of what is in world coordinates. */
tahr__map tahr__map_fixed(const tahr__frame *frame);
tahr_vec3 tahr__map_point(const tahr__map *map, tahr_vec3 v);
void tahr__map_triangle(const tahr__map *map, const tahr__body *body, uint32_t triangle, tahr_vec3 v[3]);
tahr_bounds tahr__frame_box_to_world(const tahr__frame *frame, const tahr_bounds *box, double grow);
tahr_bounds tahr__frame_box_to_local(const tahr__frame *frame, const tahr_bounds *box);
/* What all primitives of a body share; then the rest of a triangle, of a whole round body, of the inside of a box. */
void tahr__prim_begin(const tahr__body *body, uint32_t id, tahr__prim *prim);
void tahr__prim_triangle(const tahr__map *map, const tahr__body *body, uint32_t triangle, tahr__prim *prim);
void tahr__prim_round(const tahr__map *map, const tahr__body *body, tahr__prim *prim);
void tahr__prim_solid(const tahr__map *map, const tahr__body *body, tahr__prim *prim);
/* Of a field of heights; v: its exact corners. */
void tahr__prim_heights(const tahr__map *map, const tahr__body *body, uint32_t triangle, const tahr_vec3 v[3],
                        tahr__prim *prim);
tahr_bounds tahr__prim_bounds(const tahr__query *query, const tahr__prim *prim);

/* bodies.c */
tahr_status tahr__bodies_open(tahr__native *world, const tahr_world_desc *desc);
void tahr__bodies_close(tahr__native *world);
tahr_status tahr__bodies_place(tahr__native *world, const tahr_body_pose *poses, uint32_t count);

/* gather.c */
enum { TAHR__CACHE_MOST = 4096 };
/* Does the cache hold everything static within reach of the search? */
int tahr__cache_holds(const tahr__search *search);
/* Which cached primitives (prims[found[i].index]) may be within reach up to this fraction of the motion. Returns how
 * many, at most TAHR__CACHE_MOST. */
uint32_t tahr__cache_cull(const tahr__search *search, double until, const tahr__prim **prims, tahr__lanes_found *found);
/* Does one of them concern a query? */
int tahr__cache_concerns(const tahr__query *query, uint32_t index);
/* Which of them comes within reach first, by what single precision tells of planes and edges; TAHR__NONE: none does. */
uint32_t tahr__cache_guess(const tahr__search *search);
size_t tahr__cache_bytes(const tahr__native *world);
#define TAHR__NONE 0xFFFFFFFFu
/* Exact corners of the cached triangles, three each, and who has one: the first of a bucket and the next corner, at
 * 3 * triangle + corner; TAHR__NONE: no more. Worlds with gather only. */
typedef struct tahr__corners {
    tahr_vec3 *exact;
    uint32_t *next, *first;
    uint32_t buckets; /* a power of two */
} tahr__corners;
tahr__corners tahr__cache_corners(const tahr__native *world, tahr__cache *cache);
uint32_t tahr__corner_bucket(const tahr__corners *corners, tahr_vec3 corner);
tahr_status tahr__cache_prepare(tahr__native *world, tahr_query_context *context, const tahr_prepare *announcement);

/* margin.c: count primitives were found within a margin of a box of that width. Returns 1, if it should be gathered
 * anew. margin: [in, out] the best there is: for that, or for the next time. */
int tahr__margin_choose(const tahr__native *world, double width, uint32_t count, double *margin);
/* The most it may be. */
double tahr__margin_most(const tahr__native *world, double width);

/* Who has come farther (m) from the place looks around anew, but in the open: a runner after two steps or three. */
#define TAHR__DRIFT 0.12

/* vicinity.c: what a sweep need not ask. Where a motion leads: UNKNOWN: the cache or more is to be asked; AROUND: all
 * that is near; OVER: of that, what is above the floor; DOWN: the floor too. */
enum { TAHR__UNKNOWN, TAHR__AROUND, TAHR__OVER, TAHR__DOWN };
/* Looks around anew where that may help; and the same from what is known. */
uint32_t tahr__vicinity_look(const tahr__query *query);
uint32_t tahr__vicinity_known(const tahr__query *query);
uint32_t tahr__vicinity_way(const tahr__query *query);
/* Is it not known because what has been gathered does not reach so far? */
int tahr__vicinity_ends(const tahr__query *query);
/* Of a way that is known: is nothing met? 0: there may be something. */
int tahr__vicinity_is_clear(const tahr__query *query, uint32_t way);
/* A foot that goes DOWN on the inside of a face: 1 and what a sweep would tell; 0: there may be more to it. */
int tahr__vicinity_lands(const tahr__query *query, tahr_hit *hit);
/* m that the shape may go from the start of a query whose way is known, whichever way it goes, without meeting
 * anything; < 0: not known. What has not been gathered may be anywhere. */
double tahr__vicinity_room(const tahr__query *query);

/* m from a place (world) to everything that is static: 0 within the bounds of all of it, and no more than 16. */
double tahr__outside_of_all(const tahr__native *world, tahr_vec3 position);

/* The cache holds something else now. */
void tahr__vicinity_forget(const tahr__native *world, tahr__cache *cache);

/* source.c: the triangles of the user. */
/* Fills all but the walkable fields of a loose triangle; 0: it has no area. */
int tahr__loose_make(const tahr__frame *frame, const tahr_triangle *t, tahr__loose *out);
/* Hands those near the search to its visitor. */
void tahr__source_search(tahr__search *search);
/* The same for a cache that is being filled; take stores one. Returns 0 if something is wrong with them. */
int tahr__source_fill(tahr__search *search, void (*take)(tahr__search *search, const tahr__loose *loose));
/* Triangles of the body of a gathered primitive that have a corner at `corner` (exact); it itself is left out. at: a
 * local point of the search that has found it, which all that matter contain; NULL: it may be anywhere. Of more than
 * most those with the lowest features. */
uint32_t tahr__source_around(const tahr__query *query, const tahr__prim *prim, tahr_vec3 corner, const tahr_vec3 *at,
                             tahr__near *near, uint32_t most);
/* Its exact corners. */
const tahr_vec3 *tahr__source_corners(const tahr__query *query, const tahr__prim *prim);

/* hull.c */
tahr_status tahr__hull_build(const tahr_host *host, const tahr_body_desc *desc, uint32_t body, tahr__mesh *mesh);
/* How far the core must move, and along which unit normal, to leave the hull; negative: it does not overlap. */
double tahr__hull_leave(const tahr__core *core, tahr_vec3 centre, const tahr__mesh *mesh, const tahr__map *map,
                        tahr_vec3 *normal);
/* The face that looks that way most (body coordinates). */
uint32_t tahr__hull_face(const tahr__mesh *mesh, tahr_vec3 direction);

/* tree.c: primitives of a group of bodies, straight from their trees. */
void tahr__tree_search(tahr__search *search, const tahr__group *group);
/* Does a box (world) meet the bounds of any movable body? */
int tahr__movable_meets(const tahr__native *world, const tahr_bounds *box);
/* m from a place (world) to any movable body at least; `most` where they are farther. */
double tahr__movable_gap(const tahr__native *world, tahr_vec3 position, double most);
/* And of one body alone. */
void tahr__tree_search_body(tahr__search *search, uint32_t body);

/* resolve.c: from a nearest point to a contact. */
enum { TAHR__REJECTED = 0, TAHR__ACCEPTED = 1, TAHR__NEIGHBOUR = 2 };

typedef struct tahr__contact_normals {
    tahr_vec3 normal, face; /* local, unit */
    double closer;          /* with TAHR__NEIGHBOUR: distance of the core to the neighbour that is nearer */
    double enough;          /* [in] less of it need not be told apart */
    uint32_t measure;       /* [in] 1: closer is asked for */
    uint32_t reserved;
} tahr__contact_normals;

/* witness: of the core at centre. NEIGHBOUR: the nearest point is an edge or corner, and another triangle at it is
 * nearer. */
int tahr__resolve(const tahr__query *query, const tahr__prim *prim, tahr_vec3 centre, const tahr__witness *witness,
                  tahr_vec3 motion, tahr__contact_normals *out);

/* What it is at. Takes a neighbour; 1: no others are needed. */
typedef struct tahr__resolving tahr__resolving;
int tahr__resolve_near(tahr__resolving *resolving, const tahr__near *near);

/* around.c: neighbours where there are no rings (GATHERED, FACELESS). */
void tahr__around(const tahr__query *query, const tahr__prim *prim, const tahr__witness *witness,
                  tahr__resolving *resolving);
/* Has any triangle no neighbour at any edge? */
int tahr__stands_alone(const tahr__query *query, const tahr__prim *prim);
/* The face of a FACELESS one. */
tahr_vec3 tahr__heights_face(const tahr__query *query, const tahr__prim *prim);

/* probe.c: one primitive. */
typedef struct tahr__probe {
    tahr__witness witness;
    double gap; /* signed distance between the surfaces */
} tahr__probe;

/* The earliest blocking of one primitive, local frame. */
typedef struct tahr__found {
    double t, gap;
    tahr_vec3 normal, face, point;
    double walkable_angle;
    uint32_t walkable_rule, surface;
    uint32_t overlap, unknown;
    uint32_t body, feature, item, kind;
    uint32_t edge; /* of a one-way body: only held by coming down on it */
    uint32_t reserved;
} tahr__found;

enum { TAHR__FREE = 0, TAHR__BLOCKED = 1, TAHR__LATER = 2, TAHR__BESIDE = 3, TAHR__SINKS = 4 };

/* Does the primitive stop the motion at or before limit (what comes later may be missed)? earliest: what plane.h
 * says, at most limit. BESIDE: within the margin at the start (out->gap) and not blocking. LATER, only without beside:
 * not before out->t; ask again with beside, the smallest gap of all that were BESIDE (the margin if none), when
 * everything has been asked. SINKS: the foot has sunk into this one-way body, which does not block. */
typedef struct tahr__ask {
    double earliest, limit;
    const double *beside;
} tahr__ask;
int tahr__probe_sweep(const tahr__query *query, const tahr__prim *prim, const tahr__ask *ask, tahr__found *out);
/* The same of a point that comes down well inside of a face (its exact unit normal), which is what most motions are
 * stopped by, and asked at the time before which nothing happens: 1 if that is so, else nothing is said. */
int tahr__probe_face(const tahr__query *query, const tahr__prim *prim, tahr_vec3 face, double t, tahr__found *out);
/* 1 if the primitive is within margin of the shape at its start. */
int tahr__probe_touch(const tahr__query *query, const tahr__prim *prim, double margin, tahr__found *out);

/* Of a capsule's contact with an upright face or edge, along which its side touches alike: the point that is nearest to
 * the middle of the shape, centred at `centre`. Of another the one that was found. */
tahr_vec3 tahr__touch_middle(const tahr__prim *prim, const tahr__witness *w, tahr_vec3 centre);
/* Is a before b? Overlaps first, the deepest of them; then (fraction, body, feature). */
int tahr__found_before(const tahr__found *a, const tahr__found *b);
/* The last of these alone: by body, feature, item. */
int tahr__named_before(const tahr__found *a, const tahr__found *b);
/* Half the extent of a box core along n: apart, so that the code of round shapes stays small. */
double tahr__box_extent(const tahr__query *query, tahr_vec3 n);

/* sweep.c, contacts.c, ray.c: the slots. */
void tahr__query_begin(tahr__query *query, const tahr__native *world, tahr_query_context *context, tahr_vec3 position,
                       tahr_vec3 up);
void tahr__query_shape(tahr__query *query, const tahr_shape *shape, tahr_quat orientation);
/* Of a query that is complete, and of which the vicinity does not know the answer. */
tahr_status tahr__sweep_rest(tahr__query *query, tahr_hit *hits, uint32_t capacity, uint32_t *count);
void tahr__fill_hit(const tahr__query *query, const tahr__found *found, tahr_hit *hit);
tahr_status tahr__native_sweep(void *self, tahr_query_context *context, const tahr_sweep *sweep, tahr_hit *hits,
                               uint32_t capacity, uint32_t *count);
tahr_status tahr__native_walk(void *self, tahr_query_context *context, const tahr_walk *walk, tahr_hit *hit,
                              uint32_t *known);
tahr_status tahr__native_contacts(void *self, tahr_query_context *context, const tahr_contact_query *query,
                                  tahr_contact *contacts, uint32_t capacity, uint32_t *count);
/* describe.c */
tahr_status tahr__native_describe(void *self, const tahr_log *to);
tahr_status tahr__native_ray(void *self, tahr_query_context *context, const tahr_ray *ray, tahr_hit *hit,
                             uint32_t *count);

#endif
