/* SPDX-License-Identifier: MIT
 * world.h: describing a scene, opening a world on a backend or on your own callbacks, placing bodies, and asking
 * directly. */
#ifndef TAHR_WORLD_H
#define TAHR_WORLD_H

#include <tahr/types.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct tahr_world tahr_world;
struct tahr_backend;

/* HULL: the convex hull of its vertices. HEIGHTS: a field of heights over local x and y. CHAIN: a line through its
 * vertices, in a plane (TAHR_CAP_PLANAR). Which of them a backend holds its capabilities say (TAHR_CAP_MESH, _SOLIDS,
 * _ROUND_SOLIDS, _HULLS, _HEIGHTS, _CHAINS); another one is TAHR_E_UNSUPPORTED when the world is opened. */
enum {
    TAHR_BODY_MESH = 1,
    TAHR_BODY_BOX = 2,
    TAHR_BODY_SPHERE = 3,
    TAHR_BODY_CAPSULE = 4,
    TAHR_BODY_CYLINDER = 5,
    TAHR_BODY_CONE = 6,
    TAHR_BODY_ELLIPSOID = 7,
    TAHR_BODY_HULL = 8,
    TAHR_BODY_HEIGHTS = 9,
    TAHR_BODY_CHAIN = 10
};

enum {
    TAHR_BODY_SENSOR = 1 << 0,    /* reported, never blocks; a mesh is met at its surface, other bodies inside too */
    TAHR_BODY_TWO_SIDED = 1 << 1, /* triangles and chains block from behind too */
    TAHR_BODY_MOVABLE = 1 << 2,   /* will be placed again with tahr_world_set or _move; others never move */
    TAHR_BODY_FLUID = 1 << 3,     /* a volume to swim in: a sensor too; boxes, spheres, capsules */
    TAHR_BODY_NO_BASE = 1 << 4,   /* stood on, but does not carry */
    TAHR_BODY_NO_STEP = 1 << 5,   /* not stepped up on */
    TAHR_BODY_CHARACTER = 1 << 6, /* stands for another character: see config.max_depenetration_character */
    /* Stood on from above, passed from everywhere else: it is there only for a shape that does not overlap it, where
     * the contact normal is within 60 degrees of up (tahr_one_way_blocks), and its edges only for what comes down on
     * them. No wall, no ceiling, no step, no ledge to hang on. Bodies side by side are one platform. Not with SENSOR.
     * Of bodies that the world did not describe tahr_body_motion.flags tells. */
    TAHR_BODY_ONE_WAY = 1 << 7,
    TAHR_BODY_LOOP = 1 << 8,    /* a chain: its last vertex is joined to the first */
    TAHR_BODY_TEMPLATE = 1 << 9 /* a hull: not there itself, it lends its vertices to TAHR_SHAPE_HULL */
};

/* One body of a scene. Its id is its index in tahr_world_desc.bodies.
 * Zero what you do not use: mask 0 means "all bits", a zero quaternion means identity. */
typedef struct tahr_body_desc {
    uint32_t struct_size;
    uint32_t type;              /* TAHR_BODY_* kind */
    uint32_t flags;             /* TAHR_BODY_* flags */
    uint32_t mask;              /* queries with (body.mask & mask) == 0 do not find it */
    tahr_pose pose;             /* world */
    uint32_t walkable_rule;     /* TAHR_WALKABLE_* */
    uint32_t surface;           /* handed back in hits and contacts */
    double walkable_angle;      /* rad, with INCREASE and DECREASE */
    tahr_vec3 surface_velocity; /* m/s, local, up to 1e4: a conveyor; of a FLUID: its current */
    double mass;                /* kg, 0..1e12; 0: no character moves it, and no push is reported */
    double fluid_friction;      /* 1/s, FLUID: drag; 0: config.fluid_friction; up to 1e4 */

    /* Every size that counts lies within 1e-6..1e6 m, positions within 1e7 m of the origin. */
    tahr_vec3 half_extents; /* m, of a box; semi-axes of an ellipsoid; x and y: half the size of a field of heights */
    double radius;          /* m, sphere, capsule, cylinder, base of a cone */
    double half_height;     /* m, along local z: capsule (caps included), cylinder, cone (apex at +z) */

    /* 3 per vertex, m, local, finite, |x| <= 1e7; copied. Of a mesh, a hull (4 to 256 in general position), a chain (2
     * or more; z does not count; its front is on the right hand of who goes along it seen from +z, so that a ring that
     * runs counter-clockwise has it outside). */
    const double *vertices;
    /* Mesh: 3 per triangle, counter-clockwise seen from the front; copied. One without area (its height below 1e-10 of
     * its longest edge: two corners in one place, three in a line) is not there. */
    const uint32_t *indices;
    uint32_t vertex_count;
    uint32_t triangle_count;

    /* heights[row * columns + column], m along local z, at local x from -half_extents.x (column 0) to +half_extents.x
     * and y likewise by row; NaN: a hole. Each cell is cut from its lowest corner (x, y) to its highest: triangle
     * 2 * cell on the side of larger x, 2 * cell + 1 beside it, where cell = row * (columns - 1) + column; one with a
     * hole at a corner is not there. At least 2 by 2, at most 65 536 each way, |height| <= 1e7; copied. */
    const double *heights;
    uint32_t columns, rows;
} tahr_body_desc;

