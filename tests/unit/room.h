/* SPDX-License-Identifier: MIT
 * room.h: a room with a lift, a belt, a pool, a sensor and a crate, in which something moves now and then, and a
 * character of whom anything may be asked. */
#ifndef ROOM_H
#define ROOM_H

#include "dice.h"
#include "stage.h"

/* On the native backend, with most of the settings under "Feel" on. */
void room_open(rig *r, uint32_t preset, uint32_t sleep);

/* Half of the time nothing; else one or several of all that an input can ask for. */
tahr_input room_input(oracle_random *dice);

/* What moves before step n: the lift and the sensor for a while, the crate by a jump, the lift back at once. */
void room_move(rig *r, int n);
/* Puts everything where it was after that, at rest. */
void room_put(rig *r, int n);

/* Every so often the character is taken to where there is something to do. */
void room_carry(rig *r, int n);

/* One step at 60 Hz without a trace: with one every step is computed. */
void room_step(rig *r);

#endif
