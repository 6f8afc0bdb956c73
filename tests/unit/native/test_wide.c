/* SPDX-License-Identifier: MIT
 * test_wide.c: the tree of eight children a node finds all that is within reach, at every width the same, and grows
 * little with what is in it. What is within reach says a plain loop over exact boxes. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "common/processor.h"
#include "common/wide.h"
#include "dice.h"
#include "fake_host.h"

enum { MOST = 4000 };

typedef struct scene {
    fake_memory memory;
    tahr_host host;
    tahr_bounds boxes[MOST];
    tahr__bvh_box scratch[MOST];
    uint32_t order[MOST], count;
    tahr_vec3 centre;
    double size; /* of all of it */
    tahr__wide tree;
} scene;

static void build(scene *s)
{
    tahr_bounds all = s->boxes[0];
    memset(&s->memory, 0, sizeof s->memory);
    s->host.allocator = fake_allocator(&s->memory);
    for (uint32_t i = 0; i < s->count; i++) {
        all.min = v_min(all.min, s->boxes[i].min);
        all.max = v_max(all.max, s->boxes[i].max);
    }
    s->centre = v_scale(v_add(all.min, all.max), 0.5);
    s->size = v_length(v_sub(all.max, all.min));
    for (uint32_t i = 0; i < s->count; i++)
        s->scratch[i] = tahr__bvh_box_make(&s->boxes[i], s->centre);
    assert_int_equal(tahr__wide_build(&s->host, s->scratch, s->order, s->count, s->centre, &s->tree), TAHR_OK);
}

static void discard(scene *s)
{
    tahr__wide_free(&s->host, &s->tree);
    assert_int_equal(s->memory.live_blocks, 0);
}

/* Kinds: 0 a flat floor with things on it, 1 a cloud, 2 all boxes alike, 3 points along a line, 4 one huge box over
 * small ones. */
enum { KINDS = 5 };
static void make(scene *s, uint32_t kind, uint32_t count, tahr_vec3 offset, oracle_random *r)
{
    s->count = count;
    for (uint32_t i = 0; i < count; i++) {
        tahr_vec3 at = dice_vec(r, 0, 20), size = v_abs(dice_vec(r, 0, 0.4));
        if (kind == 0 && i % 4) at.z = size.z = 0;
        if (kind == 2) at = v_make(3, 4, 5), size = v_make(0.5, 0.25, 0);
        if (kind == 3) at.y = at.z = 0, size = v_make(0, 0, 0);
        if (kind == 4 && i == 0) at = v_make(-4000, -3000, -1), size = v_make(9000, 7000, 3);
        s->boxes[i].min = v_add(at, offset);
        s->boxes[i].max = v_add(s->boxes[i].min, size);
    }
    build(s);
}

/* The n-th tree, when the one before is not needed any more: of every kind and size, near and far out. 0: that was all.
 */
static int next_tree(scene *s, uint32_t n, oracle_random *r)
{
    static const uint32_t counts[] = {1, 2, 8, 9, 65, 1000, MOST};
    static const tahr_vec3 offsets[] = {{0, 0, 0}, {1e6, -2e6, 3e5}};
    if (n > 0) discard(s);
    if (n == KINDS * 14) return 0;
    make(s, n % KINDS, counts[n / KINDS % 7], offsets[n / KINDS / 7], r);
    return 1;
}

static double gap(const tahr_bounds *a, const tahr_bounds *b)
{
    tahr_vec3 apart = v_max(v_max(v_sub(a->min, b->max), v_sub(b->min, a->max)), v_make(0, 0, 0));
    return v_length(apart);
}

static tahr_bounds random_box(const scene *s, oracle_random *r)
{
    tahr_vec3 at = v_add(s->boxes[oracle_below(r, s->count)].min, dice_vec(r, -1, 1));
    return (tahr_bounds){at, v_add(at, v_abs(dice_vec(r, 0, 1)))};
}

