/* SPDX-License-Identifier: MIT
 * box2d.h: the backend on Box2D, in two dimensions. Not part of libtahr: link libtahr_box2d. */
#ifndef TAHR_BOX2D_H
#define TAHR_BOX2D_H

#include <tahr/backend.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Which Box2D: the newest that this library was built with, 2.4 (C++) or 3 (C). */
enum { TAHR_BOX2D_NEWEST = 0, TAHR_BOX2D_2 = 2, TAHR_BOX2D_3 = 3 };

/* Zero means default for every field but struct_size. */
typedef struct tahr_box2d_desc {
    uint32_t struct_size;
    uint32_t engine; /* TAHR_BOX2D_* */
} tahr_box2d_desc;

/* The Box2D backend, of one name for both engines; for tahr_world_open, whose desc.options is a tahr_box2d_desc or
 * NULL. Static memory. Since 0.1. */
TAHR_API const tahr_backend *tahr_backend_v1_box2d(void);

#ifdef __cplusplus
}
#endif
#endif
