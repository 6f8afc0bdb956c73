/* SPDX-License-Identifier: MIT
 * answer.h: the only calls of backend slots that ask something: every answer is checked. A backend may lie, and what it
 * says decides where a character goes. */
#ifndef TAHR_ANSWER_H
#define TAHR_ANSWER_H

#include "core.h"

/* Each asks the world's backend. Returns what it returned, or TAHR_E_BACKEND after a message that names the slot and
 * the field. Normals come back as exact units. */
tahr_status tahr__answer_contacts(const tahr_world *world, tahr_query_context *context, const tahr_contact_query *query,
                                  tahr_contact *contacts, uint32_t capacity, uint32_t *count);
tahr_status tahr__answer_ray(const tahr_world *world, tahr_query_context *context, const tahr_ray *query, tahr_hit *hit,
                             uint32_t *count);
tahr_status tahr__answer_fluid(const tahr_world *world, tahr_query_context *context, const tahr_fluid_query *query,
                               tahr_fluid *fluid);
/* Of a body that the core has no note of: also TAHR_E_NOT_FOUND. */
tahr_status tahr__answer_motion(const tahr_world *world, uint32_t body, tahr_body_motion *motion);

/* Says which field of a slot's answer is invalid. Returns TAHR_E_BACKEND. */
tahr_status tahr__bad_answer(const tahr_world *world, const char *slot, const char *field);
/* Says which negative status a slot returned. Returns TAHR_E_BACKEND. */
tahr_status tahr__bad_status(const tahr_world *world, const char *slot, tahr_status status);

/* The slow ways of answer_sweep. */
tahr_status tahr__refine_hits(const tahr_world *world, tahr_status status, tahr_hit *hits, uint32_t capacity,
                              uint32_t count);
tahr_status tahr__answer_inflated(const tahr_world *world, tahr_query_context *context, const tahr_sweep *query,
                                  tahr_hit *hits, uint32_t capacity, uint32_t *count);

/* Treats what is not known as a wall in the way; of an undecided answer nothing but the fraction need make sense. */
void tahr__make_wall(tahr_hit *hit, vec3 from, vec3 motion, double margin);

/* Normals of user callbacks are often single precision: their length is accepted within this and then made exact. */
static const double UNIT_TOLERANCE = 1e-3;

static inline int normal_is_unit(vec3 n)
{
    double l = length_squared(n);
    return l > (1 - UNIT_TOLERANCE) * (1 - UNIT_TOLERANCE) && l < (1 + UNIT_TOLERANCE) * (1 + UNIT_TOLERANCE);
}

/* Unit to double precision: such a normal keeps its bits. */
static inline int normal_is_exact(vec3 n)
{
    double l = length_squared(n);
    return l > 1 - 1e-15 && l < 1 + 1e-15;
}

/* m: how far out a point and how large a distance of an answer may be: as far as a state may hold it (arguments.c). */
#define TAHR__FARTHEST 1e8

/* What almost every hit is: nothing to find bad, and nothing to make exact. A sum of squares hides nothing. */
static inline int hit_is_flawless(const tahr_hit *h)
{
    double sum = length_squared(h->point) + h->distance * h->distance + h->walkable_angle * h->walkable_angle;
    return h->fraction >= 0 && h->fraction <= 1 && !h->start_overlap && !h->unknown && normal_is_exact(h->normal) &&
           normal_is_exact(h->surface_normal) && sum <= TAHR__FARTHEST * TAHR__FARTHEST &&
           h->walkable_rule <= TAHR_WALKABLE_NEVER;
}

static inline tahr_status margin_sweep(const tahr_world *world, tahr_query_context *context, const tahr_sweep *query,
                                       tahr_hit *hits, uint32_t capacity, uint32_t *count)
{
    *count = 0;
    tahr_status status = world->backend->sweep(world->self, context, query, hits, capacity, count);
    if (status == TAHR_OK && (*count == 0 || (*count == 1 && !world_is_planar(world) && hit_is_flawless(hits)))) {
        return status;
    }
    return tahr__refine_hits(world, status, hits, capacity, *count);
}

static inline tahr_status answer_sweep(const tahr_world *world, tahr_query_context *context, const tahr_sweep *query,
                                       tahr_hit *hits, uint32_t capacity, uint32_t *count)
{
    int inflates = !(world->backend->capabilities & TAHR_CAP_MARGIN) && query->margin > 0;
    return inflates ? tahr__answer_inflated(world, context, query, hits, capacity, count)
                    : margin_sweep(world, context, query, hits, capacity, count);
}

static inline tahr_status answer_prepare(const tahr_world *world, tahr_query_context *context,
                                         const tahr_prepare *announcement)
{
    const tahr_backend *backend = world->backend;
    tahr_status status = backend->prepare ? backend->prepare(world->self, context, announcement) : TAHR_OK;
    return status < 0 ? tahr__bad_status(world, "prepare", status) : TAHR_OK;
}

#endif
