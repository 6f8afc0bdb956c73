/* SPDX-License-Identifier: MIT
 * test_push.c: bodies that move into a character push it, at any speed, and crush it only where there is no room;
 * conveyors; what a character does to bodies that have a mass. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "stage.h"

static const tahr_quat LEVEL = {0, 0, 0, 1};
static const double REACH = 0.35 + 0.01; /* radius and skin */

/* The ground and a wall of 1 x 10 x 4 m (body 1) at x = -5. */
static void stand_by_wall(rig *r, tahr_vec3 at)
{
    tahr_body_desc bodies[2] = {stage_ground(), stage_box(fake_vec(-5, 0, 2), fake_vec(0.5, 5, 2))};
    rig_open_bodies(r, bodies, 2, NULL, at);
    rig_settle(r);
}

static void a_wall_pushes_a_character_at_any_speed(void **unused)
{
    const double speeds[] = {0.1, 1, 10, 100, 1000};
    (void)unused;
    for (int k = 0; k < 5; k++) {
        for (int i = 0; i < RIG_RATES; i++) {
            rig r;
            double dt = 1 / rig_rates[i];
            stand_by_wall(&r, fake_vec(0, 0.3, 1));
            double height = r.state.position.z;
            for (int n = 1; n * dt * speeds[k] < 20; n++) {
                tahr_pose pose = {{-5 + speeds[k] * n * dt, 0, 2}, LEVEL};
                stage_step(&r, 1, pose, dt);
                assert_near(r.state.position.x, fmax(0, pose.position.x + 0.5 + REACH), 2e-6);
                assert_near(r.state.position.y, 0.3, 1e-9);
                assert_near(r.state.position.z, height, 1e-9);
                assert_false(r.report.flags & TAHR_REPORT_CRUSHED);
                if (n * dt > 2) {
                    break;
                }
            }
            rig_close(&r);
        }
    }
}

static void a_swinging_door_sweeps_a_character_along(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        rig r;
        double dt = 1 / rig_rates[i];
        /* A rod of 2 x 0.04 m half extents about its middle; 6 rad/s: at 10 Hz it turns by 34 degrees a step. */
        tahr_body_desc bodies[2] = {stage_ground(), stage_box(fake_vec(0, 0, 1), fake_vec(2, 0.02, 1))};
        rig_open_bodies(&r, bodies, 2, NULL, fake_vec(1, 0.6, 1));
        rig_settle(&r);
        for (int n = 1; n * dt < 0.4; n++) {
            double angle = 6 * n * dt;
            tahr_pose pose = {{0, 0, 1}, stage_yaw(angle)};
            stage_step(&r, 1, pose, dt);
            double across = -sin(angle) * r.state.position.x + cos(angle) * r.state.position.y;
            double along = cos(angle) * r.state.position.x + sin(angle) * r.state.position.y;
            assert_true(along > 2 || across > 0.02 + 0.35 - 1e-6);
        }
        assert_true(stage_distance(r.state.position, fake_vec(1, 0.6, r.state.position.z)) > 0.5);
        rig_close(&r);
    }
}

