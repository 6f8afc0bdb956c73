/* SPDX-License-Identifier: MIT
 * udpm://, in a network of its own (namespace.sh): from the sink to subscribers, as liblcm brings it. */
#include "../inbox.h"
#include "../quiet.h"

#include <tahr/tahr.h>
#include <tahr/lcm.h>

#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#define URL "udpm://239.255.76.67:7667?ttl=0"

static tahr_lcm *open_sink(const char *url)
{
    tahr_lcm_desc desc;
    tahr_lcm *lcm;
    assert_int_equal(tahr_lcm_desc_init(&desc, sizeof desc), TAHR_OK);
    desc.url = url;
    assert_int_equal(tahr_lcm_open(&desc, &lcm), TAHR_OK);
    return lcm;
}

static void publish_step(const tahr_sink *sink, uint32_t character, uint64_t step)
{
    const tahr_stamp stamp = {.character = character, .step = step, .sequence = step};
    const tahr_state state = {.position = {1, 2, 3}, .radius = (double)step};
    const tahr_input input = {.struct_size = sizeof input};
    const tahr_report report = {.struct_size = sizeof report};
    const tahr_sink_input given = {.input = &input, .dt = 1.0 / 60};
    const tahr_sink_report said = {.report = &report, .hash = tahr_state_hash(&state)};
    assert_int_equal(sink->input(sink->user, &stamp, &given), TAHR_OK);
    assert_int_equal(sink->state(sink->user, &stamp, &state), TAHR_OK);
    assert_int_equal(sink->report(sink->user, &stamp, &said), TAHR_OK);
}

static void expect_steps(inbox *box, uint32_t count)
{
    assert_true(inbox_wait(box, TAHR_MESSAGE_STATE, count));
    assert_true(inbox_wait(box, TAHR_MESSAGE_INPUT, count));
    assert_true(inbox_wait(box, TAHR_MESSAGE_REPORT, count));
    assert_int_equal(box->state.step, count - 1);
    assert_true(box->state.radius == count - 1 && box->state.position[2] == 3);
    assert_true(box->input.dt == 1.0 / 60);
}

/* Subscribes before anything is sent: lcm_get_fileno returns when the socket has joined the group. */
static void open_listener(inbox *box, const char *url)
{
    lcm_t *lcm = lcm_create(url);
    assert_non_null(lcm);
    inbox_open(box, lcm, "", "");
    assert_true(lcm_get_fileno(lcm) >= 0);
}

static void close_listener(inbox *box)
{
    inbox_close(box);
    lcm_destroy(box->lcm);
}

static void two_listeners_hear_the_same(void **unused)
{
    inbox one, two;
    tahr_lcm *lcm = open_sink(URL);
    (void)unused;
    open_listener(&one, URL);
    open_listener(&two, URL);
    for (uint64_t i = 0; i < 100; i++)
        publish_step(tahr_lcm_sink(lcm), 3, i);
    expect_steps(&one, 100);
    expect_steps(&two, 100);
    tahr_lcm_close(lcm);
    close_listener(&one);
    close_listener(&two);
}

static void the_usual_group_is_taken_where_nothing_is_said(void **unused)
{
    static const char *const places[] = {NULL, "", URL};
    inbox box;
    (void)unused;
    for (int i = 0; i < 3; i++) {
        if (places[i]) assert_int_equal(setenv("LCM_DEFAULT_URL", places[i], 1), 0);
        if (!places[i]) assert_int_equal(unsetenv("LCM_DEFAULT_URL"), 0);
        open_listener(&box, URL);
        tahr_lcm *lcm = open_sink(NULL);
        publish_step(tahr_lcm_sink(lcm), 1, 0);
        expect_steps(&box, 1);
        tahr_lcm_close(lcm);
        close_listener(&box);
    }
}

static void another_group_and_port_are_another_network(void **unused)
{
    inbox here, there;
    tahr_lcm *lcm = open_sink("udpm://239.1.2.3:7918?recv_buf_size=65536&ttl=0");
    (void)unused;
    open_listener(&here, URL);
    open_listener(&there, "udpm://239.1.2.3:0x1eee?ttl=0");
    publish_step(tahr_lcm_sink(lcm), 1, 0);
    expect_steps(&there, 1);
    assert_int_equal(lcm_handle_timeout(here.lcm, 0), 0);
    assert_int_equal(here.count[TAHR_MESSAGE_STATE], 0);
    tahr_lcm_close(lcm);
    close_listener(&here);
    close_listener(&there);
}

