/* SPDX-License-Identifier: MIT
 * test_step_up_order.c: what a step up asks, and in which order, changes no step: against the plain order (ahead, up,
 * down, judged by the face behind the edge), which asks everything every time. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "floor.h"
#include "lip.h"
#include "native_world.h"
#include "query.h"
#include "rig.h"
#include "step_in_progress.h"
#include "step_up.h"

enum { BODIES = 40 };

static const double HEIGHT = 0.9125; /* of the middle over a floor: half a height of 0.9, and 1.25 skins */

static tahr__step begin(rig *r)
{
    tahr__step step = step_in_progress(r);
    step.state.mode = TAHR_MODE_WALKING;
    return step;
}

static void sweep(tahr__step *step, tahr_vec3 from, tahr_vec3 motion, tahr_hit *hit)
{
    tahr__sweep(step, &step->limits->shape, from, motion, step->config->skin, 0, hit);
}

/* As far as it is free at a height; less than 1e-4 radii is none. */
static double ahead(tahr__step *step, tahr_vec3 motion, double lift, int *overlaps)
{
    tahr_hit hit;
    sweep(step, add_scaled(step->state.position, step->state.up, lift), motion, &hit);
    double part = hit.start_overlap ? 0 : hit.fraction;
    *overlaps = (int)hit.start_overlap;
    return part == 1 || part * length(motion) > 1e-4 * step->limits->width ? part : 0;
}

/* Where a step up ends, on a level floor of the height 0. Returns 0 if there is none. */
static int plain_step(tahr__step *step, tahr_vec3 motion, const tahr_hit *obstacle, tahr_vec3 *to)
{
    const tahr_config *c = step->config;
    tahr_vec3 up = step->state.up;
    double lift = c->step_height;
    int overlaps;
    tahr_hit above, landing;
    if (dot(obstacle->normal, up) < -0.1) {
        return 0;
    }
    double covered = ahead(step, motion, lift, &overlaps);
    if (covered == 0 && !overlaps) {
        return 0;
    }
    sweep(step, step->state.position, scale(up, lift), &above);
    if (above.blocking && !above.start_overlap) {
        lift *= above.fraction;
        covered = ahead(step, motion, lift, &overlaps);
    }
    if (above.start_overlap || covered == 0) {
        return 0;
    }
    double range = lift + c->snap_distance;
    tahr_vec3 raised = add_scaled(add_scaled(step->state.position, up, lift), motion, covered);
    sweep(step, raised, scale(up, -range), &landing);
    double top = landing.point.z, base = step->state.floor.point.z;
    if (!landing.blocking || landing.start_overlap || top - base > c->step_height + TAHR__HEIGHT_ROUNDING ||
        (!tahr__is_walkable(step, &landing, 0) && !tahr__tread_behind(step, &landing, base))) {
        return 0;
    }
    *to = add_scaled(raised, up, -range * landing.fraction);
    tahr__supplied supplied = {.hit = &landing};
    tahr_floor floor;
    tahr__step there = *step;
    there.state.position = *to;
    tahr__find_floor(&there, c->snap_distance, &supplied, &floor);
    return (floor.flags & TAHR_FLOOR_WALKABLE) != 0;
}

/* A level ground, and on it, and over it, boxes that stand and lean: walls, steps, slopes, beams. */
static void make_yard(oracle_random *random, tahr_body_desc bodies[BODIES])
{
    bodies[0] = native_box(fake_vec(0, 0, -1), fake_vec(20, 20, 1));
    for (int i = 1; i < BODIES; i++) {
        double angle = oracle_uniform(random, 0, 1.5), turn = oracle_uniform(random, 0, 3.1);
        tahr_vec3 half = dice_vec(random, 0.05, 1);
        tahr_vec3 at = dice_vec(random, -4, 4);
        int kind = i % 4;
        half.z = kind == 0 ? oracle_uniform(random, 0.02, 0.3) : kind == 1 ? 1 : half.z;
        at.z = kind == 3 ? oracle_uniform(random, 1.7, 2.4) + half.z : kind == 2 ? 0 : half.z;
        bodies[i] = native_box(at, half);
        tahr_quat yaw = {0, 0, sin(turn / 2), cos(turn / 2)}, tilt = {sin(angle / 2), 0, 0, cos(angle / 2)};
        bodies[i].pose.orientation = kind == 2 ? quat_multiply(yaw, tilt) : yaw;
    }
}

/* Puts a character somewhere on the ground and lets it walk into something. Returns 0 if that came to nothing. */
static int meet(rig *r, oracle_random *random, tahr__step *step, tahr_vec3 *motion, tahr_hit *obstacle)
{
    tahr_vec3 at = dice_vec(random, -4, 4);
    double angle = oracle_uniform(random, 0, 6.283), reach = oracle_uniform(random, 0.03, 0.6);
    tahr_floor floor;
    at.z = HEIGHT;
    *step = begin(r);
    step->state.position = at;
    tahr__find_floor(step, step->config->snap_distance, NULL, &floor);
    if (!(floor.flags & TAHR_FLOOR_FACE) || floor.flags & TAHR_FLOOR_PERCHING || floor.point.z != 0 ||
        floor.normal.z != 1) {
        return 0;
    }
    *motion = fake_vec(reach * cos(angle), reach * sin(angle), 0);
    sweep(step, at, *motion, obstacle);
    if (!obstacle->blocking || obstacle->start_overlap) {
        return 0;
    }
    step->state.position = add_scaled(at, *motion, obstacle->fraction);
    double left = (1 - obstacle->fraction) * reach, stride = 0.5 * 0.35; /* as a walk takes them */
    *motion = scale(*motion, (left > stride ? stride : left) / reach);
    step->state.floor = floor;
    step->state.floor_position = step->state.position;
    return length(*motion) > 1e-3;
}

