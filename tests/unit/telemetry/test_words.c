/* SPDX-License-Identifier: MIT
 * test_words.c: words of a state are told apart one by one, by whichever vectors; and packed and unpacked. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#ifdef TAHR_HAVE_THREADS
#include "common/processor.h"
#include "oracle.h"
#include "threads/words.h"

enum { WORDS = 64, TRIES = 20000 };

static _Alignas(64) uint64_t one[WORDS];
static uint64_t other[WORDS + 1];

static uint64_t told(const void *with)
{
    const uint64_t differ = tahr__words_differ(one, with);
    if (tahr__has_avx2()) assert_true(tahr__words_differ_wide(one, with) == differ);
    return differ;
}

static void each_bit_of_each_word_is_seen(void **unused)
{
    (void)unused;
    assert_true(told(one) == 0);
    for (int i = 0; i < WORDS; i++) {
        for (int bit = 0; bit < 64; bit++) {
            memcpy(other, one, sizeof one);
            other[i] ^= (uint64_t)1 << bit;
            assert_true(told(other) == (uint64_t)1 << i);
        }
    }
}

/* At places that are not on a line, too. */
static void any_words_are_told_packed_and_unpacked(void **unused)
{
    oracle_random random = {7};
    (void)unused;
    for (int i = 0; i < TRIES; i++) {
        char *with = (char *)other + i % 9;
        uint64_t wanted = 0, packed[WORDS + 1], back[WORDS];
        memcpy(with, one, sizeof one);
        for (int k = 0; k < i % 20; k++) {
            const uint32_t word = oracle_below(&random, WORDS);
            with[8 * word + oracle_below(&random, 8)] ^= (char)(1 + oracle_below(&random, 127));
        }
        for (int k = 0; k < WORDS; k++)
            wanted |= (uint64_t)(tahr__word_of(with, k) != one[k]) << k;
        assert_true(told(with) == wanted);
        memcpy(back, one, sizeof one);
        const uint64_t *end = tahr__words_pack(packed, with, wanted);
        assert_ptr_equal(tahr__words_unpack(packed, back), end);
        assert_memory_equal(back, with, sizeof back);
    }
}

int main(void)
{
    if (!tahr__has_avx2()) print_message("this processor has no AVX2: its comparison is not looked at\n");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_bit_of_each_word_is_seen),
        cmocka_unit_test(any_words_are_told_packed_and_unpacked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
#else
int main(void)
{
    puts("SKIP: unit_telemetry_words: built without libtahr_threads");
    return 77;
}
#endif
