/* SPDX-License-Identifier: MIT
 * test_calm.c: in worlds that hold lifts, shuttles, sensors, pools and conveyors a step with none of them near is taken
 * as if there were none (calm.h), and nothing but its cost shows it. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "core.h"
#include "dice.h"
#include "oracle.h"
#include "rig.h"
#include "throng.h"

static const double DT = 1.0 / 60;

enum { LIFT = 1, SHUTTLE, MOVING_SENSOR, CRATE, POOL, SENSOR, BELT, SPECIALS_END, WALLS = 24 };
enum { BODIES = SPECIALS_END + WALLS, MOVABLES = CRATE, WALKERS = 2 };

static void make_box(tahr_body_desc *b, tahr_vec3 at, tahr_vec3 half, uint32_t flags)
{
    tahr_body_desc_init(b, sizeof *b, TAHR_BODY_BOX);
    b->pose.position = at;
    b->half_extents = half;
    b->flags = flags;
}

/* All that is special lies within 12 m of the origin, walls and ramps within 60 m. */
static void make_scene(tahr_body_desc b[BODIES], oracle_random *random)
{
    make_box(&b[0], (tahr_vec3){0, 0, -1}, (tahr_vec3){300, 300, 1}, 0);
    make_box(&b[LIFT], (tahr_vec3){6, 0, 0.1}, (tahr_vec3){2, 2, 0.2}, TAHR_BODY_MOVABLE);
    make_box(&b[SHUTTLE], (tahr_vec3){0, 6, 1}, (tahr_vec3){1, 2, 0.5}, TAHR_BODY_MOVABLE);
    make_box(&b[MOVING_SENSOR], (tahr_vec3){-5, 0, 1}, (tahr_vec3){1, 1, 1}, TAHR_BODY_MOVABLE | TAHR_BODY_SENSOR);
    make_box(&b[CRATE], (tahr_vec3){3, -3, 0.5}, (tahr_vec3){0.5, 0.5, 0.5}, TAHR_BODY_MOVABLE);
    b[CRATE].mass = 40;
    make_box(&b[POOL], (tahr_vec3){-5, -6, 1}, (tahr_vec3){3, 3, 1}, TAHR_BODY_SENSOR | TAHR_BODY_FLUID);
    make_box(&b[SENSOR], (tahr_vec3){0, 10, 1}, (tahr_vec3){2, 2, 1}, TAHR_BODY_SENSOR);
    make_box(&b[BELT], (tahr_vec3){0, -10, -0.05}, (tahr_vec3){2, 2, 0.1}, 0);
    b[BELT].surface_velocity.x = 1.5;
    for (int i = SPECIALS_END; i < BODIES; i++) {
        make_box(&b[i], dice_vec(random, -60, 60), dice_vec(random, 0.3, 4), 0);
        b[i].pose.position.z = oracle_uniform(random, -2, 3);
        if (i % 2 == 0) { /* a ramp */
            const double turn = oracle_uniform(random, -0.4, 0.4);
            b[i].pose.orientation = (tahr_quat){turn, 0, 0, 1};
            const double size = 1 / sqrt(1 + turn * turn);
            b[i].pose.orientation.x *= size;
            b[i].pose.orientation.w *= size;
        }
    }
}

/* The same world and the same characters twice, with the short ways and without; what is done to both. */
typedef struct course {
    rig on, off;
    tahr_body_desc bodies[BODIES];
    tahr_state state[2][WALKERS], kept[WALKERS];
    tahr_pose pose[BODIES], kept_pose[BODIES];
    tahr_vec3 wish[WALKERS];
    oracle_random random;
    int feels;                  /* 1: has settings of feel, and faces where it goes */
    int quiet;                  /* steps left in which nothing moves and nobody wants to */
    int calm, restless, asleep; /* steps */
} course;

static void feel(tahr_config *c)
{
    c->coyote_time = c->jump_buffer = c->wall_coyote_time = 0.1;
    c->jump_release_gravity = 3;
    c->fall_gravity = 2;
    c->wall_slide_speed = c->wall_jump_speed = 6;
    c->ledge_grab = c->corner_correction = 0.4;
    c->lift_momentum = 0.1;
}

