/* SPDX-License-Identifier: MIT
 * test_plummet.c: rises and falls the short way are those of the long way, bit for bit, and are taken in free air. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include <tahr/crowd.h>
#include <tahr/native.h>
#include <tahr/tahr.h>

#include "dice.h"

enum { FLIGHTS = 48, STEPS = 240, EVENTS = 16 };

/* A plate, and a block and a ball above it to fall beside and to jump against. */
enum { BODIES = 3 };
static tahr_world *open_yard(uint32_t count)
{
    tahr_body_desc b[BODIES];
    tahr_world_desc desc;
    tahr_world *world = NULL;
    tahr_body_desc_init(&b[0], sizeof b[0], TAHR_BODY_BOX);
    b[0].half_extents = (tahr_vec3){30, 30, 1};
    tahr_body_desc_init(&b[1], sizeof b[1], TAHR_BODY_BOX);
    b[1].half_extents = (tahr_vec3){2, 2, 12};
    tahr_body_desc_init(&b[2], sizeof b[2], TAHR_BODY_SPHERE);
    b[2].radius = 3;
    b[2].pose.position = (tahr_vec3){0, 6, 9};
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = b;
    desc.body_count = count;
    assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &world), TAHR_OK);
    return world;
}

/* What a flight is like. */
typedef struct flight {
    tahr_config config;
    tahr_state state;
    double dt;
    int has_events;
} flight;

static const double STEPS_OF[] = {1.0 / 240, 1.0 / 60, 1.0 / 50, 1.0 / 35, 1.0 / 30, 1.0 / 20, 1.0 / 10, 0.3};
static const double GRAVITY[][3] = {{0, 0, -9.81}, {0, 0, -9.8}, {0, 0, -3.7}, {0, 0, -20},
                                    {1, -2, -9},   {0, 3, 0},    {0, 0, 1.6},  {0, 0, -1e-7}};

/* Starts within `reach` of `at`. */
static flight draw(oracle_random *dice, tahr_vec3 at, double reach)
{
    flight f;
    tahr_config *c = &f.config;
    const double *g = GRAVITY[oracle_below(dice, 8)];
    tahr_config_init(c, sizeof *c, TAHR_PRESET_PRECISE);
    c->gravity = (tahr_vec3){g[0], g[1], g[2]};
    c->terminal_speed = oracle_below(dice, 3) ? c->terminal_speed : 4;
    c->arc_tolerance = oracle_below(dice, 3) ? c->arc_tolerance : 2e-5;
    c->air_turn_friction = oracle_below(dice, 3) ? 0 : 2;
    c->air_control = oracle_below(dice, 3) ? c->air_control : 0;
    const tahr_vec3 off = dice_vec(dice, -reach, reach), place = {at.x + off.x, at.y + off.y, at.z + off.z};
    assert_int_equal(tahr_state_init(&f.state, c, &place), TAHR_OK);
    f.state.velocity = dice_vec(dice, -9, 9);
    f.state.velocity = oracle_below(dice, 4) ? f.state.velocity : (tahr_vec3){0, 0, 0};
    f.state.flags = oracle_below(dice, 2) ? TAHR_STATE_JUMPING : 0;
    f.state.flags |= oracle_below(dice, 2) ? TAHR_STATE_JUMP_HELD : 0u;
    f.state.floor.distance = oracle_below(dice, 2) ? -0.0 : 0.0; /* a step cleans what it does not change, too */
    f.dt = STEPS_OF[oracle_below(dice, 8)];
    f.has_events = (int)oracle_below(dice, 2);
    return f;
}

static void want(oracle_random *dice, tahr_input *input)
{
    if (oracle_below(dice, 9) == 0) {
        input->move = oracle_below(dice, 3) ? dice_vec(dice, -1, 1) : (tahr_vec3){0, 0, 0};
    }
    input->jump = oracle_below(dice, 6) == 0;
}

/* What a step reported, but for what it took to find out. */
static tahr_report plainly(tahr_report r)
{
    memset(r.saved, 0, sizeof r.saved);
    r.triangle_tests = r.narrow_iterations = r.gathers = r.escapes = 0;
    r.events = NULL;
    return r;
}

/* Steps both ways side by side. Returns the number of steps in the air that asked nothing of the scene. */
static int fly(tahr_world *world, flight *f, oracle_random *dice, int steps)
{
    tahr_mover *movers[2];
    tahr_state states[2] = {f->state, f->state};
    tahr_event events[2][EVENTS];
    tahr_input input = {.struct_size = sizeof input};
    int spared = 0;

    for (int way = 0; way < 2; way++) {
        f->config.short_ways = !way;
        assert_int_equal(tahr_mover_create(world, &f->config, &movers[way]), TAHR_OK);
    }
    for (int n = 0; n < steps; n++) {
        tahr_report r[2];
        const double dt = oracle_below(dice, 8) ? f->dt : STEPS_OF[oracle_below(dice, 8)];
        want(dice, &input);
        memset(events, 0, sizeof events);
        for (int way = 0; way < 2; way++) {
            r[way] = (tahr_report){.struct_size = sizeof r[way]};
            r[way].events = f->has_events ? events[way] : NULL;
            r[way].event_capacity = f->has_events ? EVENTS : 0;
            assert_true(tahr_mover_step(movers[way], &input, dt, &states[way], &r[way]) >= 0);
        }
        const tahr_report a = plainly(r[0]), b = plainly(r[1]);
        assert_memory_equal(&states[0], &states[1], sizeof states[0]);
        assert_memory_equal(&a, &b, sizeof a);
        assert_memory_equal(events[0], events[1], sizeof events[0]);
        spared += states[0].mode == TAHR_MODE_FALLING && r[0].saved[TAHR_SHORTCUT_CLEAR_AIR] == r[0].sweeps;
    }
    f->state = states[0];
    for (int way = 0; way < 2; way++) {
        tahr_mover_destroy(movers[way]);
    }
    return spared;
}

