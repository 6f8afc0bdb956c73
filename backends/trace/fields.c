/* SPDX-License-Identifier: MIT
 * fields.c: the names of what a query is made of, to say in which field two differ. */
#include "format.h"

#include <string.h>

typedef struct field {
    const char *name;
    uint32_t offset, size; /* 8: a double, 4: a whole number */
} field;

#define WHOLE(of, name)              \
    {                                \
#name, offsetof(of, name), 4 \
    }
#define REAL(of, name)               \
    {                                \
#name, offsetof(of, name), 8 \
    }
#define VECTOR(of, name) REAL(of, name.x), REAL(of, name.y), REAL(of, name.z)
#define SHAPE(of)                                                                                      \
    WHOLE(of, shape.type), WHOLE(of, shape.hull), REAL(of, shape.radius), REAL(of, shape.half_height), \
        REAL(of, shape.half_x), REAL(of, shape.half_y)
#define TURN(of) REAL(of, orientation.x), REAL(of, orientation.y), REAL(of, orientation.z), REAL(of, orientation.w)
#define NONE       \
    {              \
        NULL, 0, 0 \
    }

static const field sweep_fields[] = {SHAPE(tahr_sweep),
                                     VECTOR(tahr_sweep, position),
                                     VECTOR(tahr_sweep, up),
                                     TURN(tahr_sweep),
                                     VECTOR(tahr_sweep, motion),
                                     REAL(tahr_sweep, margin),
                                     WHOLE(tahr_sweep, mask),
                                     WHOLE(tahr_sweep, ignore_body),
                                     WHOLE(tahr_sweep, flags),
                                     WHOLE(tahr_sweep, reserved),
                                     NONE};
static const field contacts_fields[] = {SHAPE(tahr_contact_query),
                                        VECTOR(tahr_contact_query, position),
                                        VECTOR(tahr_contact_query, up),
                                        TURN(tahr_contact_query),
                                        REAL(tahr_contact_query, margin),
                                        WHOLE(tahr_contact_query, mask),
                                        WHOLE(tahr_contact_query, ignore_body),
                                        WHOLE(tahr_contact_query, flags),
                                        WHOLE(tahr_contact_query, reserved),
                                        NONE};
static const field ray_fields[] = {VECTOR(tahr_ray, origin), VECTOR(tahr_ray, motion), WHOLE(tahr_ray, mask),
                                   WHOLE(tahr_ray, ignore_body), NONE};
static const field fluid_fields[] = {VECTOR(tahr_fluid_query, position),
                                     VECTOR(tahr_fluid_query, up),
                                     REAL(tahr_fluid_query, radius),
                                     REAL(tahr_fluid_query, half_height),
                                     WHOLE(tahr_fluid_query, mask),
                                     WHOLE(tahr_fluid_query, reserved),
                                     NONE};

static double value_of(const field *f, const void *object)
{
    const char *at = (const char *)object + f->offset;
    double real;
    uint32_t whole;

    if (f->size == 8) {
        memcpy(&real, at, 8);
        return real;
    }
    memcpy(&whole, at, 4);
    return whole;
}

const char *tahr__trace_compare(uint32_t kind, const void *asked, const void *recorded, double values[2])
{
    const field *f = kind == TAHR__TRACE_SWEEP      ? sweep_fields
                     : kind == TAHR__TRACE_CONTACTS ? contacts_fields
                     : kind == TAHR__TRACE_RAY      ? ray_fields
                                                    : fluid_fields;
    for (; f->name; f++) {
        if (memcmp((const char *)asked + f->offset, (const char *)recorded + f->offset, f->size) == 0) continue;
        values[0] = value_of(f, asked);
        values[1] = value_of(f, recorded);
        return f->name;
    }
    return NULL;
}

const char *tahr__trace_kind_name(uint32_t kind)
{
    static const char *const names[] = {"sweep", "contacts", "ray", "fluid", "body_motion", "prepare"};

    kind &= ~(uint32_t)TAHR__TRACE_DIRECT;
    return kind >= TAHR__TRACE_SWEEP && kind <= TAHR__TRACE_PREPARE ? names[kind - TAHR__TRACE_SWEEP] : "no query";
}
