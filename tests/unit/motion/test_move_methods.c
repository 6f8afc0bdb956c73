/* SPDX-License-Identifier: MIT
 * test_move_methods.c: separation and depenetration are settings of their own: every combination of them moves, slides
 * and gets out of overlaps among planes and boxes, and none ends inside of what it started outside of. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "move.h"
#include "parity.h"
#include "rig.h"
#include "slide.h"

enum { COMBINATIONS = 4 };

static tahr_config combination(int32_t preset, int i)
{
    tahr_config c;
    assert_int_equal(tahr_config_init(&c, sizeof c, preset), TAHR_OK);
    c.separation = i & 1 ? TAHR_SEPARATION_PULL_BACK : TAHR_SEPARATION_MARGIN;
    c.depenetration = i & 2 ? TAHR_DEPENETRATION_SINGLE : TAHR_DEPENETRATION_JOINT;
    return c;
}

/* A floor, two walls that lean by up to 30 degrees, and three boxes; all within 3 m of the origin, cm. */
static parity_scene random_scene(oracle_random *dice)
{
    parity_scene scene = {.count = 0};
    parity_plane(&scene, 0, 0, 1, 0);
    for (int i = 0; i < 2; i++) {
        double turn = oracle_uniform(dice, 0, 6.283), lean = oracle_uniform(dice, -0.5, 0.5);
        parity_plane(&scene, cos(turn), sin(turn), lean, oracle_uniform(dice, -150, -80));
    }
    for (int i = 0; i < 3; i++) {
        vec3 at = vec(oracle_uniform(dice, -150, 150), oracle_uniform(dice, -150, 150), oracle_uniform(dice, 0, 150));
        vec3 half = dice_vec(dice, 10, 60);
        parity_box(&scene, sub(at, half), add(at, half));
    }
    return scene;
}

/* The same in closed form: an oracle that shares no code with any backend under test. */
static fake_world oracle_of(const parity_scene *scene)
{
    fake_world w;
    fake_world_init(&w);
    for (uint32_t i = 0; i < scene->count; i++) {
        const parity_solid *s = &scene->solids[i];
        if (s->kind == FAKE_BOX) {
            fake_add_box(&w, scale(s->min, 0.01), scale(s->max, 0.01));
        } else {
            fake_add_plane(&w, s->normal, s->offset / 100);
        }
    }
    return w;
}

/* cm, 1: a place found that is `least` metres off everything. */
static int free_place(oracle_random *dice, const fake_world *w, const tahr_shape *shape, double least, vec3 *at)
{
    for (int i = 0; i < 200; i++) {
        *at = vec(oracle_uniform(dice, -150, 150), oracle_uniform(dice, -150, 150), oracle_uniform(dice, 80, 200));
        if (fake_clearance(w, shape, scale(*at, 0.01)) > least) {
            return 1;
        }
    }
    return 0;
}

/* One motion as the stepwise solver makes it: safe move, then along what blocks. */
static void move_and_slide(parity *p, vec3 delta)
{
    tahr__swept swept;
    tahr__safe_move(&p->step, delta, &swept);
    if (swept.hit.blocking && !swept.hit.start_overlap) {
        tahr__slide_along_surface(&p->step, delta, 1 - swept.hit.fraction, swept.hit.normal, &swept);
    }
}

/* What a backend may be wrong by, m: native's sweeps are good to 1e-9 m, ccd's to 1e-5. */
static double slack_of(int backend)
{
    return backend == PARITY_CCD ? 2e-5 : 2e-9;
}

static void wander(parity *p, oracle_random *dice, const fake_world *oracle, const char *where)
{
    static const uint32_t modes[] = {TAHR_MODE_FLYING, TAHR_MODE_FALLING, TAHR_MODE_WALKING};
    p->step.state.mode = modes[oracle_below(dice, 3)];
    parity_floor(p, 2.15, vec(0, 0, 1), TAHR_FLOOR_BLOCKING | TAHR_FLOOR_WALKABLE | TAHR_FLOOR_FACE);
    for (int i = 0; i < 40; i++) {
        vec3 before = p->step.state.position;
        vec3 delta = scale(dice_direction(dice), pow(10, oracle_uniform(dice, -5, -0.3)));
        if (i % 4 == 3) { /* and straight on once more, into the same corner */
            delta = scale(delta, -1);
        }
        p->step.queries = p->step.report.event_count = 0;
        move_and_slide(p, delta);
        vec3 now = p->step.state.position;
        double gap = fake_clearance(oracle, &p->config.shape, now);
        if (!vec_is_finite(now) || gap < -slack_of(p->backend)) {
            fail_msg("%s: move %d by (%g, %g, %g) from (%.17g, %.17g, %.17g): %g m inside", where, i, delta.x, delta.y,
                     delta.z, before.x, before.y, before.z, -gap);
        }
        assert_true(length(sub(now, before)) <= 2 * length(delta) + 1e-3); /* nothing throws it */
    }
}

