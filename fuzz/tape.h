/* SPDX-License-Identifier: MIT
 * tape.h: bytes as what a player does, step by step. */
#ifndef TAHR_FUZZ_TAPE_H
#define TAHR_FUZZ_TAPE_H

#include "scene.h"

/* One step's input and length, from 2 bytes or a few more. scale: of lengths and speeds. */
void tape_read(bytes *b, double scale, const tahr_config *config, tahr_input *input, double *dt);

#endif
