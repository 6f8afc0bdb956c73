/* SPDX-License-Identifier: MIT
 * test_arguments.c: what is wrong is refused, by name where there is a log, and changes nothing. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#ifdef TAHR_HAVE_THREADS
#include "listener.h"

static char said[256];

static void say(void *user, int32_t level, const char *message)
{
    (void)user;
    if (level == TAHR_LOG_ERROR) snprintf(said, sizeof said, "%s", message);
}

/* The description is refused, and the log holds all of words. */
static void refuses(const tahr_telemetry_desc *desc, tahr_status status, const char *words)
{
    tahr_telemetry *untouched = (tahr_telemetry *)(void *)&said, *t = untouched;
    said[0] = 0;
    assert_int_equal(tahr_telemetry_create(desc, &t), status);
    assert_ptr_equal(t, untouched);
    if (!strstr(said, words)) fail_msg("'%s' does not say '%s'", said, words);
}

typedef struct setting {
    size_t offset;
    int is_double;
    double value;
    const char *words;
} setting;

#define NUMBER(field, value)                                                                         \
    {                                                                                                \
        offsetof(tahr_telemetry_desc, field), 0, value, "tahr_telemetry_create: desc." #field " is " \
    }
#define REAL(field, value)                                                                           \
    {                                                                                                \
        offsetof(tahr_telemetry_desc, field), 1, value, "tahr_telemetry_create: desc." #field " is " \
    }

static void every_field_out_of_range_is_named(void **unused)
{
    static const setting settings[] = {NUMBER(characters, 0),      NUMBER(characters, (1 << 20) + 1),
                                       NUMBER(lanes, 65),          NUMBER(ring_bytes, 4095),
                                       NUMBER(ring_bytes, 1.1e9),  NUMBER(bodies, (1 << 20) + 1),
                                       NUMBER(config_count, 0),    NUMBER(config_count, 65537),
                                       REAL(state_rate, -1),       REAL(state_rate, NAN),
                                       REAL(state_rate, INFINITY), REAL(snapshot_period, 0.009),
                                       REAL(snapshot_period, 2e6), REAL(world_period, -1),
                                       REAL(world_period, NAN),    REAL(drain_period, 1e-6),
                                       REAL(drain_period, 1.5)};
    const tahr_log log = {NULL, say};
    listener ear;
    tahr_telemetry_desc desc;
    (void)unused;
    listener_init(&ear, NULL);
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        const setting *s = &settings[i];
        const uint32_t whole = (uint32_t)(s->is_double ? 0 : s->value);
        listener_describe(&ear, 1, &desc);
        desc.log = &log;
        if (s->is_double)
            memcpy((char *)&desc + s->offset, &s->value, sizeof s->value);
        else
            memcpy((char *)&desc + s->offset, &whole, sizeof whole);
        refuses(&desc, TAHR_E_ARGUMENT, s->words);
        assert_non_null(strstr(said, "expected "));
    }
    listener_end(&ear);
}

