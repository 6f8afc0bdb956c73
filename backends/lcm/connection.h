/* SPDX-License-Identifier: MIT
 * connection.h: where messages go: an lcm_t, or an event log that is written without one. */
#ifndef TAHR_LCM_CONNECTION_H
#define TAHR_LCM_CONNECTION_H

#include "pace.h"

#include <tahr/lcm.h>

#include <lcm/lcm.h>

typedef struct tahr__lcm_connection {
    lcm_t *lcm;          /* or NULL: */
    lcm_eventlog_t *log; /* liblcm's own provider of files does not tell when a write fails */
    tahr_log complaints;
    int is_own; /* lcm is destroyed with it */
    int is_paced;
    int is_failing; /* the last message did not go out; of a log: one, and so none any more */
    tahr__lcm_pace pace;
} tahr__lcm_connection;

/* Complains with the format's text, "tahr_lcm_open: ...", and returns status. log may be NULL. */
tahr_status tahr__lcm_complain(const tahr_log *log, tahr_status status, const char *format, ...);

/* Connects to desc.lcm or desc.url, both checked here. TAHR_OK, or what tahr_lcm_open says of them, with a message. */
tahr_status tahr__lcm_connect(tahr__lcm_connection *connection, const tahr_lcm_desc *desc);

/* TAHR_OK, TAHR_E_FILE: it did not go out. Waits where a burst is over. */
tahr_status tahr__lcm_send(tahr__lcm_connection *connection, const char *channel, const void *bytes, uint32_t size);

/* Nothing more comes at the moment: what a log holds back goes into its file. */
void tahr__lcm_flush(tahr__lcm_connection *connection);

void tahr__lcm_disconnect(tahr__lcm_connection *connection);

#endif
