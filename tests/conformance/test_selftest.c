/* SPDX-License-Identifier: MIT
 * test_selftest.c: every backend of this build keeps what it promises, and the kit that says so can fail. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>
#include <tahr/box2d.h>
#include <tahr/ccd.h>
#include <tahr/fcl.h>
#include <tahr/native.h>
#include <tahr/selftest.h>
#include <tahr/tahr.h>

#include "engine.h"
#include "mutant.h"

typedef struct tally {
    const char *who;
    uint32_t passed, failed, unsupported;
    char last[64];
    int quiet;
} tally;

static void count(void *user, const tahr_selftest_result *result)
{
    tally *t = user;
    t->passed += result->verdict == TAHR_SELFTEST_PASS;
    t->failed += result->verdict == TAHR_SELFTEST_FAIL;
    t->unsupported += result->verdict == TAHR_SELFTEST_NOT_SUPPORTED;
    snprintf(t->last, sizeof t->last, "%s", result->name);
    assert_non_null(result->expected);
    assert_non_null(result->actual);
    if (result->verdict == TAHR_SELFTEST_FAIL && !t->quiet) {
        print_message("%s: %s\n    expected %s\n    actual   %s\n", t->who, result->name, result->expected,
                      result->actual);
    }
}

/* Nothing may fail, and the counts add up. least: how many cases at least a backend of these capabilities is asked. */
static void expect_all(tally *t, const tahr_backend *backend, tahr_selftest_desc *desc, uint32_t least)
{
    uint32_t failed = 99;
    desc->struct_size = sizeof *desc;
    desc->report = count;
    desc->user = t;
    assert_int_equal(tahr_backend_selftest(backend, desc, &failed), TAHR_OK);
    print_message("%s: %u passed, %u failed, %u not supported\n", t->who, t->passed, t->failed, t->unsupported);
    assert_int_equal(failed, t->failed);
    assert_int_equal(failed, 0);
    assert_true(t->passed >= least);
}

static void native_keeps_its_promises(void **state)
{
    (void)state;
    tahr_native_desc options = {.struct_size = sizeof options};
    tally t = {.who = "native"};
    tahr_selftest_desc desc = {.options = &options};
    expect_all(&t, tahr_backend_v1_native(), &desc, 60);
}

/* The same in every way of finding geometry. */
static void native_without_shortcuts_keeps_its_promises(void **state)
{
    (void)state;
    tahr_native_desc options = {.struct_size = sizeof options, .no_cache = 1, .no_simd = 1};
    tally t = {.who = "native without cache and lanes"};
    tahr_selftest_desc desc = {.options = &options};
    expect_all(&t, tahr_backend_v1_native(), &desc, 58);
}

#ifdef TAHR_HAVE_CCD
static void ccd_keeps_its_promises(void **state)
{
    (void)state;
    tally t = {.who = "ccd"};
    tahr_selftest_desc desc = {0};
    expect_all(&t, tahr_backend_v1_ccd(), &desc, 60);
}
#endif

#ifdef TAHR_HAVE_FCL
static void fcl_keeps_its_promises(void **state)
{
    (void)state;
    tally t = {.who = "fcl"};
    tahr_selftest_desc desc = {0};
    expect_all(&t, tahr_backend_v1_fcl(), &desc, 60);
}
#endif

#ifdef TAHR_HAVE_BOX2D
static tahr_status box2d_opens(uint32_t engine)
{
    tahr_box2d_desc options = {.struct_size = sizeof options, .engine = engine};
    tahr_world_desc desc;
    tahr_world *world = NULL;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.options = &options;
    tahr_status status = tahr_world_open(tahr_backend_v1_box2d(), &desc, &world);
    tahr_world_close(world);
    return status;
}

static void box2d_keeps_its_promises(uint32_t engine, const char *name)
{
    tahr_box2d_desc options = {.struct_size = sizeof options, .engine = engine};
    tally t = {.who = name};
    tahr_selftest_desc desc = {.options = &options};
    if (box2d_opens(engine) < 0) {
        print_message("SKIP: conformance_selftest: %s_keeps_its_promises: this engine is not built\n", name);
        skip();
    }
    expect_all(&t, tahr_backend_v1_box2d(), &desc, 60);
}

