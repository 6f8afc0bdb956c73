/* SPDX-License-Identifier: MIT
 * truth_solid.h: the convex solids of make_truth.c: boxes, hulls of random points, thin wedges and pyramids. */
#ifndef TAHR_TRUTH_SOLID_H
#define TAHR_TRUTH_SOLID_H

#include "truth_scene.h"

enum { SOLID_HULL, SOLID_BOX, SOLID_SHARP };

static double height_over(const mesh *m, int a, int b, int c, int p)
{
    dvec n = cross(sub(m->vertices[b], m->vertices[a]), sub(m->vertices[c], m->vertices[a]));
    return dot(n, sub(m->vertices[p], m->vertices[a])) / sqrt(dot(n, n));
}

/* 1: all others are under the plane of a, b, c; 0: not; -1: too near to it to be sure, or none of a hull. */
static int is_face(const mesh *m, int a, int b, int c, double clear)
{
    for (int p = 0; p < m->vertex_count; p++) {
        if (p == a || p == b || p == c) continue;
        double h = height_over(m, a, b, c, p);
        if (fabs(h) < clear) return -1;
        if (h > 0) return 0;
    }
    return 1;
}

/* All faces of the hull, by trying all triples. Returns 0 if four vertices of a face lie in a plane, nearly, or not all
 * vertices are corners. */
static int wrap(mesh *m, double clear)
{
    int used[MAX_VERTICES] = {0}, corners = 0;

    m->triangle_count = 0;
    for (int a = 0; a < m->vertex_count; a++) {
        for (int b = 0; b < m->vertex_count; b++) {
            for (int c = 0; c < m->vertex_count; c++) {
                if (a >= b || a >= c || b == c) continue; /* each face once, starting at its lowest */
                int answer = is_face(m, a, b, c, clear);
                if (answer < 0) return 0;
                if (answer == 0) continue;
                if (m->triangle_count == MAX_TRIANGLES) return 0;
                face(m, a, b, c);
                used[a] = used[b] = used[c] = 1;
            }
        }
    }
    for (int i = 0; i < m->vertex_count; i++)
        corners += used[i];
    return corners == m->vertex_count && m->triangle_count == 2 * m->vertex_count - 4;
}

static void make_hull(mesh *m, double size, int rounding)
{
    do {
        m->vertex_count = 0;
        for (int i = 4 + below(9); i > 0; i--) {
            dvec v = round_vec(scaled(direction(), size * uniform(0.4, 0.5)), rounding);
            vertex(m, v.x, v.y, v.z);
        }
    } while (!wrap(m, 0.02 * size));
}

/* Long and thin: edges of 2 to 30 degrees, spikes, plates. */
static void make_sharp(mesh *m, double size, int rounding)
{
    do {
        dvec long_way = direction(), side = unit(cross(long_way, direction())), thin = cross(long_way, side);
        double width = uniform(0.05, 0.5), height = uniform(0.02, 0.2);
        m->vertex_count = 0;
        for (int i = 4 + below(3); i > 0; i--) {
            double along = i % 3 == 0 ? 0.5 : uniform(-0.5, -0.3);
            dvec v = add(scaled(long_way, along), scaled(side, width * uniform(-0.5, 0.5)));
            v = round_vec(scaled(add(v, scaled(thin, height * uniform(-0.5, 0.5))), size), rounding);
            vertex(m, v.x, v.y, v.z);
        }
    } while (!wrap(m, 0.002 * size));
}

static void make_box(mesh *m, double size, int index)
{
    static const int sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    dvec axis = index % 2 ? direction() : (dvec){0, 0, 1};
    double angle = index % 4 == 0 ? 0 : uniform(0, 3);

    m->is_box = 1;
    m->vertex_count = m->triangle_count = 0;
    m->centre = round_vec(in_cube(size / 4), DYADIC);
    for (int i = 0; i < 3; i++)
        m->half[i] = rounded(uniform(0.05, 0.5) * size, DYADIC);
    m->quat[0] = axis.x * sin(angle / 2), m->quat[1] = axis.y * sin(angle / 2);
    m->quat[2] = axis.z * sin(angle / 2), m->quat[3] = cos(angle / 2);
    for (int i = 0; i < 8; i++) {
        vec local = {i & 1 ? m->half[0] : -m->half[0], i & 2 ? m->half[1] : -m->half[1],
                     i & 4 ? m->half[2] : -m->half[2]};
        dvec v = narrow(vadd(wide(m->centre), rotate(m->quat, local)));
        vertex(m, v.x, v.y, v.z);
    }
    for (int i = 0; i < 6; i++) {
        face(m, sides[i][0], sides[i][1], sides[i][2]);
        face(m, sides[i][0], sides[i][2], sides[i][3]);
    }
}

static void make_solid(mesh *m, int kind, double size, int rounding, int index)
{
    memset(m, 0, sizeof *m);
    m->solid = 1;
    if (kind == SOLID_BOX)
        make_box(m, size, index);
    else if (kind == SOLID_SHARP)
        make_sharp(m, size, rounding);
    else
        make_hull(m, size, rounding);
}

#endif
