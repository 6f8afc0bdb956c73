/* SPDX-License-Identifier: MIT
 * test_floor_walks.c: whole characters over hills with every way to look for the floor, together with every way to
 * move: none sinks into the ground or hangs over it, and every step can be taken again. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "native_world.h"
#include "rig.h"

static double hills(double x, double y)
{
    return 0.25 * sin(x * 1.3) * cos(y * 0.9) + 0.1 * sin(3 * x);
}

/* Height of what lies under a place. */
static double ground(const rig *r, tahr_vec3 at)
{
    tahr_ray ray = {{at.x, at.y, 5}, {0, 0, -10}, UINT32_MAX, TAHR_NO_BODY};
    tahr_hit hit;
    uint32_t count = 0;
    assert_int_equal(tahr_world_ray(r->world, &ray, &hit, &count), TAHR_OK);
    assert_int_equal(count, 1);
    return hit.point.z;
}

/* Runs about and jumps on 12 m x 12 m of hills with a box on them, near its middle. Every fiftieth step is taken
 * again. */
static void wander(rig *r, double rate, uint32_t seed)
{
    oracle_random dice = {seed};
    int n = (int)fmin(10 * rate, 800), walked = 0;
    double way = 0;
    for (int i = 0; i < n; i++) {
        if (i % (int)(rate / 5) == 0) {
            double away = hypot(r->state.position.x - 6, r->state.position.y - 6);
            tahr_vec3 back = fake_vec((6 - r->state.position.x) / 3, (6 - r->state.position.y) / 3, 0);
            tahr_vec3 random = dice_direction(&dice);
            r->input.move = away > 2 ? back : fake_vec(random.x, random.y, 0);
            r->input.jump = away < 1.5 && oracle_below(&dice, 8) == 0;
        }
        tahr_state before = r->state, again;
        rig_step(r, 1 / rate);
        again = r->state;
        if (i % 50 == 0) {
            r->state = before;
            rig_step(r, 1 / rate);
            assert_memory_equal(&again, &r->state, sizeof again);
        }
        tahr_vec3 p = r->state.position, v = r->state.velocity;
        assert_true(isfinite(p.x + p.y + p.z + v.x + v.y + v.z));
        double above = p.z - r->state.half_height - ground(r, p);
        if (above < -1e-9) {
            fail_msg("at %g s, %g Hz: %g m under the hills at %g %g %g", r->time, rate, -above, p.x, p.y, p.z);
        }
        walked += r->state.mode == TAHR_MODE_WALKING;
        way += hypot(p.x - before.position.x, p.y - before.position.y);
    }
    assert_true(walked > n / 4);
    assert_true(way > 2);
}

static void every_probe_walks_with_every_way_to_move(void **unused)
{
    static native_grid grid;
    const double rates[] = {10, 60, 240};
    (void)unused;
    for (uint32_t kind = 0; kind < 32; kind++) {
        for (int k = 0; k < 3; k++) {
            tahr_body_desc bodies[2];
            tahr_config c;
            rig r;
            assert_int_equal(tahr_config_init(&c, sizeof c, kind & 1 ? TAHR_PRESET_UNREAL : TAHR_PRESET_PRECISE),
                             TAHR_OK);
            c.floor_probe = TAHR_FLOOR_PROBE_SHRUNK;
            c.max_speed = 4;
            c.flat_base = kind >> 1 & 1;
            c.separation = kind >> 2 & 1 ? TAHR_SEPARATION_MARGIN : TAHR_SEPARATION_PULL_BACK;
            c.slide_solver = kind >> 3 & 1 ? TAHR_SLIDE_JOINT : TAHR_SLIDE_TWO_WALLS;
            c.perch_threshold = kind >> 4 & 1 ? 0.15 : 0;
            bodies[0] = native_grid_body(&grid, NATIVE_CELLS, 0.5, hills);
            bodies[1] = native_box(fake_vec(7, 6, 0), fake_vec(0.5, 0.5, 0.5));
            rig_open_bodies(&r, bodies, 2, &c, fake_vec(5, 6, 1.5));
            wander(&r, rates[k], 5 + kind);
            rig_close(&r);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_probe_walks_with_every_way_to_move)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
