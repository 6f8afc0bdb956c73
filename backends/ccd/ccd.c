/* SPDX-License-Identifier: MIT
 * ccd.c: the table of the ccd backend: its slots are those of convex pieces, found by walk.c. */
#include "scene.h"

#include <stdio.h>

static tahr_status sweep(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                         uint32_t capacity, uint32_t *count)
{
    tahr__ccd_walk walk;
    return tahr__piece_sweep(tahr__piece_query_by(&walk.query, &tahr__ccd_finder, self, context), query, hits, capacity,
                             count);
}

static tahr_status contacts(void *self, tahr_query_context *context, const tahr_contact_query *query,
                            tahr_contact *found, uint32_t capacity, uint32_t *count)
{
    tahr__ccd_walk walk;
    return tahr__piece_contacts(tahr__piece_query_by(&walk.query, &tahr__ccd_finder, self, context), query, found,
                                capacity, count);
}

static tahr_status ray(void *self, tahr_query_context *context, const tahr_ray *query, tahr_hit *hit, uint32_t *count)
{
    tahr__ccd_walk walk;
    return tahr__piece_ray(tahr__piece_query_by(&walk.query, &tahr__ccd_finder, self, context), query, hit, count);
}

static tahr_status describe(void *self, const tahr_log *to)
{
    const tahr__ccd_scene *scene = self;
    char path[256];
    const char *boolean = scene->boolean == TAHR_CCD_BOOLEAN_GJK ? "GJK" : "MPR";
    int n =
        snprintf(path, sizeof path, "path: the tree of bodies, in meshes their trees of eight; then pair by pair, ");
    if (scene->sweep == TAHR_CCD_SWEEP_ADVANCE)
        snprintf(path + n, sizeof path - (size_t)n, "by the distance all the way: libccd is not asked");
    else
        snprintf(path + n, sizeof path - (size_t)n, "by libccd's %s in halves, %u iterations at most: options.sweep",
                 boolean, (unsigned)scene->max_iterations);
    tahr__scene_describe(&scene->scene, "ccd", path, to);
    return TAHR_OK;
}

static const tahr_backend backend = {
    .struct_size = sizeof backend,
    .abi_major = TAHR_ABI_MAJOR,
    .abi_minor = TAHR_ABI_MINOR,
    .capabilities = TAHR_CAP_MARGIN | TAHR_CAP_CONTACTS | TAHR_CAP_RAY | TAHR_CAP_SPHERE | TAHR_CAP_CAPSULE |
                    TAHR_CAP_BOX | TAHR_CAP_CYLINDER | TAHR_CAP_CONE | TAHR_CAP_ELLIPSOID | TAHR_CAP_HULL |
                    TAHR_CAP_MESH | TAHR_CAP_SOLIDS | TAHR_CAP_ROUND_SOLIDS | TAHR_CAP_HULLS | TAHR_CAP_SENSORS |
                    TAHR_CAP_ONE_WAY,
    .name = "ccd",
    .version = "2.x", /* libccd says 2.0 in its CMake files and is 2.1 in Debian; nothing in it tells at run time */
    .open = tahr__ccd_open,
    .close = tahr__ccd_close,
    .sweep = sweep,
    .contacts = contacts,
    .ray = ray,
    .place = tahr__ccd_place,
    .fluid = tahr__scene_fluid,
    .describe = describe,
};

const tahr_backend *tahr_backend_v1_ccd(void)
{
    return &backend;
}
