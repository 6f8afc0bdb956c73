/* SPDX-License-Identifier: MIT
 * scene_file.h: a movement scene as data. The schema is in tests/scenes/README.md. */
#ifndef TAHR_TEST_SCENE_FILE_H
#define TAHR_TEST_SCENE_FILE_H

#include <jansson.h>
#include <tahr/tahr.h>

#include "scene_expr.h"
#include "scene_mesh.h"

enum { SCENE_MAX_BODIES = 32, SCENE_MAX_INPUTS = 64, SCENE_MAX_RATES = 8 };

typedef struct scene_input {
    double time; /* s, from when on */
    tahr_input input;
} scene_input;

/* How a body moves: offsets from its place as formulas of "t". */
enum { SCENE_PATH = 5 }; /* x y z, yaw and tilt in degrees */
typedef struct scene_path {
    int moves;
    json_t *along[SCENE_PATH]; /* borrowed */
    double teleport;           /* s at which it jumps, or < 0 */
} scene_path;

typedef struct scene {
    char name[128]; /* file, and the values of what is varied */
    char error[256];
    json_t *root;   /* owned */
    json_t *expect; /* borrowed from root */
    scene_names names;
    tahr_config config;
    tahr_body_desc bodies[SCENE_MAX_BODIES];
    scene_mesh meshes[SCENE_MAX_BODIES];
    tahr_body_desc flat[SCENE_MAX_BODIES]; /* a chain, as planar backends take it; type 0: bodies[] does for all */
    scene_mesh lines[SCENE_MAX_BODIES];    /* its vertices */
    scene_path paths[SCENE_MAX_BODIES];
    uint32_t body_count;
    tahr_vec3 position, velocity;
    int settle;         /* stand still first until the floor is found */
    int planar;         /* may run on planar backends */
    int may_be_crushed; /* "allow": "crushed" */
    double duration;
    scene_input inputs[SCENE_MAX_INPUTS];
    int input_count;
    double rates[SCENE_MAX_RATES];
    int rate_count;
} scene;

/* How many scenes a file holds: one per combination of what it varies. -1: unreadable, see error (capacity 256). */
int scene_count(const char *path, char *error);

/* Reads one of them. Returns 0 if it is malformed: s->error says why. Free it in both cases. */
int scene_read(scene *s, const char *path, int variant);
void scene_free(scene *s);

/* Values inside a scene: numbers, or formulas over its names. Return 0 and set s->error if they are none. */
int scene_number(scene *s, json_t *value, double *number);
int scene_vec3(scene *s, json_t *value, tahr_vec3 *vector);

#endif
