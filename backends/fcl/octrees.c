/* SPDX-License-Identifier: MIT
 * octrees.c: the octrees of the options, whose bodies the core does not know. */
#include "scene.h"

/* Tells the user of the options about a cell. */
typedef struct teller {
    const tahr__fcl_scene *scene;
    const tahr__scene_body *body;
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
    uint32_t id = scene->scene.body_count;

    if (octree->body) desc = *octree->body;
    desc.type = 0;
    tahr_quat *turn = &desc.pose.orientation;
    double n = turn->x * turn->x + turn->y * turn->y + turn->z * turn->z + turn->w * turn->w;
    if (n == 0) n = turn->w = 1;
    if (!(n > 1 - 1e-6 && n < 1 + 1e-6) || desc.flags & ~known || desc.walkable_rule > TAHR_WALKABLE_NEVER ||
        !(v_length(desc.pose.position) <= 1e7) || !(v_length(desc.surface_velocity) <= 1e4) ||
        desc.walkable_angle * 0 != 0) {
        tahr__log_body(scene->scene.host, id, "octree: flags, pose, walkable rule or velocity out of range");
        return TAHR_E_ARGUMENT;
    }
    tahr_status status = tahr__fcl_octree_read(scene->engine, scene->scene.host, octree, &g);
    if (status < 0) return status;
    tahr__scene_body *b = tahr__scene_add(&scene->scene, &desc, id);
    b->kind = TAHR__FCL_OCTREE;
    b->radius = g.radius;
    b->surface.flags &= known;
    status = tahr__fcl_engine_add(scene->engine, &g, &desc.pose);
    if (status < 0) return status;
    t.body = b;
    tahr__fcl_engine_cells(scene->engine, id, tell, &t);
    if (t.cells > 0) return TAHR_OK;
    tahr__log_body(scene->scene.host, id, "octree: no cell is occupied");
    return TAHR_E_GEOMETRY;
}

tahr_status tahr__fcl_scene_octrees(tahr__fcl_scene *scene)
{
    tahr_status status = TAHR_OK;

    for (uint32_t i = 0; i < scene->desc.octree_count && status >= 0; i++)
        status = open_octree(scene, i);
    return status;
}
