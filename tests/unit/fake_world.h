/* SPDX-License-Identifier: MIT
 * fake_world.h: worlds of half-spaces and boxes whose answers are closed forms. */
#ifndef FAKE_WORLD_H
#define FAKE_WORLD_H

#include <tahr/backend.h>
#include <tahr/tahr.h>

tahr_vec3 fake_vec(double x, double y, double z);
/* v turned by a unit quaternion, and back. */
tahr_vec3 fake_turn(tahr_quat q, tahr_vec3 v);
tahr_vec3 fake_turn_back(tahr_quat q, tahr_vec3 v);

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

/* Solids are given in the world's own frame; `frame` turns that frame into the one that Tahr sees. A solid's index is
 * its body. Boxes need shapes whose up is the own frame's z axis. */
typedef struct fake_world {
    fake_solid solids[FAKE_SOLIDS];
    uint32_t count;
    tahr_quat frame;
    uint32_t sweeps, contact_queries, rays;
    void (*on_sweep)(struct fake_world *world); /* called inside every sweep, may be NULL */
    void *user;
} fake_world;

void fake_world_init(fake_world *world); /* nothing in it */
void fake_world_flat(fake_world *world); /* the half-space below z = 0, body 0 */
fake_solid *fake_add_plane(fake_world *world, tahr_vec3 normal, double offset);
fake_solid *fake_add_box(fake_world *world, tahr_vec3 min, tahr_vec3 max);
/* A slope through the origin that rises toward +x. */
fake_solid *fake_add_slope(fake_world *world, double degrees);

/* A world of callbacks that answers sweeps and contacts. */
tahr_callbacks fake_callbacks(fake_world *world);

/* These callbacks; user is a fake_world. */
tahr_status fake_sweep(void *user, const tahr_sweep *query, tahr_hit *hit);
tahr_status fake_contacts(void *user, const tahr_contact_query *query, tahr_contact *contacts, uint32_t capacity,
                          uint32_t *count);

/* Signed distance from an upright shape (up = z of the own frame) to everything, at a place of the own frame. */
double fake_clearance(const fake_world *world, const tahr_shape *shape, tahr_vec3 at);

#endif
