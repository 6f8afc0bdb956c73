/* SPDX-License-Identifier: MIT
 * level.h: a level as the shell holds it: bodies for the world, and the same geometry for the checker and the plot. Z
 * up; of two dimensions Y up. */
#ifndef TAHR_CLI_LEVEL_H
#define TAHR_CLI_LEVEL_H

#include "backends.h"

#include <tahr/fcl.h>
#include <tahr/tahr.h>

/* A sphere (a equals b) or a capsule, by the ends of its axis. */
struct level_round {
    tahr_vec3 a, b;
    double radius;
};

/* A box that moves: there and back along `swing` with `pause` seconds at both ends, and round the vertical. */
struct level_mover {
    uint32_t body;
    tahr_vec3 half_extents, center; /* m; center: where it begins */
    tahr_vec3 swing;                /* m, from one end to the other */
    double period;                  /* s there and back, with the pauses */
    double pause;                   /* s */
    double turns;                   /* per second, counter-clockwise seen from above */
    int one_way;
};

/* A surface that blocks from above only: its ends, from left to right. */
struct level_thin {
    tahr_vec3 a, b;
};

/* A box of water. */
struct level_pool {
    tahr_vec3 center, half_extents;
};

/* What the plot writes on the map. */
struct level_label {
    const char *text;
    double x, y;
};

struct level {
    char *name;
    char *octree; /* a map of voxels by its path, or NULL */
    tahr_body_desc *bodies;
    size_t body_count, body_capacity;
    tahr_vec3 *corners; /* three per triangle, of meshes and of boxes, world */
    size_t triangle_count, corner_capacity;
    struct level_round *rounds;
    size_t round_count, round_capacity;
    struct level_mover *movers; /* neither among the triangles nor in the bounds */
    size_t mover_count, mover_capacity;
    struct level_pool *pools;
    size_t pool_count, pool_capacity;
    const struct level_label *labels; /* static memory */
    size_t label_count;
    tahr_bounds bounds;
    struct side *side; /* NULL, or what was drawn: a level of two dimensions, x and y, Y up */
    struct level_thin *thins;
    size_t thin_count, thin_capacity;
};

/* Is it a map of voxels, by the end of its name? */
int level_is_octree(const char *path);
/* Reads a map of voxels, always Z up. 0, or -1 after a message. */
int level_load_octree(struct level *level, const char *path);

/* What opens a world of this level on a backend: *options, in room if need be. 0, or -1 after a message that the
 * backend does not hold it. */
struct level_options {
    tahr_fcl_desc fcl;
    tahr_fcl_octree octree;
};
int level_options(const struct level *level, const struct backend_choice *backend, struct level_options *room,
                  const void **options);

/* Reads a file: a map of voxels as above, anything else with Assimp: triangulates it, turns Y up to Z up if up_axis
 * is 'y', welds equal vertices. One two-sided mesh body, because the winding of level files cannot be relied on. 0, or
 * -1 after a message that names the file. */
int level_load(struct level *level, const char *path, char up_axis);

/* The bundled level: about 60 x 54 m of everything that a character meets. */
void level_playground(struct level *level);

/* Switches on what the bundled level has places for: wall jumps, ledges to hang on, forgiving jumps. */
void playground_feel(tahr_config *config);

/* For the checker and the plot only. */
void level_add_triangle(struct level *level, const tahr_vec3 corners[3]);

/* Adding bodies; the level owns the arrays of a mesh from then on. */
void level_add_mesh(struct level *level, double *vertices, uint32_t vertex_count, uint32_t *indices,
                    uint32_t triangle_count);
void level_add_box(struct level *level, tahr_vec3 center, tahr_vec3 half_extents, tahr_quat orientation);
void level_add_capsule(struct level *level, tahr_vec3 center, double radius, double half_height);
void level_add_sphere(struct level *level, tahr_vec3 center, double radius);

tahr_body_desc *level_add_body(struct level *level, uint32_t type);

/* For the checker alone, of two dimensions: a wall between two places, a circle, a surface that blocks from above. */
void level_add_wall(struct level *level, tahr_vec3 a, tahr_vec3 b);
void level_add_round(struct level *level, tahr_vec3 a, tahr_vec3 b, double radius);
void level_add_thin(struct level *level, tahr_vec3 a, tahr_vec3 b);

/* Height of a place above the origin. */
double level_height(const struct level *level, tahr_vec3 place);

/* body of *mover is filled in. */
void level_add_mover(struct level *level, const struct level_mover *mover);
void level_add_pool(struct level *level, tahr_vec3 center, tahr_vec3 half_extents);
/* A conveyor: a box whose top moves. */
void level_add_belt(struct level *level, tahr_vec3 center, tahr_vec3 half_extents, tahr_vec3 velocity);

/* Where a mover is at a time, s; the same bits on every machine. */
tahr_pose level_mover_pose(const struct level_mover *mover, double time);

/* The 12 triangles of a box, outward. */
enum { LEVEL_BOX_CORNERS = 36 };
void level_box_corners(const tahr_pose *pose, tahr_vec3 half_extents, tahr_vec3 corners[LEVEL_BOX_CORNERS]);

void level_close(struct level *level);

#endif
