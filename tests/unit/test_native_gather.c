/* SPDX-License-Identifier: MIT
 * test_native_gather.c: triangles that the user hands over answer as a mesh of them would, bit for bit, whatever was
 * announced, cached or asked before. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "../support/scene_level.h"
#include "soup.h"

enum { WORLDS = 6 };

static void open_all(fixture worlds[WORLDS], const tahr_body_desc *mesh, soup soups[2], uint32_t precision)
{
    for (uint32_t i = 0; i < WORLDS; i++) {
        tahr_native_desc o = fixture_options(precision);
        o.no_cache = i < 2;
        o.no_simd = i == 3;
        o.cache_triangles = i == 4 ? 16 : 600;
        o.cache_margin = i == 5 ? 3 : 0.5;
        if (i > 0) {
            o.gather = soup_gather;
            o.gather_user = &soups[i % 2];
        }
        fixture_init(&worlds[i]);
        assert_int_equal(fixture_open(&worlds[i], mesh, i == 0, &o, 1), TAHR_OK);
    }
}

static void compare_level(const char *name, uint32_t queries)
{
    scene_mesh mesh = {0};
    char why[256];
    if (!scene_level_make(name, &mesh, why)) {
        print_message("    SKIP: %s: %s\n", name, why);
        scene_mesh_free(&mesh);
        return;
    }
    tahr_body_desc body;
    soup soups[2];
    scene_level_body(&mesh, &body);
    for (uint32_t i = 0; i < 2; i++) {
        soup_make(&soups[i], &body, 0);
        soups[i].reversed = i;
    }
    for (uint32_t precision = 0; precision < 2; precision++) {
        fixture worlds[WORLDS];
        open_all(worlds, &body, soups, precision);
        uint32_t hits = soup_compare(worlds, WORLDS, &soups[0], queries);
        print_message("    %s: %u queries, %u stopped\n", name, queries, hits);
        assert_true(hits > queries / 4);
        assert_true(worlds[2].context.gathers > queries / 4);
        for (uint32_t i = 0; i < WORLDS; i++)
            native_close(&worlds[i]);
    }
    soup_free(&soups[0]);
    soup_free(&soups[1]);
    scene_mesh_free(&mesh);
}

static void gathered_triangles_answer_as_a_mesh_bit_for_bit(void **state)
{
    (void)state;
    const char *many = getenv("TAHR_GATHER_QUERIES");
    uint32_t queries = many ? (uint32_t)strtoul(many, NULL, 10) : 300;
    for (int i = 0; i < SCENE_LEVELS; i++)
        compare_level(SCENE_LEVEL_NAMES[i], queries);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gathered_triangles_answer_as_a_mesh_bit_for_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
