/* SPDX-License-Identifier: MIT
 * box2d.c: the table of the box2d backend and its life cycle. */
#include <tahr/box2d.h>

const tahr_backend *tahr_backend_v1_box2d(void)
{
    return NULL;
}
