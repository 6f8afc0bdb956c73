/* SPDX-License-Identifier: MIT
 * solid.h: a box, sphere or capsule that moves along another one: distance, way out, face, first contact. All that a
 * backend of solids needs to keep what types.h promises of sweeps and contacts. */
#ifndef TAHR_COMMON_SOLID_H
#define TAHR_COMMON_SOLID_H

#include "core.h"

#include <tahr/backend.h>

/* Half axes around a centre, rounded by a radius. */
typedef struct tahr__solid {
    tahr__core core;
    double radius;
} tahr__solid;

/* Where a shape is nearest to a body. */
typedef struct tahr__solid_near {
    double distance;  /* signed, between the surfaces */
    tahr_vec3 normal; /* unit, from the body to the shape; of an overlap, the shortest way out */
    tahr_vec3 point;  /* on the body's surface, relative to its centre */
} tahr__solid_near;

/* Return 0 for what is no box, sphere or capsule. up and orientation are those of the query. */
int tahr__solid_of_body(const tahr_body_desc *body, tahr__solid *solid);
int tahr__solid_of_shape(const tahr_shape *shape, tahr_vec3 up, tahr_quat orientation, tahr__solid *solid);

/* Radius around the centre that holds all of it. */
double tahr__solid_reach(const tahr__solid *solid);

/* centre: of the shape, relative to the body's. */
void tahr__solid_measure(const tahr__solid *shape, const tahr__solid *body, tahr_vec3 centre, tahr__solid_near *near);

/* The face of the body at the nearest point; at an edge or corner of a box the one that faces direction most. [out]
 * feature: of a box 0 to 5, -x, +x, -y, ...: the face that faces the normal most. */
tahr_vec3 tahr__solid_face(const tahr__solid *body, const tahr__solid_near *near, tahr_vec3 direction,
                           uint32_t *feature);

typedef enum tahr__solid_verdict { TAHR__SOLID_FREE, TAHR__SOLID_HIT, TAHR__SOLID_UNKNOWN } tahr__solid_verdict;

/* The first fraction, at most 1, at which the distance falls to margin, from a start where it is more; where it is not,
 * fraction 0 if the motion approaches. [out] fraction, and near there. The distance of convex bodies is a convex function
 * of the way, so that its tangents lead to the first contact and never beyond. */
tahr__solid_verdict tahr__solid_advance(const tahr__solid *shape, const tahr__solid *body, tahr_vec3 start,
                                        tahr_vec3 motion, double margin, double *fraction, tahr__solid_near *near);

/* solid_query.c: one body against one query, all of it but the filter (mask, ignore_body): 1 if it is met, with the
 * answer, else 0. id: what the answer calls the body. Of shapes and bodies: boxes, spheres, capsules. */
int tahr__solid_sweep(const tahr_body_desc *body, uint32_t id, const tahr_sweep *query, tahr_hit *hit);
int tahr__solid_contact(const tahr_body_desc *body, uint32_t id, const tahr_contact_query *query,
                        tahr_contact *contact);
int tahr__solid_ray(const tahr_body_desc *body, uint32_t id, const tahr_ray *query, tahr_hit *hit);

/* Which of two blocking hits is answered: the first one, of overlaps at the start the deepest; ties by body. */
int tahr__solid_before(const tahr_hit *a, const tahr_hit *b);
/* Puts a contact into an answer, ordered by (distance, body); returns 0 if there was one too many: the farthest goes. */
int tahr__solid_insert(const tahr_contact *contact, tahr_contact *contacts, uint32_t capacity, uint32_t *count);

#endif
