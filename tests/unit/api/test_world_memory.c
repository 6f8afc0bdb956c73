/* SPDX-License-Identifier: MIT
 * test_world_memory.c: the default allocator keeps every alignment; the counting one counts what is held, no more;
 * what a triangle of a world takes. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <tahr/native.h>
#include <tahr/tahr.h>

#include "fake_host.h"
#include "scene_mesh.h"
#include "world_memory.h"

static void plain_memory_is_aligned_and_apart(void **unused)
{
    const tahr_allocator *a = &tahr__malloc;
    unsigned char *blocks[7];
    (void)unused;
    for (int i = 0; i < 7; i++) {
        size_t alignment = (size_t)1 << i, size = 13 + (size_t)i;
        blocks[i] = a->alloc(a->user, size, alignment);
        assert_non_null(blocks[i]);
        assert_int_equal((uintptr_t)blocks[i] % alignment, 0);
        memset(blocks[i], i, size);
    }
    for (int i = 0; i < 7; i++) {
        assert_int_equal(blocks[i][0], i);
        assert_int_equal(blocks[i][12 + i], i);
        a->free(a->user, blocks[i], 13 + (size_t)i, (size_t)1 << i);
    }
    a->free(a->user, NULL, 1, 1);
}

static void a_size_that_overflows_is_refused(void **unused)
{
    (void)unused;
    for (size_t less = 0; less < 72; less++) {
        assert_null(tahr__malloc.alloc(NULL, SIZE_MAX - less, 64));
    }
}

static void the_count_is_what_is_held(void **unused)
{
    fake_memory user = {0};
    tahr__memory memory = {fake_allocator(&user), 0};
    tahr_allocator a = tahr__counting_allocator(&memory);
    (void)unused;
    void *first = a.alloc(a.user, 100, 8), *second = a.alloc(a.user, 28, 64);
    assert_true(memory.bytes == 128 && user.live_bytes == 128);
    user.fail_at = 3;
    assert_null(a.alloc(a.user, 1000, 8));
    assert_int_equal(memory.bytes, 128);
    a.free(a.user, NULL, 50, 8); /* nothing was counted for it, and the user's free never sees it */
    assert_int_equal(memory.bytes, 128);
    a.free(a.user, first, 100, 8);
    assert_int_equal(memory.bytes, 28);
    a.free(a.user, second, 28, 64);
    assert_true(memory.bytes == 0 && user.live_blocks == 0 && user.mismatches == 0);
}

/* Bytes a triangle of a world that is this mesh. */
static double bytes_each(const scene_mesh *m, uint32_t no_fields)
{
    const tahr_native_desc options = {.struct_size = sizeof options, .no_fields = no_fields};
    tahr_body_desc body;
    tahr_world_desc desc;
    tahr_world *world = NULL;
    assert_false(m->failed);
    tahr_body_desc_init(&body, sizeof body, TAHR_BODY_MESH);
    body.vertices = m->vertices, body.vertex_count = m->vertex_count;
    body.indices = m->indices, body.triangle_count = m->triangle_count;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = &body, desc.body_count = 1, desc.options = &options;
    assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &world), TAHR_OK);
    double each = (double)tahr_world_memory(world) / m->triangle_count;
    tahr_world_close(world);
    return each;
}

/* Of many triangles, everything in the world counted: as any mesh, with corners that are shared or handed over three a
 * triangle, and as the field of heights that it is, 8 bytes a corner and as many corners as half the triangles. */
static void a_triangle_takes_at_most_64_bytes(void **unused)
{
    scene_mesh m = {0}, apart = {0};
    (void)unused;
    scene_mesh_field(&m, 100, 100, 0.5, scene_hills);
    for (uint32_t i = 0; i < m.triangle_count; i++) {
        uint32_t v[3];
        for (uint32_t k = 0; k < 3; k++) {
            const double *p = m.vertices + 3 * (size_t)m.indices[3 * i + k];
            v[k] = scene_mesh_vertex(&apart, p[0], p[1], p[2]);
        }
        scene_mesh_triangle(&apart, v[0], v[1], v[2]);
    }
    assert_int_equal(apart.vertex_count, 3 * m.triangle_count);
    assert_true(bytes_each(&m, 1) <= 64);
    assert_true(bytes_each(&apart, 1) <= 64);
    assert_true(bytes_each(&m, 0) <= 4.5);
    scene_mesh_free(&m);
    scene_mesh_free(&apart);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plain_memory_is_aligned_and_apart), cmocka_unit_test(a_size_that_overflows_is_refused),
        cmocka_unit_test(the_count_is_what_is_held), cmocka_unit_test(a_triangle_takes_at_most_64_bytes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
