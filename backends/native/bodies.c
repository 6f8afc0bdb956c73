/* SPDX-License-Identifier: MIT
 * bodies.c: taking over the bodies of a scene, placing the movable ones anew. */
#include "scene.h"

#include <stdio.h>
#include <string.h>

#define COORDINATE_LIMIT 1e7

static int in_range(double x)
{
    return x >= -COORDINATE_LIMIT && x <= COORDINATE_LIMIT;
}

/* Says what is wrong with a pose, or NULL. */
static const char *bad_pose(const tahr_pose *pose)
{
    const tahr_vec3 *p = &pose->position;
    const tahr_quat *q = &pose->orientation;
    double length2 = q->x * q->x + q->y * q->y + q->z * q->z + q->w * q->w;
    /* Unit within a millionth, or all zero for "identity". */
    int unit = (length2 > 1 - 1e-6 && length2 < 1 + 1e-6) || (q->x == 0 && q->y == 0 && q->z == 0 && q->w == 0);
    if (!in_range(p->x) || !in_range(p->y) || !in_range(p->z)) {
        return "pose.position is not finite within 1e7 m";
    }
    return unit ? NULL : "pose.orientation is not a unit quaternion";
}

static tahr_status refuse(const tahr__native *world, uint32_t body, const char *field, double value)
{
    char text[128];
    snprintf(text, sizeof text, "%s is %g", field, value);
    tahr__log_body(world->host, body, text);
    return TAHR_E_ARGUMENT;
}

static int is_left_out(uint32_t type)
{
    return type == TAHR_BODY_CYLINDER || type == TAHR_BODY_CONE || type == TAHR_BODY_ELLIPSOID;
}

static tahr_status check(const tahr__native *world, uint32_t id, const tahr_body_desc *d)
{
    const tahr_vec3 *h = &d->half_extents;
    if (d->type < TAHR_BODY_MESH || d->type > TAHR_BODY_HEIGHTS || is_left_out(d->type))
        return refuse(world, id, "type", d->type);
    if (d->flags >= TAHR_BODY_ONE_WAY << 1) return refuse(world, id, "flags", d->flags);
    if (d->walkable_rule > TAHR_WALKABLE_NEVER) return refuse(world, id, "walkable_rule", d->walkable_rule);
    const char *bad = bad_pose(&d->pose);
    if (bad) {
        tahr__log_body(world->host, id, bad);
        return TAHR_E_ARGUMENT;
    }
    if (d->type == TAHR_BODY_BOX) {
        if (!(h->x > 0 && in_range(h->x))) return refuse(world, id, "half_extents.x", h->x);
        if (!(h->y > 0 && in_range(h->y))) return refuse(world, id, "half_extents.y", h->y);
        if (!(h->z > 0 && in_range(h->z))) return refuse(world, id, "half_extents.z", h->z);
    } else if (d->type == TAHR_BODY_SPHERE || d->type == TAHR_BODY_CAPSULE) {
        if (!(d->radius > 0 && in_range(d->radius))) return refuse(world, id, "radius", d->radius);
        if (d->type == TAHR_BODY_CAPSULE && !(d->half_height >= d->radius && in_range(d->half_height))) {
            return refuse(world, id, "half_height (at least the radius)", d->half_height);
        }
    }
    return TAHR_OK;
}

