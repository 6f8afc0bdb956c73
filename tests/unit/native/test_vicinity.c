/* SPDX-License-Identifier: MIT
 * test_vicinity.c: what is known of a place, and the short ways that come of it, change no bit of where anybody goes;
 * and are taken where the ground is open. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <tahr/tahr.h>

#include "native_world.h"
#include "scene_level.h"
#include "scene_wander.h"

enum { CHARACTERS = 6, TICKS = 400, WAYS = 4 };

/* Slopes that meet in creases and crests, all planes of rational numbers: many triangles in one plane but for
 * rounding. */
static double roofs(double x, double y)
{
    double a = fabs(fmod(fabs(x), 8) - 4), b = fabs(fmod(fabs(y), 12) - 6);
    return 0.3 * a + 0.125 * b;
}

/* Flat but for steps of a hair's breadth: planes that are nearly one. */
static double hairs(double x, double y)
{
    int cell = (int)floor(x / 2) * 7 + (int)floor(y / 2) * 3;
    return 1e-9 * (double)(cell % 5) + 1e-6 * (double)(cell % 3);
}

static double flat(double x, double y)
{
    (void)x;
    (void)y;
    return 0;
}

typedef struct walkers {
    tahr_world *world;
    tahr_mover *movers[CHARACTERS];
    tahr_state states[CHARACTERS];
    scene_wanderer wanderers[CHARACTERS];
    uint64_t spared, sweeps;
} walkers;

/* way 0: as it is by default; 1: without short ways; 2: without what is known of the place; 3: with neither, and
 * nothing gathered. */
static void open_walkers(walkers *w, int way, const tahr_body_desc *bodies, uint32_t count, const tahr_bounds *spawn)
{
    tahr_native_desc native = {.struct_size = sizeof native};
    tahr_world_desc desc;
    tahr_config config;
    uint64_t seed = 99;
    memset(w, 0, sizeof *w);
    native.no_vicinity = way >= 2;
    native.no_cache = way == 3;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bodies;
    desc.body_count = count;
    desc.options = &native;
    assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &w->world), TAHR_OK);
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    config.short_ways = way != 1 && way != 3;
    for (uint32_t i = 0; i < CHARACTERS; i++) {
        assert_int_equal(tahr_mover_create(w->world, &config, &w->movers[i]), TAHR_OK);
        assert_true(scene_wander_spawn(w->world, &config, spawn, &seed, &w->states[i]));
        scene_wander_start(&w->wanderers[i], 5, i);
    }
}

static void close_walkers(walkers *w)
{
    for (int i = 0; i < CHARACTERS; i++)
        tahr_mover_destroy(w->movers[i]);
    tahr_world_close(w->world);
}

/* What a step did, but for what it took to find out. */
static tahr_report step(walkers *w, int i, double dt)
{
    tahr_report r = {.struct_size = sizeof r};
    const tahr_input *input = scene_wander_next(&w->wanderers[i], dt);
    assert_true(tahr_mover_step(w->movers[i], input, dt, &w->states[i], &r) >= 0);
    w->spared += r.saved[TAHR_SHORTCUT_KNOWN_FLOOR] + r.saved[TAHR_SHORTCUT_CLEAR_AIR];
    w->sweeps += r.sweeps;
    memset(r.saved, 0, sizeof r.saved);
    r.triangle_tests = r.narrow_iterations = r.gathers = r.escapes = 0;
    return r;
}

/* Returns the part of all sweeps that was spared. */
static double compare(const tahr_body_desc *bodies, uint32_t count, const tahr_bounds *spawn)
{
    static walkers w[WAYS];
    for (int way = 0; way < WAYS; way++)
        open_walkers(&w[way], way, bodies, count, spawn);
    for (int t = 0; t < TICKS; t++) {
        const double dt = t % 50 < 10 ? 1.0 / 30 : t % 50 < 15 ? 1.0 / 240 : 1.0 / 60;
        for (int i = 0; i < CHARACTERS; i++) {
            const tahr_report first = step(&w[0], i, dt);
            for (int way = 1; way < WAYS; way++) {
                const tahr_report other = step(&w[way], i, dt);
                assert_memory_equal(&w[way].states[i], &w[0].states[i], sizeof w[0].states[i]);
                assert_memory_equal(&other, &first, sizeof first);
            }
        }
    }
    assert_int_equal(w[2].spared, 0);
    assert_int_equal(w[3].spared, 0);
    const double part = (double)w[0].spared / (double)w[0].sweeps;
    for (int way = 0; way < WAYS; way++)
        close_walkers(&w[way]);
    return part;
}