/* How much larger than they are boxes may be in the tree: two places on the lattice of 2^24 and what single precision
 * leaves out, 2^-22 of the size, and the steps of the nodes above an item, each a 255th of its node's box (the next
 * power of two: at most twice that), whose sides halve at least every three levels: a 16th of the size covers all. */
static double slack(const scene *s)
{
    return s->size / 16;
}

static void check_walk(const scene *s, const tahr_bounds *box, double reach, const tahr_vec3 *near)
{
    static uint32_t times[MOST];
    tahr__wide_walk walk;
    uint32_t item;
    memset(times, 0, sizeof times);
    tahr__wide_walk_begin(&walk, &s->tree, box, reach, near);
    while (tahr__wide_walk_next(&walk, &item)) {
        assert_true(item < s->count);
        times[s->order[item]]++;
    }
    for (uint32_t i = 0; i < s->count; i++) {
        double away = gap(&s->boxes[i], box);
        assert_true(times[i] <= 1);
        if (away <= reach) assert_int_equal(times[i], 1);
        if (away > reach + slack(s) && away < 60 * s->size) assert_int_equal(times[i], 0); /* 64: as far as is told */
    }
}

static void a_walk_finds_every_item_within_reach_once(void **state)
{
    (void)state;
    static scene s;
    oracle_random r = {5};
    for (uint32_t n = 0; next_tree(&s, n, &r); n++) {
        for (int q = 0; q < 60; q++) {
            tahr_bounds box = random_box(&s, &r);
            double reach = q % 3 ? oracle_uniform(&r, 0, 1.5) : 0;
            check_walk(&s, &box, reach, q % 2 ? &box.min : NULL);
        }
    }
}

static void a_walk_that_is_narrowed_misses_nothing_in_the_narrower_box(void **state)
{
    (void)state;
    static scene s;
    static uint32_t seen[MOST];
    oracle_random r = {6};
    uint32_t after = 0;
    make(&s, 0, MOST, v_make(0, 0, 0), &r);
    for (int q = 0; q < 400; q++) {
        tahr_bounds box = random_box(&s, &r), less = box;
        double reach = oracle_uniform(&r, 0, 2);
        uint32_t item, until = oracle_below(&r, 30), found = 0;
        tahr__wide_walk walk;
        less.max = v_add(less.min, v_scale(v_sub(box.max, box.min), 0.1));
        memset(seen, 0, sizeof seen);
        tahr__wide_walk_begin(&walk, &s.tree, &box, reach, &box.min);
        while (tahr__wide_walk_next(&walk, &item)) {
            seen[s.order[item]]++;
            if (found++ == until) tahr__wide_walk_narrow(&walk, &less);
            after += found > until;
        }
        for (uint32_t i = 0; i < s.count; i++) {
            assert_true(seen[i] <= 1);
            if (gap(&s.boxes[i], &less) <= reach) assert_int_equal(seen[i], 1);
        }
    }
    assert_true(after > 1000);
    discard(&s);
}

/* More than a walk keeps in order, and all of them wait at once. */
static void a_walk_finds_all_of_a_tree_that_is_within_reach(void **state)
{
    (void)state;
    static scene s;
    oracle_random r = {12};
    for (uint32_t kind = 0; kind < KINDS; kind++) {
        make(&s, kind, MOST, v_make(0, 0, 0), &r);
        for (int q = 0; q < 20; q++) {
            tahr_bounds box = random_box(&s, &r);
            check_walk(&s, &box, q % 2 ? 9 : 100, &box.min);
        }
        discard(&s);
    }
}