/* A box is a mesh of 12 triangles that share 8 corners, two a face, so that everything about edges holds for it too. */
static tahr_status build_box(const tahr__native *world, uint32_t id, tahr_vec3 half, tahr__mesh *mesh)
{
    static const uint32_t faces[12][3] = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                                          {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    double vertices[8][3];
    for (uint32_t i = 0; i < 8; i++) {
        vertices[i][0] = i & 1 ? half.x : -half.x;
        vertices[i][1] = i & 2 ? half.y : -half.y;
        vertices[i][2] = i & 4 ? half.z : -half.z;
    }
    tahr__mesh_source source = {&vertices[0][0], &faces[0][0], 8, 12, id, 0};
    tahr_status status = tahr__mesh_build(world->host, &source, mesh);
    for (uint32_t i = 0; status == TAHR_OK && i < mesh->triangle_count; i++) {
        tahr__triangle *t = &mesh->triangles[i];
        t->source = (t->source & TAHR__MESH_THIN) | tahr__triangle_source(t) / 2;
    }
    return status;
}

static void put_pose(tahr__body *body, const tahr_pose *pose)
{
    body->position = pose->position;
    body->turn = m_from_quat(pose->orientation);
    tahr__mat one = m_identity();
    body->turned = memcmp(&body->turn, &one, sizeof one) != 0;
    tahr_vec3 half = v_make(body->radius, body->radius, body->radius), middle = v_make(0, 0, 0);
    if (body->type != TAHR_BODY_SPHERE && body->type != TAHR_BODY_CAPSULE) {
        half = v_scale(v_sub(body->mesh.bounds.max, body->mesh.bounds.min), 0.5);
        middle = v_add(body->mesh.bounds.min, half);
    } else {
        half.z += body->reach;
    }
    if (body->turned) {
        half = v_make(v_dot(v_abs(body->turn.row[0]), half), v_dot(v_abs(body->turn.row[1]), half),
                      v_dot(v_abs(body->turn.row[2]), half));
        middle = m_apply(&body->turn, middle);
    }
    middle = v_add(middle, body->position);
    tahr_vec3 slack = v_make(TAHR__SLACK, TAHR__SLACK, TAHR__SLACK);
    body->bounds.min = v_sub(v_sub(middle, half), slack);
    body->bounds.max = v_add(v_add(middle, half), slack);
}

/* A mesh that is a field of heights takes its path: a twelfth of the memory, and no tree. */
static tahr_status open_mesh(const tahr__native *world, const tahr__mesh_source *source, tahr__body *body)
{
    tahr_status status = tahr__mesh_check(world->host, source);
    if (status == TAHR_OK && !world->no_fields) {
        status = tahr__heights_of_mesh(world->host, source, &body->heights, &body->mesh.bounds);
        if (status != TAHR_E_NOT_FOUND) {
            body->type = TAHR_BODY_HEIGHTS;
            return status;
        }
        status = TAHR_OK;
    }
    return status == TAHR_OK ? tahr__mesh_build(world->host, source, &body->mesh) : status;
}

static tahr_status open_body(tahr__native *world, uint32_t id, const tahr_body_desc *d)
{
    tahr__body *body = &world->bodies[id];
    tahr_status status = check(world, id, d);
    if (status != TAHR_OK) return status;
    body->type = d->type;
    body->flags = d->flags;
    body->mask = d->mask ? d->mask : 0xFFFFFFFFu;
    body->walkable_rule = d->walkable_rule;
    body->walkable_angle = d->walkable_angle;
    body->surface = d->surface;
    if (d->type == TAHR_BODY_MESH) {
        tahr__mesh_source source = {d->vertices, d->indices, d->vertex_count, d->triangle_count, id, 0};
        status = open_mesh(world, &source, body);
    } else if (d->type == TAHR_BODY_BOX) {
        body->half_extents = d->half_extents;
        status = build_box(world, id, d->half_extents, &body->mesh);
    } else if (d->type == TAHR_BODY_HULL) {
        status = tahr__hull_build(world->host, d, id, &body->mesh);
        body->half_extents = v_scale(v_sub(body->mesh.bounds.max, body->mesh.bounds.min), 0.5);
    } else if (d->type == TAHR_BODY_HEIGHTS) {
        status = tahr__heights_open(world->host, d, id, &body->heights, &body->mesh.bounds);
    } else {
        body->radius = d->radius;
        body->reach = d->type == TAHR_BODY_CAPSULE ? d->half_height - d->radius : 0;
    }
    if (status == TAHR_OK) put_pose(body, &d->pose);
    return status;
}

static tahr_status open_group(tahr__native *world, tahr__group *group, uint32_t movable)
{
    const tahr_allocator *a = &world->host->allocator;
    tahr_vec3 centre = v_make(0, 0, 0);
    uint32_t *ids, k = 0;
    for (uint32_t i = 0; i < world->body_count; i++)
        group->count += (world->bodies[i].flags & TAHR_BODY_MOVABLE) == movable;
    if (group->count == 0) return TAHR_OK;
    group->order = a->alloc(a->user, group->count * sizeof *group->order, 64);
    group->boxes = a->alloc(a->user, group->count * sizeof *group->boxes, 64);
    ids = a->alloc(a->user, group->count * sizeof *ids, 64);
    tahr_status status = group->order && group->boxes && ids ? TAHR_OK : TAHR_E_MEMORY;
    for (uint32_t i = 0; status == TAHR_OK && i < world->body_count; i++) {
        const tahr__body *body = &world->bodies[i];
        if ((body->flags & TAHR_BODY_MOVABLE) != movable) continue;
        /* Movable bodies may go anywhere; static ones get their precision near the first of them. */
        if (k == 0 && !movable) centre = v_scale(v_add(body->bounds.min, body->bounds.max), 0.5);
        group->boxes[k] = tahr__bvh_box_make(&body->bounds, centre);
        ids[k++] = i;
    }
    if (status == TAHR_OK) status = tahr__bvh_build(world->host, group->boxes, group->order, k, centre, &group->tree);
    for (uint32_t i = 0; status == TAHR_OK && i < k; i++)
        group->order[i] = ids[group->order[i]];
    if (ids) a->free(a->user, ids, group->count * sizeof *ids, 64);
    return status;
}

static void close_group(tahr__native *world, tahr__group *group)
{
    const tahr_allocator *a = &world->host->allocator;
    if (group->order) a->free(a->user, group->order, group->count * sizeof *group->order, 64);
    if (group->boxes) a->free(a->user, group->boxes, group->count * sizeof *group->boxes, 64);
    tahr__bvh_free(world->host, &group->tree);
}

tahr_status tahr__bodies_open(tahr__native *world, const tahr_world_desc *desc)
{
    const tahr_allocator *a = &world->host->allocator;
    tahr_status status = TAHR_OK;
    if (desc->body_count == 0) return TAHR_OK;
    if (!desc->bodies) return TAHR_E_NULL;
    world->bodies = a->alloc(a->user, desc->body_count * sizeof *world->bodies, 64);
    if (!world->bodies) return TAHR_E_MEMORY;
    memset(world->bodies, 0, desc->body_count * sizeof *world->bodies);
    world->body_count = desc->body_count;
    for (uint32_t i = 0; status == TAHR_OK && i < desc->body_count; i++)
        status = open_body(world, i, &desc->bodies[i]);
    if (status == TAHR_OK) status = open_group(world, &world->fixed, 0);
    if (status == TAHR_OK) status = open_group(world, &world->movable, TAHR_BODY_MOVABLE);
    if (status == TAHR_OK) status = tahr__fluids_open(&world->fluids, world->host, desc);
    return status;
}

void tahr__bodies_close(tahr__native *world)
{
    const tahr_allocator *a = &world->host->allocator;
    for (uint32_t i = 0; i < world->body_count; i++) {
        tahr__mesh_free(world->host, &world->bodies[i].mesh);
        tahr__heights_close(world->host, &world->bodies[i].heights);
    }
    close_group(world, &world->fixed);
    close_group(world, &world->movable);
    tahr__fluids_close(&world->fluids, world->host);
    if (world->bodies) a->free(a->user, world->bodies, world->body_count * sizeof *world->bodies, 64);
}

tahr_status tahr__bodies_place(tahr__native *world, const tahr_body_pose *poses, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        uint32_t id = poses[i].body;
        if (id >= world->body_count) {
            tahr__log_body(world->host, id, "no such body");
            return TAHR_E_NOT_FOUND;
        }
        int movable = (world->bodies[id].flags & TAHR_BODY_MOVABLE) != 0;
        const char *bad = movable ? bad_pose(&poses[i].pose) : "is not movable (TAHR_BODY_MOVABLE)";
        if (bad) {
            tahr__log_body(world->host, id, bad);
            return TAHR_E_ARGUMENT;
        }
    }
    world->placed++;
    for (uint32_t i = 0; i < count; i++)
        put_pose(&world->bodies[poses[i].body], &poses[i].pose);
    tahr__fluids_place(&world->fluids, poses, count);
    tahr__group *group = &world->movable;
    world->revision += count == 0; /* tahr_world_touch */
    if (count == 0 || group->count == 0) return TAHR_OK;
    for (uint32_t i = 0; i < group->count; i++) {
        group->boxes[i] = tahr__bvh_box_make(&world->bodies[group->order[i]].bounds, group->tree.centre);
    }
    tahr__bvh_refit(&group->tree, group->boxes);
    return TAHR_OK;
}
