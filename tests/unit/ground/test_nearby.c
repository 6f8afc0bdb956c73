/* SPDX-License-Identifier: MIT
 * test_nearby.c: steps that go far announce what they ask again and again by itself: faster, and the same bits. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "native_world.h"
#include "rig.h"

static native_grid grid;
static tahr_body_desc bodies[NATIVE_HILLS];

static void open_with(rig *r, uint32_t no_cache, uint32_t triangles)
{
    tahr_native_desc native;
    memset(&native, 0, sizeof native);
    native.struct_size = sizeof native;
    native.no_cache = no_cache;
    native.cache_triangles = triangles;
    rig_open_native(r, &native, bodies, NATIVE_HILLS, NULL, fake_vec(6, 6, 3));
}

static void a_long_step_is_the_same_with_a_cache_that_is_too_small_for_it(void **unused)
{
    const double dt = 0.5;
    oracle_random random = {.state = 21};
    uint32_t again = 0, walked = 0;
    rig small, none;
    (void)unused;
    native_hills(&grid, bodies);
    open_with(&small, 0, 64);
    open_with(&none, 1, 0);
    for (int i = 0; i < 2000; i++) {
        if (i % 20 == 0) { /* back onto the hills */
            tahr_vec3 at = dice_vec(&random, 2, 10);
            at.z = 2.5;
            tahr_state_teleport(&small.state, &at);
            tahr_state_teleport(&none.state, &at);
        }
        tahr_vec3 move = dice_direction(&random);
        move.z = 0;
        small.input.move = none.input.move = move;
        rig_step(&small, dt);
        rig_step(&none, dt);
        assert_memory_equal(&small.state, &none.state, sizeof small.state);
        again += small.report.gathers > 1;
        walked += small.state.mode == TAHR_MODE_WALKING;
    }
    assert_true(walked > 500 && again > 20); /* the steps were such as are announced again */
    rig_close(&small);
    rig_close(&none);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_long_step_is_the_same_with_a_cache_that_is_too_small_for_it)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
