/* SPDX-License-Identifier: MIT
 * target.h: what every target is: one function of bytes that returns, or stops the program with a word on why. */
#ifndef TAHR_FUZZ_TARGET_H
#define TAHR_FUZZ_TARGET_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* A find: says what, and stops where a debugger and the fuzzer see it. */
#define FUZZ_CHECK(good, ...)                                                \
    do {                                                                     \
        if (!(good)) {                                                       \
            fprintf(stderr, "FIND: %s:%d: %s: ", __FILE__, __LINE__, #good); \
            fprintf(stderr, __VA_ARGS__);                                    \
            fputc('\n', stderr);                                             \
            abort();                                                         \
        }                                                                    \
    } while (0)

#endif
