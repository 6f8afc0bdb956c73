/* SPDX-License-Identifier: MIT
 * test_quick_step.c: what makes most steps cheap (a walk the short way, a sleeper that is not computed, what is
 * remembered of a wish) sees every bit that it is given: a mover with it and one without it do the same with whatever
 * is changed between two steps, and refuse the same. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "oracle.h"
#include "ready.h"
#include "rig.h"
#include "short_way.h"
#include "vec.h"

static const double DT = 1.0 / 60;

/* 200 m each way, to either side of an axis: the way along which it slopes. */
static const double CORNERS[12] = {-100, -100, 0, 100, -100, 0, 100, 100, 0, -100, 100, 0};
static const uint32_t TRIANGLES[6] = {0, 1, 2, 0, 2, 3};

static void make_sheet(tahr_body_desc *b)
{
    tahr_body_desc_init(b, sizeof *b, TAHR_BODY_MESH);
    b->vertices = CORNERS;
    b->indices = TRIANGLES;
    b->vertex_count = 4;
    b->triangle_count = 2;
}

/* The same character twice, on a box of 200 m, or a sheet that slopes by an angle, maybe within a sensor: with all
 * shortcuts and with none. */
typedef struct pair {
    rig on, off;
    tahr_body_desc bodies[2];
} pair;

static void open_pair_with(pair *p, tahr_config config, int senses, double slope)
{
    const tahr_vec3 at = {0, 0, config.shape.half_height + (slope > 0 ? 0.3 : 0.02)};
    for (int i = 0; i < 2; i++) {
        tahr_body_desc_init(&p->bodies[i], sizeof p->bodies[i], TAHR_BODY_BOX);
        p->bodies[i].half_extents = (tahr_vec3){100, 100, 1};
        p->bodies[i].pose.position.z = i - 1;
        if (i == 0 && slope > 0) {
            make_sheet(&p->bodies[0]);
            p->bodies[0].pose.orientation = (tahr_quat){0, sin(0.5 * slope), 0, cos(0.5 * slope)};
        }
    }
    p->bodies[1].flags = TAHR_BODY_SENSOR;
    rig_open_bodies(&p->on, p->bodies, senses ? 2 : 1, &config, at);
    config.short_ways = config.sleep = 0;
    rig_open_bodies(&p->off, p->bodies, senses ? 2 : 1, &config, at);
}

static void open_pair_on(pair *p, int senses, double slope)
{
    open_pair_with(p, rig_config(), senses, slope);
}

static tahr_config feel_config(void)
{
    tahr_config config = rig_config();
    config.coyote_time = config.jump_buffer = config.wall_coyote_time = 0.1;
    config.jump_release_gravity = 3;
    config.fall_gravity = 1.5;
    config.wall_slide_speed = config.wall_jump_speed = 3;
    config.ledge_grab = config.corner_correction = 0.25;
    return config;
}

static void open_pair(pair *p, int senses)
{
    open_pair_on(p, senses, 0);
}

static void close_pair(pair *p)
{
    rig_close(&p->on);
    rig_close(&p->off);
}

/* Steps of the first, until it is under way, or asleep. */
static void settle(pair *p, tahr_vec3 move, tahr_state *state)
{
    *state = p->on.state;
    p->on.input.move = move;
    for (int i = 0; i < 120; i++) {
        assert_int_equal(tahr_mover_step(p->on.mover, &p->on.input, DT, state, NULL), TAHR_OK);
    }
}

