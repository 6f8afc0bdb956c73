/* SPDX-License-Identifier: MIT
 * relations.h: families that are judged by a twin which must go the same way. */
#ifndef STABILITY_RELATIONS_H
#define STABILITY_RELATIONS_H

#include "run.h"

void relate_any(trial *t, oracle_random *dice);
void relate_generic(trial *t, oracle_random *dice);
void relate_triangles(trial *t, oracle_random *dice);
void relate_two_sided(trial *t, oracle_random *dice);
void relate_lattice(trial *t, oracle_random *dice);
void relate_flight(trial *t, oracle_random *dice);

void twin_cells(const trial *t, oracle_random *dice, twin *w);
void twin_anywhere(const trial *t, oracle_random *dice, twin *w);
void twin_quarter(const trial *t, oracle_random *dice, twin *w);
void twin_mirror(const trial *t, oracle_random *dice, twin *w);
void twin_turned(const trial *t, oracle_random *dice, twin *w);
void twin_scaled(const trial *t, oracle_random *dice, twin *w);
void twin_split(const trial *t, oracle_random *dice, twin *w);
void twin_rewound(const trial *t, oracle_random *dice, twin *w);
void twin_duplicated(const trial *t, oracle_random *dice, twin *w);
void twin_far_triangles(const trial *t, oracle_random *dice, twin *w);
void twin_shuffled(const trial *t, oracle_random *dice, twin *w);
void twin_pieces(const trial *t, oracle_random *dice, twin *w);
void twin_shortcuts(const trial *t, oracle_random *dice, twin *w);
void twin_senseless(const trial *t, oracle_random *dice, twin *w);
void twin_again(const trial *t, oracle_random *dice, twin *w);

#endif
