/* SPDX-License-Identifier: MIT
 * scratch.c: see scratch.h. */
#include "scratch.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char path[512];
static int loud = -1;

static void remove_file(void)
{
    if (path[0]) unlink(path);
}

const char *scratch_file(const uint8_t *data, size_t size, const char *ending)
{
    const char *folder = getenv("TMPDIR");
    if (!path[0]) {
        snprintf(path, sizeof path, "%s/tahr-fuzz-%ld.%s", folder && *folder ? folder : "/tmp", (long)getpid(), ending);
        atexit(remove_file);
    }
    FILE *file = fopen(path, "wb");
    if (!file || fwrite(data, 1, size, file) != size || fclose(file) != 0) {
        fprintf(stderr, "%s: cannot be written\n", path);
        exit(2);
    }
    return path;
}

void scratch_quiet(void)
{
    int nowhere = open("/dev/null", O_WRONLY);
    if (loud < 0) loud = dup(STDERR_FILENO);
    if (nowhere >= 0) {
        dup2(nowhere, STDERR_FILENO);
        close(nowhere);
    }
}

void scratch_loud(void)
{
    if (loud >= 0) dup2(loud, STDERR_FILENO);
}
