/* SPDX-License-Identifier: MIT
 * say.h: messages for people, and memory that is there or ends the program. */
#ifndef TAHR_CLI_SAY_H
#define TAHR_CLI_SAY_H

#include <stddef.h>
#include <tahr/abi.h>

/* Exit codes of the shell. */
enum { EXIT_GOOD = 0, EXIT_CHECK_FAILED = 1, EXIT_USAGE = 2 };

#if defined(__GNUC__)
#define SAY_FORMAT __attribute__((format(printf, 1, 2)))
#else
#define SAY_FORMAT
#endif

/* "tahr: ..." and a newline on standard error. */
void say_error(const char *format, ...) SAY_FORMAT;

/* A log for worlds and movers that speaks through say_error. */
tahr_log say_log(void);

/* Memory for count items of size bytes, zeroed; ends the program with a message when there is none. */
void *memory_new(size_t count, size_t size);

/* Room for at least `need` items: grows *capacity by halves and returns the memory at its new place. */
void *memory_grow(void *memory, size_t *capacity, size_t need, size_t size);

/* A copy of text to be freed. */
char *memory_text(const char *text);

#endif
