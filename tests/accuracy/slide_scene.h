/* SPDX-License-Identifier: MIT
 * slide_scene.h: the scenes of make_slide.c: planes, gutters, wedges, corners, edges, steps, random polyhedra. z is
 * up. */
#ifndef TAHR_TRUTH_SLIDE_SCENE_H
#define TAHR_TRUTH_SLIDE_SCENE_H

#include "slide_catch.h"
#include "truth_solid.h"

typedef struct {
    char name[32];
    mesh bodies[MAX_BODIES];
    int body_count;
    query character; /* position: at the start; margin as asked for */
    dvec u;          /* m/s */
    double duration; /* s */
} slide_scene;

/* m: half the size of what stands for an endless plane. */
static const double ENDLESS = 32;

static const double DEGREE = 0.017453292519943295;

/* A square through p across n, turned about n by angle (where its diagonal runs). Vertices are rounded to 2^-20 m, and
 * what is true is what they say. */
static void add_plane(slide_scene *s, dvec p, dvec n, double angle)
{
    mesh *m = &s->bodies[s->body_count++];
    dvec a = unit(fabs(n.x) < 0.6 ? cross(n, (dvec){1, 0, 0}) : cross(n, (dvec){0, 1, 0})), b = cross(unit(n), a);
    dvec c = add(scaled(a, cos(angle) * ENDLESS), scaled(b, sin(angle) * ENDLESS)), d = cross(unit(n), c);

    memset(m, 0, sizeof *m);
    for (int i = 0; i < 4; i++) {
        dvec v = add(p, scaled(i % 2 ? d : c, i < 2 ? 1 : -1));
        v = round_vec(v, FINE);
        vertex(m, v.x, v.y, v.z);
    }
    m->flat = 1;
    face(m, 0, 1, 2), face(m, 0, 2, 3);
}

/* An upright wall through (x, y), exactly upright, whose front looks to the left of who goes at this angle to x. */
static void add_wall(slide_scene *s, double x, double y, double angle)
{
    mesh *m = &s->bodies[s->body_count++];
    dvec a = round_vec((dvec){cos(angle) * ENDLESS, sin(angle) * ENDLESS, 0}, FINE);

    memset(m, 0, sizeof *m);
    for (int i = 0; i < 4; i++)
        vertex(m, i % 3 ? x + a.x : x - a.x, i % 3 ? y + a.y : y - a.y, i < 2 ? -ENDLESS : ENDLESS);
    m->flat = 1;
    face(m, 0, 1, 2), face(m, 0, 2, 3);
}

static void add_block(slide_scene *s, dvec lo, dvec hi)
{
    mesh *m = &s->bodies[s->body_count++];
    static const int sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

    memset(m, 0, sizeof *m);
    m->solid = 1;
    for (int i = 0; i < 8; i++)
        vertex(m, i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z);
    for (int i = 0; i < 6; i++)
        face(m, sides[i][0], sides[i][1], sides[i][2]), face(m, sides[i][0], sides[i][2], sides[i][3]);
}

static void begin(slide_scene *s, const char *name, int kind, dvec at, dvec u)
{
    query *q = &s->character;

    memset(s, 0, sizeof *s);
    snprintf(s->name, sizeof s->name, "%s", name);
    q->type = kind == SPHERE ? 1 : kind == CAPSULE ? 2 : 3;
    q->radius = kind == BOX ? 0 : 0.375;
    q->half_height = kind == SPHERE ? 0.375 : 0.875;
    q->half_x = kind == BOX ? 0.25 : 0;
    q->half_y = kind == BOX ? 0.375 : 0;
    q->up = (dvec){0, 0, 1};
    q->quat[3] = 1;
    q->position = at;
    s->u = u;
    s->duration = 1;
}

static const char *const kind_names[] = {"sphere", "capsule", NULL, "box"};

static void named(slide_scene *s, const char *what, int kind, dvec at, dvec u)
{
    char name[32];
    snprintf(name, sizeof name, "%s_%s", what, kind_names[kind]);
    begin(s, name, kind, at, u);
}

/* 8 x 8 m of quads of 0.5 m at z = 0: seams and nothing else. */
static void seams(slide_scene *s, int kind)
{
    named(s, "seams", kind, (dvec){-1.75, -1.25, 1}, (dvec){3.5, 2.25, -1});
    mesh *m = &s->bodies[s->body_count++];
    memset(m, 0, sizeof *m);
    grid(m, 5, 0.75, 0);
    m->flat = 1;
}

static void plane(slide_scene *s, int kind)
{
    named(s, "plane", kind, (dvec){-1, 0.5, 1.5}, (dvec){3, 1, -2.5});
    add_plane(s, (dvec){0, 0, 0}, (dvec){0.28, -0.16, 1}, 0.3);
}

