/* SPDX-License-Identifier: MIT
 * truth_plane.h: the cases of make_truth.c in the plane of x and y: outlines and polygons drawn out along z, shapes whose
 * axis lies in the plane. What is nearest then lies in the plane too, so one truth serves backends of two and of three
 * dimensions. */
#ifndef TAHR_TRUTH_PLANE_H
#define TAHR_TRUTH_PLANE_H

#include "truth_sweeps.h"

/* m: half the length along z; beyond all that moves. */
static const double DRAWN_OUT = 8;

static void draw_out(mesh *m, int corners, int loop)
{
    for (int i = 0; i < corners; i++) {
        dvec v = m->vertices[i];
        m->vertices[corners + i] = (dvec){v.x, v.y, DRAWN_OUT};
        m->vertices[i].z = -DRAWN_OUT;
    }
    m->vertex_count = 2 * corners;
    for (int i = 0; i + !loop < corners; i++) { /* outside on the right hand of who goes along it */
        int next = (i + 1) % corners;
        face(m, i, next, corners + next), face(m, i, corners + next, corners + i);
    }
}

/* A walk of segments of a metre or so, or a ring. */
static void make_chain(mesh *m, int loop)
{
    int corners = 3 + below(6);

    memset(m, 0, sizeof *m);
    m->chain = 1 + loop;
    for (int i = 0; i < corners; i++) {
        double angle = i * 6.283185307179586 / corners, away = uniform(0.5, 1.5);
        dvec v = loop ? (dvec){away * cos(angle), away * sin(angle), 0} : (dvec){i - corners / 2.0, uniform(-1, 1), 0};
        v = round_vec(v, DYADIC);
        vertex(m, v.x, v.y, 0);
    }
    draw_out(m, corners, loop);
}

/* A convex polygon: corners of a circle, pressed flat. */
static void make_polygon(mesh *m)
{
    int corners = 3 + below(5);
    double flat = uniform(0.05, 1), turn = uniform(0, 6), first = uniform(0, 6);

    memset(m, 0, sizeof *m);
    m->solid = 1;
    for (int i = 0; i < corners; i++) {
        double angle = first + (i + uniform(0, 0.5)) * 6.283185307179586 / corners;
        double x = cos(angle), y = flat * sin(angle);
        dvec v = round_vec((dvec){x * cos(turn) - y * sin(turn), x * sin(turn) + y * cos(turn), 0}, FINE);
        vertex(m, v.x, v.y, 0);
    }
    draw_out(m, corners, 1);
    for (int i = 2; i < corners; i++)
        face(m, 0, i, i - 1), face(m, corners, corners + i - 1, corners + i);
}

static void make_flat_shape(query *q, int kind)
{
    double angle = kind == CAPSULE_TILTED || kind == BOX_TILTED ? uniform(-1.5, 1.5) : 0, half = sqrt(0.5);
    double c = cos(angle / 2), s = sin(angle / 2);

    make_shape(q, kind, DYADIC);
    q->quat[0] = -half * c, q->quat[1] = -half * s; /* z of the shape becomes y, then all turns about z */
    q->quat[2] = half * s, q->quat[3] = half * c;
    q->up = (dvec){-2 * s * c, 1 - 2 * s * s, 0};
}

/* Toward a point of an edge, along a random way of the plane; every fourth past it by a little, or anywhere. */
static void place_flat(query *q, const mesh *m, int index)
{
    static const double misses[] = {-1e-3, -1e-5, 3e-6, 1e-4};
    triangle t = triangle_of(m, below(m->triangle_count));
    core k = core_of(q);
    dvec n = direction(), way = direction(), start;
    double rho = q->radius + q->margin, length = uniform(0.05, 2);

    n.z = way.z = 0;
    n = unit(n), way = unit(way);
    if (dot(way, n) > 0) way = scaled(way, -1);
    if (index % 4 == 2) {
        way = (dvec){n.y, -n.x, 0};
        start = sub(pose_over(&t, &k, n, rho + misses[index / 4 % 4]), scaled(way, length * uniform(0.2, 0.8)));
    } else {
        start = sub(pose_over(&t, &k, n, rho), scaled(way, length * uniform(0.02, 1.1)));
        if (index % 4 == 3) start = add(start, in_cube(1));
    }
    start.z = 0;
    q->position = round_vec(start, FINE);
    q->motion = round_vec(scaled(way, length), FINE);
}

#endif
