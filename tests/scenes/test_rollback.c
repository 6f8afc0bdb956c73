/* SPDX-License-Identifier: MIT
 * test_rollback.c: a step is a function of its inputs: the same bits again from any earlier state, whatever the caches
 * hold and whoever steps. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "scene_backend.h"
#include "scene_wander.h"

enum { CHARACTERS = 6, STEPS = 480, REPLAYED = 40, MOVABLE = 1 };

typedef struct film {
    tahr_state states[STEPS + 1][CHARACTERS];
} film;

typedef struct stage {
    tahr_world *world;
    tahr_mover *movers[CHARACTERS];
    int shared;   /* one mover steps everybody */
    int platform; /* a box moves up and down */
} stage;

static scene_mesh playground;
static tahr_input inputs[STEPS][CHARACTERS];
static film first, second;

/* Rates change from step to step as on a busy machine. */
static double dt_of(int step)
{
    static const double DT[6] = {1.0 / 60, 1.0 / 60, 1.0 / 30, 1.0 / 144, 1.0 / 1000, 0.1};
    return DT[(step / 7) % 6];
}

static int make_scene(void **state)
{
    (void)state;
    scene_mesh_playground(&playground);
    for (int c = 0; c < CHARACTERS; c++) {
        scene_wanderer wanderer;
        scene_wander_start(&wanderer, 3, (uint32_t)c);
        for (int s = 0; s < STEPS; s++) {
            inputs[s][c] = *scene_wander_next(&wanderer, dt_of(s));
            if (c == 0 && s % 120 >= 60) { /* one rests often: that is where floors stay cached */
                inputs[s][c].move = (tahr_vec3){0, 0, 0};
            }
        }
    }
    return playground.failed;
}

static int drop_scene(void **state)
{
    (void)state;
    scene_mesh_free(&playground);
    return 0;
}

static void open_stage(stage *g, const scene_backend *backend, const tahr_native_desc *options, uint32_t cached_floor)
{
    tahr_config config;
    tahr_body_desc bodies[2];
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    config.cached_floor = cached_floor;
    tahr_body_desc_init(&bodies[0], sizeof bodies[0], TAHR_BODY_MESH);
    bodies[0].flags = TAHR_BODY_TWO_SIDED;
    bodies[0].vertices = playground.vertices;
    bodies[0].vertex_count = playground.vertex_count;
    bodies[0].indices = playground.indices;
    bodies[0].triangle_count = playground.triangle_count;
    tahr_body_desc_init(&bodies[MOVABLE], sizeof bodies[MOVABLE], TAHR_BODY_BOX);
    bodies[MOVABLE].flags = TAHR_BODY_MOVABLE;
    bodies[MOVABLE].half_extents = (tahr_vec3){2, 2, 0.2};
    bodies[MOVABLE].pose.position = (tahr_vec3){-1, -17, 0};
    assert_int_equal(scene_backend_open(backend, bodies, 2, options, &g->world), TAHR_OK);
    for (int c = 0; c < CHARACTERS; c++) {
        assert_int_equal(tahr_mover_create(g->world, &config, &g->movers[c]), TAHR_OK);
    }
}

static void close_stage(stage *g)
{
    for (int c = 0; c < CHARACTERS; c++) {
        tahr_mover_destroy(g->movers[c]);
    }
    tahr_world_close(g->world);
}

static void starting_states(film *f)
{
    tahr_config config;
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    for (int c = 0; c < CHARACTERS; c++) { /* the first on the platform, the rest between stairs, ramps and pillars */
        tahr_vec3 place = {c == 0 ? -1 : -14 + 6.0 * c, c == 0 ? -17 : -15.5 + 3.0 * c, c == 0 ? 1.5 : 4.2};
        assert_int_equal(tahr_state_init(&f->states[0][c], &config, &place), TAHR_OK);
    }
}

/* Where the platform is during a step. */
static void place_platform(stage *g, int step)
{
    tahr_body_pose pose = {MOVABLE, 0, {{-1, -17, 0.01 * (step / 16 % 8)}, {0, 0, 0, 1}}};
    if (g->platform) {
        assert_int_equal(tahr_world_set(g->world, &pose, 1), TAHR_OK);
    }
}

/* Steps everybody from the states of step `from` to step `to`. */
static void play(stage *g, film *f, int from, int to)
{
    for (int s = from; s < to; s++) {
        place_platform(g, s);
        for (int c = 0; c < CHARACTERS; c++) {
            f->states[s + 1][c] = f->states[s][c];
            tahr_status status =
                tahr_mover_step(g->movers[g->shared ? 0 : c], &inputs[s][c], dt_of(s), &f->states[s + 1][c], NULL);
            if (status < 0) {
                fail_msg("step %d, character %d: %s", s, c, tahr_status_name(status));
            }
        }
    }
}