static void every_part_of_a_description_is_looked_at(void **unused)
{
    const tahr_log log = {NULL, say};
    const tahr_allocator no_free = {NULL, NULL, NULL};
    listener ear;
    tahr_telemetry_desc desc, good;
    tahr_telemetry *t = NULL;
    tahr_config configs[2];
    (void)unused;
    listener_init(&ear, NULL);
    listener_describe(&ear, 1, &good);
    good.log = &log;
    assert_int_equal(tahr_telemetry_create(NULL, &t), TAHR_E_NULL);
    assert_int_equal(tahr_telemetry_create(&good, NULL), TAHR_E_NULL);
    desc = good;
    desc.struct_size--;
    refuses(&desc, TAHR_E_STRUCT_SIZE, "");
    desc = good;
    desc.flags = 4;
    refuses(&desc, TAHR_E_UNSUPPORTED, "desc.flags is 0x4, expected TAHR_TELEMETRY_*");
    desc = good;
    desc.sink = NULL;
    refuses(&desc, TAHR_E_NULL, "desc.sink is NULL");
    desc = good;
    desc.configs = NULL;
    refuses(&desc, TAHR_E_NULL, "desc.configs is NULL");
    desc = good;
    desc.allocator = &no_free;
    refuses(&desc, TAHR_E_NULL, "desc.allocator");
    desc = good;
    configs[0] = configs[1] = *good.configs;
    configs[1].max_speed = -1;
    desc.configs = configs;
    desc.config_count = 2;
    refuses(&desc, TAHR_E_ARGUMENT, "desc.configs[1].max_speed");
    desc = good;
    desc.bodies = 1000;
    desc.ring_bytes = 65536;
    refuses(&desc, TAHR_E_ARGUMENT, "desc.ring_bytes is 65536, expected 256000 or more");
    desc = good;
    desc.log = NULL; /* silent */
    desc.sink = NULL;
    refuses(&desc, TAHR_E_NULL, "");
    struct {
        tahr_telemetry_desc desc;
        uint64_t tail;
    } longer = {good, 0};
    longer.desc.struct_size = sizeof longer;
    longer.tail = 1;
    refuses(&longer.desc, TAHR_E_UNSUPPORTED, "desc has a tail");
    longer.tail = 0;
    assert_int_equal(tahr_telemetry_create(&longer.desc, &t), TAHR_OK);
    tahr_telemetry_destroy(t);
    listener_end(&ear);
}

static void a_sink_that_does_not_fit_is_refused(void **unused)
{
    const tahr_log log = {NULL, say};
    listener ear;
    tahr_telemetry_desc desc;
    (void)unused;
    listener_init(&ear, NULL);
    listener_describe(&ear, 1, &desc);
    desc.log = &log;
    ear.sink.abi_minor++;
    refuses(&desc, TAHR_E_ABI, "sink.abi_major and abi_minor are ");
    ear.sink.abi_minor--;
    ear.sink.struct_size--;
    refuses(&desc, TAHR_E_STRUCT_SIZE, "sink.struct_size is ");
    ear.sink.struct_size++;
    ear.sink.name = NULL;
    refuses(&desc, TAHR_E_NULL, "sink.name is NULL");
    listener_end(&ear);
}

static void *no_memory(void *user, size_t size, size_t alignment)
{
    (void)user, (void)size, (void)alignment;
    return NULL;
}

static void no_free(void *user, void *memory, size_t size, size_t alignment)
{
    (void)user, (void)size, (void)alignment;
    assert_null(memory);
}

static void an_allocator_without_memory_is_an_error(void **unused)
{
    const tahr_log log = {NULL, say};
    const tahr_allocator none = {NULL, no_memory, no_free};
    listener ear;
    tahr_telemetry_desc desc;
    (void)unused;
    listener_init(&ear, NULL);
    listener_describe(&ear, 1, &desc);
    desc.log = &log;
    desc.allocator = &none;
    refuses(&desc, TAHR_E_MEMORY, "no memory");
    listener_end(&ear);
}

static void a_description_begins_as_zeros(void **unused)
{
    struct {
        tahr_telemetry_desc desc;
        uint32_t more;
    } longer;
    (void)unused;
    memset(&longer, 1, sizeof longer);
    assert_int_equal(tahr_telemetry_desc_init(NULL, sizeof longer.desc), TAHR_E_NULL);
    assert_int_equal(tahr_telemetry_desc_init(&longer.desc, sizeof longer.desc - 1), TAHR_E_STRUCT_SIZE);
    assert_int_equal(longer.desc.struct_size, 0x01010101);
    assert_int_equal(tahr_telemetry_desc_init(&longer.desc, sizeof longer), TAHR_OK);
    assert_int_equal(longer.desc.struct_size, sizeof longer);
    assert_int_equal(longer.desc.characters, 0);
    assert_int_equal(longer.more, 0);
}

