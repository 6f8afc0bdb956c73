/* SPDX-License-Identifier: MIT
 * test_box2d_seams.c: full speed over a thousand seams: tiles, one chain, separate chains; slopes joined to flats. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "box2d_rig.h"

#ifndef TAHR_HAVE_BOX2D
int main(void)
{
    puts("SKIP: unit_engines_box2d_seams: built without Box2D");
    return 77;
}
#else
#include "near.h"

enum { TILES = 1012, SEAMS = 1000 };
static const double WIDTH = 0.3, RATES[] = {30, 60, 144};
static uint32_t engines[2];
static int engine_count;
static tahr_body_desc tiles[TILES + 1];
static double corners[TILES + 1][3];

enum { BOXES, ONE_CHAIN, CHAINS, LAYOUTS };

/* Tops of tiles off by as much as a float at 100 m: steps that are none. */
static double uneven;
/* Rise of the floor along x, of chains. */
static double slope;

static double noise(int i)
{
    return uneven * ((i * 7919) % 13 - 6) / 6.0;
}

/* From x = -0.3 to 303.3, its top at y = 0. */
static uint32_t lay(int layout)
{
    for (int i = 0; i <= TILES; i++) {
        corners[i][0] = (TILES - 1 - i) * WIDTH; /* from right to left: its front is up */
        corners[i][1] = slope * corners[i][0] + noise(i);
        corners[i][2] = 0;
    }
    if (layout == ONE_CHAIN) {
        tiles[0] = box2d_chain(corners[0], TILES + 1);
        return 1;
    }
    for (int i = 0; i < TILES; i++) {
        tiles[i] =
            layout == BOXES ? box2d_box((i - 0.5) * WIDTH, noise(i) - 0.5, WIDTH / 2, 0.5) : box2d_chain(corners[i], 2);
    }
    return TILES;
}

static tahr_config config_of(uint32_t shape)
{
    tahr_config c = box2d_config();
    c.shape.type = shape;
    c.shape.half_height = shape == TAHR_SHAPE_SPHERE ? c.shape.radius : 0.9;
    c.floor_target = c.floor_max = 1;
    c.shape.half_x = c.shape.half_y = shape == TAHR_SHAPE_BOX ? 0.35 : 0;
    c.shape.radius = shape == TAHR_SHAPE_BOX ? 0 : c.shape.radius;
    return c;
}

/* The commanded distance is that of a floor of one piece: speed^2 / (2 acceleration) is lost in the beginning. */
static void run_over(uint32_t engine, int layout, uint32_t shape, double rate)
{
    box2d_rig r;
    tahr_config c = config_of(shape);
    double start = 0.4, seconds = 302 / c.max_speed, lost = c.max_speed * c.max_speed / (2 * c.acceleration);
    box2d_rig_open(&r, engine, tiles, lay(layout), &c, start, c.shape.half_height + 0.02);
    box2d_rig_steps(&r, (int)rate, 1 / rate); /* lands */
    assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
    r.hits = 0;
    r.input.move = (tahr_vec3){1, 0, 0};
    box2d_rig_steps(&r, (int)(seconds * rate), 1 / rate);
    double way = (int)(seconds * rate) / rate * c.max_speed;
    if (r.hits > 0 || r.state.position.x - start < 0.999 * (way - lost)) {
        fail_msg("engine %u, layout %d, shape %u, %g Hz: %u hits, %.6f of %.6f m", engine, layout, shape, rate, r.hits,
                 r.state.position.x - start, way - lost);
    }
    assert_true(r.state.position.x - start > SEAMS * WIDTH);
    assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
    assert_near(r.state.position.y - c.shape.half_height, 1.25 * c.skin, 0.25 * c.skin + 1e-9);
    box2d_rig_close(&r);
}

static void run_shape(uint32_t shape)
{
    for (int e = 0; e < engine_count; e++) {
        for (int layout = 0; layout < LAYOUTS; layout++) {
            for (int i = 0; i < 3; i++) {
                run_over(engines[e], layout, shape, RATES[i]);
            }
        }
    }
}

