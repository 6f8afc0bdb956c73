/* SPDX-License-Identifier: MIT
 * test_unreal.c: one-way bodies for the rules of UNREAL: sweeps without a margin, a floor probe that begins above
 * the foot, flat feet that land on slopes and edges. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "layers.h"

static const double RADIAN = 0.017453292519943295;

/* m: centre of a sphere of radius r over x, resting on a roof of two slopes that meet at the origin. */
static double roof_rest(double x, double r, double angle)
{
    double off = fabs(x);
    return off <= r * sin(angle) ? sqrt(r * r - x * x) : r / cos(angle) - off * tan(angle);
}

/* Straight down: m of 2 * down at which a sphere is stopped, < 0 if nothing stops it. */
static double stop(const layers *l, rig *r, double radius, tahr_vec3 from, double down)
{
    tahr_hit hit;
    uint32_t count = 0;
    tahr_sweep q = {.shape = {.type = TAHR_SHAPE_SPHERE, .radius = radius, .half_height = radius},
                    .position = from,
                    .up = layers_at(l, 0, 1),
                    .orientation = r->state.orientation,
                    .motion = layers_at(l, 0, -2 * down),
                    .mask = 0xFFFFFFFFu,
                    .ignore_body = TAHR_NO_BODY};
    assert_int_equal(tahr_world_sweep(r->world, &q, &hit, 1, &count), TAHR_OK);
    return count ? hit.fraction * 2 * down : -1;
}

/* The crest belongs to two bodies, and rounding decides by how much less than nothing a sweep without a margin ends
 * from it. */
static void a_crest_stops_what_comes_down_without_a_margin(void **unused)
{
    (void)unused;
    for (int world = 0; world < LAYERS_WORLDS; world++) {
        oracle_random dice = {3};
        for (int trial = 0; trial < (world < 2 ? 40 : 4); trial++) {
            static layers l;
            rig r;
            double angle = oracle_uniform(&dice, 0.05, 0.95), far = oracle_uniform(&dice, -1000, 1000);
            double low = -10 * sin(angle), out = 10 * cos(angle);
            if (!layers_begin(&l, world)) {
                break;
            }
            layers_slope(&l, (tahr_vec3){far - out, low, 0}, (tahr_vec3){far, 0, 0}, TAHR_BODY_ONE_WAY);
            layers_slope(&l, (tahr_vec3){far, 0, 0}, (tahr_vec3){far + out, low, 0}, TAHR_BODY_ONE_WAY);
            layers_open(&l, &r, NULL, far, 5);
            for (int i = 0; i < 100; i++) {
                double radius = oracle_uniform(&dice, 0.1, 0.6), x = oracle_uniform(&dice, -1, 1);
                double down = oracle_uniform(&dice, 0.01, 0.5), rest = roof_rest(x, radius, angle);
                assert_near(stop(&l, &r, radius, layers_at(&l, far + x, rest + down), down), down, 4e-6);
            }
            rig_close(&r);
        }
    }
}

/* Put where it touches, but for the rounding of a sum, it stands: half of such sums lie below the top. */
static void who_is_put_exactly_onto_a_platform_is_above_it(void **unused)
{
    (void)unused;
    for (int world = 0; world < LAYERS_WORLDS; world++) {
        oracle_random dice = {5};
        for (int trial = 0; trial < (world < 2 ? 100 : 10); trial++) {
            static layers l;
            rig r;
            double top = oracle_uniform(&dice, -1000, 1000), radius = oracle_uniform(&dice, 0.1, 0.6);
            if (!layers_begin(&l, world)) {
                break;
            }
            layers_add(&l, (int)oracle_below(&dice, LAYER_KINDS), -4, 4, top, TAHR_BODY_ONE_WAY);
            tahr_config c = layers_config(&l, TAHR_PRESET_UNREAL);
            layers_open(&l, &r, &c, 0.3, top);
            assert_true(stop(&l, &r, radius, layers_at(&l, 0.3, top + radius), 1) >= 0);
            rig_steps(&r, 60, 1.0 / 60);
            assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
            assert_near(layers_foot(&l, &r), top + 0.0215, 0.0026); /* between 1.9 and 2.4 cm */
            rig_close(&r);
        }
    }
}

/* Two flats, a slope up and one down. */
typedef struct hill {
    double run, rise, slope;
} hill;

static double hill_height(const hill *h, double x)
{
    double beyond = x < h->run + 1 ? x : 2 * h->run + 2 - x; /* it is its own mirror image */
    return beyond <= 0 ? 0 : beyond >= h->run ? h->rise : beyond * h->slope;
}