static void open_course(course *c, uint64_t seed)
{
    memset(c, 0, sizeof *c);
    c->random = (oracle_random){seed};
    make_scene(c->bodies, &c->random);
    tahr_config config = rig_config();
    c->feels = seed % 2 == 0;
    if (c->feels) {
        feel(&config);
    }
    rig_open_bodies(&c->on, c->bodies, BODIES, &config, (tahr_vec3){20, 0, 2});
    config.short_ways = 0;
    rig_open_bodies(&c->off, c->bodies, BODIES, &config, (tahr_vec3){20, 0, 2});
    for (int i = 0; i < BODIES; i++) {
        c->pose[i] = c->kept_pose[i] = c->bodies[i].pose;
    }
    for (int w = 0; w < WALKERS; w++) {
        c->state[0][w] = c->on.state;
        c->state[0][w].position.y = 4.0 * w;
        c->state[1][w] = c->kept[w] = c->state[0][w];
    }
}

static void close_course(course *c)
{
    rig_close(&c->on);
    rig_close(&c->off);
}

static int chance(course *c, double part)
{
    return oracle_uniform(&c->random, 0, 1) < part;
}

/* Both worlds: a motion, or, with dt 0, a placement. */
static void place_both(course *c, const tahr_body_pose *poses, uint32_t count, double dt)
{
    tahr_world *worlds[2] = {c->on.world, c->off.world};
    for (int i = 0; i < 2; i++) {
        tahr_status status =
            dt > 0 ? tahr_world_move(worlds[i], poses, count, dt) : tahr_world_set(worlds[i], poses, count);
        assert_int_equal(status, TAHR_OK);
    }
    for (uint32_t i = 0; i < count; i++) {
        c->pose[poses[i].body] = poses[i].pose;
    }
}

static tahr_body_pose moved(course *c, uint32_t body, double by)
{
    tahr_body_pose p = {.body = body, .pose = c->pose[body]};
    p.pose.position.x += oracle_uniform(&c->random, -by, by);
    p.pose.position.y += oracle_uniform(&c->random, -by, by);
    p.pose.position.z = oracle_uniform(&c->random, 0, 1) < 0.5 ? p.pose.position.z : c->bodies[body].pose.position.z;
    const tahr_vec3 at = p.pose.position;
    if (at.x * at.x + at.y * at.y > 12 * 12) {
        p.pose.position = c->bodies[body].pose.position;
    }
    return p;
}

/* Next to who walks there, or onto him. */
static tahr_body_pose beside(course *c, uint32_t body)
{
    tahr_body_pose p = {.body = body, .pose = c->pose[body]};
    const tahr_vec3 at = c->state[0][chance(c, 0.5)].position, off = dice_vec(&c->random, -3, 3);
    p.pose.position = (tahr_vec3){at.x + off.x, at.y + off.y, at.z + off.z};
    return p;
}

static void move_bodies(course *c)
{
    tahr_body_pose poses[2 * MOVABLES];
    uint32_t count = 0;
    for (uint32_t body = LIFT; body <= MOVABLES; body++) {
        if (chance(c, 0.7)) {
            poses[count++] = moved(c, body, 0.05);
        }
        if (chance(c, 0.002)) { /* named once more, and far */
            poses[count++] = beside(c, body);
            poses[count - 1].flags = chance(c, 0.5) ? TAHR_POSE_TELEPORT : 0;
        }
    }
    place_both(c, poses, count, DT);
}

