/* SPDX-License-Identifier: MIT
 * test_floor_end.c: where a floor ends: against closed forms, against 60 halvings, and asked of a world that lies.
 *
 * The character is the preset's: a radius of 0.35 m, a skin of 0.01 m, and a perch in the outermost 0.15 m. So a
 * straight edge holds until it is 0.35 + 0.01 - 0.15 = 0.21 m from the axis, seen from above. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "floor.h"
#include "floor_end.h"
#include "native_world.h"
#include "rig.h"
#include "step_in_progress.h"

static const double HOLDS = 0.21;

/* m: 7e-9 half widths, what is known of an end in any case where the edge is straight. */
static const double NARROW = 7e-9 * 0.35;

/* Looks may be this many (20 halvings, 4 besides, and one at the begin), and that few where an edge is straight. */
enum { MOST = 25, FEW = 4 };

typedef struct search {
    tahr__floor_border border;
    double way;     /* m */
    uint32_t looks; /* besides the one at the end of the way */
} search;

static tahr__step begin(rig *r)
{
    tahr__step step = step_in_progress(r);
    step.state.mode = TAHR_MODE_WALKING;
    return step;
}

static int floor_at(rig *r, tahr_vec3 at, tahr_floor *floor)
{
    tahr__step step = begin(r);
    step.state.position = at;
    tahr__find_floor(&step, step.config->snap_distance, NULL, floor);
    return (floor->flags & TAHR_FLOOR_WALKABLE) != 0;
}

static tahr_vec3 between(tahr_vec3 from, tahr_vec3 to, double part)
{
    return add_scaled(from, sub(to, from), part);
}

/* Fails the test if there is a floor at the end, or what must hold of every search does not. */
static search find(rig *r, tahr_vec3 from, tahr_vec3 to)
{
    search s;
    tahr_floor beyond, floor;
    tahr__path path;
    tahr__step step = begin(r);
    memset(&s, 0, sizeof s);
    memset(&path, 0, sizeof path);
    assert_false(floor_at(r, to, &beyond));
    step.state.position = to;
    path.from = from;
    step.report.decisions = r->decisions;
    step.report.decision_capacity = RIG_DECISIONS;
    tahr__floor_end(&step, &path, &beyond, &s.border);
    for (uint32_t i = 0; i < step.report.decision_count; i++) {
        s.looks += r->decisions[i].rule == TAHR_RULE_FLOOR;
    }
    s.way = length(sub(to, from));
    assert_true(s.looks <= MOST);
    assert_true(s.border.inside >= 0 && s.border.inside < s.border.outside && s.border.outside <= 1);
    assert_true((s.border.outside - s.border.inside) * s.way <= fmax(s.way / (1 << 20), NARROW));
    assert_false(floor_at(r, between(from, to, s.border.outside), &floor));
    assert_int_equal(floor_at(r, between(from, to, s.border.inside), &floor),
                     (s.border.floor.flags & TAHR_FLOOR_WALKABLE) != 0);
    assert_memory_equal(&floor, &s.border.floor, sizeof floor);
    assert_true(vec_equal(step.state.position, between(from, to, s.border.inside)));
    return s;
}

/* Fails the test unless the end lies `end` m from the begin. What a backend knows of a distance is 1e-9 m; on a way
 * that meets the edge slantwise (cosine) that is farther. */
static void expect(const search *s, double end, double cosine)
{
    assert_true(s->border.inside * s->way <= end + 1e-9 / cosine && s->border.outside * s->way >= end - 1e-9 / cosine);
}

/* A level top that ends at x = 2, z = 0, in a face that goes down by an angle to the level and has no end. */
typedef struct roof {
    double vertices[18];
    uint32_t indices[12];
} roof;

