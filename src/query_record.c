/* SPDX-License-Identifier: MIT
 * query_record.c: what a query asked and was answered, for debugging. */
#include "query_record.h"

#include "report.h"

void tahr__record_sweep(tahr__step *step, const tahr_sweep *q, const tahr_hit *hit, uint32_t count)
{
    tahr_query_record r = {.type = TAHR_QUERY_SWEEP,
                           .count = count,
                           .shape = q->shape,
                           .position = q->position,
                           .motion = q->motion,
                           .margin = q->margin,
                           .fraction = 1,
                           .body = TAHR_NO_BODY};
    if (count > 0) {
        r.fraction = hit->fraction;
        r.distance = hit->distance;
        r.normal = hit->normal;
        r.point = hit->point;
        r.body = hit->body;
        r.feature = hit->feature;
    }
    tahr__record(step, &r);
}

void tahr__record_contacts(tahr__step *step, const tahr_contact_query *q, const tahr_contact *first, uint32_t count)
{
    tahr_query_record r = {.type = TAHR_QUERY_CONTACTS,
                           .count = count,
                           .shape = q->shape,
                           .position = q->position,
                           .margin = q->margin,
                           .fraction = 1,
                           .body = TAHR_NO_BODY};
    if (count > 0) {
        r.distance = first->distance;
        r.normal = first->normal;
        r.point = first->point;
        r.body = first->body;
        r.feature = first->feature;
    }
    tahr__record(step, &r);
}

void tahr__record_ray(tahr__step *step, const tahr_ray *q, const tahr_hit *hit, uint32_t count)
{
    tahr_query_record r = {.type = TAHR_QUERY_RAY,
                           .count = count,
                           .position = q->origin,
                           .motion = q->motion,
                           .fraction = hit->fraction,
                           .normal = hit->normal,
                           .point = hit->point,
                           .body = hit->body,
                           .feature = hit->feature};
    tahr__record(step, &r);
}

void tahr__record_fluid(tahr__step *step, const tahr_fluid_query *q, const tahr_fluid *fluid)
{
    tahr_query_record r = {.type = TAHR_QUERY_FLUID,
                           .count = fluid->immersion > 0,
                           .shape = step->limits->shape,
                           .position = q->position,
                           .fraction = 1,
                           .distance = fluid->immersion,
                           .body = fluid->body};
    tahr__record(step, &r);
}
