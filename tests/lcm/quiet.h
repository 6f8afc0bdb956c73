/* SPDX-License-Identifier: MIT
 * quiet.h: what the library says to its log, and whether anybody prints beside it. */
#ifndef TAHR_TEST_QUIET_H
#define TAHR_TEST_QUIET_H

#include <tahr/abi.h>

typedef struct quiet {
    tahr_log log; /* keeps the last message */
    char message[512];
    uint32_t count;  /* of messages */
    int printed;     /* a file that stands for stderr, while */
    int true_stderr; /* it is kept here */
} quiet;

/* From here on stderr is a file. */
void quiet_begin(quiet *q);

/* And from here on itself again. Returns how many bytes were printed meanwhile. */
long quiet_end(quiet *q);

#endif
