/* SPDX-License-Identifier: MIT
 * scene_level.c: whole levels by name, and a mesh as the body of a world. */
#include "scene_level.h"

#include <stdio.h>
#include <string.h>

#include "scene_obj.h"

const char *const SCENE_LEVEL_NAMES[SCENE_LEVELS] = {"dungeon", "nav_test", "playground", "hills"};

int scene_level_make(const char *name, scene_mesh *mesh, char *why)
{
    char path[1024];
    why[0] = 0;
    if (strcmp(name, "playground") == 0) {
        scene_mesh_playground(mesh);
    } else if (strcmp(name, "hills") == 0) {
        scene_mesh_field(mesh, 120, 120, 0.5, scene_hills);
    } else if (!scene_obj_find(name, path, sizeof path)) {
        snprintf(why, 256, "not present");
    } else {
        scene_obj_read(path, mesh, why);
    }
    if (mesh->failed) {
        snprintf(why, 256, "out of memory");
    }
    return !why[0];
}

void scene_level_body(const scene_mesh *mesh, tahr_body_desc *body)
{
    tahr_body_desc_init(body, sizeof *body, TAHR_BODY_MESH);
    body->vertices = mesh->vertices;
    body->indices = mesh->indices;
    body->vertex_count = mesh->vertex_count;
    body->triangle_count = mesh->triangle_count;
}
