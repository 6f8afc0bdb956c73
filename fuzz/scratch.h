/* SPDX-License-Identifier: MIT
 * scratch.h: the bytes of one input as a file, for readers that want a path. */
#ifndef TAHR_FUZZ_SCRATCH_H
#define TAHR_FUZZ_SCRATCH_H

#include <stddef.h>
#include <stdint.h>

/* Path of a file with these bytes and that ending ("obj"), in memory if this machine can; ends the program if there is
 * none. It is removed with the next one and when the program ends. */
const char *scratch_file(const uint8_t *data, size_t size, const char *ending);

/* Messages of readers are not wanted: standard output and standard error are kept away until scratch_loud, unless
 * TAHR_FUZZ_LOUD is set: then what a sanitizer says of a find is seen too. */
void scratch_quiet(void);
void scratch_loud(void);

#endif
