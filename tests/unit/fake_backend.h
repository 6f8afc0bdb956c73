/* SPDX-License-Identifier: MIT
 * fake_backend.h: a backend whose answers a test dictates: the truth about a fake world, the truth with one field
 * spoiled, "unknown", or noise. */
#ifndef FAKE_BACKEND_H
#define FAKE_BACKEND_H

#include "dice.h"
#include "fake_world.h"

/* What is wrong with every hit. */
enum {
    LIE_NONE,
    LIE_NORMAL_NAN,
    LIE_NORMAL_LONG,
    LIE_NORMAL_ZERO,
    LIE_SURFACE_NAN,
    LIE_FRACTION_LOW,
    LIE_FRACTION_HIGH,
    LIE_FRACTION_NAN,
    LIE_COUNT,
    LIE_STATUS,
    LIE_DISTANCE,
    LIE_DEPTH,
    LIE_POINT,
    LIE_RULE,
    LIE_ANGLE,
    LIE_POINT_FAR, /* farther out than a state may hold */
    LIE_DISTANCE_FAR,
    LIES
};
/* The field that a message about the lie has to name. */
extern const char *const lie_fields[LIES];

/* What is wrong with the first contact, or with the answer. */
enum {
    CONTACT_LIE_NONE,
    CONTACT_LIE_NORMAL,
    CONTACT_LIE_DISTANCE,
    CONTACT_LIE_COUNT,
    CONTACT_LIE_STATUS,
    CONTACT_LIE_SURFACE,
    CONTACT_LIE_POINT,
    CONTACT_LIE_RULE,
    CONTACT_LIE_POINT_FAR,
    CONTACT_LIE_DISTANCE_FAR,
    CONTACT_LIES
};
extern const char *const contact_lie_fields[CONTACT_LIES];

/* How a body is answered that the backend cannot decide. */
enum { UNKNOWN_ALONE = 1, UNKNOWN_BLOCKING = 2, UNKNOWN_GARBAGE = 3, UNKNOWN_KINDS };

enum {
    FAKE_BACKEND_SHAPES = TAHR_CAP_CAPSULE | TAHR_CAP_SPHERE | TAHR_CAP_BOX,
    FAKE_BACKEND_ALL = TAHR_CAP_MARGIN | TAHR_CAP_CONTACTS | TAHR_CAP_RAY | FAKE_BACKEND_SHAPES
};

typedef struct fake_backend {
    tahr_backend table; /* to be opened with this struct as the options */
    fake_world world;   /* a ray sees only the plane z = 0, with or without it */
    int lie, contact_lie, random;
    int keeps_overlaps;    /* knows no TAHR_SWEEP_LEAVE_OVERLAP */
    uint32_t unknown_body; /* answered so, if `unknown` */
    int unknown;
    oracle_random seed;
    uint32_t asked; /* queries */
    tahr_status open_answer;
    uint32_t opened, closed, placed; /* placed: bodies */
} fake_backend;

/* Over the plane z = 0; tells the truth. */
void fake_backend_init(fake_backend *backend, uint32_t capabilities);

#endif
