/* SPDX-License-Identifier: MIT
 * test_random.c: 20 000 random sweeps of the native backend, against distances that are
 * enumerated in long double (oracle.h): where it stops, and that it could not have been stopped before. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "native_world.h"

/* Boxes are few: for one the oracle enumerates 189 cases a triangle, for a capsule 21, for a sphere 7. */
enum { TRIANGLES = 3, SCENES = 500, SWEEPS = 40, SPHERES = 33, CAPSULES = 6 };
/* m: the gap error of robustness.md, and what may be missed. */
static const double GAP = 1e-9, MISSED = 1e-6;

typedef struct scene {
    double vertices[TRIANGLES * 9];
    uint32_t indices[TRIANGLES * 3];
    fixture fixture;
} scene;

typedef struct tally {
    uint32_t sweeps, hits, misses, overlaps;
    double worst;
} tally;

static void open_scene(scene *s, oracle_random *r)
{
    double size = oracle_uniform(r, 0.05, 3);
    for (uint32_t i = 0; i < TRIANGLES; i++) {
        tahr_vec3 at = dice_vec(r, -2, 2);
        for (uint32_t k = 0; k < 3; k++) {
            tahr_vec3 v = v_add(at, dice_vec(r, -size, size));
            double *to = &s->vertices[9 * i + 3 * k];
            to[0] = v.x, to[1] = v.y, to[2] = v.z;
            s->indices[3 * i + k] = 3 * i + k;
        }
    }
    tahr_body_desc body = fixture_mesh(s->vertices, TRIANGLES * 3, s->indices, TRIANGLES);
    body.flags = TAHR_BODY_TWO_SIDED;
    native_open(&s->fixture, &body, 1, 1);
}

static oracle_core core_of(const tahr_sweep *q)
{
    const tahr_shape *shape = &q->shape;
    oracle_core core;
    memset(&core, 0, sizeof core);
    core.centre[0] = q->position.x, core.centre[1] = q->position.y, core.centre[2] = q->position.z;
    if (shape->type == TAHR_SHAPE_CAPSULE) {
        core.axis_count = 1;
        core.axis[0][2] = shape->half_height - shape->radius;
    } else if (shape->type == TAHR_SHAPE_BOX) {
        core.axis_count = 3;
        core.axis[0][0] = shape->half_x, core.axis[1][1] = shape->half_y, core.axis[2][2] = shape->half_height;
    }
    return core;
}

/* No less than the distance of a triangle from the core: that of the spheres around them. */
static double least_distance(const tahr_sweep *q, double t, const double *v)
{
    tahr_vec3 middle = {0, 0, 0};
    double around = 0;
    for (int k = 0; k < 3; k++)
        middle = v_mad(middle, v_make(v[3 * k], v[3 * k + 1], v[3 * k + 2]), 1.0 / 3);
    for (int k = 0; k < 3; k++)
        around = d_max(around, v_length(v_sub(v_make(v[3 * k], v[3 * k + 1], v[3 * k + 2]), middle)));
    double core = v_length(v_make(q->shape.half_x, q->shape.half_y, q->shape.half_height - q->shape.radius));
    return v_length(v_sub(v_mad(q->position, q->motion, t), middle)) - around - core - 1e-6;
}

/* Of the surface of the shape, at this part of the way. */
static double distance_at(const scene *s, const tahr_sweep *q, double t)
{
    const double motion[3] = {q->motion.x, q->motion.y, q->motion.z};
    const oracle_core core = core_of(q);
    long double best = 1e30L;
    for (uint32_t i = 0; i < TRIANGLES; i++) {
        double tri[3][3];
        if (least_distance(q, t, &s->vertices[9 * i]) > best) continue;
        memcpy(tri, &s->vertices[9 * i], sizeof tri);
        long double d = oracle_distance(&core, motion, t, tri);
        best = d < best ? d : best;
    }
    return (double)best - q->shape.radius;
}

/* Quicker, and no more than that. */
static double least_at(const scene *s, const tahr_sweep *q, double t)
{
    double best = 1e30;
    for (uint32_t i = 0; i < TRIANGLES; i++)
        best = d_min(best, least_distance(q, t, &s->vertices[9 * i]));
    return best - q->shape.radius;
}

/* Is it nowhere nearer than `least` between these parts of the way? No distance changes by more than is moved. Where it
 * cannot be told on a millionth of the way, it is as near as that. */
static int stays_off(const scene *s, const tahr_sweep *q, double from, double to, double least)
{
    double mid = 0.5 * (from + to), way = v_length(q->motion) * (to - from);
    if (least_at(s, q, mid) - 0.5 * way > least) return 1;
    double d = distance_at(s, q, mid);
    if (d < least) return 0;
    if (d - 0.5 * way > least || to - from < 1e-6) return 1;
    return stays_off(s, q, from, mid, least) && stays_off(s, q, mid, to, least);
}

static void judge(const scene *s, const tahr_sweep *q, const tahr_hit *h, tally *t)
{
    double start = distance_at(s, q, 0);
    t->sweeps++;
    if (h->start_overlap || start < -GAP) {
        assert_true(h->blocking && h->start_overlap && h->fraction == 0 && start <= GAP);
        t->overlaps++;
    } else if (start <= q->margin + GAP) {
        return; /* blocks or not by the direction: test_native_sweep */
    } else if (h->blocking) {
        double error = fabs(distance_at(s, q, h->fraction) - q->margin);
        t->worst = d_max(t->worst, error);
        if (error > GAP) fail_msg("gap error %g", error);
        assert_true(stays_off(s, q, 0, h->fraction, q->margin - MISSED));
        t->hits++;
    } else {
        assert_true(stays_off(s, q, 0, 1, q->margin - MISSED));
        t->misses++;
    }
}

static void random_sweeps_stop_where_the_oracle_says(void **unused)
{
    (void)unused;
    oracle_random r = {20};
    tally t = {0};
    for (int n = 0; n < SCENES; n++) {
        static scene s;
        open_scene(&s, &r);
        for (int i = 0; i < SWEEPS; i++) {
            tahr_vec3 from = dice_vec(&r, -4, 4), to = dice_vec(&r, -2, 2);
            tahr_shape shape = native_shape(i < SPHERES ? 0 : i < SPHERES + CAPSULES || n % 4 ? 1 : 2);
            tahr_sweep q = fixture_sweep(shape, from, v_sub(to, from), i % 3 ? 0.01 : i % 2 ? 0.05 : 0);
            fixture_announce(&s.fixture, from, 2);
            tahr_hit h = fixture_hit(&s.fixture, &q);
            judge(&s, &q, &h, &t);
        }
        native_close(&s.fixture);
    }
    print_message("    %u sweeps: %u hits, %u misses, %u overlaps; the gap is off by %.2g m at most\n", t.sweeps,
                  t.hits, t.misses, t.overlaps, t.worst);
    assert_true(t.sweeps >= 20000 && t.hits > 4000 && t.misses > 5000 && t.overlaps > 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_sweeps_stop_where_the_oracle_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