static void the_nearest_come_first(void **state)
{
    (void)state;
    static scene s;
    oracle_random r = {7};
    make(&s, 1, MOST, v_make(0, 0, 0), &r);
    for (int q = 0; q < 300; q++) {
        tahr_bounds box = random_box(&s, &r), point = {box.min, box.min};
        double before = 0;
        uint32_t item;
        tahr__wide_walk walk;
        tahr__wide_walk_begin(&walk, &s.tree, &box, 2, &box.min);
        while (tahr__wide_walk_next(&walk, &item)) {
            double away = gap(&s.boxes[s.order[item]], &point);
            /* Eight boxes of 0.4 m that are neighbours among 4000 in 20 m lie within 5 m of each other, and steps are a
             * 64th of that at most, on either side. */
            assert_true(away >= before - 2 * 5.0 / 64);
            before = d_max(before, away);
        }
    }
    discard(&s);
}

/* How far two boxes are apart along the axis where that is most. */
static double most_apart(const tahr_bounds *a, const tahr_bounds *b)
{
    tahr_vec3 apart = v_max(v_sub(a->min, b->max), v_sub(b->min, a->max));
    return d_max(apart.x, d_max(apart.y, apart.z));
}

static void check_collected(const scene *s, const tahr_bounds *box, double reach)
{
    static uint32_t items[MOST + TAHR__WIDE], others[MOST + TAHR__WIDE], times[MOST];
    uint32_t count = tahr__wide_collect(&s->tree, box, reach, items, MOST);
    assert_true(count <= MOST);
    memset(times, 0, sizeof times);
    for (uint32_t i = 0; i < count; i++) {
        assert_true(items[i] < s->count);
        times[s->order[items[i]]]++;
    }
    for (uint32_t i = 0; i < s->count; i++) {
        double away = most_apart(&s->boxes[i], box);
        assert_true(times[i] <= 1);
        if (away <= reach) assert_int_equal(times[i], 1);
        if (away > reach + slack(s) && away < 60 * s->size) assert_int_equal(times[i], 0);
    }
    if (count < 2) return;
    /* Of what there is no room for as much is said, and no more than seven are written beyond it. */
    memset(others, 0xff, sizeof others);
    assert_true(tahr__wide_collect(&s->tree, box, reach, others, count - 2) > count - 2);
    assert_memory_equal(items, others, (count - 2) * sizeof items[0]);
    for (uint32_t i = count - 2 + TAHR__WIDE; i < MOST + TAHR__WIDE; i++)
        assert_int_equal(others[i], 0xFFFFFFFFu);
}

static void collecting_finds_every_item_within_reach_once(void **state)
{
    (void)state;
    static scene s;
    oracle_random r = {8};
    for (uint32_t n = 0; next_tree(&s, n, &r); n++) {
        for (int q = 0; q < 60; q++) {
            tahr_bounds box = random_box(&s, &r);
            if (q % 20 == 0) box.max.x += 1e12; /* farther than is told apart */
            if (q % 30 == 0) box.min.y -= 1e12;
            check_collected(&s, &box, q % 10 == 5 ? 1e12 : q % 3 ? oracle_uniform(&r, 0, 1.5) : 0);
        }
    }
}