/* TELEPORT: in tahr_world_move this body jumps there, and carries and pushes nobody. */
enum { TAHR_POSE_TELEPORT = 1 << 0 };

typedef struct tahr_body_pose {
    uint32_t body;
    uint32_t flags; /* TAHR_POSE_* */
    tahr_pose pose;
} tahr_body_pose;

/* How a body moves: the rigid motion from its previous pose to this one. */
typedef struct tahr_body_motion {
    tahr_pose pose;             /* now, world */
    tahr_vec3 velocity;         /* m/s, of the body's origin */
    tahr_vec3 angular_velocity; /* rad/s, world */
    tahr_vec3 surface_velocity; /* m/s, world: a conveyor's, on top of that */
    double mass;                /* kg, or 0 */
    uint32_t flags;             /* TAHR_BODY_* */
    uint32_t teleported;        /* 1: it jumped to this pose */
} tahr_body_motion;

/* "How deep is this upright shape in a fluid?" */
typedef struct tahr_fluid_query {
    tahr_vec3 position; /* centre of the shape, world */
    tahr_vec3 up;       /* unit */
    double radius;      /* m, half width of the shape */
    double half_height; /* m */
    uint32_t mask;      /* bodies with (body.mask & mask) == 0 are not there */
    uint32_t reserved;  /* 0 */
} tahr_fluid_query;

typedef struct tahr_fluid {
    double immersion;   /* 0..1: part of the height below the surface; 0: no fluid */
    double friction;    /* 1/s drag; 0: config.fluid_friction */
    tahr_vec3 velocity; /* m/s, world: the current */
    uint32_t body;      /* or TAHR_NO_BODY */
    uint32_t reserved;
} tahr_fluid;

/* A scene. allocator and log are copied; everything else is read during tahr_world_open only. */
typedef struct tahr_world_desc {
    uint32_t struct_size;
    uint32_t body_count;
    const tahr_body_desc *bodies;
    const tahr_allocator *allocator; /* NULL: malloc */
    const tahr_log *log;             /* NULL: silent */
    const void *options;             /* the backend's own description (for example tahr_native_desc), or NULL */
} tahr_world_desc;

/* [in] query, [out] hit (zeroed before the call: leaving it so means "free"). Fill in blocking, fraction and normal, or
 * start_overlap, depth and normal; and body, surface and feature if you have them. Points lie within 1e8 m. What stays
 * zero is derived: surface_normal from normal, distance from the margin, point from the shape. Return TAHR_OK, or a
 * negative status to end the step with TAHR_E_BACKEND. Called from the stepping thread, or from the one that asks
 * tahr_world_sweep: from several at once if you step on several. */
typedef tahr_status (*tahr_sweep_fn)(void *user, const tahr_sweep *query, tahr_hit *hit);
/* [in] query, [out] contacts (capacity of them, zeroed before the call) and *count (0 before the call, at most
 * capacity): one per surface within query->margin, ordered by (distance, body, feature), with distance, normal and
 * point; surface_normal is derived. Return TAHR_TRUNCATED if there are more. Other statuses and threads as for
 * tahr_sweep_fn. */
typedef tahr_status (*tahr_contacts_fn)(void *user, const tahr_contact_query *query, tahr_contact *contacts,
                                        uint32_t capacity, uint32_t *count);