/* Both take a step from there, the first right after one from `good`; and end alike. */
static tahr_status assert_alike(pair *p, const tahr_state *good, const tahr_state *state, const tahr_input *input,
                                int with_report)
{
    tahr_state a = *good, b = *state;
    tahr_report ra = {.struct_size = sizeof ra}, rb = ra;
    for (int i = 0; i < 2; i++) {
        assert_int_equal(tahr_mover_step(p->on.mover, &p->on.input, DT, &a, NULL), TAHR_OK);
        a = *good;
    }
    p->on.mover->short_way = (tahr__backoff){0, 0}; /* it tries the short way */
    a = *state;
    p->on.log.text[0] = p->off.log.text[0] = 0;
    tahr_status is = tahr_mover_step(p->on.mover, input, DT, &a, with_report ? &ra : NULL);
    tahr_status was = tahr_mover_step(p->off.mover, input, DT, &b, with_report ? &rb : NULL);
    assert_int_equal(is, was);
    assert_memory_equal(&a, &b, sizeof a);
    assert_string_equal(p->on.log.text, p->off.log.text);
    if (with_report) {
        assert_int_equal(ra.flags & ~(uint32_t)TAHR_REPORT_ASLEEP, rb.flags & ~(uint32_t)TAHR_REPORT_ASLEEP);
        assert_true(ra.residual == rb.residual && ra.step_offset == rb.step_offset && ra.time_lost == rb.time_lost);
    }
    if (is < 0) {
        assert_memory_equal(&a, state, sizeof a);
    }
    return is;
}

/* Each bit of a state turned round, one by one. */
static void assert_every_bit_counts(pair *p, const tahr_state *good)
{
    int refused = 0;
    for (size_t bit = 0; bit < 8 * sizeof *good; bit++) {
        tahr_state changed = *good;
        ((unsigned char *)&changed)[bit / 8] ^= (unsigned char)(1u << bit % 8);
        refused += assert_alike(p, good, &changed, &p->on.input, bit % 2 == 0) < 0;
    }
    print_message("    %d of %d refused\n", refused, (int)(8 * sizeof *good));
    assert_true(refused > 8 * 40); /* the reserved bytes at least */
}

/* With 32-byte vectors, where the processor has them, and without; on a level, and on a slope of 29 degrees; with the
 * settings of feel, and without. */
static void every_bit_of_who_walks_is_seen(void **unused)
{
    for (int way = 0; way < 6; way++) {
        pair p;
        tahr_state good, end;
        (void)unused;
        open_pair_with(&p, way & 4 ? feel_config() : rig_config(), 0, way & 2 ? 0.5 : 0);
        p.on.mover->wide = way & 1 ? 0 : p.on.mover->wide;
        settle(&p, (tahr_vec3){0.5, 0.25, 0}, &good);
        end = good;
        assert_true(tahr__stroll(p.on.mover, &p.on.input, DT, &end, NULL));
        assert_true(ready_to_walk(p.on.mover, &p.on.input, DT, &good, NULL)); /* that is what is tried */
        assert_every_bit_counts(&p, &good);
        close_pair(&p);
    }
}

/* Far above the box, with the jump button up and down, and with the settings of feel and without. */
static void every_bit_of_who_falls_is_seen(void **unused)
{
    for (int way = 0; way < 8; way++) {
        pair p;
        tahr_state good, end;
        (void)unused;
        open_pair_with(&p, way & 4 ? feel_config() : rig_config(), 0, 0);
        p.on.state.position = (tahr_vec3){0, 0, 400};
        p.on.input.jump = (uint32_t)(way & 1);
        p.on.mover->wide = way & 2 ? 0 : p.on.mover->wide;
        settle(&p, (tahr_vec3){0.5, 0.25, 0}, &good);
        end = good;
        assert_true(tahr__plummet(p.on.mover, &p.on.input, DT, &end, NULL));
        assert_int_equal(good.mode, TAHR_MODE_FALLING);
        assert_true(ready_to_fall(p.on.mover, &p.on.input, DT, &good, NULL)); /* that is what is tried */
        assert_every_bit_counts(&p, &good);
        close_pair(&p);
    }
}

/* Who walks, and who falls: a report that wants to see decisions or queries gets all of them, one of another size is
 * refused, and one with room for events is told of none. */
