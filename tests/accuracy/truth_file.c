/* SPDX-License-Identifier: MIT
 * truth_file.c: hex floats back into bodies and cases. */
#include "truth_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifndef TAHR_SOURCE_DIR
#define TAHR_SOURCE_DIR "."
#endif

const char *const TRUTH_FAMILIES[] = {
    "generic",         "dyadic",         "lattice",     "feature",      "grazing",      "long",
    "sliver",          "tiny",           "huge",        "far_1e3",      "far_1e6",      "touching",
    "overlap",         "mesh_flat",      "mesh_hills",  "mesh_stairs",  "mesh_corner",  "mesh_fan",
    "mesh_soup",       "convex_hull",    "convex_box",  "convex_exact", "convex_sharp", "convex_grazing",
    "convex_touching", "convex_overlap", "plane_chain", "plane_hull",   NULL,
};

const char *const TRUTH_PLANE_FAMILIES[] = {"plane_chain", "plane_hull", NULL};

static void refuse(const char *what, const char *where)
{
    fprintf(stderr, "truth: %s: \"%.60s\"\n", what, where);
    abort();
}

double truth_number(char **text)
{
    char *end = *text;
    double value = strtod(*text, &end);

    if (end == *text) {
        refuse("a number is missing before", end);
    }
    *text = end;
    return value;
}

tahr_vec3 truth_vec(char **text)
{
    tahr_vec3 v;

    v.x = truth_number(text);
    v.y = truth_number(text);
    v.z = truth_number(text);
    return v;
}

static tahr_quat read_quat(char **text)
{
    tahr_quat q;

    q.x = truth_number(text);
    q.y = truth_number(text);
    q.z = truth_number(text);
    q.w = truth_number(text);
    return q;
}

void truth_read_body(char kind, char *text, truth_body *out)
{
    tahr_body_desc *d = &out->desc;
    score_body *judged = &out->judged;

    tahr_body_desc_init(d, sizeof *d, kind == 'b' ? TAHR_BODY_BOX : kind == 's' ? TAHR_BODY_HULL : TAHR_BODY_MESH);
    int loop = kind == 'l' ? (int)truth_number(&text) : 0;
    if (kind == 'b') {
        d->half_extents = truth_vec(&text);
        d->pose.position = truth_vec(&text);
        d->pose.orientation = read_quat(&text);
    }
    *judged = (score_body){
        .vertices = out->vertices, .indices = out->indices, .flags = kind == 'm' || kind == 'l' ? 0 : SCORE_SOLID};
    judged->vertex_count = (uint32_t)truth_number(&text);
    judged->triangle_count = (uint32_t)truth_number(&text);
    if (judged->vertex_count > TRUTH_MAX_VERTICES || judged->triangle_count > TRUTH_MAX_TRIANGLES) {
        refuse("more vertices or triangles than there is room for, before", text);
    }
    for (uint32_t i = 0; i < judged->vertex_count * 3; i++) {
        out->vertices[i] = truth_number(&text);
    }
    for (uint32_t i = 0; i < judged->triangle_count * 3; i++) {
        out->indices[i] = (uint32_t)truth_number(&text);
    }
    if (kind != 'b') {
        d->vertices = out->vertices;
        d->vertex_count = judged->vertex_count;
    }
    if (kind == 'm' || kind == 'l') {
        d->flags = TAHR_BODY_TWO_SIDED;
        d->indices = out->indices;
        d->triangle_count = judged->triangle_count;
    }
    out->flat = *d;
    if (kind == 'l') {
        out->flat.type = TAHR_BODY_CHAIN;
        out->flat.flags |= loop ? TAHR_BODY_LOOP : 0u;
        out->flat.vertex_count = judged->vertex_count / 2; /* those at -z; a chain has no z */
        out->flat.indices = NULL;
        out->flat.triangle_count = 0;
    }
}

static void read_case(char *text, int line, truth_case *out)
{
    tahr_sweep *q = &out->query;
    score_truth *t = &out->truth;

    memset(out, 0, sizeof *out);
    out->line = line;
    q->shape.type = (uint32_t)truth_number(&text);
    q->shape.radius = truth_number(&text);
    q->shape.half_height = truth_number(&text);
    q->shape.half_x = truth_number(&text);
    q->shape.half_y = truth_number(&text);
    q->position = truth_vec(&text);
    q->up = truth_vec(&text);
    q->orientation = read_quat(&text);
    q->motion = truth_vec(&text);
    q->margin = truth_number(&text);
    q->mask = 0xFFFFFFFFu;
    q->ignore_body = TAHR_NO_BODY;
    t->status = (uint32_t)truth_number(&text);
    t->start_gap = truth_number(&text);
    t->start_normal = truth_vec(&text);
    t->fraction = truth_number(&text);
    t->min_gap = truth_number(&text);
    t->normal = truth_vec(&text);
}

FILE *truth_open(const char *name)
{
    char path[1024];

    snprintf(path, sizeof path, "%s/tests/accuracy/truth/%s.txt", TAHR_SOURCE_DIR, name);
    FILE *file = fopen(path, "r");
    if (!file) {
        refuse("cannot read", path);
    }
    return file;
}

int truth_each(const char *family, truth_fn each, void *user)
{
    static char line[65536];
    static truth_body body;
    FILE *file = truth_open(family);
    int cases = 0, is_new = 0;

    for (int number = 1; fgets(line, sizeof line, file); number++) {
        if (line[0] == 'm' || line[0] == 's' || line[0] == 'b' || line[0] == 'l') {
            truth_read_body(line[0], line + 1, &body);
            is_new = 1;
        } else if (line[0] == 'c') {
            truth_case c;
            read_case(line + 1, number, &c);
            each(user, &body, is_new, &c);
            is_new = 0;
            cases++;
        } else if (line[0] != '#') {
            refuse("a line that begins with none of m, s, b, l, c and #", line);
        }
    }
    fclose(file);
    return cases;
}