/* [in] query, [out] hit (zeroed before the call): fill in blocking, fraction and normal of the first blocking hit; what
 * stays zero of surface_normal and point is derived. Statuses and threads as for tahr_sweep_fn. */
typedef tahr_status (*tahr_ray_fn)(void *user, const tahr_ray *query, tahr_hit *hit);

/* [in] query, [out] hits (capacity of them, zeroed) and *count (0 before the call, at most capacity): the sensors that
 * a motion passes, ends in or begins in, one record each, ordered by (fraction, body), with body, feature, surface and
 * fraction, at which the distance falls to query->margin; those that the shape overlaps at the start (distance < 0)
 * with start_overlap and fraction 0. A motion of zero asks for those alone. What stays zero is derived: normal from the
 * motion (the true one makes the times of events in a fall exact), surface_normal from normal, point from the position.
 * Return TAHR_TRUNCATED if there are more. Other statuses and threads as for tahr_sweep_fn. */
typedef tahr_status (*tahr_sensors_fn)(void *user, const tahr_sweep *query, tahr_hit *hits, uint32_t capacity,
                                       uint32_t *count);
/* [in] body, one that your hits name, [out] motion (at rest at the origin before the call). Return TAHR_E_NOT_FOUND for
 * a body that is gone: who stood on it falls. Called at least once a step by who stands on it; must agree with what the
 * queries answer. Other statuses and threads as for tahr_sweep_fn. */
typedef tahr_status (*tahr_body_fn)(void *user, uint32_t body, tahr_body_motion *motion);
/* [in] query, [out] fluid (zeroed before the call but for its body, TAHR_NO_BODY: leaving it so means "dry"): immersion
 * within 0..1, friction within 0..1e4, |velocity| up to 1e4. Statuses and threads as for tahr_sweep_fn. */
typedef tahr_status (*tahr_fluid_fn)(void *user, const tahr_fluid_query *query, tahr_fluid *fluid);

/* NO_MARGIN: the sweep does not know tahr_sweep.margin, it is always 0: the shape comes larger by it on all sides, and
 * what that overlaps by less is taken as near. Such a sweep must report overlaps at the start with depth and normal,
 * and honour TAHR_SWEEP_LEAVE_OVERLAP (look past what the motion leaves), for the larger shape of who stands on a floor
 * overlaps it by a hair in every query. Lost is what a grown shape does not tell: where it overlaps two surfaces at
 * once only the deepest is known; the corners of a grown box are sharp, so beside an edge or corner it keeps up to 1.73
 * margins; distances are as good as the engine's depths of a few millimetres. Hulls are not swept so.
 * PROBE: without a contacts function, what is near is felt for by 14 to 42 short sweeps, each of which counts as a
 * query. Of up to three planes within the margin at right angles all are found; others may be hidden behind nearer
 * ones, and an edge or corner is taken for the plane across its normal. */
enum { TAHR_CALLBACKS_NO_MARGIN = 1, TAHR_CALLBACKS_PROBE = 2 };

/* Your own collision engine. Copied; user must stay valid until the world is closed. Only sweep is required; it must
 * honour tahr_sweep.margin (unless flags say otherwise) and every shape that a mover has, of any size; for capsules
 * spheres are swept too, for spheres capsules, with config.flat_base and for hulls boxes.
 * sensors missing: there are none. body missing: nothing moves. fluid missing: there is none.
 * contacts missing: overlaps are those of sweeps that go nowhere, from the shape's place and then from out of each
 * overlap found, up to 4 of them, each told by its plane; what is near and not overlapped is not known (but see PROBE);
 * each of these sweeps counts as a query.
 * ray missing: a sphere of 1 mm is swept, which meets what passes within 1 mm and ends up to that much early.
 * tahr_backend_selftest (selftest.h) tells whether your functions keep all this. */
typedef struct tahr_callbacks {
    uint32_t struct_size;
    uint32_t flags; /* TAHR_CALLBACKS_* */
    void *user;
    tahr_sweep_fn sweep;
    tahr_contacts_fn contacts;
    tahr_ray_fn ray;
    tahr_sensors_fn sensors;
    tahr_body_fn body;
    tahr_fluid_fn fluid;
} tahr_callbacks;

/* Sets every field to its default: zero, but struct_size, type, mask (all bits) and the orientation (identity). [out]
 * desc of size bytes. Untouched on error. Allocates nothing; may run on several threads.
 * Returns TAHR_OK, TAHR_E_NULL, TAHR_E_STRUCT_SIZE. Since 0.1. */
