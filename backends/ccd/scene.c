/* SPDX-License-Identifier: MIT
 * scene.c: the scene of the ccd backend: bodies, the tree of their bounds, settings. */
#include "scene.h"

#include "../common/options.h"
#include "../common/room.h"

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

/* World bounds, grown by a relative 1e-12: the rounding of a turned corner. */
static tahr_bounds bounds_of(const tahr__scene_body *b)
{
    int round = b->kind == TAHR_BODY_SPHERE || b->kind == TAHR_BODY_CAPSULE;
    tahr_vec3 centre, h = local_half_size(b, &centre);

    centre = v_add(b->pose.position, m_apply(&b->turn, centre));
    h = v_make(v_dot(v_abs(b->turn.row[0]), h), v_dot(v_abs(b->turn.row[1]), h), v_dot(v_abs(b->turn.row[2]), h));
    if (round) h = v_add(h, v_make(b->radius, b->radius, b->radius));
    h = v_add(h, v_scale(v_add(v_abs(centre), h), 1e-12));
    return (tahr_bounds){v_sub(centre, h), v_add(centre, h)};
}

static tahr_status open_tree(tahr__ccd_scene *s)
{
    uint32_t count = s->scene.body_count;
    tahr_bounds *bounds = tahr__room_get(s->scene.host, count, sizeof *bounds);

    if (count > 0 && !bounds) return TAHR_E_MEMORY;
    for (uint32_t i = 0; i < count; i++)
        bounds[i] = bounds_of(&s->scene.bodies[i]);
    tahr_status status = tahr__body_tree_open(s->scene.host, bounds, count, &s->tree);
    tahr__room_put(s->scene.host, bounds, count, sizeof *bounds);
    return status;
}

static tahr_status read_options(tahr__ccd_scene *s, const tahr_host *host, const void *options)
{
    tahr_ccd_desc d = {0};
    tahr_status status = tahr__options_read(host, options, &d, sizeof d);
    const char *bad = d.sweep > TAHR_CCD_SWEEP_ADVANCE   ? "options.sweep is no TAHR_CCD_SWEEP_*"
                      : d.boolean > TAHR_CCD_BOOLEAN_MPR ? "options.boolean is no TAHR_CCD_BOOLEAN_*"
                      : d.max_iterations > 10000         ? "options.max_iterations is above 10000"
                                                         : NULL;

    if (status < 0) return status;
    for (int i = 0; i < 4; i++) {
        if (d.reserved[i] != 0) bad = "options.reserved is not 0";
    }
    s->sweep = d.sweep ? d.sweep : (uint32_t)TAHR_CCD_SWEEP_ADVANCE;
    s->boolean = d.boolean ? d.boolean : (uint32_t)TAHR_CCD_BOOLEAN_MPR;
    /* libccd's own default is ULONG_MAX; random, lattice, far and huge inputs need at most some thirty. */
    s->max_iterations = d.max_iterations ? d.max_iterations : 100;
    if (bad) tahr__log_error(host, bad);
    return bad ? TAHR_E_ARGUMENT : TAHR_OK;
}

tahr_status tahr__ccd_open(const tahr_host *host, const tahr_world_desc *desc, void **self)
{
    tahr__ccd_scene *s = tahr__room_get(host, 1, sizeof *s);

    if (!s) return TAHR_E_MEMORY;
    s->scene.host = host;
    tahr_status status = read_options(s, host, desc->options);
    if (status >= 0) status = tahr__scene_open(&s->scene, host, desc, desc->body_count);
    for (uint32_t i = 0; i < desc->body_count && status >= 0; i++)
        status = tahr__scene_describe(&s->scene, &desc->bodies[i], i);
    if (status >= 0) status = open_tree(s);
    if (status < 0)
        tahr__ccd_close(s);
    else
        *self = s;
    return status;
}

void tahr__ccd_close(void *self)
{
    tahr__ccd_scene *s = self;

    if (!s) return;
    tahr__body_tree_close(s->scene.host, &s->tree);
    tahr__scene_close(&s->scene);
    tahr__room_put(s->scene.host, s, 1, sizeof *s);
}

tahr_status tahr__ccd_place(void *self, const tahr_body_pose *poses, uint32_t count)
{
    tahr__ccd_scene *s = self;
    tahr_status status = tahr__scene_check(&s->scene, poses, count);

    if (status < 0) return status;
    tahr__scene_place(&s->scene, poses, count);
    for (uint32_t i = 0; i < count; i++) {
        tahr_bounds bounds = bounds_of(&s->scene.bodies[poses[i].body]);
        tahr__body_tree_set(&s->tree, poses[i].body, &bounds);
    }
    tahr__body_tree_refit(&s->tree);
    return TAHR_OK;
}
