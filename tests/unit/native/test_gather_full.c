/* SPDX-License-Identifier: MIT
 * test_gather_full.c: as test_native_gather.c, 20 000 queries on each level. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "scene_level.h"
#include "soup.h"

static void gathered_triangles_answer_as_a_mesh_bit_for_bit(void **state)
{
    (void)state;
    for (int i = 0; i < SCENE_LEVELS; i++)
        soup_compare_level(SCENE_LEVEL_NAMES[i], 10000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(gathered_triangles_answer_as_a_mesh_bit_for_bit)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
