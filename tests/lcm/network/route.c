/* SPDX-License-Identifier: MIT
 * A network whose way is taken away, in one of its own (namespace.sh): what is told, and that steps go on. */
#include "../inbox.h"
#include "../quiet.h"

#include <tahr/tahr.h>
#include <tahr/lcm.h>
#include <tahr/telemetry.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define URL "udpm://239.255.76.67:7667?ttl=0"

static void run_command(const char *command)
{
    assert_int_equal(system(command), 0);
}

static void take_route(void)
{
    run_command("ip route del 224.0.0.0/4 dev lo");
}

static void give_route(void)
{
    run_command("ip route add 224.0.0.0/4 dev lo");
}

static tahr_status try_to_open(const char *url, quiet *q, tahr_lcm **lcm)
{
    tahr_lcm_desc desc;
    assert_int_equal(tahr_lcm_desc_init(&desc, sizeof desc), TAHR_OK);
    desc.url = url;
    quiet_begin(q);
    desc.log = &q->log;
    const tahr_status status = tahr_lcm_open(&desc, lcm);
    assert_int_equal(quiet_end(q), 0);
    return status;
}

static void without_a_way_it_is_said_what_is_missing(void **unused)
{
    static const char *const urls[] = {URL, "udpm://", NULL};
    quiet q;
    tahr_lcm *lcm = NULL;
    (void)unused;
    take_route();
    assert_int_equal(unsetenv("LCM_DEFAULT_URL"), 0);
    for (int i = 0; i < 3; i++) {
        assert_int_equal(try_to_open(urls[i], &q, &lcm), TAHR_E_NOT_FOUND);
        assert_null(lcm);
        assert_int_equal(q.count, 1);
        assert_non_null(strstr(q.message, "multicast group 239.255.76.67: Network is unreachable"));
        assert_non_null(strstr(q.message, "'ip route add 224.0.0.0/4 dev lo'"));
    }
    give_route();
    assert_int_equal(try_to_open(URL, &q, &lcm), TAHR_OK);
    assert_int_equal(q.count, 0);
    tahr_lcm_close(lcm);
}

static tahr_status publish_state(const tahr_sink *sink)
{
    const tahr_stamp stamp = {.character = 1};
    const tahr_state state = {.radius = 1};
    return sink->state(sink->user, &stamp, &state);
}

static void a_way_that_is_lost_and_found_is_told_each_time_it_is_lost(void **unused)
{
    tahr_lcm_desc desc;
    tahr_lcm *lcm;
    quiet q;
    int failed = 0, sent = 0;
    (void)unused;
    assert_int_equal(tahr_lcm_desc_init(&desc, sizeof desc), TAHR_OK);
    desc.url = URL;
    quiet_begin(&q);
    desc.log = &q.log;
    assert_int_equal(tahr_lcm_open(&desc, &lcm), TAHR_OK);
    const tahr_sink *sink = tahr_lcm_sink(lcm);
    for (int i = 0; i < 3; i++) {
        take_route();
        for (int k = 0; k < 10; k++)
            failed += publish_state(sink) == TAHR_E_FILE;
        give_route();
        for (int k = 0; k < 10; k++)
            sent += publish_state(sink) == TAHR_OK;
    }
    tahr_lcm_close(lcm);
    assert_int_equal(quiet_end(&q), 0);
    assert_int_equal(failed, 30);
    assert_int_equal(sent, 30);
    assert_int_equal(q.count, 3);
    assert_non_null(strstr(q.message, "messages cannot be sent: Network is unreachable"));
}

static tahr_status plane(void *user, const tahr_sweep *q, tahr_hit *hit)
{
    const double gap = q->position.z - q->shape.half_height - q->margin, drop = -q->motion.z;
    (void)user;
    hit->normal = hit->surface_normal = (tahr_vec3){0, 0, 1};
    if (gap < -q->margin) {
        hit->start_overlap = 1;
        hit->depth = -gap - q->margin;
    } else if (drop > 0 && gap <= drop) {
        hit->blocking = 1;
        hit->fraction = gap > 0 ? gap / drop : 0;
    }
    return TAHR_OK;
}

