/* SPDX-License-Identifier: MIT
 * scene.c: bodies of the fcl backend: taking them in, placing them, letting them go. */
#include "scene.h"

#include "../common/options.h"

#include <stdio.h>
#include <string.h>

static void *get(const tahr_host *host, size_t count, size_t size)
{
    void *p = count ? host->allocator.alloc(host->allocator.user, count * size, 64) : NULL;
    if (p) memset(p, 0, count * size);
    return p;
}

static void put(const tahr_host *host, void *p, size_t count, size_t size)
{
    if (p) host->allocator.free(host->allocator.user, p, count * size, 64);
}

static void place_body(tahr__fcl_body *b, const tahr_pose *pose)
{
    b->pose = *pose;
    b->position = pose->position;
    b->turn = m_from_quat(pose->orientation);
}

tahr__fcl_body *tahr__fcl_scene_new(tahr__fcl_scene *scene, const tahr_body_desc *desc, uint32_t id)
{
    if (scene->body_count == scene->body_capacity) return NULL;
    tahr__fcl_body *b = &scene->bodies[scene->body_count++];
    b->surface = tahr__surface_of(desc, id);
    b->surface_velocity = desc->surface_velocity;
    b->mass = desc->mass;
    b->half_extents = desc->half_extents;
    b->radius = desc->radius;
    if (desc->type == TAHR_BODY_CAPSULE) b->reach = desc->half_height - desc->radius;
    if (desc->type == TAHR_BODY_CYLINDER || desc->type == TAHR_BODY_CONE) b->reach = desc->half_height;
    b->kind = desc->type;
    b->two_sided = desc->type == TAHR_BODY_MESH && (desc->flags & TAHR_BODY_TWO_SIDED) != 0;
    place_body(b, &desc->pose);
    return b;
}

tahr_status tahr__fcl_scene_mesh(tahr__fcl_scene *scene, const tahr__fcl_geometry *g, uint32_t id, uint32_t *mesh)
{
    tahr__mesh_source source = {g->vertices, g->indices, g->vertex_count, g->triangle_count, id, 0};
    tahr_status status = tahr__mesh_build(scene->host, &source, &scene->meshes[scene->mesh_count]);

    if (status < 0) return status;
    *mesh = scene->mesh_count;
    scene->identities[scene->mesh_count++] = g->identity;
    return TAHR_OK;
}

/* FCL gets the cleaned triangles in their order, so that its names for them are ours. */
static tahr_status add_mesh(tahr__fcl_scene *scene, const tahr__mesh *mesh, const tahr_pose *pose)
{
    uint32_t *indices = get(scene->host, mesh->triangle_count, 3 * sizeof *indices);
    tahr__fcl_geometry g = {.kind = TAHR_BODY_MESH,
                            .vertices = &mesh->vertices[0].x,
                            .indices = indices,
                            .vertex_count = mesh->vertex_count,
                            .triangle_count = mesh->triangle_count};

    if (!indices) return TAHR_E_MEMORY;
    for (uint32_t i = 0; i < mesh->triangle_count; i++)
        memcpy(indices + 3 * (size_t)i, mesh->triangles[i].vertex, sizeof mesh->triangles[i].vertex);
    tahr_status status = tahr__fcl_engine_add(scene->engine, &g, pose);
    put(scene->host, indices, mesh->triangle_count, 3 * sizeof *indices);
    return status;
}

static tahr_status open_body(tahr__fcl_scene *scene, const tahr_body_desc *d, uint32_t id)
{
    tahr__fcl_body *b = tahr__fcl_scene_new(scene, d, id);
    tahr__fcl_geometry g = {.kind = d->type, .half_extents = d->half_extents, .radius = d->radius};

    if (d->type < TAHR_BODY_MESH || d->type > TAHR_BODY_HULL) {
        tahr__log_body(scene->host, id, "type: no such kind of body");
        return TAHR_E_UNSUPPORTED;
    }
    g.reach = b->reach;
    if (d->type == TAHR_BODY_HULL) {
        tahr_status opened = tahr__hull_open(scene->host, d, id, &b->hull);
        if (opened < 0) return opened;
        g.vertices = &b->hull.vertices[0].x;
        g.vertex_count = b->hull.count;
    }
    if (d->type != TAHR_BODY_MESH) return tahr__fcl_engine_add(scene->engine, &g, &d->pose);
    tahr__fcl_geometry source = {.vertices = d->vertices,
                                 .indices = d->indices,
                                 .vertex_count = d->vertex_count,
                                 .triangle_count = d->triangle_count};
    tahr_status status = tahr__fcl_scene_mesh(scene, &source, id, &b->mesh);
    return status < 0 ? status : add_mesh(scene, &scene->meshes[b->mesh], &d->pose);
}

/* Tells the user of the options about a cell. */
typedef struct teller {
    const tahr__fcl_scene *scene;
    const tahr__fcl_body *body;
    uint32_t octree, cells;
} teller;

