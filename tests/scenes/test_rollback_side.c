/* SPDX-License-Identifier: MIT
 * test_rollback_side.c: a step in a plane is a function of its inputs, on every backend: the same bits again from any
 * earlier state, whatever the caches hold, whoever steps, and after bodies were put back. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "scene_backend.h"
#include "scene_tiles.h"
#include "scene_wander.h"

enum { CHARACTERS = 6, STEPS = 480, REPLAYED = 40, LIFT = SCENE_TILE_BODIES };

typedef struct stage {
    tahr_world *world;
    tahr_mover *movers[CHARACTERS];
} stage;

static scene_tiles tiles;
static tahr_body_desc lift;
static tahr_input inputs[STEPS][CHARACTERS];
static tahr_state film[STEPS + 1][CHARACTERS];
static tahr_config config;

/* Rates change from step to step as on a busy machine. */
static double dt_of(int step)
{
    static const double DT[6] = {1.0 / 60, 1.0 / 60, 1.0 / 30, 1.0 / 144, 1.0 / 1000, 0.1};
    return DT[(step / 7) % 6];
}

static int make_scene(void **state)
{
    (void)state;
    scene_tiles_make(&tiles);
    tahr_body_desc_init(&lift, sizeof lift, TAHR_BODY_BOX);
    lift.flags = TAHR_BODY_MOVABLE;
    lift.half_extents = (tahr_vec3){1.2, 0.2, 5};
    lift.pose.position = (tahr_vec3){10, 0.3, 0};
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PLATFORMER);
    for (int c = 0; c < CHARACTERS; c++) {
        scene_wanderer wanderer;
        scene_wander_start(&wanderer, 3, (uint32_t)c);
        for (int s = 0; s < STEPS; s++) {
            inputs[s][c] = *scene_wander_next_side(&wanderer, dt_of(s));
            inputs[s][c].flags = s % 45 == 44 ? TAHR_INPUT_DROP : 0;
            if (c == 0 && s % 120 >= 60) { /* one rests often: that is where floors stay cached */
                inputs[s][c].move = (tahr_vec3){0, 0, 0};
            }
        }
    }
    return 0;
}

static void open_stage(stage *g, const scene_backend *backend)
{
    tahr_body_desc bodies[LIFT + 1];
    memcpy(bodies, scene_tiles_for(&tiles, backend->get()), sizeof tiles.bodies);
    bodies[LIFT] = lift;
    assert_int_equal(scene_backend_open(backend, bodies, LIFT + 1, NULL, &g->world), TAHR_OK);
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

/* The first on the lift, one on a one-way platform, the others among stairs and slopes. */
static void starting_states(void)
{
    for (int c = 0; c < CHARACTERS; c++) {
        tahr_vec3 place = {c == 0 ? 10 : 7 + 5.5 * (c - 1), 2.6, 0};
        assert_int_equal(tahr_state_init(&film[0][c], &config, &place), TAHR_OK);
    }
}

/* Up for 0.16 m in eight stages, then back at once. */
static void place_lift(stage *g, int step)
{
    tahr_body_pose pose = {LIFT, 0, {{10, 0.3 + 0.02 * (step / 16 % 8), 0}, {0, 0, 0, 1}}};
    assert_int_equal(tahr_world_set(g->world, &pose, 1), TAHR_OK);
}

static void take_step(stage *g, int step, int character, int shared, tahr_state *s)
{
    tahr_mover *mover = g->movers[shared ? 0 : character];
    tahr_status status = tahr_mover_step(mover, &inputs[step][character], dt_of(step), s, NULL);
    if (status < 0) {
        fail_msg("step %d, character %d: %s", step, character, tahr_status_name(status));
    }
}

/* Films once; who stands somewhere and who flies must both happen, or there would be nothing to see. */
static void film_once(stage *g)
{
    int walking = 0, falling = 0;
    memset(film, 0, sizeof film);
    starting_states();
    for (int s = 0; s < STEPS; s++) {
        place_lift(g, s);
        for (int c = 0; c < CHARACTERS; c++) {
            film[s + 1][c] = film[s][c];
            take_step(g, s, c, 0, &film[s + 1][c]);
            walking += film[s + 1][c].mode == TAHR_MODE_WALKING;
            falling += film[s + 1][c].mode == TAHR_MODE_FALLING;
        }
    }
    assert_true(walking > 400 && falling > 200);
}

/* Plays again from the states of step `from` and compares all of it. */
static void play_again(stage *g, const scene_backend *backend, const char *what, int from, int to)
{
    tahr_state now[CHARACTERS];
    int shared = strcmp(what, "one mover") == 0;
    memcpy(now, film[from], sizeof now);
    for (int s = from; s < to && s < STEPS; s++) {
        place_lift(g, s);
        for (int c = 0; c < CHARACTERS; c++) {
            take_step(g, s, c, shared, &now[c]);
            if (memcmp(&now[c], &film[s + 1][c], sizeof now[c]) != 0) {
                fail_msg("%s, %s from %d: step %d, character %d: %.17g %.17g, filmed %.17g %.17g", backend->name, what,
                         from, s, c, now[c].position.x, now[c].position.y, film[s + 1][c].position.x,
                         film[s + 1][c].position.y);
            }
        }
    }
}

static void check(const scene_backend *backend)
{
    stage g, fresh;
    open_stage(&g, backend);
    film_once(&g);
    for (int at = 0; at < STEPS; at += 61) {
        play_again(&g, backend, "warm, forward", at, at + REPLAYED);
    }
    for (int at = STEPS - 1; at >= 0; at -= 47) {
        play_again(&g, backend, "warm, backward", at, at + REPLAYED);
    }
    for (int at = 0; at < STEPS; at += 61) {
        open_stage(&fresh, backend);
        play_again(&fresh, backend, "cold", at, at + REPLAYED);
        close_stage(&fresh);
    }
    play_again(&g, backend, "one mover", 0, STEPS);
    close_stage(&g);
}

static void restored_states_repeat_in_space(void **unused)
{
    (void)unused;
    for (int i = 0; i < SCENE_BACKEND_COUNT; i++) {
        check(&SCENE_BACKENDS[i]);
    }
}

static void restored_states_repeat_in_a_plane(void **unused)
{
    (void)unused;
    for (int i = 0; i < SCENE_PLANAR_BACKEND_COUNT; i++) {
        check(&SCENE_PLANAR_BACKENDS[i]);
    }
    if (SCENE_PLANAR_BACKEND_COUNT == 0) {
        print_message("SKIP: scenes_rollback_side: built without Box2D\n");
        skip();
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(restored_states_repeat_in_space),
        cmocka_unit_test(restored_states_repeat_in_a_plane),
    };
    return cmocka_run_group_tests(tests, make_scene, NULL);
}
