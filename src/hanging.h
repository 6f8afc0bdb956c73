/* SPDX-License-Identifier: MIT
 * hanging.h: hanging on the edge of a wall, climbing it and letting go.
 *
 * Who falls along a wall and pushes into it hangs where its head passes the edge of a top that can be stood on, or
 * at once if the edge is no more than config.ledge_grab above the head: at rest, its head level with the edge, its
 * side at the wall. Crouching or moving away lets go, and the same edge is not grabbed again before a fall to where
 * it is out of reach. A jump climbs: up along the wall and onto the top in one go (report.step_offset tells the
 * height, for smoothing what is shown), or straight up with jump_speed where there is no room to stand. It follows
 * an edge that moves by less than ledge_grab a step. An edge needs ledge_grab of free height over the head to be
 * seen. */
#ifndef TAHR_HANGING_H
#define TAHR_HANGING_H

#include "core.h"

/* Looks for the edge of the wall that faces `facing` (level) and that the character is at: from ledge_grab above the
 * head to `below` under it. [out] edge: the top, if it can be stood on. Returns 0 if there is none. 1 to 3 rays. */
int tahr__find_edge(tahr__step *step, vec3 facing, double below, tahr_hit *edge);

/* m, of the edge under the head. */
double tahr__edge_depth(const tahr__step *step, const tahr_hit *edge);

/* Hangs on the edge, which lies at most ledge_grab above the head. Returns 0 if that is refused. At most two sweeps. */
int tahr__grab_edge(tahr__step *step, vec3 facing, const tahr_hit *edge);

/* An edge that was let go is out of reach: it may be grabbed again. No query. */
void tahr__forget_edge(tahr__step *step);

/* One slice of hanging. No query while the world stays as it is; else what depenetration asks, 3 rays and 2 sweeps. */
tahr__next tahr__hang(tahr__step *step, double time);

/* Climbs onto the edge. Returns 0, with the state untouched, if there is no room. 3 sweeps and the floor's. */
int tahr__climb_edge(tahr__step *step);

/* Notes that the edge was let go. No query. */
void tahr__let_go(tahr__step *step);

#endif