static void same(const scene_backend *backend, const char *what, int from, int to)
{
    for (int s = from; s <= to; s++) {
        for (int c = 0; c < CHARACTERS; c++) {
            const tahr_state *a = &first.states[s][c], *b = &second.states[s][c];
            if (memcmp(a, b, sizeof *a) != 0) {
                size_t byte = 0;
                while (((const char *)a)[byte] == ((const char *)b)[byte]) {
                    byte++;
                }
                fail_msg("%s, %s: step %d, character %d, byte %zu of the state: x %.17g and %.17g, z %.17g and %.17g",
                         backend->name, what, s, c, byte, a->position.x, b->position.x, a->position.z, b->position.z);
            }
        }
    }
}

static void film_once(stage *g, const scene_backend *backend)
{
    memset(&first, 0, sizeof first);
    open_stage(g, backend, NULL, 1);
    starting_states(&first);
    play(g, &first, 0, STEPS);
}

/* Restores the states of step `at` and plays on. */
static void replay(stage *g, const scene_backend *backend, const char *what, int at)
{
    int to = at + REPLAYED < STEPS ? at + REPLAYED : STEPS;
    memcpy(second.states[at], first.states[at], sizeof first.states[at]);
    play(g, &second, at, to);
    same(backend, what, at, to);
}

static void restored_states_repeat_with_warm_caches(void **state)
{
    (void)state;
    for (int b = 0; b < SCENE_BACKEND_COUNT; b++) {
        stage g = {0};
        film_once(&g, &SCENE_BACKENDS[b]);
        for (int at = 0; at < STEPS; at += 61) {
            replay(&g, &SCENE_BACKENDS[b], "warm caches, forward", at);
        }
        for (int at = STEPS - 1; at >= 0; at -= 47) {
            replay(&g, &SCENE_BACKENDS[b], "warm caches, backward", at);
        }
        close_stage(&g);
    }
}

static void restored_states_repeat_with_cold_caches(void **state)
{
    (void)state;
    for (int b = 0; b < SCENE_BACKEND_COUNT; b++) {
        stage g = {0};
        film_once(&g, &SCENE_BACKENDS[b]);
        close_stage(&g);
        for (int at = 0; at < STEPS; at += 61) {
            stage fresh = {0};
            open_stage(&fresh, &SCENE_BACKENDS[b], NULL, 1);
            replay(&fresh, &SCENE_BACKENDS[b], "cold caches", at);
            close_stage(&fresh);
        }
    }
}

static void restored_states_repeat_after_bodies_moved(void **state)
{
    (void)state;
    for (int b = 0; b < SCENE_BACKEND_COUNT; b++) {
        stage g = {.platform = 1};
        film_once(&g, &SCENE_BACKENDS[b]);
        for (int at = 0; at < STEPS; at += 61) {
            replay(&g, &SCENE_BACKENDS[b], "moving bodies", at);
        }
        close_stage(&g);
    }
}

/* Plays the film again on another stage and compares all of it. */
static void compare(const scene_backend *backend, const char *what, stage *other)
{
    memset(&second, 0, sizeof second);
    starting_states(&second);
    play(other, &second, 0, STEPS);
    close_stage(other);
    same(backend, what, 0, STEPS);
}

static void one_mover_for_all_equals_one_each(void **state)
{
    (void)state;
    for (int b = 0; b < SCENE_BACKEND_COUNT; b++) {
        stage g = {0}, other = {.shared = 1};
        film_once(&g, &SCENE_BACKENDS[b]);
        close_stage(&g);
        open_stage(&other, &SCENE_BACKENDS[b], NULL, 1);
        compare(&SCENE_BACKENDS[b], "one mover", &other);
    }
}

static void cached_floors_change_nothing(void **state)
{
    (void)state;
    for (int b = 0; b < SCENE_BACKEND_COUNT; b++) {
        stage g = {0}, other = {0};
        film_once(&g, &SCENE_BACKENDS[b]);
        close_stage(&g);
        open_stage(&other, &SCENE_BACKENDS[b], NULL, 0);
        compare(&SCENE_BACKENDS[b], "no cached floor", &other);
    }
}

