/* SPDX-License-Identifier: MIT
 * sensor_rig.h: a rig over a floor and boxes that are sensors, on the native backend, on libccd, or on callbacks. */
#ifndef SENSOR_RIG_H
#define SENSOR_RIG_H

#include "rig.h"

enum { ON_NATIVE, ON_CALLBACKS, ON_CCD, SENSOR_BACKENDS };
enum { SENSOR_BODIES = 16 };

/* Body 0 is a floor of 128 m x 128 m with its top at z = 0; the others come with sensor_box. */
typedef struct sensor_rig {
    rig r;
    int backend;
    tahr_body_desc bodies[SENSOR_BODIES];
    uint32_t count;
    fake_world solid, sensors; /* of callbacks; a sensor's body is 1 + its index there */
} sensor_rig;

/* Built without libccd, there is one fewer. */
int sensor_backends(void);

void sensor_begin(sensor_rig *s, int backend);
/* An axis-aligned box, movable; returns its body. */
uint32_t sensor_box(sensor_rig *s, tahr_vec3 min, tahr_vec3 max);
/* The same, tall and wide enough to be met by its faces across x alone. */
uint32_t sensor_gate(sensor_rig *s, double from, double to);
/* Opens the world; config NULL: the preset. */
void sensor_open(sensor_rig *s, const tahr_config *config, tahr_vec3 at);
void sensor_close(sensor_rig *s);
/* Puts a sensor's centre elsewhere, on every backend. */
void sensor_put(sensor_rig *s, uint32_t body, tahr_vec3 centre);

/* The n-th event of a type for a body in the last report, or NULL. */
const tahr_event *sensor_event(const rig *r, uint32_t type, uint32_t body);
/* How many there are, of any body. */
int sensor_events(const rig *r, uint32_t type);

#endif
