/* SPDX-License-Identifier: MIT
 * test_form.c: triangles that are formed some at a time are, bit for bit, those that are formed one by one. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "fake_host.h"
#include "native/form.h"

enum { TRIANGLES = 120, BLOCKS = TRIANGLES / TAHR__LANES };

typedef struct scene {
    fake_memory memory;
    fake_log log;
    tahr_host host;
    tahr__native world;
    tahr__body bodies[2];
    tahr__prim prims[TRIANGLES], expected[TRIANGLES];
    float blocks[BLOCKS * TAHR__LANE_ROWS * TAHR__LANES], expected_blocks[BLOCKS * TAHR__LANE_ROWS * TAHR__LANES];
} scene;

/* Triangles of 1 mm to 10 m up to 60 m away, of which some are thin and some flat: with planes and without. */
static void build_mesh(scene *s, tahr__body *body, oracle_random *r)
{
    double vertices[9 * TRIANGLES];
    uint32_t indices[3 * TRIANGLES];
    for (uint32_t i = 0; i < TRIANGLES; i++) {
        double size = pow(10, oracle_uniform(r, -3, 1));
        tahr_vec3 at = dice_vec(r, -60, 60), v[3];
        if (i % 2) at = dice_vec(r, -3, 3);
        for (int k = 0; k < 3; k++) {
            v[k] = v_add(at, v_scale(dice_vec(r, -1, 1), size));
            if (i % 3 == 0) v[k].z = 0.25;
        }
        if (i % 10 == 0) v[2] = v_add(v_mad(v[0], v_sub(v[1], v[0]), 0.4), v_scale(dice_vec(r, -1, 1), 1e-6 * size));
        for (int k = 0; k < 3; k++) {
            vertices[9 * i + 3 * (uint32_t)k] = v[k].x;
            vertices[9 * i + 3 * (uint32_t)k + 1] = v[k].y;
            vertices[9 * i + 3 * (uint32_t)k + 2] = v[k].z;
            indices[3 * i + (uint32_t)k] = 3 * i + (uint32_t)k;
        }
    }
    tahr__mesh_source source = {vertices, indices, 3 * TRIANGLES, TRIANGLES, 0, 0};
    assert_int_equal(tahr__mesh_build(&s->host, &source, &body->mesh), TAHR_OK);
    assert_int_equal(body->mesh.triangle_count, TRIANGLES);
}

static void begin(scene *s, oracle_random *r)
{
    memset(s, 0, sizeof *s);
    s->host.allocator = fake_allocator(&s->memory);
    s->host.log = fake_log_of(&s->log);
    s->world.host = &s->host;
    s->world.bodies = s->bodies;
    s->world.body_count = 2;
    for (int i = 0; i < 2; i++) {
        tahr__body *b = &s->bodies[i];
        b->type = TAHR_BODY_MESH;
        b->mask = 7;
        b->surface = 40 + (uint32_t)i;
        b->turn = m_identity();
        b->position = i ? v_make(1.5, -2.25, 0.125) : v_make(0, 0, 0);
        b->flags = i ? (uint32_t)TAHR_BODY_TWO_SIDED : 0u;
        build_mesh(s, b, r);
    }
    s->bodies[1].turn = m_upright(dice_direction(r));
    s->bodies[1].turned = 1;
}

static void end(scene *s)
{
    for (int i = 0; i < 2; i++)
        tahr__mesh_free(&s->host, &s->bodies[i].mesh);
    assert_int_equal(s->memory.live_blocks, 0);
}

/* Some of body 0, then some of body 1, in steps of three and seven: groups begin anywhere. Returns how many. */
static uint32_t put_heads(scene *s, uint32_t first)
{
    uint32_t items[TRIANGLES], count[2] = {0, 0};
    for (uint32_t i = 0; i < TRIANGLES / 2 - 3; i++)
        items[i] = i * 7 % TRIANGLES;
    count[0] = first;
    count[1] = TRIANGLES / 2 - 3;
    tahr__form_heads(&s->bodies[0], 0, items, count[0], s->prims);
    tahr__form_heads(&s->bodies[1], 1, items, count[1], s->prims + count[0]);
    return count[0] + count[1];
}

static void expect(scene *s, const tahr__frame *frame, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        tahr__prim *p = &s->expected[i];
        const tahr__body *body = &s->bodies[s->prims[i].body];
        tahr__map map = tahr__map_make(frame, body);
        tahr__prim_begin(body, s->prims[i].body, p);
        tahr__prim_triangle(&map, body, s->prims[i].item, p);
        const tahr_vec3 *v = p->facet.v;
        tahr_bounds box = {v_min(v[0], v_min(v[1], v[2])), v_max(v[0], v_max(v[1], v[2]))};
        tahr__lanes_put(s->expected_blocks, i, &box, p->kind & TAHR__PLANELESS ? NULL : &p->facet);
    }
    tahr__lanes_end(s->expected_blocks, count);
}