static tahr_body_desc roof_body(roof *f, double rise, double angle)
{
    const double deep = 20, out = 2 + deep / tan(angle);
    const double v[18] = {-5, -5, -5 * rise, 2,   -5, -5 * rise,        2,   5, 5 * rise,
                          -5, 5,  5 * rise,  out, -5, -deep - 5 * rise, out, 5, -deep + 5 * rise};
    const uint32_t i[12] = {0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2};
    tahr_body_desc d;
    memcpy(f->vertices, v, sizeof v);
    memcpy(f->indices, i, sizeof i);
    assert_int_equal(tahr_body_desc_init(&d, sizeof d, TAHR_BODY_MESH), TAHR_OK);
    d.vertices = f->vertices;
    d.vertex_count = 6;
    d.indices = f->indices;
    d.triangle_count = 4;
    return d;
}

static const double HEIGHT = 0.9125; /* of the middle over a floor: half a height of 0.9, and 1.25 skins */

static void a_straight_edge_is_found_to_a_nanometre_however_it_is_met(void **unused)
{
    const double ways[] = {0.03, 0.1, 0.3, 1}; /* m beyond the edge: 60 Hz, 10 Hz, and more than the foot is wide */
    tahr_body_desc box = native_box(fake_vec(-3, 0, -1), fake_vec(5, 5, 1));
    rig r;
    (void)unused;
    rig_open_bodies(&r, &box, 1, NULL, fake_vec(0, 0, HEIGHT));
    for (int i = 0; i < 4; i++) {
        for (double turn = -1.2; turn < 1.3; turn += 0.3) {
            tahr_vec3 from = fake_vec(2 + HOLDS - 0.04, 0.1 * turn, HEIGHT);
            double before = 0.04 / cos(turn), way = before + ways[i];
            search s = find(&r, from, add(from, fake_vec(way * cos(turn), way * sin(turn), 0)));
            expect(&s, before, cos(turn));
            assert_true((s.border.outside - s.border.inside) * s.way <= NARROW || turn * turn > 1);
            assert_true(s.looks <= FEW || ways[i] > 0.15); /* a foot that touches nothing knows nothing */
        }
    }
    rig_close(&r);
}

static void a_corner_holds_as_far_as_an_edge_in_every_direction(void **unused)
{
    tahr_body_desc box = native_box(fake_vec(-3, 0, -1), fake_vec(5, 5, 1)); /* its corner: (2, 5) */
    rig r;
    (void)unused;
    rig_open_bodies(&r, &box, 1, NULL, fake_vec(0, 0, HEIGHT));
    for (double beside = -0.15; beside < 0.16; beside += 0.03) { /* past the corner along its bisector */
        const double s = sqrt(0.5);
        tahr_vec3 from = fake_vec(2 + s * (0.16 + beside), 5 + s * (0.16 - beside), HEIGHT);
        double begins = 0.16, ends = sqrt(HOLDS * HOLDS - beside * beside);
        if (ends - begins < 0.01) {
            begins = ends - 0.01;
            from = fake_vec(2 + s * (begins + beside), 5 + s * (begins - beside), HEIGHT);
        }
        tahr_vec3 to = add(from, fake_vec(s * 0.1, s * 0.1, 0));
        tahr_floor floor;
        if (from.x < 2 || from.y < 5 || floor_at(&r, to, &floor)) {
            continue; /* not past the corner, but past an edge */
        }
        search found = find(&r, from, to);
        expect(&found, ends - begins, ends / HOLDS);
        assert_true(found.looks <= FEW);
    }
    rig_close(&r);
}

/* On the face of 60 degrees the thinner foot touches 0.21 sin 60 = 0.182 m from its axis, less than the 0.2 m from
 * which on the edge needs a perch: it ends there. On one of 80 degrees the perch holds up to 0.21 sin 80 = 0.207 m. */