static void tell(void *user, const tahr__fcl_part *cell)
{
    teller *t = user;
    tahr_vec3 middle, half;
    tahr_bounds box;

    t->cells++;
    if (!t->scene->desc.cell) return;
    tahr__fcl_cell_box(t->body, cell, &middle, &half);
    box.min = v_sub(middle, half);
    box.max = v_add(middle, half);
    t->scene->desc.cell(t->scene->desc.cell_user, t->octree, &box);
}

static tahr_status open_octree(tahr__fcl_scene *scene, uint32_t i)
{
    const tahr_fcl_octree *octree = &scene->desc.octrees[i];
    const uint32_t known = TAHR_BODY_SENSOR | TAHR_BODY_ONE_WAY | TAHR_BODY_NO_BASE | TAHR_BODY_NO_STEP;
    tahr_body_desc desc = {.struct_size = sizeof desc};
    tahr__fcl_geometry g;
    teller t = {scene, NULL, i, 0};
    uint32_t id = scene->body_count;

    if (octree->body) desc = *octree->body;
    desc.type = 0;
    tahr_quat *turn = &desc.pose.orientation;
    double n = turn->x * turn->x + turn->y * turn->y + turn->z * turn->z + turn->w * turn->w;
    if (n == 0) n = turn->w = 1;
    if (!(n > 1 - 1e-6 && n < 1 + 1e-6) || desc.flags & ~known || desc.walkable_rule > TAHR_WALKABLE_NEVER ||
        !(v_length(desc.pose.position) <= 1e7) || !(v_length(desc.surface_velocity) <= 1e4) ||
        desc.walkable_angle * 0 != 0) {
        tahr__log_body(scene->host, id, "octree: flags, pose, walkable rule or velocity out of range");
        return TAHR_E_ARGUMENT;
    }
    tahr_status status = tahr__fcl_octree_read(scene->engine, scene->host, octree, &g);
    if (status < 0) return status;
    tahr__fcl_body *b = tahr__fcl_scene_new(scene, &desc, id);
    b->kind = TAHR__FCL_OCTREE;
    b->radius = g.radius;
    b->surface.flags &= known;
    status = tahr__fcl_engine_add(scene->engine, &g, &desc.pose);
    if (status < 0) return status;
    t.body = b;
    tahr__fcl_engine_cells(scene->engine, id, tell, &t);
    if (t.cells > 0) return TAHR_OK;
    tahr__log_body(scene->host, id, "octree: no cell is occupied");
    return TAHR_E_GEOMETRY;
}

/* A known overlap of every kind that is there: what FCL does not find, nobody would ever meet. */
static tahr_status probe(const tahr__fcl_scene *scene)
{
    for (uint32_t i = 0; i < scene->body_count; i++) {
        const tahr__fcl_body *b = &scene->bodies[i];
        uint32_t last = b->kind == TAHR_BODY_MESH ? scene->meshes[b->mesh].triangle_count - 1 : 0;
        tahr_vec3 at[2] = {b->position, b->position};
        if (b->kind == TAHR__FCL_HALF_SPACE || b->kind == TAHR__FCL_PLANE) continue; /* without bounds: everywhere */
        if (b->kind == TAHR_BODY_MESH) {
            const tahr__mesh *mesh = &scene->meshes[b->mesh];
            at[0] = mesh->vertices[mesh->triangles[0].vertex[0]];
            at[1] = mesh->vertices[mesh->triangles[last].vertex[0]];
        }
        if (tahr__fcl_engine_finds(scene->engine, i, 0, &at[0]) &&
            tahr__fcl_engine_finds(scene->engine, i, last, &at[1]))
            continue;
        tahr__log_body(scene->host, b->surface.id, "FCL does not find it where it is: it cannot be held");
        return TAHR_E_UNSUPPORTED;
    }
    return TAHR_OK;
}

static tahr_status check_options(const tahr__fcl_scene *scene, const tahr_world_desc *desc)
{
    const tahr_fcl_desc *d = &scene->desc;
    const char *bad = d->volumes > TAHR_FCL_OBBRSS                          ? "options.volumes is no TAHR_FCL_*"
                      : d->search > TAHR_FCL_COLLIDE                        ? "options.search is no TAHR_FCL_*"
                      : d->no_cache > 1                                     ? "options.no_cache is not 0 or 1"
                      : d->cache_parts > 65536                              ? "options.cache_parts is above 65536"
                      : !(d->cache_margin >= 0 && d->cache_margin <= 1000)  ? "options.cache_margin is not 0..1000"
                      : d->octree_count > 1u << 20                          ? "options.octree_count is above 2^20"
                      : d->octree_count && !d->octrees                      ? "options.octrees is NULL"
                      : d->manager && (desc->body_count || d->octree_count) ? "options.manager allows no own bodies"
                                                                            : NULL;
    if (!bad) return TAHR_OK;
    tahr__log_error(scene->host, bad);
    return TAHR_E_ARGUMENT;
}

