/* SPDX-License-Identifier: MIT
 * scene_mesh.c: meshes made by rule. */
#include "scene_mesh.h"

#include <math.h>
#include <stdlib.h>

void scene_mesh_free(scene_mesh *mesh)
{
    free(mesh->vertices);
    free(mesh->indices);
    *mesh = (scene_mesh){0};
}

static int grow(scene_mesh *mesh, void **items, size_t size, uint32_t *capacity)
{
    uint32_t more = *capacity ? 2 * *capacity : 256;
    void *memory = realloc(*items, size * more);
    if (!memory) {
        mesh->failed = 1;
        return 0;
    }
    *items = memory;
    *capacity = more;
    return 1;
}

uint32_t scene_mesh_vertex(scene_mesh *mesh, double x, double y, double z)
{
    void *items = mesh->vertices;
    if (mesh->vertex_count == mesh->vertex_capacity) {
        if (!grow(mesh, &items, 3 * sizeof(double), &mesh->vertex_capacity)) {
            return 0;
        }
        mesh->vertices = items;
    }
    double *v = mesh->vertices + 3 * (size_t)mesh->vertex_count;
    v[0] = x;
    v[1] = y;
    v[2] = z;
    return mesh->vertex_count++;
}

void scene_mesh_triangle(scene_mesh *mesh, uint32_t a, uint32_t b, uint32_t c)
{
    void *items = mesh->indices;
    if (mesh->triangle_count == mesh->triangle_capacity) {
        if (!grow(mesh, &items, 3 * sizeof(uint32_t), &mesh->triangle_capacity)) {
            return;
        }
        mesh->indices = items;
    }
    uint32_t *t = mesh->indices + 3 * (size_t)mesh->triangle_count++;
    t[0] = a;
    t[1] = b;
    t[2] = c;
}

void scene_mesh_profile(scene_mesh *mesh, const double (*points)[2], int count, double width)
{
    uint32_t base = mesh->vertex_count;
    for (int i = 0; i < count; i++) {
        scene_mesh_vertex(mesh, points[i][0], -0.5 * width, points[i][1]);
        scene_mesh_vertex(mesh, points[i][0], 0.5 * width, points[i][1]);
    }
    for (int i = 0; i + 1 < count; i++) {
        uint32_t a = base + 2 * (uint32_t)i;
        scene_mesh_triangle(mesh, a, a + 2, a + 3);
        scene_mesh_triangle(mesh, a, a + 3, a + 1);
    }
}

void scene_mesh_plan(scene_mesh *mesh, const double (*points)[2], int count, double z0, double z1)
{
    uint32_t base = mesh->vertex_count;
    for (int i = 0; i < count; i++) {
        scene_mesh_vertex(mesh, points[i][0], points[i][1], z0);
        scene_mesh_vertex(mesh, points[i][0], points[i][1], z1);
    }
    for (int i = 0; i + 1 < count; i++) {
        uint32_t a = base + 2 * (uint32_t)i;
        scene_mesh_triangle(mesh, a, a + 1, a + 3);
        scene_mesh_triangle(mesh, a, a + 3, a + 2);
    }
}

void scene_mesh_stairs(scene_mesh *mesh, const scene_stairs *s)
{
    int count = 0;
    double(*points)[2] = malloc(sizeof *points * (size_t)(4 * s->n + 4));
    if (!points) {
        mesh->failed = 1;
        return;
    }
    points[count][0] = -s->lead;
    points[count++][1] = 0;
    for (int i = 0; i < s->n; i++) {
        double x = i * s->run, top = (i + 1) * s->rise;
        points[count][0] = x;
        points[count++][1] = i * s->rise;
        points[count][0] = x;
        points[count++][1] = top - s->bevel;
        if (s->bevel > 0) {
            points[count][0] = x + s->bevel;
            points[count++][1] = top;
        }
    }
    points[count][0] = s->n * s->run + s->lead;
    points[count++][1] = s->n * s->rise;
    scene_mesh_profile(mesh, (const double(*)[2])points, count, s->width);
    free(points);
}

