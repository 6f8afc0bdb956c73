/* SPDX-License-Identifier: MIT
 * scene_backend.h: the backends that scenes are run on, and what each of them promises. */
#ifndef TAHR_TEST_SCENE_BACKEND_H
#define TAHR_TEST_SCENE_BACKEND_H

#include <tahr/box2d.h>
#include <tahr/native.h>
#include <tahr/tahr.h>

typedef struct scene_backend {
    const char *name;
    const tahr_backend *(*get)(void);
    int native;         /* takes a tahr_native_desc */
    uint32_t engine;    /* which Box2D */
    double clearance;   /* of skin: what must stay free after every move */
    double slack;       /* m, below that */
    double gap_error;   /* m, of a sweep */
    double penetration; /* m, deepest allowed while wandering */
    double drift;       /* m, off the exact path after sliding to rest between surfaces */
    double push;        /* m, who pushes and gets nowhere may move; 0: not by one bit, as always without input */
    int planar;         /* a world of two dimensions: only scenes that say so */
} scene_backend;

enum { SCENE_MAX_BACKENDS = 4 };

/* The backends of this build, those of three dimensions. */
extern const scene_backend SCENE_BACKENDS[];
extern const int SCENE_BACKEND_COUNT;

/* Those of two. One more than the count, so that there may be none. */
extern const scene_backend SCENE_PLANAR_BACKENDS[];
extern const int SCENE_PLANAR_BACKEND_COUNT;

/* Room for what a backend's own description is. */
typedef union scene_options {
    tahr_native_desc native;
    tahr_box2d_desc box2d;
} scene_options;

/* What tahr_world_desc.options has to be for a backend: room, filled in, or NULL. */
const void *scene_backend_options(const scene_backend *backend, scene_options *room);

/* Opens bodies on a backend. options, for native only, may be NULL. */
tahr_status scene_backend_open(const scene_backend *backend, const tahr_body_desc *bodies, uint32_t count,
                               const tahr_native_desc *options, tahr_world **world);

#endif
