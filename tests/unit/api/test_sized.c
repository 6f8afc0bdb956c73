/* SPDX-License-Identifier: MIT
 * test_sized.c: a struct_size that is garbage is refused by every function, and nothing beyond the struct is read: each
 * struct ends where readable memory ends. */
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cmocka.h>

#include "rig.h"

#include <tahr/native.h>

/* Uninitialised memory as one compiler marks it, more than any version will add, the largest numbers. */
static const uint32_t GARBAGE[] = {0xCCCCCCCCu, 5000, 0xFFFFFFFFu, 0x7FFFFFFFu};
enum { GARBAGES = 4 };

/* The last bytes before a page that may not be touched. */
static void *last_bytes(size_t size)
{
    size_t page = (size_t)sysconf(_SC_PAGESIZE);
    char *memory = mmap(NULL, 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    assert_true(memory != MAP_FAILED && size <= page);
    assert_int_equal(mprotect(memory + page, page, PROT_NONE), 0);
    return memory + page - size;
}

static void let_go(void *memory, size_t size)
{
    size_t page = (size_t)sysconf(_SC_PAGESIZE);
    munmap((char *)memory + size - page, 2 * page);
}

/* 5000 stands for "5000 more than this version knows". */
static void spoil(void *object, size_t known, int i)
{
    uint32_t size = GARBAGE[i] == 5000 ? (uint32_t)known + 5000 : GARBAGE[i];
    memcpy(object, &size, sizeof size);
}

static void a_config_of_garbage_size_is_refused_unread(void **unused)
{
    fake_world fake;
    rig r;
    (void)unused;
    fake_world_init(&fake);
    rig_open(&r, &fake, NULL, fake_vec(0, 0, 1));
    tahr_config *config = last_bytes(sizeof *config);
    for (int i = 0; i < GARBAGES; i++) {
        tahr_state state = r.state;
        tahr_mover *mover = NULL;
        tahr_vec3 at = {0, 0, 1};
        assert_int_equal(tahr_config_init(config, sizeof *config, TAHR_PRESET_PRECISE), TAHR_OK);
        spoil(config, sizeof *config, i);
        assert_int_equal(tahr_config_check(config, NULL), TAHR_E_STRUCT_SIZE);
        assert_int_equal(tahr_config_scale(config, 2), TAHR_E_STRUCT_SIZE);
        assert_int_equal(tahr_state_init(&state, config, &at), TAHR_E_STRUCT_SIZE);
        assert_int_equal(tahr_mover_create(r.world, config, &mover), TAHR_E_STRUCT_SIZE);
        assert_null(mover);
    }
    let_go(config, sizeof *config);
    rig_close(&r);
}

/* Steps with an input or a report at the edge of a page: refused while its size is garbage, taken when it is right. */
static void step_at_the_edge(int with_report)
{
    fake_world fake;
    rig r;
    fake_world_init(&fake);
    rig_open(&r, &fake, NULL, fake_vec(0, 0, 1));
    size_t size = with_report ? sizeof(tahr_report) : sizeof(tahr_input);
    uint32_t right = (uint32_t)size;
    void *object = last_bytes(size);
    const tahr_input *input = with_report ? &r.input : object;
    tahr_report *report = with_report ? object : NULL;
    tahr_state before = r.state;
    for (int i = 0; i < GARBAGES; i++) {
        memset(object, 0, size);
        spoil(object, size, i);
        assert_int_equal(tahr_mover_step(r.mover, input, 0.1, &r.state, report), TAHR_E_STRUCT_SIZE);
        assert_memory_equal(&before, &r.state, sizeof before);
        for (size_t at = sizeof right; at < size; at++) {
            assert_int_equal(((const unsigned char *)object)[at], 0); /* unwritten */
        }
    }
    memcpy(object, &right, sizeof right);
    assert_int_equal(tahr_mover_step(r.mover, input, 0.1, &r.state, report), TAHR_OK);
    let_go(object, size);
    rig_close(&r);
}

static void an_input_of_garbage_size_is_refused_unread(void **unused)
{
    (void)unused;
    step_at_the_edge(0);
}

static void a_report_of_garbage_size_is_refused_unwritten(void **unused)
{
    (void)unused;
    step_at_the_edge(1);
}

static void descriptions_of_garbage_size_are_refused_unread(void **unused)
{
    (void)unused;
    tahr_world_desc *desc = last_bytes(sizeof *desc);
    tahr_body_desc *body = last_bytes(sizeof *body);
    tahr_native_desc *native = last_bytes(sizeof *native);
    for (int i = 0; i < GARBAGES; i++) {
        for (int which = 0; which < 3; which++) {
            tahr_world *world = NULL;
            assert_int_equal(tahr_world_desc_init(desc, sizeof *desc), TAHR_OK);
            assert_int_equal(tahr_body_desc_init(body, sizeof *body, TAHR_BODY_BOX), TAHR_OK);
            memset(native, 0, sizeof *native);
            native->struct_size = sizeof *native;
            body->half_extents = fake_vec(1, 1, 1);
            desc->bodies = body;
            desc->body_count = 1;
            desc->options = native;
            void *objects[] = {desc, body, native};
            const size_t sizes[] = {sizeof *desc, sizeof *body, sizeof *native};
            spoil(objects[which], sizes[which], i);
            assert_int_equal(tahr_world_open(tahr_backend_v1_native(), desc, &world), TAHR_E_STRUCT_SIZE);
            assert_null(world);
        }
    }
    let_go(native, sizeof *native);
    let_go(body, sizeof *body);
    let_go(desc, sizeof *desc);
}

static void callbacks_of_garbage_size_are_refused_unread(void **unused)
{
    (void)unused;
    tahr_callbacks *callbacks = last_bytes(sizeof *callbacks);
    tahr_world_desc *desc = last_bytes(sizeof *desc);
    for (int i = 0; i < GARBAGES; i++) {
        tahr_world *world = NULL;
        memset(callbacks, 0, sizeof *callbacks);
        callbacks->sweep = fake_sweep;
        spoil(callbacks, sizeof *callbacks, i);
        assert_int_equal(tahr_world_open_callbacks(callbacks, NULL, &world), TAHR_E_STRUCT_SIZE);
        callbacks->struct_size = sizeof *callbacks;
        tahr_world_desc_init(desc, sizeof *desc);
        spoil(desc, sizeof *desc, i);
        assert_int_equal(tahr_world_open_callbacks(callbacks, desc, &world), TAHR_E_STRUCT_SIZE);
        assert_null(world);
    }
    let_go(desc, sizeof *desc);
    let_go(callbacks, sizeof *callbacks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_config_of_garbage_size_is_refused_unread),
                                       cmocka_unit_test(an_input_of_garbage_size_is_refused_unread),
                                       cmocka_unit_test(a_report_of_garbage_size_is_refused_unwritten),
                                       cmocka_unit_test(descriptions_of_garbage_size_are_refused_unread),
                                       cmocka_unit_test(callbacks_of_garbage_size_are_refused_unread)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
