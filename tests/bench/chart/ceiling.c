/* SPDX-License-Identifier: MIT
 * ceiling.c: crowds side by side that know nothing of each other. */
#define _GNU_SOURCE /* sched_setaffinity, where there is one */

#include "ceiling.h"

#include <poll.h>
#include <sched.h>
#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MOST = 64, WARM_UP = 10 };

/* The others: processes that step until the pipe is closed. */
typedef struct others {
    pid_t pid[MOST];
    int stop;  /* its end here is closed when they are to end */
    int ready; /* a byte of each comes here */
    uint32_t count;
} others;

#ifdef __linux__
typedef cpu_set_t processors;

static void pin(uint32_t processor)
{
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(processor, &set);
    sched_setaffinity(0, sizeof set, &set); /* without it the system decides, which is nearly as good */
}

static void keep_pins(processors *now)
{
    CPU_ZERO(now);
    sched_getaffinity(0, sizeof *now, now);
}

static void restore_pins(const processors *before)
{
    sched_setaffinity(0, sizeof *before, before);
}
#else
typedef int processors;

static void pin(uint32_t processor)
{
    (void)processor;
}

static void keep_pins(processors *now)
{
    *now = 0;
}

static void restore_pins(const processors *before)
{
    (void)before;
}
#endif

static int warm_up(chart_throng *t)
{
    int ok = 1;
    for (int k = 0; k < WARM_UP && ok; k++) {
        ok = chart_throng_tick(t) >= 0;
    }
    return ok;
}

/* Another one, in its process. */
static void live(const chart_throng_desc *desc, uint32_t processor, int stop, int ready)
{
    chart_throng t;
    struct pollfd ends = {.fd = stop, .events = POLLIN};
    pin(processor);
    char ok = chart_throng_make(&t, desc) >= 0 && warm_up(&t);
    if (write(ready, &ok, 1) == 1) {
        while (ok && poll(&ends, 1, 0) == 0) {
            ok = chart_throng_tick(&t) >= 0;
        }
    }
    _exit(0);
}

/* Returns 0 if one of them could not be made; those that were are to be ended all the same. */
static int begin(others *o, const chart_throng_desc *desc, uint32_t count)
{
    int stop[2], ready[2];
    *o = (others){.stop = -1, .ready = -1};
    if (pipe(stop) != 0) {
        return 0;
    }
    if (pipe(ready) != 0) {
        close(stop[0]), close(stop[1]);
        return 0;
    }
    fflush(NULL);
    for (; o->count < count; o->count++) {
        const pid_t pid = fork();
        if (pid == 0) {
            close(stop[1]), close(ready[0]);
            live(desc, o->count + 1, stop[0], ready[1]);
        }
        if (pid < 0) {
            break;
        }
        o->pid[o->count] = pid;
    }
    close(stop[0]), close(ready[1]);
    o->stop = stop[1], o->ready = ready[0];
    int all = o->count == count;
    for (uint32_t i = 0; i < o->count && all; i++) {
        char ok = 0;
        all = read(o->ready, &ok, 1) == 1 && ok;
    }
    return all;
}

static void end(others *o)
{
    if (o->stop >= 0) {
        close(o->stop), close(o->ready);
    }
    for (uint32_t i = 0; i < o->count; i++) {
        waitpid(o->pid[i], NULL, 0);
    }
}

const char *chart_ceiling(const bench_world *level, uint32_t characters, uint32_t count, double *ns, uint32_t ticks)
{
    const chart_throng_desc desc = {level, characters, 1, 0, 0};
    chart_throng t;
    others o;
    processors before;
    if (count < 1 || count > MOST) {
        return "too many processors";
    }
    const char *wrong = begin(&o, &desc, count - 1) ? NULL : "a process could not be made";
    keep_pins(&before);
    pin(0);
    tahr_status status = chart_throng_make(&t, &desc);
    if (!wrong && (status < 0 || !warm_up(&t))) {
        wrong = "a step failed";
    }
    for (uint32_t k = 0; k < ticks && !wrong; k++) {
        const double seconds = chart_throng_tick(&t);
        wrong = seconds < 0 ? "a step failed" : NULL;
        ns[k] = 1e9 * seconds / characters / count;
    }
    chart_throng_free(&t);
    restore_pins(&before);
    end(&o);
    return wrong;
}
