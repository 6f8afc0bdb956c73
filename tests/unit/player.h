/* SPDX-License-Identifier: MIT
 * player.h: whoever holds the buttons of a rig: steps to exact times at any frame rate, and remembers what happened. */
#ifndef PLAYER_H
#define PLAYER_H

#include "rig.h"

/* Types of events that are counted. */
enum { PLAYER_EVENTS = 32 };

typedef struct player {
    rig *rig;
    double rate;                  /* Hz */
    double time;                  /* s since player_begin */
    uint32_t seen[PLAYER_EVENTS]; /* events by type */
    double when[PLAYER_EVENTS];   /* s, of the last one of each type */
    tahr_event last[PLAYER_EVENTS];
    double top; /* m, greatest height of the centre, events included */
} player;

void player_begin(player *p, rig *r, double rate);
/* Steps of 1 / rate, the last one shorter, until the time is reached. */
void player_until(player *p, double time);
/* Button down or up, and on until `time`. */
void player_press(player *p, double time);
void player_release(player *p, double time);
/* Steps until an event of the type; fails after 100 s. Stops at the end of the step it happened in. */
void player_await(player *p, uint32_t type);

#endif