static void every_width_collects_the_same_items(void **state)
{
    (void)state;
    static scene s;
    static uint32_t one[MOST + TAHR__WIDE], many[MOST + TAHR__WIDE];
    oracle_random r = {13};
    tahr__wide_items_fn *const widths[] = {tahr__wide_items_8, tahr__wide_items_512};
    const int has[] = {tahr__has_avx2(), tahr__has_avx512()};
    if (!has[0]) printf("SKIP: every_width_collects_the_same_items at eight: this processor has no AVX2\n");
    if (!has[1]) printf("SKIP: every_width_collects_the_same_items at 512: this processor has no AVX-512\n");
    uint32_t found = 0, passed = 0;
    for (uint32_t kind = 0; kind < KINDS; kind++) {
        make(&s, kind, MOST, v_make(0, 0, 0), &r);
        for (int q = 0; q < 4000; q++) {
            /* Of all sizes, around a node, up to the last place that a query may have. */
            const tahr__wide_node *n = &s.tree.nodes[oracle_below(&r, s.tree.node_count)];
            const double width = pow(2, oracle_uniform(&r, 0, 24));
            tahr__wide_box box = {.limit = 0};
            for (int a = 0; a < 3; a++) {
                double at = (int32_t)(n->base[a] & 0xFFFFFF) + width * oracle_uniform(&r, -1.5, 0.5);
                box.lo[a] = q % 16 == a ? -(1 << 30) : (int32_t)at;
                box.hi[a] = q % 32 == a ? 1 << 30 : (int32_t)(at + width);
                if (q % 64 == 4 * a) box.lo[a] = box.hi[a] = 1 << 30;
            }
            const uint32_t room = q % 8 ? MOST : oracle_below(&r, 40);
            const uint32_t count = tahr__wide_items_1(&s.tree, &box, one, room);
            for (int w = 0; w < 2; w++) {
                if (!has[w]) continue;
                assert_int_equal(widths[w](&s.tree, &box, many, room), count);
                assert_memory_equal(one, many, (count < room ? count : room) * sizeof one[0]);
            }
            found += count > 0;
            passed += count > room;
        }
        discard(&s);
    }
    assert_true(found > 2000 && found < KINDS * 4000 - 2000 && passed > 200);
}

static void check_width(tahr__wide_fn *test, const tahr__wide_node *n, const tahr__wide_box *box, const int32_t at[4])
{
    float away[TAHR__WIDE] = {0}, other[TAHR__WIDE] = {0};
    uint32_t count = (n->base[0] >> 29) + 1, near = tahr__wide_test_1(n, box, at, away);
    assert_int_equal(test(n, box, at, other), near);
    assert_int_equal(test(n, box, at, NULL), near);
    assert_memory_equal(away, other, count * sizeof away[0]);
}

static void every_width_sees_the_same_bits(void **state)
{
    (void)state;
    static scene s;
    oracle_random r = {9};
    int has_avx2 = tahr__wide_best() == tahr__wide_test_8;
    uint32_t within = 0;
    if (!has_avx2) printf("SKIP: every_width_sees_the_same_bits at eight: this processor has no AVX2\n");
    make(&s, 1, MOST, v_make(0, 0, 0), &r);
    for (uint32_t q = 0; q < 40000; q++) {
        const tahr__wide_node *n = &s.tree.nodes[oracle_below(&r, s.tree.node_count)];
        tahr__wide_box box = {.limit = (float)pow(10, oracle_uniform(&r, 0, 14))};
        int32_t at[4] = {0};
        for (int a = 0; a < 3; a++) {
            int32_t base = (int32_t)(n->base[a] & 0xFFFFFF), step = 1 << (n->base[a] >> 24 & 31);
            box.lo[a] = base + step * (int32_t)oracle_uniform(&r, -100, 300);
            box.hi[a] = box.lo[a] + (int32_t)oracle_uniform(&r, 0, 1e5);
            at[a] = base + (int32_t)(step * oracle_uniform(&r, -100, 300));
            if (q % 16 == 0) box.hi[a] = 1 << 30;
            if (q % 32 == 0) box.lo[a] = at[a] = -(1 << 30);
        }
        check_width(tahr__wide_test_4, n, &box, at);
        if (has_avx2) check_width(tahr__wide_test_8, n, &box, at);
        within += tahr__wide_test_1(n, &box, at, NULL) != 0;
    }
    assert_true(within > 4000 && within < 36000);
    discard(&s);
}

static uint32_t looked_at;

static uint32_t count_nodes(const tahr__wide_node *node, const tahr__wide_box *box, const int32_t at[4], float *away)
{
    looked_at++;
    return tahr__wide_test_1(node, box, at, away);
}

