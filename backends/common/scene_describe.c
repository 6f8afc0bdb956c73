/* SPDX-License-Identifier: MIT
 * scene_describe.c: what a scene is made of, in words, for backends whose engine only finds bodies. */
#include "scene.h"

#include <stdio.h>

typedef struct kind {
    uint32_t type;
    const char *name;
} kind;

static const kind KINDS[] = {
    {TAHR_BODY_MESH, "meshes"},    {TAHR_BODY_BOX, "boxes"},
    {TAHR_BODY_SPHERE, "spheres"}, {TAHR_BODY_CAPSULE, "capsules"},
    {TAHR_BODY_HULL, "hulls"},     {TAHR_BODY_CYLINDER, "cylinders"},
    {TAHR_BODY_CONE, "cones"},     {TAHR_BODY_ELLIPSOID, "ellipsoids"},
};
enum { KIND_COUNT = sizeof KINDS / sizeof KINDS[0] };

static uint32_t count_of(const tahr__scene *scene, uint32_t type)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < scene->body_count; i++)
        count += scene->bodies[i].kind == type;
    return count;
}

static uint32_t count_movable(const tahr__scene *scene)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < scene->body_count; i++)
        count += (scene->bodies[i].surface.flags & TAHR_BODY_MOVABLE) != 0;
    return count;
}

static void describe_mesh(const tahr__scene_body *body, const tahr_log *to)
{
    char text[256];
    const tahr__mesh *m = body->mesh;
    snprintf(text, sizeof text,
             "body %u: mesh, %u triangles (%u more dropped: no area, or there twice), %u vertices, %s",
             (unsigned)body->surface.id, (unsigned)m->triangle_count, (unsigned)m->dropped, (unsigned)m->vertex_count,
             body->two_sided ? "two-sided" : "one-sided");
    to->write(to->user, TAHR_LOG_INFO, text);
}

void tahr__scene_describe(const tahr__scene *scene, const char *name, const char *path, const tahr_log *to)
{
    char text[512];
    uint32_t movable = count_movable(scene), named = 0;
    int n = snprintf(text, sizeof text, "%s, 3D: %u movable and %u static bodies,", name, (unsigned)movable,
                     (unsigned)(scene->body_count - movable));
    for (int k = 0; k < KIND_COUNT; k++) {
        uint32_t count = count_of(scene, KINDS[k].type);
        named += count;
        if (count) n += snprintf(text + n, sizeof text - (size_t)n, " %u %s,", (unsigned)count, KINDS[k].name);
    }
    if (scene->body_count > named)
        n += snprintf(text + n, sizeof text - (size_t)n, " %u others,", (unsigned)(scene->body_count - named));
    text[n - 1] = 0;
    to->write(to->user, TAHR_LOG_INFO, text);
    to->write(to->user, TAHR_LOG_INFO, path);
    for (uint32_t i = 0; i < scene->body_count; i++) {
        if (scene->bodies[i].kind == TAHR_BODY_MESH && scene->bodies[i].mesh) describe_mesh(&scene->bodies[i], to);
    }
}