static void a_floor_that_breaks_off_into_a_slope_ends_where_the_perch_slides_onto_that(void **unused)
{
    const double degree = acos(-1) / 180, angles[] = {60, 80, 85, 89};
    const double ends[] = {0.2, 0.21 * sin(80 * degree), 0.21 * sin(85 * degree), 0.21 * sin(89 * degree)};
    uint32_t looks = 0;
    (void)unused;
    for (int i = 0; i < 4; i++) {
        roof f;
        tahr_body_desc body = roof_body(&f, 0, angles[i] * degree);
        rig r;
        rig_open_bodies(&r, &body, 1, NULL, fake_vec(0, 0, HEIGHT));
        for (double turn = -0.9; turn < 1; turn += 0.45) {
            tahr_vec3 from = fake_vec(2 + ends[i] - 0.03, 0, HEIGHT);
            tahr_vec3 to = add(from, fake_vec(0.06, 0.06 * tan(turn), 0));
            search s = find(&r, from, to);
            expect(&s, 0.03 / cos(turn), 1e-2); /* both faces are met at once there: which is told is known to 1e-7 m */
            looks += s.looks;
        }
        rig_close(&r);
    }
    assert_true(looks <= 20 * 10); /* 20 ways; halving takes 20 for each */
}

/* Gone straight across, an edge is touched at the same point all along, as a corner is; it passes to its face all the
 * same. */
static void a_perch_that_comes_straight_over_an_edge_slides_onto_its_face(void **unused)
{
    const double degree = acos(-1) / 180;
    (void)unused;
    for (double angle = 76; angle < 89; angle += 2) {
        roof f;
        const tahr_body_desc body = roof_body(&f, 0, angle * degree);
        const double end = 0.21 * sin(angle * degree);
        rig r;
        rig_open_bodies(&r, &body, 1, NULL, fake_vec(0, 0, HEIGHT));
        for (double before = 0.01; before < 0.05; before += 0.01) {
            const tahr_vec3 from = fake_vec(2 + end - before, 0, HEIGHT);
            const search s = find(&r, from, add(from, fake_vec(0.08, 0, 0)));
            expect(&s, before, 1e-2); /* both faces are met at once there: which is told is known to 1e-7 m */
            assert_true(s.looks <= MOST / 2);
        }
        rig_close(&r);
    }
}

/* A level floor, and from x = 2 on one that climbs by too much. A ball of 0.21 m meets both 0.21 tan(half the angle)
 * before that. Until there the thinner foot stands on the level one; the whole foot has met the other before. */
static void a_perch_in_front_of_a_steep_slope_ends_in_the_crease(void **unused)
{
    const double degree = acos(-1) / 180;
    (void)unused;
    for (double angle = 50; angle < 66; angle += 5) {
        const double a = angle * degree, end = 2 - 0.21 * tan(a / 2);
        tahr_body_desc boxes[2] = {native_box(fake_vec(-3, 0, -1), fake_vec(20, 5, 1)),
                                   native_box(fake_vec(2 + sin(a), 0, -cos(a)), fake_vec(5, 5, 1))};
        rig r;
        boxes[1].pose.orientation = (tahr_quat){0, -sin(a / 2), 0, cos(a / 2)};
        rig_open_bodies(&r, boxes, 2, NULL, fake_vec(0, 0, HEIGHT));
        for (double turn = -0.6; turn < 0.7; turn += 0.3) {
            const double before = 0.03, after = 0.02; /* m across; over the slope at the end, by a ball of 0.36 m */
            const double height = (0.36 + (end + after - 2) * sin(a)) / cos(a);
            const tahr_vec3 from = fake_vec(end - before, 0, height + HEIGHT - 0.36);
            const search s = find(&r, from, add(from, fake_vec(before + after, (before + after) * tan(turn), 0)));
            expect(&s, before / cos(turn), 1e-2 * cos(turn)); /* of either face the depth is known to 1e-9 m */
            assert_true(s.looks <= MOST / 2);
        }
        rig_close(&r);
    }
}

