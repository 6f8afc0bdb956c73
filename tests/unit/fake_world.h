/* SPDX-License-Identifier: MIT
 * fake_world.h: worlds of half-spaces and boxes whose answers are closed forms, and a character to walk in them. */
#ifndef FAKE_WORLD_H
#define FAKE_WORLD_H

#include <tahr/backend.h>
#include <tahr/tahr.h>

enum { FAKE_HALF_SPACE = 1, FAKE_BOX = 2 };

/* Half-space: solid where normal . x < offset. Box: axis-aligned in the world's own frame. */
typedef struct fake_solid {
    int kind;
    tahr_vec3 normal;
    double offset;
    tahr_vec3 min, max;
    uint32_t walkable_rule;
    double walkable_angle;
    uint32_t surface;
} fake_solid;

enum { FAKE_SOLIDS = 16 };

/* Solids are given in the world's own frame; `frame` turns that frame into the one that Tahr sees. A solid's index is its
 * body. Boxes need shapes whose up is the own frame's z axis. */
typedef struct fake_world {
    fake_solid solids[FAKE_SOLIDS];
    uint32_t count;
    tahr_quat frame;
    uint32_t sweeps, contact_queries, rays;
    void (*on_sweep)(struct fake_world *world); /* called inside every sweep, may be NULL */
    void *user;
} fake_world;

void fake_world_init(fake_world *world);
fake_solid *fake_add_plane(fake_world *world, tahr_vec3 normal, double offset);
fake_solid *fake_add_box(fake_world *world, tahr_vec3 min, tahr_vec3 max);
/* A slope through the origin that rises toward +x. */
fake_solid *fake_add_slope(fake_world *world, double degrees);

/* The callbacks; user is a fake_world. */
tahr_status fake_sweep(void *user, const tahr_sweep *query, tahr_hit *hit);
tahr_status fake_contacts(void *user, const tahr_contact_query *query, tahr_contact *contacts, uint32_t capacity,
                          uint32_t *count);

/* Signed distance from an upright shape (up = z of the own frame) to everything, at a place of the own frame. */
double fake_clearance(const fake_world *world, const tahr_shape *shape, tahr_vec3 at);

/* A character in a fake world, with room for everything that a report can say. */
enum { RIG_EVENTS = 64, RIG_DECISIONS = 512 };
typedef struct rig {
    tahr_world *world;
    tahr_mover *mover;
    tahr_config config;
    tahr_input input;
    tahr_state state;
    tahr_report report;
    tahr_event events[RIG_EVENTS];
    tahr_decision decisions[RIG_DECISIONS];
    tahr_status status;
    double time; /* s stepped so far */
} rig;

/* Opens callbacks over `world` and makes a character at `at`. config NULL: the preset. Aborts the test on failure. */
void rig_open(rig *r, fake_world *world, const tahr_config *config, tahr_vec3 at);
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

tahr_config fake_config(void);
tahr_vec3 fake_vec(double x, double y, double z);

/* An allocator that counts, and that fails the fail_at-th request (1 = the first; 0 = never). */
typedef struct fake_memory {
    uint64_t live_blocks, live_bytes, requests, fail_at;
    int mismatches; /* free with another size or alignment than alloc, or memory not aligned */
} fake_memory;
tahr_allocator fake_allocator(fake_memory *memory);

/* A log that keeps the last message. */
typedef struct fake_log {
    char text[512];
    int count;
} fake_log;
tahr_log fake_log_of(fake_log *log);

/* |a - b| <= tolerance, with both numbers in the message. */
#define assert_near(a, b, tolerance) fake_assert_near((a), (b), (tolerance), #a " ~ " #b, __FILE__, __LINE__)
void fake_assert_near(double a, double b, double tolerance, const char *what, const char *file, int line);

#endif
