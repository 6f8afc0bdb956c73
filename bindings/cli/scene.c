/* SPDX-License-Identifier: MIT
 * scene.c: the level that the options name, and a world of it. */
#include "scene.h"

#include "say.h"
#include "side.h"

#include <stdio.h>
#include <string.h>

static int load_side(struct level *level, const struct options *o)
{
    const struct side_options options = {.pixels_per_metre = o->pixels_per_metre, .separate = o->separate_tiles};
    struct side side;
    if (side_load(&side, o->level, &options) != 0) {
        return -1;
    }
    const char *base = o->level != NULL ? strrchr(o->level, '/') : NULL;
    side_build(level, &side,
               base != NULL       ? base + 1
               : o->level != NULL ? o->level
                                  : "side-scroller",
               (backend_table(o->backend)->capabilities & TAHR_CAP_PLANAR) != 0);
    return 0;
}

int scene_load(struct level *level, const struct options *o)
{
    if (o->side) {
        return load_side(level, o);
    }
    if (o->level == NULL) {
        level_playground(level);
        return 0;
    }
    return level_load(level, o->level, o->up);
}

int scene_open(const struct level *level, const struct options *o, tahr_world **world)
{
    const tahr_log log = say_log();
    tahr_world_desc desc;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = level->bodies;
    desc.body_count = (uint32_t)level->body_count;
    desc.log = &log;
    struct level_options room;
    if (level_options(level, o->backend, &room, &desc.options) != 0) {
        return -1;
    }
    tahr_status status = tahr_world_open(backend_table(o->backend), &desc, world);
    if (status < 0) {
        say_error("level '%s' does not open on backend '%s': %s", level->name, o->backend->name,
                  tahr_status_message(status));
        return -1;
    }
    return 0;
}

/* FNV-1a. */
static uint64_t mix(uint64_t hash, const void *bytes, size_t size)
{
    const uint8_t *at = bytes;
    for (size_t i = 0; i < size && at != NULL; i++) {
        hash = (hash ^ at[i]) * 1099511628211u;
    }
    return hash;
}

static uint64_t mix_body(uint64_t hash, const tahr_body_desc *b)
{
    const uint32_t words[] = {b->type,         b->flags,          b->mask,    b->walkable_rule, b->surface,
                              b->vertex_count, b->triangle_count, b->columns, b->rows};
    const double reals[] = {b->walkable_angle, b->mass, b->fluid_friction, b->radius, b->half_height};
    hash = mix(hash, words, sizeof words);
    hash = mix(hash, reals, sizeof reals);
    hash = mix(hash, &b->pose, sizeof b->pose);
    hash = mix(hash, &b->surface_velocity, sizeof b->surface_velocity);
    hash = mix(hash, &b->half_extents, sizeof b->half_extents);
    hash = mix(hash, b->vertices, sizeof *b->vertices * 3 * b->vertex_count);
    hash = mix(hash, b->indices, sizeof *b->indices * 3 * b->triangle_count);
    return mix(hash, b->heights, sizeof *b->heights * b->columns * b->rows);
}

uint64_t scene_hash(const struct level *level)
{
    uint64_t hash = 14695981039346656037u;
    for (size_t i = 0; i < level->body_count; i++) {
        hash = mix_body(hash, &level->bodies[i]);
    }
    FILE *file = level->octree != NULL ? fopen(level->octree, "rb") : NULL; /* its voxels are in the file alone */
    if (file != NULL) {
        char bytes[4096];
        for (size_t got = 0; (got = fread(bytes, 1, sizeof bytes, file)) > 0;) {
            hash = mix(hash, bytes, got);
        }
        fclose(file);
    }
    return hash;
}