static void disturb(course *c)
{
    if (c->quiet > 0 || chance(c, 0.004)) {
        c->quiet = c->quiet > 0 ? c->quiet - 1 : 90;
        return;
    }
    if (chance(c, 0.8)) {
        move_bodies(c);
    }
    if (chance(c, 0.1)) {
        move_bodies(c);
    }
    if (chance(c, 0.003)) {
        const tahr_body_pose p = beside(c, LIFT + (uint32_t)(oracle_uniform(&c->random, 0, 1) * MOVABLES));
        place_both(c, &p, 1, 0);
    }
    if (chance(c, 0.01)) { /* what went astray comes back */
        for (uint32_t body = LIFT; body <= MOVABLES; body++) {
            const tahr_body_pose p = {.body = body, .flags = 0, .pose = c->bodies[body].pose};
            place_both(c, &p, 1, chance(c, 0.5) ? DT : 0);
        }
    }
    if (chance(c, 0.001)) {
        assert_int_equal(tahr_world_touch(c->on.world), TAHR_OK);
        assert_int_equal(tahr_world_touch(c->off.world), TAHR_OK);
    }
}

/* Keeps, or goes back to what was kept: the states alone, or with the bodies. */
static void roll_back(course *c)
{
    if (c->quiet > 0) {
        return;
    }
    if (chance(c, 0.02)) {
        memcpy(c->kept, c->state[0], sizeof c->kept);
        memcpy(c->kept_pose, c->pose, sizeof c->kept_pose);
    }
    if (!chance(c, 0.01)) {
        return;
    }
    memcpy(c->state[0], c->kept, sizeof c->kept);
    memcpy(c->state[1], c->kept, sizeof c->kept);
    for (uint32_t body = LIFT; body <= MOVABLES && chance(c, 0.9); body++) {
        const tahr_body_pose p = {.body = body, .flags = 0, .pose = c->kept_pose[body]};
        place_both(c, &p, 1, chance(c, 0.5) ? DT : 0);
    }
}

static tahr_input input_for(course *c, int w)
{
    const tahr_vec3 at = c->state[0][w].position;
    if (c->quiet > 0) {
        return (tahr_input){.struct_size = sizeof(tahr_input)};
    }
    if (chance(c, 0.02)) {
        const double home = chance(c, 0.4) ? 1 : 0;
        c->wish[w] = dice_direction(&c->random);
        c->wish[w].z = 0;
        c->wish[w].x -= home * at.x / 20;
        c->wish[w].y -= home * at.y / 20;
        c->wish[w] = chance(c, 0.1) ? (tahr_vec3){0, 0, 0} : c->wish[w];
    }
    tahr_input in = {.struct_size = sizeof in, .move = c->wish[w]};
    in.jump = (uint32_t)chance(c, c->feels ? 0.1 : 0.02);
    in.flags = c->feels && chance(c, 0.5) ? TAHR_INPUT_FACING : 0;
    in.facing = in.move;
    if (chance(c, 0.01)) {
        in.flags |= TAHR_INPUT_LAUNCH;
        in.launch = dice_vec(&c->random, -8, 8);
    }
    return in;
}

static void step_both(course *c, int w)
{
    const tahr_input in = input_for(c, w);
    const double dt = c->quiet == 0 && chance(c, 0.05) ? oracle_uniform(&c->random, 0, 0.1) : DT;
    tahr_report on = {.struct_size = sizeof on}, off = on;
    tahr_state *a = &c->state[0][w], *b = &c->state[1][w];
    const tahr_status is = tahr_mover_step(c->on.mover, &in, dt, a, &on);
    const tahr_status was = tahr_mover_step(c->off.mover, &in, dt, b, &off);
    assert_int_equal(is, was);
    assert_true(is >= 0);
    assert_memory_equal(a, b, sizeof *a);
    assert_int_equal(on.flags, off.flags);
    assert_true(on.residual == off.residual && on.step_offset == off.step_offset && on.time_lost == off.time_lost);
    c->calm += on.saved[TAHR_SHORTCUT_CALM] > 0;
    assert_int_equal(off.saved[TAHR_SHORTCUT_CALM], 0);
    assert_true(!on.saved[TAHR_SHORTCUT_CALM] || on.fluid_queries == 0);
    c->asleep += (on.flags & TAHR_REPORT_ASLEEP) != 0;
    c->restless += on.fluid_queries > 0;
}

