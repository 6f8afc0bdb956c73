/* SPDX-License-Identifier: MIT
 * ledge.c: where a floor ends, and staying on it. */
#include "ledge.h"

#include "floor.h"
#include "move.h"
#include "plane.h"
#include "report.h"
#include "slide.h"

/* By halving, until the place is known to a millionth of the piece, or less well where every look asks much: the rest
 * of the step must be left enough to ask. */
void tahr__floor_end(tahr__step *step, const tahr__path *w, vec3 to, double *inside, double *outside)
{
    enum { ROUNDS = 20, MOST = TAHR_MAX_QUERIES_PER_STEP * 5 / 8 };
    tahr_floor floor;
    *inside = 0;
    *outside = 1;
    for (int i = 0; i < ROUNDS && step->queries < MOST && step->error >= 0; i++) {
        double middle = 0.5 * (*inside + *outside);
        step->state.position = add_scaled(w->from, sub(to, w->from), middle);
        tahr__find_floor(step, step->config->snap_distance, NULL, &floor);
        *(floor_is_walkable(&floor) ? inside : outside) = middle;
    }
}

/* Stops at the last place with a floor and goes on along the edge. Returns 1 if there is such a place. */
static int hold_at_ledge(tahr__step *step, tahr__path *w)
{
    vec3 to = step->state.position;
    tahr_floor floor;
    double part, outside;
    tahr__floor_end(step, w, to, &part, &outside);
    step->state.position = add_scaled(w->from, sub(to, w->from), part);
    tahr__find_floor(step, step->config->snap_distance, NULL, &floor);
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

void tahr__stay_on_ledge(tahr__step *step, tahr__path *w)
{
    tahr_floor floor;
    for (int corner = 0; corner < 2; corner++) {
        if (!hold_at_ledge(step, w)) {
            step->state.position = w->from;
            break;
        }
        vec3 held = step->state.position;
        tahr_floor held_floor = step->state.floor;
        tahr__path_carry_floor(w, step);
        tahr__path_walk(step, w);
        tahr__find_floor(step, step->config->snap_distance, NULL, &floor);
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
