/* SPDX-License-Identifier: MIT
 * test_feel_ways.c: who has settings under "Feel", or turns toward a facing, goes the short ways too, with the bits of
 * the long one. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include <tahr/tahr.h>

#include "dice.h"
#include "native_world.h"

enum { BODIES = 40, FAR = BODIES - 1, CHARACTERS = 3, STEPS = 500, EVENTS = 16 };

/* Settings, each of which is of use by itself. */
enum {
    COYOTE = 1 << 0,
    BUFFER = 1 << 1,
    RELEASE = 1 << 2,
    FALL = 1 << 3,
    AIR = 1 << 4,
    SLIDE = 1 << 5,
    WALL_JUMP = 1 << 6,
    LEDGE = 1 << 7,
    CORNER = 1 << 8,
    FACING = 1 << 9,
    HOLD = 1 << 10,
    ALL = (1 << 11) - 1
};

static double or_none(uint32_t what, uint32_t setting, double value, double none)
{
    return what & setting ? value : none;
}

static tahr_config config_of(uint32_t what, oracle_random *dice)
{
    const double much = oracle_uniform(dice, 0.3, 1.5);
    tahr_config c;
    tahr_config_init(&c, sizeof c, TAHR_PRESET_PRECISE);
    c.jump_speed = oracle_uniform(dice, 4, 7);
    c.coyote_time = or_none(what, COYOTE, 0.15 * much, 0);
    c.jump_buffer = or_none(what, BUFFER, 0.15 * much, 0);
    c.jump_release_gravity = or_none(what, RELEASE, 3 * much, 1);
    c.fall_gravity = or_none(what, FALL, 1.6 * much, 1);
    c.air_jumps = what & AIR ? 2 : 0;
    c.wall_slide_speed = or_none(what, SLIDE, 3 * much, 0);
    c.wall_jump_speed = or_none(what, WALL_JUMP, 6 * much, 0);
    c.wall_coyote_time = or_none(what, WALL_JUMP, 0.1 * much, 0);
    c.ledge_grab = or_none(what, LEDGE, 0.4 * much, 0);
    c.corner_correction = or_none(what, CORNER, 0.25 * much, 0);
    c.jump_hold_time = or_none(what, HOLD, 0.1 * much, 0);
    return c;
}

/* A yard with walls, edges within reach, steps, ramps and planks overhead in the middle of a wide plain. moves: and a
 * body far away that moves. */
static tahr_world *open_yard(int moves)
{
    static tahr_body_desc b[BODIES];
    tahr_world_desc desc;
    tahr_world *world = NULL;
    oracle_random dice = {17};
    b[0] = native_box(v_make(0, 0, -1), v_make(400, 400, 1));
    for (int i = 1; i < FAR; i++) {
        const double height = i % 3 == 0 ? oracle_uniform(&dice, 0.05, 0.4) : oracle_uniform(&dice, 0.6, 2.5);
        const double lean = i % 4 ? 0 : oracle_uniform(&dice, -0.3, 0.3), size = sqrt(1 + lean * lean);
        const tahr_vec3 at = dice_vec(&dice, -9, 9);
        b[i] = native_box(v_make(at.x, at.y, i % 5 ? height : 2.3 + height),
                          v_make(oracle_uniform(&dice, 0.2, 1.5), oracle_uniform(&dice, 0.2, 1.5), height));
        b[i].pose.orientation = (tahr_quat){lean / size, 0, 0, 1 / size};
    }
    b[FAR] = native_box(v_make(300, 0, 1), v_make(1, 1, 1));
    b[FAR].flags = TAHR_BODY_MOVABLE;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = b;
    desc.body_count = moves ? BODIES : FAR;
    assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &world), TAHR_OK);
    return world;
}

/* What happened, of what is to happen. */
typedef struct tally {
    uint64_t saved[TAHR_SHORTCUT_COUNT];
    int grabs, wall_jumps, spent; /* spent: steps of who holds the button of the jump the short way */
} tally;

/* One character, with the short ways and without. */
typedef struct walker {
    tahr_mover *movers[2];
    tahr_state states[2];
    tahr_input input;
    int has_events;
} walker;

