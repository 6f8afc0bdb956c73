/* SPDX-License-Identifier: MIT
 * test_gather.c: triangles that the user hands over answer as a mesh of them would, bit for bit, whatever was
 * announced, cached or asked before. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <tahr/tahr.h>

#include "scene_level.h"
#include "soup.h"

static void gathered_triangles_answer_as_a_mesh_bit_for_bit(void **state)
{
    (void)state;
    for (int i = 0; i < SCENE_LEVELS; i++)
        soup_compare_level(SCENE_LEVEL_NAMES[i], 120);
}

/* The bodies of native_hills with the hills last, so that its id is the same where it is gathered. */
static void described_bodies_and_movers_may_be_there_besides(void **state)
{
    (void)state;
    static native_grid grid;
    tahr_body_desc bodies[NATIVE_HILLS], hills;
    soup soups[2];
    native_hills(&grid, bodies);
    hills = bodies[0];
    hills.flags = TAHR_BODY_TWO_SIDED; /* what is overlapped is left on either side, past edges if it stands alone */
    memmove(bodies, bodies + 1, (NATIVE_HILLS - 1) * sizeof bodies[0]);
    bodies[NATIVE_HILLS - 1] = hills;
    for (uint32_t i = 0; i < 2; i++) {
        soup_make(&soups[i], &hills, NATIVE_HILLS - 1);
        soups[i].reversed = i;
    }
    fixture worlds[3];
    for (uint32_t i = 0; i < 3; i++) {
        tahr_native_desc o = fixture_options();
        o.no_cache = i == 1;
        o.cache_triangles = 1000;
        if (i > 0) o.gather = soup_gather, o.gather_user = &soups[i - 1];
        fixture_init(&worlds[i]);
        assert_int_equal(fixture_open(&worlds[i], bodies, NATIVE_HILLS - (i > 0), &o, 1), TAHR_OK);
    }
    assert_true(soup_compare(worlds, 3, &soups[0], 1500) > 700);
    for (int i = 0; i < 3; i++)
        native_close(&worlds[i]);
    soup_free(&soups[0]);
    soup_free(&soups[1]);
}

enum { MANY = 300 };
/* Single triangles, the case in which a way out past the edges counts. Returns how many questions were stopped. */
static uint32_t compare_lone(uint32_t flags)
{
    static double vertices[MANY * 9];
    static uint32_t indices[MANY * 3];
    oracle_random r = {17};
    for (int i = 0; i < MANY; i++) {
        tahr_vec3 at = dice_vec(&r, -6, 6);
        for (int k = 0; k < 3; k++) {
            tahr_vec3 v = v_add(at, dice_vec(&r, -0.7, 0.7));
            vertices[9 * i + 3 * k] = v.x, vertices[9 * i + 3 * k + 1] = v.y, vertices[9 * i + 3 * k + 2] = v.z;
            indices[3 * i + k] = (uint32_t)(3 * i + k);
        }
    }
    tahr_body_desc mesh = fixture_mesh(vertices, MANY * 3, indices, MANY);
    mesh.flags = flags;
    soup soups[2];
    for (uint32_t i = 0; i < 2; i++) {
        soup_make(&soups[i], &mesh, 0);
        soups[i].reversed = i;
    }
    fixture worlds[SOUP_WORLDS];
    soup_open_all(worlds, &mesh, soups);
    uint32_t hits = soup_compare(worlds, SOUP_WORLDS, &soups[0], 1500);
    for (uint32_t i = 0; i < SOUP_WORLDS; i++)
        native_close(&worlds[i]);
    soup_free(&soups[0]);
    soup_free(&soups[1]);
    return hits;
}

static void lone_two_sided_triangles_are_left_past_their_edges_too(void **state)
{
    (void)state;
    assert_true(compare_lone(TAHR_BODY_TWO_SIDED) > 700);
}

/* Cached or not, in lanes or not, and whatever the order: only what comes down on them is stopped. */
static void gathered_triangles_may_be_one_way(void **state)
{
    (void)state;
    uint32_t solid = compare_lone(0), one_way = compare_lone(TAHR_BODY_ONE_WAY);
    assert_true(one_way > 20 && one_way < solid);
    assert_true(compare_lone(TAHR_BODY_ONE_WAY | TAHR_BODY_TWO_SIDED) > one_way);
}

/* A floor of two triangles, and what may be wrong with the second. */
typedef struct liar {
    tahr_triangle wrong;
    tahr_status status;
    double height;
    uint32_t null, calls;
} liar;

static tahr_status lie(void *user, const tahr_bounds *box, uint32_t mask, tahr_gather *out)
{
    liar *l = user;
    tahr_triangle floor = {.corners = {{-50, -50, l->height}, {50, -50, l->height}, {50, 50, l->height}}};
    (void)box, (void)mask;
    l->calls++;
    out->add(out, &floor);
    out->add(out, l->null ? NULL : &l->wrong);
    return l->status;
}