static tahr_body_desc body_of(scene_mesh *mesh, uint32_t flags)
{
    tahr_body_desc body;
    scene_level_body(mesh, &body);
    body.flags = flags;
    return body;
}

static double on_field(double cell, double (*height)(double, double), uint32_t flags)
{
    scene_mesh mesh = {0};
    const int cells = (int)(48 / cell);
    scene_mesh_field(&mesh, cells, cells, cell, height);
    const tahr_body_desc body = body_of(&mesh, flags);
    const tahr_bounds spawn = scene_mesh_bounds(&mesh);
    const double part = compare(&body, 1, &spawn);
    print_message("    cells of %g m: %.0f %% of the sweeps spared\n", cell, 100 * part);
    scene_mesh_free(&mesh);
    return part;
}

static void open_ground_is_walked_the_short_way(void **state)
{
    (void)state;
    assert_true(on_field(4, flat, TAHR_BODY_TWO_SIDED) > 0.6);
    assert_true(on_field(1, flat, 0) > 0.5);
}

static void planes_that_meet_or_nearly_meet_are_told_apart(void **state)
{
    (void)state;
    on_field(2, roofs, TAHR_BODY_TWO_SIDED);
    on_field(0.5, roofs, 0);
    on_field(2, hairs, TAHR_BODY_TWO_SIDED);
    on_field(0.25, scene_hills, 0);
}

/* Sheets over each other in one plane and a hair apart, boxes that lie flush, what is one-way and what leans. */
static void what_lies_in_one_plane_is_met_by_its_lowest_name(void **state)
{
    static native_grid grid, other;
    const tahr_bounds spawn = {{1, 1, -1}, {15, 15, 3}};
    tahr_body_desc bodies[8];
    (void)state;
    bodies[0] = native_grid_body(&grid, 8, 2, NULL);
    bodies[1] = native_grid_body(&other, 12, 1.25, NULL); /* its triangles overlap those of the first */
    bodies[2] = native_box(v_make(8, 8, -0.5), v_make(3, 3, 0.5));
    bodies[3] = native_box(v_make(14, 8, -0.5 - 1e-9), v_make(3, 3, 0.5));
    bodies[4] = native_box(v_make(3, 12, 0.1), v_make(1, 1, 0.1));
    bodies[5] = native_box(v_make(12, 3, 1), v_make(0.2, 2, 1));
    bodies[6] = native_box(v_make(12, 12, 0.3), v_make(1.5, 1.5, 0.05));
    bodies[6].flags = TAHR_BODY_ONE_WAY;
    bodies[7] = native_box(v_make(5, 5, 0), v_make(1, 2, 0.4));
    bodies[7].pose.orientation = (tahr_quat){0.1, 0.2, 0.05, sqrt(1 - 0.0525)};
    print_message("    %.0f %% of the sweeps spared\n", 100 * compare(bodies, 8, &spawn));
    assert_true(compare(&bodies[2], 1, &(tahr_bounds){{6, 6, -1}, {10, 10, 1}}) > 0.1);
}

/* One-sided, and every seventh triangle the wrong way round: a hole. */
static void a_triangle_that_faces_down_holds_nobody(void **state)
{
    static native_grid grid;
    const tahr_bounds spawn = {{2, 2, -1}, {22, 22, 2}};
    tahr_body_desc body = native_grid_body(&grid, 24, 1, NULL);
    (void)state;
    for (uint32_t t = 3; t < 24 * 24 * 2; t += 7) {
        const uint32_t a = grid.indices[3 * t];
        grid.indices[3 * t] = grid.indices[3 * t + 1];
        grid.indices[3 * t + 1] = a;
    }
    compare(&body, 1, &spawn);
}

/* Two floors that overlap, one a little lower, level and tilted: from one to the other and back. */
static void the_floor_is_that_of_the_higher_sheet(void **state)
{
    static native_grid low, high;
    const double heights[] = {1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 2e-3, 5e-3};
    const tahr_bounds spawn = {{-1, -1, -4}, {25, 13, 6}};
    (void)state;
    for (int i = 0; i < 16; i++) {
        tahr_body_desc bodies[2] = {native_grid_body(&low, 12, 1, NULL), native_grid_body(&high, 10, 1.3, NULL)};
        bodies[1].pose.position = v_make(9, 0.25, heights[i / 2]);
        if (i % 2) {
            const tahr_quat tilt = {0.06, 0.04, 0, sqrt(1 - 0.0052)};
            for (int k = 0; k < 2; k++)
                bodies[k].pose.orientation = tilt, bodies[k].flags = TAHR_BODY_TWO_SIDED;
        }
        compare(bodies, 2, &spawn);
    }
}

