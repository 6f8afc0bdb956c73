/* SPDX-License-Identifier: MIT
 * test_floor_shrunk.c: TAHR_FLOOR_PROBE_SHRUNK where no table of numbers goes: random slopes, shapes, sizes and up
 * directions against closed forms, the most queries, and a flat base at edges. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "floor_distance.h"
#include "limits.h"
#include "parity.h"
#include "rig.h"

static const double DEGREE = 0.017453292519943295;

/* A character of this shape in a scene that is turned as a whole, at the origin of it. */
static void reshape(parity *p, const tahr_shape *shape, tahr_quat frame)
{
    tahr__step *s = &p->step;
    p->config.shape = *shape;
    p->limits = tahr__limits_of(&p->config, shape, p->world->backend->capabilities);
    s->state.up = rotate(frame, vec(0, 0, 1));
    s->state.orientation = frame;
    s->state.position = vec(0, 0, 0);
    s->state.mode = TAHR_MODE_WALKING;
}

/* A capsule of radius r over a plane tilted by a, which lies `gap` below its end on the axis: the cap touches off the
 * axis, r (1 / cos a - 1) earlier. A start in overlap (the ends are drawn in by a tenth of the straight part) is looked
 * at with a radius less by edge_tolerance and a thousandth of pull_back. */
static void distance_to_any_slope_is_the_closed_form(void **unused)
{
    oracle_random dice = {7};
    uint32_t thin = 0, steep = 0;
    (void)unused;
    for (int i = 0; i < 4000; i++) {
        double r = oracle_uniform(&dice, 0.1, 1), h = r * oracle_uniform(&dice, 1, 4), a = oracle_uniform(&dice, 0, 60);
        double round = oracle_uniform(&dice, 0, 360) * DEGREE, lean = 1 / cos(a * DEGREE) - 1, slope = sin(a * DEGREE);
        double deep = oracle_uniform(&dice, -0.8 * (h - r), 0.4), gap = deep + r * lean;
        tahr_shape shape = {TAHR_SHAPE_CAPSULE, 0, r, h, 0, 0};
        tahr_config c = parity_config();
        tahr_quat frame = quat_between(vec(0, 0, 1), dice_direction(&dice));
        vec3 n = rotate(frame, vec(slope * cos(round), slope * sin(round), cos(a * DEGREE)));
        vec3 foot = rotate(frame, vec(0, 0, -h - gap));
        parity_scene scene = {0};
        tahr_floor floor;
        parity p;
        parity_plane(&scene, n.x, n.y, n.z, 100 * dot(n, foot));
        parity_open(&p, &scene, PARITY_FAKE, &c, 0, 0, 0);
        reshape(&p, &shape, frame);
        tahr__floor_look look = {vec(0, 0, 0), 0.45, 0.45, r, NULL};
        tahr__compute_floor_distance(&p.step, &look, &floor);
        int overlapped = deep < -0.1 * (h - r), walkable = a < 44.76;
        double expected = overlapped ? gap - (r - 0.0015 - 1e-6) * lean : deep;
        /* A foot thinned from deep inside is judged by what it meets; near the border either probe may answer. */
        if (fabs(deep + 0.1 * (h - r)) > 1e-9 && fabs(a - 44.765) > 0.01) {
            assert_near(floor.distance, fmax(expected, -r), 1e-9);
            assert_int_equal(floor_is_walkable(&floor), walkable);
            assert_int_equal(p.step.queries, 1 + (uint32_t)overlapped + !walkable);
        }
        thin += overlapped != 0;
        steep += !walkable;
        parity_close(&p);
    }
    assert_true(thin > 500 && steep > 500);
}

/* A box touches a slope with its lowest corner. The rim of a box is where it touches a slope, so that a thinner one, by
 * edge_tolerance and a thousandth of pull_back, has the last word; a flat floor is touched with the whole end. */
