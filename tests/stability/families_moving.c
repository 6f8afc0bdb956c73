/* SPDX-License-Identifier: MIT
 * families_moving.c: bodies that carry, push, turn, jump and crush. */
#include "family.h"

#include <math.h>

static tahr_vec3 at(double x, double y, double z)
{
    return (tahr_vec3){x, y, z};
}

/* What holds while bodies push: no tunnel, no speed but theirs, and nearer to nothing than where they have come to. */
static void among_movers(trial *t)
{
    t->keeps &= ~(uint32_t)(KEEPS_SAYING | KEEPS_REST | KEEPS_FLOOR);
    trial_box(t, at(0, 0, -9), at(40, 40, 1), 0);
}

static void stand_and_walk(trial *t, oracle_random *dice, double x, double y)
{
    trial_stand(t, x, y, t->config.skin * 1.25);
    if (draw_one_in(dice, 2)) trial_wander(t, dice, 60, draw(dice, -3.2, 3.2), 3, 30);
    t->first_rest = t->step_count;
    trial_idle(t, 60);
}

/* Goes up and down, faster than gravity now and then. */
void make_lift(trial *t, oracle_random *dice)
{
    trial_body *b = trial_box(t, at(0, 0, -0.5), at(3, 3, 0.5), TAHR_BODY_MOVABLE);
    b->motion.rate = draw_power(dice, -0.5, 1.3);
    b->motion.swing = at(0, 0, fmin(draw(dice, 0.05, 3), 30 / b->motion.rate));
    b->motion.phase = draw(dice, 0, 6.3);
    stand_and_walk(t, dice, 0, 0);
    among_movers(t);
}

/* To and fro, and slanting; past a wall at the side. */
void make_shuttle(trial *t, oracle_random *dice)
{
    trial_body *b = trial_box(t, at(0, 0, -0.5), at(2.5, 2.5, 0.5), TAHR_BODY_MOVABLE);
    b->motion.rate = draw_power(dice, -0.5, 0.8);
    b->motion.swing = at(draw(dice, 0.2, 3), draw(dice, -1, 1), draw_one_in(dice, 2) ? 0 : draw(dice, -1, 1));
    b->motion.phase = draw(dice, 0, 6.3);
    if (draw_one_in(dice, 2)) trial_box(t, at(5.5 + draw(dice, 0, 1), 0, 1), at(1, 6, 2.5), 0);
    stand_and_walk(t, dice, draw(dice, -1, 1), draw(dice, -1, 1));
    among_movers(t);
}

/* Turns about up, tilts about another axis, or tumbles. In the plane: tilts. */
void make_turntable(trial *t, oracle_random *dice)
{
    trial_body *b = trial_box(t, at(0, 0, -0.5), at(6, 6, 0.5), TAHR_BODY_MOVABLE);
    double tilt = draw(dice, -0.5, 0.5);
    b->motion.axis = at(0, 1, 0);
    b->motion.spin = tilt;
    if (t->world == IN_SPACE && !draw_one_in(dice, 4)) {
        double level = draw_one_in(dice, 3) ? draw(dice, -0.3, 0.3) : 0, size = sqrt(1 + level * level);
        b->motion.axis = at(level / size, 0, 1 / size);
        b->motion.spin = draw(dice, -3, 3);
    }
    stand_and_walk(t, dice, draw(dice, -4, 4), draw(dice, -4, 4));
    among_movers(t);
}

/* The floor, or a block beside it, is somewhere else all at once: nobody may be flung. */
void make_teleport(trial *t, oracle_random *dice)
{
    trial_body *b = trial_box(t, at(0, 0, -0.5), at(3, 3, 0.5), TAHR_BODY_MOVABLE);
    int floor_jumps = draw_one_in(dice, 2);
    trial_body *other = trial_box(t, at(4, 0, 0.5), at(0.7, 0.7, 0.5), TAHR_BODY_MOVABLE);
    trial_body *jumps = floor_jumps ? b : other;
    jumps->motion.teleports = 5 + (int)oracle_below(dice, 20);
    jumps->motion.hop = floor_jumps ? at(draw(dice, -8, 8), draw(dice, -8, 8), draw(dice, -2, 0.3))
                                    : at(draw(dice, -5, -3), draw(dice, -0.5, 0.5), 0);
    stand_and_walk(t, dice, draw(dice, -1, 1), draw(dice, -1, 1));
    among_movers(t);
    t->keeps &= ~(uint32_t)KEEPS_SOLID; /* what appears around somebody was not gone through */
}

/* A wall, a ceiling or a lift that closes on somebody, with room left in the end or none. */
void make_crusher(trial *t, oracle_random *dice)
{
    double r = trial_radius(t), h = trial_half(t), speed = draw_power(dice, -1, 1);
    uint32_t which = oracle_below(dice, 3);
    double way = draw(dice, 0.2, 1.2);
    trial_box(t, at(0, 0, -0.5), at(12, 12, 0.5), which == 2 ? (uint32_t)TAHR_BODY_MOVABLE : 0u);
    trial_body *floor = &t->bodies[0];
    if (which == 0) {
        trial_body *wall = trial_box(t, at(-r - 1.5, 0, 1), at(1, 3, 1), TAHR_BODY_MOVABLE);
        trial_box(t, at(r + 1.5 + draw(dice, 0, 1), 0, 1), at(1, 3, 1), 0);
        wall->motion.drift = at(speed, 0, 0);
        wall->motion.lasts = way / speed;
    } else if (which == 1) {
        trial_body *ceiling = trial_box(t, at(0, 0, 2 * h + 1.3), at(3, 3, 1), TAHR_BODY_MOVABLE);
        ceiling->motion.drift = at(0, 0, -speed);
        ceiling->motion.lasts = way / speed;
    } else {
        trial_box(t, at(0, 0, 2 * h + 1.4), at(3, 3, 1), 0);
        floor->motion.drift = at(0, 0, speed);
        floor->motion.lasts = way / speed;
    }
    stand_and_walk(t, dice, 0, 0);
    among_movers(t);
    t->keeps &= ~(uint32_t)(KEEPS_SKIN | KEEPS_SOLID); /* there may be no room at all */
}
