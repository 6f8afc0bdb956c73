/* SPDX-License-Identifier: MIT
 * level.c: bodies of a level, kept twice: as the world wants them and as plain triangles for the checker and the
 * plot. */
#include "level.h"

#include "say.h"
#include "side.h"
#include "vec.h"
#include "wander.h"

#include <stdlib.h>

static void include_point(struct level *level, tahr_vec3 p, double reach)
{
    tahr_bounds *b = &level->bounds;
    if (level->triangle_count + level->round_count + level->thin_count == 0) {
        b->min = (tahr_vec3){p.x - reach, p.y - reach, p.z - reach};
        b->max = (tahr_vec3){p.x + reach, p.y + reach, p.z + reach};
    }
    b->min = (tahr_vec3){least(b->min.x, p.x - reach), least(b->min.y, p.y - reach), least(b->min.z, p.z - reach)};
    b->max = (tahr_vec3){most(b->max.x, p.x + reach), most(b->max.y, p.y + reach), most(b->max.z, p.z + reach)};
}

static void add_triangle(struct level *level, tahr_vec3 a, tahr_vec3 b, tahr_vec3 c)
{
    size_t first = level->triangle_count * 3;
    level->corners = memory_grow(level->corners, &level->corner_capacity, first + 3, sizeof *level->corners);
    include_point(level, a, 0);
    include_point(level, b, 0);
    include_point(level, c, 0);
    level->corners[first] = a;
    level->corners[first + 1] = b;
    level->corners[first + 2] = c;
    level->triangle_count++;
}

void level_add_triangle(struct level *level, const tahr_vec3 corners[3])
{
    add_triangle(level, corners[0], corners[1], corners[2]);
}

tahr_body_desc *level_add_body(struct level *level, uint32_t type)
{
    level->bodies = memory_grow(level->bodies, &level->body_capacity, level->body_count + 1, sizeof *level->bodies);
    tahr_body_desc *body = &level->bodies[level->body_count++];
    tahr_body_desc_init(body, sizeof *body, type);
    return body;
}

void level_add_mesh(struct level *level, double *vertices, uint32_t vertex_count, uint32_t *indices,
                    uint32_t triangle_count)
{
    tahr_body_desc *body = level_add_body(level, TAHR_BODY_MESH);
    body->flags = TAHR_BODY_TWO_SIDED;
    body->vertices = vertices;
    body->indices = indices;
    body->vertex_count = vertex_count;
    body->triangle_count = triangle_count;
    for (uint32_t t = 0; t < triangle_count; t++) {
        tahr_vec3 p[3];
        for (int k = 0; k < 3; k++) {
            const double *v = vertices + 3 * (size_t)indices[3 * (size_t)t + (size_t)k];
            p[k] = (tahr_vec3){v[0], v[1], v[2]};
        }
        add_triangle(level, p[0], p[1], p[2]);
    }
}

void level_box_corners(const tahr_pose *pose, tahr_vec3 half_extents, tahr_vec3 corners[LEVEL_BOX_CORNERS])
{
    /* Corner i has bit 0 for +x, bit 1 for +y, bit 2 for +z; two triangles per face. */
    static const int faces[LEVEL_BOX_CORNERS] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                                 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    tahr_vec3 corner[8];
    for (int i = 0; i < 8; i++) {
        tahr_vec3 local = {i & 1 ? half_extents.x : -half_extents.x, i & 2 ? half_extents.y : -half_extents.y,
                           i & 4 ? half_extents.z : -half_extents.z};
        corner[i] = vec_add(pose->position, vec_turn(pose->orientation, local));
    }
    for (int i = 0; i < LEVEL_BOX_CORNERS; i++) {
        corners[i] = corner[faces[i]];
    }
}

void level_add_box(struct level *level, tahr_vec3 center, tahr_vec3 half_extents, tahr_quat orientation)
{
    tahr_vec3 corners[LEVEL_BOX_CORNERS];
    tahr_body_desc *body = level_add_body(level, TAHR_BODY_BOX);
    body->pose = (tahr_pose){center, orientation};
    body->half_extents = half_extents;
    level_box_corners(&body->pose, half_extents, corners);
    for (int i = 0; i < LEVEL_BOX_CORNERS; i += 3) {
        add_triangle(level, corners[i], corners[i + 1], corners[i + 2]);
    }
}

void level_add_belt(struct level *level, tahr_vec3 center, tahr_vec3 half_extents, tahr_vec3 velocity)
{
    level_add_box(level, center, half_extents, (tahr_quat){0, 0, 0, 1});
    level->bodies[level->body_count - 1].surface_velocity = velocity;
}

