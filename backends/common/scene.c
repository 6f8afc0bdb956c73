/* SPDX-License-Identifier: MIT
 * scene.c: bodies in space: taking them in, placing them, letting them go. */
#include "scene.h"

#include "room.h"

/* m: what is farther is an error of the caller. */
#define FARTHEST 1e8

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

static tahr_status describe(tahr__scene *scene, const tahr_body_desc *d, uint32_t id)
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
    return status;
}

tahr_status tahr__scene_open(tahr__scene *scene, const tahr_host *host, const tahr_world_desc *desc, uint32_t more)
{
    scene->host = host;
    scene->described = desc->body_count;
    scene->capacity = desc->body_count + more;
    scene->bodies = tahr__room_get(host, scene->capacity, sizeof *scene->bodies);
    scene->meshes = tahr__room_get(host, scene->capacity, sizeof *scene->meshes);
    tahr_status status = scene->capacity == 0 || (scene->bodies && scene->meshes) ? TAHR_OK : TAHR_E_MEMORY;
    for (uint32_t i = 0; i < desc->body_count && status >= 0; i++)
        status = describe(scene, &desc->bodies[i], i);
    return status < 0 ? status : tahr__fluids_open(&scene->fluids, host, desc);
}

static int is_usual_pose(const tahr_pose *p)
{
    tahr_vec3 at = v_abs(p->position);
    tahr_quat q = p->orientation;
    return at.x <= FARTHEST && at.y <= FARTHEST && at.z <= FARTHEST && (q.x + q.y + q.z + q.w) * 0 == 0;
}

static tahr_status check_pose(const tahr__scene *scene, const tahr_body_pose *p)
{
    if (p->body >= scene->described) return TAHR_E_NOT_FOUND;
    int movable = (scene->bodies[p->body].surface.flags & TAHR_BODY_MOVABLE) != 0;
    if (movable && is_usual_pose(&p->pose)) return TAHR_OK;
    tahr__log_body(scene->host, p->body,
                   movable ? "pose: not finite, or beyond 1e8 m" : "is not movable (TAHR_BODY_MOVABLE)");
    return TAHR_E_ARGUMENT;
}

tahr_status tahr__scene_place(void *self, const tahr_body_pose *poses, uint32_t count)
{
    tahr__scene *scene = self;

    for (uint32_t i = 0; i < count; i++) {
        tahr_status status = check_pose(scene, &poses[i]);
        if (status < 0) return status;
    }
    for (uint32_t i = 0; i < count; i++)
        place_body(&scene->bodies[poses[i].body], &poses[i].pose);
    tahr__fluids_place(&scene->fluids, poses, count);
    return TAHR_OK;
}

const tahr__scene_body *tahr__scene_find(const tahr__scene *scene, uint32_t id)
{
    for (uint32_t i = 0; i < scene->body_count; i++) {
        if (scene->bodies[i].surface.id == id) return &scene->bodies[i];
    }
    return NULL;
}

/* Of a body's bounds in its own frame: [out] middle. Round sides count as their box. */
static tahr_vec3 local_half_size(const tahr__scene_body *b, tahr_vec3 *middle)
{
    *middle = v_make(0, 0, 0);
    switch (b->kind) {
    case TAHR_BODY_MESH:
        *middle = v_scale(v_add(b->mesh->bounds.min, b->mesh->bounds.max), 0.5);
        return v_scale(v_sub(b->mesh->bounds.max, b->mesh->bounds.min), 0.5);
    case TAHR_BODY_HULL: *middle = b->hull.middle; return b->hull.half;
    case TAHR_BODY_BOX:
    case TAHR_BODY_ELLIPSOID: return b->half_extents;
    case TAHR_BODY_CYLINDER:
    case TAHR_BODY_CONE: return v_make(b->radius, b->radius, b->reach);
    default: return v_make(0, 0, b->reach);
    }
}

/* Grown by a relative 1e-12: the rounding of a turned corner. */
tahr_bounds tahr__scene_bounds(const tahr__scene_body *b)
{
    int round = b->kind == TAHR_BODY_SPHERE || b->kind == TAHR_BODY_CAPSULE;
    tahr_vec3 centre, h = local_half_size(b, &centre);

    centre = v_add(b->pose.position, m_apply(&b->turn, centre));
    h = v_make(v_dot(v_abs(b->turn.row[0]), h), v_dot(v_abs(b->turn.row[1]), h), v_dot(v_abs(b->turn.row[2]), h));
    if (round) h = v_add(h, v_make(b->radius, b->radius, b->radius));
    h = v_add(h, v_scale(v_add(v_abs(centre), h), 1e-12));
    return (tahr_bounds){v_sub(centre, h), v_add(centre, h)};
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
