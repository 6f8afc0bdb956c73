/* SPDX-License-Identifier: MIT
 * fit.c: whether a character fits the world that it is to move in. */
#include "fit.h"

#include <string.h>

#include "message.h"
#include "query.h"

/* In a world of two dimensions everybody stays in its plane. Returns the field that does not, or NULL. */
static const char *out_of_plane(const tahr_world *world, const tahr_config *c)
{
    if (!world_is_planar(world)) {
        return NULL;
    }
    int planar = c->plane.x == 0 && c->plane.y == 0 && c->plane.z != 0;
    return !planar ? "plane" : (c->gravity.z != 0 ? "gravity" : NULL);
}

/* Extents are the user's own sums: a millionth is their rounding, and 1e-6 m of a person is below the skin. */
static int differs(double size, double half)
{
    return !(fabs(size - half) <= 1e-6 * half);
}

/* Described bodies only: of callbacks nothing is known. */
static const char *bad_hull(const tahr_world *world, const tahr_shape *s)
{
    if (s->type != TAHR_SHAPE_HULL || !world->bodies) {
        return NULL;
    }
    const uint32_t id = s->hull;
    if (id >= world->body_count || !(world->bodies[id].flags & TAHR_BODY_TEMPLATE)) {
        return "shape.hull";
    }
    const vec3 half = world->bodies[id].half;
    if (half.x == 0) { /* restored by a recorder, which knows no vertices */
        return NULL;
    }
    if (differs(s->half_x, half.x) || differs(s->half_y, half.y)) {
        return differs(s->half_x, half.x) ? "shape.half_x" : "shape.half_y";
    }
    return differs(s->half_height, half.z) ? "shape.half_height" : NULL;
}

tahr_status tahr__fit_check(const tahr_world *world, const tahr_config *config, const char *function)
{
    if (!tahr__can_sweep(world, &config->shape)) {
        return tahr__cannot_sweep(world, function, &config->shape);
    }
    const char *field = out_of_plane(world, config);
    if (field) {
        return tahr__complain(&world->log, TAHR_E_UNSUPPORTED, function, field,
                              strcmp(field, "plane") == 0 ? "must be (0, 0, 1): the world has two dimensions, x and y"
                                                          : TAHR__NO_Z);
    }
    field = bad_hull(world, &config->shape);
    return field ? tahr__complain(&world->log, TAHR_E_ARGUMENT, function, field,
                                  "does not fit a hull of the scene with TAHR_BODY_TEMPLATE")
                 : TAHR_OK;
}
