/* SPDX-License-Identifier: MIT
 * bench_loop.c: a loop of C around the very call that Crowd.step makes, for bench_steps.py: the same crowd in the same
 * memory, without Python. */
#include <stdint.h>
#include <time.h>

typedef int32_t (*step_fn)(void *crowd, const void *tick, void *events, uint32_t room);

static int64_t now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return t.tv_sec * INT64_C(1000000000) + t.tv_nsec;
}

/* CPU time of the steps, ns; -1 if one fails. */
int64_t bench_loop(step_fn step, void *crowd, const void *tick, int32_t steps)
{
    const int64_t begin = now();
    for (int32_t i = 0; i < steps; i++) {
        if (step(crowd, tick, 0, 0) < 0) return -1;
    }
    return now() - begin;
}
