/* SPDX-License-Identifier: MIT
 * check.h: an independent look at what a run did: crossed surfaces and overlaps, by its own grid and its own geometry.
 * It shares no code with any backend. */
#ifndef TAHR_CLI_CHECK_H
#define TAHR_CLI_CHECK_H

#include "level.h"

/* Distances beyond this are not told apart, m. */
#define CHECK_REACH 0.05
/* m; more than any backend is allowed. */
#define CHECK_BOX_DEPTH 0.006

struct checker;

/* Builds the grid over a level, which must stay as it is until checker_close. */
struct checker *checker_open(const struct level *level);
void checker_close(struct checker *checker);

/* Where movers are: at the begin and at the end of the step that is looked at from now on. */
void checker_time(struct checker *checker, double before, double now);

/* 1 if the segment between two centres crosses a triangle, or touches the inside of a round body, or crosses
 * a mover as seen from it. */
int checker_crosses(struct checker *checker, tahr_vec3 from, tahr_vec3 to);

/* 1 if a shape that lay above a surface that blocks from above, or above a mover that does, has its foot below it
 * now. */
int checker_sinks(struct checker *checker, const tahr_shape *before, tahr_vec3 from, const tahr_shape *now,
                  tahr_vec3 to);

/* Signed distance from a capsule or sphere to the nearest surface, at most CHECK_REACH. Negative: an overlap, and how
 * far the shape's axis would have to be moved away from that surface. Boxes are taken as their inner capsule; on levels
 * of two dimensions their outline is looked at too, and an overlap of its corners counts as CHECK_BOX_DEPTH if it is at
 * least that deep. */
double checker_clearance(struct checker *checker, const tahr_shape *shape, tahr_vec3 position, tahr_vec3 up);

/* The same to the nearest mover alone. */
double checker_mover_clearance(struct checker *checker, const tahr_shape *shape, tahr_vec3 position, tahr_vec3 up);

#endif
