/* SPDX-License-Identifier: MIT
 * sketch.c: drawing meshes of a level: triangles, quads, profiles, blocks. */
#include "sketch.h"

#include "say.h"
#include "vec.h"

#include <string.h>

/* Faces look up, as the spawn points and the plot prefer them. */
void sketch_triangle(struct sketch *sketch, tahr_vec3 a, tahr_vec3 b, tahr_vec3 c)
{
    if (vec_cross(vec_sub(b, a), vec_sub(c, a)).z < 0) {
        sketch_triangle(sketch, a, c, b);
        return;
    }
    const double v[9] = {a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z};
    sketch->vertices =
        memory_grow(sketch->vertices, &sketch->vertex_capacity, 3 * sketch->vertex_count + 9, sizeof(double));
    sketch->indices = memory_grow(sketch->indices, &sketch->index_capacity, sketch->index_count + 3, sizeof(uint32_t));
    memcpy(sketch->vertices + 3 * sketch->vertex_count, v, sizeof v);
    for (int k = 0; k < 3; k++) {
        sketch->indices[sketch->index_count++] = (uint32_t)sketch->vertex_count++;
    }
}

void sketch_quad(struct sketch *sketch, tahr_vec3 a, tahr_vec3 b, tahr_vec3 c, tahr_vec3 d)
{
    sketch_triangle(sketch, a, b, c);
    sketch_triangle(sketch, a, c, d);
}

void sketch_finish(struct sketch *sketch, struct level *level)
{
    level_add_mesh(level, sketch->vertices, (uint32_t)sketch->vertex_count, sketch->indices,
                   (uint32_t)(sketch->index_count / 3));
}

/* A profile of heights over x, drawn out from y0 to y1, with side walls down to `bottom`. Two corners over each other
 * are a riser. */
void sketch_profile(struct sketch *sketch, const struct corner *profile, size_t count, double y0, double y1,
                    double bottom)
{
    for (size_t i = 0; i + 1 < count; i++) {
        struct corner a = profile[i], b = profile[i + 1];
        sketch_quad(sketch, (tahr_vec3){a.x, y0, a.z}, (tahr_vec3){b.x, y0, b.z}, (tahr_vec3){b.x, y1, b.z},
                    (tahr_vec3){a.x, y1, a.z});
        for (int side = 0; side < 2 && b.x > a.x; side++) {
            double y = side ? y1 : y0;
            if (a.z > bottom) {
                sketch_triangle(sketch, (tahr_vec3){a.x, y, bottom}, (tahr_vec3){b.x, y, b.z},
                                (tahr_vec3){a.x, y, a.z});
            }
            if (b.z > bottom) {
                sketch_triangle(sketch, (tahr_vec3){a.x, y, bottom}, (tahr_vec3){b.x, y, bottom},
                                (tahr_vec3){b.x, y, b.z});
            }
        }
    }
}

void sketch_block(struct level *level, double x0, double x1, double y0, double y1, double z0, double z1)
{
    level_add_box(level, (tahr_vec3){(x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2},
                  (tahr_vec3){(x1 - x0) / 2, (y1 - y0) / 2, (z1 - z0) / 2}, (tahr_quat){0, 0, 0, 1});
}