static void add_hill(layers *l, const hill *h, uint32_t flags)
{
    double end = 2 * h->run + 2;
    layers_add(l, LAYER_TILES, -6, 0, 0, flags);
    layers_slope(l, (tahr_vec3){0, 0, 0}, (tahr_vec3){h->run, h->rise, 0}, flags);
    layers_add(l, LAYER_SHEET, h->run, h->run + 2, h->rise, flags);
    layers_slope(l, (tahr_vec3){h->run + 2, h->rise, 0}, (tahr_vec3){end, 0, 0}, flags);
    layers_add(l, LAYER_TILES, end, end + 6, 0, flags);
}

static void walk_over_hill(const layers *l, const hill *h, rig *r, double direction, double dt)
{
    double end = h->run + 1 + direction * (h->run + 3), time = 0, x = layers_x(l, r->state.position);
    rig_steps(r, 60, 1.0 / 60);
    assert_int_equal(r->state.mode, TAHR_MODE_WALKING);
    r->input.move = layers_at(l, direction, 0);
    for (; (x - end) * direction < 0; time += dt) {
        assert_true(time < 5); /* 13 m at 6 m/s, and room for crests that throw it */
        rig_step(r, dt);
        x = layers_x(l, r->state.position);
        assert_true(layers_foot(l, r) > hill_height(h, x) - 1e-5);
    }
}

static void hills_are_walked_over_one_way_or_solid(void **unused)
{
    (void)unused;
    static const double ANGLES[] = {15, 22.5, 30, 37.5};
    for (int world = 0; world < LAYERS_WORLDS; world++) {
        oracle_random dice = {11};
        for (int k = 0; k < 32; k++) {
            for (int i = world < 2 ? 0 : k % 5; i < RIG_RATES; i += world < 2 ? 1 : 5) {
                static layers l;
                rig r;
                double angle = ANGLES[k / 8] * RADIAN, direction = k & 1 ? -1 : 1;
                hill h = {3 * cos(angle), 3 * sin(angle), tan(angle)};
                if (!layers_begin(&l, world)) {
                    break;
                }
                add_hill(&l, &h, k & 2 ? TAHR_BODY_ONE_WAY : 0);
                tahr_config c = layers_config(&l, TAHR_PRESET_UNREAL);
                if (k & 4) {
                    c.shape = (tahr_shape){.type = TAHR_SHAPE_BOX, .half_height = 0.9, .half_x = 0.3, .half_y = 0.3};
                }
                double begin = h.run + 1 - direction * (h.run + 3 + oracle_uniform(&dice, 0, 1));
                layers_open(&l, &r, &c, begin, 0.1);
                walk_over_hill(&l, &h, &r, direction, 1 / rig_rates[i]);
                rig_close(&r);
            }
        }
    }
}

/* The upper side of its foot touches the slope: half the width times the slope above the axis' ground. */
static void flat_feet_land_on_a_slope_and_stay(void **unused)
{
    (void)unused;
    static const double ANGLES[] = {1, 10, 22.5, 40};
    static const tahr_shape FEET[] = {
        {.type = TAHR_SHAPE_BOX, .half_height = 0.9, .half_x = 0.3, .half_y = 0.25},
        {.type = TAHR_SHAPE_CYLINDER, .half_height = 0.9, .radius = 0.3},
        {.type = TAHR_SHAPE_CONE, .half_height = 0.9, .radius = 0.3},
    };
    static const uint32_t NEEDED[] = {TAHR_CAP_BOX, TAHR_CAP_CYLINDER, TAHR_CAP_CONE};
    for (int world = 0; world < LAYERS_WORLDS; world++) {
        for (int k = 0; k < 24; k++) {
            static layers l;
            rig r;
            double angle = ANGLES[k / 2 % 4] * RADIAN, up = 5 * tan(angle);
            if (!layers_begin(&l, world)) {
                break;
            }
            if (!(l.backend->capabilities & NEEDED[k / 8])) {
                continue;
            }
            layers_slope(&l, (tahr_vec3){-5, -up, 0}, (tahr_vec3){5, up, 0}, k & 1 ? TAHR_BODY_ONE_WAY : 0);
            tahr_config c = layers_config(&l, TAHR_PRESET_UNREAL);
            c.shape = FEET[k / 8];
            layers_open(&l, &r, &c, 0, 1);
            rig_steps(&r, 60, 1.0 / 60);
            assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
            assert_near(layers_x(&l, r.state.position), 0, 1e-6);
            /* and the band of 1.9 to 2.4 cm; the probe is 0.15 cm thinner */
            assert_near(layers_foot(&l, &r) - 0.3 * tan(angle), 0.0215, 0.0027 + 0.0015 * tan(angle));
            rig_close(&r);
        }
    }
}

/* Which point of a flat contact a backend names is its affair: it may be the rim, and nothing lets a level foot slide
 * off a level top. */