/* How many of the lanes have planes. */
static uint32_t compare(scene *s, const tahr__frame *frame, uint32_t count)
{
    uint32_t planes = 0;
    tahr__form_lanes(&s->world, frame, s->prims, s->blocks, count);
    tahr__lanes_end(s->blocks, count);
    uint32_t used = (count + TAHR__LANES - 1) / TAHR__LANES;
    assert_memory_equal(s->blocks, s->expected_blocks, used * TAHR__LANE_ROWS * TAHR__LANES * sizeof(float));
    for (uint32_t i = 0; i < count; i++) {
        const float *n = &s->blocks[tahr__lane(i, TAHR__LANE_NORMAL)];
        planes += n[0] != 0 || n[TAHR__LANES] != 0 || n[2 * TAHR__LANES] != 0;
        if (s->prims[i].kind & TAHR__UNFORMED) tahr__form_rest(&s->world, frame, &s->prims[i]);
        assert_memory_equal(&s->prims[i], &s->expected[i], sizeof s->prims[i]);
    }
    return planes;
}

static void check(const tahr__former *former)
{
    static scene s;
    oracle_random r = {21};
    uint32_t planes = 0, all = 0;
    for (uint32_t n = 0; n < 48; n++) {
        begin(&s, &r);
        s.world.former = *former;
        tahr__frame frame = tahr__frame_make(dice_vec(&r, -20, 20), n % 3 ? v_make(0, 0, 1) : dice_direction(&r));
        uint32_t count = put_heads(&s, n);
        expect(&s, &frame, count);
        planes += compare(&s, &frame, count);
        all += count;
        end(&s);
    }
    assert_true(planes > all / 8 && planes < all); /* both kinds have been seen */
}

static void formed_together_is_formed_one_by_one(void **state)
{
    (void)state;
    for (uint32_t width = 1; width <= TAHR__FORMED; width *= 2) {
        const tahr__former former = tahr__former_of(width);
        if (former.width < width) printf("    %u at a time: not here\n", (unsigned)width);
        check(&former);
    }
    assert_int_equal(tahr__former_of(1).width, 1);
}

/* Lanes of what was stored among them, at any place of a block. */
static void what_is_stored_between_is_left_alone(void **state)
{
    (void)state;
    static scene s;
    static float before[BLOCKS * TAHR__LANE_ROWS * TAHR__LANES];
    oracle_random r = {22};
    for (uint32_t n = 0; n < 3 * 23; n++) {
        const uint32_t stored = 1 + n / 3;
        begin(&s, &r);
        s.world.former = tahr__former_of(2u << n % 3);
        tahr__frame frame = tahr__frame_make(dice_vec(&r, -20, 20), v_make(0, 0, 1));
        uint32_t count = put_heads(&s, 24);
        s.prims[stored].kind &= ~(uint32_t)TAHR__UNFORMED;
        for (uint32_t i = 0; i < sizeof before / sizeof before[0]; i++)
            before[i] = s.blocks[i] = (float)(i + 1);
        tahr__form_lanes(&s.world, &frame, s.prims, s.blocks, count);
        for (uint32_t row = 0; row < TAHR__LANE_ROWS; row++) {
            for (uint32_t i = 0; i < count; i++) {
                int same = s.blocks[tahr__lane(i, row)] == before[tahr__lane(i, row)];
                assert_int_equal(same, i == stored);
            }
        }
        end(&s);
    }
}

enum { COLUMNS = 7, ROWS = 9, CELLS = (COLUMNS - 1) * (ROWS - 1), MOST = 2 * CELLS };

/* A field with 0.3 m between its heights, in place of the body's mesh. */
static void open_field(scene *s, tahr__body *body, uint32_t columns, oracle_random *r)
{
    double heights[COLUMNS * ROWS];
    tahr_body_desc d;
    tahr_bounds bounds;
    tahr__mesh_free(&s->host, &body->mesh);
    memset(&body->mesh, 0, sizeof body->mesh);
    memset(&d, 0, sizeof d);
    for (int i = 0; i < COLUMNS * ROWS; i++)
        heights[i] = oracle_uniform(r, -0.2, 0.2);
    d.columns = columns;
    d.rows = ROWS;
    d.heights = heights;
    d.half_extents = v_make(0.15 * (columns - 1), 1.2, 0);
    assert_int_equal(tahr__heights_open(&s->host, &d, 0, &body->heights, &bounds), TAHR_OK);
    assert_int_equal(body->heights.may_be_thin, 0);
    body->type = TAHR_BODY_HEIGHTS;
}

