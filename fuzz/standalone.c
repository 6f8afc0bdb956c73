/* SPDX-License-Identifier: MIT
 * standalone.c: a main for targets without a fuzzer: replays the files, and the files of the folders, that it is
 * given. */
#include "target.h"

#include <dirent.h>
#include <string.h>
#include <time.h>

/* s of processor time that no input may take: the slowest of the corpus takes a hundredth of it, and what once hung
 * took several times as much. */
static const double MOST_TIME = 0.5;

static int replay_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (!file) {
        fprintf(stderr, "%s: cannot be opened\n", path);
        return -1;
    }
    uint8_t *data = NULL;
    size_t size = 0, room = 0, got;
    do {
        room = room ? 2 * room : 4096;
        uint8_t *larger = realloc(data, room);
        if (!larger) break;
        data = larger;
        got = fread(data + size, 1, room - size, file);
        size += got;
    } while (size == room);
    fclose(file);
    /* An array of exactly that size, so that a sanitizer sees who reads past it. */
    uint8_t *exact = malloc(size ? size : 1);
    if (!data || !exact) return -1;
    memcpy(exact, data, size);
    free(data);
    clock_t begin = clock();
    LLVMFuzzerTestOneInput(exact, size);
    double took = (double)(clock() - begin) / CLOCKS_PER_SEC;
    FUZZ_CHECK(took <= MOST_TIME, "%s takes %.2f s", path, took);
    free(exact);
    return 1;
}

/* Number of files replayed, or -1. */
static int replay(const char *path)
{
    char name[1024];
    int count = 0;
    DIR *folder = opendir(path);
    if (!folder) return replay_file(path);
    for (struct dirent *entry = readdir(folder); entry && count >= 0; entry = readdir(folder)) {
        if (entry->d_name[0] == '.') continue;
        snprintf(name, sizeof name, "%s/%s", path, entry->d_name);
        int more = replay(name);
        if (more < 0) fprintf(stderr, "%s: not replayed\n", name);
        count = more < 0 ? -1 : count + more;
    }
    closedir(folder);
    return count;
}

int main(int argc, char **argv)
{
    int count = 0;
    for (int i = 1; i < argc; i++) {
        int more = replay(argv[i]);
        if (more < 0) return 2;
        count += more;
    }
    printf("%d inputs replayed\n", count);
    return count > 0 ? 0 : 2;
}