static void a_capsule_runs_over_a_thousand_seams_as_over_none(void **unused)
{
    (void)unused;
    run_shape(TAHR_SHAPE_CAPSULE);
}

static void a_circle_runs_over_a_thousand_seams_as_over_none(void **unused)
{
    (void)unused;
    run_shape(TAHR_SHAPE_SPHERE);
}

static void a_box_runs_over_a_thousand_seams_as_over_none(void **unused)
{
    (void)unused;
    run_shape(TAHR_SHAPE_BOX);
}

/* Every gap on either side of the margin, with the way ahead free of all but seams. */
static void no_seam_stops_a_sweep_along_it(void **unused)
{
    const double gaps[] = {1e-6, 1e-4, 1e-3, 0.005, 0.01 - 1e-7, 0.01, 0.01 + 1e-7, 0.02, 0.1}, margins[] = {0, 0.01};
    const uint32_t shapes[] = {TAHR_SHAPE_SPHERE, TAHR_SHAPE_CAPSULE, TAHR_SHAPE_BOX};
    (void)unused;
    for (int k = 0; k < engine_count * LAYOUTS * 3; k++) {
        fake_log log = {0};
        tahr_config c = config_of(shapes[k % 3]);
        tahr_world *world = box2d_open(engines[k / 3 / LAYOUTS], tiles, lay(k / 3 % LAYOUTS), &log);
        for (int i = 0; i < 9 * 2; i++) {
            tahr_hit hit[2];
            uint32_t count = 9;
            tahr_sweep q = {.shape = c.shape,
                            .position = {1.07, c.shape.half_height + gaps[i / 2], 0},
                            .up = {0, 1, 0},
                            .orientation = {-0.70710678118654757, 0, 0, 0.70710678118654757},
                            .motion = {25, 0, 0},
                            .margin = margins[i % 2],
                            .mask = 0xFFFFFFFFu,
                            .ignore_body = TAHR_NO_BODY};
            assert_int_equal(tahr_world_sweep(world, &q, hit, 2, &count), TAHR_OK);
            if (count != 0) {
                fail_msg("case %d: gap %g, margin %g: stopped at %g, normal %g %g", k, gaps[i / 2], margins[i % 2],
                         hit[0].fraction * 25, hit[0].normal.x, hit[0].normal.y);
            }
        }
        tahr_world_close(world);
    }
}

typedef struct obstacle {
    double slope, gap; /* tangent; 0: a wall */
    double at;         /* x of the centre where it is met */
} obstacle;

/* A hull from x = 6 to 10 with its left corner on the floor, or a block. */
static tahr_body_desc body_of(const obstacle *o, double (*ramp)[3])
{
    tahr_body_desc b = box2d_box(8, 0.5, 2, 0.5);
    if (o->slope > 0) {
        const double from[4][3] = {{6, 0, 0}, {10, 4 * o->slope, 0}, {10, 0, 0}, {6, 0, 1}};
        memcpy(ramp, from, sizeof from);
        assert_int_equal(tahr_body_desc_init(&b, sizeof b, TAHR_BODY_HULL), TAHR_OK);
        b.vertices = ramp[0];
        b.vertex_count = 4;
    }
    return b;
}

/* A wall behind the seams, and a slope of angle a that begins at one, are met where they are: a steep one at its
 * margin, where its foot is s = (r + m - (r + g) cos a) / sin a before the centre; a gentle one, which the centre's
 * foot on it reaches when it is within the margin already, at s = (r + g) tan a, though its corner was at the margin
 * before. */
