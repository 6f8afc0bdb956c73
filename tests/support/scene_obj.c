/* SPDX-License-Identifier: MIT
 * scene_obj.c: reads "v" and "f" lines of Wavefront OBJ files; everything else in them is appearance. */
#include "scene_obj.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_LINE = 4096 };

static int refuse(char *error, const char *path, long line, const char *why)
{
    snprintf(error, 256, "%.180s:%ld: %s", path, line, why);
    return 0;
}

static int read_vertex(const char *text, scene_mesh *mesh)
{
    double v[3];
    if (sscanf(text, "%lf %lf %lf", &v[0], &v[1], &v[2]) != 3) {
        return 0;
    }
    scene_mesh_vertex(mesh, v[0], -v[2], v[1]); /* a quarter turn about x: y becomes z */
    return 1;
}

/* Corners are "7", "7/1", "7//3" or "7/1/3"; counted from 1, or from the end if negative. */
static int read_face(const char *text, scene_mesh *mesh, uint32_t base)
{
    uint32_t first = 0, last = 0;
    int corners = 0;
    for (;;) {
        char *end;
        long number = strtol(text, &end, 10);
        if (end == text) {
            return corners >= 3;
        }
        long index = number > 0 ? (long)base + number - 1 : (long)mesh->vertex_count + number;
        if (number == 0 || index < (long)base || index >= (long)mesh->vertex_count) {
            return 0;
        }
        if (corners >= 2) {
            scene_mesh_triangle(mesh, first, last, (uint32_t)index);
        } else if (corners == 0) {
            first = (uint32_t)index;
        }
        last = (uint32_t)index;
        corners++;
        text = end + strcspn(end, " \t\r\n");
    }
}

int scene_obj_read(const char *path, scene_mesh *mesh, char *error)
{
    char line[MAX_LINE];
    long number = 0;
    int ok = 1;
    uint32_t base = mesh->vertex_count;
    FILE *file = fopen(path, "r");
    if (!file) {
        return refuse(error, path, 0, "cannot be opened");
    }
    while (ok && fgets(line, sizeof line, file)) {
        number++;
        if (!strchr(line, '\n') && !feof(file)) {
            ok = refuse(error, path, number, "the line is too long");
        } else if (line[0] == 'v' && line[1] == ' ' && !read_vertex(line + 2, mesh)) {
            ok = refuse(error, path, number, "three coordinates were expected");
        } else if (line[0] == 'f' && line[1] == ' ' && !read_face(line + 2, mesh, base)) {
            ok = refuse(error, path, number, "three or more existing vertices were expected");
        }
    }
    fclose(file);
    if (ok && (mesh->failed || mesh->triangle_count == 0)) {
        ok = refuse(error, path, number, mesh->failed ? "out of memory" : "no faces");
    }
    return ok;
}

int scene_obj_find(const char *name, char *path, size_t capacity)
{
    const char *folder = getenv("TAHR_LEVELS");
    snprintf(path, capacity, "%s/%s.obj", folder && folder[0] ? folder : TAHR_SOURCE_DIR "/../shared/levels", name);
    FILE *file = fopen(path, "r");
    if (file) {
        fclose(file);
    }
    return file != NULL;
}
