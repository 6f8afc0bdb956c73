/* SPDX-License-Identifier: MIT
 * test_describe.c: what worlds on other engines say of themselves is so: of scenes that can be counted by hand. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include <tahr/tahr.h>
#ifdef TAHR_HAVE_CCD
#include <tahr/ccd.h>
#endif
#ifdef TAHR_HAVE_FCL
#include <tahr/fcl.h>
#endif
#ifdef TAHR_HAVE_BOX2D
#include <tahr/box2d.h>
#endif

#include "fake_host.h"
#include "page.h"

/* Nothing is allocated. */
static void describe(const tahr_backend *backend, const tahr_body_desc *bodies, uint32_t count, const void *options,
                     page *p)
{
    fake_memory memory = {0};
    const tahr_allocator allocator = fake_allocator(&memory);
    const tahr_log to = page_log(p);
    tahr_world_desc desc;
    tahr_world *world = NULL;
    memset(p, 0, sizeof *p);
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bodies;
    desc.body_count = count;
    desc.options = options;
    desc.allocator = &allocator;
    assert_int_equal(tahr_world_open(backend, &desc, &world), TAHR_OK);
    uint64_t requests = memory.requests;
    assert_int_equal(tahr_world_describe(world, &to), TAHR_OK);
    assert_true(memory.requests == requests);
    tahr_world_close(world);
}

static const double CORNERS[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
/* The third is the first again. */
static const uint32_t TRIANGLES[] = {0, 1, 2, 0, 2, 3, 0, 1, 2};

/* A mesh of two triangles and one that is there twice, a box that moves, a sphere. */
static void make_bodies(tahr_body_desc bodies[3])
{
    tahr_body_desc_init(&bodies[0], sizeof bodies[0], TAHR_BODY_MESH);
    bodies[0].vertices = CORNERS;
    bodies[0].vertex_count = 4;
    bodies[0].indices = TRIANGLES;
    bodies[0].triangle_count = 3;
    bodies[0].flags = TAHR_BODY_TWO_SIDED;
    tahr_body_desc_init(&bodies[1], sizeof bodies[1], TAHR_BODY_BOX);
    bodies[1].half_extents = (tahr_vec3){1, 1, 1};
    bodies[1].pose.position = (tahr_vec3){5, 0, 0};
    bodies[1].flags = TAHR_BODY_MOVABLE;
    tahr_body_desc_init(&bodies[2], sizeof bodies[2], TAHR_BODY_SPHERE);
    bodies[2].radius = 1;
    bodies[2].pose.position = (tahr_vec3){-5, 0, 0};
}

static void bodies_in_space_are_counted(const tahr_backend *backend, const char *name)
{
    tahr_body_desc bodies[3];
    char first[128];
    page p;
    make_bodies(bodies);
    describe(backend, bodies, 3, NULL, &p);
    snprintf(first, sizeof first, "%s, 3D: 1 movable and 2 static bodies, 1 meshes, 1 boxes, 1 spheres\n", name);
    assert_memory_equal(p.text, first, strlen(first));
    page_says(&p, "body 0: mesh, 2 triangles (1 more dropped: no area, or there twice), 4 vertices, two-sided\n");
    assert_int_equal(p.lines, 3);
}

static void ccd_says_what_it_is_made_of_and_whom_it_asks(void **unused)
{
    (void)unused;
#ifdef TAHR_HAVE_CCD
    tahr_body_desc bodies[3];
    page p;
    bodies_in_space_are_counted(tahr_backend_v1_ccd(), "ccd");
    make_bodies(bodies);
    describe(tahr_backend_v1_ccd(), bodies, 3, NULL, &p);
    page_says(&p, "libccd is not asked");
    const tahr_ccd_desc halves = {.struct_size = sizeof halves,
                                  .sweep = TAHR_CCD_SWEEP_BISECTION,
                                  .boolean = TAHR_CCD_BOOLEAN_GJK,
                                  .max_iterations = 77};
    describe(tahr_backend_v1_ccd(), bodies, 3, &halves, &p);
    page_says(&p, "by libccd's GJK in halves, 77 iterations at most");
#else
    puts("SKIP: unit_engines_describe: built without libccd");
#endif
}

static void fcl_says_what_it_is_made_of_and_how_it_searches(void **unused)
{
    (void)unused;
#ifdef TAHR_HAVE_FCL
    tahr_body_desc bodies[3];
    page p;
    bodies_in_space_are_counted(tahr_backend_v1_fcl(), "fcl");
    make_bodies(bodies);
    describe(tahr_backend_v1_fcl(), bodies, 3, NULL, &p);
    page_says(&p, "in meshes its trees of AABB, searched by a descent");
    const tahr_fcl_desc other = {.struct_size = sizeof other, .volumes = TAHR_FCL_OBBRSS, .search = TAHR_FCL_COLLIDE};
    describe(tahr_backend_v1_fcl(), bodies, 3, &other, &p);
    page_says(&p, "in meshes its trees of OBBRSS, searched by collide()");
#else
    puts("SKIP: unit_engines_describe: built without FCL");
#endif
}

/* A box, and a chain of three points: two segments. */
static void box2d_counts_bodies_and_segments(void **unused)
{
    (void)unused;
#ifdef TAHR_HAVE_BOX2D
    static const double points[] = {-4, 0, 0, 0, 0, 0, 4, 1, 0};
    tahr_body_desc bodies[2];
    page p;
    tahr_body_desc_init(&bodies[0], sizeof bodies[0], TAHR_BODY_BOX);
    bodies[0].half_extents = (tahr_vec3){1, 1, 1};
    bodies[0].pose.position = (tahr_vec3){0, 5, 0};
    bodies[0].flags = TAHR_BODY_MOVABLE;
    tahr_body_desc_init(&bodies[1], sizeof bodies[1], TAHR_BODY_CHAIN);
    bodies[1].vertices = points;
    bodies[1].vertex_count = 3;
    describe(tahr_backend_v1_box2d(), bodies, 2, NULL, &p);
    page_says(&p, "box2d, 2D: 1 movable and 1 static bodies, 1 of them chains; path: the tree of Box2D ");
    page_says(&p, ", 3 pieces: ");
    assert_int_equal(p.lines, 1);
#else
    puts("SKIP: unit_engines_describe: built without Box2D");
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ccd_says_what_it_is_made_of_and_whom_it_asks),
        cmocka_unit_test(fcl_says_what_it_is_made_of_and_how_it_searches),
        cmocka_unit_test(box2d_counts_bodies_and_segments),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
