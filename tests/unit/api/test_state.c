/* SPDX-License-Identifier: MIT
 * test_state.c: making and hashing states. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "rig.h"

static void init_makes_a_standing_character_and_refuses_bad_places(void **unused)
{
    tahr_config c = rig_config();
    tahr_state s, before;
    tahr_vec3 at = {1, -2, 3};
    const double bad[] = {NAN, INFINITY, -INFINITY, 1.1e7};
    (void)unused;
    memset(&s, 0x6B, sizeof s);
    before = s;
    assert_int_equal(tahr_state_init(NULL, &c, &at), TAHR_E_NULL);
    assert_int_equal(tahr_state_init(&s, NULL, &at), TAHR_E_NULL);
    assert_int_equal(tahr_state_init(&s, &c, NULL), TAHR_E_NULL);
    for (int i = 0; i < 12; i++) {
        tahr_vec3 p = at;
        (&p.x)[i % 3] = bad[i / 3];
        assert_int_equal(tahr_state_init(&s, &c, &p), TAHR_E_ARGUMENT);
    }
    c.skin = -1;
    assert_int_equal(tahr_state_init(&s, &c, &at), TAHR_E_ARGUMENT);
    c.struct_size = 4;
    assert_int_equal(tahr_state_init(&s, &c, &at), TAHR_E_STRUCT_SIZE);
    assert_memory_equal(&s, &before, sizeof s);
    c = rig_config();
    assert_int_equal(tahr_state_init(&s, &c, &at), TAHR_OK);
    assert_true(s.position.x == 1 && s.mode == TAHR_MODE_FALLING && s.up.z == 1 && s.orientation.w == 1 &&
                s.floor_revision == 0);
    for (int i = 0; i < (int)sizeof s.reserved; i++) {
        assert_int_equal(s.reserved[i], 0);
    }
}

static void up_is_opposite_to_any_gravity(void **unused)
{
    tahr_config c = rig_config();
    tahr_state s;
    tahr_vec3 at = {0, 0, 0};
    (void)unused;
    c.gravity = fake_vec(0, 0, 9.81);
    assert_int_equal(tahr_state_init(&s, &c, &at), TAHR_OK);
    assert_true(s.up.z == -1);
    tahr_quat q = s.orientation;
    assert_near(1 - 2 * (q.x * q.x + q.y * q.y), -1, 1e-15);
    c.gravity = fake_vec(0, 0, 0);
    assert_int_equal(tahr_state_init(&s, &c, &at), TAHR_OK);
    assert_true(s.up.z == 1);
}

/* FNV-1a 64, the textbook loop over bytes. */
static uint64_t textbook(const void *memory, size_t size)
{
    uint64_t h = 14695981039346656037u;
    for (size_t i = 0; i < size; i++) {
        h = (h ^ ((const unsigned char *)memory)[i]) * 1099511628211u;
    }
    return h;
}

static void hash_is_fnv1a_with_one_zero(void **unused)
{
    tahr_config c = rig_config();
    tahr_state s, t;
    tahr_vec3 at = {1, -2, 3};
    (void)unused;
    tahr_state_init(&s, &c, &at);
    assert_true(tahr_state_hash(&s) == textbook(&s, sizeof s));
    t = s;
    t.velocity.x = -0.0;
    assert_true(tahr_state_hash(&s) == tahr_state_hash(&t));
    t.velocity.x = 1e-300;
    assert_true(tahr_state_hash(&s) != tahr_state_hash(&t));
    t = s;
    t.reserved[sizeof t.reserved - 1] = 1;
    assert_true(tahr_state_hash(&s) != tahr_state_hash(&t));
    assert_true(tahr_state_hash(NULL) == 0);
}

static void steps_leave_no_minus_zero(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
    r.state.velocity = fake_vec(-0.0, -0.0, -0.0);
    for (int i = 0; i < 60; i++) {
        r.input.move = fake_vec(i > 30 ? -1 : 0, -0.0, 0);
        rig_step(&r, 1.0 / 60);
        for (size_t at = 0; at < sizeof r.state; at += 8) {
            uint64_t word;
            memcpy(&word, (const char *)&r.state + at, 8);
            assert_true(word != (uint64_t)1 << 63);
        }
    }
    rig_close(&r);
}