static void what_lies_behind_a_seam_is_met(void **unused)
{
    const double r = 0.35, margin = 0.01, steep = atan(0.5), near_margin = 0.01 - 1e-7;
    const obstacle all[] = {
        {0, near_margin, 6 - r - margin},
        {0.5, near_margin, 6 - (r + margin - (r + near_margin) * cos(steep)) / sin(steep)},
        {0.1, 0.005, 6 - (r + 0.005) * 0.1},
    };
    (void)unused;
    for (int k = 0; k < engine_count * LAYOUTS * 3; k++) {
        const obstacle *o = &all[k % 3];
        fake_log log = {0};
        uint32_t count = lay(k / 3 % LAYOUTS), found = 0;
        double ramp[4][3];
        tahr_hit hit;
        tahr_config c = config_of(TAHR_SHAPE_CAPSULE);
        tiles[count] = body_of(o, ramp);
        tahr_world *world = box2d_open(engines[k / 3 / LAYOUTS], tiles, count + 1, &log);
        tahr_sweep q = {.shape = c.shape,
                        .position = {1.07, 0.9 + o->gap, 0},
                        .up = {0, 1, 0},
                        .orientation = {0, 0, 0, 1},
                        .motion = {8, 0, 0},
                        .margin = margin,
                        .mask = 0xFFFFFFFFu,
                        .ignore_body = TAHR_NO_BODY};
        assert_int_equal(tahr_world_sweep(world, &q, &hit, 1, &found), TAHR_OK);
        assert_int_equal(found, 1);
        assert_int_equal(hit.body, count);
        assert_near(q.position.x + 8 * hit.fraction, o->at, 1e-8);
        assert_near(hit.normal.x, o->slope > 0 ? -sin(atan(o->slope)) : -1, 1e-9);
        tahr_world_close(world);
    }
}

/* Steps of a few micrometres between tiles are rounding, not walls; with the floor held at exactly one skin every
 * second one of them reaches into it. */
static void steps_of_rounding_are_no_walls(void **unused)
{
    const uint32_t shapes[] = {TAHR_SHAPE_CAPSULE, TAHR_SHAPE_SPHERE, TAHR_SHAPE_BOX};
    (void)unused;
    uneven = 5e-6;
    for (int k = 0; k < engine_count * LAYOUTS * 3; k++) {
        run_over(engines[k / 3 / LAYOUTS], k / 3 % LAYOUTS, shapes[k % 3], 60);
    }
    uneven = 0;
}

/* Up and down a slope of 20 degrees: level speed max_speed cos 20, for max_speed is meant along the floor. */
static void chains_lead_up_and_down_slopes(void **unused)
{
    (void)unused;
    for (int k = 0; k < engine_count * 2 * 2; k++) {
        box2d_rig r;
        int layout = k / 2 % 2 ? CHAINS : ONE_CHAIN, down = k % 2;
        tahr_config c = config_of(TAHR_SHAPE_CAPSULE);
        double start = down ? 290 : 1;
        slope = 0.36397023426620234;
        box2d_rig_open(&r, engines[k / 4], tiles, lay(layout), &c, start, start * slope + 0.95);
        slope = 0;
        box2d_rig_steps(&r, 60, 1.0 / 60);
        start = r.state.position.x;
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        r.hits = 0;
        r.input.move = (tahr_vec3){down ? -1 : 1, 0, 0};
        box2d_rig_steps(&r, 40 * 60, 1.0 / 60);
        assert_int_equal(r.hits, 0);
        double lost = c.max_speed * c.max_speed / (2 * c.acceleration),
               cosine = 1 / sqrt(1 + 0.36397023426620234 * 0.36397023426620234);
        assert_true(fabs(r.state.position.x - start) >= 0.999 * (40 * c.max_speed - lost) * cosine);
        box2d_rig_close(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_capsule_runs_over_a_thousand_seams_as_over_none),
        cmocka_unit_test(a_circle_runs_over_a_thousand_seams_as_over_none),
        cmocka_unit_test(a_box_runs_over_a_thousand_seams_as_over_none),
        cmocka_unit_test(no_seam_stops_a_sweep_along_it),
        cmocka_unit_test(what_lies_behind_a_seam_is_met),
        cmocka_unit_test(steps_of_rounding_are_no_walls),
        cmocka_unit_test(chains_lead_up_and_down_slopes),
    };
    engine_count = box2d_engines(engines);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
#endif
