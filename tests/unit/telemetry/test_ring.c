/* SPDX-License-Identifier: MIT
 * test_ring.c: what is read from a ring is what was written, in order, and nothing is written over before it was read.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#ifdef TAHR_HAVE_THREADS
#include <pthread.h>

#include "listener.h"
#include "threads/ring.h"

enum { SIZE = 64, MOST = 24, RECORDS = 200000 };

/* Record n: its length, and words that follow from n. */
static uint64_t length_of(uint64_t n)
{
    return 1 + (n * 7 + n / 5) % MOST;
}

/* Reserves up to spare words more than it needs. Returns 0: no room. */
static int write_record(tahr__ring *ring, uint64_t n, uint64_t spare)
{
    const uint64_t length = length_of(n);
    uint64_t *words = tahr__ring_reserve(ring, length + spare);
    if (!words) return 0;
    words[0] = length;
    for (uint64_t i = 1; i < length; i++)
        words[i] = n + i;
    tahr__ring_commit(ring, length);
    return 1;
}

/* Returns 0: nothing is there; -1: it is not record n. */
static int read_record(tahr__ring *ring, uint64_t n)
{
    const uint64_t *words = tahr__ring_peek(ring);
    if (!words) return 0;
    if (words[0] != length_of(n)) return -1;
    for (uint64_t i = 1; i < words[0]; i++)
        if (words[i] != n + i) return -1;
    tahr__ring_pop(ring);
    return 1;
}

/* A model beside it: how many words there are, gaps too, and where the end is. */
static void it_takes_what_there_is_room_for_and_no_more(void **unused)
{
    uint64_t words[SIZE];
    tahr__ring ring;
    made_up dice;
    uint64_t written = 0, read = 0, head = 0, tail = 0, full = 0, gaps = 0;
    (void)unused;
    made_up_init(&dice, 6);
    tahr__ring_init(&ring, words, SIZE);
    for (int i = 0; i < RECORDS; i++) {
        if (made_up_number(&dice) % 2) {
            const uint64_t spare = made_up_number(&dice) % 3, count = length_of(written) + spare;
            const uint64_t gap = head % SIZE + count > SIZE ? SIZE - head % SIZE : 0;
            const int fits = head + gap + count - tail <= SIZE;
            assert_int_equal(write_record(&ring, written, spare), fits);
            if (fits) head += gap + length_of(written++);
            full += !fits;
            gaps += fits && gap > 0;
        } else {
            assert_int_equal(tahr__ring_look(&ring), head - tail);
            const int got = read_record(&ring, read);
            assert_int_equal(got, written > read);
            if (!got) continue;
            if (tail % SIZE + length_of(read) > SIZE || words[tail % SIZE] >> 63) tail += SIZE - tail % SIZE;
            tail += length_of(read++);
        }
        const uint64_t room = SIZE - (head - tail), asked = made_up_number(&dice) % (SIZE + 1);
        assert_int_equal(tahr__ring_has_room(&ring, asked), asked <= room);
    }
    assert_true(full > 1000 && gaps > 1000 && read > RECORDS / 4);
}

static void *write_all(void *user)
{
    for (uint64_t n = 0; n < RECORDS; n++)
        while (!write_record(user, n, 0)) { /* the reader is on its way */
        }
    return NULL;
}

static void a_reader_on_another_thread_sees_whole_records_in_order(void **unused)
{
    static uint64_t words[SIZE];
    static tahr__ring ring;
    pthread_t writer;
    uint64_t n = 0;
    int got = 0;
    (void)unused;
    tahr__ring_init(&ring, words, SIZE);
    assert_int_equal(pthread_create(&writer, NULL, write_all, &ring), 0);
    while (n < RECORDS && got >= 0) {
        tahr__ring_look(&ring);
        while ((got = read_record(&ring, n)) > 0)
            n++;
    }
    assert_int_equal(got, 0);
    assert_int_equal(pthread_join(writer, NULL), 0);
    assert_int_equal(tahr__ring_look(&ring), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_takes_what_there_is_room_for_and_no_more),
        cmocka_unit_test(a_reader_on_another_thread_sees_whole_records_in_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
#else
int main(void)
{
    puts("SKIP: unit_telemetry_ring: built without libtahr_threads");
    return 77;
}
#endif
