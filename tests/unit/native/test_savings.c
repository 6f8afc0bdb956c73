/* SPDX-License-Identifier: MIT
 * test_savings.c: what every shortcut saves is counted where it is on, and nothing where it is off; and its switch
 * changes no bit of a state and nothing of a report but what it saves. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include <tahr/tahr.h>

#include "dice.h"
#include "native_world.h"
#include "scene_level.h"
#include "scene_wander.h"

enum { CHARACTERS = 8, TICKS = 600, BODIES = 60 };

typedef struct walkers {
    tahr_world *world;
    tahr_mover *movers[CHARACTERS];
    tahr_state states[CHARACTERS];
    scene_wanderer wanderers[CHARACTERS];
    uint64_t saved[TAHR_SHORTCUT_COUNT], sweeps;
} walkers;

/* shortcut: which is off; TAHR_SHORTCUT_COUNT: none. */
static void switch_off(uint32_t shortcut, tahr_config *config, tahr_native_desc *native)
{
    config->sleep = shortcut != TAHR_SHORTCUT_SLEEP;
    config->cached_floor = shortcut != TAHR_SHORTCUT_CACHED_FLOOR;
    config->barred_steps = shortcut != TAHR_SHORTCUT_BARRED_STEP;
    config->short_ways = shortcut != TAHR_SHORTCUT_CLEAR_AIR;
    native->no_vicinity = shortcut == TAHR_SHORTCUT_KNOWN_FLOOR;
    native->no_cache = shortcut == TAHR_SHORTCUT_CACHE;
    native->no_capsule_ends = shortcut == TAHR_SHORTCUT_CAPSULE_END;
}

static void open_walkers(walkers *w, uint32_t off, const tahr_body_desc *bodies, uint32_t count,
                         const tahr_bounds *spawn)
{
    tahr_native_desc native = {.struct_size = sizeof native};
    tahr_world_desc desc;
    tahr_config config;
    uint64_t seed = 5;
    memset(w, 0, sizeof *w);
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    switch_off(off, &config, &native);
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bodies;
    desc.body_count = count;
    desc.options = &native;
    assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &w->world), TAHR_OK);
    for (uint32_t i = 0; i < CHARACTERS; i++) {
        assert_int_equal(tahr_mover_create(w->world, &config, &w->movers[i]), TAHR_OK);
        assert_true(scene_wander_spawn(w->world, &config, spawn, &seed, &w->states[i]));
        scene_wander_start(&w->wanderers[i], 7, i);
    }
}

static void close_walkers(walkers *w)
{
    for (int i = 0; i < CHARACTERS; i++)
        tahr_mover_destroy(w->movers[i]);
    tahr_world_close(w->world);
}

/* One in eight stands for a while and now and then. */
static tahr_report step(walkers *w, int i, int tick)
{
    const tahr_input *wish = scene_wander_next(&w->wanderers[i], 1.0 / 60), none = {.struct_size = sizeof none};
    tahr_report r = {.struct_size = sizeof r};
    const int stands = i == 0 && tick % 100 > 50;
    assert_true(tahr_mover_step(w->movers[i], stands ? &none : wish, 1.0 / 60, &w->states[i], &r) >= 0);
    for (int s = 0; s < TAHR_SHORTCUT_COUNT; s++)
        w->saved[s] += r.saved[s];
    w->sweeps += r.sweeps;
    return r;
}

/* Leaves out of a report what the shortcut saves, and what it takes to find out. */
static void leave_out(uint32_t shortcut, tahr_report *r)
{
    const int sleeps = shortcut == TAHR_SHORTCUT_SLEEP, keeps = shortcut == TAHR_SHORTCUT_CACHED_FLOOR;
    memset(r->saved, 0, sizeof r->saved);
    r->triangle_tests = r->narrow_iterations = r->gathers = r->escapes = 0;
    if (sleeps || keeps || shortcut == TAHR_SHORTCUT_BARRED_STEP) r->sweeps = 0;
    if (sleeps || keeps) r->flags &= ~(uint32_t)TAHR_REPORT_CACHED_FLOOR;
    if (sleeps) {
        r->flags &= ~(uint32_t)TAHR_REPORT_ASLEEP;
        r->contact_queries = r->rays = 0;
    }
}

