/* SPDX-License-Identifier: MIT
 * test_onward.c: the last piece along a wall and the floor under its end, asked for in one look, change no bit of where
 * anybody goes and of what is reported. The look is made here of the two sweeps that it stands for, so that it knows
 * always. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <tahr/tahr.h>

#include "native_world.h"
#include "scene_wander.h"

enum { CHARACTERS = 8, TICKS = 600, BODIES = 24 };

/* What the look answers. */
enum { KNOWS, KNOWS_NOTHING, LIES };

static struct {
    int answers;
    int in_step; /* 1: since the announcement of a step; a look before it is the short way's (stroll.c) */
    uint32_t looks, known;
} slot;

/* Of all characters. */
static struct {
    double dt; /* s */
    uint32_t stays_on_ledges;
} way = {1.0 / 60, 0};

static tahr_status prepare(void *self, tahr_query_context *context, const tahr_prepare *announcement)
{
    slot.in_step = 1;
    return tahr_backend_v1_native()->prepare(self, context, announcement);
}

static uint32_t ask(void *self, tahr_query_context *context, const tahr_walk *w, int foot, tahr_hit *hit)
{
    const tahr_sweep q = {.shape = foot ? *w->foot : *w->shape,
                          .position = foot ? w->foot_position : w->position,
                          .up = w->up,
                          .orientation = {0, 0, 0, 1},
                          .motion = foot ? w->foot_motion : w->motion,
                          .margin = w->margin,
                          .mask = w->mask,
                          .ignore_body = TAHR_NO_BODY};
    uint32_t count = 0;
    assert_int_equal(tahr_backend_v1_native()->sweep(self, context, &q, hit, 1, &count), TAHR_OK);
    return count;
}

static tahr_status walk(void *self, tahr_query_context *context, const tahr_walk *w, tahr_hit *hit, uint32_t *known)
{
    *known = 0;
    if (!slot.in_step || !w->foot) {
        return TAHR_OK;
    }
    slot.looks++;
    *known = slot.answers != KNOWS_NOTHING && ask(self, context, w, 0, hit) == 0 && ask(self, context, w, 1, hit) == 1;
    slot.known += *known;
    if (slot.answers == LIES) { /* what no check lets pass */
        hit->fraction = slot.looks % 2 ? NAN : 2;
        *known = 1;
    }
    return TAHR_OK;
}

/* A platform in the middle of a level ground, and on both walls, pillars and slopes that stand close enough to be met
 * all the time, also at the border. */
static void make_yard(tahr_body_desc bodies[BODIES])
{
    oracle_random random = {.state = 11};
    bodies[0] = native_box(v_make(0, 0, -2), v_make(4, 4, 2));
    bodies[1] = native_box(v_make(0, 0, -2.2), v_make(40, 40, 1));
    for (int i = 2; i < BODIES; i++) {
        const double turn = oracle_uniform(&random, 0, 3.1), tilt = i % 3 == 0 ? oracle_uniform(&random, 0.2, 1.2) : 0;
        const tahr_vec3 at = {oracle_uniform(&random, -7, 7), oracle_uniform(&random, -7, 7), i % 2 ? 0.4 : -0.8};
        bodies[i] = native_box(at, v_make(0.2 + 0.1 * (i % 4), oracle_uniform(&random, 0.5, 2.5), i % 5 ? 1.6 : 0.3));
        const tahr_quat yaw = {0, 0, sin(turn / 2), cos(turn / 2)};
        const double s = sin(tilt / 2), c = cos(tilt / 2);
        bodies[i].pose.orientation = (tahr_quat){yaw.w * s, yaw.z * s, yaw.z * c, yaw.w * c};
    }
}

typedef struct walkers {
    tahr_world *world;
    tahr_mover *movers[CHARACTERS];
    tahr_state states[CHARACTERS];
    scene_wanderer wanderers[CHARACTERS];
} walkers;

static void open_walkers(walkers *w, const tahr_backend *backend, uint32_t short_ways)
{
    const tahr_bounds yard = {{-8, -8, -1}, {8, 8, 4}};
    tahr_body_desc bodies[BODIES];
    tahr_world_desc desc;
    tahr_config config;
    uint64_t seed = 7;
    make_yard(bodies);
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bodies;
    desc.body_count = BODIES;
    assert_int_equal(tahr_world_open(backend, &desc, &w->world), TAHR_OK);
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    config.short_ways = short_ways;
    config.walk_off_ledges = !way.stays_on_ledges;
    for (uint32_t i = 0; i < CHARACTERS; i++) {
        assert_int_equal(tahr_mover_create(w->world, &config, &w->movers[i]), TAHR_OK);
        assert_true(scene_wander_spawn(w->world, &config, &yard, &seed, &w->states[i]));
        scene_wander_start(&w->wanderers[i], 3, i);
    }
}