static void a_rising_floor_takes_a_character_up_and_a_press_crushes_it_under_the_ceiling(void **unused)
{
    rig r;
    const double dt = 1.0 / 60;
    tahr_body_desc bodies[2] = {stage_box(fake_vec(0, 0, -0.25), fake_vec(5, 5, 0.25)),
                                stage_box(fake_vec(0, 0, 4), fake_vec(5, 5, 0.5))};
    (void)unused;
    bodies[1].flags = 0;
    rig_open_bodies(&r, bodies, 2, NULL, fake_vec(0, 0, 1));
    rig_settle(&r);
    int crushed = 0;
    double z = 0;
    for (int n = 1; n <= 150; n++) { /* 1 m/s up to 2.2 m below a ceiling at 3.5 m, then down again */
        z = n <= 120 ? n * dt : (240 - n) * dt;
        tahr_pose pose = {{0, 0, -0.25 + z}, LEVEL};
        stage_step(&r, 0, pose, dt);
        double room = 3.5 - z - 1.8;
        if (room > 0) {
            assert_false(r.report.flags & TAHR_REPORT_CRUSHED);
        } else {
            assert_true(r.report.flags & TAHR_REPORT_CRUSHED);
            assert_near(r.report.residual, -room, 0.02); /* the skins of both sides are part of it */
            assert_int_equal(r.status, r.report.flags & TAHR_REPORT_STUCK ? TAHR_STUCK : TAHR_CRUSHED);
            crushed++;
        }
        assert_true(r.state.position.z + 0.9 < 3.5 + 1e-6); /* never into what does not move */
    }
    assert_in_range(crushed, 30, 40);
    rig_settle(&r);
    assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
    assert_near(r.state.position.z - 0.9 - z, 0.0125, 0.0026); /* in the band again */
    rig_close(&r);
}

/* Two walls that close to a gap and open again. gap 0.71: room for the shape, not for its skins. */
static void closing_walls_crush_only_when_they_leave_no_room(void **unused)
{
    const double gaps[] = {0.8, 0.73, 0.71, 0.6};
    (void)unused;
    for (int k = 0; k < 4; k++) {
        rig r;
        const double dt = 1.0 / 60;
        tahr_body_desc bodies[3] = {stage_ground(), stage_box(fake_vec(-3, 0, 1.5), fake_vec(1, 3, 1.5)),
                                    stage_box(fake_vec(3, 0, 1.5), fake_vec(1, 3, 1.5))};
        rig_open_bodies(&r, bodies, 3, NULL, fake_vec(0.3, 0, 1));
        rig_settle(&r);
        int crushed = 0;
        for (int n = 1; n <= 200; n++) {
            double half = fmax(gaps[k] / 2, n <= 100 ? 2 - 2 * n * dt : gaps[k] / 2 + 2 * (n - 100) * dt);
            tahr_body_pose poses[2] = {{1, 0, {{-1 - half, 0, 1.5}, LEVEL}}, {2, 0, {{1 + half, 0, 1.5}, LEVEL}}};
            assert_int_equal(tahr_world_move(r.world, poses, 2, dt), TAHR_OK);
            rig_step(&r, dt);
            crushed += (r.report.flags & TAHR_REPORT_CRUSHED) != 0;
            assert_true(fabs(r.state.position.x) < fmax(half - 0.35, 0) + 0.03);
            assert_near(r.state.position.z, 0.9125, 0.003);
        }
        assert_true((crushed > 0) == (gaps[k] < 0.7));
        r.input.move = fake_vec(0, 1, 0);
        rig_steps(&r, 60, dt);
        assert_true(r.state.position.y > 5); /* free again */
        rig_close(&r);
    }
}

static void a_press_from_above_squeezes_out_who_is_near_its_edge(void **unused)
{
    rig r;
    const double dt = 1.0 / 60;
    tahr_body_desc bodies[2] = {stage_ground(), stage_box(fake_vec(0, 0, 4), fake_vec(1, 1, 1))};
    (void)unused;
    bodies[1].type = TAHR_BODY_SPHERE;
    bodies[1].radius = 1;
    rig_open_bodies(&r, bodies, 2, NULL, fake_vec(0.2, 0.1, 1));
    rig_settle(&r);
    for (int n = 1; n <= 180; n++) {
        tahr_pose pose = {{0, 0, 4 - n * dt}, LEVEL};
        stage_step(&r, 1, pose, dt);
        assert_false(r.report.flags & TAHR_REPORT_CRUSHED);
        assert_near(r.state.position.z, 0.9125, 0.003);
    }
    double away = hypot(r.state.position.x, r.state.position.y);
    assert_true(away > 1.3);
    assert_near(r.state.position.y / r.state.position.x, 0.5, 1e-3); /* straight away from its axis */
    rig_close(&r);
}

