/* SPDX-License-Identifier: MIT
 * test_one_way.c: bodies that are stood on from above and passed from everywhere else, against parabolas, at every
 * frame rate, as boxes, sheets and rows of tiles, on every backend that has them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "common/one_way.h"
#include "dice.h"
#include "layers.h"

static const double G = 9.81, SKIN = 0.01;

/* Both sides of every limit, for all flags: a change of one of the two alone is found. */
static void the_two_rules_agree_at_every_limit(void **unused)
{
    (void)unused;
    static const double MARGINS[] = {0, 1e-3, 0.01, 0.05}, OFF[] = {-1, -1e-9, 0, 1e-9, 1};
    const tahr_vec3 up = {0, 0, 1};
    uint32_t there = 0, asked = 0;
    for (uint32_t k = 0; k < 4 * 3 * 5 * 5 * 64; k++) {
        double margin = MARGINS[k % 4], rounding = fmax(1e-3 * margin, 2e-6);
        double limits[] = {-rounding, 0, 2 * margin}, distance = limits[k / 4 % 3] + 1e-6 * OFF[k / 12 % 5];
        double lean = 0.5 + 0.1 * OFF[k / 60 % 5];
        tahr_vec3 normal = {sqrt(1 - lean * lean), 0, lean};
        uint32_t flags = k / 300;
        int32_t is = tahr_one_way_blocks(&up, &normal, distance, margin, flags);
        assert_int_equal(is, tahr__one_way_blocks(up, normal, distance, margin, flags));
        there += is != 0;
        asked++;
    }
    assert_true(there > asked / 2 && there < asked); /* with WHOLE always, which is every other */
}

/* The public rule and the one of the backends are written twice: backends never link libtahr. */
static void the_two_rules_agree(void **unused)
{
    (void)unused;
    oracle_random dice = {41};
    for (int i = 0; i < 100000; i++) {
        tahr_vec3 up = dice_direction(&dice), n = dice_direction(&dice);
        double margin = oracle_below(&dice, 4) ? oracle_uniform(&dice, 0, 0.02) : 0;
        double distance = oracle_uniform(&dice, -1, 3) * (oracle_below(&dice, 2) ? margin : 1e-3 * margin);
        uint32_t flags = oracle_below(&dice, 64);
        assert_int_equal(tahr_one_way_blocks(&up, &n, distance, margin, flags),
                         tahr__one_way_blocks(up, n, distance, margin, flags));
    }
    tahr_vec3 up = {0, 0, 1}, side = {sqrt(0.75) + 1e-9, 0, 0.5 - 1e-9};
    assert_int_equal(tahr_one_way_blocks(&up, &up, 0, 0.01, 0), 1);
    assert_int_equal(tahr_one_way_blocks(&up, &side, 0, 0.01, 0), 0);
    assert_int_equal(tahr_one_way_blocks(&up, &up, -1e-4, 0.01, 0), 0);
    assert_int_equal(tahr_one_way_blocks(&up, &up, 0.02, 0.01, TAHR_SWEEP_DROP), 0);
    assert_int_equal(tahr_one_way_blocks(&up, &up, 0.021, 0.01, TAHR_SWEEP_DROP), 1);
    assert_int_equal(tahr_one_way_blocks(NULL, &up, 0, 0.01, 0), 0);
    assert_int_equal(tahr_one_way_blocks(&up, NULL, 0, 0.01, 0), 0);
}

/* m, of every layer from the lowest: some closer than a foot is high, some far apart. */
static int stack_layers(layers *l, oracle_random *dice, double tops[8])
{
    static const double GAPS[] = {0.3, 0.45, 1, 3};
    double height = 0;
    for (int i = 0; i < 8; i++) {
        height += GAPS[oracle_below(dice, 4)];
        tops[i] = height;
        layers_add(l, (int)oracle_below(dice, LAYER_KINDS), -7.5 - i * 0.3, 8, height, TAHR_BODY_ONE_WAY);
    }
    return 8;
}

