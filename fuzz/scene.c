/* SPDX-License-Identifier: MIT
 * scene.c: see scene.h. */
#include "scene.h"

#include <math.h>
#include <string.h>
#include <tahr/backend.h>

/* A coordinate: a multiple of half a metre within 4 m, every second time exactly so, else off by one ulp up to 1 mm. */
static double coordinate(bytes *b)
{
    static const double off[] = {0, 0, 0, 0, 2.220446049250313e-16, -2.220446049250313e-16, 1e-9, -1e-6, 1e-3, -1e-3};
    uint32_t where = bytes_below(b, 17), how = bytes_u8(b);
    double x = 0.5 * ((double)where - 8);
    return how < 128 ? x : x * (1 + off[how % 10]) + (how % 10 > 5 ? off[how % 10] : 0);
}

static tahr_vec3 lattice(bytes *b)
{
    tahr_vec3 p;
    p.x = coordinate(b);
    p.y = coordinate(b);
    p.z = coordinate(b);
    return p;
}

tahr_vec3 scene_point(const scene *s, bytes *b)
{
    tahr_vec3 p = lattice(b);
    return (tahr_vec3){s->origin.x + p.x * s->scale, s->origin.y + p.y * s->scale, s->origin.z + p.z * s->scale};
}

static double size_of(bytes *b)
{
    static const double sizes[] = {0.5, 1, 2, 4, 0.25, 0.05, 1e-3, 8};
    return sizes[bytes_below(b, 8)];
}

static tahr_quat turn_of(bytes *b)
{
    static const tahr_quat turns[] = {
        {0, 0, 0, 1},
        {0, 0, 0, 1},
        {0, 0, 0.70710678118654752, 0.70710678118654752},
        {0, 0.70710678118654752, 0, 0.70710678118654752},
        {0, 0.38268343236508977, 0, 0.92387953251128676},
        {0.5, 0.5, 0.5, 0.5},
        {0.18257418583505536, 0.36514837167011072, 0.54772255750516607, 0.73029674334022143},
        {0, 0.17364817766693033, 0, 0.98480775301220802}};
    return turns[bytes_below(b, 8)];
}

static void read_flags(tahr_body_desc *body, bytes *b, uint32_t allowed)
{
    uint32_t how = bytes_u8(b);
    if ((allowed & SCENE_SENSORS) && how % 8 == 1) body->flags |= TAHR_BODY_SENSOR;
    if ((allowed & SCENE_MOVERS) && how % 8 == 2) body->flags |= TAHR_BODY_MOVABLE;
    if ((allowed & SCENE_FLUIDS) && how % 16 == 3 && body->type != TAHR_BODY_MESH) body->flags |= TAHR_BODY_FLUID;
    if (how % 16 == 4) body->surface_velocity = (tahr_vec3){how / 64.0 - 1, 0.5, 0};
    if (how % 16 == 5) body->flags |= TAHR_BODY_NO_STEP | TAHR_BODY_NO_BASE;
    if (how % 16 == 6) body->walkable_rule = 1 + how / 16 % 3;
    body->walkable_angle = 0.3;
}

static void read_solid(scene *s, bytes *b, uint32_t allowed)
{
    tahr_body_desc *body = &s->bodies[s->body_count];
    uint32_t round = bytes_below(b, 6) / 4, which = 1 + bytes_below(b, 2), type = TAHR_BODY_BOX + round * which;
    tahr_body_desc_init(body, sizeof *body, type);
    body->pose.position = scene_point(s, b);
    body->half_extents.x = size_of(b) * s->scale;
    body->half_extents.y = size_of(b) * s->scale;
    body->half_extents.z = size_of(b) * s->scale;
    body->radius = body->half_extents.x;
    body->half_height = fmax(body->half_extents.z, body->radius);
    body->pose.orientation = turn_of(b);
    read_flags(body, b, allowed);
    s->movers += (body->flags & TAHR_BODY_MOVABLE) != 0;
    s->body_count++;
}

static void read_mesh(scene *s, bytes *b, uint32_t allowed)
{
    tahr_body_desc *body = &s->bodies[s->body_count];
    uint32_t triangles = bytes_below(b, SCENE_TRIANGLES + 1);
    uint32_t corners = 3 + bytes_below(b, 60);
    if (triangles == 0) return;
    tahr_body_desc_init(body, sizeof *body, TAHR_BODY_MESH);
    for (uint32_t i = 0; i < corners; i++) {
        tahr_vec3 p = lattice(b);
        s->vertices[3 * i] = p.x * s->scale;
        s->vertices[3 * i + 1] = p.y * s->scale;
        s->vertices[3 * i + 2] = p.z * s->scale;
    }
    for (uint32_t i = 0; i < 3 * triangles; i++)
        s->indices[i] = bytes_u8(b) % corners;
    body->pose.position = s->origin;
    body->vertices = s->vertices;
    body->indices = s->indices;
    body->vertex_count = corners;
    body->triangle_count = triangles;
    uint32_t how = bytes_u8(b);
    read_flags(body, b, allowed & ~(uint32_t)SCENE_MOVERS);
    if ((allowed & SCENE_TWO_SIDED) || how % 2) body->flags |= TAHR_BODY_TWO_SIDED;
    s->body_count++;
}

