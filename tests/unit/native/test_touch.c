/* SPDX-License-Identifier: MIT
 * test_touch.c: where a capsule's side touches something upright along a line, the point that is told is the one
 * nearest to its middle. By hand: the wall's own corners say where that is. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "native_world.h"

/* A capsule of radius 0.3 and half height 0.9, its middle at height 1: its straight side from 0.4 to 1.6. */
static const double MIDDLE = 1, RADIUS = 0.3, HALF = 0.9, MARGIN = 0.01;

/* Rounding of a mesh's corners and of what comes of them. */
static const double ROUNDING = 1e-12;

/* The hit of a walk along +x, from x = 0, into a triangle. */
static tahr_hit meet(const tahr_vec3 corner[3], double y)
{
    const uint32_t indices[3] = {0, 1, 2};
    double vertices[9];
    fixture f;
    for (int i = 0; i < 3; i++) {
        vertices[3 * i] = corner[i].x;
        vertices[3 * i + 1] = corner[i].y;
        vertices[3 * i + 2] = corner[i].z;
    }
    tahr_body_desc body = fixture_mesh(vertices, 3, indices, 1);
    body.flags = TAHR_BODY_TWO_SIDED;
    native_open(&f, &body, 1, 0);
    const tahr_sweep sweep =
        fixture_sweep(fixture_shape(TAHR_SHAPE_CAPSULE, RADIUS, HALF), v_make(0, y, MIDDLE), v_make(2, 0, 0), MARGIN);
    const tahr_hit hit = fixture_hit(&f, &sweep);
    native_close(&f);
    assert_int_equal(hit.blocking, 1);
    return hit;
}

static void expect_point(const tahr_hit *hit, double x, double y, double z)
{
    assert_true(fabs(hit->point.x - x) <= ROUNDING);
    assert_true(fabs(hit->point.y - y) <= ROUNDING);
    assert_true(fabs(hit->point.z - z) <= ROUNDING);
}

/* A triangle in the plane x = 1, as wide as it is needed, from `low` to `high` at y = 0. */
static tahr_hit meet_wall(double low, double high)
{
    const tahr_vec3 corner[3] = {{1, -4, low}, {1, 4, low}, {1, 0, high}};
    return meet(corner, 0);
}

static void a_tall_wall_is_touched_at_the_middle(void **state)
{
    (void)state;
    const tahr_hit hit = meet_wall(-3, 9);
    expect_point(&hit, 1, 0, MIDDLE);
    assert_true(fabs(hit.fraction - (1 - RADIUS - MARGIN) / 2) <= 1e-9);
    assert_true(hit.normal.x == -1 && hit.normal.y == 0 && hit.normal.z == 0);
}

static void a_wall_that_ends_below_or_above_is_touched_at_its_end(void **state)
{
    (void)state;
    tahr_hit hit = meet_wall(-3, 0.75);
    expect_point(&hit, 1, 0, 0.75);
    hit = meet_wall(1.25, 9);
    expect_point(&hit, 1, 0, 1.25);
}

/* z <= 0.6 + y / 2 there: at y = 0.4 the wall ends at 0.8. */
static void the_end_of_a_wall_may_be_aslant(void **state)
{
    (void)state;
    const tahr_vec3 corner[3] = {{1, -4, -1.4}, {1, 4, -1.4}, {1, 4, 2.6}};
    const tahr_hit hit = meet(corner, 0.4);
    expect_point(&hit, 1, 0.4, 0.8);
}

/* The triangle lies behind x = 1, and its upright side there is met from 0.3 beside it. */
static void an_upright_edge_is_touched_as_a_wall_is(void **state)
{
    static const double ends[][3] = {{-2, 5, 1}, {-2, 0.7, 0.7}, {1.5, 5, 1.5}};
    (void)state;
    for (int i = 0; i < 3; i++) {
        const tahr_vec3 corner[3] = {{1, 0, ends[i][0]}, {1, 0, ends[i][1]}, {3, 0, 1}};
        const tahr_hit hit = meet(corner, 0.1);
        expect_point(&hit, 1, 0, ends[i][2]);
    }
}

/* x = 1 + lean (z - 1): leaning away from the capsule it is touched at the upper end of the side if it leans over, at
 * the lower one if it leans back; by the rounding of single precision, at the middle still, and there on the face. */
static void a_wall_that_leans_is_touched_at_an_end(void **state)
{
    static const double leans[] = {1e-3, -1e-3, 4e-6, -4e-6};
    (void)state;
    for (int i = 0; i < 4; i++) {
        const double lean = leans[i];
        const tahr_vec3 corner[3] = {{1 - 4 * lean, -9, -3}, {1 - 4 * lean, 9, -3}, {1 + 9 * lean, 0, 10}};
        const tahr_hit hit = meet(corner, 0);
        const double end = fabs(lean) < 1e-5 ? MIDDLE : lean > 0 ? 0.4 : 1.6;
        /* The cap turns the contact by the angle of the lean. */
        assert_true(fabs(hit.point.z - end) <= 1.01 * fabs(lean) * (fabs(lean) < 1e-5 ? 0.6 * 1e-5 : RADIUS + MARGIN));
        assert_true(fabs(hit.point.x - (1 + lean * (hit.point.z - 1))) <= 1e-10);
    }
}

/* Beside a wall that is touched a contact is told so too. */
static void contacts_are_told_at_the_middle_too(void **state)
{
    static const double vertices[] = {1, -4, -3, 1, 4, -3, 1, 0, 9};
    static const uint32_t indices[] = {0, 1, 2};
    tahr_contact contacts[4];
    uint32_t count = 0;
    fixture f;
    (void)state;
    tahr_body_desc body = fixture_mesh(vertices, 3, indices, 1);
    body.flags = TAHR_BODY_TWO_SIDED;
    native_open(&f, &body, 1, 0);
    const tahr_contact_query query =
        fixture_contacts(fixture_shape(TAHR_SHAPE_CAPSULE, RADIUS, HALF), v_make(0.65, 0, MIDDLE), 0.1);
    assert_int_equal(tahr_backend_v1_native()->contacts(f.self, &f.context, &query, contacts, 4, &count), TAHR_OK);
    assert_int_equal(count, 1);
    assert_true(fabs(contacts[0].point.z - MIDDLE) <= ROUNDING && fabs(contacts[0].distance - 0.05) <= ROUNDING);
    native_close(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tall_wall_is_touched_at_the_middle),
        cmocka_unit_test(a_wall_that_ends_below_or_above_is_touched_at_its_end),
        cmocka_unit_test(the_end_of_a_wall_may_be_aslant),
        cmocka_unit_test(an_upright_edge_is_touched_as_a_wall_is),
        cmocka_unit_test(a_wall_that_leans_is_touched_at_an_end),
        cmocka_unit_test(contacts_are_told_at_the_middle_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
