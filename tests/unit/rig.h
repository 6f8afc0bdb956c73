/* SPDX-License-Identifier: MIT
 * rig.h: a mover over a world, with everything that a step takes and gives. */
#ifndef RIG_H
#define RIG_H

#include "fake_backend.h"
#include "fake_host.h"
#include "fake_world.h"
#include "near.h"

#include <tahr/native.h>

/* What does not depend on the frame rate is tested at all of these, in Hz. */
enum { RIG_RATES = 5 };
extern const double rig_rates[RIG_RATES];

enum { RIG_EVENTS = 64, RIG_DECISIONS = 512 };
typedef struct rig {
    tahr_world *world;
    tahr_mover *mover;
    tahr_config config;
    tahr_input input;
    tahr_state state;
    tahr_report report; /* of the last step, with room for all that it can say */
    tahr_event events[RIG_EVENTS];
    tahr_decision decisions[RIG_DECISIONS];
    tahr_status status;
    double time;  /* s stepped so far */
    fake_log log; /* of the world */
} rig;

/* The preset. */
tahr_config rig_config(void);

/* Each opens a world and makes a character at `at`, in the air. config NULL: the preset. Fails the test if it fails. */
void rig_open(rig *r, fake_world *world, const tahr_config *config, tahr_vec3 at);
void rig_open_callbacks(rig *r, const tahr_callbacks *callbacks, const tahr_config *config, tahr_vec3 at);
/* Bodies of the native backend, for what no half-space or box can show. */
void rig_open_bodies(rig *r, const tahr_body_desc *bodies, uint32_t count, const tahr_config *config, tahr_vec3 at);
/* The same on another backend. */
void rig_open_bodies_on(rig *r, const tahr_backend *backend, const tahr_body_desc *bodies, uint32_t count,
                        const tahr_config *config, tahr_vec3 at);
/* On the native backend with a description of its own. */
void rig_open_native(rig *r, const tahr_native_desc *native, const tahr_body_desc *bodies, uint32_t count,
                     const tahr_config *config, tahr_vec3 at);
/* Makes the backend too; the character is the preset's, 5 cm over the backend's plane z = 0. */
void rig_open_backend(rig *r, fake_backend *backend, uint32_t capabilities);
/* rig_open, and lets it fall until it stands. */
void rig_stand(rig *r, fake_world *world, const tahr_config *config, tahr_vec3 at);
void rig_close(rig *r);

/* One step; fails the test on an error status. Returns the status. */
tahr_status rig_step(rig *r, double dt);
/* n steps. */
void rig_steps(rig *r, int n, double dt);
/* Steps without input at 60 Hz until walking with zero velocity, twice the same bits. */
void rig_settle(rig *r);
/* The first event of a type in the last report, or NULL. */
const tahr_event *rig_event(const rig *r, uint32_t type);
/* Every event of the last report lies within the step, none before the one reported earlier. */
void rig_assert_in_order(const rig *r, double dt);
/* The last decision of a rule in the last report, or NULL. */
const tahr_decision *rig_decision(const rig *r, uint32_t rule);

#endif