/* To and fro over the border of two great triangles, the second a little lower, so that the foot that has stood on it
 * is asked for in the plane of the first. */
static void steps(double lower, uint64_t dice)
{
    const double high[] = {-30, -30, 0, 2, -30, 0, 2, 40, 0};
    const double low[] = {2, -30, -lower, 30, -30, -lower, 2, 40, -lower};
    const uint32_t corners[] = {0, 1, 2};
    tahr_body_desc bodies[2];
    tahr_world *worlds[2];
    tahr_mover *movers[2];
    tahr_state states[2];
    tahr_input input = {.struct_size = sizeof input};
    oracle_random random = {dice};
    double way = 1;
    for (int i = 0; i < 2; i++) {
        tahr_body_desc_init(&bodies[i], sizeof bodies[i], TAHR_BODY_MESH);
        bodies[i].vertices = i ? low : high;
        bodies[i].indices = corners;
        bodies[i].vertex_count = 3;
        bodies[i].triangle_count = 1;
        bodies[i].flags = TAHR_BODY_TWO_SIDED;
    }
    for (uint32_t i = 0; i < 2; i++) {
        const tahr_native_desc native = {.struct_size = sizeof native, .no_vicinity = i};
        tahr_world_desc desc;
        tahr_config config;
        tahr_world_desc_init(&desc, sizeof desc);
        desc.bodies = bodies;
        desc.body_count = 2;
        desc.options = &native;
        assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &worlds[i]), TAHR_OK);
        tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
        config.max_speed = 1;
        config.perch_threshold = 0;
        config.short_ways = !i;
        assert_int_equal(tahr_mover_create(worlds[i], &config, &movers[i]), TAHR_OK);
        assert_int_equal(tahr_state_init(&states[i], &config, &(tahr_vec3){1.7, -10, 0.93}), TAHR_OK);
    }
    for (int n = 0; n < 1500; n++) {
        const double x = states[0].position.x - 2;
        way = x < -0.2 ? 1 : x > 0.25 ? -1 : oracle_below(&random, 12) == 0 ? -way : way;
        input.move.x = n < 30 ? 0 : way;
        for (int i = 0; i < 2; i++)
            assert_true(tahr_mover_step(movers[i], &input, 1.0 / 120, &states[i], NULL) >= 0);
        assert_memory_equal(&states[0], &states[1], sizeof states[0]);
    }
    for (int i = 0; i < 2; i++) {
        tahr_mover_destroy(movers[i]);
        tahr_world_close(worlds[i]);
    }
}

static void who_stood_lower_is_told_from_who_stands_in_the_plane(void **state)
{
    const double heights[] = {1e-9, 1e-6, 1e-5, 1e-4, 1e-3, 2e-3};
    (void)state;
    for (size_t i = 0; i < sizeof heights / sizeof heights[0]; i++) {
        for (uint64_t dice = 1; dice < 6; dice++)
            steps(heights[i], dice);
    }
}

/* Narrow ways between walls that stand upright, lean in or lean out, with ledges at the height of the head and a
 * ceiling: nowhere is there more room than a step or two, and still most walks meet none of it. */
static void who_walks_between_walls_is_told_from_who_meets_them(void **state)
{
    static native_grid grid;
    const tahr_bounds spawn = {{1, 1, -0.5}, {14, 14, 1}};
    (void)state;
    for (int lean = -1; lean <= 1; lean++) {
        tahr_body_desc bodies[14] = {native_grid_body(&grid, 8, 2, NULL)};
        bodies[0].flags = TAHR_BODY_TWO_SIDED;
        for (int i = 0; i < 6; i++) {
            const double x = 1.5 + 2.2 * i, half = 0.05 * lean;
            bodies[1 + i] = native_box(v_make(x, 8, 1), v_make(0.3, 5.5, 1.5));
            bodies[1 + i].pose.orientation = (tahr_quat){0, half, 0, sqrt(1 - half * half)};
            bodies[7 + i] = native_box(v_make(x + 0.5, 4 + i, 1.6), v_make(0.3, 0.7, 0.1));
        }
        bodies[13] = native_box(v_make(8, 8, 2.4), v_make(8, 8, 0.3));
        const double part = compare(bodies, 14, &spawn);
        print_message("    walls that lean by %.1f: %.0f %% of the sweeps spared\n", 0.1 * lean, 100 * part);
        assert_true(part > 0.2);
    }
}

