/* SPDX-License-Identifier: MIT
 * listeners.h: who listens to a multicast group on this machine, and how far he is behind. */
#ifndef TAHR_LCM_LISTENERS_H
#define TAHR_LCM_LISTENERS_H

#include <stdint.h>

typedef struct tahr__lcm_listeners {
    int table;      /* the system's list of UDP sockets, or -1: it has none, and nobody is known to lag */
    uint32_t group; /* in the order of the network */
    uint32_t port;  /* 0: of no group */
    uint32_t usual; /* bytes of a socket's buffer, unless it asked for another one */
} tahr__lcm_listeners;

void tahr__lcm_listeners_open(tahr__lcm_listeners *listeners, const uint8_t group[4], uint16_t port);
void tahr__lcm_listeners_close(tahr__lcm_listeners *listeners);

/* 1: the buffer of one is more than half full, and not yet lost. Takes some 30 us. */
int tahr__lcm_listeners_lag(const tahr__lcm_listeners *listeners);

#endif