static void what_a_report_asks_for_is_seen(void **unused)
{
    (void)unused;
    for (int falls = 0; falls < 2; falls++) {
        tahr_decision decisions[2][64];
        tahr_query_record queries[2][64];
        tahr_event events[4];
        pair p;
        tahr_state good;
        open_pair(&p, 0);
        p.on.state.position.z += falls ? 400 : 0;
        settle(&p, (tahr_vec3){0.5, 0.25, 0}, &good);
        for (int what = 0; what < 4; what++) {
            tahr_state ends[2] = {good, good};
            tahr_report r[2] = {{.struct_size = sizeof r[0]}, {.struct_size = sizeof r[0]}};
            tahr_status is[2];
            for (int k = 0; k < 2; k++) {
                tahr_state before = good;
                r[k].decisions = what == 0 ? decisions[k] : NULL;
                r[k].queries = what == 1 ? queries[k] : NULL;
                r[k].decision_capacity = r[k].query_capacity = 64;
                r[k].struct_size = what == 2 ? 8 : sizeof r[k];
                r[k].events = what == 3 ? events : NULL;
                r[k].event_capacity = 4;
                tahr_mover *mover = k ? p.off.mover : p.on.mover;
                assert_int_equal(tahr_mover_step(mover, &p.on.input, DT, &before, NULL), TAHR_OK);
                is[k] = tahr_mover_step(mover, &p.on.input, DT, &ends[k], &r[k]);
            }
            assert_int_equal(is[0], is[1]);
            assert_int_equal(is[0], what == 2 ? TAHR_E_STRUCT_SIZE : TAHR_OK);
            assert_memory_equal(&ends[0], &ends[1], sizeof good);
            assert_int_equal(r[0].decision_count, r[1].decision_count);
            assert_int_equal(r[0].query_count, r[1].query_count);
            assert_int_equal(r[0].query_count > 0, what == 1);
            assert_int_equal(r[0].event_count, 0);
            assert_true(what == 2 || r[0].event_capacity == (what == 3 ? 4 : 0));
        }
        close_pair(&p);
    }
}

static void is_asleep(pair *p, const tahr_state *good)
{
    tahr_state end = *good;
    tahr_report report = {.struct_size = sizeof report};
    for (int i = 0; i < 2; i++) {
        assert_int_equal(tahr_mover_step(p->on.mover, &p->on.input, DT, &end, &report), TAHR_OK);
        assert_memory_equal(&end, good, sizeof end);
    }
    assert_true(report.flags & TAHR_REPORT_ASLEEP);
}

/* With 32-byte vectors, where the processor has them, and without; of who remembers nothing, and of who is in a
 * sensor. */
static void every_bit_of_who_sleeps_is_seen(void **unused)
{
    (void)unused;
    for (int way = 0; way < 4; way++) {
        pair p;
        tahr_state good;
        open_pair(&p, way & 1);
        p.on.mover->sleep.wide = way & 2 ? 0 : p.on.mover->sleep.wide;
        settle(&p, (tahr_vec3){0, 0, 0}, &good);
        is_asleep(&p, &good);
        assert_int_equal(p.on.mover->sleep.blank, !(way & 1));
        assert_every_bit_counts(&p, &good);
        close_pair(&p);
    }
}

/* Of an input all that counts without a flag, and the flags. */
static void every_bit_of_an_input_is_seen(void **unused)
{
    (void)unused;
    for (int walks = 0; walks < 2; walks++) {
        pair p;
        tahr_state good;
        int refused = 0;
        open_pair(&p, 0);
        settle(&p, (tahr_vec3){0.5 * walks, 0.25 * walks, 0}, &good);
        for (size_t bit = 0; bit < 8 * sizeof p.on.input; bit++) {
            const size_t byte = bit / 8;
            tahr_input changed = p.on.input;
            if (byte >= 4 && byte < offsetof(tahr_input, reserved)) {
                changed.gravity = (tahr_vec3){0, 0, -9.81};
                changed.facing = (tahr_vec3){0, 1, 0};
                changed.radius = 0.35, changed.half_height = 0.9;
            }
            ((unsigned char *)&changed)[byte] ^= (unsigned char)(1u << bit % 8);
            if (byte >= 4) { /* what lies behind a longer input is nobody's */
                refused += assert_alike(&p, &good, &good, &changed, bit % 2 == 0) < 0;
            }
        }
        assert_true(refused >= 32 + 20); /* input.reserved, and the flags that are none */
        close_pair(&p);
    }
}

