/* SPDX-License-Identifier: MIT
 * url.h: the URLs of LCM that can be published to, taken apart and checked before liblcm sees them, which prints what
 * it does not like. */
#ifndef TAHR_LCM_URL_H
#define TAHR_LCM_URL_H

#include <tahr/abi.h>

enum { TAHR__LCM_UDPM = 1, TAHR__LCM_FILE = 2, TAHR__LCM_MEMQ = 3 };

enum { TAHR__LCM_MOST_PATH = 4095 }; /* letters; PATH_MAX of Linux with its zero */

typedef struct tahr__lcm_url {
    uint32_t scheme;                    /* TAHR__LCM_* */
    uint8_t group[4];                   /* UDPM */
    uint16_t port;                      /* UDPM */
    char path[TAHR__LCM_MOST_PATH + 1]; /* FILE */
    char problem[200];                  /* what is wrong, after an error */
} tahr__lcm_url;

/* TAHR_OK, TAHR_E_ARGUMENT, TAHR_E_UNSUPPORTED (a scheme that is not published to). */
tahr_status tahr__lcm_url_read(const char *text, tahr__lcm_url *url);

#endif
