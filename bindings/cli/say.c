/* SPDX-License-Identifier: MIT
 * say.c: messages for people, and memory that is there or ends the program. */
#include "say.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void say_error(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fputs("tahr: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
}

static void write_log(void *user, int32_t level, const char *message)
{
    (void)user;
    if (level != TAHR_LOG_INFO) {
        say_error("%s", message);
    }
}

tahr_log say_log(void)
{
    return (tahr_log){NULL, write_log};
}

static void end_without_memory(void)
{
    say_error("out of memory");
    exit(EXIT_CHECK_FAILED);
}

void *memory_new(size_t count, size_t size)
{
    void *memory = calloc(count ? count : 1, size);
    if (memory == NULL) {
        end_without_memory();
    }
    return memory;
}

void *memory_grow(void *memory, size_t *capacity, size_t need, size_t size)
{
    size_t wanted = *capacity;
    if (need <= wanted) {
        return memory;
    }
    wanted = wanted + wanted / 2 > need ? wanted + wanted / 2 : need;
    wanted = wanted < 16 ? 16 : wanted;
    void *grown = wanted > SIZE_MAX / size ? NULL : realloc(memory, wanted * size);
    if (grown == NULL) {
        end_without_memory();
    }
    *capacity = wanted;
    return grown;
}

char *memory_text(const char *text)
{
    size_t size = strlen(text) + 1;
    return memcpy(memory_new(size, 1), text, size);
}