static void set_velocity(const layers *l, rig *r, double across, double up)
{
    r->state.velocity = layers_at(l, across, up);
}

/* Rises as if nothing were there, and comes down on the highest layer that the whole foot was above. */
static void jump_through(layers *l, rig *r, const double tops[8], double speed, double rate)
{
    double apex = layers_foot(l, r) + speed * speed / (2 * G), floor = 0;
    uint32_t apexes = 0, landings = 0;
    for (int i = 0; i < 8; i++) {
        floor = tops[i] <= apex ? tops[i] : floor;
        if (fabs(tops[i] - apex) < 0.02) { /* within two skins of the apex either is right */
            return;
        }
    }
    double level = layers_x(l, r->state.velocity);
    for (int i = 0; landings == 0; i++) {
        assert_true(r->time < 10);
        rig_step(r, 1 / rate);
        for (uint32_t k = 0; k < r->report.event_count; k++) {
            const tahr_event *e = &r->events[k];
            assert_true(e->type == TAHR_EVENT_APEX || e->type == TAHR_EVENT_LANDED || e->type == TAHR_EVENT_MODE ||
                        e->type == TAHR_EVENT_STOPPED);
            apexes += e->type == TAHR_EVENT_APEX;
            landings += e->type == TAHR_EVENT_LANDED;
            if (e->type == TAHR_EVENT_APEX) {
                assert_near(layers_height(l, e->position) - r->state.half_height, apex, 1e-9);
                assert_near(e->time + r->time - 1 / rate, speed / G, 1e-9);
            }
            if (e->type == TAHR_EVENT_LANDED) {
                double fall = sqrt(2 * (apex - floor - SKIN) / G);
                assert_near(e->time + r->time - 1 / rate, speed / G + fall, 1e-5);
                assert_near(layers_x(l, e->position), level * (speed / G + fall), 1e-4);
            }
        }
    }
    assert_int_equal(apexes, 1);
    rig_step(r, 1 / rate);
    assert_int_equal(r->state.mode, TAHR_MODE_WALKING);
    assert_true(layers_foot(l, r) - floor >= SKIN - 1e-5 && layers_foot(l, r) - floor <= 1.5 * SKIN + 1e-5);
}

static void jumps_rise_through_all_layers_and_land_on_the_highest_below(void **unused)
{
    (void)unused;
    for (int world = 0; world < LAYERS_WORLDS; world++) {
        oracle_random dice = {7 + (uint64_t)world};
        for (int trial = 0; trial < (world < 2 ? 40 : 4); trial++) {
            static layers l;
            double tops[8], speed = oracle_uniform(&dice, 2, 12), across = oracle_uniform(&dice, -1.5, 1.5);
            if (!layers_begin(&l, world)) {
                break;
            }
            layers_add(&l, LAYER_BOX, -20, 20, 0, 0);
            stack_layers(&l, &dice, tops);
            tahr_config c = layers_config(&l, TAHR_PRESET_PRECISE);
            int kind = (int)oracle_below(&dice, 3);
            if (kind == 1) {
                c.shape = (tahr_shape){.type = TAHR_SHAPE_BOX, .half_height = 0.9, .half_x = 0.3, .half_y = 0.25};
            } else if (kind == 2) {
                c.shape = (tahr_shape){.type = TAHR_SHAPE_SPHERE, .radius = 0.4, .half_height = 0.4};
            }
            for (int i = 0; i < RIG_RATES; i += world < 2 ? 1 : 2) {
                rig r;
                layers_open(&l, &r, &c, 0, 0.0125);
                set_velocity(&l, &r, across, speed);
                jump_through(&l, &r, tops, speed, rig_rates[i]);
                rig_close(&r);
            }
        }
    }
}

