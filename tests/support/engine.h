/* SPDX-License-Identifier: MIT
 * engine.h: somebody's own engine behind callbacks: the worlds it builds for the conformance kit. */
#ifndef TAHR_TEST_ENGINE_H
#define TAHR_TEST_ENGINE_H

#include <tahr/selftest.h>

/* For tahr_selftest_desc.open and .close. */
tahr_status engine_open(void *user, const tahr_world_desc *desc, tahr_world **world);
void engine_close(void *user, tahr_world *world);

/* The engine behind such a world, whose bodies are moved; NULL of any other world. */
tahr_world *engine_inside(const tahr_world *world);

/* The same, of which only the sweep is handed over. */
tahr_status engine_open_sweep_only(void *user, const tahr_world_desc *desc, tahr_world **world);

#endif
