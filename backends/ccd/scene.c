/* SPDX-License-Identifier: MIT
 * scene.c: the scene of the ccd backend: bodies, the tree of their bounds, settings. */
#include "scene.h"

#include "../common/options.h"
#include "../common/room.h"

static tahr_status open_tree(tahr__ccd_scene *s)
{
    uint32_t count = s->scene.body_count;
    tahr_bounds *bounds = tahr__room_get(s->scene.host, count, sizeof *bounds);

    if (count > 0 && !bounds) return TAHR_E_MEMORY;
    for (uint32_t i = 0; i < count; i++)
        bounds[i] = tahr__scene_bounds(&s->scene.bodies[i]);
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
    if (status >= 0) status = tahr__scene_open(&s->scene, host, desc, 0);
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
    tahr_status status = tahr__scene_place(self, poses, count);

    if (status < 0) return status;
    for (uint32_t i = 0; i < count; i++) {
        tahr_bounds bounds = tahr__scene_bounds(&s->scene.bodies[poses[i].body]);
        tahr__body_tree_set(&s->tree, poses[i].body, &bounds);
    }
    tahr__body_tree_refit(&s->tree);
    return TAHR_OK;
}