/* Returns what the shortcut saved. */
static uint64_t compare(uint32_t shortcut, const tahr_body_desc *bodies, uint32_t count, const tahr_bounds *spawn)
{
    static walkers with, without;
    uint64_t more = 0, saved;
    open_walkers(&with, TAHR_SHORTCUT_COUNT, bodies, count, spawn);
    open_walkers(&without, shortcut, bodies, count, spawn);
    for (int tick = 0; tick < TICKS; tick++) {
        for (int i = 0; i < CHARACTERS; i++) {
            tahr_report on = step(&with, i, tick), off = step(&without, i, tick);
            assert_memory_equal(&with.states[i], &without.states[i], sizeof with.states[i]);
            assert_true(on.sweeps <= off.sweeps);
            more += off.sweeps - on.sweeps;
            leave_out(shortcut, &on);
            leave_out(shortcut, &off);
            assert_memory_equal(&on, &off, sizeof on);
        }
    }
    saved = with.saved[shortcut];
    assert_int_equal(without.saved[shortcut], 0);
    if (shortcut == TAHR_SHORTCUT_BARRED_STEP) assert_true(more >= saved);
    if (shortcut == TAHR_SHORTCUT_CLEAR_AIR || shortcut == TAHR_SHORTCUT_KNOWN_FLOOR) {
        assert_true(saved <= with.sweeps && with.sweeps == without.sweeps);
    }
    close_walkers(&with);
    close_walkers(&without);
    return saved;
}

static const uint32_t SHORTCUTS[] = {TAHR_SHORTCUT_SLEEP,      TAHR_SHORTCUT_CACHED_FLOOR, TAHR_SHORTCUT_BARRED_STEP,
                                     TAHR_SHORTCUT_CLEAR_AIR,  TAHR_SHORTCUT_KNOWN_FLOOR,  TAHR_SHORTCUT_CACHE,
                                     TAHR_SHORTCUT_CAPSULE_END};

static void compare_all(const tahr_body_desc *bodies, uint32_t count, const tahr_bounds *spawn)
{
    for (size_t i = 0; i < sizeof SHORTCUTS / sizeof SHORTCUTS[0]; i++) {
        const uint64_t saved = compare(SHORTCUTS[i], bodies, count, spawn);
        print_message("    %s: %llu saved in %d steps\n", tahr_shortcut_name(SHORTCUTS[i]), (unsigned long long)saved,
                      CHARACTERS * TICKS);
        assert_true(saved > 0);
    }
}

static void the_playground_is_walked_alike_without_each_of_them(void **unused)
{
    (void)unused;
    scene_mesh mesh = {0};
    tahr_body_desc body;
    scene_mesh_playground(&mesh);
    scene_level_body(&mesh, &body);
    const tahr_bounds spawn = scene_mesh_bounds(&mesh);
    compare_all(&body, 1, &spawn);
    scene_mesh_free(&mesh);
}

/* Slabs that stand and lean by little or much, hang, and end at the height of a step: quarters of a metre, so that much
 * coincides. */
static void walls_and_steps_are_met_alike_without_each_of_them(void **unused)
{
    (void)unused;
    static tahr_body_desc bodies[BODIES];
    const tahr_bounds spawn = {{-8, -8, 0}, {8, 8, 3}};
    oracle_random random = {11};
    bodies[0] = native_box(v_make(0, 0, -1), v_make(12, 12, 1));
    for (int i = 1; i < BODIES; i++) {
        const double lean = i % 3 ? 0 : pow(10, oracle_uniform(&random, -9, -0.5)), size = sqrt(1 + lean * lean);
        tahr_vec3 half = {0.25 * (1 + oracle_below(&random, 4)), 0.25 * (1 + oracle_below(&random, 6)),
                          0.2 * (1 + oracle_below(&random, i % 2 ? 2 : 8))};
        tahr_vec3 at = {floor(oracle_uniform(&random, -32, 32)) / 4, floor(oracle_uniform(&random, -32, 32)) / 4,
                        half.z + (i % 5 ? 0 : 0.5)};
        bodies[i] = native_box(at, half);
        bodies[i].pose.orientation = (tahr_quat){lean / size, 0, 0, 1 / size};
    }
    compare_all(bodies, BODIES, &spawn);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_playground_is_walked_alike_without_each_of_them),
                                       cmocka_unit_test(walls_and_steps_are_met_alike_without_each_of_them)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