static void boxes_and_spheres_have_their_own_closed_forms(void **unused)
{
    oracle_random dice = {11};
    (void)unused;
    for (int i = 0; i < 1000; i++) {
        double a = i % 4 == 0 ? 0 : oracle_uniform(&dice, 1, 44), x = oracle_uniform(&dice, 0.2, 0.5);
        double y = oracle_uniform(&dice, 0.2, 0.5), thinner = a > 0 ? 0.001501 : 0;
        int box = i % 2;
        tahr_shape shape = {TAHR_SHAPE_SPHERE, 0, x, x, 0, 0};
        tahr_config c = parity_config();
        parity_scene scene = {0};
        tahr_floor floor;
        parity p;
        if (box) {
            shape = (tahr_shape){TAHR_SHAPE_BOX, 0, 0, 0.9, x, y};
        }
        double lean = box ? (x - thinner) * tan(a * DEGREE) : x * (1 / cos(a * DEGREE) - 1);
        double gap = lean + oracle_uniform(&dice, 0.001, 0.4);
        parity_plane(&scene, sin(a * DEGREE), 0, cos(a * DEGREE), 100 * (-shape.half_height - gap) * cos(a * DEGREE));
        parity_open(&p, &scene, PARITY_FAKE, &c, 0, 0, 0);
        reshape(&p, &shape, (tahr_quat){0, 0, 0, 1});
        tahr__floor_look look = {vec(0, 0, 0), 1, 1, p.limits.width, NULL};
        tahr__compute_floor_distance(&p.step, &look, &floor);
        assert_near(floor.distance, gap - lean, 1e-9);
        assert_true(floor_is_walkable(&floor));
        assert_int_equal(p.step.queries, box && a > 0 ? 2 : 1);
        parity_close(&p);
    }
}

/* config.flat_base is the cure for sinking over an edge: the drop of a round foot is R - sqrt(R^2 - d^2). */
static void flat_base_does_not_sink_at_edges(void **unused)
{
    const struct {
        double from, drop;
    } rows[] = {{20, 6.50}, {30, 18.0}, {33.849, 30.8}}; /* cm; the last just inside of edge_tolerance */
    (void)unused;
    for (int i = 0; i < 3; i++) {
        for (int flat = 0; flat < 2; flat++) {
            for (int backend = PARITY_NATIVE; backend < PARITY_BACKENDS; backend++) {
                parity_scene scene = {0};
                tahr_config c = parity_config();
                tahr_floor floor;
                parity p;
                if (!parity_has(backend)) {
                    continue;
                }
                c.flat_base = (uint32_t)flat;
                parity_box(&scene, fake_vec(rows[i].from, -300, -100), fake_vec(rows[i].from + 300, 300, 0));
                parity_open(&p, &scene, backend, &c, 0, 0, 88 + 2.15);
                p.step.state.mode = TAHR_MODE_WALKING;
                tahr__find_floor(&p.step, c.snap_distance, NULL, &floor);
                assert_true(floor_is_walkable(&floor));
                assert_near(100 * floor.distance, 2.15 + (flat ? 0 : rows[i].drop),
                            0.006); /* as many digits as given */
                if (flat) {
                    assert_true(floor.normal.z > 1 - 1e-6);
                }
                parity_close(&p);
            }
        }
    }
}

static void turning_on_the_spot_changes_no_floor(void **unused)
{
    oracle_random dice = {3};
    parity_scene scene = {0};
    tahr_config c = parity_config();
    tahr_floor first, floor;
    parity p;
    (void)unused;
    memset(&first, 0, sizeof first);
    memset(&floor, 0, sizeof floor);
    c.flat_base = 1;
    parity_box(&scene, fake_vec(30, -300, -100), fake_vec(300, 300, 0));
    parity_plane(&scene, 0, 0, 1, -30);
    parity_open(&p, &scene, PARITY_NATIVE, &c, 0, 0, 90);
    for (int i = 0; i < 50; i++) {
        double half = oracle_uniform(&dice, 0, 3.2);
        p.step.state.orientation = (tahr_quat){0, 0, i ? sin(half) : 0, i ? cos(half) : 1};
        tahr_quat before = p.step.state.orientation;
        tahr__find_floor(&p.step, c.snap_distance, NULL, i ? &floor : &first);
        assert_memory_equal(&before, &p.step.state.orientation, sizeof before);
        assert_memory_equal(i ? &floor : &first, &first, sizeof first);
    }
    parity_close(&p);
}

