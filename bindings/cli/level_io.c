/* SPDX-License-Identifier: MIT
 * level_io.c: how Assimp opens files: read only, and regular files only. */
#include "level_io.h"

#include "say.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

static FILE *stream_of(struct aiFile *file)
{
    return (FILE *)(void *)file->UserData;
}

static size_t read_items(struct aiFile *file, char *items, size_t size, size_t count)
{
    return fread(items, size, count, stream_of(file));
}

static size_t write_items(struct aiFile *file, const char *items, size_t size, size_t count)
{
    (void)file, (void)items, (void)size, (void)count;
    return 0;
}

static size_t tell(struct aiFile *file)
{
    long place = ftell(stream_of(file));
    return place < 0 ? 0 : (size_t)place;
}

static size_t file_size(struct aiFile *file)
{
    struct stat status;
    return fstat(fileno(stream_of(file)), &status) == 0 ? (size_t)status.st_size : 0;
}

static enum aiReturn seek(struct aiFile *file, size_t offset, enum aiOrigin origin)
{
    int whence = origin == aiOrigin_SET ? SEEK_SET : origin == aiOrigin_CUR ? SEEK_CUR : SEEK_END;
    return fseek(stream_of(file), (long)offset, whence) == 0 ? aiReturn_SUCCESS : aiReturn_FAILURE;
}

static void flush(struct aiFile *file)
{
    (void)file;
}

static struct aiFile *open_file(struct aiFileIO *io, const char *path, const char *mode)
{
    struct stat status;
    (void)io;
    FILE *stream = mode[0] == 'r' ? fopen(path, "rb") : NULL;
    if (stream != NULL && (fstat(fileno(stream), &status) != 0 || !S_ISREG(status.st_mode))) {
        fclose(stream);
        stream = NULL;
    }
    if (stream == NULL) {
        return NULL;
    }
    struct aiFile *file = memory_new(1, sizeof *file);
    *file = (struct aiFile){.ReadProc = read_items,
                            .WriteProc = write_items,
                            .TellProc = tell,
                            .FileSizeProc = file_size,
                            .SeekProc = seek,
                            .FlushProc = flush,
                            .UserData = (char *)(void *)stream};
    return file;
}

static void close_file(struct aiFileIO *io, struct aiFile *file)
{
    (void)io;
    fclose(stream_of(file));
    free(file);
}

struct aiFileIO level_io(void)
{
    return (struct aiFileIO){.OpenProc = open_file, .CloseProc = close_file, .UserData = NULL};
}