static void a_box_stands_on_an_edge_with_whatever_part_of_it(void **unused)
{
    (void)unused;
    static const double OVER[] = {1e-4, 1e-3, 2e-3, 0.02, 0.1, 0.3};
    for (int world = 0; world < LAYERS_WORLDS; world++) {
        for (int k = 0; k < 6; k++) {
            static layers l;
            rig r;
            if (!layers_begin(&l, world)) {
                break;
            }
            layers_add(&l, LAYER_BOX, -4, OVER[k] - 0.3, 1, 0);
            layers_add(&l, LAYER_BOX, -4, 4, -1, 0);
            tahr_config c = layers_config(&l, TAHR_PRESET_UNREAL);
            c.shape = (tahr_shape){.type = TAHR_SHAPE_BOX, .half_height = 0.9, .half_x = 0.3, .half_y = 0.25};
            layers_open(&l, &r, &c, 0, 1.5);
            rig_steps(&r, 60, 1.0 / 60);
            assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
            assert_near(layers_foot(&l, &r), 1.0215, 0.0026);
            rig_close(&r);
        }
    }
}

/* The edge of a slope, met flat: its own face slopes, and which point of it is named may be the end of the foot. */
static void a_box_stands_on_the_crest_of_a_slope(void **unused)
{
    (void)unused;
    for (int world = 0; world < LAYERS_WORLDS; world++) {
        for (int k = 0; k < 12; k++) {
            static layers l;
            rig r;
            double x = -0.25 + 0.1 * (k / 2);
            if (!layers_begin(&l, world)) {
                break;
            }
            if (k & 1) {
                layers_add(&l, LAYER_BOX, 0, 4, 0, 0);
            }
            layers_slope(&l, (tahr_vec3){-2, -1, 0}, (tahr_vec3){0, 0, 0}, 0);
            if (!(k & 1)) {
                layers_add(&l, LAYER_BOX, 0, 4, 0, 0);
            }
            tahr_config c = layers_config(&l, TAHR_PRESET_UNREAL);
            c.shape = (tahr_shape){.type = TAHR_SHAPE_BOX, .half_height = 0.9, .half_x = 0.3, .half_y = 0.25};
            layers_open(&l, &r, &c, x, 0.1);
            rig_steps(&r, 60, 1.0 / 60);
            assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
            assert_near(layers_x(&l, r.state.position), x, 1e-6);
            assert_near(layers_foot(&l, &r), 0.0215, 0.0026);
            rig_close(&r);
        }
    }
}

/* The probe begins above the foot, where the straight part of a capsule is 1.08 m long by 5.4 cm, where it touches at
 * the rim by half a metre; a ray begins at the axis. The ends of low platforms are a floor for the round of a foot, up
 * to where it leans by 60 degrees (17 cm): there it begins inside. */
static void what_is_above_the_foot_is_no_floor(void **unused)
{
    (void)unused;
    static const double TOPS[] = {0.03, 0.05, 0.07, 0.25, 0.5, 0.8};
    for (int world = 0; world < LAYERS_WORLDS; world++) {
        for (int k = 0; k < 24; k++) {
            for (int i = world < 2 ? 0 : k % 5; i < RIG_RATES; i += world < 2 ? 1 : 5) {
                static layers l;
                rig r;
                if (!layers_begin(&l, world)) {
                    break;
                }
                layers_add(&l, LAYER_BOX, -20, 20, 0, 0);
                layers_add(&l, k / 6, 0, 4, TOPS[k % 6], TAHR_BODY_ONE_WAY);
                tahr_config c = layers_config(&l, TAHR_PRESET_UNREAL);
                layers_open(&l, &r, &c, k % 6 < 3 ? 1 : -2, 0.0215);
                rig_settle(&r);
                double foot = layers_foot(&l, &r);
                assert_near(foot, 0.0215, 0.0026); /* of the ground */
                r.input.move = layers_at(&l, 1, 0);
                for (int n = 0; n < rig_rates[i] * (k % 6 < 3 ? 0.4 : 1.2); n++) {
                    rig_step(&r, 1 / rig_rates[i]);
                    assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
                    assert_near(layers_foot(&l, &r), foot, 1e-6);
                }
                assert_true(layers_x(&l, r.state.position) > 2);
                rig_close(&r);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_crest_stops_what_comes_down_without_a_margin),
        cmocka_unit_test(who_is_put_exactly_onto_a_platform_is_above_it),
        cmocka_unit_test(hills_are_walked_over_one_way_or_solid),
        cmocka_unit_test(flat_feet_land_on_a_slope_and_stay),
        cmocka_unit_test(a_box_stands_on_an_edge_with_whatever_part_of_it),
        cmocka_unit_test(a_box_stands_on_the_crest_of_a_slope),
        cmocka_unit_test(what_is_above_the_foot_is_no_floor),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
