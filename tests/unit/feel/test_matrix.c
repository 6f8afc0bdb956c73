/* SPDX-License-Identifier: MIT
 * test_matrix.c: whatever is pressed, no two of the jump helpers together lead higher than the sum of their
 * jumps. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "rig.h"

enum { COYOTE, BUFFER, HOLD, RELEASE, AIR, WALL, LEDGE, CORNER, HELPERS };

static const double V = 4.2;

/* m, of a centre that stands: half height and at most 1.5 skin. */
static const double STANDING = 0.915;

/* s, of every time that is on; m, the top of the block. */
static const double TIME = 0.15, TOP = 2.2;

/* Every way to fall: the preset, its methods one by one, and those of the other preset all together. */
enum { PRECISE, STEPS, TWO_WALLS, UNREAL, METHODS };

static tahr_config config_of(uint32_t helpers, int method)
{
    tahr_config c = rig_config();
    if (method == UNREAL) {
        assert_int_equal(tahr_config_init(&c, sizeof c, TAHR_PRESET_UNREAL), TAHR_OK);
    }
    c.integrator = method == STEPS ? TAHR_INTEGRATOR_STEPPED : c.integrator;
    c.slide_solver = method == TWO_WALLS ? TAHR_SLIDE_TWO_WALLS : c.slide_solver;
    c.coyote_time = helpers >> COYOTE & 1 ? TIME : 0;
    c.jump_buffer = helpers >> BUFFER & 1 ? TIME : 0;
    c.jump_hold_time = helpers >> HOLD & 1 ? TIME : 0;
    c.jump_release_gravity = helpers >> RELEASE & 1 ? 2 : 1;
    c.air_jumps = helpers >> AIR & 1;
    c.wall_jump_speed = helpers >> WALL & 1 ? 3 : 0;
    c.wall_slide_speed = helpers >> WALL & 1 ? 2 : 0;
    c.wall_coyote_time = helpers >> WALL & 1 ? TIME : 0;
    c.ledge_grab = helpers >> LEDGE & 1 ? 0.3 : 0;
    c.corner_correction = helpers >> CORNER & 1 ? 0.1 : 0;
    c.air_control = 1;
    return c;
}

/* m, how high one jump leads. */
static double rise_of(const tahr_config *c)
{
    return V * c->jump_hold_time + V * V / (-2 * c->gravity.z);
}

/* Ground and one wall: nothing to stand on but the ground, one jump from it, one off the wall, those in the air. */
static double make_wall(fake_world *w, const tahr_config *c)
{
    fake_world_flat(w);
    fake_add_plane(w, fake_vec(-1, 0, 0), -1);
    return STANDING + rise_of(c) * (1 + c->air_jumps + (c->wall_jump_speed > 0));
}

/* Ground, a block to stand on, and a ceiling with a side that begins above. The sides of the block can be jumped off
 * again and again, but only where they are: a centre that touches one is lower than one that stands on the top, and
 * may go on rising for as long as a wall is remembered. From there one jump, one off the side of the ceiling, those
 * in the air. */
static double make_block(fake_world *w, const tahr_config *c)
{
    int walls = c->wall_jump_speed > 0;
    fake_world_flat(w);
    fake_add_box(w, fake_vec(0.5, -1, 0), fake_vec(2, 1, TOP));
    fake_add_box(w, fake_vec(-100, -100, 2.6), fake_vec(-0.5, 100, 100));
    return TOP + STANDING + walls * V * TIME + rise_of(c) * (1 + c->air_jumps + (uint32_t)walls);
}

/* What happened, so that the test cannot pass because nothing did. */
typedef struct tally {
    uint32_t jumps, wall_jumps, grabs, climbs, corners, air_jumps;
} tally;

typedef struct player {
    oracle_random random;
    double next; /* s, of the next change of the stick */
    uint32_t presses;
} player;

/* A button that changes every 80 ms or so, a stick that changes every half second; now and then a crouch. */
static void play(player *p, rig *r, double dt)
{
    uint32_t was = r->input.jump;
    if (oracle_uniform(&p->random, 0, 1) < dt / 0.08) {
        r->input.jump = !was;
    }
    p->presses += r->input.jump && !was;
    r->input.crouch = r->state.mode == TAHR_MODE_HANGING && oracle_uniform(&p->random, 0, 1) < dt;
    if (r->time >= p->next) {
        double a = oracle_below(&p->random, 2) ? 0 : oracle_uniform(&p->random, -3.2, 3.2); /* often at the wall */
        int home = fabs(r->state.position.x) > 4 || fabs(r->state.position.y) > 3;
        r->input.move = home ? fake_vec(-r->state.position.x, -r->state.position.y, 0) : fake_vec(cos(a), sin(a), 0);
        p->next += 0.5;
    }
}