/* Are these lanes of a field's triangle, bit for bit, those that are made of it alone? */
static void assert_formed(scene *s, const tahr__map *map, uint32_t i)
{
    const uint32_t id = s->prims[i].body, item = s->prims[i].item;
    const tahr__body *body = &s->bodies[id];
    tahr_vec3 v[3];
    tahr__prim p;
    assert_true(tahr__heights_triangle(&body->heights, item, v));
    tahr__prim_begin(body, id, &p);
    tahr__prim_heights(map, body, item, v, &p);
    const tahr_vec3 *c = p.facet.v;
    tahr_bounds box = {v_min(c[0], v_min(c[1], c[2])), v_max(c[0], v_max(c[1], c[2]))};
    tahr__lanes_put(s->expected_blocks, i, &box, &p.facet);
    for (uint32_t row = 0; row < TAHR__LANE_ROWS; row++)
        assert_memory_equal(&s->blocks[tahr__lane(i, row)], &s->expected_blocks[tahr__lane(i, row)], sizeof(float));
}

/* From any triangle on, in the field's order or in steps: pairs are whole and cut, rows end within a group. */
static void triangles_of_a_field_are_formed_together_as_one_by_one(void **state)
{
    (void)state;
    static scene s;
    oracle_random r = {23};
    const tahr__former formers[] = {tahr__former_of(8), tahr__former_of(4), tahr__former_of(2)};
    for (uint32_t n = 0; n < 2 * MOST; n++) {
        uint32_t items[MOST], step = n % 3 ? 1 : 1 + 2 * oracle_below(&r, MOST / 2), count = 0;
        begin(&s, &r);
        tahr__body *body = &s.bodies[1];
        open_field(&s, body, COLUMNS, &r);
        s.world.former = formers[n / 3 % 3];
        tahr__frame frame = tahr__frame_make(dice_vec(&r, -20, 20), n % 3 ? v_make(0, 0, 1) : dice_direction(&r));
        for (uint32_t at = n % MOST; at < MOST && count < MOST; at += step)
            items[count++] = at;
        tahr__form_heads(body, 1, items, count, s.prims);
        tahr__form_lanes(&s.world, &frame, s.prims, s.blocks, count);
        tahr__map map = tahr__map_make(&frame, body);
        for (uint32_t i = 0; i < count; i++)
            assert_formed(&s, &map, i);
        tahr__heights_close(&s.host, &body->heights);
        end(&s);
    }
}

/* Where one field ends and one of other columns begins the rows of the first count for nothing. */
static void two_fields_are_formed_each_by_its_own_rows(void **state)
{
    (void)state;
    static scene s;
    oracle_random r = {29};
    const tahr__former formers[] = {tahr__former_of(8), tahr__former_of(4), tahr__former_of(2)};
    for (uint32_t n = 0; n < 200; n++) {
        const uint32_t columns[2] = {COLUMNS, 2 + n % (COLUMNS - 1)};
        uint32_t items[TRIANGLES], count = 0;
        tahr__map maps[2];
        begin(&s, &r);
        s.world.former = formers[n / 3 % 3];
        tahr__frame frame = tahr__frame_make(dice_vec(&r, -20, 20), v_make(0, 0, 1));
        for (uint32_t id = 0; id < 2; id++) {
            open_field(&s, &s.bodies[id], columns[id], &r);
            const uint32_t last = 2 * (columns[id] - 1) * (ROWS - 1), some = 1 + oracle_below(&r, 8);
            for (uint32_t i = 0; i < some; i++)
                items[i] = oracle_below(&r, last);
            tahr__form_heads(&s.bodies[id], id, items, some, s.prims + count);
            maps[id] = tahr__map_make(&frame, &s.bodies[id]);
            count += some;
        }
        tahr__form_lanes(&s.world, &frame, s.prims, s.blocks, count);
        for (uint32_t i = 0; i < count; i++)
            assert_formed(&s, &maps[s.prims[i].body], i);
        for (int id = 0; id < 2; id++)
            tahr__heights_close(&s.host, &s.bodies[id].heights);
        end(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_stored_between_is_left_alone),
        cmocka_unit_test(triangles_of_a_field_are_formed_together_as_one_by_one),
        cmocka_unit_test(two_fields_are_formed_each_by_its_own_rows),
        cmocka_unit_test(formed_together_is_formed_one_by_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
