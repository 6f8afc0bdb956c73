/* SPDX-License-Identifier: MIT
 * scene.c: bodies of the ccd backend: taking them in, placing them, letting them go. */
#include "scene.h"

#include "../common/options.h"

/* m: poses beyond this are an error of the caller. */
#define FARTHEST 1e8

/* Of a body's bounds in its own frame: [out] middle. Round sides count as their box. */
static tahr_vec3 local_half_size(const tahr__ccd_body *b, tahr_vec3 *middle)
{
    *middle = v_make(0, 0, 0);
    switch (b->type) {
    case TAHR_BODY_MESH:
        *middle = v_scale(v_add(b->mesh.bounds.min, b->mesh.bounds.max), 0.5);
        return v_scale(v_sub(b->mesh.bounds.max, b->mesh.bounds.min), 0.5);
    case TAHR_BODY_HULL: *middle = b->hull.middle; return b->hull.half;
    case TAHR_BODY_BOX:
    case TAHR_BODY_ELLIPSOID: return b->half_extents;
    case TAHR_BODY_CYLINDER:
    case TAHR_BODY_CONE: return v_make(b->radius, b->radius, b->reach);
    default: return v_make(0, 0, b->reach);
    }
}

/* World bounds, grown by a relative 1e-12: the rounding of a turned corner. */
static void place_body(tahr__ccd_body *b, const tahr_pose *pose)
{
    tahr_vec3 centre, half, grow, h;
    int round = b->type == TAHR_BODY_SPHERE || b->type == TAHR_BODY_CAPSULE;

    b->position = pose->position;
    b->turn = m_from_quat(pose->orientation);
    h = local_half_size(b, &centre);
    centre = v_add(b->position, m_apply(&b->turn, centre));
    half = v_make(v_dot(v_abs(b->turn.row[0]), h), v_dot(v_abs(b->turn.row[1]), h), v_dot(v_abs(b->turn.row[2]), h));
    if (round) half = v_add(half, v_make(b->radius, b->radius, b->radius));
    grow = v_scale(v_add(v_abs(centre), half), 1e-12);
    half = v_add(half, grow);
    b->bounds.min = v_sub(centre, half);
    b->bounds.max = v_add(centre, half);
}

static double reach_of(const tahr_body_desc *d)
{
    if (d->type == TAHR_BODY_CAPSULE) return d->half_height - d->radius;
    return d->type == TAHR_BODY_CYLINDER || d->type == TAHR_BODY_CONE ? d->half_height : 0;
}

static tahr_status open_body(tahr__ccd_scene *scene, const tahr_body_desc *d, uint32_t id)
{
    tahr__ccd_body *b = &scene->bodies[id];
    tahr_status status = TAHR_OK;

    b->type = d->type;
    b->surface = tahr__surface_of(d, id);
    b->half_extents = d->half_extents;
    b->radius = d->radius;
    b->reach = reach_of(d);
    if (d->type < TAHR_BODY_MESH || d->type > TAHR_BODY_HULL) {
        tahr__log_body(scene->host, id, "type: no such kind of body");
        return TAHR_E_UNSUPPORTED;
    }
    if (d->type == TAHR_BODY_MESH) {
        tahr__mesh_source source = {d->vertices, d->indices, d->vertex_count, d->triangle_count, id, 0};
        status = tahr__mesh_build(scene->host, &source, &b->mesh);
        if (status < 0) b->type = 0; /* nothing to free */
    }
    if (d->type == TAHR_BODY_HULL) status = tahr__hull_open(scene->host, d, id, &b->hull);
    if (status >= 0) place_body(b, &d->pose);
    return status;
}

static tahr_status open_tree(tahr__ccd_scene *scene)
{
    const tahr_allocator *a = &scene->host->allocator;
    size_t size = scene->body_count * sizeof(tahr_bounds);
    tahr_bounds *bounds = a->alloc(a->user, size, 64);

    if (!bounds) return TAHR_E_MEMORY;
    for (uint32_t i = 0; i < scene->body_count; i++)
        bounds[i] = scene->bodies[i].bounds;
    tahr_status status = tahr__body_tree_open(scene->host, bounds, scene->body_count, &scene->tree);
    a->free(a->user, bounds, size, 64);
    return status;
}

static tahr_status bad_option(const tahr_host *host, const char *text)
{
    tahr__log_error(host, text);
    return TAHR_E_ARGUMENT;
}