static void no_combination_ends_inside_of_planes_and_boxes(void **unused)
{
    (void)unused;
    for (int i = 0; i < COMBINATIONS; i++) {
        tahr_config c = combination(TAHR_PRESET_UNREAL, i);
        for (int backend = 0; backend < PARITY_BACKENDS; backend++) {
            oracle_random dice = {1234};
            int walks = 0;
            for (int k = 0; k < 30 && parity_has(backend); k++) {
                parity p;
                vec3 at;
                parity_scene scene = random_scene(&dice);
                fake_world oracle = oracle_of(&scene);
                if (!free_place(&dice, &oracle, &c.shape, 0, &at)) {
                    continue;
                }
                parity_open(&p, &scene, backend, &c, at.x, at.y, at.z);
                wander(&p, &dice, &oracle, parity_backend_name(backend));
                parity_close(&p);
                walks++;
            }
            assert_true(walks > 20 || !parity_has(backend));
        }
    }
}

/* Overlaps one solid only, and there is room right outside of it. */
static int leaves_at_once(const fake_world *w, const tahr_config *c, vec3 at)
{
    tahr_contact_query q = {.shape = c->shape, .position = at, .up = {0, 0, 1}, .orientation = {0, 0, 0, 1}};
    tahr_contact contacts[FAKE_SOLIDS];
    fake_world copy = *w;
    uint32_t count = 0;
    assert_int_equal(fake_contacts(&copy, &q, contacts, FAKE_SOLIDS, &count), TAHR_OK);
    if (count != 1) {
        return 0;
    }
    vec3 out = add_scaled(at, contacts[0].normal, 0.001 - contacts[0].distance);
    return fake_clearance(w, &c->shape, out) > 0.0009; /* the inflation of the test whether it fits, within the push */
}

typedef struct escapes {
    uint32_t starts, simple, out;
} escapes;

/* Ticks of small moves from an overlap: never deeper, within the queries, and out at the first tick where it is
 * simple. */
static void escape(parity *p, oracle_random *dice, const fake_world *oracle, escapes *e)
{
    const tahr_config *c = &p->config;
    int single = c->depenetration == TAHR_DEPENETRATION_SINGLE;
    uint32_t most = single ? TAHR__SAFE_MOVE_QUERIES : 2 + TAHR__DEPENETRATION_QUERIES;
    double before = fake_clearance(oracle, &c->shape, p->step.state.position);
    int simple = leaves_at_once(oracle, c, p->step.state.position);
    for (int tick = 0; tick < 12; tick++) {
        tahr__swept swept;
        p->step.queries = p->step.report.event_count = 0;
        p->step.push_left = c->max_depenetration;
        tahr__safe_move(&p->step, scale(dice_direction(dice), 0.002), &swept);
        assert_true(p->step.queries <= most);
        assert_true(vec_is_finite(p->step.state.position));
        double now = fake_clearance(oracle, &c->shape, p->step.state.position);
        if (now < min_of(before, 0) - 1e-4 || (simple && now < -slack_of(p->backend))) {
            fail_msg("%s, tick %d: %g m after %g m, simple: %d", parity_backend_name(p->backend), tick, now, before,
                     simple);
        }
        before = now;
    }
    e->starts++;
    e->simple += simple != 0;
    e->out += before >= -slack_of(p->backend);
}

static void overlaps_are_left_and_never_get_deeper(void **unused)
{
    escapes e = {0, 0, 0};
    (void)unused;
    for (int i = 0; i < COMBINATIONS; i++) {
        tahr_config c = combination(TAHR_PRESET_UNREAL, i);
        for (int backend = 0; backend < PARITY_BACKENDS; backend++) {
            oracle_random dice = {99};
            for (int k = 0; k < 200 && parity_has(backend); k++) {
                parity_scene scene = random_scene(&dice);
                fake_world oracle = oracle_of(&scene);
                parity p;
                vec3 at;
                if (!free_place(&dice, &oracle, &c.shape, -0.1, &at) ||
                    fake_clearance(&oracle, &c.shape, scale(at, 0.01)) > -0.001) {
                    continue;
                }
                parity_open(&p, &scene, backend, &c, at.x, at.y, at.z);
                escape(&p, &dice, &oracle, &e);
                parity_close(&p);
            }
        }
    }
    print_message("%u overlaps, %u of them simple; out of %u after 12 moves\n", e.starts, e.simple, e.out);
    assert_true(e.simple > 100 && e.starts > e.simple);
}