typedef struct field {
    const char *name;
    size_t at;
    double bad; /* out of range */
} field;

#define FIELD(name, member, bad)                         \
    {                                                    \
        "state." name, offsetof(tahr_state, member), bad \
    }

/* Numbers of a state as mover.h and arguments.c give their ranges; and each not finite. */
static void what_is_wrong_in_who_walks_is_named(void **unused)
{
    static const field fields[] = {FIELD("position", position.x, 2.1e7),
                                   FIELD("position", position.y, -2.1e7),
                                   FIELD("position", position.z, 2.1e7),
                                   FIELD("velocity", velocity.x, 1.1e5),
                                   FIELD("velocity", velocity.y, 1.1e5),
                                   FIELD("velocity", velocity.z, -1.1e5),
                                   FIELD("orientation", orientation.x, 0.01),
                                   FIELD("orientation", orientation.y, 0.01),
                                   FIELD("orientation", orientation.z, 1),
                                   FIELD("orientation", orientation.w, 1.001),
                                   FIELD("up", up.x, 0.001),
                                   FIELD("up", up.y, 0.001),
                                   FIELD("up", up.z, 0.999),
                                   FIELD("floor.normal", floor.normal.x, 0.1),
                                   FIELD("floor.normal", floor.normal.y, 0.1),
                                   FIELD("floor.normal", floor.normal.z, 0.9),
                                   FIELD("floor.surface_normal", floor.surface_normal.x, 0.1),
                                   FIELD("floor.surface_normal", floor.surface_normal.y, 0.1),
                                   FIELD("floor.surface_normal", floor.surface_normal.z, 1.1),
                                   FIELD("floor.point", floor.point.x, 1.1e8),
                                   FIELD("floor.point", floor.point.y, 1.1e8),
                                   FIELD("floor.point", floor.point.z, 1.1e8),
                                   FIELD("floor.distance", floor.distance, 1.1e8),
                                   FIELD("floor.perch_distance", floor.perch_distance, -1.1e8),
                                   FIELD("floor_position", floor_position.x, 1.1e8),
                                   FIELD("floor_position", floor_position.y, 1.1e8),
                                   FIELD("floor_position", floor_position.z, 1.1e8),
                                   FIELD("jump_hold", jump_hold, -1e-9)};
    pair p;
    tahr_state good;
    (void)unused;
    open_pair(&p, 0);
    settle(&p, (tahr_vec3){0.5, 0.25, 0}, &good);
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; i++) {
        const double bad[] = {NAN, INFINITY, -INFINITY, fields[i].bad};
        for (int k = 0; k < 4; k++) {
            tahr_state wrong = good;
            memcpy((char *)&wrong + fields[i].at, &bad[k], sizeof bad[k]);
            assert_int_equal(assert_alike(&p, &good, &wrong, &p.on.input, k % 2), TAHR_E_ARGUMENT);
            if (!strstr(p.on.log.text, fields[i].name)) {
                fail_msg("%s: \"%s\"", fields[i].name, p.on.log.text);
            }
        }
    }
    for (int k = 0; k < 12; k++) {
        const double bad[] = {NAN, INFINITY, -INFINITY, 1.1e6};
        tahr_input wrong = p.on.input;
        memcpy((char *)&wrong.move + 8 * (k / 4), &bad[k % 4], sizeof bad[0]);
        assert_int_equal(assert_alike(&p, &good, &good, &wrong, k % 2), TAHR_E_ARGUMENT);
        assert_non_null(strstr(p.on.log.text, "input.move"));
    }
    close_pair(&p);
}

/* In a world without gravity nothing says which way is up; but it has to be a direction. */
static void without_gravity_up_is_still_checked(void **unused)
{
    tahr_body_desc ground;
    tahr_config config = rig_config();
    rig r;
    (void)unused;
    config.gravity = (tahr_vec3){0, 0, 0};
    tahr_body_desc_init(&ground, sizeof ground, TAHR_BODY_BOX);
    ground.half_extents = (tahr_vec3){9, 9, 1};
    rig_open_bodies(&r, &ground, 1, &config, (tahr_vec3){0, 0, 3});
    r.state.up = (tahr_vec3){0, 0, 0};
    assert_int_equal(tahr_mover_step(r.mover, &r.input, DT, &r.state, NULL), TAHR_E_ARGUMENT);
    assert_non_null(strstr(r.log.text, "state.up"));
    rig_close(&r);
}

