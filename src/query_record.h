/* SPDX-License-Identifier: MIT
 * query_record.h: what a query asked and was answered, for debugging. Called only if report.queries is given. */
#ifndef TAHR_QUERY_RECORD_H
#define TAHR_QUERY_RECORD_H

#include "core.h"

void tahr__record_sweep(tahr__step *step, const tahr_sweep *q, const tahr_hit *hit, uint32_t count);
void tahr__record_contacts(tahr__step *step, const tahr_contact_query *q, const tahr_contact *first, uint32_t count);
void tahr__record_ray(tahr__step *step, const tahr_ray *q, const tahr_hit *hit, uint32_t count);
void tahr__record_fluid(tahr__step *step, const tahr_fluid_query *q, const tahr_fluid *fluid);

#endif