static void a_step_that_cannot_be_is_refused_and_leaves_no_trace(void **unused)
{
    listener ear;
    tahr_telemetry_desc desc;
    tahr_telemetry *t;
    made_up m;
    tahr_telemetry_counts c = {.struct_size = sizeof c};
    (void)unused;
    listener_init(&ear, NULL);
    listener_describe(&ear, 2, &desc);
    assert_int_equal(tahr_telemetry_create(&desc, &t), TAHR_OK);
    made_up_init(&m, 1);
    assert_int_equal(tahr_telemetry_begin(NULL, 0, 0, 0, &m.state), TAHR_E_NULL);
    assert_int_equal(tahr_telemetry_begin(t, 0, 0, 0, NULL), TAHR_E_NULL);
    assert_int_equal(tahr_telemetry_begin(t, 1, 0, 0, &m.state), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_telemetry_begin(t, 0, 2, 0, &m.state), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_telemetry_begin(t, 0, 0, 1, &m.state), TAHR_E_ARGUMENT);

    const tahr_telemetry_step good = made_up_pushed(&m, 1);
    assert_int_equal(tahr_telemetry_push(NULL, 0, &good), TAHR_E_NULL);
    assert_int_equal(tahr_telemetry_push(t, 0, NULL), TAHR_E_NULL);
    assert_int_equal(tahr_telemetry_push(t, 1, &good), TAHR_E_ARGUMENT);
    const double bad[] = {-1e-9, NAN, INFINITY, 10.1};
    for (int i = 0; i < 4; i++) {
        tahr_telemetry_step s = good;
        s.dt = bad[i];
        assert_int_equal(tahr_telemetry_push(t, 0, &s), TAHR_E_ARGUMENT);
    }
    tahr_telemetry_step s = good;
    s.character = 2;
    assert_int_equal(tahr_telemetry_push(t, 0, &s), TAHR_E_ARGUMENT);
    s = good;
    s.input = NULL;
    assert_int_equal(tahr_telemetry_push(t, 0, &s), TAHR_E_NULL);
    s = good;
    s.state = NULL;
    assert_int_equal(tahr_telemetry_push(t, 0, &s), TAHR_E_NULL);
    s = good;
    s.flags = 4;
    assert_int_equal(tahr_telemetry_push(t, 0, &s), TAHR_E_UNSUPPORTED);
    s = good;
    s.reserved = 1;
    assert_int_equal(tahr_telemetry_push(t, 0, &s), TAHR_E_ARGUMENT);
    m.input.struct_size--;
    assert_int_equal(tahr_telemetry_push(t, 0, &good), TAHR_E_STRUCT_SIZE);
    m.input.struct_size++;
    m.report.struct_size = 0;
    assert_int_equal(tahr_telemetry_push(t, 0, &good), TAHR_E_STRUCT_SIZE);
    m.report.struct_size = sizeof m.report;
    m.report.events = NULL;
    m.report.event_count = 1;
    assert_int_equal(tahr_telemetry_push(t, 0, &good), TAHR_E_NULL);

    assert_int_equal(tahr_telemetry_get_counts(t, &c), TAHR_OK);
    for (int k = 0; k < TAHR_MESSAGE_WORLD; k++)
        assert_int_equal(c.offered[k], 0);
    tahr_state state;
    assert_int_equal(tahr_telemetry_latest(t, 1, &state, NULL), TAHR_E_NOT_FOUND);
    tahr_telemetry_destroy(t);
    listener_end(&ear);
}

