/* SPDX-License-Identifier: MIT
 * test_walk.c: what the walk slot knows is what two sweeps say that know nothing of the place, bit for bit. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "native_world.h"

enum { WALKS = 12000, POSTS = 7, BODIES = 5 + POSTS * POSTS };

/* The foot begins this much (m) higher than the lower end of the body, so that it may come from above where the body
 * itself is too low. */
#define RAISED 0.1
#define RADIUS 0.3
#define HALF 0.9
#define MARGIN 0.02

typedef struct pair {
    fixture knows, asks; /* the same world; one of them knows nothing of the place */
    tahr_shape shape, foot;
    int known, barred, lower;
} pair;

static void open_pair(pair *p, const tahr_body_desc *bodies, uint32_t count)
{
    memset(p, 0, sizeof *p);
    p->shape = fixture_shape(TAHR_SHAPE_CAPSULE, RADIUS, HALF);
    p->foot = fixture_shape(TAHR_SHAPE_SPHERE, RADIUS, RADIUS);
    for (uint32_t i = 0; i < 2; i++) {
        tahr_native_desc o = fixture_options();
        o.cache_triangles = 4096;
        o.cache_margin = 3; /* so that one gather lasts for many walks */
        o.no_vicinity = i;
        fixture_init(i ? &p->asks : &p->knows);
        assert_int_equal(fixture_open(i ? &p->asks : &p->knows, bodies, count, &o, 1), TAHR_OK);
    }
}

static tahr_sweep sweep_of(const tahr_walk *w, int foot)
{
    tahr_sweep q = fixture_sweep(foot ? *w->foot : *w->shape, foot ? w->foot_position : w->position,
                                 foot ? w->foot_motion : w->motion, w->margin);
    q.up = w->up;
    q.mask = w->mask;
    return q;
}

/* Returns whether the slot knew. */
static int ask(pair *p, tahr_vec3 at, tahr_vec3 motion)
{
    const tahr_vec3 end = v_add(at, motion);
    const tahr_walk walk = {.shape = &p->shape,
                            .foot = &p->foot,
                            .position = at,
                            .motion = motion,
                            .foot_position = v_make(end.x, end.y, end.z - (HALF - RADIUS) + RAISED),
                            .foot_motion = {0, 0, -0.4},
                            .up = {0, 0, 1},
                            .margin = MARGIN,
                            .mask = 0xFFFFFFFFu};
    uint32_t known = 0;
    tahr_hit hit;
    fixture_announce(&p->knows, at, 0.5);
    fixture_announce(&p->asks, at, 0.5);
    memset(&hit, 0, sizeof hit);
    assert_int_equal(tahr_backend_v1_native()->walk(p->knows.self, &p->knows.context, &walk, &hit, &known), TAHR_OK);
    const tahr_sweep body = sweep_of(&walk, 0), foot = sweep_of(&walk, 1);
    const tahr_hit met = fixture_hit(&p->asks, &body), below = fixture_hit(&p->asks, &foot);
    if (known == TAHR_WALK_KNOWN) {
        assert_int_equal(met.blocking, 0);
        assert_memory_equal(&hit, &below, sizeof hit);
    } else if (met.blocking || !below.blocking) {
        p->barred++;
    }
    p->known += known == TAHR_WALK_KNOWN;
    p->lower += motion.z < 0;
    /* A cache that is asked nothing else learns from no sweep which floor it is. */
    fixture_hit(&p->knows, &foot);
    return !met.blocking;
}

/* Wanders at heights (m) over z = 0 that are just enough, or not quite, and sometimes down into the floor. */
static void wander(pair *p, uint64_t dice, double size)
{
    const double heights[] = {0.023, 0.023, 0.023, 0.02, 0.0195, 0.05}, falls[] = {0, 0, 0, 0, -0.001, -0.05, 0.01};
    oracle_random r = {dice};
    tahr_vec3 at = v_make(0.5 * size, 0.5 * size, 0), way = v_make(0.06, 0, 0);
    for (int n = 0; n < WALKS; n++) {
        if (oracle_below(&r, 8) == 0) {
            const double turn = oracle_uniform(&r, 0, 6.283), step = oracle_uniform(&r, 0.005, 0.12);
            way = v_make(step * cos(turn), step * sin(turn), 0);
        }
        at.z = HALF + heights[oracle_below(&r, 6)];
        tahr_vec3 motion = v_make(way.x, way.y, falls[oracle_below(&r, 7)]);
        const int free = ask(p, at, motion);
        if (free)
            at = v_add(at, way);
        else
            way = v_scale(way, -1);
        if (at.x < 1 || at.x > size - 1 || at.y < 1 || at.y > size - 1) at = v_make(0.5 * size, 0.5 * size, 0);
    }
}

static void close_pair(pair *p)
{
    print_message("    known %d, not free %d, downward %d of %d\n", p->known, p->barred, p->lower, WALKS);
    assert_true(p->known > WALKS / 10 && p->barred > 100 && p->lower > 1000); /* else nothing was compared */
    native_close(&p->knows);
    native_close(&p->asks);
}

/* A level floor, walls far apart, of which one leans, and posts so dense that more of them are near than fences. */
static void a_walk_among_posts_and_walls_is_known_as_sweeps_say(void **state)
{
    tahr_body_desc bodies[BODIES];
    pair p;
    (void)state;
    bodies[0] = native_box(v_make(8, 8, -0.5), v_make(8, 8, 0.5));
    bodies[1] = native_box(v_make(3, 8, 1), v_make(0.2, 4, 1));
    bodies[2] = native_box(v_make(8, 3, 1), v_make(4, 0.2, 1));
    bodies[3] = native_box(v_make(6, 8, 1), v_make(0.2, 3, 1));
    bodies[3].pose.orientation = (tahr_quat){0, 0.06, 0, sqrt(1 - 0.0036)};
    bodies[4] = native_box(v_make(8, 6, 1.95), v_make(1, 0.6, 0.1));
    for (int i = 0; i < POSTS * POSTS; i++) {
        const tahr_vec3 at = v_make(8.7 + 0.95 * (i % POSTS), 8.7 + 0.95 * (i / POSTS), 0.5);
        bodies[5 + i] = native_box(at, v_make(0.05, 0.05, 0.5));
    }
    open_pair(&p, bodies, BODIES);
    wander(&p, 3, 16);
    close_pair(&p);
}

/* Over the mean height the hills stand up like walls and steps. */
static double bumps(double x, double y)
{
    return d_max(0, 0.8 * sin(1.3 * x) * sin(1.1 * y) - 0.3);
}

static void a_walk_over_a_mesh_is_known_as_sweeps_say(void **state)
{
    static native_grid grid;
    pair p;
    (void)state;
    for (int i = 0; i < 2; i++) {
        tahr_body_desc body = native_grid_body(&grid, 24, i ? 0.75 : 0.5, i ? bumps : NULL);
        tahr_body_desc bodies[2] = {body, native_box(v_make(4, 4, 1), v_make(0.5, 0.5, 1))};
        bodies[0].flags = i ? 0 : TAHR_BODY_TWO_SIDED;
        open_pair(&p, bodies, 2);
        wander(&p, 8, i ? 18 : 12);
        close_pair(&p);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_walk_among_posts_and_walls_is_known_as_sweeps_say),
        cmocka_unit_test(a_walk_over_a_mesh_is_known_as_sweeps_say),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