/* The top climbs along y, and its edge with it: seen from above it is as far away. */
static void an_edge_that_slopes_holds_as_far_as_a_level_one(void **unused)
{
    roof f;
    tahr_body_desc body = roof_body(&f, 0.5, acos(-1) / 2);
    rig r;
    (void)unused;
    rig_open_bodies(&r, &body, 1, NULL, fake_vec(0, 0, HEIGHT));
    for (double y = -1; y < 1.1; y += 0.25) {
        tahr_floor floor;
        tahr_vec3 from = fake_vec(2 + HOLDS - 0.05, y, 0.5 * y + 1.1);
        assert_true(floor_at(&r, from, &floor));
        from.z -= floor.distance - 0.0125;
        search s = find(&r, from, add(from, fake_vec(0.08, 0, 0)));
        expect(&s, 0.05, 1);
        assert_true(s.looks <= FEW);
    }
    rig_close(&r);
}

/* 0.6 m lower is too deep for a snap of 0.4 m and not for a perch, which may be 0.4 m deeper: it holds until the edge
 * is less than edge_tolerance, 1e-4 m, inside the rim of the foot and its skin. */
static void a_perch_over_a_lower_floor_ends_at_the_rim(void **unused)
{
    tahr_body_desc boxes[2] = {native_box(fake_vec(-3, 0, -1), fake_vec(5, 5, 1)),
                               native_box(fake_vec(0, 0, -2.6), fake_vec(20, 20, 2))};
    rig r;
    (void)unused;
    rig_open_bodies(&r, boxes, 2, NULL, fake_vec(0, 0, HEIGHT));
    for (double turn = -1; turn < 1.1; turn += 0.5) {
        tahr_vec3 from = fake_vec(2.3, 0, HEIGHT), to = add(from, fake_vec(0.08, 0.08 * tan(turn), 0));
        search s = find(&r, from, to);
        expect(&s, 0.0599 / cos(turn), cos(turn));
        assert_true(s.looks <= FEW);
    }
    rig_close(&r);
}

/* Over the edge of a top that climbs the rim of the foot leaves the edge for good only where a foot thinner by twice
 * the edge_tolerance passes it: seen from above it is then 0.36 - 2e-4 m away. */
static void a_perch_over_an_edge_that_slopes_ends_where_the_foot_without_its_rim_passes(void **unused)
{
    roof f;
    tahr_body_desc bodies[2] = {roof_body(&f, 1.11, acos(-1) / 2),
                                native_box(fake_vec(0, 0, -2.6), fake_vec(20, 20, 2))};
    rig r;
    (void)unused;
    rig_open_bodies(&r, bodies, 2, NULL, fake_vec(0, 0, HEIGHT));
    for (double begin = 0.3; begin < 0.36; begin += 0.02) {
        tahr_vec3 from = fake_vec(2 + begin, 0, 0.55 + 0.34);
        search s = find(&r, from, add(from, fake_vec(0.08, 0, 0)));
        expect(&s, 0.3598 - begin, 1);
        assert_true(s.looks < MOST / 2);
    }
    rig_close(&r);
}

/* Over hills and boxes the way is halved 60 times with the same question. Where that is the only border of the way they
 * must agree; where there are several the search must still have found one, which `find` sees to. */
static void compare_with_60_halvings(const tahr_config *config)
{
    static native_grid grid;
    static tahr_body_desc bodies[NATIVE_HILLS];
    oracle_random random = {.state = 5};
    uint32_t compared = 0, found = 0;
    double looks = 0;
    rig r;
    native_hills(&grid, bodies);
    rig_open_bodies(&r, bodies, NATIVE_HILLS, config, fake_vec(6, 6, 10));
    for (int i = 0; i < 20000; i++) {
        tahr_floor floor;
        tahr_vec3 from = dice_vec(&random, 0, 12), way = dice_vec(&random, -0.3, 0.3);
        from.z = 0.3 * from.z;
        way.z *= 0.1;
        tahr_vec3 to = add(from, way);
        if (!floor_at(&r, from, &floor) || floor.distance < 0.01 || floor_at(&r, to, &floor)) {
            continue;
        }
        search s = find(&r, from, to);
        double low = 0, high = 1;
        int changes = 0, before = 1;
        found++;
        looks += s.looks;
        for (int k = 1; k <= 200; k++) {
            int now = floor_at(&r, between(from, to, k / 200.0), &floor);
            changes += now != before;
            before = now;
        }
        for (int k = 0; k < 60; k++) {
            double middle = 0.5 * (low + high);
            *(floor_at(&r, between(from, to, middle), &floor) ? &low : &high) = middle;
        }
        if (changes == 1) {
            assert_true(high >= s.border.inside && low <= s.border.outside);
            compared++;
        }
    }
    rig_close(&r);
    assert_true(compared > 150);
    assert_true(looks / found < 16); /* halving takes 20 */
}