static void assert_sound(const rig *r, const fake_world *w, double bound)
{
    const tahr_state *s = &r->state;
    assert_true(isfinite(s->position.x + s->position.y + s->position.z));
    assert_true(isfinite(s->velocity.x + s->velocity.y + s->velocity.z));
    assert_true(s->coyote_left >= 0 && s->buffer_left >= 0 && s->wall_left >= 0 && s->coyote_left <= TIME &&
                s->buffer_left <= TIME && s->wall_left <= TIME + 1e-12);
    assert_int_equal(r->report.flags &
                         (TAHR_REPORT_STUCK | TAHR_REPORT_CRUSHED | TAHR_REPORT_QUERY_CAP | TAHR_REPORT_MODE_REFUSED),
                     0);
    double kept = r->config.separation == TAHR_SEPARATION_MARGIN ? 0.01 - 1e-7 : 0; /* a pull-back keeps what it can */
    assert_true(fake_clearance(w, &r->config.shape, s->position) > kept);
    if (s->position.z > bound + 1e-6) {
        fail_msg("at %g s: %g m high, the sum of its jumps is %g", r->time, s->position.z, bound);
    }
}

static void count(tally *t, const rig *r, const tahr_state *before)
{
    for (uint32_t k = 0; k < r->report.event_count; k++) {
        t->jumps += r->events[k].type == TAHR_EVENT_JUMPED;
        t->wall_jumps += r->events[k].type == TAHR_EVENT_WALL_JUMPED;
        t->grabs += r->events[k].type == TAHR_EVENT_GRABBED;
        t->climbs += r->events[k].type == TAHR_EVENT_STEPPED_UP && r->events[k].value > 1.5;
    }
    const tahr_decision *corner = rig_decision(r, TAHR_RULE_CORNER);
    t->corners += corner && corner->accepted;
    t->air_jumps += r->state.jump_count > before->jump_count;
}

static void run(uint32_t helpers, int method, double rate, double (*make)(fake_world *w, const tahr_config *c),
                tally *t)
{
    fake_world w;
    rig r;
    /* First straight up, beside the ceiling of make_block: 5 cm of it are over the head and its skin. */
    player p = {.random = {helpers * 1000 + (uint32_t)rate}, .next = 1};
    tahr_config c = config_of(helpers, method);
    double bound = make(&w, &c);
    tahr_mover *other;
    tally own = {0};
    rig_stand(&r, &w, &c, fake_vec(-0.5 + 0.36 - 0.05, 0, 1));
    assert_int_equal(tahr_mover_create(r.world, &c, &other), TAHR_OK);
    r.time = 0;
    for (int i = 0; i < (int)(12 * rate); i++) {
        tahr_state again = r.state;
        play(&p, &r, 1 / rate);
        rig_step(&r, 1 / rate);
        rig_assert_in_order(&r, 1 / rate);
        assert_sound(&r, &w, bound);
        count(&own, &r, &again);
        assert_true(own.jumps + own.wall_jumps <= p.presses);
        if (i % 7 == 0) { /* nothing but the state is remembered */
            assert_true(tahr_mover_step(other, &r.input, 1 / rate, &again, NULL) >= 0);
            assert_memory_equal(&again, &r.state, sizeof again);
        }
    }
    t->jumps += own.jumps;
    t->wall_jumps += own.wall_jumps;
    t->grabs += own.grabs;
    t->climbs += own.climbs;
    t->corners += own.corners;
    t->air_jumps += own.air_jumps;
    tahr_mover_destroy(other);
    rig_close(&r);
}

static void run_at_all_rates(uint32_t helpers, int method, tally *t)
{
    const double rates[] = {10, 60, 300};
    for (int i = 0; i < 3; i++) {
        run(helpers, method, rates[i], make_wall, t);
        run(helpers, method, rates[i], make_block, t);
    }
}