static tahr_status open_described(tahr__fcl_scene *scene, const tahr_world_desc *desc)
{
    tahr_status status = TAHR_OK;

    for (uint32_t i = 0; i < desc->body_count && status >= 0; i++)
        status = open_body(scene, &desc->bodies[i], i);
    scene->described = scene->body_count;
    for (uint32_t i = 0; i < scene->desc.octree_count && status >= 0; i++)
        status = open_octree(scene, i);
    if (status >= 0) status = tahr__fcl_engine_finish(scene->engine);
    return status;
}

static tahr_status get_room(tahr__fcl_scene *scene, uint32_t count)
{
    scene->bodies = get(scene->host, count, sizeof *scene->bodies);
    scene->meshes = get(scene->host, count, sizeof *scene->meshes);
    scene->identities = get(scene->host, count, sizeof *scene->identities);
    scene->body_capacity = count;
    return count == 0 || (scene->bodies && scene->meshes && scene->identities) ? TAHR_OK : TAHR_E_MEMORY;
}

tahr_status tahr__fcl_scene_open(tahr__fcl_scene *scene, const tahr_host *host, const tahr_world_desc *desc)
{
    uint32_t count = desc->body_count;

    memset(scene, 0, sizeof *scene);
    scene->host = host;
    tahr_status status = tahr__options_read(host, desc->options, &scene->desc, sizeof scene->desc);
    if (status >= 0) status = check_options(scene, desc);
    if (status < 0) return status;
    if (scene->desc.cache_parts == 0) scene->desc.cache_parts = 256;
    if (!(scene->desc.cache_margin > 0)) scene->desc.cache_margin = 0.5;
    status = tahr__fcl_engine_open(host, &scene->desc, &scene->engine);
    if (status >= 0 && scene->desc.manager) status = tahr__fcl_engine_attach(scene->engine, &count);
    if (status >= 0) status = get_room(scene, count + scene->desc.octree_count);
    if (status >= 0) status = scene->desc.manager ? tahr__fcl_scene_attach(scene) : open_described(scene, desc);
    if (status >= 0) status = probe(scene);
    if (status >= 0) status = tahr__fluids_open(&scene->fluids, host, desc);
    if (status < 0) tahr__fcl_scene_close(scene);
    return status;
}

void tahr__fcl_scene_close(tahr__fcl_scene *scene)
{
    for (uint32_t i = 0; i < scene->mesh_count; i++)
        tahr__mesh_free(scene->host, &scene->meshes[i]);
    for (uint32_t i = 0; i < scene->body_count; i++)
        tahr__hull_close(scene->host, &scene->bodies[i].hull);
    put(scene->host, scene->bodies, scene->body_capacity, sizeof *scene->bodies);
    put(scene->host, scene->meshes, scene->body_capacity, sizeof *scene->meshes);
    put(scene->host, (void *)scene->identities, scene->body_capacity, sizeof *scene->identities);
    tahr__fluids_close(&scene->fluids, scene->host);
    tahr__fcl_engine_close(scene->engine);
    memset(scene, 0, sizeof *scene);
}

static int is_finite_pose(const tahr_pose *p)
{
    tahr_quat q = p->orientation;
    return (p->position.x + p->position.y + p->position.z) * 0 == 0 && (q.x + q.y + q.z + q.w) * 0 == 0;
}

/* FCL may run out of memory while its tree is brought up to date: then the world is not fit for use any more, and says
 * so at every query. */
tahr_status tahr__fcl_scene_place(tahr__fcl_scene *scene, const tahr_body_pose *poses, uint32_t count)
{
    tahr_status status = TAHR_OK;

    for (uint32_t i = 0; i < count; i++) {
        if (poses[i].body >= scene->described) return TAHR_E_NOT_FOUND;
        if (!(scene->bodies[poses[i].body].surface.flags & TAHR_BODY_MOVABLE)) {
            tahr__log_body(scene->host, poses[i].body, "is not movable (TAHR_BODY_MOVABLE)");
            return TAHR_E_ARGUMENT;
        }
        if (!is_finite_pose(&poses[i].pose)) {
            tahr__log_body(scene->host, poses[i].body, "pose: not finite");
            return TAHR_E_ARGUMENT;
        }
    }
    for (uint32_t i = 0; i < count && status >= 0; i++) {
        place_body(&scene->bodies[poses[i].body], &poses[i].pose);
        status = tahr__fcl_engine_place(scene->engine, poses[i].body, &poses[i].pose);
    }
    if (status >= 0) status = tahr__fcl_engine_update(scene->engine);
    tahr__fluids_place(&scene->fluids, poses, count);
    scene->revision++;
    return status;
}
