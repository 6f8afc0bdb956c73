/* SPDX-License-Identifier: MIT
 * test_allocation.c: every allocation may fail, nothing leaks, and a step allocates nothing. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fake_world.h"

#include <tahr/native.h>

static void describe(tahr_world_desc *desc, tahr_body_desc bodies[2], const tahr_allocator *allocator)
{
    static const double vertices[] = {-50, -50, 0, 50, -50, 0, 50, 50, 0, -50, 50, 0};
    static const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    tahr_body_desc_init(&bodies[0], sizeof bodies[0], TAHR_BODY_MESH);
    bodies[0].vertices = vertices;
    bodies[0].indices = indices;
    bodies[0].vertex_count = 4;
    bodies[0].triangle_count = 2;
    tahr_body_desc_init(&bodies[1], sizeof bodies[1], TAHR_BODY_BOX);
    bodies[1].half_extents = fake_vec(1, 1, 0.15);
    bodies[1].pose.position = fake_vec(4, 0, 0.15);
    tahr_world_desc_init(desc, sizeof *desc);
    desc->bodies = bodies;
    desc->body_count = 2;
    desc->allocator = allocator;
}

static tahr_status open_all(int native, fake_world *fake, const tahr_allocator *allocator, tahr_world **world,
                            tahr_mover **mover)
{
    tahr_callbacks callbacks = {
        .struct_size = sizeof callbacks, .user = fake, .sweep = fake_sweep, .contacts = fake_contacts};
    tahr_world_desc desc;
    tahr_body_desc bodies[2];
    tahr_config c = fake_config();
    describe(&desc, bodies, allocator);
    tahr_status status = native ? tahr_world_open(tahr_backend_v1_native(), &desc, world)
                                : tahr_world_open_callbacks(&callbacks, &desc, world);
    return status < 0 ? status : tahr_mover_create(*world, &c, mover);
}

static void every_failing_allocation_is_reported_and_nothing_leaks(void **unused)
{
    (void)unused;
    for (int native = 0; native < 2; native++) {
        fake_world fake;
        uint64_t k = 1;
        fake_world_init(&fake);
        for (;; k++) {
            fake_memory memory = {.fail_at = k};
            tahr_allocator allocator = fake_allocator(&memory);
            tahr_world *world = NULL;
            tahr_mover *mover = NULL;
            tahr_status status = open_all(native, &fake, &allocator, &world, &mover);
            if (status != TAHR_OK) {
                assert_int_equal(status, TAHR_E_MEMORY);
                assert_null(mover);
            }
            tahr_mover_destroy(mover);
            tahr_world_close(world);
            assert_int_equal(memory.live_blocks, 0);
            assert_int_equal(memory.live_bytes, 0);
            assert_int_equal(memory.mismatches, 0);
            if (status == TAHR_OK) {
                break;
            }
            assert_true(k < 1000);
        }
        assert_true(k > 1);
    }
}

static void a_thousand_steps_allocate_nothing(void **unused)
{
    (void)unused;
    for (int native = 0; native < 2; native++) {
        fake_world fake;
        fake_memory memory = {0};
        tahr_allocator allocator = fake_allocator(&memory);
        tahr_world *world = NULL;
        tahr_mover *mover = NULL;
        tahr_state state;
        tahr_input input = {.struct_size = sizeof input};
        tahr_config c = fake_config();
        tahr_vec3 at = {0, 0, 1};
        fake_world_init(&fake);
        fake_add_plane(&fake, fake_vec(0, 0, 1), 0);
        fake_add_box(&fake, fake_vec(3, -1, 0), fake_vec(5, 1, 0.3));
        assert_int_equal(open_all(native, &fake, &allocator, &world, &mover), TAHR_OK);
        tahr_state_init(&state, &c, &at);
        uint64_t before = memory.requests, bytes = memory.live_bytes, blocks = memory.live_blocks;
        for (int i = 0; i < 1000; i++) {
            input.move = fake_vec(cos(i * 0.01), sin(i * 0.03), 0);
            input.jump = i % 100 == 0;
            assert_true(tahr_mover_step(mover, &input, 1.0 / 60, &state, NULL) >= 0);
        }
        assert_int_equal(memory.requests, before);
        assert_int_equal(memory.live_bytes, bytes);
        assert_int_equal(memory.live_blocks, blocks);
        tahr_mover_destroy(mover);
        tahr_world_close(world);
        assert_int_equal(memory.live_blocks, 0);
        assert_int_equal(memory.mismatches, 0);
    }
}

static void world_memory_is_what_the_allocator_holds(void **unused)
{
    (void)unused;
    for (int native = 0; native < 2; native++) {
        fake_world fake;
        fake_memory memory = {0};
        tahr_allocator allocator = fake_allocator(&memory);
        tahr_world *world = NULL;
        tahr_mover *mover = NULL;
        fake_world_init(&fake);
        assert_int_equal(open_all(native, &fake, &allocator, &world, &mover), TAHR_OK);
        tahr_mover_destroy(mover); /* its memory is not the world's */
        assert_int_equal(tahr_world_memory(world), memory.live_bytes);
        tahr_world_close(world);
    }
    assert_int_equal(tahr_world_memory(NULL), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_failing_allocation_is_reported_and_nothing_leaks),
                                       cmocka_unit_test(a_thousand_steps_allocate_nothing),
                                       cmocka_unit_test(world_memory_is_what_the_allocator_holds)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