/* From beside and at every height, through the ends of platforms, rising: nothing bends the way. */
static void what_rises_past_the_end_of_a_platform_is_not_touched(void **unused)
{
    (void)unused;
    for (int world = 0; world < LAYERS_WORLDS; world++) {
        oracle_random dice = {17};
        for (int trial = 0; trial < (world < 2 ? 200 : 20); trial++) {
            static layers l;
            rig r;
            if (!layers_begin(&l, world)) {
                break;
            }
            layers_add(&l, (int)oracle_below(&dice, LAYER_KINDS), 0, 4, oracle_uniform(&dice, 0, 2), TAHR_BODY_ONE_WAY);
            layers_open(&l, &r, NULL, oracle_uniform(&dice, -2, 0), 0);
            double up = oracle_uniform(&dice, 4, 8), level = oracle_uniform(&dice, 0, 6), time = up / G;
            set_velocity(&l, &r, level, up);
            double x = layers_x(&l, r.state.position), foot = layers_foot(&l, &r);
            int steps = 1 + (int)oracle_below(&dice, 200);
            rig_steps(&r, steps, 0.999 * time / steps);
            time *= 0.999;
            assert_near(layers_x(&l, r.state.position), x + level * time, 1e-9);
            assert_near(layers_foot(&l, &r), foot + up * time - G * time * time / 2, 1e-9);
            rig_close(&r);
        }
    }
}

/* Between two tiles, partly below their tops: falls as if none were there, whichever way it drifts. */
static void who_has_sunk_into_a_tile_is_not_caught_by_the_next(void **unused)
{
    (void)unused;
    for (int world = 0; world < LAYERS_WORLDS; world++) {
        oracle_random dice = {23};
        for (int trial = 0; trial < (world < 2 ? 300 : 30); trial++) {
            static layers l;
            rig r;
            if (!layers_begin(&l, world)) {
                break;
            }
            layers_add(&l, trial % 2 ? LAYER_TILES : LAYER_BLOCKS, -6, 6, 0, TAHR_BODY_ONE_WAY);
            tahr_config c = layers_config(&l, TAHR_PRESET_PRECISE);
            if (trial % 3 == 2) {
                c.shape = (tahr_shape){.type = TAHR_SHAPE_BOX, .half_height = 0.9, .half_x = 0.3, .half_y = 0.3};
            }
            layers_open(&l, &r, &c, oracle_uniform(&dice, -1, 1), -oracle_uniform(&dice, 0.001, 0.4));
            double up = oracle_uniform(&dice, -3, 0.1), level = oracle_uniform(&dice, -8, 8), time = 0.3;
            set_velocity(&l, &r, level, up);
            double x = layers_x(&l, r.state.position), foot = layers_foot(&l, &r);
            int steps = 1 + (int)oracle_below(&dice, 100);
            for (int i = 0; i < steps; i++) {
                rig_step(&r, time / steps);
                assert_null(rig_event(&r, TAHR_EVENT_HIT));
            }
            assert_near(layers_x(&l, r.state.position), x + level * time, 1e-9);
            assert_near(layers_foot(&l, &r), foot + up * time - G * time * time / 2, 1e-9);
            rig_close(&r);
        }
    }
}

/* Straight down at the end of a platform: within the inner foot it stands, to where the contact leans by 60 degrees
 * (0.36 sin 60 = 0.312 m off the axis) its round foot slides off the edge, and farther out there is nothing. */
static void the_end_of_a_platform_holds_the_inner_foot_at_every_rate(void **unused)
{
    (void)unused;
    static const double OFF[] = {-0.3, 0.05, 0.19, 0.24, 0.3, 0.32, 0.35};
    for (int world = 0; world < LAYERS_WORLDS; world++) {
        for (int k = 0; k < 7; k++) {
            for (int i = 0; i < RIG_RATES; i += world < 2 ? 1 : 2) {
                static layers l;
                rig r;
                if (!layers_begin(&l, world)) {
                    break;
                }
                layers_add(&l, (k + i) % 2 ? LAYER_SHEET : LAYER_BOX, -4, 0, 0, TAHR_BODY_ONE_WAY);
                layers_open(&l, &r, NULL, OFF[k], 0.7 + 0.013 * k);
                double foot = layers_foot(&l, &r), time = 0;
                for (; time < 0.7 - 1e-9; time += 1 / rig_rates[i]) {
                    rig_step(&r, 1 / rig_rates[i]);
                }
                if (OFF[k] < 0.2) {
                    assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
                    assert_near(layers_x(&l, r.state.position), OFF[k], 1e-6);
                } else if (OFF[k] > 0.312) {
                    assert_near(layers_foot(&l, &r), foot - G * time * time / 2, 1e-9);
                } else {
                    assert_int_equal(r.state.mode, TAHR_MODE_FALLING);
                    assert_true(layers_foot(&l, &r) < -0.2 && layers_x(&l, r.state.position) > OFF[k]);
                }
                rig_close(&r);
            }
        }
    }
}

