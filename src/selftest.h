/* SPDX-License-Identifier: MIT
 * selftest.h: the laboratory of the conformance kit: one small world, one shape, and questions whose answers are known
 * in closed form.
 *
 * Scenes are drawn in the plane of a side view, u to the right and v along up, in metres for a character 1.8 m high:
 * the lab turns them into x and y with up = +y on a planar backend, into x and z with up = +z elsewhere, where they are
 * extruded along y; it multiplies them by its scale and moves them to its origin. */
#ifndef TAHR_CORE_SELFTEST_H
#define TAHR_CORE_SELFTEST_H

#include <tahr/selftest.h>

#include "core.h"

enum { TAHR__LAB_BODIES = 48, TAHR__LAB_VERTICES = 256, TAHR__LAB_INDICES = 768 };

/* What scenes are made of. */
enum { TAHR__OF_BOXES = 0, TAHR__OF_MESHES = 1, TAHR__OF_CHAINS = 2, TAHR__MATERIALS = 3 };

typedef struct tahr__lab {
    const tahr_backend *backend; /* NULL with desc.open */
    const tahr_selftest_desc *desc;
    uint32_t claims; /* TAHR_CAP_* */
    uint32_t planar;
    tahr_world *world; /* or NULL */
    tahr_query_context context;
    void *cache;
    size_t cache_size;

    /* The scene that open will open. */
    tahr_body_desc bodies[TAHR__LAB_BODIES];
    double vertices[3 * TAHR__LAB_VERTICES];
    uint32_t indices[TAHR__LAB_INDICES];
    uint32_t body_count, vertex_count, index_count;
    double scale;
    vec3 origin; /* m */
    uint32_t material;

    /* What asks. */
    tahr_shape shape;
    const char *shape_name;
    double margin; /* m, already scaled */

    /* What was found: the first failure, or the last success. */
    uint32_t verdict; /* TAHR_SELFTEST_* */
    uint32_t checks;
    double number; /* that the case is about just now, for the texts */
    char expected[256], actual[256], message[160];
} tahr__lab;

typedef struct tahr__lab_case {
    const char *name;
    uint32_t needs; /* TAHR_CAP_*, all of them */
    void (*run)(tahr__lab *lab);
} tahr__lab_case;

/* The cases of one theme, in order. */
typedef struct tahr__lab_theme {
    const tahr__lab_case *cases;
    size_t count;
} tahr__lab_theme;

extern const tahr__lab_theme tahr__lab_sweeps, tahr__lab_edges, tahr__lab_places, tahr__lab_shapes, tahr__lab_answers,
    tahr__lab_filters, tahr__lab_random, tahr__lab_walks, tahr__lab_one_way, tahr__lab_bodies;

/* Scenes (selftest_scene.c). All lengths are scaled; a body is the caller's to change until the world is opened. */
/* Closes the world, forgets scene, scale, origin and margin; shape and material stay. */
void tahr__lab_clear(tahr__lab *lab);
int tahr__lab_open(tahr__lab *lab); /* 0: it could not, and the case has failed */
vec3 tahr__lab_at(const tahr__lab *lab, double u, double v);
vec3 tahr__lab_along(const tahr__lab *lab, double u, double v);  /* a vector: scaled, not moved */
vec3 tahr__lab_toward(const tahr__lab *lab, double u, double v); /* neither */
vec3 tahr__lab_up(const tahr__lab *lab);
tahr_quat tahr__lab_upright(const tahr__lab *lab);
tahr_body_desc *tahr__lab_body(tahr__lab *lab, uint32_t type);
/* Of the lab's material, solid, from one corner to the other. */
tahr_body_desc *tahr__lab_block(tahr__lab *lab, double u0, double v0, double u1, double v1);
/* The same of boxes or meshes with an extent of their own along the third axis; not in a plane. */
tahr_body_desc *tahr__lab_block3(tahr__lab *lab, vec3 low, vec3 high);
/* A large flat face through (0, 0) with that unit normal; beyond 10 m from there it ends. */
tahr_body_desc *tahr__lab_plane(tahr__lab *lab, double normal_u, double normal_v);
/* An empty mesh or chain, its corners in scaled coordinates of the world's axes, relative to the lab's origin. */
void tahr__lab_corner(tahr__lab *lab, tahr_body_desc *body, double x, double y, double z);
void tahr__lab_triangle(tahr__lab *lab, tahr_body_desc *mesh, uint32_t a, uint32_t b, uint32_t c);