/* The joint solver asks tahr__move: with a pull-back or single pushes it walks on all the same. */
static void the_joint_solver_walks_with_every_combination(void **unused)
{
    (void)unused;
    for (int i = 0; i < COMBINATIONS; i++) {
        tahr_config c = combination(TAHR_PRESET_PRECISE, i);
        for (int rate = 0; rate < RIG_RATES; rate++) {
            oracle_random dice = {7};
            fake_world w;
            rig r;
            double dt = 1 / rig_rates[rate], walked = 0;
            fake_world_flat(&w);
            fake_add_plane(&w, unit(vec(-1, 0.3, 0.1)), -2);
            fake_add_plane(&w, unit(vec(0, -1, 0.2)), -2);
            fake_add_box(&w, vec(-3, 0.8, 0), vec(-1, 2, 0.3));
            fake_add_box(&w, vec(-1.5, -2.5, 0), vec(0.5, -1.2, 3));
            rig_open(&r, &w, &c, vec(0, 0, 1));
            for (int k = 0; k < (int)(6 / dt); k++) {
                vec3 before = r.state.position;
                if (k % (int)(0.5 / dt) == 0) {
                    double turn = oracle_uniform(&dice, 0, 6.283);
                    r.input.move = vec(cos(turn), sin(turn), 0);
                }
                rig_step(&r, dt);
                walked += length(sub(r.state.position, before));
                assert_true(vec_is_finite(r.state.position) && vec_is_finite(r.state.velocity));
                double gap = fake_clearance(&w, &c.shape, r.state.position);
                if (gap < -1e-9) {
                    fail_msg("combination %d, %g Hz, step %d: %g m inside at (%g, %g, %g)", i, rig_rates[rate], k, -gap,
                             r.state.position.x, r.state.position.y, r.state.position.z);
                }
            }
            assert_true(walked > 2); /* of at most 36 m, among walls */
            rig_close(&r);
        }
    }
}

/* The skin is kept along the normal whatever the motion; the pull-back depends on its length: 10 cm and 2 m into one
 * wall. */
static void skin_does_not_depend_on_the_motion_and_the_pull_back_does(void **unused)
{
    static const double gaps[2][2] = {{1.9, 1.9}, {0.101 * 10, 1 + 0.001 * 200}}; /* cm */
    parity_scene scene = {.count = 0};
    (void)unused;
    parity_plane(&scene, -1, 0, 0, -40);
    for (int pull = 0; pull < 2; pull++) {
        tahr_config c = combination(TAHR_PRESET_UNREAL, pull);
        for (int longer = 0; longer < 2; longer++) {
            tahr__swept swept;
            parity p;
            parity_open(&p, &scene, PARITY_FAKE, &c, 0, 0, 0);
            tahr__safe_move(&p.step, parity_vec(longer ? 200 : 10, 0, 0), &swept);
            assert_near(40 - 34 - 100 * p.step.state.position.x, gaps[pull][longer], 1e-9);
            assert_near(100 * swept.location.x, pull ? 6 : 6 - 1.9, 1e-9);
            parity_close(&p);
        }
    }
}

/* 2 cm in the floor. JOINT ends where the separation keeps it, SINGLE at 0.125 cm whatever that is. */
static void pushes_end_where_the_separation_keeps_the_shape(void **unused)
{
    static const double gaps[COMBINATIONS] = {1.9, 0.125, 0.125, 0.125}; /* cm, at i & 1: pull-back, i & 2: single */
    parity_scene scene = {.count = 0};
    (void)unused;
    parity_plane(&scene, 0, 0, 1, 0);
    for (int i = 0; i < COMBINATIONS; i++) {
        tahr_config c = combination(TAHR_PRESET_UNREAL, i);
        tahr__swept swept;
        parity p;
        parity_open(&p, &scene, PARITY_FAKE, &c, 0, 0, 86);
        tahr__safe_move(&p.step, parity_vec(10, 0, 0), &swept);
        assert_near(100 * p.step.state.position.x, 10, 1e-9);
        assert_near(100 * p.step.state.position.z - 88, gaps[i], 1e-9);
        assert_int_equal(p.step.just_teleported, 1);
        parity_close(&p);
    }
}

/* At 1000 Hz a crawl of 1 mm/s moves 1e-6 m a step: with a skin that counts, with a pull-back it is too short to be
 * seen. */
static void short_moves_count_with_a_skin_only(void **unused)
{
    parity_scene scene = {.count = 0};
    (void)unused;
    for (int pull = 0; pull < 2; pull++) {
        tahr_config c = combination(TAHR_PRESET_UNREAL, pull);
        tahr__swept swept;
        parity p;
        parity_open(&p, &scene, PARITY_FAKE, &c, 0, 0, 0);
        assert_int_equal(tahr__safe_move(&p.step, vec(1e-6, 0, 0), &swept), 1);
        assert_near(p.step.state.position.x, pull ? 0 : 1e-6, 0);
        assert_int_equal(p.step.queries, pull ? 0 : 1);
        parity_close(&p);
    }
}