/* A foot that is below the top is not lifted by the platform, whatever the character does there. */
static void walking_into_a_low_platform_passes_through_it(void **unused)
{
    (void)unused;
    for (int world = 0; world < LAYERS_WORLDS; world++) {
        for (int i = 0; i < RIG_RATES; i++) {
            for (int kind = 0; kind < LAYER_KINDS; kind++) {
                static layers l;
                rig r;
                if (!layers_begin(&l, world)) {
                    break;
                }
                layers_add(&l, LAYER_BOX, -20, 20, 0, 0);
                layers_add(&l, kind, 0, 4, 0.1 + 0.3 * (i % 3), TAHR_BODY_ONE_WAY);
                layers_open(&l, &r, NULL, -2, 0.0125);
                rig_settle(&r);
                double foot = layers_foot(&l, &r);
                r.input.move = layers_at(&l, 1, 0);
                for (int k = 0; k < rig_rates[i] * 1.2; k++) {
                    rig_step(&r, 1 / rig_rates[i]);
                    assert_near(layers_foot(&l, &r), foot, 1e-9);
                    assert_null(rig_event(&r, TAHR_EVENT_HIT));
                }
                assert_true(layers_x(&l, r.state.position) > 2.5);
                r.input.jump = 1; /* crouches, grows and jumps in the middle of it */
                r.input.crouch = 1;
                rig_step(&r, 1 / rig_rates[i]);
                assert_null(rig_event(&r, TAHR_EVENT_DEPENETRATED));
                assert_int_equal(r.report.flags & TAHR_REPORT_SHAPE_REFUSED, 0);
                rig_close(&r);
            }
        }
    }
}

/* Standing on nothing but rounding: 100 000 steps that are computed, at the origin and 1000 km from it. */
static void nobody_sinks_through_a_platform_by_standing(void **unused)
{
    (void)unused;
    static const double FAR[] = {0, 1e6};
    for (int world = 0; world < 2; world++) {
        for (int i = 0; i < 2; i++) {
            static layers l;
            rig r;
            layers_begin(&l, world);
            layers_add(&l, LAYER_TILES, FAR[i] - 4, FAR[i] + 4, FAR[i], TAHR_BODY_ONE_WAY);
            tahr_config c = layers_config(&l, TAHR_PRESET_PRECISE);
            c.cached_floor = c.sleep = 0;
            layers_open(&l, &r, &c, FAR[i], FAR[i]); /* exactly on it, but for the rounding of a sum */
            rig_steps(&r, 50000, 1.0 / 60);
            assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
            double foot = layers_foot(&l, &r) - FAR[i];
            assert_true(foot >= SKIN - 1e-6 && foot <= 1.5 * SKIN + 1e-6);
            rig_close(&r);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_two_rules_agree),
        cmocka_unit_test(the_two_rules_agree_at_every_limit),
        cmocka_unit_test(jumps_rise_through_all_layers_and_land_on_the_highest_below),
        cmocka_unit_test(what_rises_past_the_end_of_a_platform_is_not_touched),
        cmocka_unit_test(who_has_sunk_into_a_tile_is_not_caught_by_the_next),
        cmocka_unit_test(the_end_of_a_platform_holds_the_inner_foot_at_every_rate),
        cmocka_unit_test(walking_into_a_low_platform_passes_through_it),
        cmocka_unit_test(nobody_sinks_through_a_platform_by_standing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