static void short_ways_never_show_among_bodies_that_move(void **unused)
{
    (void)unused;
    static course c;
    int calm = 0, restless = 0, asleep = 0;
    for (uint64_t seed = 1; seed <= 10; seed++) {
        open_course(&c, seed);
        for (int i = 0; i < 1500; i++) {
            disturb(&c);
            roll_back(&c);
            for (int w = 0; w < (c.quiet > 0 ? 1 : WALKERS); w++) { /* a mover remembers one sleeper */
                step_both(&c, w);
            }
        }
        close_course(&c);
        calm += c.calm;
        restless += c.restless;
        asleep += c.asleep;
    }
    print_message("    %d steps calm, %d restless, %d asleep\n", calm, restless, asleep);
    assert_true(calm > 2000 && restless > 2000 && asleep > 100);
}

/* Who walks on a flat floor, or falls above it, takes the same looks with a body 500 m away and without. */
static void assert_spared(uint32_t flags, double surface_speed, double height)
{
    tahr_body_desc bodies[2];
    rig with, without;
    uint64_t spared = 0, sweeps = 0, calm = 0;
    make_box(&bodies[0], (tahr_vec3){0, 0, -1}, (tahr_vec3){2000, 2000, 1}, 0);
    make_box(&bodies[1], (tahr_vec3){0, 500, 1}, (tahr_vec3){1, 1, 1}, flags);
    bodies[1].surface_velocity.x = surface_speed;
    const tahr_config config = rig_config();
    rig_open_bodies(&with, bodies, 2, &config, (tahr_vec3){0, 0, height});
    rig_open_bodies(&without, bodies, 1, &config, (tahr_vec3){0, 0, height});
    with.input.move = without.input.move = (tahr_vec3){1, 0, 0};
    for (int i = 0; i < 240; i++) {
        tahr_body_pose p = {.body = 1, .pose = bodies[1].pose};
        p.pose.position.x = 0.02 * (i % 50);
        if (flags & TAHR_BODY_MOVABLE) {
            assert_int_equal(tahr_world_move(with.world, &p, 1, DT), TAHR_OK);
        }
        tahr_report a = {.struct_size = sizeof a}, b = a;
        assert_int_equal(tahr_mover_step(with.mover, &with.input, DT, &with.state, &a), TAHR_OK);
        assert_int_equal(tahr_mover_step(without.mover, &without.input, DT, &without.state, &b), TAHR_OK);
        assert_int_equal(a.fluid_queries, 0);
        assert_int_equal(a.sweeps, b.sweeps);
        calm += a.saved[TAHR_SHORTCUT_CALM];
        a.saved[TAHR_SHORTCUT_CALM] = 0;
        assert_memory_equal(a.saved, b.saved, sizeof a.saved);
        assert_int_equal(a.triangle_tests, b.triangle_tests);
        assert_memory_equal(&with.state, &without.state, offsetof(tahr_state, floor_revision));
        spared += a.saved[TAHR_SHORTCUT_KNOWN_FLOOR] + a.saved[TAHR_SHORTCUT_CLEAR_AIR];
        sweeps += a.sweeps;
    }
    assert_true(10 * spared > 8 * sweeps && calm == 240);
    rig_close(&with);
    rig_close(&without);
}

static void a_step_far_from_all_that_is_special_is_as_short_as_in_a_world_without(void **unused)
{
    (void)unused;
    static const uint32_t flags[] = {TAHR_BODY_MOVABLE, TAHR_BODY_SENSOR, TAHR_BODY_SENSOR | TAHR_BODY_FLUID, 0,
                                     TAHR_BODY_MOVABLE | TAHR_BODY_SENSOR};
    for (size_t i = 0; i < sizeof flags / sizeof flags[0]; i++) {
        assert_spared(flags[i], flags[i] ? 0 : 1, 1);    /* on the floor */
        assert_spared(flags[i], flags[i] ? 0 : 1, 1000); /* in the air */
    }
}

