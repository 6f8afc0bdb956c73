/* SPDX-License-Identifier: MIT
 * test_contacts.c: contacts of the native backend: every surface near a shape once, and the way out of it. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "native_world.h"

/* Stands on a floor that has every triangle twice, a hundredth of a metre over it and beside a wall. */
static void expect_floor_and_wall(tahr_shape shape, tahr_vec3 at)
{
    fixture f;
    static native_grid grid;
    tahr_contact contacts[16];
    uint32_t count = 0;
    double side = shape.type == TAHR_SHAPE_BOX ? shape.half_x : shape.radius;
    tahr_body_desc floor = native_grid_body(&grid, 4, 0.25, NULL);
    memcpy(grid.indices + 3 * floor.triangle_count, grid.indices, 3 * floor.triangle_count * sizeof grid.indices[0]);
    floor.triangle_count *= 2;
    tahr_body_desc bodies[2] = {floor, native_box(v_make(at.x + side + 0.01 + 0.5, 0.5, 0), v_make(0.5, 2, 2))};
    native_open(&f, bodies, 2, 0);
    tahr_contact_query q = fixture_contacts(shape, v_make(at.x, at.y, shape.half_height + 0.01), 0.02);
    assert_int_equal(tahr_backend_v1_native()->contacts(f.self, &f.context, &q, contacts, 16, &count), TAHR_OK);
    assert_int_equal(count, 2);
    assert_int_equal(contacts[0].body + contacts[1].body, 1); /* each once */
    for (uint32_t i = 0; i < 2; i++) {
        assert_true(fabs(contacts[i].distance - 0.01) < 1e-12);
        assert_true(contacts[i].body == 0 ? contacts[i].normal.z == 1 : contacts[i].normal.x == -1);
        assert_true(contacts[i].body == 0 ? contacts[i].feature < 32 : contacts[i].feature == 0);
    }
    native_close(&f);
}

static void contacts_report_each_surface_once(void **state)
{
    (void)state;
    for (int kind = 0; kind < NATIVE_KINDS; kind++) {
        tahr_shape shape = native_shape(kind);
        expect_floor_and_wall(shape, v_make(0.5, 0.5, 0)); /* over a corner of the grid */
        expect_floor_and_wall(shape, v_make(0.5, 0.6, 0)); /* an edge */
        expect_floor_and_wall(shape, v_make(0.6, 0.6, 0)); /* a diagonal */
        expect_floor_and_wall(shape, v_make(0.6, 0.7, 0)); /* inside */
    }
}

static void contacts_come_nearest_first_and_say_when_more_existed(void **state)
{
    (void)state;
    fixture f;
    const tahr_body_desc bodies[3] = {native_box(v_make(0, 0, -2), v_make(1, 1, 1)),
                                      native_box(v_make(1.32, 0, 0), v_make(1, 1, 1)),
                                      native_box(v_make(0, -1.31, 0), v_make(1, 1, 1))};
    const uint32_t order[3] = {2, 1, 0};
    tahr_contact contacts[4];
    uint32_t count = 0;
    const tahr_backend *b = tahr_backend_v1_native();
    native_open(&f, bodies, 3, 0);
    /* 0.03 over the first, 0.02 and 0.01 beside the others. */
    tahr_contact_query q = fixture_contacts(fixture_shape(TAHR_SHAPE_CAPSULE, 0.3, 0.9), v_make(0, 0, -0.07), 0.05);
    assert_int_equal(b->contacts(f.self, &f.context, &q, contacts, 4, &count), TAHR_OK);
    assert_int_equal(count, 3);
    for (uint32_t i = 0; i < 3; i++) {
        assert_int_equal(contacts[i].body, order[i]);
        assert_true(fabs(contacts[i].distance - 0.01 * (i + 1)) < 1e-9);
    }
    assert_int_equal(b->contacts(f.self, &f.context, &q, contacts, 1, &count), TAHR_TRUNCATED);
    assert_true(count == 1 && contacts[0].body == 2);
    native_close(&f);
}

static void a_box_pushes_out_what_is_inside(void **state)
{
    (void)state;
    fixture f;
    tahr_body_desc body = native_box(v_make(0, 0, 0), v_make(2, 3, 4));
    native_open(&f, &body, 1, 0);
    for (int kind = 0; kind < NATIVE_KINDS; kind++) {
        tahr_shape shape = native_shape(kind);
        double half = kind == 2 ? 0.25 : 0.3;
        tahr_sweep q = fixture_sweep(shape, v_make(1.5, 0.1, 0.2), v_make(0.1, 0, 0), 0.01);
        tahr_hit h = fixture_hit(&f, &q);
        assert_true(h.start_overlap == 1 && h.normal.x == 1 && fabs(h.depth - 0.5 - half) < 1e-12);
        tahr_contact_query c = fixture_contacts(shape, q.position, 0);
        tahr_contact contact;
        uint32_t count = 0;
        tahr_backend_v1_native()->contacts(f.self, &f.context, &c, &contact, 1, &count);
        assert_true(count == 1 && contact.normal.x == 1 && fabs(contact.distance + 0.5 + half) < 1e-12);
        assert_int_equal(contact.feature, 1);
    }
    native_close(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(contacts_report_each_surface_once),
        cmocka_unit_test(contacts_come_nearest_first_and_say_when_more_existed),
        cmocka_unit_test(a_box_pushes_out_what_is_inside),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
