/* SPDX-License-Identifier: MIT
 * route.h: timed inputs of one character, from a JSON file. */
#ifndef TAHR_CLI_ROUTE_H
#define TAHR_CLI_ROUTE_H

#include <tahr/tahr.h>

/* What an entry waits for, once the one before has begun. */
enum route_wait { ROUTE_TIME, ROUTE_AFTER, ROUTE_AT_X, ROUTE_AT_Y };

/* Holds until the next entry begins. */
struct route_entry {
    enum route_wait wait;
    double time; /* s; of AT_X and AT_Y a coordinate of the centre, m */
    tahr_vec3 move, facing;
    int crouch, has_launch, has_mode;
    tahr_vec3 launch; /* m/s, in the first step of the entry */
    uint32_t mode;    /* likewise */
    int jump, drop, has_facing;
};

struct route {
    struct route_entry *entries;
    size_t count;
    size_t next; /* the first entry that has not begun */
    tahr_vec3 start;
    int has_start;
    double begun;     /* when the entry before `next` began, s */
    tahr_vec3 before; /* where the character was when it was last asked */
};

/* Strict: every message names the file, the entry and the key. planar: of vectors z may be left out. 0, or -1 after a
 * message. */
int route_load(struct route *route, const char *path, int planar);

/* The bundled route. */
void route_tour(struct route *route);

/* Fills the input for the step that begins at time with the character's centre at `place`; times must not decrease. A
 * press that began and ended since the last step counts for this one. 1: a new entry has begun. */
int route_input(struct route *route, double time, tahr_vec3 place, tahr_input *input);

void route_close(struct route *route);

#endif