/* A floor of cells x cells squares of 0.25 m, two boxes each: nodes that a walk around a walker looks at. */
static double nodes_per_walk(uint32_t cells)
{
    uint32_t count = 2 * cells * cells;
    fake_memory memory = {0};
    tahr_host host = {.allocator = fake_allocator(&memory)};
    tahr__bvh_box *boxes = malloc(count * sizeof *boxes);
    uint32_t *order = malloc(count * sizeof *order);
    oracle_random r = {10};
    tahr__wide tree;
    assert_true(boxes && order);
    for (uint32_t i = 0; i < count; i++) {
        tahr_vec3 at = {0.25 * (i / 2 % cells), 0.25 * (i / 2 / cells), 0};
        tahr_bounds box = {at, v_add(at, v_make(0.25, 0.25, 0))};
        boxes[i] = tahr__bvh_box_make(&box, v_make(0, 0, 0));
    }
    assert_int_equal(tahr__wide_build(&host, boxes, order, count, v_make(0, 0, 0), &tree), TAHR_OK);
    assert_true((double)memory.live_bytes / count <=
                16); /* what the issue of 64 bytes a triangle leaves for the tree */
    tree.test = count_nodes;
    looked_at = 0;
    for (int q = 0; q < 400; q++) {
        tahr_vec3 at = {oracle_uniform(&r, 1, cells * 0.25 - 2), oracle_uniform(&r, 1, cells * 0.25 - 2), 0.1};
        tahr_bounds box = {at, v_add(at, v_make(1, 1, 1))};
        tahr__wide_walk walk;
        uint32_t item;
        tahr__wide_walk_begin(&walk, &tree, &box, 0.3, NULL);
        while (tahr__wide_walk_next(&walk, &item))
            continue;
    }
    tahr__wide_free(&host, &tree);
    free(boxes);
    free(order);
    return looked_at / 400.0;
}

/* Eight times the items are one level more; what is near is as many. From 10 000 to 640 000 that are two levels, to
 * 5 000 000 three, each with what of it lies at the border of the box: at most four nodes. */
static void a_walk_looks_at_few_more_nodes_in_a_tree_64_times_larger(void **state)
{
    (void)state;
    double small = nodes_per_walk(71), large = nodes_per_walk(566);
    assert_true(large <= small + 2 * 4 && large <= 2 * small);
}

static void what_cannot_be_had_is_given_back(void **state)
{
    (void)state;
    static scene s;
    oracle_random r = {11};
    make(&s, 1, 500, v_make(0, 0, 0), &r);
    uint64_t requests = s.memory.requests;
    discard(&s);
    for (uint64_t fail = 1; fail <= requests; fail++) {
        memset(&s.memory, 0, sizeof s.memory);
        s.memory.fail_at = fail;
        s.host.allocator = fake_allocator(&s.memory);
        for (uint32_t i = 0; i < s.count; i++)
            s.scratch[i] = tahr__bvh_box_make(&s.boxes[i], s.centre);
        tahr_status status = tahr__wide_build(&s.host, s.scratch, s.order, s.count, s.centre, &s.tree);
        /* Without the last one it stays as large as it was at first. */
        if (status == TAHR_OK) tahr__wide_free(&s.host, &s.tree);
        assert_true(status == TAHR_E_MEMORY || (status == TAHR_OK && fail == requests));
        assert_int_equal(s.memory.live_blocks, 0);
        assert_int_equal(s.memory.mismatches, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_walk_finds_every_item_within_reach_once),
        cmocka_unit_test(a_walk_that_is_narrowed_misses_nothing_in_the_narrower_box),
        cmocka_unit_test(a_walk_finds_all_of_a_tree_that_is_within_reach),
        cmocka_unit_test(the_nearest_come_first),
        cmocka_unit_test(collecting_finds_every_item_within_reach_once),
        cmocka_unit_test(every_width_collects_the_same_items),
        cmocka_unit_test(every_width_sees_the_same_bits),
        cmocka_unit_test(a_walk_looks_at_few_more_nodes_in_a_tree_64_times_larger),
        cmocka_unit_test(what_cannot_be_had_is_given_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
