/* SPDX-License-Identifier: MIT
 * bus.h: a connection to LCM, for commands that hear what others publish, or publish what was recorded. */
#ifndef TAHR_CLI_LCM_BUS_H
#define TAHR_CLI_LCM_BUS_H

#include <lcm/lcm.h>

/* URL, or what stands for it where none is given. */
const char *bus_url(const char *url);

/* To be heard: udpm://, or file:// to be played back as it was recorded. NULL after a message that names the option. */
lcm_t *bus_open_to_hear(const char *url);

/* To be published on: udpm:// alone. NULL after a message. */
lcm_t *bus_open_to_speak(const char *url);

/* What is done with what is heard. */
struct bus_listener {
    void (*hear)(void *user, const lcm_recv_buf_t *message, const char *channel);
    void (*pause)(void *user); /* nothing more is there at the moment, or a tenth of a second is over */
    int (*is_done)(void *user);
    void *user;
    double seconds; /* and it ends after so long; 0: not */
};

/* Hears everything on all channels, until it is done, the time is over, a signal comes or a file ends. 0, or -1 after a
 * message that it cannot begin. */
int bus_listen(lcm_t *lcm, const struct bus_listener *listener);

#endif