static void no_two_helpers_together_lead_higher_than_the_sum_of_their_jumps(void **unused)
{
    tally t = {0};
    (void)unused;
    for (uint32_t a = 0; a < HELPERS; a++) {
        for (uint32_t b = a; b < HELPERS; b++) {
            run_at_all_rates(1u << a | 1u << b, PRECISE, &t);
        }
    }
    print_message("%u jumps, %u off walls, %u in the air, %u edges, %u climbed, %u corners\n", t.jumps, t.wall_jumps,
                  t.air_jumps, t.grabs, t.climbs, t.corners);
    assert_true(t.jumps && t.wall_jumps && t.air_jumps && t.grabs && t.climbs && t.corners);
}

static void all_helpers_together_lead_no_higher_than_the_sum_of_their_jumps(void **unused)
{
    tally t = {0};
    (void)unused;
    run_at_all_rates(0, PRECISE, &t);
    run_at_all_rates((1u << HELPERS) - 1, PRECISE, &t);
    for (uint32_t without = 0; without < HELPERS; without++) {
        run_at_all_rates(((1u << HELPERS) - 1) & ~(1u << without), PRECISE, &t);
    }
    assert_true(t.jumps && t.wall_jumps && t.air_jumps && t.grabs);
}

static void every_method_keeps_to_the_sum(void **unused)
{
    (void)unused;
    for (int method = STEPS; method < METHODS; method++) {
        tally t = {0};
        for (uint32_t a = 0; a < HELPERS; a++) {
            run_at_all_rates(1u << a, method, &t);
        }
        run_at_all_rates((1u << HELPERS) - 1, method, &t);
        print_message("method %d: %u jumps, %u off walls, %u in the air, %u edges, %u climbed\n", method, t.jumps,
                      t.wall_jumps, t.air_jumps, t.grabs, t.climbs);
        assert_true(t.jumps && t.wall_jumps && t.air_jumps && t.grabs);
    }
}

enum { BLOCKS = 24 };

/* Ground and turned blocks of all heights, some in the air, on the native backend. */
static void make_yard(tahr_body_desc *bodies, oracle_random *random)
{
    for (int i = 0; i < BLOCKS; i++) {
        double a = oracle_uniform(random, 0, 3);
        assert_int_equal(tahr_body_desc_init(&bodies[i], sizeof bodies[i], TAHR_BODY_BOX), TAHR_OK);
        bodies[i].half_extents = dice_vec(random, 0.3, 1.5);
        bodies[i].pose.position = dice_vec(random, -4, 4);
        bodies[i].pose.position.z = i % 3 ? bodies[i].half_extents.z - 0.1 : oracle_uniform(random, 3.5, 5);
        bodies[i].pose.orientation = (tahr_quat){0, 0, sin(a / 2), cos(a / 2)};
    }
    bodies[0].half_extents = fake_vec(2000, 2000, 1);
    bodies[0].pose.position = fake_vec(0, 0, -1);
}

/* Above the reach of all helpers there is nothing, below it nobody falls. */
static void all_helpers_stay_sound_among_turned_blocks(void **unused)
{
    const double rates[] = {10, 60, 300};
    uint32_t most = 0;
    (void)unused;
    for (int i = 0; i < 3 * METHODS * 4; i++) {
        tahr_body_desc bodies[BLOCKS];
        rig r;
        player p = {.random = {(uint64_t)i + 77}};
        tahr_config c = config_of((1u << HELPERS) - 1, i / 3 % METHODS);
        double rate = rates[i % 3];
        make_yard(bodies, &p.random);
        rig_open_bodies(&r, bodies, BLOCKS, &c, fake_vec(0, 0, 8));
        for (int k = 0; k < (int)(10 * rate); k++) {
            const tahr_state *s = &r.state;
            play(&p, &r, 1 / rate);
            rig_step(&r, 1 / rate);
            rig_assert_in_order(&r, 1 / rate);
            uint32_t asked = r.report.sweeps + r.report.contact_queries + r.report.rays;
            most = asked > most ? asked : most;
            assert_false(r.report.flags & (TAHR_REPORT_QUERY_CAP | TAHR_REPORT_MODE_REFUSED));
            assert_true(isfinite(s->velocity.x + s->velocity.y + s->velocity.z));
            assert_true(s->position.z > 0.8 && s->position.z < 20);
        }
        rig_close(&r);
    }
    print_message("at most %u queries a step\n", most);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_two_helpers_together_lead_higher_than_the_sum_of_their_jumps),
        cmocka_unit_test(all_helpers_together_lead_no_higher_than_the_sum_of_their_jumps),
        cmocka_unit_test(every_method_keeps_to_the_sum), cmocka_unit_test(all_helpers_stay_sound_among_turned_blocks)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