/* Everything grows alike with tahr_config_scale: lengths in the code that did not would show. */
static void scaled_characters_find_scaled_floors(void **unused)
{
    const double factors[] = {0.01, 0.1, 10, 100};
    oracle_random dice = {19};
    (void)unused;
    for (int i = 0; i < 400; i++) {
        double edge = oracle_uniform(&dice, -40, 40), top = oracle_uniform(&dice, -10, 40),
               under = oracle_uniform(&dice, -12, 60);
        double tilt = oracle_uniform(&dice, -60, 60) * DEGREE, distance = 0, height = 0;
        uint32_t flags = 0, queries = 0;
        for (int k = -1; k < 4; k++) {
            double f = k < 0 ? 1 : factors[k];
            parity_scene scene = {0};
            tahr_config c = parity_config();
            parity p;
            c.perch_threshold = i % 2 ? 0.15 : 0;
            assert_int_equal(tahr_config_scale(&c, f), TAHR_OK);
            parity_box(&scene, fake_vec(edge * f, -900 * f, -900 * f), fake_vec(900 * f, 900 * f, top * f));
            parity_plane(&scene, sin(tilt), 0, cos(tilt), -under * f * cos(tilt));
            parity_open(&p, &scene, PARITY_FAKE, &c, 0, 0, 88 * f);
            p.step.state.mode = TAHR_MODE_WALKING;
            tahr__find_floor(&p.step, c.snap_distance, NULL, &p.step.state.floor);
            double found = p.step.state.floor.distance / f;
            uint32_t kind = p.step.state.floor.flags;
            double rise = tahr__adjust_height(&p.step) / f;
            if (k < 0) {
                distance = found, height = rise, flags = kind, queries = p.step.queries;
            }
            /* The sphere that stands for a ray on callbacks has one size. */
            if (!(flags & TAHR_FLOOR_LINE) && !(kind & TAHR_FLOOR_LINE)) {
                assert_near(found, distance, 1e-9);
                assert_near(rise, height, 1e-9);
                assert_int_equal(kind, flags);
                assert_int_equal(p.step.queries, queries);
            }
            parity_close(&p);
        }
    }
}

static int is_finite_floor(const tahr_floor *f)
{
    double sum = (f->normal.x + f->normal.y + f->normal.z) + (f->point.x + f->point.y + f->point.z);
    sum += (f->surface_normal.x + f->surface_normal.y + f->surface_normal.z) + f->distance + f->perch_distance;
    return isfinite(sum);
}

static void random_scene(oracle_random *dice, parity_scene *scene, int boxes_only)
{
    memset(scene, 0, sizeof *scene);
    uint32_t count = 1 + oracle_below(dice, 5);
    for (uint32_t i = 0; i < count; i++) {
        parity_solid *s;
        if (boxes_only || oracle_below(dice, 2)) {
            vec3 at = dice_vec(dice, -80, 80), half = dice_vec(dice, 2, 90);
            s = parity_box(scene, sub(at, half), add(at, half));
        } else {
            vec3 n = dice_direction(dice);
            s = parity_plane(scene, n.x, n.y, n.z, oracle_uniform(dice, -110, 20));
        }
        s->walkable_rule = oracle_below(dice, 4) ? TAHR_WALKABLE_DEFAULT : oracle_below(dice, 4);
        s->walkable_angle = oracle_uniform(dice, 0, 1.6);
    }
}

