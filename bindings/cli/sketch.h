/* SPDX-License-Identifier: MIT
 * sketch.h: drawing meshes of a level: triangles, quads, profiles, blocks. */
#ifndef TAHR_CLI_SKETCH_H
#define TAHR_CLI_SKETCH_H

#include "level.h"

/* A mesh under construction. Vertices need not be welded: the library does that. */
struct sketch {
    double *vertices;
    uint32_t *indices;
    size_t vertex_count, index_count, vertex_capacity, index_capacity;
};

void sketch_triangle(struct sketch *sketch, tahr_vec3 a, tahr_vec3 b, tahr_vec3 c);
void sketch_quad(struct sketch *sketch, tahr_vec3 a, tahr_vec3 b, tahr_vec3 c, tahr_vec3 d);

/* Hands the mesh to the level. */
void sketch_finish(struct sketch *sketch, struct level *level);

struct corner {
    double x, z;
};

/* A profile of heights over x, drawn out from y0 to y1, with side walls down to `bottom`. Two corners over each other
 * are a riser. */
void sketch_profile(struct sketch *sketch, const struct corner *profile, size_t count, double y0, double y1,
                    double bottom);

#define SKETCH_PROFILE(sketch, y0, y1, bottom, ...)                                           \
    do {                                                                                      \
        const struct corner profile_[] = {__VA_ARGS__};                                       \
        sketch_profile(sketch, profile_, sizeof profile_ / sizeof *profile_, y0, y1, bottom); \
    } while (0)

/* A box that stands on height z0. */
void sketch_block(struct level *level, double x0, double x1, double y0, double y1, double z0, double z1);

#endif