static void caches_and_simd_change_nothing(void **state)
{
    static const struct {
        const char *what;
        tahr_native_desc options;
    } VARIANTS[] = {
        {"no cache", {.no_cache = 1}},
        {"no simd", {.no_simd = 1}},
        {"no vicinity", {.no_vicinity = 1}},
        {"no capsule ends", {.no_capsule_ends = 1}},
        {"neither", {.no_cache = 1, .no_simd = 1}},
        {"a cache of 8 triangles", {.cache_triangles = 8}},
        {"a margin of 3 m", {.cache_margin = 3}},
    };
    (void)state;
    for (int b = 0; b < SCENE_BACKEND_COUNT; b++) {
        stage g = {0};
        if (!SCENE_BACKENDS[b].native) {
            continue;
        }
        film_once(&g, &SCENE_BACKENDS[b]);
        close_stage(&g);
        for (size_t i = 0; i < sizeof VARIANTS / sizeof VARIANTS[0]; i++) {
            stage other = {0};
            open_stage(&other, &SCENE_BACKENDS[b], &VARIANTS[i].options, 1);
            compare(&SCENE_BACKENDS[b], VARIANTS[i].what, &other);
        }
    }
}

/* The floor, and a wall that the character just clears, or just not, when gravity turns it to lie along x. */
static tahr_world *open_turning(const scene_backend *backend)
{
    tahr_body_desc bodies[2];
    tahr_world *world = NULL;
    for (int i = 0; i < 2; i++) {
        tahr_body_desc_init(&bodies[i], sizeof bodies[i], TAHR_BODY_BOX);
    }
    bodies[0].half_extents = (tahr_vec3){50, 50, 1};
    bodies[0].pose.position.z = -1;
    bodies[1].half_extents = (tahr_vec3){0.3, 50, 0.7};
    bodies[1].pose.position = (tahr_vec3){-1.1234567, 0, 1.2};
    assert_int_equal(scene_backend_open(backend, bodies, 2, NULL, &world), TAHR_OK);
    return world;
}

/* Turns one character beside the wall on a mover that has done nothing, or `warmed` steps of another character far away
 * or of itself at the same place, standing upright. */
static tahr_state turn(tahr_world *world, const tahr_config *config, tahr_vec3 at, int far, int warmed)
{
    tahr_input upright = {.struct_size = sizeof upright}, turned = upright;
    tahr_mover *mover = NULL;
    tahr_state other, s;
    tahr_vec3 place = far ? (tahr_vec3){30.3, 20, 20} : at;
    turned.flags = TAHR_INPUT_GRAVITY;
    turned.gravity = (tahr_vec3){9.81, 0, 0}; /* up is -x */
    assert_int_equal(tahr_mover_create(world, config, &mover), TAHR_OK);
    tahr_state_init(&other, config, &place);
    for (int i = 0; i < warmed; i++) {
        assert_true(tahr_mover_step(mover, far ? &turned : &upright, 1.0 / 60, &other, NULL) >= 0);
    }
    tahr_state_init(&s, config, &at);
    assert_true(tahr_mover_step(mover, &turned, 1.0 / 60, &s, NULL) >= 0);
    tahr_mover_destroy(mover);
    return s;
}

static void turning_gravity_does_not_ask_what_the_cache_holds(void **state)
{
    (void)state;
    for (int b = 0; b < SCENE_BACKEND_COUNT; b++) {
        const scene_backend *backend = &SCENE_BACKENDS[b];
        tahr_world *world = open_turning(backend);
        tahr_config config;
        int no_foot = 0, half = backend->native ? 300 : 60;
        tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
        for (int k = -half; k <= half; k++) { /* 1e-8 m apart: float and double, near and far disagree somewhere
                                               * there */
            tahr_vec3 at = {-0.8234567 + 1.8 + k * 1e-8, 0, 2.1};
            tahr_state cold = turn(world, &config, at, 0, 0), warm = turn(world, &config, at, 0, 2);
            tahr_state shared = turn(world, &config, at, 1, 1);
            if (memcmp(&cold, &warm, sizeof cold) != 0 || memcmp(&cold, &shared, sizeof cold) != 0) {
                fail_msg("%s, x %.17g: up of a cold mover %g, warm %g, shared %g", backend->name, at.x, cold.up.x,
                         warm.up.x, shared.up.x);
            }
            no_foot += cold.position.x > at.x - 0.45; /* turned about the centre, or not at all */
        }
        assert_in_range(no_foot, 1, 2 * half); /* both happened */
        tahr_world_close(world);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(restored_states_repeat_with_warm_caches),
        cmocka_unit_test(restored_states_repeat_with_cold_caches),
        cmocka_unit_test(restored_states_repeat_after_bodies_moved),
        cmocka_unit_test(one_mover_for_all_equals_one_each),
        cmocka_unit_test(cached_floors_change_nothing),
        cmocka_unit_test(caches_and_simd_change_nothing),
        cmocka_unit_test(turning_gravity_does_not_ask_what_the_cache_holds),
    };
    return cmocka_run_group_tests(tests, make_scene, drop_scene);
}