static tahr_status read_options(tahr__ccd_scene *scene, const tahr_host *host, const void *options)
{
    tahr_ccd_desc d = {0};
    tahr_status status = tahr__options_read(host, options, &d, sizeof d);

    if (status < 0) return status;
    if (d.sweep > TAHR_CCD_SWEEP_ADVANCE) return bad_option(host, "options.sweep is no TAHR_CCD_SWEEP_*");
    if (d.boolean > TAHR_CCD_BOOLEAN_MPR) return bad_option(host, "options.boolean is no TAHR_CCD_BOOLEAN_*");
    if (d.max_iterations > 10000) return bad_option(host, "options.max_iterations is above 10000");
    for (int i = 0; i < 4; i++) {
        if (d.reserved[i] != 0) return bad_option(host, "options.reserved is not 0");
    }
    scene->sweep = d.sweep ? d.sweep : (uint32_t)TAHR_CCD_SWEEP_ADVANCE;
    scene->boolean = d.boolean ? d.boolean : (uint32_t)TAHR_CCD_BOOLEAN_MPR;
    /* libccd's own default is ULONG_MAX; random, lattice, far and huge inputs need at most some thirty. */
    scene->max_iterations = d.max_iterations ? d.max_iterations : 100;
    return TAHR_OK;
}

tahr_status tahr__ccd_scene_open(tahr__ccd_scene *scene, const tahr_host *host, const tahr_world_desc *desc)
{
    size_t size = desc->body_count * sizeof *scene->bodies;
    tahr_status status;

    *scene = (tahr__ccd_scene){.host = host};
    status = read_options(scene, host, desc->options);
    if (status < 0 || desc->body_count == 0) return status;
    scene->bodies = host->allocator.alloc(host->allocator.user, size, 64);
    if (!scene->bodies) return TAHR_E_MEMORY;
    scene->body_count = desc->body_count;
    for (uint32_t i = 0; i < desc->body_count; i++)
        scene->bodies[i] = (tahr__ccd_body){0};
    for (uint32_t i = 0; i < desc->body_count && status >= 0; i++)
        status = open_body(scene, &desc->bodies[i], i);
    if (status >= 0) status = open_tree(scene);
    if (status >= 0) status = tahr__fluids_open(&scene->fluids, host, desc);
    if (status < 0) tahr__ccd_scene_close(scene);
    return status;
}

static void close_body(const tahr_host *host, tahr__ccd_body *b)
{
    if (b->type == TAHR_BODY_MESH) tahr__mesh_free(host, &b->mesh);
    tahr__hull_close(host, &b->hull);
}

void tahr__ccd_scene_close(tahr__ccd_scene *scene)
{
    const tahr_allocator *a = &scene->host->allocator;

    for (uint32_t i = 0; i < scene->body_count; i++)
        close_body(scene->host, &scene->bodies[i]);
    if (scene->bodies) a->free(a->user, scene->bodies, scene->body_count * sizeof *scene->bodies, 64);
    tahr__body_tree_close(scene->host, &scene->tree);
    tahr__fluids_close(&scene->fluids, scene->host);
    scene->bodies = NULL;
    scene->body_count = 0;
}

static int is_usual_pose(const tahr_pose *p)
{
    tahr_vec3 at = v_abs(p->position);
    tahr_quat q = p->orientation;
    return at.x <= FARTHEST && at.y <= FARTHEST && at.z <= FARTHEST && (q.x + q.y + q.z + q.w) * 0 == 0;
}

tahr_status tahr__ccd_scene_place(tahr__ccd_scene *scene, const tahr_body_pose *poses, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        if (poses[i].body >= scene->body_count) return TAHR_E_NOT_FOUND;
        if (!(scene->bodies[poses[i].body].surface.flags & TAHR_BODY_MOVABLE)) {
            tahr__log_body(scene->host, poses[i].body, "is not movable (TAHR_BODY_MOVABLE)");
            return TAHR_E_ARGUMENT;
        }
        if (!is_usual_pose(&poses[i].pose)) {
            tahr__log_body(scene->host, poses[i].body, "pose: not finite, or beyond 1e8 m");
            return TAHR_E_ARGUMENT;
        }
    }
    for (uint32_t i = 0; i < count; i++) {
        tahr__ccd_body *b = &scene->bodies[poses[i].body];
        place_body(b, &poses[i].pose);
        tahr__body_tree_set(&scene->tree, b->surface.id, &b->bounds);
    }
    tahr__body_tree_refit(&scene->tree);
    tahr__fluids_place(&scene->fluids, poses, count);
    return TAHR_OK;
}