static void teleporting_forgets_the_place_and_keeps_the_rest(void **unused)
{
    const tahr_config c = rig_config();
    const tahr_vec3 to = {-0.0, 4, -7};
    tahr_state s, want;
    (void)unused;
    assert_int_equal(tahr_state_init(&s, &c, &(tahr_vec3){1, 2, 3}), TAHR_OK);
    s.velocity = (tahr_vec3){1, 2, -3};
    s.mode = TAHR_MODE_WALKING;
    s.flags = TAHR_STATE_CROUCHED | TAHR_STATE_JUMP_HELD;
    s.half_height = 0.55;
    s.jump_count = 2;
    want = s;
    want.position = (tahr_vec3){0, 4, -7};
    s.flags |= TAHR_STATE_FLOOR_MOVED;
    s.floor.flags = TAHR_FLOOR_WALKABLE;
    s.floor.distance = 0.01;
    s.floor.body = 3;
    s.floor_position = s.position;
    s.floor_revision = 77;
    s.base.body = 3;
    s.base.velocity.x = 1;
    s.touched[0] = 4;
    s.touched_count = 1;
    s.coyote_left = s.lift_left = s.wall_left = 0.1;
    s.wall_normal.x = 1;
    s.wall_body = s.drop_body = 5;
    s.wall_feature = s.drop_feature = 6;
    assert_int_equal(tahr_state_teleport(&s, &to), TAHR_OK);
    assert_memory_equal(&s, &want, sizeof s);
}

static void teleporting_to_no_place_is_refused(void **unused)
{
    const tahr_config c = rig_config();
    const tahr_vec3 bad[] = {{NAN, 0, 0}, {0, INFINITY, 0}, {0, 0, 1.1e7}};
    tahr_state s, before;
    (void)unused;
    assert_int_equal(tahr_state_init(&s, &c, &(tahr_vec3){1, 2, 3}), TAHR_OK);
    before = s;
    for (int i = 0; i < 3; i++) {
        assert_int_equal(tahr_state_teleport(&s, &bad[i]), TAHR_E_ARGUMENT);
    }
    assert_int_equal(tahr_state_teleport(&s, NULL), TAHR_E_NULL);
    assert_int_equal(tahr_state_teleport(NULL, &bad[0]), TAHR_E_NULL);
    assert_memory_equal(&s, &before, sizeof s);
}

/* On the edge of a box, in free air, and deep in the ground. */
static void who_was_teleported_moves_like_one_made_there(void **unused)
{
    const tahr_vec3 places[] = {{4, 0, 2}, {0, 30, 5}, {-3, 0, 0.5}};
    (void)unused;
    for (int i = 0; i < 3; i++) {
        fake_world w;
        rig r, made;
        fake_world_flat(&w);
        fake_add_box(&w, fake_vec(4, -3, 0), fake_vec(6, 3, 1));
        rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
        rig_open(&made, &w, NULL, places[i]);
        made.state.mode = TAHR_MODE_WALKING;
        assert_int_equal(tahr_state_teleport(&r.state, &places[i]), TAHR_OK);
        for (int k = 0; k < 60; k++) {
            r.input.move = made.input.move = fake_vec(0.6, 0.8, 0);
            rig_step(&r, 1.0 / 60);
            rig_step(&made, 1.0 / 60);
            assert_memory_equal(&r.state, &made.state, sizeof r.state);
        }
        rig_close(&r);
        rig_close(&made);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(init_makes_a_standing_character_and_refuses_bad_places),
                                       cmocka_unit_test(up_is_opposite_to_any_gravity),
                                       cmocka_unit_test(hash_is_fnv1a_with_one_zero),
                                       cmocka_unit_test(steps_leave_no_minus_zero),
                                       cmocka_unit_test(teleporting_forgets_the_place_and_keeps_the_rest),
                                       cmocka_unit_test(teleporting_to_no_place_is_refused),
                                       cmocka_unit_test(who_was_teleported_moves_like_one_made_there)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
