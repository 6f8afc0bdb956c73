/* SPDX-License-Identifier: MIT
 * quiet.c: a log that remembers, and a stderr that counts. */
#include "quiet.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void keep(void *user, int32_t level, const char *message)
{
    quiet *q = user;
    (void)level;
    q->count++;
    snprintf(q->message, sizeof q->message, "%s", message);
}

void quiet_begin(quiet *q)
{
    char name[] = "/tmp/tahr_quiet_XXXXXX";

    memset(q, 0, sizeof *q);
    q->log = (tahr_log){q, keep};
    fflush(stderr);
    q->printed = mkstemp(name);
    q->true_stderr = dup(STDERR_FILENO);
    if (q->printed < 0 || q->true_stderr < 0) abort();
    unlink(name);
    dup2(q->printed, STDERR_FILENO);
}

long quiet_end(quiet *q)
{
    fflush(stderr);
    const long size = (long)lseek(q->printed, 0, SEEK_END);
    dup2(q->true_stderr, STDERR_FILENO);
    close(q->printed);
    close(q->true_stderr);
    return size;
}
