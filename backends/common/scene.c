/* SPDX-License-Identifier: MIT
 * scene.c: bodies in space: taking them in, placing them, letting them go. */
#include "scene.h"

#include "room.h"

/* m: what is farther is an error of the caller. */
#define FARTHEST 1e8

tahr_status tahr__scene_open(tahr__scene *scene, const tahr_host *host, const tahr_world_desc *desc, uint32_t count)
{
    scene->host = host;
    scene->bodies = tahr__room_get(host, count, sizeof *scene->bodies);
    scene->meshes = tahr__room_get(host, count, sizeof *scene->meshes);
    scene->capacity = count;
    if (count > 0 && !(scene->bodies && scene->meshes)) return TAHR_E_MEMORY;
    return tahr__fluids_open(&scene->fluids, host, desc);
}

void tahr__scene_close(tahr__scene *scene)
{
    for (uint32_t i = 0; i < scene->mesh_count; i++)
        tahr__mesh_free(scene->host, &scene->meshes[i]);
    for (uint32_t i = 0; i < scene->body_count; i++)
        tahr__hull_close(scene->host, &scene->bodies[i].hull);
    tahr__room_put(scene->host, scene->bodies, scene->capacity, sizeof *scene->bodies);
    tahr__room_put(scene->host, scene->meshes, scene->capacity, sizeof *scene->meshes);
    tahr__fluids_close(&scene->fluids, scene->host);
}

static void place_body(tahr__scene_body *b, const tahr_pose *pose)
{
    b->pose = *pose;
    b->turn = m_from_quat(pose->orientation);
}

tahr__scene_body *tahr__scene_add(tahr__scene *scene, const tahr_body_desc *d, uint32_t id)
{
    if (scene->body_count == scene->capacity) return NULL;
    tahr__scene_body *b = &scene->bodies[scene->body_count++];
    b->surface = tahr__surface_of(d, id);
    b->kind = d->type;
    b->two_sided = d->type == TAHR_BODY_MESH && (d->flags & TAHR_BODY_TWO_SIDED) != 0;
    b->half_extents = d->half_extents;
    b->radius = d->radius;
    if (d->type == TAHR_BODY_CAPSULE) b->reach = d->half_height - d->radius;
    if (d->type == TAHR_BODY_CYLINDER || d->type == TAHR_BODY_CONE) b->reach = d->half_height;
    b->surface_velocity = d->surface_velocity;
    b->mass = d->mass;
    place_body(b, &d->pose);
    return b;
}

const tahr__mesh *tahr__scene_mesh(tahr__scene *scene, const tahr__mesh_source *source, tahr_status *status)
{
    *status = tahr__mesh_build(scene->host, source, &scene->meshes[scene->mesh_count]);
    return *status < 0 ? NULL : &scene->meshes[scene->mesh_count++];
}

tahr_status tahr__scene_describe(tahr__scene *scene, const tahr_body_desc *d, uint32_t id)
{
    tahr__scene_body *b = tahr__scene_add(scene, d, id);
    tahr_status status = TAHR_OK;

    if (d->type < TAHR_BODY_MESH || d->type > TAHR_BODY_HULL) {
        tahr__log_body(scene->host, id, "type: no such kind of body");
        return TAHR_E_UNSUPPORTED;
    }
    if (d->type == TAHR_BODY_MESH) {
        const tahr__mesh_source source = {d->vertices, d->indices, d->vertex_count, d->triangle_count, id, 0};
        b->mesh = tahr__scene_mesh(scene, &source, &status);
    }
    if (d->type == TAHR_BODY_HULL) status = tahr__hull_open(scene->host, d, id, &b->hull);
    scene->described = scene->body_count;
    return status;
}

static int is_usual_pose(const tahr_pose *p)
{
    tahr_vec3 at = v_abs(p->position);
    tahr_quat q = p->orientation;
    return at.x <= FARTHEST && at.y <= FARTHEST && at.z <= FARTHEST && (q.x + q.y + q.z + q.w) * 0 == 0;
}

tahr_status tahr__scene_check(const tahr__scene *scene, const tahr_body_pose *poses, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        if (poses[i].body >= scene->described) return TAHR_E_NOT_FOUND;
        int movable = (scene->bodies[poses[i].body].surface.flags & TAHR_BODY_MOVABLE) != 0;
        if (movable && is_usual_pose(&poses[i].pose)) continue;
        tahr__log_body(scene->host, poses[i].body,
                       movable ? "pose: not finite, or beyond 1e8 m" : "is not movable (TAHR_BODY_MOVABLE)");
        return TAHR_E_ARGUMENT;
    }
    return TAHR_OK;
}

void tahr__scene_place(tahr__scene *scene, const tahr_body_pose *poses, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        place_body(&scene->bodies[poses[i].body], &poses[i].pose);
    tahr__fluids_place(&scene->fluids, poses, count);
}

const tahr__hull *tahr__scene_hull(const tahr__scene *scene, const tahr_shape *shape)
{
    int lends = shape->type == TAHR_SHAPE_HULL && shape->hull < scene->described &&
                scene->bodies[shape->hull].kind == TAHR_BODY_HULL;
    return lends ? &scene->bodies[shape->hull].hull : NULL;
}

void tahr__scene_piece(const tahr__scene_body *b, const tahr__placement *frame, uint32_t triangle, tahr__piece *piece)
{
    switch (b->kind) {
    case TAHR_BODY_MESH: tahr__piece_triangle(frame, b->mesh, triangle, piece); break;
    case TAHR_BODY_SPHERE:
    case TAHR_BODY_CAPSULE: tahr__piece_round(frame, b->radius, b->reach, piece); break;
    case TAHR_BODY_CYLINDER: tahr__piece_swept(frame, TAHR__CONVEX_CYLINDER, b->radius, b->reach, piece); break;
    case TAHR_BODY_CONE: tahr__piece_swept(frame, TAHR__CONVEX_CONE, b->radius, b->reach, piece); break;
    case TAHR_BODY_ELLIPSOID: tahr__piece_ellipsoid(frame, b->half_extents, piece); break;
    case TAHR_BODY_HULL: tahr__piece_hull(frame, &b->hull, piece); break;
    default: tahr__piece_box(frame, v_make(0, 0, 0), b->half_extents, piece); break;
    }
    piece->two_sided = b->two_sided;
}

tahr_status tahr__scene_fluid(void *self, tahr_query_context *context, const tahr_fluid_query *query,
                              tahr_fluid *answer)
{
    const tahr__scene *scene = self;

    (void)context;
    tahr__fluids_ask(&scene->fluids, query, answer);
    return TAHR_OK;
}
