/* SPDX-License-Identifier: MIT
 * family.c: the table of families. */
#include "family.h"

#include "relations.h"

#include <tahr/backend.h>

#include <string.h>

/* One trial in so many is a sphere's, or a circle's. */
enum { BALLS = 8 };

#define BOTH (IN_SPACE | IN_PLANE)
#define NEEDS_TRIANGLES "its case is made of triangles"
#define ROW(n, t, w, y, m) .name = (n), .tells = (t), .worlds = (w), .why_not = (y), .make = (m)
#define NEEDS_DEPTH "its case has three dimensions"

const family FAMILIES[] = {
    {ROW("touching", "exactly touching, and a hair off it", BOTH, "", make_touching)},
    {ROW("dead_band", "1e-9 to 1e-3 m from contact, on either side", BOTH, "", make_dead_band)},
    {ROW("edges", "ridges, spikes and rims", BOTH, "", make_edges)},
    {ROW("deep_start", "begins inside of something", BOTH, "", make_deep_start)},
    {ROW("tug_of_war", "between two walls that leave no room", BOTH, "", make_tug_of_war)},
    {ROW("narrow", "a gap as wide as it is, within a hair", BOTH, "", make_narrow)},
    {ROW("slivers", "a floor of needles", IN_SPACE, NEEDS_TRIANGLES, make_slivers)},
    {ROW("degenerate", "triangles without area, doubled, 10 km long", IN_SPACE, NEEDS_TRIANGLES, make_degenerate)},
    {ROW("seams", "a level floor in pieces", BOTH, "", make_seams)},
    {ROW("t_junctions", "corners inside of edges", IN_SPACE, NEEDS_TRIANGLES, make_t_junctions)},
    {ROW("sheets", "sheets that block on one side, or on both", BOTH, "", make_sheets)},
    {ROW("soup", "triangles any way", IN_SPACE, NEEDS_TRIANGLES, make_soup)},
    {ROW("terrain", "rough ground", BOTH, "", make_terrain)},
    {ROW("blocks", "boxes in and on each other", BOTH, "", make_blocks)},
    {ROW("acute_corner", "walls that meet at 2 to 40 degrees", IN_SPACE, NEEDS_DEPTH, make_acute_corner)},
    {ROW("gutter", "two slopes that meet below", BOTH, "", make_gutter)},
    {ROW("wedge", "slope and walls, slope and ceiling", BOTH, "", make_wedge)},
    {ROW("floor_ceiling", "a ceiling as high as it is, within a hair", BOTH, "", make_floor_ceiling)},
    {ROW("step_traps", "steps as high as the rules allow, within a hair", BOTH, "", make_step_traps)},
    {ROW("perch", "over a rim as far as the rules allow, within a hair", BOTH, "", make_perch)},
    {ROW("hunting", "slopes of every angle: is the height left alone?", BOTH, "", make_hunting)},
    {ROW("energy", "fast falls into steep funnels", BOTH, "", make_energy), .unreal_loses = KEEPS_REST,
     .unreal_why = "held between faces too steep to stand on, it falls on the spot"},
    {ROW("lift", "a floor that moves faster than gravity", BOTH, "", make_lift), .moves = 1},
    {ROW("shuttle", "a floor that goes to and fro past a wall", BOTH, "", make_shuttle), .moves = 1},
    {ROW("turntable", "a floor that turns and tilts", BOTH, "", make_turntable), .moves = 1},
    {ROW("teleport", "a floor that is somewhere else all at once", BOTH, "", make_teleport), .moves = 1},
    {ROW("crusher", "walls and ceilings that close", BOTH, "", make_crusher), .moves = 1},
    {ROW("far_origin", "1 to 9000 km from the origin", BOTH, "", make_far_origin)},
    {ROW("huge_scale", "3 to 100 times as large", BOTH, "", make_huge_scale)},
    {ROW("tiny_scale", "3 to 100 times as small", BOTH, "", make_tiny_scale)},
    {ROW("skins", "skins of a tenth to ten times the usual", BOTH, "", make_skins)},
    {ROW("huge_dt", "steps of up to a second", BOTH, "", make_huge_dt)},
    {ROW("tiny_dt", "steps down to less than a nanosecond, and of none", BOTH, "", make_tiny_dt)},
    {ROW("wrong_input", "numbers that are none", BOTH, "", make_wrong_input)},
    {ROW("hulls", "convex solids any way", IN_SPACE, NEEDS_DEPTH, make_hulls), .needs = TAHR_CAP_HULLS,
     .needs_why = "it has no hulls"},
    {ROW("heights", "a field of heights, with holes", IN_SPACE, NEEDS_DEPTH, make_heights), .needs = TAHR_CAP_HEIGHTS,
     .needs_why = "it has no fields of heights"},
    {ROW("one_way", "platforms that are there from above only", BOTH, "", make_one_way), .needs = TAHR_CAP_ONE_WAY,
     .needs_why = "it has no one-way bodies"},
    {ROW("sensors", "what is felt and does not block", BOTH, "", make_sensors), .needs = TAHR_CAP_SENSORS,
     .needs_why = "it has no sensors", .twin = twin_senseless},
    {ROW("water", "a basin, swum in, dived in and left", IN_SPACE, NEEDS_DEPTH, make_water), .needs = NEEDS_FLUIDS,
     .needs_why = "it has no water"},
    {ROW("pushed", "a plough, with room before it", BOTH, "", make_pushed), .moves = 1},
    {ROW("box_character", "who is a box, in gaps and on steps of its size", BOTH, "", make_box_character)},
    {ROW("same_again", "run twice: the same bits", BOTH, "", relate_any), .twin = twin_again},
    {ROW("shortcuts", "cache, lanes, kept floors, sleep off: the same bits", BOTH, "", relate_any),
     .twin = twin_shortcuts},
    {ROW("moved_cells", "moved by whole cells: the same bits", BOTH, "", relate_lattice), .twin = twin_cells},
    {ROW("moved", "moved anywhere", BOTH, "", relate_generic), .twin = twin_anywhere},
    {ROW("turned_90", "turned by 90 degrees about up", IN_SPACE, NEEDS_DEPTH, relate_generic), .twin = twin_quarter},
    {ROW("mirrored", "mirrored", BOTH, "", relate_generic), .twin = twin_mirror},
    {ROW("turned", "turned any way, gravity too", BOTH, "", relate_generic), .twin = twin_turned},
    {ROW("scaled", "half, a quarter as large", BOTH, "", relate_lattice), .twin = twin_scaled},
    {ROW("split", "every triangle cut into three", IN_SPACE, NEEDS_TRIANGLES, relate_generic), .twin = twin_split},
    {ROW("rewound", "two-sided triangles the other way round", IN_SPACE, NEEDS_TRIANGLES, relate_two_sided),
     .twin = twin_rewound},
    {ROW("doubled", "triangles twice: the same bits", IN_SPACE, NEEDS_TRIANGLES, relate_any), .twin = twin_duplicated},
    {ROW("far_added", "triangles far away: the same bits", IN_SPACE, NEEDS_TRIANGLES, relate_any),
     .twin = twin_far_triangles},
    {ROW("shuffled", "triangles handed over in another order: the same bits", IN_SPACE, NEEDS_TRIANGLES,
         relate_triangles),
     .twin = twin_shuffled},
    {ROW("pieces", "free flight in 2 to 10 pieces a step", BOTH, "", relate_flight), .twin = twin_pieces,
     .unreal_loses = KEEPS_RELATION, .unreal_why = "it integrates in steps"},
    {.name = NULL},
};

int family_count(void)
{
    return (int)(sizeof FAMILIES / sizeof FAMILIES[0]) - 1;
}

const family *family_named(const char *name)
{
    for (const family *f = FAMILIES; f->name; f++) {
        if (strcmp(f->name, name) == 0) return f;
    }
    return NULL;
}

void family_make(const family *f, uint32_t world, uint32_t preset, uint64_t seed, trial *t)
{
    oracle_random dice = {seed * 0x9e3779b97f4a7c15u + 1};
    trial_begin(t, world, preset);
    if (seed % BALLS == 0) t->config.shape = (tahr_shape){.type = TAHR_SHAPE_SPHERE, .radius = 0.5, .half_height = 0.5};
    f->make(t, &dice);
    trial_finish(t);
}
