/* SPDX-License-Identifier: MIT
 * test_outline.c: outlines of random tiles against the tiles themselves: every side between a tile and air lies on
 * exactly one outline, no side between two tiles does, what is solid is on the left, and no corner is superfluous. */
#include "outline.h"

#include "say.h"
#include "wander.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { N = 12, TILE = 16 };

/* How often the lower side and the left side of a cell were passed, each way. */
struct sides {
    int right[N + 1][N + 1], left[N + 1][N + 1], up[N + 1][N + 1], down[N + 1][N + 1];
    double area;
    int corners, straight, open, lines;
};

static int whole(double x)
{
    assert_true(x == floor(x / TILE) * TILE);
    return (int)(x / TILE);
}

static void pass(struct sides *s, struct outline_point a, struct outline_point b)
{
    int x = whole(a.x), y = whole(a.y), to_x = whole(b.x), to_y = whole(b.y);
    assert_true((x == to_x) != (y == to_y));
    for (; x < to_x; x++)
        s->right[x][y]++;
    for (; x > to_x; x--)
        s->left[x - 1][y]++;
    for (; y < to_y; y++)
        s->up[x][y]++;
    for (; y > to_y; y--)
        s->down[x][y - 1]++;
}

static void count_line(void *user, const struct outline_point *p, size_t count, enum outline_end end, uint32_t tag)
{
    struct sides *s = user;
    int closed = end == OUTLINE_RING;
    (void)tag;
    s->lines++;
    s->open += !closed;
    for (size_t i = 0; i + !closed < count; i++) {
        struct outline_point a = p[i], b = p[(i + 1) % count], c = p[(i + 2) % count];
        pass(s, a, b);
        s->area += (a.x * b.y - a.y * b.x) / 2 / (TILE * TILE);
        if (closed || i + 2 < count) {
            s->corners++;
            s->straight += (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x) == 0;
        }
    }
}

static int solid(int (*cells)[N], int x, int y)
{
    return x >= 0 && y >= 0 && x < N && y < N && cells[x][y];
}

static void add_rectangle(struct outline *outline, double x0, double y0, double x1, double y1, uint32_t tag)
{
    const struct outline_point corners[4] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    outline_add(outline, corners, 4, 1, tag);
}

static void outlines_of_random_tiles_are_the_sides_between_tile_and_air(void **state)
{
    struct pcg random;
    (void)state;
    pcg_start(&random, 20261122, 1);
    for (int round = 0; round < 500; round++) {
        struct sides *s = memory_new(1, sizeof *s);
        struct outline outline = {0};
        int cells[N][N], number = 0;
        double density = pcg_unit(&random);
        for (int x = 0; x < N; x++) {
            for (int y = 0; y < N; y++) {
                cells[x][y] = pcg_unit(&random) < density;
                number += cells[x][y];
                if (cells[x][y]) {
                    add_rectangle(&outline, x * TILE, y * TILE, (x + 1) * TILE, (y + 1) * TILE, 0);
                }
            }
        }
        outline_finish(&outline, count_line, s);
        for (int x = 0; x <= N; x++) {
            for (int y = 0; y <= N; y++) {
                int above = solid(cells, x, y), below = solid(cells, x, y - 1), before = solid(cells, x - 1, y);
                assert_int_equal(s->right[x][y], above && !below);
                assert_int_equal(s->left[x][y], below && !above);
                assert_int_equal(s->down[x][y], above && !before);
                assert_int_equal(s->up[x][y], before && !above);
            }
        }
        assert_int_equal(s->open, 0);
        assert_int_equal(s->straight, 0);
        assert_true(fabs(s->area - number) < 1e-9);
        free(s);
    }
}

static void a_floor_of_two_kinds_is_cut_where_they_meet_and_nowhere_else(void **state)
{
    struct sides s = {0};
    struct outline outline = {0};
    (void)state;
    for (int x = 0; x < 9; x++) {
        add_rectangle(&outline, x * TILE, 0, (x + 1) * TILE, TILE, x >= 3 && x < 6);
    }
    outline_finish(&outline, count_line, &s);
    assert_int_equal(s.lines, 4); /* the belt's top and bottom, and the rest on both sides of it */
    assert_int_equal(s.open, 4);
    assert_int_equal(s.corners, 4); /* of the whole; the ends of the lines are on its sides */
    for (int x = 0; x < 9; x++) {
        assert_int_equal(s.right[x][0], 1);
        assert_int_equal(s.left[x][1], 1);
        assert_int_equal(s.up[x][0], 0);
    }
}

static void a_half_tile_beside_a_whole_one_leaves_half_a_side(void **state)
{
    struct sides s = {0};
    struct outline outline = {0};
    (void)state;
    add_rectangle(&outline, 0, 0, 2 * TILE, 4 * TILE, 0);
    add_rectangle(&outline, 2 * TILE, 0, 3 * TILE, 2 * TILE, 0);
    outline_finish(&outline, count_line, &s);
    assert_int_equal(s.lines, 1);
    assert_int_equal(s.corners, 6);
    assert_true(s.area == 10);
}

static void a_ring_round_a_hole_is_two_outlines_the_inner_one_clockwise(void **state)
{
    struct sides s = {0};
    struct outline outline = {0};
    (void)state;
    for (int x = 0; x < 3; x++) {
        for (int y = 0; y < 3; y++) {
            if (x != 1 || y != 1) {
                add_rectangle(&outline, x * TILE, y * TILE, (x + 1) * TILE, (y + 1) * TILE, 0);
            }
        }
    }
    outline_finish(&outline, count_line, &s);
    assert_int_equal(s.lines, 2);
    assert_int_equal(s.corners, 8);
    assert_true(s.area == 8);
    assert_int_equal(s.left[1][1], 1); /* over the lower row, seen from the hole */
}

struct chain {
    struct outline_point points[8];
    size_t count;
    enum outline_end end;
};

static void keep_line(void *user, const struct outline_point *points, size_t count, enum outline_end end, uint32_t tag)
{
    struct chain *chain = user;
    (void)tag;
    assert_true(count <= 8);
    memcpy(chain->points, points, count * sizeof *points);
    chain->count = count;
    chain->end = end;
}

static void two_slopes_of_one_angle_and_a_flat_are_joined_without_a_seam(void **state)
{
    /* 1:2 up over two tiles, then flat, to the left as lines that look up run; handed in out of order. */
    const struct outline_point pieces[3][2] = {{{32, 16}, {16, 8}}, {{48, 16}, {32, 16}}, {{16, 8}, {0, 0}}};
    struct outline outline = {0};
    struct chain chain = {0};
    (void)state;
    for (int i = 0; i < 3; i++) {
        outline_add(&outline, pieces[i], 2, 0, 0);
    }
    outline_finish(&outline, keep_line, &chain);
    assert_int_equal(chain.end, OUTLINE_OPEN);
    assert_int_equal(chain.count, 3);
    assert_true(chain.points[0].x == 48 && chain.points[1].x == 32 && chain.points[2].x == 0);
    assert_true(chain.points[0].y == 16 && chain.points[1].y == 16 && chain.points[2].y == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(outlines_of_random_tiles_are_the_sides_between_tile_and_air),
        cmocka_unit_test(a_floor_of_two_kinds_is_cut_where_they_meet_and_nowhere_else),
        cmocka_unit_test(a_half_tile_beside_a_whole_one_leaves_half_a_side),
        cmocka_unit_test(two_slopes_of_one_angle_and_a_flat_are_joined_without_a_seam),
        cmocka_unit_test(a_ring_round_a_hole_is_two_outlines_the_inner_one_clockwise),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