static void flights_among_bodies_have_the_bits_of_the_long_way(void **unused)
{
    oracle_random dice = {41};
    tahr_world *world = open_yard(BODIES);
    (void)unused;
    for (int i = 0; i < FLIGHTS; i++) {
        flight f = draw(&dice, (tahr_vec3){0, 0, 20}, 18);
        fly(world, &f, &dice, STEPS);
    }
    tahr_world_close(world);
}

static void flights_far_above_all_ask_nothing_of_the_scene(void **unused)
{
    oracle_random dice = {42};
    tahr_world *world = open_yard(BODIES);
    int flights = 0, spared = 0;
    (void)unused;
    while (flights < FLIGHTS) {
        flight f = draw(&dice, (tahr_vec3){0, 0, 9000}, 100);
        const double g = fabs(f.config.gravity.x) + fabs(f.config.gravity.y) + fabs(f.config.gravity.z);
        if (g < 1e-3 ||
            f.config.arc_tolerance < 1e-4) { /* goes straight, or in so many chords that it goes the long way */
            continue;
        }
        f.has_events = 0;
        spared += fly(world, &f, &dice, 60);
        flights++;
    }
    /* But for steps of 0.3 s (1 of 8 flights and of 64 steps, 14 %), the long way. */
    assert_true(spared > 0.7 * 60 * FLIGHTS);
    tahr_world_close(world);
}

/* z and vz of the parabola; and x, which nothing changes without a wish. */
static void a_fall_the_short_way_is_the_parabola(void **unused)
{
    tahr_world *world = open_yard(1);
    (void)unused;
    for (size_t i = 0; i < sizeof STEPS_OF / sizeof STEPS_OF[0]; i++) {
        tahr_config config;
        tahr_state s;
        tahr_mover *mover;
        tahr_input input = {.struct_size = sizeof input};
        tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);

        assert_int_equal(tahr_mover_create(world, &config, &mover), TAHR_OK);
        assert_int_equal(tahr_state_init(&s, &config, &(tahr_vec3){1, 2, 500}), TAHR_OK);
        s.velocity = (tahr_vec3){3, 0, 6};
        const int steps = (int)ceil(2 / STEPS_OF[i]);
        for (int n = 0; n < steps; n++) {
            assert_int_equal(tahr_mover_step(mover, &input, STEPS_OF[i], &s, NULL), TAHR_OK);
        }
        const double t = steps * STEPS_OF[i];
        assert_true(fabs(s.position.z - (500 + 6 * t - 0.5 * 9.81 * t * t)) < 1e-9);
        assert_true(fabs(s.velocity.z - (6 - 9.81 * t)) < 1e-11);
        assert_true(fabs(s.position.x - (1 + 3 * t)) < 1e-11);
        tahr_mover_destroy(mover);
    }
    tahr_world_close(world);
}

/* Two sizes take turns in one mover: what is clear for the thin one is not for the one of 5 m. */
static void what_is_clear_for_one_size_is_not_for_another(void **unused)
{
    tahr_world *world = open_yard(1);
    tahr_config configs[2];
    tahr_crowd *crowd;
    tahr_crowd_desc desc;
    tahr_crowd_tick tick;
    tahr_state states[2];
    tahr_input inputs[2];
    tahr_member members[2] = {{.id = 0, .groups = 1, .flags = TAHR_MEMBER_ALONE, .config = 0},
                              {.id = 1, .groups = 1, .flags = TAHR_MEMBER_ALONE, .config = 1}};
    (void)unused;
    for (int i = 0; i < 2; i++) {
        tahr_config_init(&configs[i], sizeof configs[i], TAHR_PRESET_PRECISE);
        inputs[i] = (tahr_input){.struct_size = sizeof inputs[i]};
    }
    configs[1].shape.radius = 5;
    configs[1].shape.half_height = 7;
    tahr_crowd_desc_init(&desc, sizeof desc);
    desc.capacity = 2;
    desc.configs = configs;
    desc.config_count = 2;
    desc.flags = TAHR_CROWD_LEAN;
    desc.tasks = 1;
    assert_int_equal(tahr_crowd_create(world, &desc, &crowd), TAHR_OK);
    tahr_crowd_tick_init(&tick, sizeof tick);
    tick.count = 2;
    tick.members = members;
    tick.inputs = inputs;
    tick.states = states;
    tick.dt = 1.0 / 60;
    for (int i = 0; i < 2; i++) { /* both feet 12 m above the plate, whose top is at 1 m */
        const tahr_vec3 at = {0.1, 0.2, 13 + configs[i].shape.half_height};
        assert_int_equal(tahr_state_init(&states[i], &configs[i], &at), TAHR_OK);
    }
    for (int n = 0; n < 120; n++) {
        assert_true(tahr_crowd_step(crowd, &tick) >= 0);
        for (int i = 0; i < 2; i++) {
            assert_true(states[i].position.z - configs[i].shape.half_height > 1);
        }
    }
    assert_int_equal(states[0].mode, TAHR_MODE_WALKING);
    assert_int_equal(states[1].mode, TAHR_MODE_WALKING);
    tahr_crowd_destroy(crowd);
    tahr_world_close(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flights_among_bodies_have_the_bits_of_the_long_way),
        cmocka_unit_test(flights_far_above_all_ask_nothing_of_the_scene),
        cmocka_unit_test(a_fall_the_short_way_is_the_parabola),
        cmocka_unit_test(what_is_clear_for_one_size_is_not_for_another),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