/* Longer than a packet of UDP may be: LCM sends it in pieces. */
static void a_long_world_arrives_whole(void **unused)
{
    enum { COUNT = 150 };
    static tahr_config configs[COUNT];
    inbox box;
    open_listener(&box, URL);
    tahr_lcm *lcm = open_sink(URL);
    const tahr_sink *sink = tahr_lcm_sink(lcm);
    const tahr_sink_world world = {.level = "long", .configs = configs, .config_count = COUNT};
    (void)unused;
    assert_true(sizeof configs > 65536 && sizeof configs < 150000);
    for (uint32_t i = 0; i < COUNT; i++)
        configs[i].struct_size = sizeof configs[i];
    assert_int_equal(sink->world(sink->user, &world), TAHR_OK);
    assert_true(inbox_wait(&box, TAHR_MESSAGE_WORLD, 1));
    assert_int_equal(box.world.size, sizeof configs);
    assert_string_equal(box.world.level, "long");
    tahr_lcm_close(lcm);
    close_listener(&box);
}

/* A process that has joined the group and then reads nothing. */
static pid_t start_deaf(void)
{
    int ready[2];
    char letter;
    assert_int_equal(pipe(ready), 0);
    const pid_t pid = fork();
    assert_true(pid >= 0);
    if (pid == 0) {
        lcm_t *lcm = lcm_create(URL);
        if (!lcm || !lcm_subscribe(lcm, ".*", NULL, NULL) || lcm_get_fileno(lcm) < 0) _exit(1);
        if (write(ready[1], "x", 1) != 1) _exit(1);
        raise(SIGSTOP);
        _exit(0);
    }
    assert_int_equal(read(ready[0], &letter, 1), 1);
    assert_int_equal(waitpid(pid, NULL, WUNTRACED), pid);
    close(ready[0]);
    close(ready[1]);
    return pid;
}

/* He is waited for a while, and no more; who listens loses nothing by it. */
static void who_has_stopped_does_not_hold_up_the_others(void **unused)
{
    enum { COUNT = 3000 };
    inbox box;
    const pid_t deaf = start_deaf();
    open_listener(&box, URL);
    tahr_lcm *lcm = open_sink(URL);
    (void)unused;
    for (uint64_t i = 0; i < COUNT; i++) {
        publish_step(tahr_lcm_sink(lcm), 0, i);
        while (i % 32 == 0 && lcm_handle_timeout(box.lcm, 0) > 0) {
        }
    }
    expect_steps(&box, COUNT);
    kill(deaf, SIGKILL);
    waitpid(deaf, NULL, 0);
    tahr_lcm_close(lcm);
    close_listener(&box);
}

/* A child that was forked while a sink is open, and ends, does no harm. */
static void forks_are_left_in_peace(void **unused)
{
    inbox box;
    open_listener(&box, URL);
    tahr_lcm *lcm = open_sink(URL);
    int status;
    (void)unused;
    for (uint64_t i = 0; i < 10; i++) {
        const pid_t pid = fork();
        assert_true(pid >= 0);
        if (pid == 0) _exit(0);
        publish_step(tahr_lcm_sink(lcm), 0, i);
        assert_int_equal(waitpid(pid, &status, 0), pid);
        assert_int_equal(status, 0);
    }
    expect_steps(&box, 10);
    tahr_lcm_close(lcm);
    close_listener(&box);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_listeners_hear_the_same),
        cmocka_unit_test(the_usual_group_is_taken_where_nothing_is_said),
        cmocka_unit_test(another_group_and_port_are_another_network),
        cmocka_unit_test(a_long_world_arrives_whole),
        cmocka_unit_test(who_has_stopped_does_not_hold_up_the_others),
        cmocka_unit_test(forks_are_left_in_peace),
    };
    if (!getenv("TAHR_OWN_NETWORK")) {
        puts("SKIP: lcm_exchange: to be run by namespace.sh, not where others hear it");
        return 77;
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