static const tahr_triangle RIGHT = {.corners = {{-50, -50, 0}, {50, 50, 0}, {-50, 50, 0}}, .feature = 1};

static void open_liar(fixture *f, liar *l, int with_cache)
{
    tahr_native_desc o = fixture_options();
    o.gather = lie;
    o.gather_user = l;
    fixture_init(f);
    assert_int_equal(fixture_open(f, NULL, 0, &o, with_cache), TAHR_OK);
}

/* A floor of one triangle: from above stopped a margin off it, from below and from within not at all. */
static void gathered_platforms_hold_what_comes_down(void **state)
{
    (void)state;
    for (int cached = 0; cached < 2; cached++) {
        liar l = {.wrong = RIGHT, .height = -30};
        fixture f;
        soup_answer a;
        l.wrong.flags = TAHR_BODY_ONE_WAY;
        open_liar(&f, &l, cached);
        tahr_sweep q = fixture_sweep(native_shape(1), v_make(-10, 10, 2), v_make(0, 0, -3), 0.01);
        if (cached) soup_announce(&f, q.position, q.up, 4);
        soup_ask(&f, &q, &a);
        assert_true(a.hit_count == 1 && fabs(a.hits[0].fraction - (2 - 0.9 - 0.01) / 3) < 1e-9);
        assert_int_equal(a.ray_count, 1);
        q.position.z = 0.8;
        soup_ask(&f, &q, &a);
        assert_true(a.hit_count == 0 && a.contact_count == 0);
        q.position.z = -2;
        q.motion.z = 4;
        soup_ask(&f, &q, &a);
        assert_true(a.hit_count == 0 && a.ray_count == 0);
        native_close(&f);
    }
}

static void what_is_wrong_with_a_triangle_fails_the_query_by_name(void **state)
{
    const char *const named[] = {
        "triangle 1: corners",       "triangle 1: corners",        "triangle 1: body",    "triangle 1: flags",
        "triangle 1: walkable_rule", "triangle 1: walkable_angle", "triangle 1: is NULL", "status -"};
    (void)state;
    for (int cached = 0; cached < 2; cached++) {
        for (int n = 0; n < 8; n++) {
            liar l = {.wrong = RIGHT};
            fixture f;
            soup_answer a;
            open_liar(&f, &l, cached);
            if (n == 0) l.wrong.corners[2].y = NAN;
            if (n == 1) l.wrong.corners[0].z = 1.1e7;
            if (n == 2) l.wrong.body = TAHR_NO_BODY;
            if (n == 3) l.wrong.flags = TAHR_BODY_SENSOR;
            if (n == 4) l.wrong.walkable_rule = TAHR_WALKABLE_NEVER + 1;
            if (n == 5) l.wrong.walkable_angle = INFINITY;
            if (n == 6) l.null = 1;
            if (n == 7) l.status = TAHR_E_MEMORY;
            tahr_sweep q = fixture_sweep(native_shape(1), v_make(0, 1, 2), v_make(0, 0, -3), 0.01);
            if (cached) soup_announce(&f, q.position, q.up, 1);
            soup_ask(&f, &q, &a);
            for (int i = 0; i < 3; i++)
                assert_int_equal(a.status[i], TAHR_E_BACKEND);
            assert_non_null(strstr(f.message, named[n]));
            l = (liar){.wrong = RIGHT}; /* nothing of it stays */
            if (cached) soup_announce(&f, v_make(100, 1, 2), q.up, 1);
            if (cached) soup_announce(&f, q.position, q.up, 1);
            soup_ask(&f, &q, &a);
            assert_int_equal(a.status[0], TAHR_OK);
            assert_true(a.hit_count == 1 && fabs(a.hits[0].fraction - (2 - 0.9 - 0.01) / 3) < 1e-9);
            native_close(&f);
        }
    }
}

static void the_ids_of_described_bodies_are_not_free(void **state)
{
    (void)state;
    liar l = {.wrong = RIGHT};
    tahr_native_desc o = fixture_options();
    tahr_body_desc box = native_box(v_make(0, 0, -9), v_make(1, 1, 1));
    fixture f;
    soup_answer a;
    o.gather = lie;
    o.gather_user = &l;
    fixture_init(&f);
    assert_int_equal(fixture_open(&f, &box, 1, &o, 0), TAHR_OK);
    tahr_sweep q = fixture_sweep(native_shape(1), v_make(0, 1, 2), v_make(0, 0, -3), 0.01);
    soup_ask(&f, &q, &a);
    assert_int_equal(a.status[0], TAHR_E_BACKEND);
    assert_non_null(strstr(f.message, "triangle 0: body"));
    native_close(&f);
}