static void a_pushed_character_slides_along_what_is_in_the_way(void **unused)
{
    rig r;
    const double dt = 1.0 / 60;
    /* A fixed wall at 45 degrees across the way of a piston along x. */
    tahr_body_desc bodies[3] = {stage_ground(), stage_box(fake_vec(-3, 0, 1.5), fake_vec(1, 5, 1.5)),
                                stage_box(fake_vec(2, 0, 1.5), fake_vec(0.2, 5, 1.5))};
    (void)unused;
    bodies[2].flags = 0;
    bodies[2].pose.orientation = stage_yaw(0.7853981633974483);
    rig_open_bodies(&r, bodies, 3, NULL, fake_vec(0, 0, 1));
    rig_settle(&r);
    for (int n = 1; n <= 240; n++) {
        tahr_pose pose = {{-3 + n * dt, 0, 1.5}, LEVEL};
        stage_step(&r, 1, pose, dt);
        assert_false(r.report.flags & TAHR_REPORT_CRUSHED);
        assert_true(r.state.position.x >= pose.position.x + 1 + REACH - 1e-5);
        assert_true((r.state.position.x - 2) * sqrt(0.5) + r.state.position.y * sqrt(0.5) <= -0.2 - REACH + 1e-5);
    }
    /* In the corner of both: x = -3 + 4 + 1 + REACH, (x - 2 + y) / sqrt 2 = -0.2 - REACH. */
    assert_near(r.state.position.x, 2 + REACH, 1e-5);
    assert_near(r.state.position.y, -REACH - sqrt(2) * (0.2 + REACH), 1e-4);
    rig_close(&r);
}

static void a_floor_that_rises_into_a_falling_character_is_landed_on_at_its_speed(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        rig r;
        double dt = 1 / rig_rates[i], speed = -1;
        tahr_body_desc slab = stage_box(fake_vec(0, 0, -0.25), fake_vec(5, 5, 0.25));
        rig_open_bodies(&r, &slab, 1, NULL, fake_vec(0, 0, 2.9));
        for (int n = 1; n * dt < 1; n++) {
            tahr_pose pose = {{0, 0, -0.25 + 5 * n * dt}, LEVEL};
            stage_step(&r, 0, pose, dt);
            const tahr_event *e = rig_event(&r, TAHR_EVENT_LANDED);
            if (e) {
                speed = e->value;
            }
            assert_true(r.state.position.z - 0.9 >= pose.position.z + 0.25 + 0.01 - 2e-6);
        }
        /* 1.99 m apart: 5 t + g t^2 / 2; sqrt(5^2 + 2 g 1.99) at the meeting */
        assert_near(speed, sqrt(25 + 2 * 9.81 * 1.99), 1e-4);
        assert_int_equal(r.state.mode, TAHR_MODE_WALKING);
        assert_near(r.state.velocity.z, 0, 0);
        rig_close(&r);
    }
}

enum { BOXES = 6 };

/* Boxes that fly about a character on a floor. */
typedef struct storm {
    rig r;
    oracle_random random;
    int boxes;
    tahr_body_desc bodies[BOXES + 1];
    tahr_body_pose poses[BOXES];
    tahr_vec3 velocity[BOXES];
    tahr_quat spin[BOXES]; /* turn of a step */
} storm;

