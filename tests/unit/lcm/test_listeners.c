/* SPDX-License-Identifier: MIT
 * test_listeners.c: who lags is found among the sockets of the system; by plain datagrams to this machine itself. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#ifndef TAHR_HAVE_LCM
int main(void)
{
    puts("SKIP: unit_lcm_listeners: built without LCM");
    return 77;
}
#else
#include <arpa/inet.h>
#include <netinet/in.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "lcm/listeners.h"

static const uint8_t group[4] = {239, 255, 76, 67};

typedef struct ear {
    int socket;
    struct sockaddr_in address;
} ear;

static void open_ear(ear *e, in_addr_t bound_to)
{
    socklen_t size = sizeof e->address;
    memset(&e->address, 0, sizeof e->address);
    e->address.sin_family = AF_INET;
    e->address.sin_addr.s_addr = htonl(bound_to);
    e->socket = socket(AF_INET, SOCK_DGRAM, 0);
    assert_true(e->socket >= 0);
    assert_int_equal(bind(e->socket, (struct sockaddr *)&e->address, sizeof e->address), 0);
    assert_int_equal(getsockname(e->socket, (struct sockaddr *)&e->address, &size), 0);
    e->address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
}

static void say(const ear *e, int mouth)
{
    static const char text[700];
    assert_int_equal(sendto(mouth, text, sizeof text, 0, (const struct sockaddr *)&e->address, sizeof e->address),
                     sizeof text);
}

/* How many datagrams it takes until the answer is that, at most `most`. */
static int say_until(const ear *e, int mouth, const tahr__lcm_listeners *l, int answer, int most)
{
    int count = 0;
    while (tahr__lcm_listeners_lag(l) != answer && count < most) {
        say(e, mouth);
        count++;
    }
    return count;
}

static void read_all(const ear *e)
{
    char text[1024];
    while (recv(e->socket, text, sizeof text, MSG_DONTWAIT) > 0) {
    }
}

static void who_has_much_to_read_lags_until_he_has_lost_it(void **unused)
{
    enum { MOST = 100000 };
    tahr__lcm_listeners l;
    ear e;
    (void)unused;
    open_ear(&e, INADDR_ANY);
    tahr__lcm_listeners_open(&l, group, ntohs(e.address.sin_port));
    const int mouth = socket(AF_INET, SOCK_DGRAM, 0);
    for (int round = 0; round < 2; round++) {
        assert_int_equal(tahr__lcm_listeners_lag(&l), 0);
        say(&e, mouth);
        assert_int_equal(tahr__lcm_listeners_lag(&l), 0);
        const int to_lag = say_until(&e, mouth, &l, 1, MOST);
        assert_in_range(to_lag, 10, MOST - 1);
        const int to_full = say_until(&e, mouth, &l, 0, MOST);
        /* From a quarter to seven eighths. */
        assert_in_range(to_full, 2 * to_lag, 3 * to_lag);
        read_all(&e);
    }
    close(mouth);
    tahr__lcm_listeners_close(&l);
    close(e.socket);
}

/* Another port, another address, no port at all. */
static void others_are_not_looked_at(void **unused)
{
    tahr__lcm_listeners l, elsewhere;
    ear e, loop;
    (void)unused;
    open_ear(&e, INADDR_ANY);
    open_ear(&loop, INADDR_LOOPBACK);
    const int mouth = socket(AF_INET, SOCK_DGRAM, 0);
    tahr__lcm_listeners_open(&l, group, ntohs(e.address.sin_port));
    assert_in_range(say_until(&e, mouth, &l, 1, 100000), 10, 99999);
    tahr__lcm_listeners_open(&elsewhere, group, (uint16_t)(ntohs(e.address.sin_port) ^ 1));
    assert_int_equal(tahr__lcm_listeners_lag(&elsewhere), 0);
    tahr__lcm_listeners_close(&elsewhere);
    tahr__lcm_listeners_open(&elsewhere, group, ntohs(loop.address.sin_port));
    assert_int_equal(say_until(&loop, mouth, &elsewhere, 1, 100), 100);
    tahr__lcm_listeners_close(&elsewhere);
    tahr__lcm_listeners_close(&l);
    close(mouth);
    close(e.socket);
    close(loop.socket);
}

/* The table is read piece by piece. */
static void one_is_found_among_many(void **unused)
{
    enum { MANY = 200 };
    ear ears[MANY];
    tahr__lcm_listeners l;
    (void)unused;
    const int mouth = socket(AF_INET, SOCK_DGRAM, 0);
    for (int i = 0; i < MANY; i++)
        open_ear(&ears[i], INADDR_ANY);
    for (int i = 0; i < MANY; i += 13) {
        tahr__lcm_listeners_open(&l, group, ntohs(ears[i].address.sin_port));
        assert_int_equal(tahr__lcm_listeners_lag(&l), 0);
        assert_in_range(say_until(&ears[i], mouth, &l, 1, 100000), 10, 99999);
        tahr__lcm_listeners_close(&l);
    }
    for (int i = 0; i < MANY; i++)
        close(ears[i].socket);
    close(mouth);
}

static void where_nothing_is_known_nobody_lags(void **unused)
{
    const tahr__lcm_listeners l = {.table = -1};
    (void)unused;
    assert_int_equal(tahr__lcm_listeners_lag(&l), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(who_has_much_to_read_lags_until_he_has_lost_it),
        cmocka_unit_test(others_are_not_looked_at),
        cmocka_unit_test(one_is_found_among_many),
        cmocka_unit_test(where_nothing_is_known_nobody_lags),
    };
    if (access("/proc/net/udp", R_OK) != 0) {
        puts("SKIP: unit_lcm_listeners: this system has no /proc/net/udp");
        return 77;
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
#endif
