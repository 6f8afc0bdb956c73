/* SPDX-License-Identifier: MIT
 * one_way.h: when a body with TAHR_BODY_ONE_WAY is there. The same rule as tahr_one_way_blocks (src/one_way.c says
 * why twice).
 *
 * A contact is judged by what the query began with and by what it meets, never by a velocity of some earlier step: so
 * platforms may move, and every frame rate gives the same answer. Faces hold whoever was above them. An edge (a corner,
 * a crest) holds only what comes down on it, else it would bend a jump past a platform's end; and not a foot that has
 * sunk into another one-way body, else the next tile would catch what passes through this one. */
#ifndef TAHR_COMMON_ONE_WAY_H
#define TAHR_COMMON_ONE_WAY_H

#include "vec.h"

#include <tahr/backend.h>

/* cos 60 degrees: what leans more is its side or its bottom. */
#define TAHR__ONE_WAY_TOP 0.5
/* An overlap of less is the rounding of who was put exactly onto it (1e-9 m at 1e7 m): of the margin, and without one
 * the error of a distance on geometry in floats (m). */
#define TAHR__ONE_WAY_ROUNDING 1e-3
#define TAHR__ONE_WAY_LEAST 2e-6

static inline double tahr__one_way_rounding(double margin)
{
    double part = TAHR__ONE_WAY_ROUNDING * margin;
    return part > TAHR__ONE_WAY_LEAST ? part : TAHR__ONE_WAY_LEAST;
}

/* distance: signed, where the question begins; normal: the contact normal; flags, margin: those of a sweep. */
static inline int tahr__one_way_blocks(tahr_vec3 up, tahr_vec3 normal, double distance, double margin, uint32_t flags)
{
    int dropped = (flags & TAHR_SWEEP_PASS) || ((flags & TAHR_SWEEP_DROP) && distance <= 2 * margin);
    if (flags & TAHR_SWEEP_WHOLE) return 1;
    return distance >= -tahr__one_way_rounding(margin) && v_dot(up, normal) >= TAHR__ONE_WAY_TOP && !dropped;
}

/* Is the contact on an edge or a corner, whose normal is that of no face? */
static inline int tahr__one_way_edge(tahr_vec3 normal, tahr_vec3 face)
{
    return v_dot(normal, face) < 1 - 1e-6;
}

/* Has the foot sunk into a one-way body that is not there, or is about to? Asked of every one-way body that does not
 * block where the question begins; distance and normal: there, of the surfaces; inside: 1 where more than the rounding
 * of the shape is in it (the cores cross), for that is no foot. */
static inline int tahr__one_way_sinks(tahr_vec3 up, tahr_vec3 normal, double distance, double margin, int inside)
{
    return distance <= 2 * margin && v_dot(up, normal) >= TAHR__ONE_WAY_TOP && !inside;
}

/* Does an edge that passed tahr__one_way_blocks hold? motion: of the sweep; below: how far the contact lies below the
 * lowest point of the shape where the question begins, along up; sinks: tahr__one_way_sinks of any body. In contacts
 * edges never count: they have no motion. */
static inline int tahr__one_way_edge_holds(tahr_vec3 up, tahr_vec3 motion, double below, double margin, int sinks)
{
    double rise = v_dot(motion, up);
    int comes_down = rise < 0 && rise * rise > 1e-18 * v_dot(motion, motion); /* flatter is the rounding of level */
    return comes_down && (!sinks || below > 2 * margin);
}

/* Sensors never block, whatever their flags. */
static inline int tahr__one_way_is(uint32_t body_flags)
{
    return (body_flags & (TAHR_BODY_ONE_WAY | TAHR_BODY_SENSOR)) == TAHR_BODY_ONE_WAY;
}

/* Is a one-way body there in a query of contacts, which does not drop? face: at the contact. */
static inline int tahr__one_way_touches(tahr_vec3 up, tahr_vec3 normal, tahr_vec3 face, double distance, double margin)
{
    return !tahr__one_way_edge(normal, face) && tahr__one_way_blocks(up, normal, distance, margin, 0);
}

/* What a sweep knows of the one-way bodies on its way. */
typedef struct tahr__one_way_sweep {
    tahr_vec3 up, motion;
    double motion_length, margin;
    double low; /* how far the shape reaches down along up from its centre */
    uint32_t flags;
    uint32_t sunk;  /* 1: the foot has sunk into one, as the sweep found out when it was asked before */
    uint32_t edged; /* an edge was met that holds */
    uint32_t sinks; /* the foot sinks into one */
} tahr__one_way_sweep;

typedef struct tahr__one_way_meeting {
    tahr_vec3 normal, face;
    tahr_vec3 point; /* relative to the start */
    double fraction;
    double
        start; /* signed distance where the question begins; where that is beyond the margin, any such, but of drops */
    uint32_t inside; /* 1: the cores touch or cross */
    uint32_t reserved;
} tahr__one_way_meeting;

/* one_way.c: is a one-way body there where it is met? */
int tahr__one_way_met(tahr__one_way_sweep *sweep, const tahr__one_way_meeting *meeting);

/* Which edges hold is not known before all bodies were asked: must they be asked again? */
static inline int tahr__one_way_again(tahr__one_way_sweep *sweep)
{
    int again = sweep->edged && sweep->sinks && !sweep->sunk;
    if (again) sweep->sunk = 1;
    return again;
}

#endif
