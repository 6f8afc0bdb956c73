/* SPDX-License-Identifier: MIT
 * publish.h: a sink's messages as LCM's. */
#ifndef TAHR_LCM_PUBLISH_H
#define TAHR_LCM_PUBLISH_H

#include "connection.h"

/* Of the longest name, with a zero: prefix, TAHR_SNAPSHOT; and of that with _ and the ten digits of a number. */
enum {
    TAHR__LCM_MOST_PREFIX = 32,
    TAHR__LCM_NAME = TAHR__LCM_MOST_PREFIX + 13 + 1,
    TAHR__LCM_CHANNEL = TAHR__LCM_NAME + 11
};

/* Holds every message but those of worlds, whose settings have any length; the longest is a snapshot_t, 588 bytes. */
enum { TAHR__LCM_MESSAGE = 1024 };

struct tahr_lcm {
    tahr_sink sink;
    tahr__lcm_connection connection;
    tahr_allocator allocator;
    uint32_t flags;
    char names[TAHR_MESSAGE_COUNT][TAHR__LCM_NAME]; /* of channels, by TAHR_MESSAGE_* */
    unsigned char *world;                           /* room for a world_t, of */
    uint32_t world_room;                            /* bytes */
};

/* Fills in the functions of lcm->sink. */
void tahr__lcm_publish_with(tahr_lcm *lcm);

#endif
