/* SPDX-License-Identifier: MIT
 * puppet.c: a method that goes where a test says. */
#include "puppet.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

static void *open_puppet(const method *m, const method_level *level, const method_character *who, uint32_t count,
                         char *error)
{
    puppet *p = (puppet *)(uintptr_t)m->data;
    (void)level;
    (void)error;
    assert_true(count <= PUPPETS);
    p->dt = who->dt;
    return p;
}

static void close_puppet(void *self)
{
    (void)self;
}

static void place(void *self, uint32_t i, const double position[3])
{
    puppet *p = self;
    p->places[i] = (method_place){.position = {position[0], position[1], position[2]}};
}

static void step(void *self, uint32_t i, const double wish[3], int jump)
{
    puppet *p = self;
    uint32_t tick = p->ticks[i]++;
    assert_true(tick < PUPPET_TICKS);
    memcpy(p->wishes[i][tick], wish, sizeof p->wishes[i][tick]);
    p->jumps[i][tick] = jump;
    p->move(p, i, tick, wish, &p->places[i]);
}

static void look(void *self, uint32_t i, method_place *out)
{
    const puppet *p = self;
    *out = p->places[i];
}

method puppet_method(puppet *p, puppet_fn *move)
{
    memset(p, 0, sizeof *p);
    p->move = move;
    return (method){.name = "puppet",
                    .version = "0",
                    .settings = "none",
                    .open = open_puppet,
                    .close = close_puppet,
                    .place = place,
                    .step = step,
                    .look = look,
                    .data = p};
}

void puppet_run(const course *c, puppet *p, puppet_fn *move, uint32_t ticks, course_result *result)
{
    method m = puppet_method(p, move);
    char error[METHOD_ERROR];
    course_plan plan = {.characters = PUPPETS, .ticks = ticks};
    course_run *run = course_open(c, &m, &plan, error);
    assert_non_null(run);
    while (course_advance(run, 50) > 0) {
    }
    assert_int_equal(course_judge(run, result), 1);
    course_close(run);
}