static void begin_storm(storm *s, int boxes, uint64_t seed)
{
    s->random.state = seed;
    s->boxes = boxes;
    s->bodies[0] = stage_ground();
    for (int b = 0; b < boxes; b++) {
        s->bodies[b + 1] = stage_box(fake_vec(20 + 3 * b, 0, 5), dice_vec(&s->random, 0.2, 1));
        s->velocity[b] = fake_vec(0, 0, 0);
        s->spin[b] = LEVEL;
        if (boxes > 1) { /* up to 0.2 rad a step: 12 rad/s */
            tahr_vec3 axis = dice_direction(&s->random);
            double sine = oracle_uniform(&s->random, 0, 0.1);
            s->spin[b] = (tahr_quat){axis.x * sine, axis.y * sine, axis.z * sine, sqrt(1 - sine * sine)};
        }
    }
    rig_open_bodies(&s->r, s->bodies, (uint32_t)boxes + 1, NULL, fake_vec(0, 0, 1));
    rig_settle(&s->r);
}

static tahr_quat product(tahr_quat a, tahr_quat b)
{
    tahr_quat q = {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                   a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
    return q;
}

/* Moves all boxes; one that has gone past aims anew, from a place clear of the character. */
static void blow(storm *s, double dt)
{
    const tahr_vec3 at = s->r.state.position;
    for (int b = 0; b < s->boxes; b++) {
        tahr_pose *pose = &s->bodies[b + 1].pose;
        if (stage_distance(pose->position, at) > 8) {
            tahr_vec3 way = dice_direction(&s->random);
            double speed = oracle_uniform(&s->random, 0, 50), level = hypot(way.x, way.y);
            way.z = fabs(way.z);
            if (oracle_below(&s->random, 2)) {
                way = fake_vec(way.x / level, way.y / level, 0);
            }
            pose->position = fake_vec(at.x + 5 * way.x, at.y + 5 * way.y, at.z + 5 * way.z);
            s->velocity[b] = fake_vec(-speed * way.x, -speed * way.y, -speed * way.z);
            tahr_body_pose put = {(uint32_t)b + 1, 0, *pose};
            assert_int_equal(tahr_world_set(s->r.world, &put, 1), TAHR_OK);
        }
        s->poses[b] = (tahr_body_pose){(uint32_t)b + 1, 0, *pose};
        s->poses[b].pose.position.x += s->velocity[b].x * dt;
        s->poses[b].pose.position.y += s->velocity[b].y * dt;
        s->poses[b].pose.position.z += s->velocity[b].z * dt;
        s->poses[b].pose.orientation = product(s->spin[b], pose->orientation);
    }
    assert_int_equal(tahr_world_move(s->r.world, s->poses, (uint32_t)s->boxes, dt), TAHR_OK);
}

/* Part of the straight way between two points that lies in a box about the origin. */
static double part_inside(const double from[3], const double to[3], const double half[3])
{
    double low = 0, high = 1;
    for (int a = 0; a < 3; a++) {
        double d = to[a] - from[a], in = (-half[a] - from[a]) / d, out = (half[a] - from[a]) / d;
        if (d == 0) {
            low = fabs(from[a]) < half[a] ? low : 2;
            continue;
        }
        low = fmax(low, fmin(in, out));
        high = fmin(high, fmax(in, out));
    }
    return high - low;
}

static double distance_to_box(tahr_vec3 p, tahr_vec3 half)
{
    double x = fmax(fabs(p.x) - half.x, 0), y = fmax(fabs(p.y) - half.y, 0), z = fmax(fabs(p.z) - half.z, 0);
    return sqrt(x * x + y * y + z * z);
}

static tahr_vec3 seen_from(const tahr_pose *pose, tahr_vec3 p)
{
    tahr_vec3 c = pose->position;
    return fake_turn_back(pose->orientation, fake_vec(p.x - c.x, p.y - c.y, p.z - c.z));
}

/* The capsule's clearance from each box, at points of its axis, and the way of its centre seen from a box that does not
 * turn. */
static void check_boxes(storm *s, tahr_vec3 before, int crushed, int was_crushed)
{
    const tahr_vec3 to = s->r.state.position;
    for (int b = 0; b < s->boxes; b++) {
        const tahr_pose *now = &s->poses[b].pose;
        const tahr_vec3 h = s->bodies[b + 1].half_extents;
        tahr_vec3 f = seen_from(now, stage_carried(&s->bodies[b + 1].pose, now, before)), t = seen_from(now, to);
        double least = INFINITY;
        for (int i = -11; i <= 11; i++) {
            least = fmin(least, distance_to_box(seen_from(now, fake_vec(to.x, to.y, to.z + 0.05 * i)), h));
        }
        s->bodies[b + 1].pose = *now;
        if (!crushed && least < 0.35 - 1e-5) {
            fail_msg("%g m into box %d, at %g %g %g of it", 0.35 - least, b, t.x, t.y, t.z);
        }
        double from[3] = {f.x, f.y, f.z}, end[3] = {t.x, t.y, t.z}, half[3] = {h.x, h.y, h.z};
        if (!crushed && !was_crushed && s->boxes == 1 && part_inside(from, end, half) > 0) {
            fail_msg("through the box, from %g %g %g to %g %g %g", f.x, f.y, f.z, t.x, t.y, t.z);
        }
    }
}

static int storm_of(int boxes, int rounds)
{
    const double dt = 1.0 / 60;
    int crushed = 0;
    for (int round = 0; round < rounds; round++) {
        storm s;
        int was_crushed = 0;
        begin_storm(&s, boxes, 20251 + (uint64_t)round);
        for (int n = 0; n < 200; n++) {
            tahr_vec3 before = s.r.state.position;
            blow(&s, dt);
            if (n % 20 == 0 && boxes > 1) { /* alone it stands still: whoever walks takes corners */
                s.r.input.move = dice_direction(&s.random);
                s.r.input.jump = n % 40 == 0;
            }
            rig_step(&s.r, dt);
            int is_crushed = (s.r.report.flags & TAHR_REPORT_CRUSHED) != 0;
            crushed += is_crushed;
            assert_true(isfinite(s.r.state.position.x + s.r.state.position.y + s.r.state.position.z));
            if (s.r.state.position.z < 0.9 - 1e-5) { /* never into the floor */
                fail_msg("round %d, step %d: %g m into the floor, crushed %d", round, n, 0.9 - s.r.state.position.z,
                         is_crushed);
            }
            check_boxes(&s, before, is_crushed, was_crushed);
            assert_false(boxes == 1 && is_crushed && s.velocity[0].z == 0); /* level, in the open: there is room */
            was_crushed = is_crushed;
        }
        rig_close(&s.r);
    }
    return crushed;
}

static void a_box_at_fifty_metres_a_second_does_not_pass_through_a_character(void **unused)
{
    (void)unused;
    print_message("crushed in %d steps\n", storm_of(1, 60));
}

static void tumbling_boxes_do_not_enter_a_character_unless_they_crush_it(void **unused)
{
    (void)unused;
    print_message("crushed in %d steps\n", storm_of(BOXES, 30));
}

static void a_conveyor_carries_and_hands_over_its_velocity(void **unused)
{
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        rig r;
        double dt = 1 / rig_rates[i];
        tahr_body_desc belt = stage_box(fake_vec(0, 0, -0.25), fake_vec(20, 2, 0.25));
        belt.flags = 0;
        belt.surface_velocity = fake_vec(2, 0, 0);
        belt.pose.orientation = stage_yaw(1.5707963267948966); /* it runs along y in the world */
        rig_open_bodies(&r, &belt, 1, NULL, fake_vec(0, 0, 0.9125));
        rig_step(&r, dt); /* lands */
        while (r.state.mode != TAHR_MODE_WALKING || fabs(r.state.velocity.y) > 0) {
            rig_step(&r, dt);
        }
        double start = r.state.position.y;
        rig_steps(&r, (int)rig_rates[i], dt);
        assert_near(r.state.position.y - start, 2, 1e-9);
        assert_near(r.state.position.x, 0, 1e-9);
        assert_near(r.state.velocity.y, 0, 1e-9);
        r.input.jump = 1;
        rig_step(&r, dt);
        assert_near(r.state.velocity.y, 2, 1e-9);
        rig_close(&r);
    }
}

