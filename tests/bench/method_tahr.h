/* SPDX-License-Identifier: MIT
 * method_tahr.h: Tahr as a method, with its knobs. */
#ifndef TAHR_BENCH_METHOD_TAHR_H
#define TAHR_BENCH_METHOD_TAHR_H

#include <tahr/backend.h>
#include <tahr/tahr.h>

#include "method.h"

/* What method.data points to. Zero means Tahr's own default for every field but backend. */
typedef struct method_tahr {
    const tahr_backend *(*backend)(void);
    int32_t preset; /* TAHR_PRESET_*, 0: PRECISE */
    int ramp_up;    /* 1: accelerate as the preset does; 0: the wish is the velocity at once, as with the peers */
    int box;        /* 1: level.box instead of the triangles, where there is one */
    /* Changes of settings after everything else, or NULL. */
    void (*tune)(tahr_config *config, const void *tuning);
    const void *tuning;
} method_tahr;

/* A method of that name; knobs and texts must live as long. */
method method_of_tahr(const char *name, const char *settings, const method_tahr *knobs);

/* The report of the last step of a character of an open method, for what method_place does not tell. */
const tahr_report *method_tahr_report(const void *self);
tahr_world *method_tahr_world(const void *self);

#endif
