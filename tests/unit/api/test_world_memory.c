/* SPDX-License-Identifier: MIT
 * test_world_memory.c: the default allocator keeps every alignment; the counting one counts what is held, no more. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fake_host.h"
#include "world_memory.h"

static void plain_memory_is_aligned_and_apart(void **unused)
{
    const tahr_allocator *a = &tahr__malloc;
    unsigned char *blocks[7];
    (void)unused;
    for (int i = 0; i < 7; i++) {
        size_t alignment = (size_t)1 << i, size = 13 + (size_t)i;
        blocks[i] = a->alloc(a->user, size, alignment);
        assert_non_null(blocks[i]);
        assert_int_equal((uintptr_t)blocks[i] % alignment, 0);
        memset(blocks[i], i, size);
    }
    for (int i = 0; i < 7; i++) {
        assert_int_equal(blocks[i][0], i);
        assert_int_equal(blocks[i][12 + i], i);
        a->free(a->user, blocks[i], 13 + (size_t)i, (size_t)1 << i);
    }
    a->free(a->user, NULL, 1, 1);
}

static void a_size_that_overflows_is_refused(void **unused)
{
    (void)unused;
    for (size_t less = 0; less < 72; less++) {
        assert_null(tahr__malloc.alloc(NULL, SIZE_MAX - less, 64));
    }
}

static void the_count_is_what_is_held(void **unused)
{
    fake_memory user = {0};
    tahr__memory memory = {fake_allocator(&user), 0};
    tahr_allocator a = tahr__counting_allocator(&memory);
    (void)unused;
    void *first = a.alloc(a.user, 100, 8), *second = a.alloc(a.user, 28, 64);
    assert_true(memory.bytes == 128 && user.live_bytes == 128);
    user.fail_at = 3;
    assert_null(a.alloc(a.user, 1000, 8));
    assert_int_equal(memory.bytes, 128);
    a.free(a.user, NULL, 50, 8); /* nothing was counted for it, and the user's free never sees it */
    assert_int_equal(memory.bytes, 128);
    a.free(a.user, first, 100, 8);
    assert_int_equal(memory.bytes, 28);
    a.free(a.user, second, 28, 64);
    assert_true(memory.bytes == 0 && user.live_blocks == 0 && user.mismatches == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(plain_memory_is_aligned_and_apart),
                                       cmocka_unit_test(a_size_that_overflows_is_refused),
                                       cmocka_unit_test(the_count_is_what_is_held)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
