/* SPDX-License-Identifier: MIT
 * test_rest.c: a crowd that rests, and tells nobody, is only compared with what it was: every bit that it is given is
 * seen all the same. The like of it that never sleeps goes the same way, and refuses the same. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "crowd.h"
#include "throng.h"

enum { COUNT = 4, CHANGED = 2 };

/* The same crowd with sleep and without; who stands where, and how. */
typedef struct pair {
    throng on, off;
    tahr_config configs[2][2];
    tahr_state good[COUNT];
} pair;

static void open_one(pair *p, throng *t, uint32_t sleep)
{
    tahr_body_desc ground;
    tahr_body_desc_init(&ground, sizeof ground, TAHR_BODY_BOX);
    ground.half_extents = (tahr_vec3){200, 200, 1};
    ground.pose.position.z = -1;
    ground.mask = 1;
    throng_open(t, &ground, 1);
    for (int k = 0; k < 2; k++) {
        p->configs[sleep][k] = t->config;
        p->configs[sleep][k].sleep = sleep;
    }
    p->configs[sleep][1].mask = 2; /* falls through the ground */
    t->desc.configs = p->configs[sleep];
    t->desc.config_count = 2;
    throng_make(t, COUNT);
    t->tick.reports = NULL;
    t->tick.delays = NULL;
    for (uint32_t i = 0; i < COUNT; i++) {
        throng_place(t, i, 3.0 * i, 0.5 * i);
    }
}

/* Ticks until all rest. */
static void settle(pair *p, int members)
{
    throng *both[2] = {&p->on, &p->off};
    for (int k = 0; k < 2; k++) {
        throng *t = both[k];
        t->tick.members = members ? t->members : NULL;
        for (int n = 0; n < 4; n++) {
            assert_int_equal(tahr_crowd_step(t->crowd, &t->tick), TAHR_OK);
        }
    }
    assert_true(p->on.crowd->settled);
    assert_memory_equal(p->on.states, p->off.states, sizeof p->good);
}

static void open_pair(pair *p, int members, int narrow)
{
    open_one(p, &p->on, 1);
    open_one(p, &p->off, 0);
    p->on.crowd->kinds[0]->wide = narrow ? 0 : p->on.crowd->kinds[0]->wide;
    for (int n = 0; n < 10; n++) {
        settle(p, members);
    }
    memcpy(p->good, p->on.states, sizeof p->good);
}

static void close_pair(pair *p)
{
    throng_close(&p->on);
    throng_close(&p->off);
}

/* One tick of both, from there. Returns what it came to. */
static tahr_status assert_alike(pair *p)
{
    assert_true(p->on.crowd->settled);
    memset(p->on.statuses, 0x55, COUNT * sizeof p->on.statuses[0]);
    memset(p->off.statuses, 0x55, COUNT * sizeof p->off.statuses[0]);
    p->on.said[0] = p->off.said[0] = 0;
    const tahr_status is = tahr_crowd_step(p->on.crowd, &p->on.tick);
    const tahr_status was = tahr_crowd_step(p->off.crowd, &p->off.tick);
    assert_int_equal(is, was);
    assert_memory_equal(p->on.states, p->off.states, sizeof p->good);
    assert_memory_equal(p->on.statuses, p->off.statuses, COUNT * sizeof p->on.statuses[0]);
    assert_string_equal(p->on.said, p->off.said);
    return is;
}

static void restore(pair *p, int members)
{
    memcpy(p->on.states, p->good, sizeof p->good);
    memcpy(p->off.states, p->good, sizeof p->good);
    settle(p, members);
    assert_memory_equal(p->on.states, p->good, sizeof p->good);
}

static void flip(void *of, size_t bit)
{
    ((unsigned char *)of)[bit / 8] ^= (unsigned char)(1u << bit % 8);
}

static void every_bit_of_a_state_at_rest_is_seen(void **unused)
{
    (void)unused;
    for (int way = 0; way < 3; way++) { /* with members, without, without 32-byte vectors */
        pair p;
        int refused = 0;
        const int members = way == 0;
        open_pair(&p, members, way == 2);
        for (size_t bit = 0; bit < 8 * sizeof p.good[0]; bit++) {
            flip(&p.on.states[CHANGED], bit);
            flip(&p.off.states[CHANGED], bit);
            refused += assert_alike(&p) < 0;
            restore(&p, members);
        }
        assert_true(refused > 8 * 40); /* the reserved bytes at least */
        close_pair(&p);
    }
}

/* Of what counts without a flag, and of the flags: the fields that some of those would need are set to what they may
 * be. Struct sizes are told apart before anything is looked at. */
static void every_bit_of_an_input_of_who_rests_is_seen(void **unused)
{
    (void)unused;
    for (int way = 0; way < 2; way++) {
        pair p;
        int refused = 0;
        open_pair(&p, 0, way);
        for (size_t bit = 0; bit < 8 * sizeof p.on.inputs[0]; bit++) {
            const tahr_input kept = p.on.inputs[CHANGED];
            if (bit / 8 >= 4 && bit / 8 < offsetof(tahr_input, reserved)) {
                p.on.inputs[CHANGED].gravity = (tahr_vec3){0, 0, -9.81};
                p.on.inputs[CHANGED].facing = (tahr_vec3){0, 1, 0};
                p.on.inputs[CHANGED].radius = 0.35, p.on.inputs[CHANGED].half_height = 0.9;
            }
            flip(&p.on.inputs[CHANGED], bit);
            p.off.inputs[CHANGED] = p.on.inputs[CHANGED];
            refused += assert_alike(&p) < 0;
            p.on.inputs[CHANGED] = p.off.inputs[CHANGED] = kept;
            restore(&p, 0);
        }
        assert_true(refused >= 32 + 20); /* input.reserved, and the flags that are none */
        close_pair(&p);
    }
}

