/* SPDX-License-Identifier: MIT
 * scratch.c: see scratch.h. */
#include "scratch.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { STREAMS = 2 };

static char path[512];
static int loud[STREAMS] = {-1, -1}; /* where standard output and standard error went */

static void remove_file(void)
{
    if (path[0]) unlink(path);
}

/* A folder in memory where there is one: a fuzzer writes thousands of files a second. */
static const char *scratch_folder(void)
{
    const char *folder = getenv("TMPDIR");
    if (folder && *folder) return folder;
    return access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp";
}

const char *scratch_file(const uint8_t *data, size_t size, const char *ending)
{
    if (!path[0]) atexit(remove_file);
    remove_file();
    snprintf(path, sizeof path, "%s/tahr-fuzz-%ld.%s", scratch_folder(), (long)getpid(), ending);
    FILE *file = fopen(path, "wb");
    if (!file || fwrite(data, 1, size, file) != size || fclose(file) != 0) {
        fprintf(stderr, "%s: cannot be written\n", path);
        exit(2);
    }
    return path;
}

void scratch_quiet(void)
{
    if (getenv("TAHR_FUZZ_LOUD")) return;
    int nowhere = open("/dev/null", O_WRONLY);
    fflush(stdout);
    for (int i = 0; i < STREAMS && nowhere >= 0; i++) {
        if (loud[i] < 0) loud[i] = dup(STDOUT_FILENO + i);
        dup2(nowhere, STDOUT_FILENO + i);
    }
    if (nowhere >= 0) close(nowhere);
}

void scratch_loud(void)
{
    fflush(stdout);
    for (int i = 0; i < STREAMS; i++) {
        if (loud[i] >= 0) dup2(loud[i], STDOUT_FILENO + i);
    }
}