static void hitting_a_body_with_a_mass_reports_its_push(void **unused)
{
    const double masses[] = {0, 5, 80, 1e6};
    (void)unused;
    for (int k = 0; k < 4; k++) {
        rig r;
        const double dt = 1.0 / 60;
        tahr_body_desc bodies[2] = {stage_ground(), stage_box(fake_vec(2, 0, 1), fake_vec(0.5, 0.5, 1))};
        bodies[1].mass = masses[k];
        rig_open_bodies(&r, bodies, 2, NULL, fake_vec(0, 0, 1));
        rig_settle(&r);
        r.input.move = fake_vec(1, 0, 0);
        const tahr_event *hit = NULL, *push = NULL;
        for (int n = 0; n < 60 && !hit; n++) {
            rig_step(&r, dt);
            hit = rig_event(&r, TAHR_EVENT_HIT);
            push = rig_event(&r, TAHR_EVENT_PUSHED);
        }
        assert_non_null(hit);
        assert_true((push != NULL) == (masses[k] > 0));
        if (push) {
            double reduced = 80 * masses[k] / (80 + masses[k]);
            assert_near(push->value, fmin(hit->value * reduced, 500 * dt), 1e-9);
            assert_near(push->normal.x, -1, 1e-9);
            assert_near(push->position.x, 1.5, 1e-6);
            assert_int_equal(push->body, 1);
        }
        rig_steps(&r, 30, dt); /* leaning against it goes on pushing: 20.48 / 60 m/s more each step, were it not there */
        push = rig_event(&r, TAHR_EVENT_PUSHED);
        assert_true((push != NULL) == (masses[k] > 0));
        if (push) {
            assert_near(push->value, fmin(20.48 * dt * 80 * masses[k] / (80 + masses[k]), 500 * dt), 1e-9);
        }
        rig_close(&r);
    }
}

