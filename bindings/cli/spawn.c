/* SPDX-License-Identifier: MIT
 * spawn.c: places on a level where characters can stand: rays from above through every layer of it. */
#include "spawn.h"

#include "say.h"
#include "side.h"
#include "vec.h"
#include "wander.h"

/* Layers of one column that are looked at, and how far below a hit the next ray starts, m. */
#define MAX_LAYERS 16
#define LAYER_STEP 0.01

/* Columns tried before giving up: a level of which 1 % is walkable still fills up. */
static uint64_t most_columns(uint32_t count)
{
    return 4096 + 256 * (uint64_t)count;
}

/* The walkable limit as a cosine, without libm, whose last bits differ between machines. */
static double cosine_of(double angle)
{
    return unit_vector(angle / 6.283185307179586).x;
}

/* The coordinate that is the height of a place. */
static double *height_of(const struct level *level, tahr_vec3 *place)
{
    return level->side != NULL ? &place->y : &place->z;
}

/* Whether the shape fits above a hit with a skin of air on all sides. *place is where the ray met the ground, and then
 * the centre of the shape. */
static int fits(tahr_world *world, const struct level *level, const tahr_config *config, const tahr_hit *hit,
                tahr_vec3 *place)
{
    const tahr_shape *shape = &config->shape;
    tahr_state state;
    tahr_contact contact;
    uint32_t count = 0;
    double clearance = config->skin * config->floor_target, slant = level_height(level, hit->normal);
    double half_width = shape->type == TAHR_SHAPE_BOX ? shape->half_x : 0;
    /* The lower cap touches a slope beside its lowest point: lift it by the slant. Of a box a corner touches it. */
    *height_of(level, place) += (shape->radius + clearance) / slant - shape->radius + shape->half_height;
    *height_of(level, place) += half_width * sqrt(most(1 - slant * slant, 0)) / slant;
    if (level->side != NULL && side_is_solid(level->side, place->x, place->y)) {
        return 0; /* on one solid, inside of another */
    }
    tahr_state_init(&state, config, place);
    tahr_contact_query query = {.shape = *shape,
                                .position = *place,
                                .up = state.up,
                                .orientation = state.orientation,
                                .margin = config->skin,
                                .mask = config->mask,
                                .ignore_body = TAHR_NO_BODY,
                                .flags = level->side != NULL ? (uint32_t)TAHR_CONTACTS_SOLID : 0u};
    tahr_status status = tahr_world_contacts(world, &query, &contact, 1, &count);
    return status == TAHR_OK && count == 0;
}

/* Whether a face looks up by its winding. Rooms are modelled from inside: their ceilings, which can be stood on from
 * outside because meshes are two-sided, look down. */
static int looks_up(const struct level *level, const tahr_hit *hit)
{
    const tahr_body_desc *body = hit->body < level->body_count ? &level->bodies[hit->body] : NULL;
    tahr_vec3 p[3];
    if (body == NULL || body->type != TAHR_BODY_MESH || hit->feature >= body->triangle_count) {
        return 1;
    }
    for (int k = 0; k < 3; k++) {
        const double *v = body->vertices + 3 * (size_t)body->indices[3 * (size_t)hit->feature + (size_t)k];
        p[k] = (tahr_vec3){v[0], v[1], v[2]};
    }
    return level_height(level, vec_cross(vec_sub(p[1], p[0]), vec_sub(p[2], p[0]))) > 0;
}

/* The places of one column, from above: those on faces that look up, or if there are none, the others. Returns their
 * number, or -1 when the backend fails. */
static int search_column(tahr_world *world, const struct level *level, const tahr_config *config, tahr_vec3 *places,
                         tahr_vec3 at)
{
    tahr_vec3 low = level->bounds.min, high = level->bounds.max;
    const double lowest = *height_of(level, &low) - 1, limit = cosine_of(config->walkable_angle);
    double *height = height_of(level, &at);
    int found = 0, proper = 0; /* found: on faces of the better kind so far */
    *height = *height_of(level, &high) + 1;
    for (int layer = 0; layer<MAX_LAYERS && * height> lowest; layer++) {
        tahr_ray ray = {.origin = at, .mask = config->mask, .ignore_body = TAHR_NO_BODY};
        tahr_hit hit = {0};
        uint32_t count = 0;
        *height_of(level, &ray.motion) = lowest - *height;
        tahr_status status = tahr_world_ray(world, &ray, &hit, &count);
        if (status < 0) {
            say_error("cannot look for spawn points: %s", tahr_status_message(status));
            return -1;
        }
        if (count == 0 || !hit.blocking) {
            break;
        }
        *height += *height_of(level, &ray.motion) * hit.fraction;
        tahr_vec3 place = at;
        int up = looks_up(level, &hit);
        if (*height_of(level, &hit.normal) >= limit && up >= proper && fits(world, level, config, &hit, &place)) {
            found = up > proper ? 0 : found;
            proper = up;
            places[found++] = place;
        }
        *height -= LAYER_STEP;
    }
    return found;
}

int spawn_find(tahr_world *world, const struct level *level, const tahr_config *config, uint64_t seed,
               tahr_vec3 *places, uint32_t count)
{
    /* The R2 sequence (M. Roberts, 2018) covers the plane evenly for any number of points: fractions of the inverse
     * powers of the plastic number. The seed moves its start. */
    const double step_x = 0.7548776662466927, step_y = 0.5698402909980532;
    const tahr_bounds *bounds = &level->bounds;
    struct pcg random;
    uint32_t found = 0;
    pcg_start(&random, seed, UINT32_MAX);
    double u = pcg_unit(&random), v = pcg_unit(&random);
    for (uint64_t column = 0; column < most_columns(count) && found < count; column++) {
        tahr_vec3 layers[MAX_LAYERS];
        u = u + step_x - floor(u + step_x);
        v = v + step_y - floor(v + step_y);
        tahr_vec3 at = {bounds->min.x + u * (bounds->max.x - bounds->min.x),
                        bounds->min.y + v * (bounds->max.y - bounds->min.y), 0};
        int number = search_column(world, level, config, layers, at);
        if (number < 0) {
            return -1;
        }
        if (number > 0) {
            places[found++] = layers[(uint32_t)(pcg_unit(&random) * number)];
        }
    }
    if (found == 0) {
        say_error("level '%s' has no walkable place that a character fits in", level->name);
        return -1;
    }
    for (uint32_t i = found; i < count; i++) {
        places[i] = places[i - found];
    }
    return 0;
}