void scene_mesh_field(scene_mesh *mesh, int nx, int ny, double cell, double (*height)(double x, double y))
{
    uint32_t base = mesh->vertex_count;
    for (int j = 0; j <= ny; j++) {
        for (int i = 0; i <= nx; i++) {
            double x = (i - 0.5 * nx) * cell, y = (j - 0.5 * ny) * cell;
            scene_mesh_vertex(mesh, x, y, height ? height(x, y) : 0);
        }
    }
    for (int j = 0; j < ny; j++) {
        for (int i = 0; i < nx; i++) {
            uint32_t a = base + (uint32_t)(j * (nx + 1) + i), up = a + (uint32_t)nx + 1;
            scene_mesh_triangle(mesh, a, a + 1, up + 1);
            scene_mesh_triangle(mesh, a, up + 1, up);
        }
    }
}

double scene_hills(double x, double y)
{
    return 1.5 * sin(0.31 * x) * cos(0.27 * y) + 0.2 * sin(1.1 * x + 0.7 * y);
}

void scene_mesh_box(scene_mesh *mesh, const double low[3], const double high[3])
{
    /* Vertex k has bit 0, 1, 2 set where it lies high along x, y, z. */
    static const uint32_t QUADS[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    uint32_t base = mesh->vertex_count;
    for (uint32_t k = 0; k < 8; k++) {
        scene_mesh_vertex(mesh, k & 1 ? high[0] : low[0], k & 2 ? high[1] : low[1], k & 4 ? high[2] : low[2]);
    }
    for (int f = 0; f < 6; f++) {
        const uint32_t *q = QUADS[f];
        scene_mesh_triangle(mesh, base + q[0], base + q[1], base + q[2]);
        scene_mesh_triangle(mesh, base + q[0], base + q[2], base + q[3]);
    }
}

static void shift(scene_mesh *mesh, uint32_t from, double x, double y, double z)
{
    for (uint32_t i = from; i < mesh->vertex_count; i++) {
        mesh->vertices[3 * (size_t)i] += x;
        mesh->vertices[3 * (size_t)i + 1] += y;
        mesh->vertices[3 * (size_t)i + 2] += z;
    }
}

static void add_box(scene_mesh *mesh, double x, double y, double sx, double sy, double height)
{
    double low[3] = {x - 0.5 * sx, y - 0.5 * sy, -0.5}, high[3] = {x + 0.5 * sx, y + 0.5 * sy, height};
    scene_mesh_box(mesh, low, high);
}

void scene_mesh_playground(scene_mesh *mesh)
{
    static const double RISES[4] = {0.1, 0.2, 0.3, 0.4};
    scene_mesh_field(mesh, 40, 40, 1, NULL);
    for (int i = 0; i < 4; i++) {
        scene_stairs stairs = {
            .n = 8, .rise = RISES[i] * 0.75, .run = 0.3, .width = 3, .bevel = i % 2 ? 0.03 : 0, .lead = 2};
        uint32_t from = mesh->vertex_count;
        scene_mesh_stairs(mesh, &stairs);
        shift(mesh, from, -10, -12.0 + 6 * i, 0.001);
        double height = 1 + i, ramp[4][2] = {{0, 0}, {2.7, height}, {4.7, height}, {7.4, 0}};
        from = mesh->vertex_count;
        scene_mesh_profile(mesh, (const double(*)[2])ramp, 4, 3);
        shift(mesh, from, 5, -12.0 + 6 * i, 0.001);
        for (int k = 0; k < 8; k++) {
            add_box(mesh, -17 + 5.0 * k, -15 + 9.0 * i, 0.5 + 0.25 * (k % 3), 0.5, k % 2 ? 2.5 : RISES[i]);
        }
    }
    for (int i = 0; i < 4; i++) {
        double at = i % 2 ? 20 : -20;
        add_box(mesh, i < 2 ? at : 0, i < 2 ? 0 : at, i < 2 ? 0.4 : 40.4, i < 2 ? 40.4 : 0.4, 3);
    }
}
