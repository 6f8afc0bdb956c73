/* SPDX-License-Identifier: MIT
 * selftest.h: the conformance kit: does a backend, or your own callbacks, keep what backend.h and types.h promise? */
#ifndef TAHR_SELFTEST_H
#define TAHR_SELFTEST_H

#include <tahr/backend.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { TAHR_SELFTEST_PASS = 0, TAHR_SELFTEST_FAIL = 1, TAHR_SELFTEST_NOT_SUPPORTED = 2 };

/* What one case found. The texts are valid during the call only. */
typedef struct tahr_selftest_result {
    const char *name;     /* "rest_at_margin_plus_one_ulp" */
    uint32_t verdict;     /* TAHR_SELFTEST_* */
    uint32_t reserved;    /* 0 */
    const char *expected; /* "fraction 0, blocking" */
    const char *actual;   /* "free"; of what is not supported: the capability that is missing */
} tahr_selftest_result;

typedef void (*tahr_selftest_fn)(void *user, const tahr_selftest_result *result);

/* For your own callbacks: "open me a world with these bodies": build them in your engine and open your callbacks over
 * them (tahr_world_open_callbacks). [in] desc is valid during the call only; all its bodies are of the kinds and have
 * the flags that tahr_selftest_desc.capabilities claims. In your answers a body is its index there, with its mask,
 * surface and walkable rule. [out] world, untouched on failure. Returns TAHR_OK or what went wrong. */
typedef tahr_status (*tahr_selftest_open_fn)(void *user, const tahr_world_desc *desc, tahr_world **world);

/* Closes a world of that function, and what is behind it. */
typedef void (*tahr_selftest_close_fn)(void *user, tahr_world *world);

/* Zero what you do not use. capabilities: without open 0; with open TAHR_CAP_* of the shapes that your sweep takes and
 * of the bodies that you can build (SOLIDS: boxes, spheres and capsules), MARGIN (but with TAHR_CALLBACKS_NO_MARGIN),
 * and CONTACTS, RAY, SENSORS and ONE_WAY if you do them. */
typedef struct tahr_selftest_desc {
    uint32_t struct_size;
    uint32_t capabilities;
    const void *options;          /* for tahr_world_desc.options of every world that is opened */
    double gap_tolerance;         /* m, of distances to a shape 1.8 m high, in proportion to others; 0: 9e-5 */
    double angle_tolerance;       /* rad, of normals, up to 0.5; 0: 2 degrees */
    const char *only;             /* run the cases whose name begins so; NULL: all */
    tahr_selftest_fn report;      /* may be NULL */
    void *user;                   /* of report, open and close */
    const tahr_log *log;          /* what the worlds complain about; NULL: silent */
    tahr_selftest_open_fn open;   /* or NULL: tahr_world_open on the backend */
    tahr_selftest_close_fn close; /* NULL: tahr_world_close */
} tahr_selftest_desc;

/* Runs the cases, each in worlds of its own, and reports one after the other in a fixed order. Small scenes with
 * answers in closed form, near the origin and far away, asked through the same checks as in a step, and with
 * TAHR_CAP_PLANAR in the x-y plane with up = +y. What the capabilities do not claim is not supported; whatever they
 * claim must be right. [in] backend (NULL with desc.open), desc; [out] failed: how many failed, may be NULL; untouched
 * on error. Returns TAHR_OK (also if cases failed), TAHR_E_NULL (desc; backend and open both missing; an empty slot of
 * the backend), TAHR_E_STRUCT_SIZE, TAHR_E_ABI, TAHR_E_UNSUPPORTED (an unknown tail of desc not zero), TAHR_E_ARGUMENT
 * (tolerances not finite or out of range; a backend beside open; capabilities without open; `only` that no case begins
 * with), TAHR_E_MEMORY; the log says which. Allocates by malloc; may run on several threads. Under a second on a fast
 * backend, some seconds on a slow one. Since 0.1. */
TAHR_API tahr_status tahr_backend_selftest(const tahr_backend *backend, const tahr_selftest_desc *desc,
                                           uint32_t *failed);

#ifdef __cplusplus
}
#endif
#endif
