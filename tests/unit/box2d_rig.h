/* SPDX-License-Identifier: MIT
 * box2d_rig.h: a character in a plane: a scene on either engine of the box2d backend, up = +y, motion held in z = 0. */
#ifndef BOX2D_RIG_H
#define BOX2D_RIG_H

#include "fake_host.h"

#include <tahr/tahr.h>

typedef struct box2d_rig {
    tahr_world *world;
    tahr_mover *mover;
    tahr_config config;
    tahr_input input;
    tahr_state state;
    tahr_report report;
    tahr_event events[64];
    uint32_t hits; /* TAHR_EVENT_HIT so far */
    fake_log log;
} box2d_rig;

/* The engines of this build, TAHR_BOX2D_2 and _3. Returns how many. */
int box2d_engines(uint32_t engines[2]);

tahr_body_desc box2d_box(double x, double y, double half_width, double half_height);
/* A chain through count corners of 3 doubles each; not copied. */
tahr_body_desc box2d_chain(const double *corners, uint32_t count);

/* The preset PRECISE in the plane z = 0 with gravity along -y. */
tahr_config box2d_config(void);

/* Opens a world; fails the test if it fails. */
tahr_world *box2d_open(uint32_t engine, const tahr_body_desc *bodies, uint32_t count, fake_log *log);
/* And a character in it, in the air at x, y. */
void box2d_rig_open(box2d_rig *r, uint32_t engine, const tahr_body_desc *bodies, uint32_t count,
                    const tahr_config *config, double x, double y);
void box2d_rig_close(box2d_rig *r);
/* n steps; fails the test on an error status. */
void box2d_rig_steps(box2d_rig *r, int n, double dt);

#endif
