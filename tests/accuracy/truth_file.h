/* SPDX-License-Identifier: MIT
 * truth_file.h: reads the stored truth (truth/<family>.txt, made by make_truth.c) and judges answers against it with a
 * long double distance of its own. */
#ifndef TAHR_TRUTH_FILE_H
#define TAHR_TRUTH_FILE_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <tahr/tahr.h>

#define TAHR_TRUTH_REAL long double
#include "quad_distance.h"

enum { TRUTH_FREE = 0, TRUTH_HIT = 1, TRUTH_OVERLAP = 2, TRUTH_MAX_VERTICES = 64, TRUTH_MAX_TRIANGLES = 64 };

typedef struct truth_mesh {
    double vertices[TRUTH_MAX_VERTICES * 3];
    uint32_t indices[TRUTH_MAX_TRIANGLES * 3];
    uint32_t vertex_count, triangle_count;
} truth_mesh;

typedef struct truth_case {
    tahr_sweep query;
    int status, line;
    double start_gap, fraction, min_gap;
    tahr_vec3 start_normal, normal;
} truth_case;

static double truth_number(char **text)
{
    char *end = *text;
    double value = strtod(*text, &end);

    if (end == *text) {
        fprintf(stderr, "truth: a number is missing before \"%.40s\"\n", end);
        abort();
    }
    *text = end;
    return value;
}

static tahr_vec3 truth_vec(char **text)
{
    tahr_vec3 v;

    v.x = truth_number(text);
    v.y = truth_number(text);
    v.z = truth_number(text);
    return v;
}

static void truth_read_mesh(char *text, truth_mesh *mesh)
{
    mesh->vertex_count = (uint32_t)truth_number(&text);
    mesh->triangle_count = (uint32_t)truth_number(&text);
    if (mesh->vertex_count > TRUTH_MAX_VERTICES || mesh->triangle_count > TRUTH_MAX_TRIANGLES) abort();
    for (uint32_t i = 0; i < mesh->vertex_count * 3; i++)
        mesh->vertices[i] = truth_number(&text);
    for (uint32_t i = 0; i < mesh->triangle_count * 3; i++)
        mesh->indices[i] = (uint32_t)truth_number(&text);
}

static void truth_read_case(char *text, int line, truth_case *out)
{
    tahr_sweep *q = &out->query;

    memset(out, 0, sizeof *out);
    out->line = line;
    q->shape.type = (uint32_t)truth_number(&text);
    q->shape.radius = truth_number(&text);
    q->shape.half_height = truth_number(&text);
    q->shape.half_x = truth_number(&text);
    q->shape.half_y = truth_number(&text);
    q->position = truth_vec(&text);
    q->up = truth_vec(&text);
    q->orientation.x = truth_number(&text);
    q->orientation.y = truth_number(&text);
    q->orientation.z = truth_number(&text);
    q->orientation.w = truth_number(&text);
    q->motion = truth_vec(&text);
    q->margin = truth_number(&text);
    q->mask = 0xFFFFFFFFu;
    q->ignore_body = TAHR_NO_BODY;
    out->status = (int)truth_number(&text);
    out->start_gap = truth_number(&text);
    out->start_normal = truth_vec(&text);
    out->fraction = truth_number(&text);
    out->min_gap = truth_number(&text);
    out->normal = truth_vec(&text);
}

static vec truth_rotate(tahr_quat q, vec v)
{
    vec u = {q.x, q.y, q.z};
    return vadd(v, vmul(vadd(vmul(vcross(u, v), q.w), vcross(u, vcross(u, v))), 2));
}

/* The core at the given fraction of the motion, with the start position as origin: subtracted exactly, so that a far
 * origin costs no digits. */
static core truth_core(const tahr_sweep *q, double fraction)
{
    core k = {{q->motion.x, q->motion.y, q->motion.z}, {{0, 0, 0}}, 0};

    k.centre = vmul(k.centre, fraction);
    if (q->shape.type == TAHR_SHAPE_CAPSULE && q->shape.half_height > q->shape.radius) {
        k.axes = 1;
        k.axis[0] = vmul((vec){q->up.x, q->up.y, q->up.z}, (real)q->shape.half_height - q->shape.radius);
    } else if (q->shape.type == TAHR_SHAPE_BOX) {
        k.axes = 3;
        k.axis[0] = truth_rotate(q->orientation, (vec){q->shape.half_x, 0, 0});
        k.axis[1] = truth_rotate(q->orientation, (vec){0, q->shape.half_y, 0});
        k.axis[2] = truth_rotate(q->orientation, (vec){0, 0, q->shape.half_height});
    }
    return k;
}

static triangle truth_triangle(const truth_mesh *mesh, const tahr_sweep *q, uint32_t index)
{
    triangle t;

    for (int i = 0; i < 3; i++) {
        const double *v = &mesh->vertices[mesh->indices[index * 3 + (uint32_t)i] * 3];
        t.v[i] = (vec){(real)v[0] - q->position.x, (real)v[1] - q->position.y, (real)v[2] - q->position.z};
    }
    return t;
}

/* Distances of the core at a fraction to every triangle; the smallest is returned. */
static long double truth_distances(const truth_mesh *mesh, const tahr_sweep *q, double fraction,
                                   nearest out[TRUTH_MAX_TRIANGLES])
{
    core k = truth_core(q, fraction);
    real best = -1;

    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        triangle t = truth_triangle(mesh, q, i);
        out[i] = core_triangle(&k, &t);
        if (best < 0 || out[i].squared < best) best = out[i].squared;
    }
    return sqrtl(best);
}

/* Angle in degrees from a normal to the nearest of the directions that count as closest: those of every triangle whose
 * distance is within slack of the smallest. */
static double truth_normal_error(const truth_mesh *mesh, const nearest *distances, double slack, tahr_vec3 normal)
{
    long double least = -1, best = 180;

    for (uint32_t i = 0; i < mesh->triangle_count; i++)
        if (least < 0 || distances[i].squared < least) least = distances[i].squared;
    least = sqrtl(least) + slack;
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        vec g = distances[i].gap, n = {normal.x, normal.y, normal.z}, side;
        if (distances[i].squared > least * least) continue;
        side = vcross(g, n);
        long double angle = atan2l(sqrtl(vdot(side, side)), vdot(g, n)) * 57.29577951308232L;
        if (angle < best) best = angle;
    }
    return (double)best;
}

#endif
