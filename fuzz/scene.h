/* SPDX-License-Identifier: MIT
 * scene.h: bytes as a scene: bodies from a lattice, so that about half of all coordinates coincide exactly, and the
 * rest nearly. */
#ifndef TAHR_FUZZ_SCENE_H
#define TAHR_FUZZ_SCENE_H

#include <tahr/tahr.h>

#include "bytes.h"

enum { SCENE_BODIES = 24, SCENE_TRIANGLES = 64 };

/* What a scene may hold. */
enum { SCENE_SENSORS = 1, SCENE_MOVERS = 2, SCENE_FLUIDS = 4, SCENE_TWO_SIDED = 8, SCENE_NEAR = 16 };

typedef struct scene {
    tahr_body_desc bodies[SCENE_BODIES];
    double vertices[9 * SCENE_TRIANGLES];
    uint32_t indices[3 * SCENE_TRIANGLES];
    uint32_t body_count;
    double scale;     /* a power of two */
    tahr_vec3 origin; /* m */
    uint32_t movers;  /* bodies with TAHR_BODY_MOVABLE */
} scene;

/* Reads a scene of at most 12 solids and one mesh. allowed: SCENE_*; TWO_SIDED: meshes always are; NEAR: scale 1 near
 * the origin. */
void scene_read(scene *s, bytes *b, uint32_t allowed);

/* A point of the lattice, or beside it, as scene_read's. */
tahr_vec3 scene_point(const scene *s, bytes *b);

/* A world on a backend; NULL if it is refused. */
tahr_world *scene_open(const scene *s, const struct tahr_backend *backend, const void *options);

/* A shape and settings of the scene's size. 0: they do not exist at that size. */
int scene_config(const scene *s, bytes *b, tahr_config *config);

#endif