TAHR_API tahr_status tahr_world_desc_init(tahr_world_desc *desc, size_t size);
TAHR_API tahr_status tahr_body_desc_init(tahr_body_desc *desc, size_t size, uint32_t type);

/* Opens a scene on a backend. [out] world, untouched on failure; close it with tahr_world_close.
 * Returns TAHR_OK, TAHR_E_NULL (also an empty slot of the backend), TAHR_E_STRUCT_SIZE, TAHR_E_ABI (backend of another
 * ABI), TAHR_E_FLOAT_MODE, TAHR_E_GEOMETRY (index out of range, vertex not finite or beyond 1e7 m, mesh without
 * triangles, hull without a volume), TAHR_E_ARGUMENT (type, flags, pose, size or rule of a body; options),
 * TAHR_E_UNSUPPORTED (unknown tail of a description not zero, or the backend cannot hold such a body), TAHR_E_MEMORY,
 * and what the backend's own header adds; the log names the body and the field.
 * Allocates. Worlds may be opened, and closed, on several threads at once, if what they share (allocator, log, backend)
 * may be called so; an open world belongs to no thread. Since 0.1. */
TAHR_API tahr_status tahr_world_open(const struct tahr_backend *backend, const tahr_world_desc *desc,
                                     tahr_world **world);

/* Opens a world whose geometry is behind the caller's functions. desc may be NULL; of it only allocator and log are
 * used. [out] world, untouched on failure. Returns TAHR_OK, TAHR_E_NULL (sweep missing), TAHR_E_STRUCT_SIZE,
 * TAHR_E_UNSUPPORTED (unknown flags or tail not zero), TAHR_E_FLOAT_MODE, TAHR_E_MEMORY. Allocates. Threads as for
 * tahr_world_open. Since 0.1. */
TAHR_API tahr_status tahr_world_open_callbacks(const tahr_callbacks *callbacks, const tahr_world_desc *desc,
                                               tahr_world **world);

/* Closes a world; its movers must be destroyed before, and nothing else may use it meanwhile. NULL is allowed.
 * Since 0.1. */
TAHR_API void tahr_world_close(tahr_world *world);

/* Places movable bodies at new poses, at rest, and advances the revision; the others keep their motion. All or nothing:
 * every pose is checked first. Needs exclusive access: no step may run meanwhile. Characters are not carried: what is
 * placed into one pushes it out in its next step. Use it to put a scene back for a rollback. Returns TAHR_OK,
 * TAHR_E_NULL, TAHR_E_NOT_FOUND (no such body), TAHR_E_ARGUMENT (not movable, not finite, not a unit quaternion, flags
 * not 0; in a TAHR_CAP_PLANAR world turned about anything but z), TAHR_E_UNSUPPORTED (a backend or callbacks that
 * cannot place). Since 0.1. */
TAHR_API tahr_status tahr_world_set(tahr_world *world, const tahr_body_pose *poses, uint32_t count);

/* Moves movable bodies to new poses within dt seconds (> 0, up to 10), and advances the revision. All or nothing. Needs
 * exclusive access. Call it once before the steps of a tick, with every body that moves in it: bodies that are not
 * named, or are where they were, come to rest. In their next step characters are carried by what they stand on, by the
 * exact difference of its poses, and pushed by what moves into them, straight and turning evenly (by less than half a
 * turn). A body named twice goes to its last pose. poses[i].flags: TAHR_POSE_TELEPORT. For a rollback put the bodies
 * back with tahr_world_set and move them again: all bits repeat. Statuses as for tahr_world_set, and TAHR_E_ARGUMENT
 * (dt; flags unknown). Since 0.1. */
TAHR_API tahr_status tahr_world_move(tahr_world *world, const tahr_body_pose *poses, uint32_t count, double dt);

/* How a body moves now: its speeds are those of the last tahr_world_move, on the way to this pose. World frame, SI
 * units. [out] motion, untouched on error. Returns TAHR_OK, TAHR_E_NULL, TAHR_E_NOT_FOUND, TAHR_E_BACKEND
 * (an invalid answer of a callback). Allocates nothing; may run on several threads. Since 0.1. */
