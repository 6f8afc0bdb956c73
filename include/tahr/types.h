/* SPDX-License-Identifier: MIT
 * types.h: frozen plain data: vectors, shapes, queries and their answers. SI units (metres, seconds, radians),
 * right-handed world frame, any up direction. Frozen: fixed size within an ABI range, reserved words zero. */
#ifndef TAHR_TYPES_H
#define TAHR_TYPES_H

#include <tahr/abi.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct tahr_vec3 {
    double x, y, z;
} tahr_vec3;

/* Unit quaternion, w is the scalar part. */
typedef struct tahr_quat {
    double x, y, z, w;
} tahr_quat;

/* Local to world: p_world = position + orientation * p_local. */
typedef struct tahr_pose {
    tahr_vec3 position;
    tahr_quat orientation;
} tahr_pose;

typedef struct tahr_bounds {
    tahr_vec3 min, max;
} tahr_bounds;

enum {
    TAHR_SHAPE_SPHERE = 1,
    TAHR_SHAPE_CAPSULE = 2,
    TAHR_SHAPE_BOX = 3,
    TAHR_SHAPE_CYLINDER = 4,
    TAHR_SHAPE_CONE = 5,
    TAHR_SHAPE_ELLIPSOID = 6,
    TAHR_SHAPE_HULL = 7
};

/* A character's shape, centred on its position, its axis along up.
 * Sphere: radius; half_height equals radius. Capsule: radius and half_height with the caps in it (half_height >=
 * radius). Box: half extents half_x, half_y across the axis (in the frame of the orientation) and half_height along it;
 * radius 0. Cylinder: radius and half_height. Cone: radius of its base, which is below, and half_height. Ellipsoid: its
 * semi-axes are half_x, half_y and half_height; radius 0. Hull: the vertices of a body of the scene (TAHR_BODY_HULL
 * with TAHR_BODY_TEMPLATE) in the frame of the orientation, the middle of their extents at the position; half_x, half_y
 * and half_height are half those extents, radius 0; it keeps its size: it does not crouch. Boxes, cylinders, cones and
 * hulls stand on a flat base, which holds on an edge as long as a part of it does; rules that ask how wide a hull is
 * take its extents, and where a thinner one is asked for their box. Every size that counts lies within 1e-6..1e4 m.
 * Which of the shapes a backend sweeps its capabilities say. In a plane (TAHR_CAP_PLANAR) a sphere is a circle and
 * half_x is half the width; half_y does not count. */
typedef struct tahr_shape {
    uint32_t type;      /* TAHR_SHAPE_* */
    uint32_t hull;      /* id of the body that lends its vertices, hulls only */
    double radius;      /* m */
    double half_height; /* m */
    double half_x;      /* m, boxes, ellipsoids, hulls */
    double half_y;      /* m, boxes, ellipsoids, hulls */
} tahr_shape;

/* Sweep flags. LEAVE_OVERLAP: a surface that is overlapped at the start blocks only a motion that goes deeper in.
 * ONLY_BODY: the other way round: nothing is there but ignore_body (asked only of bodies that tahr_world_move moves).
 * SENSORS: only sensors are there, and nothing blocks; a motion of zero asks what the shape is inside of. A
 * tahr_sweep_fn never sees it: tahr_callbacks.sensors is asked instead.
 * Of one-way bodies (TAHR_BODY_ONE_WAY), and nothing to who has none: DROP: one that is within two margins at
 * the start is not there. WHOLE: they block from all sides, as any other. PASS: none of them is there. */
enum {
    TAHR_SWEEP_LEAVE_OVERLAP = 1,
    TAHR_SWEEP_ONLY_BODY = 2,
    TAHR_SWEEP_SENSORS = 4,
    TAHR_SWEEP_DROP = 8,
    TAHR_SWEEP_WHOLE = 16,
    TAHR_SWEEP_PASS = 32
};

/* "How far can this shape go along this motion before the distance to something falls to margin?"
 * The margin is a distance between surfaces along their normal (metres, >= 0), not extra motion. With d0 the signed
 * distance at the start: d0 < 0 is an overlap at the start; 0 <= d0 <= margin blocks at fraction 0 if the motion
 * approaches (motion . normal < 0) and does not block otherwise. */
