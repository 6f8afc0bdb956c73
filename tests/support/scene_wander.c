/* SPDX-License-Identifier: MIT
 * scene_wander.c: spawning and wandering. */
#include "scene_wander.h"

#include <math.h>

enum { SPAWN_TRIES = 400, MAX_STOREYS = 8 };

/* splitmix64 (S. Vigna) for places */
static uint32_t draw(uint64_t *seed)
{
    uint64_t z = *seed += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (uint32_t)((z ^ (z >> 31)) >> 32);
}

static double between(uint64_t *seed, double low, double high)
{
    return low + (high - low) * (double)draw(seed) / 4294967296.0;
}

tahr_bounds scene_mesh_bounds(const scene_mesh *mesh)
{
    tahr_bounds b = {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const double *v = mesh->vertices + 3 * (size_t)i;
        b.min = (tahr_vec3){fmin(b.min.x, v[0]), fmin(b.min.y, v[1]), fmin(b.min.z, v[2])};
        b.max = (tahr_vec3){fmax(b.max.x, v[0]), fmax(b.max.y, v[1]), fmax(b.max.z, v[2])};
    }
    return b;
}

static int is_free(tahr_world *world, const tahr_config *config, const tahr_state *state)
{
    tahr_contact contact;
    uint32_t count = 0;
    tahr_contact_query query = {.shape = config->shape,
                                .position = state->position,
                                .up = state->up,
                                .orientation = state->orientation,
                                .margin = config->skin,
                                .mask = config->mask,
                                .ignore_body = TAHR_NO_BODY};
    return tahr_world_contacts(world, &query, &contact, 1, &count) == TAHR_OK && count == 0;
}

static int is_planar(const tahr_config *config)
{
    return config->plane.z != 0;
}

/* The part of v along up. */
static double height(const tahr_config *config, tahr_vec3 v)
{
    return is_planar(config) ? v.y : v.z;
}

static tahr_vec3 at_height(const tahr_config *config, tahr_vec3 v, double h)
{
    return is_planar(config) ? (tahr_vec3){v.x, h, 0} : (tahr_vec3){v.x, v.y, h};
}

/* The ground of one storey under a place, the one at or below from. */
static int ground(tahr_world *world, const tahr_config *config, tahr_vec3 from, double low, tahr_hit *hit)
{
    uint32_t count = 0;
    double way = low - 1 - height(config, from);
    tahr_ray ray = {.origin = from,
                    .motion = at_height(config, (tahr_vec3){0, 0, 0}, way),
                    .mask = config->mask,
                    .ignore_body = TAHR_NO_BODY};
    return way < 0 && tahr_world_ray(world, &ray, hit, &count) == TAHR_OK && count == 1;
}

int scene_wander_spawn(tahr_world *world, const tahr_config *config, const tahr_bounds *bounds, uint64_t *seed,
                       tahr_state *state)
{
    for (int i = 0; i < SPAWN_TRIES; i++) {
        tahr_vec3 from = {between(seed, bounds->min.x, bounds->max.x), between(seed, bounds->min.y, bounds->max.y), 0};
        from = at_height(config, from, height(config, bounds->max) + 1);
        uint32_t storey = draw(seed) % MAX_STOREYS;
        for (uint32_t k = 0; k <= storey; k++) {
            tahr_hit hit;
            if (!ground(world, config, from, height(config, bounds->min), &hit)) {
                break;
            }
            double h = height(config, hit.point);
            from = at_height(config, from, h - 0.01);
            /* 0.2 m above the ground: free of it on slopes of up to 45 degrees, (1/cos 45 - 1) * 0.35 = 0.145 m */
            tahr_vec3 place = at_height(config, from, h + config->shape.half_height + 0.2);
            tahr_state_init(state, config, &place);
            if (k % 2 == storey % 2 && height(config, hit.surface_normal) > 0.71 && is_free(world, config, state)) {
                return 1;
            }
        }
    }
    return 0;
}

/* PCG32 (M. E. O'Neill, 2014, XSH-RR 64/32) with a stream per character. */
static uint32_t pcg(scene_wanderer *w)
{
    uint64_t old = w->state;
    uint32_t mixed = (uint32_t)(((old >> 18) ^ old) >> 27), turn = (uint32_t)(old >> 59);
    w->state = old * 6364136223846793005u + w->increment;
    return (mixed >> turn) | (mixed << ((32 - turn) & 31));
}

static double unit(scene_wanderer *w)
{
    return (double)pcg(w) / 4294967296.0;
}

void scene_wander_start(scene_wanderer *w, uint64_t seed, uint32_t character)
{
    *w = (scene_wanderer){.input = {.struct_size = sizeof w->input}};
    w->increment = ((uint64_t)character << 1) | 1;
    pcg(w);
    w->state += seed;
    pcg(w);
}

const tahr_input *scene_wander_next(scene_wanderer *w, double dt)
{
    w->input.jump = 0;
    if (w->time_left <= 0) {
        double angle = 6.283185307179586 * unit(w), speed = 5.0 / 6;
        w->input.move = (tahr_vec3){speed * cos(angle), speed * sin(angle), 0};
        w->time_left += 0.5 + 1.5 * unit(w);
        w->input.jump = unit(w) < 0.05;
        w->changes++;
    }
    w->time_left -= dt;
    return &w->input;
}

const tahr_input *scene_wander_next_side(scene_wanderer *w, double dt)
{
    w->input.jump = 0;
    if (w->time_left <= 0) {
        w->input.move = (tahr_vec3){unit(w) < 0.5 ? -5.0 / 6 : 5.0 / 6, 0, 0};
        w->time_left += 0.5 + 1.5 * unit(w);
        w->input.jump = unit(w) < 0.5;
        w->changes++;
    }
    w->time_left -= dt;
    return &w->input;
}
