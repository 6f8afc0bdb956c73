/* SPDX-License-Identifier: MIT
 * test_still.c: a crowd that stands is not looked at again, and nobody can tell. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "throng.h"

enum { COUNT = 48, TICKS = 3000 };

static const double DT = 1.0 / 60;

/* Two of a crowd, one of which never sleeps: what differs is found. */
typedef struct twins {
    throng on, off;
    tahr_config configs[2][2];
    oracle_random dice;
    double dt;
    uint32_t shown; /* characters of a tick */
    uint64_t asleep, awake, failed;
} twins;

static void open_one(twins *w, uint32_t sleep)
{
    throng *t = sleep ? &w->on : &w->off;
    tahr_config *configs = w->configs[sleep];
    tahr_body_desc b[2];
    for (int i = 0; i < 2; i++) {
        tahr_body_desc_init(&b[i], sizeof b[i], TAHR_BODY_BOX);
        b[i].half_extents = i ? (tahr_vec3){3, 3, 0.2} : (tahr_vec3){60, 60, 1};
        b[i].pose.position.z = i ? -0.1 : -1;
    }
    b[1].flags = TAHR_BODY_MOVABLE;
    throng_open(t, b, 2);
    configs[0] = configs[1] = t->config;
    configs[0].sleep = configs[1].sleep = sleep;
    configs[1].shape.radius = 0.5;
    t->desc.configs = configs;
    t->desc.config_count = 2;
    throng_make(t, COUNT);
    for (uint32_t i = 0; i < COUNT; i++) {
        throng_place(t, i, 2.5 * (i % 8) - 10, 2.5 * (i / 8) - 10);
    }
}

static tahr_status tick(throng *t, const twins *w)
{
    t->tick.dt = w->dt;
    t->tick.count = w->shown;
    for (uint32_t i = 0; i < COUNT; i++) {
        t->reports[i] = (tahr_report){.struct_size = sizeof t->reports[i]};
        t->statuses[i] = 0;
    }
    return tahr_crowd_step(t->crowd, &t->tick);
}

/* All but what sleeping is for. */
static void assert_same(twins *w, uint32_t i, int n)
{
    tahr_report a = w->on.reports[i], b = w->off.reports[i];
    if (memcmp(&w->on.states[i], &w->off.states[i], sizeof w->on.states[i]) != 0) {
        fail_msg("tick %d, character %u: the states differ", n, i);
    }
    assert_int_equal(w->on.statuses[i], w->off.statuses[i]);
    w->asleep += (a.flags & TAHR_REPORT_ASLEEP) != 0;
    w->awake += (a.flags & TAHR_REPORT_ASLEEP) == 0;
    w->failed += w->on.statuses[i] < 0;
    assert_int_equal(a.flags & ~(uint32_t)TAHR_REPORT_ASLEEP, b.flags);
    assert_int_equal(a.slides, b.slides);
    assert_int_equal(a.slices, b.slices);
    assert_true(a.time_lost == b.time_lost && a.residual == b.residual && a.step_offset == b.step_offset);
}

static void step_both(twins *w, int n)
{
    const tahr_status on = tick(&w->on, w), off = tick(&w->off, w);
    assert_int_equal(on, off);
    for (uint32_t i = 0; i < COUNT; i++) {
        assert_same(w, i, n);
    }
}

static void raise_lift(twins *w, double height)
{
    const tahr_body_pose pose = {.body = 1, .pose = {{0, 0, height - 0.1}, {0, 0, 0, 1}}};
    assert_int_equal(tahr_world_move(w->on.world, &pose, 1, DT), TAHR_OK);
    assert_int_equal(tahr_world_move(w->off.world, &pose, 1, DT), TAHR_OK);
}

