/* SPDX-License-Identifier: MIT
 * families_other.c: the other families far away, huge, tiny, at other rates, with other skins; and wrong input. */
#include "family.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* Those that mean the same anywhere and at any size. */
void make_any(trial *t, oracle_random *dice)
{
    static void (*const some[])(trial *, oracle_random *) = {make_blocks,        make_terrain, make_step_traps,
                                                             make_floor_ceiling, make_wedge,   make_gutter,
                                                             make_edges,         make_perch,   make_narrow};
    some[oracle_below(dice, sizeof some / sizeof some[0])](t, dice);
}

void make_far_origin(trial *t, oracle_random *dice)
{
    double far = draw_power(dice, 3, 6.8), way = draw(dice, 0, 6.283185307179586);
    make_any(t, dice);
    t->shift = (tahr_vec3){far * cos(way), far * sin(way), draw_one_in(dice, 2) ? 0 : -far};
}

void make_huge_scale(trial *t, oracle_random *dice)
{
    make_any(t, dice);
    t->grow = draw_power(dice, 0.5, 2);
}

void make_tiny_scale(trial *t, oracle_random *dice)
{
    make_any(t, dice);
    t->grow = draw_power(dice, -2, -0.5);
}

void make_skins(trial *t, oracle_random *dice)
{
    double times = draw_power(dice, -1, 1);
    t->config.skin *= times;
    make_any(t, dice);
}

/* Steps of a tenth to a whole second, evenly or not. */
void make_huge_dt(trial *t, oracle_random *dice)
{
    static void (*const rooms[])(trial *, oracle_random *) = {make_blocks, make_terrain, make_soup};
    double dt = draw(dice, 0.1, 1);
    int even = draw_one_in(dice, 2);
    rooms[oracle_below(dice, t->world == IN_SPACE ? 3 : 2)](t, dice);
    for (int i = 0; i < t->step_count; i++)
        t->steps[i].dt = even ? dt : draw(dice, 0.02, 1);
    t->keeps &= ~(uint32_t)KEEPS_SOLID; /* a straight line between two places says nothing: the room does */
    t->keeps &= ~(uint32_t)KEEPS_TIME;  /* a second may hold more than config.max_slides bends */
}

/* Steps of a nanosecond to a tenth of a millisecond; and of all lengths, 0 too. */
void make_tiny_dt(trial *t, oracle_random *dice)
{
    double dt = draw_power(dice, -9.5, -4);
    int even = draw_one_in(dice, 2);
    make_any(t, dice);
    for (int i = 0; i < t->step_count; i++)
        t->steps[i].dt = even ? dt : draw_one_in(dice, 6) ? 0 : draw_power(dice, -9.5, -1.2);
    t->keeps &= ~(uint32_t)KEEPS_REST;
}

/* Now and then a number of the input is none, or none that is allowed: refused, and nothing changed. */
void make_wrong_input(trial *t, oracle_random *dice)
{
    const double wrong[] = {NAN, HUGE_VAL, -HUGE_VAL, 1e300, -1e7};
    make_any(t, dice);
    for (int i = 0; i < t->step_count; i++) {
        trial_step *s = &t->steps[i];
        if (!draw_one_in(dice, 5)) continue;
        s->refused = 1;
        double value = wrong[oracle_below(dice, 5)];
        switch (oracle_below(dice, 6)) {
        case 0: s->input.move.x = value; break;
        case 1: s->input.move.z = value; break;
        case 2: s->dt = value == value && value > 0 ? -1 : value; break;
        case 3:
            s->input.flags |= TAHR_INPUT_GRAVITY;
            s->input.gravity.y = value;
            break;
        case 4:
            s->input.flags |= TAHR_INPUT_LAUNCH;
            s->input.launch.x = value;
            break;
        default:
            s->input.flags |= TAHR_INPUT_SHAPE;
            s->input.radius = 0.3;
            s->input.half_height = value;
            break;
        }
    }
}