/* One mover, two characters in turn, with wishes and lengths of steps that change: what it remembers of one is not
 * taken for the other. */
static void a_mover_remembers_no_wish_of_another(void **unused)
{
    pair p;
    tahr_state on[2], off[2];
    oracle_random dice = {11};
    const double lengths[] = {1.0 / 60, 1.0 / 30, 1.0 / 144, 1e-3};
    tahr_vec3 moves[2] = {{0.5, 0, 0}, {0, 0.5, 0}};
    double dt = DT;
    (void)unused;
    open_pair(&p, 0);
    settle(&p, (tahr_vec3){0, 0, 0}, &on[0]);
    on[1] = off[0] = off[1] = on[0];
    for (int n = 0; n < 4000; n++) {
        const int who = n % 2;
        if (oracle_below(&dice, 12) == 0) {
            const double a = oracle_uniform(&dice, 0, 6.2831853), size = oracle_uniform(&dice, 0, 1.2);
            moves[oracle_below(&dice, 2)] = (tahr_vec3){size * cos(a), size * sin(a), oracle_uniform(&dice, -1, 1)};
            dt = oracle_below(&dice, 3) ? dt : lengths[oracle_below(&dice, 4)];
        }
        p.on.input.move = p.off.input.move = moves[who];
        assert_int_equal(tahr_mover_step(p.on.mover, &p.on.input, dt, &on[who], NULL), TAHR_OK);
        assert_int_equal(tahr_mover_step(p.off.mover, &p.off.input, dt, &off[who], NULL), TAHR_OK);
        assert_memory_equal(&on[who], &off[who], sizeof on[who]);
        if (fabs(on[who].position.x) > 60 || fabs(on[who].position.y) > 60) {
            moves[who] = (tahr_vec3){-on[who].position.x / 60, -on[who].position.y / 60, 0};
        }
    }
    close_pair(&p);
}

enum { CHARACTERS = 4 };

/* A level ground and two slopes of 14 and 27 degrees that come out of it; four characters, one on the ground, one over
 * each slope, and the last high up. axis: 0: up is +z, 1: +x, and the level is turned likewise. */
static void open_slopes(rig *r, const tahr_config *config, int axis, tahr_state states[CHARACTERS])
{
    tahr_body_desc b[3];
    const double places[CHARACTERS][3] = {{0, 0, 1}, {-40, 0, 4}, {40, 0, 4}, {0, 40, 60}};
    const double slopes[3] = {0, 0.25, -0.5}; /* tangents, about the level y */
    for (int i = 0; i < 3; i++) {
        const double half = 0.5 * atan(slopes[i]), x = 40.0 * (i == 0 ? 0 : i == 1 ? -1 : 1);
        make_sheet(&b[i]);
        b[i].pose.position = (tahr_vec3){x, 0, 0};
        b[i].pose.orientation = (tahr_quat){0, -sin(half), 0, cos(half)};
        if (axis) { /* (x, y, z) to (z, x, y): a third of a turn about (1, 1, 1) */
            const tahr_quat q = b[i].pose.orientation;
            const tahr_quat turn = {0.5, 0.5, 0.5, 0.5};
            b[i].pose.position = (tahr_vec3){0, x, 0};
            b[i].pose.orientation = quat_multiply(turn, q);
        }
    }
    rig_open_bodies(r, b, 3, config, axis ? (tahr_vec3){30, 60, 60} : (tahr_vec3){60, 60, 30});
    for (int k = 0; k < CHARACTERS; k++) {
        const double *p = places[k];
        const tahr_vec3 at = axis ? (tahr_vec3){p[2], p[0], p[1]} : (tahr_vec3){p[0], p[1], p[2]};
        assert_int_equal(tahr_state_init(&states[k], config, &at), TAHR_OK);
    }
}

