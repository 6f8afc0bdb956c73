/* SPDX-License-Identifier: MIT
 * route.h: timed inputs of one character, from a JSON file. */
#ifndef TAHR_CLI_ROUTE_H
#define TAHR_CLI_ROUTE_H

#include <tahr/tahr.h>

/* Holds from time until the next entry. */
struct route_entry {
    double time; /* s */
    tahr_vec3 move, facing;
    int crouch, has_launch, has_mode;
    tahr_vec3 launch; /* m/s, in the first step of the entry */
    uint32_t mode;    /* likewise */
    int jump, has_facing;
};

struct route {
    struct route_entry *entries;
    size_t count;
    size_t next; /* the first entry that has not begun */
    tahr_vec3 start;
    int has_start;
};

/* Strict: every message names the file, the entry and the key. 0, or -1 after a message. */
int route_load(struct route *route, const char *path);

/* Fills the input for the step that begins at time; times must not decrease. A press that began and ended since the
 * last step counts for this one. 1: a new entry has begun. */
int route_input(struct route *route, double time, tahr_input *input);

void route_close(struct route *route);

#endif
