/* SPDX-License-Identifier: MIT
 * placing.h: what opening a world and placing its bodies share. */
#ifndef TAHR_PLACING_H
#define TAHR_PLACING_H

#include "core.h"

/* Around a call of the backend that has the world for itself. */
void tahr__enter_backend(tahr_world *world, const char *function);
/* An error of the backend's that it did not explain gets at least its name. Returns status. */
tahr_status tahr__leave_backend(tahr_world *world, const tahr_backend *backend, tahr_status status);

/* FNV-1a over the words of a pose. */
uint64_t tahr__hash_pose(uint32_t body, const tahr_pose *pose);

/* The revision is the sum of the shares of all bodies: putting them back gives the old number back, which a rollback
 * needs to repeat bit for bit. */
void tahr__move_revision(tahr_world *world, uint64_t by);

#endif
