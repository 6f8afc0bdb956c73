/* SPDX-License-Identifier: MIT
 * opened.c: see opened.h. */
#include "opened.h"

#include "target.h"

#include <math.h>
#include <tahr/backend.h>

/* What is in the arrays of a body is what it says that it holds. */
static void check_body(const tahr_body_desc *b, unsigned number)
{
    for (uint32_t k = 0; b->type == TAHR_BODY_MESH && k < 3 * b->triangle_count; k++)
        FUZZ_CHECK(b->indices[k] < b->vertex_count, "body %u: index %u of %u", number, b->indices[k], b->vertex_count);
    for (uint32_t k = 0; b->vertices && k < 3 * b->vertex_count; k++)
        FUZZ_CHECK(isfinite(b->vertices[k]), "body %u: vertex %u", number, k / 3);
}

tahr_world *opened(const struct level *level, const tahr_backend *backend, const void *options)
{
    tahr_world_desc desc;
    tahr_world *world = NULL;
    for (size_t i = 0; i < level->body_count; i++)
        check_body(&level->bodies[i], (unsigned)i);
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = level->bodies;
    desc.body_count = (uint32_t)level->body_count;
    desc.options = options;
    return tahr_world_open(backend, &desc, &world) == TAHR_OK ? world : NULL;
}
