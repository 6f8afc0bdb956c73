/* SPDX-License-Identifier: MIT
 * describe.c: what a world is made of, in words. */
#include <stdio.h>

#include "core.h"
#include "message.h"

tahr_status tahr_world_describe(tahr_world *world, const tahr_log *to)
{
    if (!world || !to || !to->write) {
        return TAHR_E_NULL;
    }
    if (world->backend->describe) {
        return world->backend->describe(world->self, to) < 0 ? TAHR_E_BACKEND : TAHR_OK;
    }
    char text[128];
    snprintf(text, sizeof text, "%.64s, %s: this backend says no more of its scene", world->backend->name,
             world->backend->capabilities & TAHR_CAP_PLANAR ? "2D" : "3D");
    to->write(to->user, TAHR_LOG_INFO, text);
    return TAHR_OK;
}
