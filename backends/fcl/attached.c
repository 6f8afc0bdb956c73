/* SPDX-License-Identifier: MIT
 * attached.c: bodies from the objects of a user's manager: who they are the user says, what they are FCL says. */
#include "scene.h"

#include "../common/options.h"
#include "../common/room.h"

#include <stdio.h>

static tahr_status complain(const tahr__fcl_scene *scene, uint32_t i, const char *what, tahr_status status)
{
    char text[160];

    snprintf(text, sizeof text, "manager's object %u: %s", i, what);
    tahr__log_error(scene->scene.host, text);
    return status;
}

/* Flags that mean something for a body that the core does not know. */
static int bad_desc(const tahr_body_desc *d)
{
    const uint32_t known = TAHR_BODY_SENSOR | TAHR_BODY_TWO_SIDED | TAHR_BODY_ONE_WAY | TAHR_BODY_NO_BASE |
                           TAHR_BODY_NO_STEP | TAHR_BODY_CHARACTER;
    return (d->flags & ~known) != 0 || d->walkable_rule > TAHR_WALKABLE_NEVER || d->walkable_angle * 0 != 0 ||
           !(d->mass >= 0 && d->mass <= 1e12) || !(v_length(d->surface_velocity) <= 1e4);
}

/* Where the cleaned mesh has the triangles of the model. */
static tahr_status adopt_mesh(tahr__fcl_scene *scene, uint32_t i, const tahr__fcl_geometry *g, const tahr__mesh *mesh)
{
    const tahr_host *host = scene->scene.host;
    uint32_t *order = tahr__room_get(host, g->triangle_count, sizeof *order);

    if (!order) return TAHR_E_MEMORY;
    memset(order, 0xff, g->triangle_count * sizeof *order);
    for (uint32_t k = 0; k < mesh->triangle_count; k++)
        order[tahr__triangle_source(&mesh->triangles[k])] = k;
    tahr_status status = tahr__fcl_engine_adopt(scene->engine, i, g, order);
    tahr__room_put(host, order, g->triangle_count, sizeof *order);
    return status;
}

/* Objects that share a geometry share the mesh. */
static tahr_status take_mesh(tahr__fcl_scene *scene, uint32_t i, const tahr__fcl_geometry *g, tahr__scene_body *b)
{
    const tahr__mesh_source source = {g->vertices, g->indices, g->vertex_count, g->triangle_count, b->surface.id, 0};
    tahr_status status = TAHR_OK;
    uint32_t k = 0;

    while (k < scene->scene.mesh_count && scene->identities[k] != g->identity)
        k++;
    scene->identities[k] = g->identity;
    b->mesh = k < scene->scene.mesh_count ? &scene->scene.meshes[k] : tahr__scene_mesh(&scene->scene, &source, &status);
    return status < 0 ? status : adopt_mesh(scene, i, g, b->mesh);
}

static tahr_status attach(tahr__fcl_scene *scene, uint32_t i)
{
    tahr_body_desc desc = {.struct_size = sizeof desc, .mask = 0xFFFFFFFFu, .pose.orientation.w = 1};
    tahr__fcl_geometry g;
    const void *object;
    char text[96];
    uint32_t id = i;

    tahr_status status = tahr__fcl_engine_object(scene->engine, i, &object, &g);
    if (status < 0) return status;
    desc.flags = g.two_sided ? (uint32_t)TAHR_BODY_TWO_SIDED : 0u;
    if (scene->desc.object) status = scene->desc.object(scene->desc.user, object, &id, &desc);
    if (status == TAHR_E_NOT_FOUND) return TAHR_OK;
    if (status < 0) return complain(scene, i, "options.object refused it", status);
    if (id == TAHR_NO_BODY || tahr__scene_find(&scene->scene, id))
        return complain(scene, i, "its id is another's", TAHR_E_ARGUMENT);
    if (bad_desc(&desc)) return complain(scene, i, "flags, rule, mass or velocity out of range", TAHR_E_ARGUMENT);
    if (g.kind == 0) {
        snprintf(text, sizeof text, "%.40s cannot be held, or not of that size", g.name);
        return complain(scene, i, text, TAHR_E_UNSUPPORTED);
    }
    desc.type = 0;
    tahr__scene_body *b = tahr__scene_add(&scene->scene, &desc, id);
    b->kind = g.kind;
    b->half_extents = g.half_extents;
    b->radius = g.radius;
    b->reach = g.reach;
    b->two_sided = g.kind == TAHR_BODY_MESH ? (desc.flags & TAHR_BODY_TWO_SIDED) != 0 : g.two_sided;
    return g.kind == TAHR_BODY_MESH ? take_mesh(scene, i, &g, b) : tahr__fcl_engine_adopt(scene->engine, i, &g, NULL);
}

tahr_status tahr__fcl_scene_attach(tahr__fcl_scene *scene)
{
    uint32_t count = scene->scene.capacity;
    tahr_status status = TAHR_OK;

    scene->identities = tahr__room_get(scene->scene.host, count, sizeof *scene->identities);
    if (count > 0 && !scene->identities) return TAHR_E_MEMORY;
    for (uint32_t i = 0; i < count && status >= 0; i++)
        status = attach(scene, i);
    return status;
}
