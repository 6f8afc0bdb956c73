/* SPDX-License-Identifier: MIT
 * scene_list.c: the files of tests/scenes. */
#include "scene_list.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FOLDER TAHR_SOURCE_DIR "/tests/scenes"

static int by_name(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

int scene_list(char *files[SCENE_MAX_FILES])
{
    DIR *folder = opendir(FOLDER);
    struct dirent *entry;
    int count = 0;
    while (folder && (entry = readdir(folder)) != NULL) {
        size_t n = strlen(entry->d_name), size = sizeof FOLDER "/" + n;
        if (n <= 5 || strcmp(entry->d_name + n - 5, ".json") != 0) {
            continue;
        }
        char *path = count < SCENE_MAX_FILES ? malloc(size) : NULL;
        if (!path) {
            printf("too many scenes, or too little memory\n");
            exit(1);
        }
        snprintf(path, size, "%s/%s", FOLDER, entry->d_name);
        files[count++] = path;
    }
    if (folder) {
        closedir(folder);
    }
    qsort(files, (size_t)count, sizeof *files, by_name);
    return count;
}

int scene_list_is(const char *path, const char *name)
{
    const char *file = strrchr(path, '/') + 1;
    return strncmp(file, name, strlen(name)) == 0 && file[strlen(name)] == '.';
}
