/* SPDX-License-Identifier: MIT
 * ledge.c: staying on a floor that ends. */
#include "ledge.h"

#include "floor.h"
#include "floor_end.h"
#include "move.h"
#include "plane.h"
#include "report.h"
#include "slide.h"

/* Stops at the last place with a floor and goes on along the edge. Returns 1 if there is such a place. */
static int hold_at_ledge(tahr__step *step, tahr__path *w, const tahr_floor *beyond)
{
    tahr__floor_border end;
    tahr__floor_end(step, w, beyond, &end);
    tahr_floor floor = end.floor;
    double part = end.inside;
    if (!floor_is_walkable(&floor)) {
        return tahr__decide(step, TAHR_RULE_LEDGE, 0, NULL, part, 0, "no floor on the way here");
    }
    tahr__path_cut(step, w, part);
    /* The contact with the edge leans outward: its level part is the wall that keeps the character in. */
    tahr__plane edge = {.normal = unit(scale(step_level(step, floor.normal), -1)),
                        .anchor = step->state.position,
                        .body = floor.body,
                        .feature = floor.feature};
    int faces_out = is_in_plane(step) && !tahr__plane_surface(step, &edge.normal, &edge.offset);
    if (length_squared(edge.normal) == 0 || faces_out) {
        edge.normal = unit(scale(step_level(step, w->wish), -1));
    }
    /* A thousandth of a skin inward, so that going on along the edge does not lose the floor to rounding. */
    tahr_hit hit;
    tahr__move(step, scale(edge.normal, 1e-3 * step->config->skin), &hit);
    tahr__find_floor(step, step->config->snap_distance, NULL, &floor);
    tahr__keep_floor(step, &floor);
    tahr__planes_add(w->walls, &w->wall_count, &edge);
    tahr__path_bend(step, w);
    return tahr__decide(step, TAHR_RULE_LEDGE, 1, NULL, part, 1, "held at the ledge");
}

void tahr__stay_on_ledge(tahr__step *step, tahr__path *w, const tahr_floor *beyond)
{
    tahr_floor floor = *beyond;
    for (int corner = 0; corner < 2; corner++) {
        if (!hold_at_ledge(step, w, &floor)) {
            step->state.position = w->from;
            break;
        }
        vec3 held = step->state.position;
        tahr_floor held_floor = step->state.floor;
        tahr__path_carry_floor(w, step);
        tahr__path_walk(step, w);
        tahr__path_look_below(step, w, &floor);
        if (floor_is_walkable(&floor)) {
            tahr__keep_floor(step, &floor);
            return;
        }
        if (corner == 1) {
            step->state.position = held;
            tahr__keep_floor(step, &held_floor);
        }
    }
    step->state.velocity = vec(0, 0, 0);
}