/* How many queries each rule may ask at most: find floor 6, with a flat base 10; the distance 3 or 5; a height 7. */
static void nothing_asks_more_than_it_may_or_answers_nonsense(void **unused)
{
    oracle_random dice = {23};
    uint32_t most = 0, most_flat = 0, lines = 0, perches = 0;
    (void)unused;
    for (int i = 0; i < 6000; i++) {
        int backend = i % PARITY_BACKENDS, flat = backend != PARITY_FAKE && oracle_below(&dice, 2);
        parity_scene scene;
        tahr_config c = parity_config();
        tahr_floor floor;
        parity p;
        random_scene(&dice, &scene, 0);
        c.flat_base = (uint32_t)flat;
        c.perch_threshold = oracle_below(&dice, 2) ? oracle_uniform(&dice, 0, 0.4) : 0;
        if (!parity_has(backend)) {
            continue;
        }
        parity_open(&p, &scene, backend, &c, 0, 0, 0);
        tahr__step *s = &p.step;
        s->state.mode = oracle_below(&dice, 2) ? TAHR_MODE_WALKING : TAHR_MODE_FALLING;
        tahr__find_floor(s, c.snap_distance, NULL, &floor);
        assert_true(s->queries >= 1 && s->queries <= (flat ? 10u : 6u));
        *(flat ? &most_flat : &most) = s->queries > (flat ? most_flat : most) ? s->queries : (flat ? most_flat : most);
        assert_true(is_finite_floor(&floor));
        assert_true(!floor_is_walkable(&floor) || (floor.flags & TAHR_FLOOR_BLOCKING));
        assert_true(floor.distance >= -0.34 && floor.distance <= 0.475);
        lines += (floor.flags & TAHR_FLOOR_LINE) != 0;
        perches += (floor.flags & TAHR_FLOOR_PERCHING) != 0;

        tahr__keep_floor(s, &floor);
        s->queries = 0;
        double z = s->state.position.z, height = tahr__adjust_height(s);
        assert_true(s->queries <= 7);
        assert_true(isfinite(height) && fabs(height) <= 5.0);
        assert_near(s->state.position.z - z, height, 1e-12);
        assert_true(is_finite_floor(&s->state.floor));

        tahr__floor_look look = {s->state.position, 0.474, 0.474, oracle_uniform(&dice, 0.0011, 0.34), NULL};
        s->queries = 0;
        tahr__compute_floor_distance(s, &look, &floor);
        assert_true(s->queries >= 1 && s->queries <= (flat ? 5u : 3u));
        assert_true(is_finite_floor(&floor));
        parity_close(&p);
    }
    assert_true(most >= 5 && most_flat >= 6 && lines > 50 && perches > 20); /* the scenes are hard enough */
}

/* A whole character of the other preset, with each probe, comes to rest in the band over a floor, a slope and an
 * edge. */
static void characters_come_to_rest_in_the_band(void **unused)
{
    for (int kind = 0; kind < 6; kind++) {
        double z = 0.88 + 0.019, slack = 0.024 - 0.019;
        int flat = kind >= 3;
        tahr_config c = parity_config();
        tahr_body_desc box;
        rig r;
        (void)unused;
        c.flat_base = (uint32_t)flat;
        assert_int_equal(tahr_body_desc_init(&box, sizeof box, TAHR_BODY_BOX), TAHR_OK);
        box.half_extents = fake_vec(2, 2, 0.5);
        box.pose.position = fake_vec(0, 0, -0.5);
        if (kind % 3 == 1) { /* 20 cm over the edge */
            box.pose.position.x = 2.2;
            z -= flat ? 0 : 0.34 - sqrt(0.34 * 0.34 - 0.2 * 0.2);
        } else if (kind % 3 == 2) { /* 30 degrees up x: the cap touches the slope early, the box with its corner */
            double half = 15 * DEGREE;
            box.pose.orientation = (tahr_quat){0, -sin(half), 0, cos(half)};
            box.pose.position = fake_vec(0.5 * sin(30 * DEGREE), 0, -0.5 * cos(30 * DEGREE));
            z += flat ? 0.707 * sqrt(2.0) * 0.34 * tan(30 * DEGREE) : 0.34 * (1 / cos(30 * DEGREE) - 1);
        }
        rig_open_bodies(&r, &box, 1, &c, fake_vec(0, 0, z + 0.05));
        rig_settle(&r);
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        assert_near(r.state.position.z, z + 0.5 * slack, 0.5 * slack + 1e-5);
        assert_near(r.state.position.x, 0, 1e-9);
        rig_close(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(distance_to_any_slope_is_the_closed_form),
                                       cmocka_unit_test(boxes_and_spheres_have_their_own_closed_forms),
                                       cmocka_unit_test(flat_base_does_not_sink_at_edges),
                                       cmocka_unit_test(turning_on_the_spot_changes_no_floor),
                                       cmocka_unit_test(scaled_characters_find_scaled_floors),
                                       cmocka_unit_test(nothing_asks_more_than_it_may_or_answers_nonsense),
                                       cmocka_unit_test(characters_come_to_rest_in_the_band)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