/* Steps of one character, and where it is in the end. */
static tahr_state walk(tahr_telemetry *telemetry, const tahr_config *config, int steps)
{
    const tahr_callbacks callbacks = {.struct_size = sizeof callbacks, .sweep = plane};
    const tahr_input input = {.struct_size = sizeof input, .move = {1, 0, 0}};
    tahr_world *world;
    tahr_mover *mover;
    tahr_state state;
    assert_int_equal(tahr_world_open_callbacks(&callbacks, NULL, &world), TAHR_OK);
    assert_int_equal(tahr_mover_create(world, config, &mover), TAHR_OK);
    assert_int_equal(tahr_state_init(&state, config, &(tahr_vec3){0, 0, 1}), TAHR_OK);
    for (int i = 0; i < steps; i++) {
        tahr_report report = {.struct_size = sizeof report};
        if (telemetry) assert_int_equal(tahr_telemetry_begin(telemetry, 0, 0, 0, &state), TAHR_OK);
        assert_true(tahr_mover_step(mover, &input, 1.0 / 60, &state, &report) >= 0);
        const tahr_telemetry_step step = {.input = &input, .state = &state, .report = &report, .dt = 1.0 / 60};
        if (telemetry) assert_int_equal(tahr_telemetry_push(telemetry, 0, &step), TAHR_OK);
    }
    tahr_mover_destroy(mover);
    tahr_world_close(world);
    return state;
}

static void steps_go_on_without_a_network_and_what_was_not_sent_is_counted(void **unused)
{
    enum { STEPS = 300 };
    tahr_config config;
    tahr_telemetry_desc desc;
    tahr_telemetry *telemetry;
    tahr_telemetry_counts counts = {.struct_size = sizeof counts};
    tahr_lcm *lcm;
    quiet q;
    (void)unused;
    assert_int_equal(tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE), TAHR_OK);
    assert_int_equal(try_to_open(URL, &q, &lcm), TAHR_OK);
    assert_int_equal(tahr_telemetry_desc_init(&desc, sizeof desc), TAHR_OK);
    desc.sink = tahr_lcm_sink(lcm);
    desc.characters = 1;
    desc.configs = &config;
    desc.config_count = 1;
    take_route();
    assert_int_equal(tahr_telemetry_create(&desc, &telemetry), TAHR_OK);
    const tahr_state with = walk(telemetry, &config, STEPS);
    assert_int_equal(tahr_telemetry_stop(telemetry, TAHR_STOP_DRAIN, 60), TAHR_OK);
    assert_int_equal(tahr_telemetry_get_counts(telemetry, &counts), TAHR_OK);
    tahr_telemetry_destroy(telemetry);
    give_route();
    tahr_lcm_close(lcm);
    const tahr_state without = walk(NULL, &config, STEPS);
    assert_memory_equal(&with, &without, sizeof with);
    assert_int_equal(counts.failed[TAHR_MESSAGE_STATE], STEPS);
    assert_int_equal(counts.failed[TAHR_MESSAGE_INPUT], STEPS);
    assert_int_equal(counts.failed[TAHR_MESSAGE_REPORT], STEPS);
    assert_int_equal(counts.delivered[TAHR_MESSAGE_STATE], 0);
    assert_int_equal(counts.last_failure, TAHR_E_FILE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_a_way_it_is_said_what_is_missing),
        cmocka_unit_test(a_way_that_is_lost_and_found_is_told_each_time_it_is_lost),
        cmocka_unit_test(steps_go_on_without_a_network_and_what_was_not_sent_is_counted),
    };
    if (!getenv("TAHR_OWN_NETWORK")) {
        puts("SKIP: lcm_route: to be run by namespace.sh: it takes away the routes of a network");
        return 77;
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