/* The same, of slabs whose sides lean by nothing, by the rounding of single precision, and by more, over and back; of
 * all heights, some of which end in the height of a step, and some hang. */
static void make_stand(oracle_random *random, tahr_body_desc bodies[BODIES])
{
    bodies[0] = native_box(fake_vec(0, 0, -1), fake_vec(20, 20, 1));
    for (int i = 1; i < BODIES; i++) {
        double turn = oracle_uniform(random, 0, 3.1), lean = pow(10, oracle_uniform(random, -10, -2));
        double angle = i % 4 == 0 ? 0 : i % 2 ? lean : -lean;
        tahr_vec3 half = dice_vec(random, 0.1, 1), at = dice_vec(random, -4, 4);
        half.z = i % 3 == 0 ? oracle_uniform(random, 0.1, 0.5) : oracle_uniform(random, 0.3, 2);
        at.z = (i % 5 == 0 ? oracle_uniform(random, 0.1, 1.5) : 0) + half.z;
        bodies[i] = native_box(at, half);
        tahr_quat yaw = {0, 0, sin(turn / 2), cos(turn / 2)}, tilt = {sin(angle / 2), 0, 0, cos(angle / 2)};
        bodies[i].pose.orientation = quat_multiply(yaw, tilt);
    }
}

typedef struct tally {
    uint32_t met, taken, asked, plainly, spared;
} tally;

static void compare(int yards, void (*make)(oracle_random *, tahr_body_desc[BODIES]), tally *t)
{
    static tahr_body_desc bodies[BODIES];
    oracle_random random = {.state = 3};
    for (int yard = 0; yard < yards; yard++) {
        rig r;
        make(&random, bodies);
        rig_open_bodies(&r, bodies, BODIES, NULL, fake_vec(0, 0, 30));
        for (int i = 0; i < 400; i++) {
            tahr__step step;
            tahr_hit obstacle;
            tahr_vec3 motion, to;
            if (!meet(&r, &random, &step, &motion, &obstacle)) {
                continue;
            }
            tahr__step plain = step;
            plain.queries = step.queries = 0;
            int steps = plain_step(&plain, motion, &obstacle, &to);
            double covered = tahr__step_up(&step, motion, &obstacle, NULL);
            assert_int_equal(covered > 0, steps);
            t->met++;
            t->asked += step.queries;
            t->plainly += plain.queries;
            t->spared += step.report.saved[TAHR_SHORTCUT_BARRED_STEP];
            if (steps) {
                assert_true(length(sub(step.state.position, to)) <= 1e-12);
                t->taken++;
            }
        }
        rig_close(&r);
    }
}

static void the_order_of_the_questions_changes_no_step(void **unused)
{
    tally t = {0};
    (void)unused;
    compare(200, make_yard, &t);
    assert_true(t.met > 3000 && t.taken > 1000);
    assert_true(t.asked < t.plainly);
}

/* What touches the side of the raised shape too bars its way, and no sweep says so. */
static void walls_that_bar_the_raised_shape_are_known_without_a_question(void **unused)
{
    tally t = {0};
    (void)unused;
    compare(80, make_stand, &t);
    print_message("    %u met, %u stepped up on, %u refused without a question\n", t.met, t.taken, t.spared);
    assert_true(t.met > 1500 && t.taken > 50 && t.spared > t.met / 4);
}

/* A box of 0.3 m that can be stepped up on, met at its front by a normal that leans by a little, as a backend of less
 * accuracy tells it. Of a point that is touched at the raised side too, though nothing is there, it is believed; not of
 * one that is farther away, lies lower or beside the way. */
static void only_a_point_in_the_way_bars_it(void **unused)
{
    static const struct {
        double farther, higher, aside;
        int bars;
    } cases[] = {{0, 0.3, 0, 1}, {0.05, 0.3, 0, 0}, {0, -0.5, 0, 0}, {0, 0.3, 3, 0}};
    const tahr_body_desc bodies[] = {native_box(fake_vec(0, 0, -1), fake_vec(20, 20, 1)),
                                     native_box(fake_vec(2, 0, 0.15), fake_vec(1, 3, 0.15))};
    rig r;
    (void)unused;
    rig_open_bodies(&r, bodies, 2, NULL, fake_vec(0, 0, 30));
    for (int i = 0; i < 4; i++) {
        tahr__step step = begin(&r);
        const tahr_vec3 motion = {0.1, 0, 0};
        const double touched = step.limits->shape.radius + step.config->skin;
        tahr_floor floor;
        tahr_hit hit;
        step.state.position = fake_vec(0.2, 0, HEIGHT);
        sweep(&step, step.state.position, fake_vec(1, 0, 0), &hit);
        assert_true(hit.blocking && !hit.start_overlap);
        step.state.position.x += hit.fraction;
        tahr__find_floor(&step, step.config->snap_distance, NULL, &floor);
        step.state.floor = floor;
        hit.normal = unit(fake_vec(-1, 0, 1e-6));
        hit.point = add(step.state.position, fake_vec(touched + cases[i].farther, cases[i].aside, cases[i].higher));
        assert_int_equal(tahr__step_up(&step, motion, &hit, NULL) > 0, !cases[i].bars);
    }
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_order_of_the_questions_changes_no_step),
        cmocka_unit_test(walls_that_bar_the_raised_shape_are_known_without_a_question),
        cmocka_unit_test(only_a_point_in_the_way_bars_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
