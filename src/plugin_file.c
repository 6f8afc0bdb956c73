/* SPDX-License-Identifier: MIT
 * plugin_file.c: a look at a file before the system loads it. Loaders map what the head of a shared object tells of: if
 * the file ends before (a copy or a build under way) they crash, and opening a pipe waits for who writes into it. */
#include "plugin_file.h"

#if !defined(TAHR_NO_PLUGINS) && (defined(__unix__) || defined(__APPLE__) || defined(__HAIKU__))
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#if defined(__linux__)
#include <link.h>

/* What the file has to hold for all of its segments; 0: it is no shared object of this machine, or cannot be read,
 * which the loader says better. */
static uint64_t bytes_needed(FILE *file)
{
    ElfW(Ehdr) head;
    uint64_t most = 0;
    if (fread(&head, 1, sizeof head, file) != sizeof head || memcmp(head.e_ident, ELFMAG, SELFMAG) != 0 ||
        head.e_phentsize != sizeof(ElfW(Phdr)) || head.e_phoff > INT32_MAX ||
        fseek(file, (long)head.e_phoff, SEEK_SET) != 0) {
        return 0;
    }
    for (unsigned i = 0; i < head.e_phnum; i++) {
        ElfW(Phdr) part;
        if (fread(&part, 1, sizeof part, file) != sizeof part) {
            return head.e_phoff + (uint64_t)head.e_phnum * sizeof part;
        }
        uint64_t end = (uint64_t)part.p_offset + part.p_filesz;
        most = part.p_type == PT_LOAD && end > most ? end : most;
    }
    return most;
}

static int is_whole(const char *path, uint64_t size, char *text, size_t room)
{
    FILE *file = fopen(path, "rb");
    uint64_t needed = file ? bytes_needed(file) : 0;
    if (file) {
        fclose(file);
    }
    if (needed > size) {
        snprintf(text, room, "the file is cut off: it has %llu bytes, expected at least %llu", (unsigned long long)size,
                 (unsigned long long)needed);
    }
    return needed <= size;
}
#else
static int is_whole(const char *path, uint64_t size, char *text, size_t room)
{
    (void)path, (void)size, (void)text, (void)room;
    return 1;
}
#endif

int tahr__plugin_file_check(const char *path, char *text, size_t room)
{
    struct stat info;
    if (stat(path, &info) != 0) {
        return 1;
    }
    if (!S_ISREG(info.st_mode)) {
        snprintf(text, room, "it is %s, expected a file",
                 S_ISDIR(info.st_mode) ? "a folder" : (S_ISFIFO(info.st_mode) ? "a pipe" : "a device or a socket"));
        return 0;
    }
    return is_whole(path, (uint64_t)info.st_size, text, room);
}
#else
int tahr__plugin_file_check(const char *path, char *text, size_t room)
{
    (void)path, (void)text, (void)room;
    return 1;
}
#endif