static void open_walker(walker *w, tahr_world *worlds[2], uint32_t what, oracle_random *dice)
{
    tahr_config config = config_of(what, dice);
    const tahr_vec3 off = dice_vec(dice, -12, 12);
    for (int way = 0; way < 2; way++) {
        config.short_ways = !way;
        assert_int_equal(tahr_mover_create(worlds[way], &config, &w->movers[way]), TAHR_OK);
        assert_int_equal(tahr_state_init(&w->states[way], &config, &(tahr_vec3){off.x, off.y, 7}), TAHR_OK);
    }
    w->input = (tahr_input){.struct_size = sizeof w->input};
    w->has_events = (int)oracle_below(dice, 2);
}

static void close_walkers(walker *w, int count, tahr_world *worlds[2])
{
    for (int way = 0; way < 2; way++) {
        for (int i = 0; i < count; i++)
            tahr_mover_destroy(w[i].movers[way]);
        tahr_world_close(worlds[way]);
    }
}

/* The button goes down and up at random, at most half a second each; who is far out turns back. */
static void want(walker *w, uint32_t what, oracle_random *dice)
{
    tahr_input *in = &w->input;
    if (oracle_below(dice, 30) == 0) {
        const tahr_vec3 at = w->states[0].position;
        in->move = oracle_below(dice, 6) ? dice_vec(dice, -1, 1) : (tahr_vec3){0, 0, 0};
        in->move.x -= at.x / 16;
        in->move.y -= at.y / 16;
        in->move.z = 0;
    }
    in->jump = in->jump ? oracle_below(dice, 12) != 0 : oracle_below(dice, 40) == 0;
    if (what & FACING && oracle_below(dice, 25) == 0) {
        in->flags = oracle_below(dice, 4) ? TAHR_INPUT_FACING : 0;
        in->facing = oracle_below(dice, 3) ? in->move : dice_vec(dice, -2, 2);
    }
}

/* What a step reported, but for what it took to find out. */
static tahr_report plainly(tahr_report r)
{
    memset(r.saved, 0, sizeof r.saved);
    r.triangle_tests = r.narrow_iterations = r.gathers = r.escapes = 0;
    r.events = NULL;
    return r;
}

static void count(tally *t, const tahr_report *r, uint32_t flags)
{
    for (int s = 0; s < TAHR_SHORTCUT_COUNT; s++)
        t->saved[s] += r->saved[s];
    for (uint32_t i = 0; i < r->event_count; i++) {
        t->grabs += r->events[i].type == TAHR_EVENT_GRABBED;
        t->wall_jumps += r->events[i].type == TAHR_EVENT_WALL_JUMPED;
    }
    t->spent += r->saved[TAHR_SHORTCUT_CLEAR_AIR] > 0 && flags & TAHR_STATE_JUMP_SPENT;
}

static void step_both(walker *w, double dt, tally *t)
{
    static tahr_event events[2][EVENTS];
    tahr_report r[2];
    memset(events, 0, sizeof events);
    for (int way = 0; way < 2; way++) {
        r[way] = (tahr_report){.struct_size = sizeof r[way]};
        r[way].events = w->has_events ? events[way] : NULL;
        r[way].event_capacity = w->has_events ? EVENTS : 0;
        assert_true(tahr_mover_step(w->movers[way], &w->input, dt, &w->states[way], &r[way]) >= 0);
    }
    count(t, &r[0], w->states[0].flags);
    const tahr_report on = plainly(r[0]), off = plainly(r[1]);
    assert_memory_equal(&w->states[0], &w->states[1], sizeof w->states[0]);
    assert_memory_equal(&on, &off, sizeof on);
    assert_memory_equal(events[0], events[1], sizeof events[0]);
}

static void shuttle(tahr_world *worlds[2], int step)
{
    const tahr_body_pose p = {.body = FAR,
                              .pose = {.position = {300 + 0.02 * (step % 50), 0, 1}, .orientation = {0, 0, 0, 1}}};
    for (int way = 0; way < 2; way++)
        assert_int_equal(tahr_world_move(worlds[way], &p, 1, 1.0 / 60), TAHR_OK);
}