static void box2d_2_keeps_its_promises(void **state)
{
    (void)state;
    box2d_keeps_its_promises(TAHR_BOX2D_2, "box2d_2");
}

static void box2d_3_keeps_its_promises(void **state)
{
    (void)state;
    box2d_keeps_its_promises(TAHR_BOX2D_3, "box2d_3");
}
#endif

enum { SHAPES = TAHR_CAP_SPHERE | TAHR_CAP_CAPSULE | TAHR_CAP_BOX, BODIES = TAHR_CAP_MESH | TAHR_CAP_SOLIDS };

static void callbacks_keep_their_promises(void **state)
{
    (void)state;
    tally t = {.who = "callbacks"};
    tahr_selftest_desc desc = {.capabilities = SHAPES | BODIES | TAHR_CAP_MARGIN | TAHR_CAP_CONTACTS | TAHR_CAP_RAY |
                                               TAHR_CAP_SENSORS,
                               .open = engine_open,
                               .close = engine_close};
    expect_all(&t, NULL, &desc, 55);
}

static void callbacks_of_one_sweep_keep_their_promises(void **state)
{
    (void)state;
    tally t = {.who = "callbacks, only a sweep"};
    tahr_selftest_desc desc = {
        .capabilities = SHAPES | BODIES | TAHR_CAP_MARGIN, .open = engine_open_sweep_only, .close = engine_close};
    expect_all(&t, NULL, &desc, 45);
}

/* One promise broken at a time: the case that is named for it must say so. */
static void every_broken_promise_is_caught(void **state)
{
    (void)state;
    uint32_t missed = 0;
    for (uint32_t i = 1; i < MUTANT_COUNT; i++) {
        mutant_desc options = {sizeof options, i};
        tally t = {.who = mutant_name(i), .quiet = 1};
        uint32_t failed = 0;
        tahr_selftest_desc desc = {
            .struct_size = sizeof desc, .options = &options, .only = mutant_case(i), .report = count, .user = &t};
        assert_int_equal(tahr_backend_selftest(mutant_backend(), &desc, &failed), TAHR_OK);
        if (failed == 0) {
            print_message("%s: not caught by %s\n", t.who, mutant_case(i));
            missed++;
        }
    }
    assert_int_equal(missed, 0);
}

static void the_wrapper_that_breaks_nothing_passes(void **state)
{
    (void)state;
    mutant_desc options = {sizeof options, MUTANT_NONE};
    tally t = {.who = "mutant that is none"};
    tahr_selftest_desc desc = {.options = &options};
    expect_all(&t, mutant_backend(), &desc, 60);
}

/* Every case has a mutant that it catches, unless native lacks what it needs, or it is about a slot's form alone. */
static uint32_t uncovered;

static void note_uncovered(void *user, const tahr_selftest_result *result)
{
    (void)user;
    int covered = result->verdict == TAHR_SELFTEST_NOT_SUPPORTED;
    for (uint32_t i = 1; i < MUTANT_COUNT; i++) {
        covered = covered || strcmp(mutant_case(i), result->name) == 0;
    }
    /* Between the cases of one ulp less and of a micrometre more. */
    covered = covered || strcmp(result->name, "rest_at_margin_plus_one_ulp") == 0;
    if (!covered) {
        print_message("no mutant for %s\n", result->name);
        uncovered++;
    }
}

static void every_case_has_a_mutant(void **state)
{
    (void)state;
    mutant_desc options = {sizeof options, MUTANT_NONE};
    tahr_selftest_desc desc = {.struct_size = sizeof desc, .options = &options, .report = note_uncovered};
    assert_int_equal(tahr_backend_selftest(mutant_backend(), &desc, NULL), TAHR_OK);
    assert_int_equal(uncovered, 0);
}

static tahr_status cannot_open(void *user, const tahr_world_desc *desc, tahr_world **world)
{
    (void)user, (void)desc, (void)world;
    return TAHR_E_MEMORY;
}

