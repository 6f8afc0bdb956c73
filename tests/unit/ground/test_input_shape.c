/* SPDX-License-Identifier: MIT
 * test_input_shape.c: another shape than the config's, asked for by input.radius and input.half_height. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "rig.h"

static const double STANDING = 0.9, SKIN = 0.01;

static double foot(const rig *r)
{
    return r->state.position.z - r->state.half_height;
}

static void another_shape_is_taken_while_it_is_asked_for(void **unused)
{
    (void)unused;
    fake_world w;
    rig r;
    fake_world_flat(&w);
    fake_add_plane(&w, fake_vec(-1, 0, 0), -0.5); /* a wall at x = 0.5 */
    rig_stand(&r, &w, NULL, fake_vec(-2, 0, 1));
    double before = foot(&r);
    r.input.flags = TAHR_INPUT_SHAPE;
    r.input.radius = 0.6;
    r.input.half_height = 1.2;
    rig_step(&r, 1.0 / 60);
    assert_near(r.state.radius, 0.6, 0);
    assert_near(r.state.half_height, 1.2, 0);
    assert_near(foot(&r), before, 1e-15);
    assert_false(r.state.flags & TAHR_STATE_CROUCHED);
    r.input.move = fake_vec(1, 0, 0);
    rig_steps(&r, 90, 1.0 / 60);
    assert_near(r.state.position.x, 0.5 - 0.6 - SKIN, 1e-6); /* stopped as wide as it is */
    r.input.flags = 0;
    rig_step(&r, 1.0 / 60);
    assert_near(r.state.radius, 0.35, 0);
    assert_near(foot(&r), before, 1e-6);
    rig_steps(&r, 60, 1.0 / 60);
    r.input.flags = TAHR_INPUT_SHAPE; /* now the wall is in the way of it */
    rig_step(&r, 1.0 / 60);
    assert_true(r.report.flags & TAHR_REPORT_SHAPE_REFUSED);
    assert_near(r.state.radius, 0.35, 0);
    rig_close(&r);
}

/* On a slope a wider foot has to stand higher: its lower cap touches the slope earlier. */
static void a_wider_foot_stands_higher_on_a_slope(void **unused)
{
    (void)unused;
    fake_world w;
    rig r;
    const double angle = 40 * 3.14159265358979323846 / 180;
    fake_world_init(&w);
    fake_add_slope(&w, 40);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 1.2));
    r.input.flags = TAHR_INPUT_SHAPE;
    r.input.radius = 0.5;
    r.input.half_height = STANDING;
    rig_step(&r, 1.0 / 60);
    assert_near(r.state.radius, 0.5, 0);
    assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
    rig_steps(&r, 10, 1.0 / 60);
    /* The centre of the cap is radius + skin from the plane, and the gap above that at most half a skin along up. */
    double centre = r.state.position.z - (STANDING - 0.5);
    double along = centre * cos(angle) - r.state.position.x * sin(angle);
    assert_true(along > 0.5 + SKIN - 1e-6 && along < 0.5 + SKIN + 0.5 * SKIN);
    assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
    rig_close(&r);
}

static void sizes_that_no_such_shape_has_are_refused(void **unused)
{
    const struct {
        uint32_t type;
        double radius, half_height;
        const char *field; /* NULL: taken */
    } cases[] = {{TAHR_SHAPE_CAPSULE, 0.35, -0.9, "input.half_height"},
                 {TAHR_SHAPE_CAPSULE, 0.35, 0, "input.half_height"},
                 {TAHR_SHAPE_CAPSULE, 0.35, NAN, "input.half_height"},
                 {TAHR_SHAPE_CAPSULE, 0.35, 2e4, "input.half_height"},
                 {TAHR_SHAPE_CAPSULE, -0.1, 0.9, "input.radius"},
                 {TAHR_SHAPE_CAPSULE, 0, 0.9, "input.radius"},
                 {TAHR_SHAPE_CAPSULE, 1, 0.9, "input.radius"},
                 {TAHR_SHAPE_CAPSULE, INFINITY, 0.9, "input.radius"},
                 {TAHR_SHAPE_CAPSULE, 0.5, 0.5, NULL},
                 {TAHR_SHAPE_SPHERE, 0.35, 0.9, "input.radius"},
                 {TAHR_SHAPE_SPHERE, 0.5, 0.5, NULL},
                 {TAHR_SHAPE_BOX, 0.35, 0.9, "input.radius"},
                 {TAHR_SHAPE_BOX, 0, 0.6, NULL}};
    (void)unused;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        fake_world w;
        rig r;
        tahr_config c = rig_config();
        c.shape = (tahr_shape){.type = cases[i].type, .radius = 0.35, .half_height = 0.9};
        if (cases[i].type == TAHR_SHAPE_SPHERE) {
            c.shape.half_height = 0.35;
            c.step_height = 0.3;
        } else if (cases[i].type == TAHR_SHAPE_BOX) {
            c.shape.radius = 0;
            c.shape.half_x = c.shape.half_y = 0.3;
        }
        fake_world_flat(&w);
        rig_open(&r, &w, &c, fake_vec(0, 0, 3));
        r.input.flags = TAHR_INPUT_SHAPE;
        r.input.radius = cases[i].radius;
        r.input.half_height = cases[i].half_height;
        tahr_state before = r.state;
        tahr_status status = tahr_mover_step(r.mover, &r.input, 0.01, &r.state, NULL);
        assert_int_equal(status, cases[i].field ? TAHR_E_ARGUMENT : TAHR_OK);
        if (cases[i].field) {
            assert_non_null(strstr(r.log.text, cases[i].field));
            assert_memory_equal(&before, &r.state, sizeof before);
        } else {
            assert_near(r.state.half_height, cases[i].half_height, 0);
        }
        rig_close(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(another_shape_is_taken_while_it_is_asked_for),
                                       cmocka_unit_test(a_wider_foot_stands_higher_on_a_slope),
                                       cmocka_unit_test(sizes_that_no_such_shape_has_are_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
