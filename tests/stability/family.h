/* SPDX-License-Identifier: MIT
 * family.h: the hard cases: one function each, which makes a variation out of a seed. */
#ifndef STABILITY_FAMILY_H
#define STABILITY_FAMILY_H

#include "trial.h"

typedef struct twin twin;

typedef struct family {
    const char *name;
    const char *tells;   /* what is hard about it, and where methods fail */
    uint32_t worlds;     /* IN_* */
    const char *why_not; /* why not in the others */
    void (*make)(trial *t, oracle_random *dice);
    int moves;             /* bodies do: not for who cannot be told how they do */
    uint32_t needs;        /* TAHR_CAP_*, NEEDS_FLUIDS */
    const char *needs_why; /* said of who has not got them */
    /* What UNREAL does not keep, as it documents, and why. */
    uint32_t unreal_loses;
    const char *unreal_why;
    /* A relation: what else goes the same way; NULL: none. */
    void (*twin)(const trial *t, oracle_random *dice, twin *twin);
} family;

extern const family FAMILIES[];
int family_count(void);
const family *family_named(const char *name);

/* Makes variation number seed of a family, finished. */
void family_make(const family *f, uint32_t world, uint32_t preset, uint64_t seed, trial *t);

/* Of the files families_*.c. */
void make_touching(trial *t, oracle_random *dice);
void make_dead_band(trial *t, oracle_random *dice);
void make_edges(trial *t, oracle_random *dice);
void make_deep_start(trial *t, oracle_random *dice);
void make_tug_of_war(trial *t, oracle_random *dice);
void make_slivers(trial *t, oracle_random *dice);
void make_degenerate(trial *t, oracle_random *dice);
void make_seams(trial *t, oracle_random *dice);
void make_t_junctions(trial *t, oracle_random *dice);
void make_sheets(trial *t, oracle_random *dice);
void make_soup(trial *t, oracle_random *dice);
void make_terrain(trial *t, oracle_random *dice);
void make_blocks(trial *t, oracle_random *dice);
void make_acute_corner(trial *t, oracle_random *dice);
void make_gutter(trial *t, oracle_random *dice);
void make_wedge(trial *t, oracle_random *dice);
void make_floor_ceiling(trial *t, oracle_random *dice);
void make_narrow(trial *t, oracle_random *dice);
void make_step_traps(trial *t, oracle_random *dice);
void make_perch(trial *t, oracle_random *dice);
void make_hunting(trial *t, oracle_random *dice);
void make_energy(trial *t, oracle_random *dice);
void make_lift(trial *t, oracle_random *dice);
void make_shuttle(trial *t, oracle_random *dice);
void make_turntable(trial *t, oracle_random *dice);
void make_teleport(trial *t, oracle_random *dice);
void make_crusher(trial *t, oracle_random *dice);
void make_far_origin(trial *t, oracle_random *dice);
void make_huge_scale(trial *t, oracle_random *dice);
void make_tiny_scale(trial *t, oracle_random *dice);
void make_skins(trial *t, oracle_random *dice);
void make_huge_dt(trial *t, oracle_random *dice);
void make_tiny_dt(trial *t, oracle_random *dice);
void make_hulls(trial *t, oracle_random *dice);
void make_heights(trial *t, oracle_random *dice);
void make_one_way(trial *t, oracle_random *dice);
void make_sensors(trial *t, oracle_random *dice);
void make_water(trial *t, oracle_random *dice);
void make_pushed(trial *t, oracle_random *dice);
void make_box_character(trial *t, oracle_random *dice);
void make_wrong_input(trial *t, oracle_random *dice);
/* One of those that stand still and need nothing of their own: what is far, huge or slow is one of them. */
void make_any(trial *t, oracle_random *dice);

#endif