void scene_read(scene *s, bytes *b, uint32_t allowed)
{
    static const double offsets[] = {0, 0, 0, 0, 4, 1000, -1e5, 1e6, 9e6};
    memset(s, 0, sizeof *s);
    uint32_t one = bytes_below(b, 4);
    int exponent = one ? 0 : (int)bytes_below(b, 41) - 20;
    s->scale = ldexp(1, allowed & SCENE_NEAR ? 0 : exponent);
    s->origin.x = offsets[bytes_below(b, 9)];
    s->origin.y = offsets[bytes_below(b, 9)];
    if (allowed & SCENE_NEAR) s->origin = (tahr_vec3){0, 0, 0};
    uint32_t how = bytes_u8(b), solids = bytes_below(b, 13);
    if (how % 4) { /* most scenes have a floor */
        tahr_body_desc *body = &s->bodies[s->body_count++];
        tahr_body_desc_init(body, sizeof *body, TAHR_BODY_BOX);
        body->half_extents = (tahr_vec3){8 * s->scale, 8 * s->scale, s->scale};
        body->pose.position = (tahr_vec3){s->origin.x, s->origin.y, s->origin.z - s->scale};
    }
    for (uint32_t i = 0; i < solids; i++)
        read_solid(s, b, allowed);
    if (how % 8 > 2) read_mesh(s, b, allowed);
}

tahr_world *scene_open(const scene *s, const tahr_backend *backend, const void *options)
{
    tahr_world *world = NULL;
    tahr_world_desc desc;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = s->bodies;
    desc.body_count = s->body_count;
    desc.options = options;
    return tahr_world_open(backend, &desc, &world) == TAHR_OK ? world : NULL;
}

static void mix_methods(bytes *b, tahr_config *c)
{
    uint32_t how = bytes_u8(b), more = bytes_u8(b);
    c->integrator = 1 + how % 2;
    c->slide_solver = 1 + how / 2 % 2;
    c->separation = 1 + how / 4 % 2;
    c->floor_probe = 1 + how / 8 % 2;
    c->depenetration = 1 + how / 16 % 2;
    c->step_rule = 1 + how / 32 % 2;
    c->flat_base = how / 64 % 2;
    c->keep_level_speed = how / 128;
    c->cached_floor = more % 2;
    c->walk_off_ledges = more / 2 % 2;
    c->max_slides = 1 + more / 4 % 8;
    c->sleep = more / 32 % 2;
}

static void mix_feel(bytes *b, tahr_config *c)
{
    uint32_t how = bytes_u8(b);
    c->coyote_time = how & 1 ? 0.1 : 0;
    c->jump_buffer = how & 2 ? 0.1 : 0;
    c->jump_release_gravity = how & 4 ? 2 : 1;
    c->wall_slide_speed = how & 8 ? 1 : 0;
    c->wall_jump_speed = how & 16 ? 4 : 0;
    c->ledge_grab = how & 32 ? 0.3 : 0;
    c->corner_correction = how & 64 ? 0.2 : 0;
    c->air_jumps = how & 128 ? 2 : 0;
}

int scene_config(const scene *s, bytes *b, tahr_config *config)
{
    uint32_t how = bytes_u8(b);
    tahr_config_init(config, sizeof *config, how % 4 == 3 ? TAHR_PRESET_UNREAL : TAHR_PRESET_PRECISE);
    if (how / 4 % 4 == 1) mix_methods(b, config);
    if (how / 16 % 4 == 1) mix_feel(b, config);
    if (how / 64 == 1) config->shape = (tahr_shape){TAHR_SHAPE_SPHERE, 0, 0.4, 0.4, 0, 0};
    if (how / 64 == 2) config->shape = (tahr_shape){TAHR_SHAPE_BOX, 0, 0, 0.9, 0.3, 0.3};
    if (config->shape.type == TAHR_SHAPE_SPHERE) config->crouched_half_height = 0.4;
    if (s->scale != 1 && tahr_config_scale(config, s->scale) < 0) return 0;
    return tahr_config_check(config, NULL) == TAHR_OK;
}
