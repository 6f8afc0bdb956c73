/* SPDX-License-Identifier: MIT
 * scene_run.h: runs a scene on a backend at a rate and remembers every step. */
#ifndef TAHR_TEST_SCENE_RUN_H
#define TAHR_TEST_SCENE_RUN_H

#include "scene_backend.h"
#include "scene_file.h"

typedef struct scene_sample {
    double time, dt; /* s; time is the end of the step */
    tahr_state state;
    double clearance;   /* m to the nearest thing that blocks, at most 2 skin */
    double immersion;   /* part of its axis that is in a fluid */
    double step_offset; /* m */
    uint32_t sweeps, queries, flags;
    tahr_input input;
} scene_sample;

typedef struct scene_record {
    scene_sample *samples; /* [0] is the start, after settling */
    int count, capacity;
    tahr_event *events; /* times count from the start of the scene */
    int event_count, event_capacity;
    double cuts[SCENE_MAX_INPUTS + 32]; /* times at which a step must end */
    int cut_count;
    char error[256]; /* what went wrong, or empty */
} scene_record;

/* Everything in the scene, start, bodies, gravity and inputs, is taken into a frame: turned and then shifted. Returns 0
 * if the run ended early: r->error says why. */
int scene_run(scene *s, const scene_backend *backend, double rate, const tahr_pose *frame, scene_record *r);
void scene_record_free(scene_record *r);

/* The vector turned by a unit quaternion, and the other way round. */
tahr_vec3 scene_turn(tahr_quat q, tahr_vec3 v);
tahr_vec3 scene_turn_back(tahr_quat q, tahr_vec3 v);

/* A step must end at this time. Call before scene_run, on a zeroed record. */
void scene_record_cut(scene_record *r, double time);

#endif