static void crease(slide_scene *s, int kind)
{
    named(s, "crease", kind, (dvec){-0.5, 0.25, 1.75}, (dvec){2, 3, -3});
    add_plane(s, (dvec){0, 0, 0}, (dvec){0, 0, 1}, 0.3);
    add_wall(s, 0, 2, -0.3);
}

/* The gutter in which clipping by one plane after the other drifts. */
static void gutter(slide_scene *s, int kind)
{
    named(s, "gutter", kind, (dvec){0.5, -3, 2.75}, (dvec){0.5, 3, -5});
    add_plane(s, (dvec){0, 0, 0}, (dvec){0.6, -0.62, 0.5}, 0.3);
    add_plane(s, (dvec){0, 0, 0}, (dvec){-0.6, -0.62, 0.5}, 0.2);
}

/* Two walls that meet at the z axis at an angle, and who goes in between them off the middle: stuck, or down along. */
static void wedge(slide_scene *s, int kind, double degrees, double sink)
{
    char name[32];
    double half = degrees * DEGREE / 2, depth = rounded(0.75 / sin(half), DYADIC);
    snprintf(name, sizeof name, "wedge_%g%s", degrees, sink != 0 ? "_along" : "");
    named(s, name, kind, (dvec){depth, 0.25, 0}, (dvec){-fmax(0.75 * depth, 3), 0.75, sink});
    add_wall(s, 0, 0, half);
    add_wall(s, 0, 0, -half);
}

/* A floor and two walls 30 degrees apart. */
static void three_planes(slide_scene *s, int kind)
{
    named(s, "three", kind, (dvec){3, 0.25, 1.5}, (dvec){-4, 0.5, -2});
    add_plane(s, (dvec){0, 0, 0}, (dvec){0, 0, 1}, 0.3);
    add_wall(s, 0, 0, 15 * DEGREE);
    add_wall(s, 0, 0, -15 * DEGREE);
}

/* Walls at 30 and 5 degrees to the way, which is between them: the corner of ping-pong. */
static void acute(slide_scene *s, int kind)
{
    named(s, "acute", kind, (dvec){-1.5, 0.75, 0}, (dvec){4.5, 0.75, 0});
    add_wall(s, 0, 0, -5 * DEGREE);
    add_wall(s, 0, 1.5, -30 * DEGREE);
}

/* Over the edge of a table, and down. */
static void edge(slide_scene *s, int kind)
{
    named(s, "edge", kind, (dvec){-1.25, 0.25, 1.5}, (dvec){2, 0.5, -2});
    add_block(s, (dvec){-4, -4, -8}, (dvec){0, 4, 0});
}

/* Over a corner of three faces, off all its symmetries. */
static void corner_point(slide_scene *s, int kind)
{
    named(s, "vertex", kind, (dvec){-0.25, -0.125, kind == SPHERE ? 1.75 : 2.25}, (dvec){0.75, 0.375, -3});
    add_block(s, (dvec){-4, -4, -8}, (dvec){0, 0, 0});
}

/* Into a step of 0.2 m: a round foot rolls up over its edge. */
static void step(slide_scene *s, int kind)
{
    named(s, "step", kind, (dvec){-1.5, 0, kind == SPHERE ? 0.75 : 1.25}, (dvec){4, 0.25, -1});
    add_block(s, (dvec){-8, -8, -4}, (dvec){8, 8, 0});
    add_block(s, (dvec){0, -8, -4}, (dvec){8, 8, 0.1875});
}

static void stair(slide_scene *s, int kind)
{
    named(s, "stairs", kind, (dvec){-1, 0, kind == SPHERE ? 0.75 : 1.25}, (dvec){4, 0.25, -1});
    add_block(s, (dvec){-8, -8, -4}, (dvec){8, 8, 0});
    for (int i = 0; i < 4; i++)
        add_block(s, (dvec){i * 0.5, -8, -4}, (dvec){8, 8, 0.125 * (i + 1)});
}

/* Hulls and boxes around the way, far enough apart that no crease is curved; the maker throws away those where one is
 * met all the same. */
static void polyhedra(slide_scene *s, int kind, int index)
{
    char name[32];
    snprintf(name, sizeof name, "random_%d", index);
    named(s, name, kind, round_vec((dvec){-3, uniform(-0.5, 0.5), uniform(-0.5, 0.5)}, DYADIC),
          round_vec((dvec){4, uniform(-1, 1), uniform(-1, 1)}, DYADIC));
    s->duration = 1.5;
    for (int i = 0; i < 4; i++) {
        mesh *m = &s->bodies[s->body_count++];
        dvec at = round_vec((dvec){-1.25 + 1.75 * i, uniform(-1, 1), uniform(-1, 1)}, DYADIC);
        make_solid(m, SOLID_HULL, uniform(0.75, 1.5), DYADIC, 0);
        for (int j = 0; j < m->vertex_count; j++)
            m->vertices[j] = add(m->vertices[j], at);
    }
}

#endif
