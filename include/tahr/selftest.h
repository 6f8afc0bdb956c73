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

/* Zero what you do not use. */
typedef struct tahr_selftest_desc {
    uint32_t struct_size;
    uint32_t reserved;      /* 0 */
    const void *options;    /* for tahr_world_desc.options of every world that is opened */
    double gap_tolerance;   /* m, of the place where a sweep stops; 0: 1e-4 of the shape's size */
    double angle_tolerance; /* rad, of normals; 0: 2 degrees */
    const char *only;       /* run the cases whose name begins so; NULL: all */
    tahr_selftest_fn report;
    void *user;
    const tahr_log *log;
} tahr_selftest_desc;

/* Runs the cases, each in worlds of its own, and reports one after the other in a fixed order. [in] backend, desc;
 * [out] failed: how many failed, may be NULL. Returns TAHR_OK (also if cases failed), TAHR_E_NULL, TAHR_E_STRUCT_SIZE,
 * TAHR_E_UNSUPPORTED, TAHR_E_ABI, TAHR_E_ARGUMENT, TAHR_E_MEMORY. Allocates. Some seconds on a slow backend.
 * Since 0.1. */
TAHR_API tahr_status tahr_backend_selftest(const tahr_backend *backend, const tahr_selftest_desc *desc,
                                           uint32_t *failed);

#ifdef __cplusplus
}
#endif
#endif