/* Corners 5 cm apart, of which a cache takes no more than those of half a metre: level (flaw 0), with one corner that is
 * a hair higher (1), with a hole (2), in terraces with slopes between them (3). */
enum { FINE = 401 };
static void fill_fine(double heights[FINE * FINE], int flaw)
{
    for (int y = 0; y < FINE; y++) {
        for (int x = 0; x < FINE; x++) {
            const double terrace = 0.15 * (x / 60 + y / 90), slope = x % 60 < 12 ? 0.0125 * (12 - x % 60) : 0;
            heights[y * FINE + x] = flaw == 3 ? terrace - (x >= 60 ? slope : 0) : 0.25;
        }
    }
    if (flaw == 1) heights[200 * FINE + 200] += 1e-12;
    if (flaw == 2) heights[180 * FINE + 210] = NAN;
}

static double on_fine_field(const double *heights, uint32_t flags, uint32_t others)
{
    const tahr_bounds spawn = {{-8, -8, -1}, {8, 8, 3}};
    tahr_body_desc bodies[3];
    tahr_body_desc_init(&bodies[0], sizeof bodies[0], TAHR_BODY_HEIGHTS);
    bodies[0].heights = heights;
    bodies[0].columns = bodies[0].rows = FINE;
    bodies[0].half_extents = v_make(10, 10, 0);
    bodies[0].flags = flags;
    bodies[1] = native_box(v_make(1, 1, 0.5), v_make(0.3, 2, 0.5));
    bodies[2] = bodies[0]; /* another one through it */
    bodies[2].pose.position = v_make(0.0125, 9, 0);
    const double part = compare(bodies, 1 + others, &spawn);
    print_message("    a field of 5 cm, %u others: %.0f %% of the sweeps spared\n", others, 100 * part);
    return part;
}

static void fine_level_ground_is_walked_the_short_way_too(void **state)
{
    static double heights[FINE * FINE];
    (void)state;
    for (int flaw = 0; flaw < 4; flaw++) {
        fill_fine(heights, flaw);
        const double part = on_fine_field(heights, flaw % 2 ? 0 : TAHR_BODY_TWO_SIDED, 0);
        assert_true(part > (flaw == 3 ? 0.1 : 0.6));
    }
    fill_fine(heights, 0);
    assert_true(on_fine_field(heights, 0, 1) > 0.3);
    assert_true(on_fine_field(heights, 0, 2) > 0.1);
    on_fine_field(heights, TAHR_BODY_ONE_WAY, 0);
}

static void levels_are_walked_alike(void **state)
{
    const char *const names[] = {"playground", "dungeon", "nav_test"};
    (void)state;
    for (int i = 0; i < 3; i++) {
        scene_mesh mesh = {0};
        char why[256] = "";
        if (!scene_level_make(names[i], &mesh, why)) {
            print_message("    SKIP: %s: %s\n", names[i], why);
            continue;
        }
        const tahr_body_desc body = body_of(&mesh, TAHR_BODY_TWO_SIDED);
        const tahr_bounds spawn = scene_mesh_bounds(&mesh);
        print_message("    %s: %.0f %% of the sweeps spared\n", names[i], 100 * compare(&body, 1, &spawn));
        scene_mesh_free(&mesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(open_ground_is_walked_the_short_way),
        cmocka_unit_test(planes_that_meet_or_nearly_meet_are_told_apart),
        cmocka_unit_test(what_lies_in_one_plane_is_met_by_its_lowest_name),
        cmocka_unit_test(a_triangle_that_faces_down_holds_nobody),
        cmocka_unit_test(the_floor_is_that_of_the_higher_sheet),
        cmocka_unit_test(who_stood_lower_is_told_from_who_stands_in_the_plane),
        cmocka_unit_test(who_walks_between_walls_is_told_from_who_meets_them),
        cmocka_unit_test(fine_level_ground_is_walked_the_short_way_too),
        cmocka_unit_test(levels_are_walked_alike),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
