/* SPDX-License-Identifier: MIT
 * wandering.h: characters wander through levels on every backend, watched by an independent check. */
#ifndef TAHR_TEST_WANDERING_H
#define TAHR_TEST_WANDERING_H

/* Steps of each of the 16 characters, by backend; arguments narrow it down: [level [backend]]. Prints one line per
 * level and backend. Returns the exit code of a test. */
int wandering_run(int native_steps, int other_steps, int argc, char **argv);

#endif