void level_add_pool(struct level *level, tahr_vec3 center, tahr_vec3 half_extents)
{
    tahr_body_desc *body = level_add_body(level, TAHR_BODY_BOX);
    body->flags = TAHR_BODY_FLUID;
    body->pose.position = center;
    body->half_extents = half_extents;
    level->pools = memory_grow(level->pools, &level->pool_capacity, level->pool_count + 1, sizeof *level->pools);
    level->pools[level->pool_count++] = (struct level_pool){center, half_extents};
}

void level_add_mover(struct level *level, const struct level_mover *mover)
{
    tahr_body_desc *body = level_add_body(level, TAHR_BODY_BOX);
    body->flags = TAHR_BODY_MOVABLE | (mover->one_way ? (uint32_t)TAHR_BODY_ONE_WAY : 0u);
    body->pose = level_mover_pose(mover, 0);
    body->half_extents = mover->half_extents;
    level->movers = memory_grow(level->movers, &level->mover_capacity, level->mover_count + 1, sizeof *level->movers);
    level->movers[level->mover_count] = *mover;
    level->movers[level->mover_count++].body = (uint32_t)level->body_count - 1;
}

static double fraction(double x)
{
    return x - floor(x);
}

/* Smooth between the ends: (1 - cos) / 2 of half a turn. */
static double part_of_swing(const struct level_mover *mover, double time)
{
    double half = mover->period / 2, t = fraction(time / mover->period) * mover->period;
    double back = t >= half, within = t - back * half;
    double part = clamp((within - mover->pause) / (half - mover->pause), 0, 1);
    double smooth = (1 - unit_vector(part / 2).x) / 2;
    return back > 0 ? 1 - smooth : smooth;
}

tahr_pose level_mover_pose(const struct level_mover *mover, double time)
{
    tahr_pose pose = {mover->center, {0, 0, 0, 1}};
    if (mover->period > 0) {
        pose.position = vec_add(pose.position, vec_scale(mover->swing, part_of_swing(mover, time)));
    }
    if (mover->turns != 0) {
        tahr_vec3 half_turn = unit_vector(fraction(time * mover->turns / 2));
        pose.orientation = (tahr_quat){0, 0, half_turn.y, half_turn.x};
    }
    return pose;
}

void level_add_round(struct level *level, tahr_vec3 a, tahr_vec3 b, double radius)
{
    include_point(level, a, radius);
    include_point(level, b, radius);
    level->rounds = memory_grow(level->rounds, &level->round_capacity, level->round_count + 1, sizeof *level->rounds);
    level->rounds[level->round_count++] = (struct level_round){a, b, radius};
}

void level_add_capsule(struct level *level, tahr_vec3 center, double radius, double half_height)
{
    tahr_body_desc *body = level_add_body(level, TAHR_BODY_CAPSULE);
    tahr_vec3 half_axis = {0, 0, half_height - radius};
    body->pose.position = center;
    body->radius = radius;
    body->half_height = half_height;
    level_add_round(level, vec_sub(center, half_axis), vec_add(center, half_axis), radius);
}

void level_add_sphere(struct level *level, tahr_vec3 center, double radius)
{
    tahr_body_desc *body = level_add_body(level, TAHR_BODY_SPHERE);
    body->pose.position = center;
    body->radius = radius;
    level_add_round(level, center, center, radius);
}

void level_add_wall(struct level *level, tahr_vec3 a, tahr_vec3 b)
{
    /* As thick as a cell of the checker's grid: the nearest point to anything in the plane is in the plane. */
    const tahr_vec3 aside = {0, 0, 0.25};
    tahr_vec3 near_a = vec_add(a, aside), near_b = vec_add(b, aside), far_a = vec_sub(a, aside),
              far_b = vec_sub(b, aside);
    add_triangle(level, far_a, far_b, near_b);
    add_triangle(level, far_a, near_b, near_a);
}

void level_add_thin(struct level *level, tahr_vec3 a, tahr_vec3 b)
{
    include_point(level, a, 0);
    include_point(level, b, 0);
    level->thins = memory_grow(level->thins, &level->thin_capacity, level->thin_count + 1, sizeof *level->thins);
    level->thins[level->thin_count++] = (struct level_thin){a, b};
}

double level_height(const struct level *level, tahr_vec3 place)
{
    return level->side != NULL ? place.y : place.z;
}

void level_close(struct level *level)
{
    for (size_t i = 0; i < level->body_count; i++) {
        free((void *)level->bodies[i].vertices);
        free((void *)level->bodies[i].indices);
    }
    free(level->bodies);
    free(level->corners);
    free(level->rounds);
    free(level->movers);
    free(level->pools);
    free(level->thins);
    free(level->name);
    if (level->side != NULL) {
        side_free(level->side);
        free(level->side);
    }
    free(level->octree);
    *level = (struct level){0};
}
