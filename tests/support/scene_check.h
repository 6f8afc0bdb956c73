/* SPDX-License-Identifier: MIT
 * scene_check.h: the expectations of a scene, checked on the record of a run. */
#ifndef TAHR_TEST_SCENE_CHECK_H
#define TAHR_TEST_SCENE_CHECK_H

#include "scene_run.h"

/* What an expectation is checked against. */
typedef struct scene_case {
    scene *scene;
    const scene_backend *backend;
    double rate;
    const scene_record *record;
    json_t *item;      /* the expectation */
    char failure[256]; /* empty: it holds */
} scene_case;

/* Runs a scene and checks everything it expects. Returns 1, or 0 with the first violation in failure (capacity 256). */
int scene_check(scene *s, const scene_backend *backend, double rate, char *failure);

/* Says what is violated, once. Returns 0. */
int scene_violated(scene_case *c, double time, const char *what, double value, double limit);

/* Optional members of an expectation. */
double scene_member(scene_case *c, const char *key, double fallback);
int scene_in_window(scene_case *c, const scene_sample *sample);

/* "slide": the displacement of every step is that of the same step without walls, projected onto the walls it meets. */
int scene_check_slide(scene_case *c);

#endif