typedef struct tahr_sweep {
    tahr_shape shape;
    tahr_vec3 position;    /* centre of the shape, world */
    tahr_vec3 up;          /* unit axis of the shape, world */
    tahr_quat orientation; /* frame of the shape: its z axis is up (boxes need it, round shapes do not) */
    tahr_vec3 motion;      /* m, world */
    double margin;         /* m */
    uint32_t mask;         /* bodies with (body.mask & mask) == 0 are not there */
    uint32_t ignore_body;  /* one body that is not there (ONLY_BODY: that alone is), or TAHR_NO_BODY */
    uint32_t flags;        /* TAHR_SWEEP_* */
    uint32_t reserved;
} tahr_sweep;

/* A motion and what is under its end, for backends that can answer both in one look: is it free, and what does the foot
 * meet on its own motion from where it would be then? Fields as in two tahr_sweep without flags and without a body to
 * ignore; the shapes are round. */
typedef struct tahr_walk {
    const tahr_shape *shape;
    const tahr_shape *foot; /* NULL: only the motion is asked for */
    tahr_vec3 position, motion;
    tahr_vec3 foot_position, foot_motion;
    tahr_vec3 up;
    double margin; /* m */
    uint32_t mask;
    uint32_t reserved;
} tahr_walk;

/* Contact query flags. SOLID: sensors are not there. DROP: one-way bodies are not there. */
enum { TAHR_CONTACTS_SOLID = 1, TAHR_CONTACTS_DROP = 2 };

/* "What is within margin of this shape here?" Fields of one name mean what they mean in tahr_sweep. */
typedef struct tahr_contact_query {
    tahr_shape shape;
    tahr_vec3 position;
    tahr_vec3 up;
    tahr_quat orientation;
    double margin; /* m, >= 0; 0 = overlap and penetration only */
    uint32_t mask;
    uint32_t ignore_body;
    uint32_t flags; /* TAHR_CONTACTS_* */
    uint32_t reserved;
} tahr_contact_query;

/* "What does this segment meet first?" From origin to origin + motion. Sensors are not there. */
typedef struct tahr_ray {
    tahr_vec3 origin; /* world */
    tahr_vec3 motion; /* m, world */
    uint32_t mask;
    uint32_t ignore_body;
} tahr_ray;

/* How a surface changes the walkable limit. INCREASE only widens it to walkable_angle, DECREASE only narrows it; an
 * angle outside 0..90 degrees is taken as the nearer end. */
enum { TAHR_WALKABLE_DEFAULT = 0, TAHR_WALKABLE_INCREASE = 1, TAHR_WALKABLE_DECREASE = 2, TAHR_WALKABLE_NEVER = 3 };

/* Where a shape met something. All vectors world frame. distance: the margin of an ordinary hit, less of what was
 * closer already at the start. */
typedef struct tahr_hit {
    uint32_t blocking;        /* 1: stops the motion; 0: a sensor, or nothing at all */
    uint32_t start_overlap;   /* 1: overlaps at the start: fraction 0, depth and normal say how to get out */
    uint32_t unknown;         /* 1: the backend gave up; free up to fraction, nothing known beyond */
    uint32_t sensor;          /* 1: reported, does not block */
    double fraction;          /* 0..1 of the motion */
    double distance;          /* m, signed distance at that place */
    double depth;             /* m, > 0 only with start_overlap */
    tahr_vec3 normal;         /* contact normal, unit, from the surface to the shape */
    tahr_vec3 surface_normal; /* unit, of the face; on an edge or vertex, of its face that opposes the motion most */
    tahr_vec3 point;          /* on the surface; of a line or patch that touches alike, one of its points */
    double walkable_angle;    /* rad, with INCREASE and DECREASE */
    uint32_t walkable_rule;   /* TAHR_WALKABLE_* */
    uint32_t surface;         /* the user's id of the surface */
    uint32_t body;
    uint32_t feature; /* triangle of a mesh, face of a box or a hull, 0 of round bodies */
} tahr_hit;

/* One feature near a shape. All vectors world frame; what tells of the surface as in tahr_hit. */
typedef struct tahr_contact {
    double distance;          /* m, signed: negative is penetration depth */
    tahr_vec3 normal;         /* contact normal, unit, from the surface to the shape: the way out */
    tahr_vec3 surface_normal; /* unit, of the face; on an edge or vertex, of its face that faces the normal most */
    tahr_vec3 point;          /* on the surface */
    double walkable_angle;    /* rad */
    uint32_t walkable_rule;
    uint32_t surface;
    uint32_t body;
    uint32_t feature;
    uint32_t sensor; /* 1: of a sensor */
    uint32_t reserved;
} tahr_contact;

#ifdef __cplusplus
}
#endif
#endif