/* Characters with such settings. */
static void wander(uint32_t what, int moves, oracle_random *dice, tally *all)
{
    tahr_world *worlds[2] = {open_yard(moves), open_yard(moves)};
    walker walkers[CHARACTERS];
    const tally before = *all;
    for (int i = 0; i < CHARACTERS; i++)
        open_walker(&walkers[i], worlds, what, dice);
    for (int n = 0; n < STEPS; n++) {
        const double dt = n % 50 < 35 ? 1.0 / 60 : n % 50 < 45 ? 1.0 / 30 : oracle_uniform(dice, 1e-3, 0.1);
        if (moves) shuttle(worlds, n);
        for (int i = 0; i < CHARACTERS; i++) {
            want(&walkers[i], what, dice);
            step_both(&walkers[i], dt, all);
        }
    }
    close_walkers(walkers, CHARACTERS, worlds);
    const uint64_t *now = all->saved, *then = before.saved;
    assert_true(now[TAHR_SHORTCUT_KNOWN_FLOOR] - then[TAHR_SHORTCUT_KNOWN_FLOOR] > STEPS / 5);
    assert_true(now[TAHR_SHORTCUT_CLEAR_AIR] - then[TAHR_SHORTCUT_CLEAR_AIR] > 20);
    assert_true(!moves || now[TAHR_SHORTCUT_CALM] - then[TAHR_SHORTCUT_CALM] > STEPS / 2);
}

static void assert_that_much_happened(const tally *t)
{
    print_message("    %d grabs, %d wall jumps, %d short steps of held jumps\n", t->grabs, t->wall_jumps, t->spent);
    assert_true(t->grabs > 10 && t->wall_jumps > 20 && t->spent > 200);
}

static void each_setting_by_itself_has_the_bits_of_the_long_way(void **unused)
{
    oracle_random dice = {7};
    tally all = {0};
    (void)unused;
    for (uint32_t what = 1; what < ALL; what <<= 1)
        for (int moves = 0; moves < 2; moves++)
            for (int again = 0; again < 12; again++)
                wander(what, moves, &dice, &all);
    assert_that_much_happened(&all);
}

static void any_mixture_of_settings_has_the_bits_of_the_long_way(void **unused)
{
    oracle_random dice = {8};
    tally all = {0};
    (void)unused;
    for (int i = 0; i < 200; i++)
        wander(i % 6 ? oracle_below(&dice, ALL + 1) : ALL, i % 2, &dice, &all);
    assert_that_much_happened(&all);
}

/* Who walks and who falls: facings as large as they may be, and larger; and a first step as long as it may be, of
 * who left a wall or presses the button. */
static void what_is_asked_for_the_short_way_is_checked(void **unused)
{
    static const double sizes[] = {1, 9e4, 9e5, 1.1e6, NAN, INFINITY};
    (void)unused;
    for (size_t n = 0; n < 2 * sizeof sizes / sizeof sizes[0]; n++) {
        tahr_world *worlds[2] = {open_yard(0), open_yard(0)};
        const int falls = n % 2 == 0, good = n / 2 < 3;
        oracle_random dice = {n};
        tally all = {0};
        walker w;
        open_walker(&w, worlds, COYOTE | BUFFER | AIR, &dice);
        for (int way = 0; way < 2; way++) {
            w.states[way].position = (tahr_vec3){60, 60, falls ? 500 : 0.92};
            w.states[way].flags = n % 4 == 0 ? TAHR_STATE_WALL_TOUCHED : 0;
        }
        w.input.jump = n % 4 == 2;
        step_both(&w, falls ? 1 : 1.0 / 60, &all);
        w.input.jump = 0;
        w.input.move.x = 0.5;
        for (int i = 0; i < 60; i++)
            step_both(&w, 1.0 / 60, &all);
        w.input.flags = TAHR_INPUT_FACING;
        w.input.facing = (tahr_vec3){0.1, sizes[n / 2], 0};
        for (int way = 0; way < 2; way++) {
            const tahr_status is = tahr_mover_step(w.movers[way], &w.input, 1.0 / 60, &w.states[way], NULL);
            assert_int_equal(is, good ? TAHR_OK : TAHR_E_ARGUMENT);
        }
        assert_memory_equal(&w.states[0], &w.states[1], sizeof w.states[0]);
        close_walkers(&w, 1, worlds);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_setting_by_itself_has_the_bits_of_the_long_way),
                                       cmocka_unit_test(any_mixture_of_settings_has_the_bits_of_the_long_way),
                                       cmocka_unit_test(what_is_asked_for_the_short_way_is_checked)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