static void close_walkers(walkers *w)
{
    for (int i = 0; i < CHARACTERS; i++) {
        tahr_mover_destroy(w->movers[i]);
    }
    tahr_world_close(w->world);
}

/* What a step did, but for what it took to find out. traced: somebody looks at its queries. */
static tahr_report step(walkers *w, int i, int traced)
{
    static tahr_query_record queries[TAHR_MAX_QUERIES_PER_STEP];
    tahr_report r = {.struct_size = sizeof r};
    const tahr_input *input = scene_wander_next(&w->wanderers[i], way.dt);
    if (traced) {
        r.queries = queries;
        r.query_capacity = TAHR_MAX_QUERIES_PER_STEP;
    }
    slot.in_step = 0;
    assert_true(tahr_mover_step(w->movers[i], input, way.dt, &w->states[i], &r) >= 0);
    if (traced) {
        assert_int_equal(r.query_count, r.sweeps + r.rays + r.contact_queries);
    }
    r.queries = NULL;
    r.query_capacity = r.query_count = 0;
    memset(r.saved, 0, sizeof r.saved);
    r.triangle_tests = r.narrow_iterations = r.gathers = r.escapes = 0;
    return r;
}

/* Returns how many looks were known. */
static uint32_t compare(int answers, int traced)
{
    static walkers with, without;
    tahr_backend backend = *tahr_backend_v1_native();
    backend.walk = walk;
    backend.prepare = prepare;
    memset(&slot, 0, sizeof slot);
    slot.answers = answers;
    open_walkers(&with, &backend, 1);
    open_walkers(&without, tahr_backend_v1_native(), 0);
    for (int t = 0; t < TICKS; t++) {
        for (int i = 0; i < CHARACTERS; i++) {
            const tahr_report first = step(&with, i, traced), other = step(&without, i, traced);
            assert_memory_equal(&with.states[i], &without.states[i], sizeof with.states[i]);
            assert_memory_equal(&first, &other, sizeof first);
        }
    }
    close_walkers(&with);
    close_walkers(&without);
    return slot.known;
}

static void the_last_piece_along_a_wall_is_known_in_one_look(void **state)
{
    (void)state;
    const uint32_t known = compare(KNOWS, 0);
    print_message("    %u of %u looks known, of %d steps\n", known, slot.looks, TICKS * CHARACTERS);
    assert_true(known > slot.looks / 2 && known > TICKS * CHARACTERS / 20);
}

/* Who is held there goes on along the edge, in long steps often past something else. */
static void the_last_piece_along_a_ledge_is_asked_for_once(void **state)
{
    (void)state;
    way.dt = 0.3;
    way.stays_on_ledges = 1;
    const uint32_t known = compare(KNOWS, 0);
    way.dt = 1.0 / 60;
    way.stays_on_ledges = 0;
    assert_true(known > 0);
}

/* Where nothing ever comes of it a look is taken once in 16 times. */
static void what_is_not_known_is_asked_for_and_looked_at_seldom(void **state)
{
    (void)state;
    compare(KNOWS, 0);
    const uint32_t looks = slot.looks;
    compare(KNOWS_NOTHING, 0);
    print_message("    %u looks instead of %u\n", slot.looks, looks);
    assert_true(slot.looks >= CHARACTERS && slot.looks < looks / 4);
}

static void an_impossible_answer_counts_as_none(void **state)
{
    (void)state;
    compare(LIES, 0);
    assert_true(slot.looks >= CHARACTERS);
}

static void who_is_watched_asks_one_by_one(void **state)
{
    (void)state;
    compare(KNOWS, 1);
    assert_int_equal(slot.looks, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_last_piece_along_a_wall_is_known_in_one_look),
        cmocka_unit_test(the_last_piece_along_a_ledge_is_asked_for_once),
        cmocka_unit_test(what_is_not_known_is_asked_for_and_looked_at_seldom),
        cmocka_unit_test(an_impossible_answer_counts_as_none),
        cmocka_unit_test(who_is_watched_asks_one_by_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
