/* SPDX-License-Identifier: MIT
 * listeners.c: Linux tells in /proc/net/udp, a line for each socket, what it was bound to and how many bytes wait to be
 * read from it. */
#include "listeners.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* net.core.rmem_default, and where that cannot be read what it is as a rule. */
static uint32_t usual_buffer(void)
{
    enum { USUAL = 212992 };
    char text[24] = "";
    const int file = open("/proc/sys/net/core/rmem_default", O_RDONLY | O_CLOEXEC);
    if (file >= 0) {
        if (read(file, text, sizeof text - 1) < 0) text[0] = 0;
        close(file);
    }
    const long value = strtol(text, NULL, 10);
    return value > 0 && value < INT32_MAX ? (uint32_t)value : USUAL;
}

void tahr__lcm_listeners_open(tahr__lcm_listeners *l, const uint8_t group[4], uint16_t port)
{
    memcpy(&l->group, group, sizeof l->group);
    l->port = port;
    l->usual = usual_buffer();
    l->table = open("/proc/net/udp", O_RDONLY | O_CLOEXEC);
}

void tahr__lcm_listeners_close(tahr__lcm_listeners *l)
{
    if (l->table >= 0) close(l->table);
}

/* One that is full to an eighth has lost messages already, or has a larger buffer: nobody waits for it. */
static int lags(const tahr__lcm_listeners *l, const char *line)
{
    unsigned address, port, waiting;
    if (sscanf(line, " %*u: %8X:%4X %*8X:%*4X %*2X %*8X:%8X", &address, &port, &waiting) != 3) return 0;
    if (port != l->port || (address != l->group && address != 0)) return 0;
    return waiting > l->usual / 4 && waiting < l->usual - l->usual / 8;
}

int tahr__lcm_listeners_lag(const tahr__lcm_listeners *l)
{
    char text[4096 + 1];
    size_t kept = 0;
    off_t at = 0;
    ssize_t size;

    if (l->table < 0) return 0;
    while ((size = pread(l->table, text + kept, sizeof text - 1 - kept, at)) > 0) {
        char *line = text, *end;
        at += size;
        kept += (size_t)size;
        text[kept] = 0;
        for (; (end = strchr(line, '\n')) != NULL; line = end + 1) {
            *end = 0;
            if (lags(l, line)) return 1;
        }
        kept -= (size_t)(line - text);
        memmove(text, line, kept);
    }
    return 0;
}