/* fraction = (height above the floor - margin) / way: closed form. */
static void a_touch_makes_caches_forget(void **state)
{
    (void)state;
    tahr_world *world = NULL;
    liar l = {.wrong = RIGHT};
    tahr_native_desc o = fixture_options();
    tahr_world_desc desc;
    tahr_config config;
    tahr_state s;
    tahr_mover *mover = NULL;
    tahr_input input = {.struct_size = sizeof input};
    o.gather = lie;
    o.gather_user = &l;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.options = &o;
    assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &world), TAHR_OK);
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    tahr_state_init(&s, &config, &(tahr_vec3){0, 1, config.shape.half_height + config.skin});
    assert_int_equal(tahr_mover_create(world, &config, &mover), TAHR_OK);
    for (int i = 0; i < 30; i++)
        assert_int_equal(tahr_mover_step(mover, &input, 1.0 / 60, &s, NULL), TAHR_OK);
    assert_int_equal(s.mode, TAHR_MODE_WALKING);
    double stood = s.position.z;
    uint32_t calls = l.calls;
    for (int i = 0; i < 30; i++)
        assert_int_equal(tahr_mover_step(mover, &input, 1.0 / 60, &s, NULL), TAHR_OK);
    assert_int_equal(l.calls, calls); /* who rests asks nothing */
    l.height = -2;
    for (int i = 0; i < 3; i++)
        l.wrong.corners[i].z = -2;
    assert_int_equal(tahr_world_touch(world), TAHR_OK);
    for (int i = 0; i < 120; i++)
        assert_int_equal(tahr_mover_step(mover, &input, 1.0 / 60, &s, NULL), TAHR_OK);
    assert_int_equal(s.mode, TAHR_MODE_WALKING);
    assert_true(fabs(s.position.z - (stood - 2)) < 1e-6);
    tahr_mover_destroy(mover);
    tahr_world_close(world);
}

static uint64_t walk(const tahr_world_desc *desc, uint32_t steps)
{
    tahr_world *world = NULL;
    tahr_mover *mover = NULL;
    tahr_config config;
    tahr_state s;
    uint64_t hash = 0;
    oracle_random r = {5};
    tahr_input input = {.struct_size = sizeof input};
    assert_int_equal(tahr_world_open(tahr_backend_v1_native(), desc, &world), TAHR_OK);
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    tahr_state_init(&s, &config, &(tahr_vec3){1, 2, 1.5});
    assert_int_equal(tahr_mover_create(world, &config, &mover), TAHR_OK);
    for (uint32_t i = 0; i < steps; i++) {
        if (i % 40 == 0) input.move = dice_direction(&r), input.move.z = 0;
        input.jump = i % 90 == 50;
        assert_true(tahr_mover_step(mover, &input, 1.0 / 60, &s, NULL) >= 0);
        s.floor_revision = 0; /* worlds differ in it */
        hash = hash * 31 + tahr_state_hash(&s);
    }
    tahr_mover_destroy(mover);
    tahr_world_close(world);
    return hash;
}

static void a_character_walks_on_gathered_triangles_as_on_a_mesh(void **state)
{
    (void)state;
    scene_mesh mesh = {0};
    char why[256];
    tahr_body_desc body;
    soup s;
    assert_true(scene_level_make("playground", &mesh, why));
    scene_level_body(&mesh, &body);
    soup_make(&s, &body, 0);
    tahr_native_desc o = fixture_options();
    tahr_world_desc desc;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.options = &o;
    desc.bodies = &body;
    desc.body_count = 1;
    uint64_t meshed = walk(&desc, 1500);
    desc.body_count = 0;
    o.gather = soup_gather;
    o.gather_user = &s;
    o.cache_triangles = 512;
    assert_true(walk(&desc, 1500) == meshed);
    assert_true(s.calls < 1500); /* most steps are answered by what was gathered before */
    o.no_cache = 1;
    assert_true(walk(&desc, 300) != 0);
    soup_free(&s);
    scene_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gathered_triangles_answer_as_a_mesh_bit_for_bit),
        cmocka_unit_test(described_bodies_and_movers_may_be_there_besides),
        cmocka_unit_test(lone_two_sided_triangles_are_left_past_their_edges_too),
        cmocka_unit_test(gathered_triangles_may_be_one_way),
        cmocka_unit_test(gathered_platforms_hold_what_comes_down),
        cmocka_unit_test(what_is_wrong_with_a_triangle_fails_the_query_by_name),
        cmocka_unit_test(the_ids_of_described_bodies_are_not_free),
        cmocka_unit_test(a_touch_makes_caches_forget),
        cmocka_unit_test(a_character_walks_on_gathered_triangles_as_on_a_mesh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
