/* SPDX-License-Identifier: MIT
 * wander.c: one character's aimless walk: a new heading every 0.5 to 2 s, now and then with a jump. */
#include "wander.h"

/* How long a heading lasts and how often its start comes with a jump: the definition of wandering that the stated
 * results (steps without tunnelling, nanoseconds per step) refer to. */
#define HEADING_MIN 0.5
#define HEADING_MAX 2.0
#define JUMP_CHANCE 0.05

/* In two dimensions, where every way on may lead over something: how often a heading rests, jumps, drops, and how long
 * a jump is held at most, s. */
#define REST_CHANCE 0.1
#define SIDE_JUMP_CHANCE 0.6
#define DROP_CHANCE 0.2
#define HOLD_MAX 0.4
#define DROP_TIME 0.1 /* s */

/* Where there is something to crawl through. */
#define CROUCH_CHANCE 0.15

/* PCG32 (XSH RR 64/32), M. E. O'Neill, "PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms for
 * Random Number Generation", 2014: a 64-bit linear congruential generator whose high bits are shifted and rotated
 * out. */
uint32_t pcg_next(struct pcg *random)
{
    uint64_t old = random->state;
    random->state = old * 6364136223846793005u + random->increment;
    uint32_t shifted = (uint32_t)(((old >> 18) ^ old) >> 27);
    uint32_t turn = (uint32_t)(old >> 59);
    return (shifted >> turn) | (shifted << ((32 - turn) & 31));
}

void pcg_start(struct pcg *random, uint64_t seed, uint64_t stream)
{
    random->state = 0;
    random->increment = (stream << 1) | 1;
    pcg_next(random);
    random->state += seed;
    pcg_next(random);
}

double pcg_unit(struct pcg *random)
{
    return (double)pcg_next(random) / 4294967296.0;
}

/* Taylor series up to x^15 and x^16; on [0, pi/4] the first term left out is below 1e-16. */
static double sine(double x)
{
    double s = x * x;
    return x * (1 - s / 6 * (1 - s / 20 * (1 - s / 42 * (1 - s / 72 * (1 - s / 110 * (1 - s / 156 * (1 - s / 210)))))));
}

static double cosine(double x)
{
    double s = x * x;
    return 1 - s / 2 *
                   (1 - s / 12 *
                            (1 - s / 30 * (1 - s / 56 * (1 - s / 90 * (1 - s / 132 * (1 - s / 182 * (1 - s / 240)))))));
}

tahr_vec3 unit_vector(double turn)
{
    const double two_pi = 6.283185307179586;
    int octant = (int)(turn * 8);
    double part = turn * 8 - octant;
    double angle = (octant & 1 ? 1 - part : part) * (two_pi / 8);
    double c = octant & 1 ? sine(angle) : cosine(angle), s = octant & 1 ? cosine(angle) : sine(angle);
    switch (octant >> 1) { /* the quarter */
    case 0: return (tahr_vec3){c, s, 0};
    case 1: return (tahr_vec3){-s, c, 0};
    case 2: return (tahr_vec3){-c, -s, 0};
    default: return (tahr_vec3){s, -c, 0};
    }
}

void wander_start(struct wander *wander, uint64_t seed, uint32_t character)
{
    *wander = (struct wander){.next_change = 0};
    pcg_start(&wander->random, seed, character);
}

static void side_heading(struct wander *wander)
{
    double way = pcg_unit(&wander->random), jump = pcg_unit(&wander->random), hold = pcg_unit(&wander->random);
    double begin = wander->next_change;
    wander->heading = (tahr_vec3){way < REST_CHANCE ? 0 : way < (1 + REST_CHANCE) / 2 ? -1 : 1, 0, 0};
    wander->jump_until = jump < SIDE_JUMP_CHANCE ? begin + HOLD_MAX * hold : begin - 1;
    wander->drop_until =
        jump >= SIDE_JUMP_CHANCE && jump < SIDE_JUMP_CHANCE + DROP_CHANCE ? begin + DROP_TIME : begin - 1;
}

static int side_input(struct wander *wander, double time, tahr_input *input)
{
    int changed = 0;
    while (time >= wander->next_change) {
        double before = wander->heading.x;
        side_heading(wander);
        wander->next_change += HEADING_MIN + (HEADING_MAX - HEADING_MIN) * pcg_unit(&wander->random);
        wander->crouch = wander->crouches && pcg_unit(&wander->random) < CROUCH_CHANCE;
        changed |= wander->heading.x != before; /* with two ways to go the same one again is no new one */
    }
    input->jump = time < wander->jump_until;
    input->flags |= time < wander->drop_until ? (uint32_t)TAHR_INPUT_DROP : 0u;
    input->move = wander->heading;
    input->crouch = wander->crouch;
    return changed;
}

int wander_input(struct wander *wander, double time, tahr_input *input)
{
    int changed = 0;
    if (wander->side) {
        return side_input(wander, time, input);
    }
    input->jump = 0;
    while (time >= wander->next_change) {
        wander->heading = unit_vector(pcg_unit(&wander->random));
        wander->next_change += HEADING_MIN + (HEADING_MAX - HEADING_MIN) * pcg_unit(&wander->random);
        input->jump |= pcg_unit(&wander->random) < JUMP_CHANCE;
        wander->crouch = wander->crouches && pcg_unit(&wander->random) < CROUCH_CHANCE;
        changed = 1;
    }
    input->move = wander->heading;
    input->crouch = wander->crouch;
    return changed;
}
