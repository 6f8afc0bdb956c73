/* SPDX-License-Identifier: MIT
 * scene.c: bodies of the ccd backend: taking them in, placing them, letting them go. */
#include "scene.h"

static tahr_vec3 half_size(const tahr__ccd_body *b)
{
    tahr_vec3 axis = v_abs(v_make(b->turn.row[0].z, b->turn.row[1].z, b->turn.row[2].z));
    tahr_vec3 h = b->half_extents;

    if (b->type == TAHR_BODY_MESH) h = v_scale(v_sub(b->mesh.bounds.max, b->mesh.bounds.min), 0.5);
    if (b->type == TAHR_BODY_MESH || b->type == TAHR_BODY_BOX) {
        double x = v_dot(v_abs(b->turn.row[0]), h), y = v_dot(v_abs(b->turn.row[1]), h);
        return v_make(x, y, v_dot(v_abs(b->turn.row[2]), h));
    }
    return v_mad(v_make(b->radius, b->radius, b->radius), axis, b->reach);
}

/* World bounds, grown by a relative 1e-12: the rounding of a turned corner. */
static void place_body(tahr__ccd_body *b, const tahr_pose *pose)
{
    tahr_vec3 centre = v_make(0, 0, 0), half, grow;

    b->position = pose->position;
    b->turn = m_from_quat(pose->orientation);
    if (b->type == TAHR_BODY_MESH) centre = v_scale(v_add(b->mesh.bounds.min, b->mesh.bounds.max), 0.5);
    centre = v_add(b->position, m_apply(&b->turn, centre));
    half = half_size(b);
    grow = v_scale(v_add(v_abs(centre), half), 1e-12);
    half = v_add(half, grow);
    b->bounds.min = v_sub(centre, half);
    b->bounds.max = v_add(centre, half);
}

static tahr_status open_body(tahr__ccd_scene *scene, const tahr_body_desc *d, uint32_t id)
{
    tahr__ccd_body *b = &scene->bodies[id];
    tahr_status status = TAHR_OK;

    b->type = d->type;
    b->flags = d->flags;
    b->mask = d->mask ? d->mask : 0xFFFFFFFFu;
    b->walkable_rule = d->walkable_rule;
    b->walkable_angle = d->walkable_angle;
    b->surface = d->surface;
    b->id = id;
    b->half_extents = d->half_extents;
    b->radius = d->radius;
    b->reach = d->type == TAHR_BODY_CAPSULE ? d->half_height - d->radius : 0;
    if (d->type < TAHR_BODY_MESH || d->type > TAHR_BODY_CAPSULE) {
        tahr__log_body(scene->host, id, "type: no such kind of body");
        return TAHR_E_UNSUPPORTED;
    }
    if (d->type == TAHR_BODY_MESH) {
        tahr__mesh_source source = {d->vertices, d->indices, d->vertex_count, d->triangle_count, id, 0};
        status = tahr__mesh_build(scene->host, &source, &b->mesh);
        if (status < 0) b->type = 0; /* nothing to free */
    }
    place_body(b, &d->pose);
    return status;
}

tahr_status tahr__ccd_scene_open(tahr__ccd_scene *scene, const tahr_host *host, const tahr_world_desc *desc)
{
    size_t size = desc->body_count * sizeof *scene->bodies;
    tahr_status status = TAHR_OK;

    scene->host = host;
    scene->bodies = NULL;
    scene->body_count = 0;
    scene->fluids = (tahr__fluids){NULL, 0};
    if (desc->body_count == 0) return TAHR_OK;
    scene->bodies = host->allocator.alloc(host->allocator.user, size, 64);
    if (!scene->bodies) return TAHR_E_MEMORY;
    scene->body_count = desc->body_count;
    for (uint32_t i = 0; i < desc->body_count; i++)
        scene->bodies[i] = (tahr__ccd_body){0};
    for (uint32_t i = 0; i < desc->body_count && status >= 0; i++)
        status = open_body(scene, &desc->bodies[i], i);
    if (status >= 0) status = tahr__fluids_open(&scene->fluids, host, desc);
    if (status < 0) tahr__ccd_scene_close(scene);
    return status;
}

void tahr__ccd_scene_close(tahr__ccd_scene *scene)
{
    const tahr_allocator *a = &scene->host->allocator;

    for (uint32_t i = 0; i < scene->body_count; i++) {
        if (scene->bodies[i].type == TAHR_BODY_MESH) tahr__mesh_free(scene->host, &scene->bodies[i].mesh);
    }
    if (scene->bodies) a->free(a->user, scene->bodies, scene->body_count * sizeof *scene->bodies, 64);
    tahr__fluids_close(&scene->fluids, scene->host);
    scene->bodies = NULL;
    scene->body_count = 0;
}

static int is_finite_pose(const tahr_pose *p)
{
    double sum = (p->position.x + p->position.y + p->position.z) * 0;
    tahr_quat q = p->orientation;
    return sum == 0 && (q.x + q.y + q.z + q.w) * 0 == 0;
}

tahr_status tahr__ccd_scene_place(tahr__ccd_scene *scene, const tahr_body_pose *poses, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        if (poses[i].body >= scene->body_count) return TAHR_E_NOT_FOUND;
        if (!(scene->bodies[poses[i].body].flags & TAHR_BODY_MOVABLE)) {
            tahr__log_body(scene->host, poses[i].body, "is not movable (TAHR_BODY_MOVABLE)");
            return TAHR_E_ARGUMENT;
        }
        if (!is_finite_pose(&poses[i].pose)) {
            tahr__log_body(scene->host, poses[i].body, "pose: not finite");
            return TAHR_E_ARGUMENT;
        }
    }
    for (uint32_t i = 0; i < count; i++)
        place_body(&scene->bodies[poses[i].body], &poses[i].pose);
    tahr__fluids_place(&scene->fluids, poses, count);
    return TAHR_OK;
}