/* Every now and then something happens to one of them, the same in both. */
static void disturb(twins *w, int n)
{
    const uint32_t i = (uint32_t)oracle_uniform(&w->dice, 0, COUNT - 1e-9);
    const uint32_t j = (uint32_t)oracle_uniform(&w->dice, 0, COUNT - 1e-9);
    const double x = oracle_uniform(&w->dice, -12, 12), y = oracle_uniform(&w->dice, -12, 12);
    const int what = (int)oracle_uniform(&w->dice, 0, 14);
    w->dt = DT;
    w->shown = COUNT;
    for (int k = 0; k < 2; k++) {
        throng *t = k ? &w->off : &w->on;
        switch (what) {
        case 0:
        case 1: throng_go(t, i, x / 12, y / 12); break;
        case 2:
        case 3: throng_go(t, i, 0, 0); break;
        case 4: throng_place(t, i, x, y); break;
        case 5: t->members[i].mask = t->members[i].mask ? 0 : 2; break;
        case 6: t->members[i].flags ^= TAHR_MEMBER_ALONE; break;
        case 7: t->members[i].config ^= 1; break;
        case 8: w->dt = n % 2 ? 0 : 1.0 / 50; break;
        case 9: w->shown = i + 1; break;
        case 10: t->states[i].up.x = n % 2 ? NAN : 0; break;
        case 11: t->members[i].id = t->members[j].id; break;
        case 12: t->inputs[i].launch = (tahr_vec3){x, y, 1}; break;
        default: {
            const tahr_state s = t->states[i];
            t->states[i] = t->states[j], t->states[j] = s;
        }
        }
    }
}

/* What would stop the crowd for ever. */
static void repair(twins *w)
{
    for (int k = 0; k < 2; k++) {
        throng *t = k ? &w->off : &w->on;
        for (uint32_t i = 0; i < COUNT; i++) {
            t->members[i].id = i;
            t->states[i].up.x = 0;
        }
    }
}

static void whoever_sleeps_the_crowd_goes_the_same_way(void **unused)
{
    twins w = {.dice = {5}};
    (void)unused;
    open_one(&w, 1);
    open_one(&w, 0);
    for (int n = 0; n < TICKS; n++) {
        w.dt = DT;
        w.shown = COUNT;
        if (n % 20 > 15) disturb(&w, n);
        if (n % 400 > 380) raise_lift(&w, 0.05 * (n % 400 - 380));
        step_both(&w, n);
        if (n % 20 == 19) repair(&w);
    }
    print_message("    %u asleep, %u awake, %u failed\n", (unsigned)w.asleep, (unsigned)w.awake, (unsigned)w.failed);
    assert_true(w.asleep > w.awake / 10 && w.failed > 0);
    throng_close(&w.on);
    throng_close(&w.off);
}

static uint32_t count_asleep(const throng *t)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < COUNT; i++) {
        n += (t->reports[i].flags & TAHR_REPORT_ASLEEP) != 0 && t->reports[i].sweeps == 0;
    }
    return n;
}

/* 2.5 m apart: who walks to the next one meets him, and nobody else. */
static void who_walks_wakes_whom_he_comes_near(void **unused)
{
    twins w = {.dt = DT, .shown = COUNT};
    (void)unused;
    open_one(&w, 1);
    throng *t = &w.on;
    for (int i = 0; i < 60; i++) {
        assert_int_equal(tick(t, &w), TAHR_OK);
    }
    assert_int_equal(count_asleep(t), COUNT);
    throng_go(t, 9, 1, 0);
    assert_int_equal(tick(t, &w), TAHR_OK);
    assert_int_equal(count_asleep(t), COUNT - 1);
    for (int i = 0; i < 30; i++) { /* 2 m, at 4 m/s */
        assert_int_equal(tick(t, &w), TAHR_OK);
    }
    assert_int_equal(count_asleep(t), COUNT - 2);
    assert_int_equal(t->reports[10].flags & TAHR_REPORT_ASLEEP, 0);
    assert_true(throng_gap(&t->states[9], &t->states[10]) > 0);
    throng_close(&w.on);
}

