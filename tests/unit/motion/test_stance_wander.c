/* SPDX-License-Identifier: MIT
 * test_stance_wander.c: random shapes asked for by a character that wanders, jumps and is launched among boxes and low
 * ceilings: it never overlaps anything, its state stays finite, and every step can be taken again. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "native_world.h"
#include "rig.h"

/* A room of 12 m x 12 m, 4 m high, with blocks to step and climb on, and slabs to crawl under. */
static void furnish(fake_world *w)
{
    fake_world_flat(w);
    fake_add_plane(w, fake_vec(0, 0, -1), -4);
    fake_add_plane(w, fake_vec(1, 0, 0), -6);
    fake_add_plane(w, fake_vec(-1, 0, 0), -6);
    fake_add_plane(w, fake_vec(0, 1, 0), -6);
    fake_add_plane(w, fake_vec(0, -1, 0), -6);
    fake_add_box(w, fake_vec(-5, -5, 1.3), fake_vec(-2, -2, 2));
    fake_add_box(w, fake_vec(2, -5, 1.0), fake_vec(5, -2, 1.2));
    fake_add_box(w, fake_vec(2, 2, 0), fake_vec(4, 4, 0.3));
    fake_add_box(w, fake_vec(3, 3, 0.3), fake_vec(4, 4, 0.6));
    fake_add_box(w, fake_vec(-4, 2, 0), fake_vec(-3, 4, 2));
    fake_add_box(w, fake_vec(-2.2, 2, 0), fake_vec(-1.2, 4, 2));
    fake_add_box(w, fake_vec(-3, 2, 1.9), fake_vec(-2.2, 4, 2.5));
}

static void choose(oracle_random *dice, rig *r)
{
    if (oracle_below(dice, 10) == 0) {
        double angle = oracle_uniform(dice, 0, 6.283185307179586);
        r->input.move = fake_vec(cos(angle), sin(angle), 0);
    }
    if (oracle_below(dice, 5) == 0) {
        r->input.crouch = oracle_below(dice, 2);
        r->input.flags = oracle_below(dice, 3) == 0 ? TAHR_INPUT_SHAPE : 0;
        r->input.radius = oracle_uniform(dice, 0.1, 0.7);
        r->input.half_height = r->input.radius + oracle_uniform(dice, 0, 1);
    }
    r->input.jump = oracle_below(dice, 8) == 0;
    r->input.flags &= ~(uint32_t)TAHR_INPUT_LAUNCH;
    if (oracle_below(dice, 60) == 0) {
        r->input.flags |= TAHR_INPUT_LAUNCH;
        r->input.launch = dice_vec(dice, -6, 6);
    }
}

static double clearance(const rig *r, const fake_world *w)
{
    tahr_shape shape = r->config.shape;
    shape.radius = r->state.radius;
    shape.half_height = r->state.half_height;
    return fake_clearance(w, &shape, r->state.position);
}

static void random_shapes_never_overlap_and_repeat_their_bits(void **unused)
{
    const double rates[] = {10, 60, 1000};
    (void)unused;
    for (uint32_t seed = 0; seed < 6; seed++) {
        fake_world w;
        rig r;
        tahr_mover *other;
        oracle_random dice = {seed + 11};
        double dt = 1 / rates[seed % 3];
        uint32_t refused = 0, taken = 0;
        furnish(&w);
        rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
        assert_int_equal(tahr_mover_create(r.world, &r.config, &other), TAHR_OK);
        for (int i = 0; i < 4000; i++) {
            choose(&dice, &r);
            tahr_state again = r.state;
            rig_step(&r, dt);
            if (!(clearance(&r, &w) > -1e-9)) {
                fail_msg("seed %u, step %d: overlaps by %g m", seed, i, -clearance(&r, &w));
            }
            assert_int_equal(r.report.flags & (TAHR_REPORT_CRUSHED | TAHR_REPORT_STUCK), 0);
            assert_true(fabs(r.state.position.x) < 6 && fabs(r.state.position.y) < 6 && r.state.position.z < 4);
            refused += (r.report.flags & TAHR_REPORT_SHAPE_REFUSED) != 0;
            taken += rig_event(&r, TAHR_EVENT_SHAPE) != NULL;
            assert_true(tahr_mover_step(other, &r.input, dt, &again, NULL) >= 0);
            assert_memory_equal(&again, &r.state, sizeof again);
        }
        assert_true(refused > 20 && taken > 100);
        tahr_mover_destroy(other);
        rig_close(&r);
    }
}

/* What a change of the shape asks lies in the box that was announced: nothing is gathered twice. */
static void growing_stays_inside_of_what_was_announced(void **unused)
{
    (void)unused;
    for (int air = 0; air < 2; air++) {
        static native_grid grid;
        tahr_body_desc floor = native_grid_body(&grid, 2, 20, NULL); /* 8 triangles: all gathered */
        rig r;
        rig_open_bodies(&r, &floor, 1, NULL, fake_vec(10, 10, 0.95));
        rig_settle(&r);
        r.state.mode = air ? TAHR_MODE_FALLING : r.state.mode;
        r.input.flags = TAHR_INPUT_SHAPE;
        r.input.radius = 2.5;
        r.input.half_height = 4;
        rig_step(&r, 1.0 / 60);
        assert_near(r.state.half_height, 4, 0);
        assert_true(r.report.contact_queries > 0);
        assert_int_equal(r.report.escapes, 0);
        rig_close(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(random_shapes_never_overlap_and_repeat_their_bits),
                                       cmocka_unit_test(growing_stays_inside_of_what_was_announced)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
