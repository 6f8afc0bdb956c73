/* SPDX-License-Identifier: MIT
 * test_rollback_inputs.c: with all that an input may ask for, among bodies that move now and then, in water and on
 * edges: any earlier state, with the bodies put back, goes the same way again, on the same mover and in another
 * world. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "room.h"

enum { STEPS = 5400, REPLAYED = 120, APART = 53 };
static tahr_state states[STEPS + 1];
static tahr_input inputs[STEPS + 1];

/* Step n, from 1 on, of the state that the rig has. */
static void play(rig *r, int n)
{
    r->input = inputs[n];
    room_carry(r, n);
    room_move(r, n);
    room_step(r);
}

static void film(rig *r, uint64_t seed)
{
    oracle_random dice = {seed};
    tahr_input input = r->input;
    int left = 60;
    states[0] = r->state;
    for (int n = 1; n <= STEPS; n++) {
        if (left-- == 0) {
            left = (int)oracle_uniform(&dice, 1, 90);
            input = room_input(&dice);
        }
        inputs[n] = input;
        play(r, n);
        states[n] = r->state;
    }
}

static void replay(rig *r, int from, const char *where)
{
    room_put(r, from);
    r->state = states[from];
    for (int n = from + 1; n <= from + REPLAYED && n <= STEPS; n++) {
        play(r, n);
        if (memcmp(&r->state, &states[n], sizeof r->state) != 0) {
            size_t byte = 0;
            while (((const char *)&r->state)[byte] == ((const char *)&states[n])[byte]) {
                byte++;
            }
            fail_msg("%s, from step %d: the state of step %d differs at byte %zu", where, from, n, byte);
        }
    }
}

static void whatever_is_asked_for_a_rollback_repeats_every_bit(void **unused)
{
    const uint32_t presets[] = {TAHR_PRESET_PRECISE, TAHR_PRESET_UNREAL};
    (void)unused;
    for (uint64_t seed = 1; seed <= 4; seed++) {
        rig r, other;
        room_open(&r, presets[seed % 2], 1);
        room_open(&other, presets[seed % 2], 1); /* in which nothing has ever moved */
        room_put(&r, 0);
        film(&r, seed);
        for (int from = STEPS - 1; from >= 0; from -= APART) {
            replay(&r, from, "the same mover");
            replay(&other, from, "another world");
        }
        rig_close(&r);
        rig_close(&other);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(whatever_is_asked_for_a_rollback_repeats_every_bit)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