static void settle(twins *w)
{
    for (int i = 0; i < 40; i++) {
        assert_true(tick(&w->on, w) >= 0);
    }
}

/* From the left, 2.5 m, at 4 m/s: a second is enough to be through him if he is not seen. */
static void assert_stopped_by(twins *w, uint32_t walker, uint32_t sleeper)
{
    throng *t = &w->on;
    throng_go(t, walker, 1, 0);
    for (int i = 0; i < 60; i++) {
        assert_true(tick(t, w) >= 0);
        const double gap = throng_gap(&t->states[walker], &t->states[sleeper]);
        if (!(gap > 0)) fail_msg("tick %d: %g m", i, gap);
    }
    throng_go(t, walker, 0, 0);
}

/* Shown elsewhere in a tick that steps nobody, or fails: then where he slept before. */
static void who_comes_back_to_where_he_slept_is_seen_there(void **unused)
{
    (void)unused;
    for (int wrong = 0; wrong < 2; wrong++) {
        twins w = {.dt = DT, .shown = COUNT};
        open_one(&w, 1);
        settle(&w);
        const tahr_state slept = w.on.states[10];
        throng_place(&w.on, 10, 40, 40);
        w.on.states[10].reserved[0] = (uint8_t)wrong;
        w.dt = wrong ? DT : 0;
        assert_int_equal(tick(&w.on, &w), wrong ? TAHR_E_ARGUMENT : TAHR_OK);
        w.dt = DT;
        w.on.states[10] = slept;
        assert_stopped_by(&w, 9, 10);
        throng_close(&w.on);
    }
}

/* Nobody moves, and yet two are in each other: one came while the other was not there, or did not count. */
static void who_finds_another_in_him_wakes(void **unused)
{
    (void)unused;
    for (int alone = 0; alone < 2; alone++) {
        twins w = {.dt = DT, .shown = COUNT};
        open_one(&w, 1);
        settle(&w);
        const tahr_vec3 at = w.on.states[10].position;
        w.shown = alone ? COUNT : 5;
        w.on.members[0].flags = alone ? TAHR_MEMBER_ALONE : 0;
        throng_place(&w.on, 0, at.x + 0.3, at.y);
        settle(&w);
        assert_true(throng_gap(&w.on.states[0], &w.on.states[10]) < -0.3);
        w.shown = COUNT;
        w.on.members[0].flags = 0;
        for (int i = 0; i < 60; i++) {
            tick(&w.on, &w);
        }
        assert_true(throng_gap(&w.on.states[0], &w.on.states[10]) > 0);
        throng_close(&w.on);
    }
}

/* Eight that are larger make other cells of the grid: those who sleep have other places in it, also those who were not
 * there when it was made. */
static void who_sleeps_is_found_in_other_cells(void **unused)
{
    (void)unused;
    for (int few = 0; few < 2; few++) {
        twins w = {.dt = DT, .shown = COUNT};
        open_one(&w, 1);
        settle(&w);
        for (uint32_t i = 0; i < 8; i++) {
            w.on.members[i].config = 1;
            throng_place(&w.on, i, 30 + 3 * (double)i, -40);
        }
        w.shown = few ? 8 : COUNT;
        settle(&w);
        w.shown = COUNT;
        for (uint32_t i = 8; i < COUNT - 1; i++) {
            if (i % 8 < 6) assert_stopped_by(&w, i, i + 1);
        }
        throng_close(&w.on);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(who_comes_back_to_where_he_slept_is_seen_there),
        cmocka_unit_test(who_finds_another_in_him_wakes),
        cmocka_unit_test(who_sleeps_is_found_in_other_cells),
        cmocka_unit_test(whoever_sleeps_the_crowd_goes_the_same_way),
        cmocka_unit_test(who_walks_wakes_whom_he_comes_near),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
