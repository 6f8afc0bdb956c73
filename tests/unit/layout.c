/* SPDX-License-Identifier: MIT
 * layout.c: prints sizes, offsets, constants and prototypes of the public headers, one per line, for comparison
 * with layout.golden. layout.sh generates the list it expands, includes every public header before it, and compiles it
 * as C99, C11, C17 and C++17: all of them must print the same. Fails by itself on padding nobody declared, on a
 * struct_size that is not the first field, and on a state that is not 512 bytes. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int failures;
static const char *current;
static size_t covered;

static void begin(const char *name, size_t size, size_t alignment)
{
    printf("struct %s size %lu align %lu\n", name, (unsigned long)size, (unsigned long)alignment);
    current = name;
    covered = 0;
}

static void field(const char *name, const char *type, size_t offset, size_t size)
{
    printf("  %lu %lu %s: %s\n", (unsigned long)offset, (unsigned long)size, name, type);
    if (offset != covered) {
        fprintf(stderr, "%s.%s: %ld bytes of padding before it\n", current, name, (long)offset - (long)covered);
        failures++;
    }
    if (strcmp(name, "struct_size") == 0 && (offset != 0 || size != 4)) {
        fprintf(stderr, "%s.struct_size: not a uint32_t at offset 0\n", current);
        failures++;
    }
    covered = offset + size;
}

static void end(size_t size)
{
    if (covered != size) {
        fprintf(stderr, "%s: %ld bytes of padding at its end\n", current, (long)size - (long)covered);
        failures++;
    }
}

#define BEGIN(type)       \
    struct align_##type { \
        char first;       \
        type second;      \
    };
#define FIELD(type, name, text)
#define END(type)
#define VALUE(name)
#define FUNCTION(text)
#include "layout.inc"
#undef BEGIN
#undef FIELD
#undef END
#undef VALUE
#undef FUNCTION

#define BEGIN(type) begin(#type, sizeof(type), offsetof(struct align_##type, second));
#define FIELD(type, name, text) field(#name, text, offsetof(type, name), sizeof(((type *)0)->name));
#define END(type) end(sizeof(type));
#define VALUE(name) printf("value %s %lld\n", #name, (long long)(name));
#define FUNCTION(text) puts("function " text);

int main(void)
{
    if (sizeof(void *) != 8 || sizeof(long) != 8) {
        puts("SKIP: house_layout: the golden text is that of 64-bit machines with a 64-bit long");
        return 77;
    }
#include "layout.inc"
    if (sizeof(tahr_state) != 512) {
        fprintf(stderr, "tahr_state: %lu bytes instead of 512\n", (unsigned long)sizeof(tahr_state));
        failures++;
    }
    return failures ? EXIT_FAILURE : EXIT_SUCCESS;
}
