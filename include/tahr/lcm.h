/* SPDX-License-Identifier: MIT
 * lcm.h: a telemetry sink that publishes over LCM. Not part of libtahr: link libtahr_lcm, and liblcm. The types of the
 * messages are in the installed folder share/tahr/lcm; backends/lcm/README.md lists the channels. */
#ifndef TAHR_LCM_H
#define TAHR_LCM_H

#include <tahr/sink.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct tahr_lcm tahr_lcm;

/* ID_SUFFIX: the channels of characters end in _ID: TAHR_STATE_3. */
enum { TAHR_LCM_ID_SUFFIX = 1 << 0 };

/* url: udpm://, file:// (an event log, written anew) or memq:// (which nobody hears but subscribers of your own lcm);
 * NULL: the environment's LCM_DEFAULT_URL, or else udpm://, LCM's usual group.
 * burst, rate: to a network so many messages are sent at once, and so many in a second, so that a listener's buffer of
 * the usual size does not run over; a message counts once more for each kilobyte. Files need no such wait, nor does
 * memq://; an lcm of yours waits, for it may be a network.
 * [in] everything is copied, but lcm. Zero what you do not use. */
typedef struct tahr_lcm_desc {
    uint32_t struct_size;
    uint32_t flags; /* TAHR_LCM_* */
    const char *url;
    const char *prefix; /* put before the names of the channels, up to 32 letters; NULL: none */
    void *lcm;          /* an lcm_t of yours, used instead of url; must stay valid until the sink is closed */
    uint32_t burst;     /* [0: 16] 1..65536, not above rate */
    uint32_t rate;      /* [0: 64000] per second; UINT32_MAX: as fast as it goes */
    const tahr_allocator *allocator; /* NULL: malloc; asked again by the thread that tells of the first world */
    const tahr_log *log; /* NULL: silent; that thread tells when messages begin to fail, once until one goes out */
} tahr_lcm_desc;

/* Sets every field to its default: zero, but struct_size. [out] desc of size bytes. Untouched on error. Allocates
 * nothing; may run on several threads. Returns TAHR_OK, TAHR_E_NULL, TAHR_E_STRUCT_SIZE. Since 0.1. */
TAHR_API tahr_status tahr_lcm_desc_init(tahr_lcm_desc *desc, size_t size);

/* Connects to LCM. [out] lcm, untouched on failure; close it with tahr_lcm_close.
 * Returns TAHR_OK, TAHR_E_NULL, TAHR_E_STRUCT_SIZE, TAHR_E_UNSUPPORTED (unknown flags or tail; tcpq://, whose publish
 * waits for ever for a server that stalls; an unknown scheme), TAHR_E_ARGUMENT (prefix, burst, url), TAHR_E_FILE (a
 * file that cannot be written), TAHR_E_NOT_FOUND (no route for multicast, or LCM cannot be set up for another reason),
 * TAHR_E_MEMORY; the log says which. Since 0.1. */
TAHR_API tahr_status tahr_lcm_open(const tahr_lcm_desc *desc, tahr_lcm **lcm);

/* For tahr_telemetry_desc.sink, of one telemetry at a time. NULL for NULL. Valid until tahr_lcm_close. Since 0.1. */
TAHR_API const tahr_sink *tahr_lcm_sink(tahr_lcm *lcm);

/* Closes it; no telemetry may use it any more. NULL is allowed. Since 0.1. */
TAHR_API void tahr_lcm_close(tahr_lcm *lcm);

#ifdef __cplusplus
}
#endif
#endif
