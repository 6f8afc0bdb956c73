/* SPDX-License-Identifier: MIT
 * test_storm.c: boxes that fly about a character at up to 50 m/s: never in it, never through it, nothing pressed into
 * the floor. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "stage.h"

static const tahr_quat LEVEL = {0, 0, 0, 1};

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
    s->bodies[0] = stage_box(fake_vec(0, 0, -0.02), fake_vec(2e4, 2e4, 0.02)); /* thin: nothing may be pressed
                                                                                * through */
    s->bodies[0].flags = 0;
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_box_at_fifty_metres_a_second_does_not_pass_through_a_character),
        cmocka_unit_test(tumbling_boxes_do_not_enter_a_character_unless_they_crush_it)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