static void what_60_halvings_find_lies_between_inside_and_outside(void **unused)
{
    tahr_config box = rig_config();
    (void)unused;
    compare_with_60_halvings(NULL);
    box.shape.type = TAHR_SHAPE_BOX;
    box.shape.half_x = box.shape.half_y = 0.35;
    box.shape.radius = 0;
    compare_with_60_halvings(&box);
}

/* Takes the platform away from every other sweep or so, at random. */
static void blink(fake_world *w)
{
    oracle_random *random = w->user;
    w->solids[0].max.x = oracle_uniform(random, 0, 1) < 0.5 ? 2 : -4;
}

static void a_world_that_lies_costs_no_more_looks_than_halving_and_four(void **unused)
{
    oracle_random random = {.state = 11};
    fake_world w;
    rig r;
    uint32_t most = 0;
    (void)unused;
    fake_world_init(&w);
    fake_add_box(&w, fake_vec(-5, -5, -1), fake_vec(2, 5, 0));
    rig_open(&r, &w, NULL, fake_vec(0, 0, HEIGHT));
    w.user = &random;
    for (int i = 0; i < 500; i++) {
        tahr__step step = begin(&r);
        tahr__floor_border border;
        tahr__path path;
        tahr_floor beyond;
        uint32_t looks = 0;
        memset(&path, 0, sizeof path);
        w.on_sweep = NULL;
        w.solids[0].max.x = 2;
        path.from = fake_vec(2 + oracle_uniform(&random, -0.2, 0.2), 0, HEIGHT);
        step.state.position = fake_vec(2.3, 0.1, HEIGHT);
        assert_false(floor_at(&r, step.state.position, &beyond));
        w.on_sweep = blink;
        step.report.decisions = r.decisions;
        step.report.decision_capacity = RIG_DECISIONS;
        tahr__floor_end(&step, &path, &beyond, &border);
        for (uint32_t k = 0; k < step.report.decision_count; k++) {
            looks += r.decisions[k].rule == TAHR_RULE_FLOOR;
        }
        assert_true(looks <= MOST);
        assert_true(border.inside >= 0 && border.inside < border.outside && border.outside <= 1);
        assert_true(border.outside - border.inside <= 1.0 / (1 << 20));
        most = looks > most ? looks : most;
    }
    w.on_sweep = NULL;
    rig_close(&r);
    assert_true(most >= 20); /* the lies were hard enough */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_straight_edge_is_found_to_a_nanometre_however_it_is_met),
        cmocka_unit_test(a_corner_holds_as_far_as_an_edge_in_every_direction),
        cmocka_unit_test(a_floor_that_breaks_off_into_a_slope_ends_where_the_perch_slides_onto_that),
        cmocka_unit_test(a_perch_that_comes_straight_over_an_edge_slides_onto_its_face),
        cmocka_unit_test(a_perch_in_front_of_a_steep_slope_ends_in_the_crease),
        cmocka_unit_test(an_edge_that_slopes_holds_as_far_as_a_level_one),
        cmocka_unit_test(a_perch_over_a_lower_floor_ends_at_the_rim),
        cmocka_unit_test(a_perch_over_an_edge_that_slopes_ends_where_the_foot_without_its_rim_passes),
        cmocka_unit_test(what_60_halvings_find_lies_between_inside_and_outside),
        cmocka_unit_test(a_world_that_lies_costs_no_more_looks_than_halving_and_four)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
