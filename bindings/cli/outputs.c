/* SPDX-License-Identifier: MIT
 * outputs.c: files that a run will write. */
#include "outputs.h"

#include "say.h"

#include <errno.h>
#include <string.h>

static int complain(const char *option, const char *path)
{
    say_error("--%s '%s': cannot write: %s", option, path, strerror(errno));
    return -1;
}

int output_probe(const char *option, const char *path)
{
    if (path == NULL) {
        return 0;
    }
    FILE *file = fopen(path, "r+b");
    int is_new = file == NULL && errno == ENOENT;
    if (is_new) {
        file = fopen(path, "wb");
    }
    if (file == NULL) {
        return complain(option, path);
    }
    fclose(file);
    if (is_new) {
        remove(path);
    }
    return 0;
}

FILE *output_open(const char *option, const char *path)
{
    FILE *file = fopen(path, "wb");
    if (file == NULL) {
        complain(option, path);
    }
    return file;
}

int output_close(FILE *file, const char *option, const char *path)
{
    int failed = ferror(file);
    failed |= fclose(file) != 0;
    return failed ? complain(option, path) : 0;
}