TAHR_API tahr_status tahr_world_body(tahr_world *world, uint32_t body, tahr_body_motion *motion);

/* Tells worlds whose geometry is the user's (callbacks, tahr_native_desc.gather) that it changed, so that cached floors
 * and triangles are looked at again. Needs exclusive access. Returns TAHR_OK, TAHR_E_NULL. Since 0.1. */
TAHR_API tahr_status tahr_world_touch(tahr_world *world);

/* A number that changes when the world does; the same again when bodies are put back. 0 for NULL. Since 0.1. */
TAHR_API uint64_t tahr_world_revision(const tahr_world *world);

/* Says in words what a world is made of, which way queries go through it and why: one line per call of to->write, of
 * level TAHR_LOG_INFO, the first one about the whole. With native: what there is, how triangles meet (open and flat
 * edges), what was dropped, bytes per triangle, the densest place and how far around a step is gathered there, meshes
 * that are fields of heights; with the others the bodies and the way of a query. For people, and different from version
 * to version. Takes time in proportion to the triangles (0.1 s per million); allocates nothing; not while the world is
 * changed. Returns TAHR_OK, TAHR_E_NULL, TAHR_E_BACKEND. Since 0.1. */
TAHR_API tahr_status tahr_world_describe(tahr_world *world, const tahr_log *to);

/* Name of the backend behind a world ("native", "callbacks"), "?" for NULL; static memory. Since 0.1. */
TAHR_API const char *tahr_world_backend_name(const tahr_world *world);

/* Bytes that a world holds now through its allocator (scene and backend, without the caches of movers). 0 for NULL.
 * Since 0.1. */
TAHR_API uint64_t tahr_world_memory(const tahr_world *world);

/* The three questions, asked directly, with arguments and answers checked; the order of the answers is that of the
 * slots in backend.h. [out] *count of hits or contacts. Outputs untouched on error. Positions up to 2e7 m from the
 * origin, sweeps up to 1e6 m long, margins up to 1e4 m. Return TAHR_OK, TAHR_TRUNCATED, TAHR_UNKNOWN (sweep),
 * TAHR_E_NULL, TAHR_E_ARGUMENT (query not finite or out of range, bad shape, up, orientation or flags, up or motion
 * with a z in a TAHR_CAP_PLANAR world, a sweep with capacity 0), TAHR_E_UNSUPPORTED (shape), TAHR_E_BACKEND (invalid
 * answer). At most 64 answers per call. Allocate nothing; may run on several threads. Since 0.1. */
TAHR_API tahr_status tahr_world_sweep(tahr_world *world, const tahr_sweep *query, tahr_hit *hits, uint32_t capacity,
                                      uint32_t *count);
TAHR_API tahr_status tahr_world_contacts(tahr_world *world, const tahr_contact_query *query, tahr_contact *contacts,
                                         uint32_t capacity, uint32_t *count);
TAHR_API tahr_status tahr_world_ray(tahr_world *world, const tahr_ray *query, tahr_hit *hit, uint32_t *count);

/* The rule of one-way bodies, for your own sweep, contacts and ray: 1 if such a body is there for a shape with this up
 * that is at this signed distance from it when the question is asked (for a sweep at its start), where the contact
 * normal is this; else 0. flags and margin are those of a sweep. Besides: an edge (where the contact normal is not that
 * of the face) blocks only a sweep with motion . up < 0, and is no contact; with TAHR_CONTACTS_DROP nothing is.
 * NULL: 0. Allocates nothing; may run on several threads. Since 0.1. */
TAHR_API int32_t tahr_one_way_blocks(const tahr_vec3 *up, const tahr_vec3 *normal, double distance, double margin,
                                     uint32_t flags);

/* How deep an upright shape is in the fluids of a world: of described bodies the largest part of its axis that lies
 * inside one of them, ties by id. [in] query: radius 0..1e4 m, half_height 1e-6..1e4 m; [out] fluid: immersion 0 and
 * TAHR_NO_BODY where there is none; untouched on error. Returns TAHR_OK, TAHR_E_NULL, TAHR_E_ARGUMENT, TAHR_E_BACKEND
 * (invalid answer). Allocates nothing; may run on several threads. Since 0.1. */
TAHR_API tahr_status tahr_world_fluid(tahr_world *world, const tahr_fluid_query *query, tahr_fluid *fluid);

#ifdef __cplusplus
}
#endif
#endif