/* Shapes and materials that the backend claims. next begins at *at = 0 and returns 0 after the last. */
int tahr__lab_next(tahr__lab *lab, uint32_t *at, uint32_t shapes);
int tahr__lab_first_shape(tahr__lab *lab, uint32_t shapes); /* the first of TAHR_CAP_* in shapes; 0: none */
int tahr__lab_take(tahr__lab *lab, uint32_t capability);    /* that shape; 0: not claimed */
/* Scales the shape and what is drawn from now on, and moves it there. */
void tahr__lab_resize(tahr__lab *lab, double factor, vec3 origin);
/* How far the shape reaches along a unit vector of the world. */
double tahr__lab_reach(const tahr__lab *lab, vec3 toward);
/* m: what a distance may be off by, for the lab's scale. */
double tahr__lab_slack(const tahr__lab *lab);

/* Questions (selftest_ask.c). The shape at (u, v), moving by (mu, mv). */
tahr_sweep tahr__lab_sweep(const tahr__lab *lab, double u, double v, double mu, double mv);
/* Asks for the blocking hit; 0: a status that ends the case. Free: *hit is zero but for fraction 1. */
int tahr__lab_ask(tahr__lab *lab, const tahr_sweep *query, tahr_hit *hit);
/* Asks for more; returns the count. status may be TAHR_TRUNCATED. */
uint32_t tahr__lab_ask_all(tahr__lab *lab, const tahr_sweep *query, tahr_hit *hits, uint32_t capacity,
                           tahr_status *status);
uint32_t tahr__lab_touch(tahr__lab *lab, const tahr_sweep *at, double margin, uint32_t flags, tahr_contact *contacts,
                         uint32_t capacity, tahr_status *status);
int tahr__lab_ray(tahr__lab *lab, vec3 from, vec3 motion, tahr_hit *hit);

/* Claims. Each asks, compares, and notes what was expected and what came. what: a word on the situation. */
void tahr__lab_free(tahr__lab *lab, const tahr_sweep *query, const char *what);
/* It stops there, against that contact normal. fraction is the exact one. */
void tahr__lab_stops(tahr__lab *lab, const tahr_sweep *query, double fraction, vec3 normal, const char *what);
void tahr__lab_overlaps(tahr__lab *lab, const tahr_sweep *query, double depth, vec3 normal, const char *what);
/* Any other: format and the rest say what came. Returns good. */
int tahr__lab_check(tahr__lab *lab, int good, const char *expected, const char *format, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 4, 5)))
#endif
    ;
/* There is no such thing here: the case ends as not supported unless something was checked before. */
void tahr__lab_lacks(tahr__lab *lab, const char *what);
int tahr__lab_same_direction(const tahr__lab *lab, vec3 a, vec3 b);

static inline int lab_goes_on(const tahr__lab *lab)
{
    return lab->verdict != TAHR_SELFTEST_FAIL;
}

#define TAHR__LAB_ROUND (TAHR_CAP_SPHERE | TAHR_CAP_CAPSULE)
#define TAHR__LAB_USUAL (TAHR_CAP_SPHERE | TAHR_CAP_CAPSULE | TAHR_CAP_BOX)
#define TAHR__LAB_ALL (TAHR__LAB_USUAL | TAHR_CAP_CYLINDER | TAHR_CAP_CONE | TAHR_CAP_ELLIPSOID | TAHR_CAP_HULL)

#endif