static void wrong_arguments_are_refused(void **state)
{
    (void)state;
    const tahr_backend *native = tahr_backend_v1_native();
    tahr_backend small = *native, old = *native, hollow = *native;
    uint32_t failed = 77;
    tahr_selftest_desc desc = {.struct_size = sizeof desc}, bad = desc;
    struct {
        tahr_selftest_desc known;
        uint32_t tail[4];
    } longer = {.known = desc, .tail = {1, 0, 0, 0}};
    small.struct_size = 8;
    old.abi_major = 200;
    hollow.ray = NULL;
    assert_int_equal(tahr_backend_selftest(native, NULL, &failed), TAHR_E_NULL);
    assert_int_equal(tahr_backend_selftest(NULL, &desc, &failed), TAHR_E_NULL);
    assert_int_equal(tahr_backend_selftest(&small, &desc, &failed), TAHR_E_STRUCT_SIZE);
    assert_int_equal(tahr_backend_selftest(&old, &desc, &failed), TAHR_E_ABI);
    assert_int_equal(tahr_backend_selftest(&hollow, &desc, &failed), TAHR_E_NULL);
    bad.struct_size = 4;
    assert_int_equal(tahr_backend_selftest(native, &bad, &failed), TAHR_E_STRUCT_SIZE);
    longer.known.struct_size = sizeof longer;
    assert_int_equal(tahr_backend_selftest(native, &longer.known, &failed), TAHR_E_UNSUPPORTED);
    bad = desc;
    bad.gap_tolerance = -1;
    assert_int_equal(tahr_backend_selftest(native, &bad, &failed), TAHR_E_ARGUMENT);
    bad = desc;
    bad.angle_tolerance = 1;
    assert_int_equal(tahr_backend_selftest(native, &bad, &failed), TAHR_E_ARGUMENT);
    bad = desc;
    bad.capabilities = TAHR_CAP_MESH;
    assert_int_equal(tahr_backend_selftest(native, &bad, &failed), TAHR_E_ARGUMENT);
    bad = desc;
    bad.open = cannot_open;
    assert_int_equal(tahr_backend_selftest(native, &bad, &failed), TAHR_E_ARGUMENT);
    bad = desc;
    bad.only = "no case begins like this";
    assert_int_equal(tahr_backend_selftest(native, &bad, &failed), TAHR_E_ARGUMENT);
    assert_int_equal(failed, 77);
}

static void only_runs_what_begins_so(void **state)
{
    (void)state;
    tally t = {.who = "native"};
    tahr_selftest_desc desc = {.only = "grazing_"};
    expect_all(&t, tahr_backend_v1_native(), &desc, 2);
    assert_int_equal(t.passed, 2);
    assert_string_equal(t.last, "grazing_0.1_degree");
}

/* A backend that cannot open its worlds fails every case that needs one, and nothing crashes. */
static void worlds_that_do_not_open_fail_their_cases(void **state)
{
    (void)state;
    tally t = {.who = "nothing", .quiet = 1};
    uint32_t failed = 0;
    tahr_selftest_desc desc = {.struct_size = sizeof desc,
                               .capabilities = SHAPES | BODIES | TAHR_CAP_MARGIN,
                               .open = cannot_open,
                               .report = count,
                               .user = &t};
    assert_int_equal(tahr_backend_selftest(NULL, &desc, &failed), TAHR_OK);
    assert_int_equal(t.passed, 0);
    assert_true(failed > 40);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(native_keeps_its_promises),      cmocka_unit_test(native_without_shortcuts_keeps_its_promises),
#ifdef TAHR_HAVE_CCD
        cmocka_unit_test(ccd_keeps_its_promises),
#endif
#ifdef TAHR_HAVE_FCL
        cmocka_unit_test(fcl_keeps_its_promises),
#endif
#ifdef TAHR_HAVE_BOX2D
        cmocka_unit_test(box2d_2_keeps_its_promises),     cmocka_unit_test(box2d_3_keeps_its_promises),
#endif
        cmocka_unit_test(callbacks_keep_their_promises),  cmocka_unit_test(callbacks_of_one_sweep_keep_their_promises),
        cmocka_unit_test(every_broken_promise_is_caught), cmocka_unit_test(the_wrapper_that_breaks_nothing_passes),
        cmocka_unit_test(every_case_has_a_mutant),        cmocka_unit_test(wrong_arguments_are_refused),
        cmocka_unit_test(only_runs_what_begins_so),       cmocka_unit_test(worlds_that_do_not_open_fail_their_cases),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