static void a_change_that_cannot_be_is_refused_and_leaves_no_trace(void **unused)
{
    const tahr_body_pose pose = {0, 0, {{0, 0, 0}, {0, 0, 0, 1}}};
    listener ear;
    tahr_telemetry_desc desc;
    tahr_telemetry *t;
    tahr_telemetry_counts c = {.struct_size = sizeof c};
    (void)unused;
    listener_init(&ear, NULL);
    listener_describe(&ear, 1, &desc);
    assert_int_equal(tahr_telemetry_create(&desc, &t), TAHR_OK);
    assert_int_equal(tahr_telemetry_change(NULL, TAHR_CHANGE_SET, &pose, 1, 0, 1), TAHR_E_NULL);
    assert_int_equal(tahr_telemetry_change(t, TAHR_CHANGE_SET, NULL, 1, 0, 1), TAHR_E_NULL);
    assert_int_equal(tahr_telemetry_change(t, 0, &pose, 1, 0, 1), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_telemetry_change(t, TAHR_CHANGE_SNAPSHOT, &pose, 1, 0, 1), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_telemetry_change(t, TAHR_CHANGE_SET, &pose, 65537, 0, 1), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_telemetry_change(t, TAHR_CHANGE_SET, &pose, 1, 0.1, 1), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_telemetry_change(t, TAHR_CHANGE_TOUCH, &pose, 1, 0, 1), TAHR_E_ARGUMENT);
    const double bad[] = {0, -1, NAN, 10.1};
    for (int i = 0; i < 4; i++)
        assert_int_equal(tahr_telemetry_change(t, TAHR_CHANGE_MOVE, &pose, 1, bad[i], 1), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_telemetry_get_counts(t, &c), TAHR_OK);
    assert_int_equal(c.offered[TAHR_MESSAGE_BODY], 0);
    assert_int_equal(tahr_telemetry_change(t, TAHR_CHANGE_MOVE, NULL, 0, 0.1, 1), TAHR_OK); /* all come to rest */
    tahr_telemetry_destroy(t);
    listener_end(&ear);
}

static void what_is_asked_wrongly_is_not_answered(void **unused)
{
    listener ear;
    tahr_telemetry_desc desc;
    tahr_telemetry *t;
    tahr_telemetry_counts c = {.struct_size = sizeof c};
    (void)unused;
    listener_init(&ear, NULL);
    listener_describe(&ear, 1, &desc);
    assert_int_equal(tahr_telemetry_create(&desc, &t), TAHR_OK);
    assert_int_equal(tahr_telemetry_get_counts(NULL, &c), TAHR_E_NULL);
    assert_int_equal(tahr_telemetry_get_counts(t, NULL), TAHR_E_NULL);
    c.struct_size--;
    assert_int_equal(tahr_telemetry_get_counts(t, &c), TAHR_E_STRUCT_SIZE);
    assert_int_equal(tahr_telemetry_stop(NULL, TAHR_STOP_DRAIN, 1), TAHR_E_NULL);
    assert_int_equal(tahr_telemetry_stop(t, 0, 1), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_telemetry_stop(t, 3, 1), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_DRAIN, -1), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_DRAIN, NAN), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_DRAIN, 1e7), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_telemetry_stop(t, TAHR_STOP_DRAIN, 100), TAHR_OK); /* was still at work */
    tahr_telemetry_destroy(t);
    listener_end(&ear);
}

static void messages_have_names(void **unused)
{
    static const char *const names[] = {"state", "event", "input", "report", "snapshot", "body", "world"};
    (void)unused;
    for (uint32_t k = 0; k < TAHR_MESSAGE_COUNT; k++)
        assert_string_equal(tahr_message_name(k), names[k]);
    assert_string_equal(tahr_message_name(TAHR_MESSAGE_COUNT), "?");
    assert_string_equal(tahr_message_name(0xFFFFFFFFu), "?");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_field_out_of_range_is_named),
        cmocka_unit_test(every_part_of_a_description_is_looked_at),
        cmocka_unit_test(a_sink_that_does_not_fit_is_refused),
        cmocka_unit_test(an_allocator_without_memory_is_an_error),
        cmocka_unit_test(a_description_begins_as_zeros),
        cmocka_unit_test(a_step_that_cannot_be_is_refused_and_leaves_no_trace),
        cmocka_unit_test(a_change_that_cannot_be_is_refused_and_leaves_no_trace),
        cmocka_unit_test(what_is_asked_wrongly_is_not_answered),
        cmocka_unit_test(messages_have_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
#else
int main(void)
{
    puts("SKIP: unit_telemetry_arguments: built without libtahr_threads");
    return 77;
}
#endif