static void standing_on_a_body_with_a_mass_reports_the_weight(void **unused)
{
    rig r;
    tahr_body_desc slab = stage_box(fake_vec(0, 0, -0.25), fake_vec(5, 5, 0.25));
    (void)unused;
    slab.mass = 20;
    rig_open_bodies(&r, &slab, 1, NULL, fake_vec(0, 0, 1));
    rig_settle(&r);
    rig_step(&r, 1.0 / 60);
    const tahr_event *e = rig_event(&r, TAHR_EVENT_PUSHED);
    assert_non_null(e);
    assert_near(e->value, 80 * 9.81 / 60, 1e-9);
    assert_near(e->normal.z, 1, 1e-12);
    assert_near(e->position.z, 0, 1e-6);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_wall_pushes_a_character_at_any_speed),
        cmocka_unit_test(a_swinging_door_sweeps_a_character_along),
        cmocka_unit_test(a_rising_floor_takes_a_character_up_and_a_press_crushes_it_under_the_ceiling),
        cmocka_unit_test(closing_walls_crush_only_when_they_leave_no_room),
        cmocka_unit_test(a_press_from_above_squeezes_out_who_is_near_its_edge),
        cmocka_unit_test(a_pushed_character_slides_along_what_is_in_the_way),
        cmocka_unit_test(a_floor_that_rises_into_a_falling_character_is_landed_on_at_its_speed),
        cmocka_unit_test(a_box_at_fifty_metres_a_second_does_not_pass_through_a_character),
        cmocka_unit_test(tumbling_boxes_do_not_enter_a_character_unless_they_crush_it),
        cmocka_unit_test(a_conveyor_carries_and_hands_over_its_velocity),
        cmocka_unit_test(hitting_a_body_with_a_mass_reports_its_push),
        cmocka_unit_test(standing_on_a_body_with_a_mass_reports_the_weight)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
