/* SPDX-License-Identifier: MIT
 * truth_file.h: reads the stored truth of sweeps (truth/<family>.txt, made by make_truth.c) and of slides
 * (truth/slides.txt, made by make_slide.c). */
#ifndef TAHR_ACCURACY_TRUTH_FILE_H
#define TAHR_ACCURACY_TRUTH_FILE_H

#include <stdio.h>

#include <tahr/tahr.h>

#include "score.h"

enum { TRUTH_MAX_VERTICES = 64, TRUTH_MAX_TRIANGLES = 64 };

/* One body, as it is judged and as a world takes it. */
typedef struct truth_body {
    double vertices[TRUTH_MAX_VERTICES * 3];
    uint32_t indices[TRUTH_MAX_TRIANGLES * 3];
    score_body judged;
    tahr_body_desc desc; /* a mesh that blocks from both sides, a hull, or a box; its arrays are those above */
    tahr_body_desc flat; /* of an outline in the plane: the chain, for worlds of two dimensions; else as desc */
} truth_body;

typedef struct truth_case {
    tahr_sweep query;
    score_truth truth;
    int line;
} truth_case;

/* Calls with every case of a family of the sources' folder, in order; body is the one that the case is about, and is
 * another one where is_new is 1. Aborts with a message on files that cannot be read. Returns how many. */
typedef void (*truth_fn)(void *user, const truth_body *body, int is_new, const truth_case *c);
int truth_each(const char *family, truth_fn each, void *user);

/* Names of all families, then NULL; and of those that happen in the plane of x and y, for backends of both kinds. */
extern const char *const TRUTH_FAMILIES[], *const TRUTH_PLANE_FAMILIES[];

enum { TRUTH_MAX_BODIES = 16 };

/* One slide: a scene, who wants to go where in it, and the path that is right: at every moment the velocity nearest to
 * wish that leads into nothing that is touched, where "touched" is at the distance margin. */
typedef struct truth_slide {
    char name[32]; /* "edge_capsule" */
    const tahr_body_desc *descs;
    score_scene scene;
    tahr_shape shape;
    tahr_vec3 position, up, wish; /* wish: m/s */
    double margin;                /* m: 0, or the skin of a character that is to go this way */
    double duration;              /* s */
    int curved;                   /* 1: a part of it goes around an edge or a vertex: no polygon */
    double first_order;           /* m: how far off a scheme of first order with steps of 1/64 s is at most */
    score_reference path;
} truth_slide;

/* Calls with every slide; what it is given is valid during the call. Aborts with a message on a file that cannot be
 * read. Returns how many. */
typedef void (*truth_slide_fn)(void *user, const truth_slide *slide);
int truth_each_slide(truth_slide_fn each, void *user);

/* A body of a line of a file, after its first letter kind (m, s, b, l). */
void truth_read_body(char kind, char *text, truth_body *out);

/* tests/accuracy/truth/<name>.txt of the sources; aborts where it cannot be read. */
FILE *truth_open(const char *name);

/* The next number of a text, in hex floats or decimals; aborts where there is none. */
double truth_number(char **text);
tahr_vec3 truth_vec(char **text);

#endif