/* One mover steps all of them in random turns, now and then the same one for a while: what it holds of a face, a wish
 * or a flight of one is not taken for another's. With 32-byte vectors and without, upright and lying. */
static void a_mover_holds_no_face_of_another(void **unused)
{
    (void)unused;
    for (int way = 0; way < 3; way++) {
        oracle_random dice = {21};
        tahr_config config = rig_config();
        tahr_state on[CHARACTERS], off[CHARACTERS];
        tahr_vec3 moves[CHARACTERS] = {{0.5, 0.1, 0}, {0.3, 0.4, 0}, {-0.2, 0.5, 0}, {0.7, 0, 0}};
        rig a, b;
        uint64_t spared = 0, steps = 0;
        uint32_t who = 0;
        const int axis = way == 2;
        config.gravity = axis ? (tahr_vec3){-9.81, 0, 0} : config.gravity;
        open_slopes(&a, &config, axis, on);
        config.short_ways = config.sleep = 0;
        open_slopes(&b, &config, axis, off);
        a.mover->wide = way == 1 ? 0 : a.mover->wide;
        for (int n = 0; n < 12000; n++) {
            const double angle = oracle_uniform(&dice, 0, 6.2831853), size = oracle_uniform(&dice, 0, 1);
            tahr_report report = {.struct_size = sizeof report};
            who = oracle_below(&dice, 20) ? who : oracle_below(&dice, CHARACTERS);
            if (oracle_below(&dice, 50) == 0) {
                moves[who] = (tahr_vec3){size * cos(angle), size * sin(angle), 0};
            }
            a.input.move = axis ? (tahr_vec3){0, moves[who].x, moves[who].y} : moves[who];
            a.input.jump = b.input.jump = oracle_below(&dice, 60) == 0;
            b.input.move = a.input.move;
            const tahr_status is = tahr_mover_step(a.mover, &a.input, DT, &on[who], &report);
            assert_int_equal(is, tahr_mover_step(b.mover, &b.input, DT, &off[who], NULL));
            assert_true(is >= 0);
            if (memcmp(&on[who], &off[who], sizeof on[who]) != 0) {
                fail_msg("way %d, step %d, character %u", way, n, who);
            }
            steps += report.sweeps > 0;
            spared += report.sweeps > 0 && report.saved[TAHR_SHORTCUT_KNOWN_FLOOR] == report.sweeps;
        }
        print_message("    %d of %d steps asked nothing\n", (int)spared, (int)steps);
        assert_true(spared > steps / 4);
        rig_close(&a);
        rig_close(&b);
    }
}

static void a_decay_that_is_known_changes_no_bit(void **unused)
{
    oracle_random dice = {5};
    (void)unused;
    for (int i = 0; i < 20000; i++) {
        const double a = oracle_uniform(&dice, 0, 6.2831853), t = oracle_uniform(&dice, 1e-4, 0.2);
        tahr__law law = {.wish = {cos(a), sin(a), 0},
                         .speed = oracle_uniform(&dice, 0, 6),
                         .acceleration = oracle_uniform(&dice, 0, 40),
                         .turn_friction = oracle_below(&dice, 5) ? oracle_uniform(&dice, 0, 12) : 0,
                         .braking = 20,
                         .drag = 16};
        const vec3 v = {oracle_uniform(&dice, -6, 6), oracle_uniform(&dice, -6, 6), 0};
        const tahr__motion m = tahr__law_advance(&law, v, t);
        decay_learn(&law.decay, law.turn_friction, t);
        const tahr__motion known = tahr__law_advance(&law, v, t);
        assert_memory_equal(&m, &known, sizeof m);
    }
}

/* A lean crowd of one goes as a mover of its own does, turning now and then. The crowd's mover was made for the first
 * of two configs; the second one steps its velocity, which no short way does. */