/* A refused step leaves the state as it was, also what bodies far away would have changed in it. */
static void what_is_refused_is_left_as_it_was(void **unused)
{
    (void)unused;
    tahr_body_desc bodies[2];
    rig r;
    make_box(&bodies[0], (tahr_vec3){0, 0, -1}, (tahr_vec3){2000, 2000, 1}, 0);
    make_box(&bodies[1], (tahr_vec3){0, 500, 1}, (tahr_vec3){1, 1, 1}, TAHR_BODY_MOVABLE);
    const tahr_config config = rig_config();
    rig_open_bodies(&r, bodies, 2, &config, (tahr_vec3){0, 0, 1});
    rig_steps(&r, 120, DT);
    for (int i = 0; i < 4; i++) {
        tahr_body_pose p = {.body = 1, .pose = bodies[1].pose};
        p.pose.position.x = 0.02 * (i + 1);
        assert_int_equal(tahr_world_move(r.world, &p, 1, DT), TAHR_OK);
        const tahr_state before = r.state;
        tahr_input bad = r.input;
        bad.move.x = i == 0 ? NAN : 0;
        bad.reserved = i == 1;
        bad.flags = i == 2 ? 1u << 31 : 0;
        assert_true(tahr_mover_step(r.mover, &bad, i == 3 ? -DT : DT, &r.state, NULL) < 0);
        assert_memory_equal(&r.state, &before, sizeof before);
        const tahr_status status = tahr_mover_step(r.mover, &r.input, DT, &r.state, NULL);
        assert_int_equal(status, TAHR_OK);
        assert_true(r.state.base.seen != before.base.seen);
    }
    rig_close(&r);
}

/* A crowd among them, with the short ways and without. */
static void open_throng(throng *t, const tahr_body_desc *bodies, int short_ways, uint32_t flags)
{
    enum { COUNT = 40 };
    throng_open(t, bodies, BODIES);
    t->config.short_ways = (uint32_t)short_ways;
    t->desc.flags |= flags;
    throng_make(t, COUNT);
    for (uint32_t i = 0; i < COUNT; i++) {
        throng_place(t, i, 3.0 * (i % 8) - 10 + 30 * (i % 3), 2.5 * (i / 8) - 6);
        throng_go(t, i, i % 2 ? -0.7 : 0.5, i % 5 ? 0.3 : -0.4);
    }
}

static void assert_crowds_alike(uint32_t flags)
{
    static tahr_body_desc bodies[BODIES];
    oracle_random random = {7};
    throng on, off;
    make_scene(bodies, &random);
    open_throng(&on, bodies, 1, flags);
    open_throng(&off, bodies, 0, flags);
    for (int i = 0; i < 240; i++) {
        tahr_body_pose p = {.body = LIFT + (uint32_t)i % MOVABLES, .pose = bodies[LIFT + i % MOVABLES].pose};
        p.pose.position.x += 0.03 * (i % 90);
        assert_int_equal(tahr_world_move(on.world, &p, 1, DT), TAHR_OK);
        assert_int_equal(tahr_world_move(off.world, &p, 1, DT), TAHR_OK);
        assert_int_equal(throng_step(&on), throng_step(&off));
        assert_true(throng_hash(&on) == throng_hash(&off));
    }
    throng_close(&on);
    throng_close(&off);
}

static void nor_in_a_crowd(void **unused)
{
    (void)unused;
    assert_crowds_alike(0);
    assert_crowds_alike(TAHR_CROWD_LEAN);
}

