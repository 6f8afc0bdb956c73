/* SPDX-License-Identifier: MIT
 * subject.h: a backend with some settings, asked directly: its own slots, so that the narrow phase's counts are seen.
 */
#ifndef TAHR_CHART_SUBJECT_H
#define TAHR_CHART_SUBJECT_H

#include <tahr/backend.h>
#include <tahr/box2d.h>
#include <tahr/native.h>
#include <tahr/tahr.h>

/* Room for what a backend's own description is. */
typedef struct chart_options {
    uint64_t words[32];
} chart_options;

typedef struct chart_subject {
    const char *curve, *setting, *role;
    double value; /* of the knob */
    const tahr_backend *(*get)(void);
    int planar;            /* a world of two dimensions */
    int slow;              /* a step takes tens of microseconds */
    chart_options options; /* starts with its struct_size; that is 0: the backend's defaults */
} chart_subject;

/* Every backend, solver and tolerance of this build, in an order that goes along the curves; NULL beyond the
 * last. Static memory. */
const chart_subject *chart_subject_at(uint32_t index);

/* What tahr_world_desc.options has to be. */
const void *chart_subject_options(const chart_subject *subject);

/* Opens bodies, which must be complete (tahr_body_desc_init), on the backend itself. Returns a status. */
tahr_status chart_subject_open(const chart_subject *subject, const tahr_body_desc *bodies, uint32_t count, void **self);

/* Gives a context of this open backend its cache, which the caller frees. Returns 0 if memory is out. */
int chart_subject_cache(const chart_subject *subject, void *self, tahr_query_context *context);

#endif