static void a_lean_crowd_takes_no_short_way_for_who_may_not(void **unused)
{
    pair p;
    tahr_config configs[2] = {rig_config(), rig_config()};
    tahr_member member = {.config = 1};
    tahr_mover *mover = NULL;
    tahr_crowd *crowd = NULL;
    tahr_crowd_desc desc;
    tahr_crowd_tick tick;
    (void)unused;
    open_pair(&p, 0);
    tahr_input input = p.on.input;
    tahr_state among = p.on.state, alone = among;
    configs[1].integrator = TAHR_INTEGRATOR_STEPPED;
    tahr_crowd_desc_init(&desc, sizeof desc);
    desc.capacity = desc.tasks = 1;
    desc.configs = configs, desc.config_count = 2;
    desc.flags = TAHR_CROWD_LEAN;
    assert_int_equal(tahr_crowd_create(p.on.world, &desc, &crowd), TAHR_OK);
    assert_int_equal(tahr_mover_create(p.on.world, &configs[1], &mover), TAHR_OK);
    tahr_crowd_tick_init(&tick, sizeof tick);
    tick.count = 1, tick.dt = DT, tick.members = &member, tick.inputs = &input, tick.states = &among;
    for (int n = 0; n < 240; n++) {
        input.move = n / 40 % 2 ? (tahr_vec3){0, 0.8, 0} : (tahr_vec3){0.8, 0, 0};
        assert_true(tahr_crowd_step(crowd, &tick) >= 0);
        assert_int_equal(tahr_mover_step(mover, &input, DT, &alone, NULL), TAHR_OK);
        assert_memory_equal(&among, &alone, sizeof among);
    }
    tahr_mover_destroy(mover);
    tahr_crowd_destroy(crowd);
    close_pair(&p);
}

/* Where what was gathered ends it looks around, and goes the short way all the same: two of three times at least, on a
 * floor with nothing on it; and no more often than the long way, which announces every step. */
static void a_short_walk_looks_around_by_itself(void **unused)
{
    enum { STEPS = 600 };
    pair p;
    (void)unused;
    open_pair(&p, 0);
    tahr_state a = p.on.state, b = p.off.state;
    uint64_t gathers[2] = {0, 0};
    int by_itself = 0;
    for (int n = 0; n < STEPS; n++) {
        tahr_report ra = {.struct_size = sizeof ra}, rb = ra;
        const tahr_input input = {.struct_size = sizeof input, .move = {n / 200 % 2 ? -0.9 : 0.9, 0.01 * (n % 7), 0}};
        assert_int_equal(tahr_mover_step(p.on.mover, &input, DT, &a, &ra), TAHR_OK);
        assert_int_equal(tahr_mover_step(p.off.mover, &input, DT, &b, &rb), TAHR_OK);
        assert_memory_equal(&a, &b, sizeof a);
        gathers[0] += ra.gathers;
        gathers[1] += rb.gathers;
        by_itself += ra.gathers > 0 && ra.saved[TAHR_SHORTCUT_KNOWN_FLOOR] == 2;
    }
    assert_true(gathers[0] > 10 && gathers[0] <= gathers[1]);
    assert_true(3 * (uint64_t)by_itself >= 2 * gathers[0]);
    close_pair(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_bit_of_who_walks_is_seen),
                                       cmocka_unit_test(every_bit_of_who_falls_is_seen),
                                       cmocka_unit_test(what_a_report_asks_for_is_seen),
                                       cmocka_unit_test(every_bit_of_who_sleeps_is_seen),
                                       cmocka_unit_test(every_bit_of_an_input_is_seen),
                                       cmocka_unit_test(what_is_wrong_in_who_walks_is_named),
                                       cmocka_unit_test(without_gravity_up_is_still_checked),
                                       cmocka_unit_test(a_mover_remembers_no_wish_of_another),
                                       cmocka_unit_test(a_mover_holds_no_face_of_another),
                                       cmocka_unit_test(a_short_walk_looks_around_by_itself),
                                       cmocka_unit_test(a_decay_that_is_known_changes_no_bit),
                                       cmocka_unit_test(a_lean_crowd_takes_no_short_way_for_who_may_not)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
