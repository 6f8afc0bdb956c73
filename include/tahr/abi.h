/* SPDX-License-Identifier: MIT
 * abi.h: what every other header stands on: export macro, version, status codes, allocator, log callback. */
#ifndef TAHR_ABI_H
#define TAHR_ABI_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) && defined(TAHR_SHARED)
#ifdef TAHR_BUILD
#define TAHR_API __declspec(dllexport)
#else
#define TAHR_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define TAHR_API __attribute__((visibility("default")))
#else
#define TAHR_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Before 1.0 the minor number is the compatible range; from 1.0 on it will be the major one. */
#define TAHR_VERSION_MAJOR 0
#define TAHR_VERSION_MINOR 1
#define TAHR_VERSION_PATCH 0
#define TAHR_ABI_MAJOR 0
#define TAHR_ABI_MINOR 1
#define TAHR_ABI ((TAHR_ABI_MAJOR << 16) | TAHR_ABI_MINOR)

/* Names a body that does not exist: "no floor", "ignore nobody". */
#define TAHR_NO_BODY 0xFFFFFFFFu

/* One table feeds the enum, the names and the messages: X(constant, value, name, message). */
#define TAHR_STATUS_TABLE(X)                                                                                          \
    X(TAHR_OK, 0, "ok", "success")                                                                                    \
    X(TAHR_TRUNCATED, 1, "truncated", "more answers existed than the caller's array could hold")                      \
    X(TAHR_UNKNOWN, 2, "unknown", "a backend could not decide a query; the move stopped where it was proven free")    \
    X(TAHR_STUCK, 3, "stuck", "the character wanted to move and nothing let it")                                      \
    X(TAHR_CRUSHED, 4, "crushed", "the character still overlaps something after depenetration")                       \
    X(TAHR_QUERY_CAP, 5, "query_cap", "the step reached its promised number of queries and stopped early")            \
    X(TAHR_E_ARGUMENT, -1, "argument", "an argument is out of its range")                                             \
    X(TAHR_E_NULL, -2, "null", "a required pointer is NULL")                                                          \
    X(TAHR_E_STRUCT_SIZE, -3, "struct_size", "struct_size is smaller than version 0.1 of the struct, or far larger")  \
    X(TAHR_E_UNSUPPORTED, -4, "unsupported", "the request is valid but not supported here")                           \
    X(TAHR_E_MEMORY, -5, "memory", "an allocation failed")                                                            \
    X(TAHR_E_BACKEND, -6, "backend", "a backend or callback gave an invalid answer")                                  \
    X(TAHR_E_REENTRANT, -7, "reentrant", "the object is already in use by a call further up the stack")               \
    X(TAHR_E_ABI, -8, "abi", "header and library, or library and backend, do not fit together")                       \
    X(TAHR_E_FLOAT_MODE, -9, "float_mode", "the floating-point environment contracts, flushes or rounds differently") \
    X(TAHR_E_GEOMETRY, -10, "geometry", "a mesh or shape is malformed")                                               \
    X(TAHR_E_NOT_FOUND, -11, "not_found", "no such body, file or backend")                                            \
    X(TAHR_E_FILE, -12, "file", "a file cannot be written or read, or is not what it should be")                      \
    X(TAHR_E_TIMEOUT, -13, "timeout", "something did not end in the time given")

typedef int32_t tahr_status;

enum {
#define TAHR_STATUS_ENUM(constant, value, name, message) constant = (value),
    TAHR_STATUS_TABLE(TAHR_STATUS_ENUM)
#undef TAHR_STATUS_ENUM
};

/* Short lower-case name of a status ("argument"), "?" for a number that is none. Static memory. Since 0.1. */
TAHR_API const char *tahr_status_name(tahr_status status);

/* One English sentence without a full stop for a status. Static memory. Since 0.1. */
TAHR_API const char *tahr_status_message(tahr_status status);

/* "0.1.0". Static memory. Since 0.1. */
TAHR_API const char *tahr_version(void);

/* Compares the header an application was compiled with (pass TAHR_ABI) to this library: TAHR_OK, or TAHR_E_ABI if the
 * library is older or of another compatible range. Since 0.1. */
TAHR_API tahr_status tahr_abi_check(uint32_t header_abi);

/* Memory of one object. Alignment is a power of two of at most 64. free receives what alloc was asked for. Called only
 * while objects are opened, created, changed or closed, never inside a step. A NULL allocator means malloc and free. */
typedef struct tahr_allocator {
    void *user;
    void *(*alloc)(void *user, size_t size, size_t alignment);
    void (*free)(void *user, void *memory, size_t size, size_t alignment);
} tahr_allocator;

enum { TAHR_LOG_ERROR = 0, TAHR_LOG_WARNING = 1, TAHR_LOG_INFO = 2 };

/* Receives one message without a newline; it names the function, the argument and what was wrong with it. The text is
 * valid during the call only. Called from whichever thread called the library: from several at once if movers of one
 * world step on several. Must not call back into the object that complains. */
typedef void (*tahr_log_fn)(void *user, int32_t level, const char *message);

typedef struct tahr_log {
    void *user;
    tahr_log_fn write;
} tahr_log;

#ifdef __cplusplus
}
#endif
#endif