/* A backend that answers as it is told, whatever it is asked. */
typedef struct liar {
    tahr_hit hit;
    uint32_t contacts; /* answered: 0 or 1 */
    tahr_status status;
} liar;

static tahr_status lying_sweep(void *user, const tahr_sweep *query, tahr_hit *hit)
{
    const liar *l = user;
    (void)query;
    *hit = l->hit;
    return l->status;
}

static tahr_status lying_contacts(void *user, const tahr_contact_query *query, tahr_contact *contacts,
                                  uint32_t capacity, uint32_t *count)
{
    const liar *l = user;
    (void)query, (void)capacity;
    *count = l->contacts;
    contacts[0].distance = -0.01;
    contacts[0].normal = contacts[0].surface_normal = vec(0, 0, 1);
    return TAHR_OK;
}

/* Undecided, failing, contradicting and absurd answers: finite, no farther than asked, within the queries. */
static void bad_answers_stop_the_move_where_it_is_proven_free(void **unused)
{
    static const struct {
        tahr_hit hit;
        tahr_status status;
        uint32_t contacts;
        double x; /* expected with a pull-back, cm; of 10 asked */
    } rows[] = {
        {{.unknown = 1, .fraction = 0.5}, TAHR_OK, 0, 10 * (0.5 - 0.101)},
        {{.blocking = 1, .fraction = NAN, .normal = {0, 0, 1}}, TAHR_OK, 0, 0},
        {{.blocking = 0}, TAHR_E_BACKEND, 0, 0},
        {{.blocking = 1, .start_overlap = 1, .fraction = 0.5, .depth = 0.02, .normal = {0, 0, 1}}, TAHR_OK, 1, 0},
        {{.blocking = 1, .start_overlap = 1, .depth = 1e300, .normal = {0, 0, 1}}, TAHR_OK, 1, 0}};
    (void)unused;
    for (int i = 0; i < COMBINATIONS; i++) {
        tahr_config c = combination(TAHR_PRESET_UNREAL, i);
        for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
            liar l = {rows[k].hit, rows[k].contacts, rows[k].status};
            tahr_callbacks callbacks = {
                .struct_size = sizeof callbacks, .user = &l, .sweep = lying_sweep, .contacts = lying_contacts};
            tahr__swept swept;
            parity p;
            parity_open_callbacks(&p, &callbacks, &c);
            tahr__safe_move(&p.step, parity_vec(10, 0, 0), &swept);
            vec3 at = p.step.state.position;
            assert_near(100 * at.x, (i & 1) || k > 0 ? rows[k].x : 5, 1e-9);
            assert_true(vec_is_finite(at) && at.z >= 0 && at.z <= c.max_depenetration + 1e-9);
            assert_int_equal(p.step.error, rows[k].status < 0 || k == 1 ? TAHR_E_BACKEND : TAHR_OK);
            assert_true(p.step.queries <= 2 + TAHR__DEPENETRATION_QUERIES);
            if (k > 2) {
                assert_true(p.step.report.flags & TAHR_REPORT_CRUSHED);
            }
            parity_close(&p);
        }
    }
}

static void pull_backs_can_be_traced(void **unused)
{
    parity_scene scene = {.count = 0};
    tahr_decision decisions[8];
    tahr__swept swept;
    parity p;
    (void)unused;
    parity_plane(&scene, -1, 0, 0, -60);
    parity_open(&p, &scene, PARITY_FAKE, NULL, 0, 0, 0);
    p.step.report.decisions = decisions;
    p.step.report.decision_capacity = 8;
    tahr__safe_move(&p.step, parity_vec(50, 0, 0), &swept);
    assert_int_equal(p.step.report.decision_count, 2);
    assert_int_equal(decisions[0].rule, TAHR_RULE_SWEEP);
    assert_int_equal(decisions[0].accepted, 0);
    assert_int_equal(decisions[1].rule, TAHR_RULE_PULL_BACK);
    assert_int_equal(decisions[1].accepted, 1);
    assert_near(decisions[1].value, 0.52, 1e-12);  /* 26 of 50 cm */
    assert_near(decisions[1].limit, 0.499, 1e-12); /* row M1 */
    parity_close(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_combination_ends_inside_of_planes_and_boxes),
                                       cmocka_unit_test(overlaps_are_left_and_never_get_deeper),
                                       cmocka_unit_test(the_joint_solver_walks_with_every_combination),
                                       cmocka_unit_test(skin_does_not_depend_on_the_motion_and_the_pull_back_does),
                                       cmocka_unit_test(pushes_end_where_the_separation_keeps_the_shape),
                                       cmocka_unit_test(short_moves_count_with_a_skin_only),
                                       cmocka_unit_test(bad_answers_stop_the_move_where_it_is_proven_free),
                                       cmocka_unit_test(pull_backs_can_be_traced)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