/* On a floor with a plate 10 cm above it, which is put there, and away again. */
static void what_is_known_of_a_place_holds_no_body_that_moves(void **unused)
{
    (void)unused;
    tahr_body_desc bodies[2];
    rig r;
    make_box(&bodies[0], (tahr_vec3){0, 0, -1}, (tahr_vec3){2000, 2000, 1}, 0);
    make_box(&bodies[1], (tahr_vec3){0, 500, 0.05}, (tahr_vec3){1, 1, 0.05}, TAHR_BODY_MOVABLE);
    const tahr_config config = rig_config();
    rig_open_bodies(&r, bodies, 2, &config, (tahr_vec3){0, 0, 1});
    rig_steps(&r, 60, DT);
    r.input.move = (tahr_vec3){1, 0, 0};
    rig_steps(&r, 120, DT);
    for (int i = 0; i < 3; i++) {
        tahr_body_pose p = {.body = 1, .pose = bodies[1].pose};
        p.pose.position.x = r.state.position.x;
        p.pose.position.y = i == 1 ? 0 : 500;
        assert_int_equal(tahr_world_set(r.world, &p, 1), TAHR_OK);
        tahr_query_context context = {.cache = r.mover->cache};
        const tahr__pace *pace = &r.mover->pace;
        tahr_shape foot = r.mover->limits.foot.shape;
        const tahr_vec3 from = {r.state.position.x, r.state.position.y, r.state.position.z + 0.3};
        const tahr_vec3 foot_from = {from.x + 0.01, from.y, from.z + pace->foot};
        const tahr_walk walk = {.shape = &r.mover->limits.shape,
                                .foot = &foot,
                                .position = from,
                                .motion = {0.01, 0, 0},
                                .foot_position = foot_from,
                                .foot_motion = {0, 0, -0.6},
                                .up = {0, 0, 1},
                                .margin = config.skin,
                                .mask = config.mask};
        tahr_hit hit = {0};
        uint32_t known = 0;
        assert_int_equal(r.world->backend->walk(r.world->self, &context, &walk, &hit, &known), TAHR_OK);
        assert_int_equal(known, i != 1);
        const tahr_sweep sweep = {.shape = foot,
                                  .position = foot_from,
                                  .orientation = {0, 0, 0, 1},
                                  .motion = {0, 0, -0.6},
                                  .up = {0, 0, 1},
                                  .margin = config.skin,
                                  .mask = config.mask,
                                  .ignore_body = TAHR_NO_BODY};
        uint32_t count = 0;
        assert_int_equal(r.world->backend->sweep(r.world->self, &context, &sweep, &hit, 1, &count), TAHR_OK);
        assert_int_equal(count, 1);
        assert_int_equal(hit.body, i == 1);
    }
    rig_close(&r);
}

/* Who is put back to where a lift was, which has been put away and moves there: the state says that it stands on it. */
static void who_says_that_he_stands_on_a_lift_is_carried_by_it_however_far_it_is(void **unused)
{
    (void)unused;
    tahr_state end[2];
    for (int i = 0; i < 2; i++) {
        tahr_body_desc bodies[2];
        rig r;
        make_box(&bodies[0], (tahr_vec3){0, 0, -1}, (tahr_vec3){2000, 2000, 1}, 0);
        make_box(&bodies[1], (tahr_vec3){0, 0, 0.05}, (tahr_vec3){1, 1, 0.05}, TAHR_BODY_MOVABLE);
        tahr_config config = rig_config();
        config.short_ways = i == 0;
        rig_open_bodies(&r, bodies, 2, &config, (tahr_vec3){0, 0, 1.2});
        rig_steps(&r, 60, DT);
        assert_int_equal(r.state.floor.body, 1);
        tahr_body_pose p = {.body = 1, .pose = bodies[1].pose};
        p.pose.position.y = 500;
        assert_int_equal(tahr_world_set(r.world, &p, 1), TAHR_OK);
        p.pose.position.y += 0.1;
        assert_int_equal(tahr_world_move(r.world, &p, 1, DT), TAHR_OK);
        assert_int_equal(tahr_mover_step(r.mover, &r.input, DT, &r.state, NULL), TAHR_OK);
        end[i] = r.state;
        rig_close(&r);
    }
    assert_memory_equal(&end[0], &end[1], sizeof end[0]);
    assert_true(end[0].position.y > 0.05 || end[0].velocity.y > 0.05); /* carried 0.1 m, or let go at 6 m/s */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(short_ways_never_show_among_bodies_that_move),
        cmocka_unit_test(nor_in_a_crowd),
        cmocka_unit_test(what_is_known_of_a_place_holds_no_body_that_moves),
        cmocka_unit_test(who_says_that_he_stands_on_a_lift_is_carried_by_it_however_far_it_is),
        cmocka_unit_test(a_step_far_from_all_that_is_special_is_as_short_as_in_a_world_without),
        cmocka_unit_test(what_is_refused_is_left_as_it_was),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