/* Who somebody is, for how long the tick is, and what is around. */
static void what_else_a_tick_is_given_is_seen(void **unused)
{
    pair p;
    (void)unused;
    open_pair(&p, 1, 0);
    for (int what = 0; what < 11; what++) {
        tahr_status expected = TAHR_OK;
        for (int k = 0; k < 2; k++) {
            throng *t = k ? &p.off : &p.on;
            tahr_member *m = &t->members[CHANGED];
            switch (what) {
            case 0: m->id = 1, expected = TAHR_E_ARGUMENT; break;
            case 1: m->config = 1; break;
            case 2: m->config = 2, expected = TAHR_E_ARGUMENT; break;
            case 3: m->flags = 2, expected = TAHR_E_ARGUMENT; break;
            case 4: m->budget = 0.1, expected = TAHR_E_ARGUMENT; break;
            case 5: t->tick.dt = 1.0 / 50; break;
            case 6: t->tick.dt = -1, expected = TAHR_E_ARGUMENT; break;
            case 7: t->tick.count = COUNT - 1; break;
            case 8: t->inputs[CHANGED].move.z = NAN, expected = TAHR_E_ARGUMENT; break;
            case 9: m->budget = 0.1, t->tick.delays = t->delays; break;
            default: assert_int_equal(tahr_world_touch(t->world), TAHR_OK);
            }
        }
        assert_int_equal(assert_alike(&p), expected);
        assert_memory_equal(p.on.delays, p.off.delays, COUNT * sizeof p.on.delays[0]);
        assert_int_equal(p.on.crowd->settled, what == 6 || what == 7); /* not begun; of fewer all rest on */
        for (int k = 0; k < 2; k++) {
            throng *t = k ? &p.off : &p.on;
            t->members[CHANGED] = (tahr_member){.id = CHANGED};
            t->inputs[CHANGED].move.z = 0;
            t->tick.dt = 1.0 / 60;
            t->tick.count = COUNT;
            t->tick.delays = NULL;
        }
        settle(&p, 1);
        if (what < 10) { /* a floor found in a world that was touched is another one */
            restore(&p, 1);
        }
    }
    close_pair(&p);
}

/* Two in each other, who do not meet as long as their members say so; and then there are no members. */
static void who_is_somebody_else_wakes(void **unused)
{
    pair p;
    (void)unused;
    open_one(&p, &p.on, 1);
    open_one(&p, &p.off, 0);
    for (int k = 0; k < 2; k++) {
        throng *t = k ? &p.off : &p.on;
        throng_place(t, 1, 0.3, 0);
        t->members[0].flags = t->members[1].flags = TAHR_MEMBER_ALONE;
    }
    for (int n = 0; n < 10; n++) {
        settle(&p, 1);
    }
    p.on.tick.members = p.off.tick.members = NULL;
    const double x = p.on.states[1].position.x;
    assert_int_equal(assert_alike(&p), TAHR_OK);
    assert_true(p.on.states[1].position.x > x + 0.01);
    close_pair(&p);
}

/* Two change places: each has the other's state, which is a state at rest, but not his. */
static void who_changes_places_wakes(void **unused)
{
    pair p;
    (void)unused;
    open_pair(&p, 0, 0);
    for (int k = 0; k < 2; k++) {
        throng *t = k ? &p.off : &p.on;
        const tahr_state kept = t->states[1];
        t->states[1] = t->states[2];
        t->states[2] = kept;
    }
    assert_int_equal(assert_alike(&p), TAHR_OK);
    assert_false(p.on.crowd->settled);
    settle(&p, 0);
    close_pair(&p);
}

static void ticks_at_rest_are_counted(void **unused)
{
    pair p;
    tahr_crowd_counts before = {.struct_size = sizeof before}, after = before;
    (void)unused;
    open_pair(&p, 1, 0);
    assert_int_equal(tahr_crowd_get_counts(p.on.crowd, &before), TAHR_OK);
    for (int n = 0; n < 10; n++) {
        assert_int_equal(assert_alike(&p), TAHR_OK);
    }
    assert_int_equal(tahr_crowd_get_counts(p.on.crowd, &after), TAHR_OK);
    assert_int_equal(after.ticks - before.ticks, 10);
    assert_int_equal(after.steps - before.steps, 10 * COUNT);
    assert_int_equal(after.beside, before.beside);
    close_pair(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_bit_of_a_state_at_rest_is_seen),
                                       cmocka_unit_test(every_bit_of_an_input_of_who_rests_is_seen),
                                       cmocka_unit_test(what_else_a_tick_is_given_is_seen),
                                       cmocka_unit_test(who_is_somebody_else_wakes),
                                       cmocka_unit_test(who_changes_places_wakes),
                                       cmocka_unit_test(ticks_at_rest_are_counted)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
