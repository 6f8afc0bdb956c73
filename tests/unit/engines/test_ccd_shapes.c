/* SPDX-License-Identifier: MIT
 * test_ccd_shapes.c: sweeps of every kind of character against every kind of body of the libccd and fcl backends, each
 * answer proved by extents and by the distance of points (solid_oracle.h): what is hit is hit where it says, what is
 * missed was missed. And all settings of libccd answer alike. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>
#include <tahr/tahr.h>

#if !defined(TAHR_HAVE_CCD) && !defined(TAHR_HAVE_FCL)
int main(void)
{
    puts("SKIP: unit_engines_ccd_shapes: built without libccd and without FCL");
    return 77;
}
#else
#ifdef TAHR_HAVE_CCD
#include <tahr/ccd.h>
#endif
#ifdef TAHR_HAVE_FCL
#include <tahr/fcl.h>
#endif

#include "dice.h"
#include "solid_oracle.h"

/* m: margins between shapes of 0.1 to 1 m. The backend may be early by a hundredth of robustness' 1e-4 of a size; late,
 * or past a body, by a micrometre. */
#define EARLY 1e-6
#define LATE 1e-6
/* m: shallow overlaps are a character's own; their depth is the shortest. */
#define SHALLOW 0.02

enum { SHAPES = 7, BODIES = 8, SCENES = 18, SWEEPS = 20 };

static const uint32_t body_types[BODIES] = {TAHR_BODY_MESH,     TAHR_BODY_BOX,  TAHR_BODY_SPHERE,    TAHR_BODY_CAPSULE,
                                            TAHR_BODY_CYLINDER, TAHR_BODY_CONE, TAHR_BODY_ELLIPSOID, TAHR_BODY_HULL};
/* What kind of body a shape is. */
static const uint32_t shape_solids[SHAPES + 1] = {0,
                                                  TAHR_BODY_SPHERE,
                                                  TAHR_BODY_CAPSULE,
                                                  TAHR_BODY_BOX,
                                                  TAHR_BODY_CYLINDER,
                                                  TAHR_BODY_CONE,
                                                  TAHR_BODY_ELLIPSOID,
                                                  TAHR_BODY_HULL};

typedef struct tally {
    int sweeps, hits, misses, overlaps, early, late, false_misses, false_hits, wrong_depths, long_depths, unknown;
    solid_real worst_early, worst_late;
} tally;

typedef struct pair {
    tahr_world *world;
    tahr_shape shape;
    solid character, body;
    double hull[SOLID_VERTICES * 3], obstacle[SOLID_VERTICES * 3];
    double scale; /* of everything, m */
} pair;

static oracle_random dice;
static const tahr_backend *backend; /* that is asked */

static double uniform(double low, double high)
{
    return oracle_uniform(&dice, low, high);
}

static double dot(tahr_vec3 a, tahr_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static tahr_vec3 along(tahr_vec3 a, tahr_vec3 b, double s)
{
    return (tahr_vec3){a.x + b.x * s, a.y + b.y * s, a.z + b.z * s};
}

static tahr_quat random_turn(void)
{
    tahr_quat q = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(0.1, 1)};
    double n = 1 / sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    return (tahr_quat){q.x * n, q.y * n, q.z * n, q.w * n};
}

/* Random sizes; vertices of hulls and triangles go to the given array too. */
static void random_solid(solid *s, uint32_t type, double scale, double *vertices)
{
    *s = (solid){.type = type};
    s->radius = scale * uniform(0.05, 0.5);
    s->half_height = type == TAHR_BODY_SPHERE    ? s->radius
                     : type == TAHR_BODY_CAPSULE ? s->radius + scale * uniform(0, 0.5)
                                                 : scale * uniform(0.05, 1);
    s->half = (solid_vec){scale * uniform(0.05, 0.6), scale * uniform(0.05, 0.6), scale * uniform(0.05, 1)};
    s->vertex_count = type == TAHR_BODY_MESH ? 3 : SOLID_VERTICES;
    for (int i = 0; i < SOLID_VERTICES; i++) {
        for (int k = 0; k < 3; k++)
            vertices[3 * i + k] = scale * uniform(-0.7, 0.7);
        s->vertices[i] = (solid_vec){vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]};
    }
    if (type == TAHR_BODY_HULL) solid_hull(s);
}

/* Half the extents of a hull's vertices, and the vertices around the middle of them, where a character is. */
static void centre_hull(pair *p)
{
    solid *s = &p->character;
    solid_vec low = s->vertices[0], high = low;
    for (int i = 1; i < SOLID_VERTICES; i++) {
        solid_vec v = s->vertices[i];
        low = (solid_vec){fminl(low.x, v.x), fminl(low.y, v.y), fminl(low.z, v.z)};
        high = (solid_vec){fmaxl(high.x, v.x), fmaxl(high.y, v.y), fmaxl(high.z, v.z)};
    }
    s->half = (solid_vec){(high.x - low.x) / 2, (high.y - low.y) / 2, (high.z - low.z) / 2};
    for (int i = 0; i < SOLID_VERTICES; i++) {
        s->vertices[i].x -= (high.x + low.x) / 2;
        s->vertices[i].y -= (high.y + low.y) / 2;
        s->vertices[i].z -= (high.z + low.z) / 2;
    }
}

static void set_shape(pair *p, uint32_t type)
{
    const solid *s = &p->character;
    int wide = type == TAHR_SHAPE_BOX || type == TAHR_SHAPE_ELLIPSOID || type == TAHR_SHAPE_HULL;
    p->shape = (tahr_shape){.type = type, .hull = type == TAHR_SHAPE_HULL ? 1u : 0u};
    p->shape.radius = wide ? 0 : (double)s->radius;
    p->shape.half_x = wide ? (double)s->half.x : 0;
    p->shape.half_y = wide ? (double)s->half.y : 0;
    p->shape.half_height = wide ? (double)s->half.z : (double)s->half_height;
}

static tahr_body_desc describe(const solid *s, const double *vertices)
{
    static const uint32_t triangle[3] = {0, 1, 2};
    tahr_body_desc d;
    tahr_body_desc_init(&d, sizeof d, s->type);
    d.radius = (double)s->radius;
    d.half_height = (double)s->half_height;
    d.half_extents = (tahr_vec3){(double)s->half.x, (double)s->half.y, (double)s->half.z};
    d.vertices = vertices;
    d.vertex_count = (uint32_t)s->vertex_count;
    d.indices = triangle;
    d.triangle_count = 1;
    d.flags = s->type == TAHR_BODY_MESH ? TAHR_BODY_TWO_SIDED : 0;
    return d;
}

static void open_pair(pair *p, uint32_t shape, uint32_t body, const void *options)
{
    tahr_body_desc bodies[2];
    tahr_world_desc desc;
    tahr_vec3 at = dice_vec(&dice, -p->scale, p->scale);
    tahr_quat turn = random_turn();
    random_solid(&p->character, shape_solids[shape], p->scale, p->hull);
    random_solid(&p->body, body, p->scale, p->obstacle);
    solid_place(&p->body, at, turn);
    bodies[0] = describe(&p->body, p->obstacle);
    bodies[0].pose = (tahr_pose){at, turn};
    p->character.type = TAHR_BODY_HULL;
    p->character.vertex_count = SOLID_VERTICES;
    bodies[1] = describe(&p->character, p->hull);
    bodies[1].flags = TAHR_BODY_TEMPLATE;
    p->character.type = shape_solids[shape];
    if (shape == TAHR_SHAPE_HULL) centre_hull(p);
    set_shape(p, shape);
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bodies;
    desc.body_count = 2;
    desc.options = options;
    p->world = NULL;
    assert_int_equal(tahr_world_open(backend, &desc, &p->world), TAHR_OK);
}

/* Most go about toward the body. */
static tahr_sweep random_sweep(const pair *p)
{
    tahr_vec3 centre = {(double)p->body.at.x, (double)p->body.at.y, (double)p->body.at.z};
    tahr_quat turn = random_turn();
    tahr_sweep q = {.shape = p->shape, .orientation = turn, .margin = p->scale * (uniform(0, 1) < 0.2 ? 0 : 0.01)};
    q.mask = 0xFFFFFFFFu;
    q.ignore_body = TAHR_NO_BODY;
    q.up = (tahr_vec3){2 * (turn.x * turn.z + turn.w * turn.y), 2 * (turn.y * turn.z - turn.w * turn.x),
                       1 - 2 * (turn.x * turn.x + turn.y * turn.y)};
    double n = 1 / sqrt(dot(q.up, q.up));
    q.up = (tahr_vec3){q.up.x * n, q.up.y * n, q.up.z * n};
    q.position = along(centre, dice_direction(&dice), p->scale * uniform(0.6, 3));
    tahr_vec3 goal = along(centre, dice_vec(&dice, -1, 1), p->scale);
    q.motion = along(goal, q.position, -1);
    double length = p->scale * uniform(0.5, 4) / sqrt(dot(q.motion, q.motion));
    q.motion = (tahr_vec3){q.motion.x * length, q.motion.y * length, q.motion.z * length};
    return q;
}

/* A point of the body that is no farther than the margin, and two planes that are no nearer. */
static void judge_hit(pair *p, const tahr_sweep *q, const tahr_hit *hit, tally *t)
{
    solid_real scale = p->scale, margin = hit->distance;
    solid_place(&p->character, along(q->position, q->motion, hit->fraction), q->orientation);
    solid_real gap = -solid_way(&p->character, (tahr_vec3){0, 0, 0}, &p->body, hit->normal);
    solid_real reach = solid_point_distance(&p->character, hit->point) + solid_point_distance(&p->body, hit->point);
    t->hits++;
    if (gap < margin - LATE * scale) /* the normal is good to a few millionths; is there a better one? */
        gap = -solid_least_way_near(&p->character, (tahr_vec3){0, 0, 0}, &p->body, hit->normal, LATE * scale - margin,
                                    &dice);
    t->late += gap < margin - LATE * scale;
    t->early += reach > margin + EARLY * scale || (hit->fraction > 0 && margin > q->margin + EARLY * scale);
    t->worst_late = fmaxl(t->worst_late, (margin - gap) / scale);
    t->worst_early = fmaxl(t->worst_early, (reach - margin) / scale);
    t->false_hits += !(dot(q->motion, hit->normal) < 0);
}

static void judge_overlap(pair *p, const tahr_sweep *q, const tahr_hit *hit, tally *t)
{
    const tahr_vec3 rest = {0, 0, 0};
    solid_real scale = p->scale;
    solid_place(&p->character, q->position, q->orientation);
    solid_real way = solid_way(&p->character, rest, &p->body, hit->normal);
    solid_real least = solid_least_way(&p->character, rest, &p->body, -1e30L, &dice);
    t->overlaps++;
    t->false_hits += least < -EARLY * scale;
    t->wrong_depths += fabsl(way - hit->depth) > 1e-9L * scale;
    t->long_depths += hit->depth < SHALLOW * p->scale && hit->depth > least + 1e-4L * scale;
}

/* Nothing is within the margin of the shape anywhere on its way; or only where it begins, and it leads away. */
static void judge_miss(pair *p, const tahr_sweep *q, tally *t)
{
    solid_real enough = -(solid_real)q->margin + LATE * p->scale, way = 0;
    t->misses++;
    solid_place(&p->character, q->position, q->orientation);
    for (int tries = 0; tries < 8; tries++) {
        way = solid_least_way(&p->character, q->motion, &p->body, enough, &dice);
        if (way <= enough) return;
    }
    way = solid_least_way(&p->character, (tahr_vec3){0, 0, 0}, &p->body, -1e30L, &dice);
    t->false_misses += way > 0 || way < enough; /* within the margin at the start it may move apart */
}

static void judge(pair *p, const tahr_sweep *q, tally *t)
{
    tahr_hit hit = {0};
    uint32_t count = 0;
    assert_int_equal(tahr_world_sweep(p->world, q, &hit, 1, &count), TAHR_OK);
    t->sweeps++;
    t->unknown += count && hit.unknown;
    if (count && hit.start_overlap)
        judge_overlap(p, q, &hit, t);
    else if (count)
        judge_hit(p, q, &hit, t);
    else
        judge_miss(p, q, t);
}

static void expect_none_wrong(const tally *t)
{
    print_message("    %d sweeps: %d hits, %d misses, %d overlaps; early by %.1Lg, late by %.1Lg of a metre\n",
                  t->sweeps, t->hits, t->misses, t->overlaps, t->worst_early, t->worst_late);
    assert_int_equal(t->unknown, 0);
    assert_int_equal(t->late, 0);
    assert_int_equal(t->early, 0);
    assert_int_equal(t->false_hits, 0);
    assert_int_equal(t->false_misses, 0);
    assert_int_equal(t->wrong_depths, 0);
    print_message("    %d of the overlaps have a shorter way out than was found\n", t->long_depths);
    assert_true(t->long_depths * 50 <= t->overlaps);
}

static void every_pair(double scale, int scenes, tally *t)
{
    pair p = {.scale = scale};
    for (uint32_t shape = TAHR_SHAPE_SPHERE; shape <= TAHR_SHAPE_HULL; shape++) {
        for (int body = 0; body < BODIES; body++) {
            for (int scene = 0; scene < scenes; scene++) {
                open_pair(&p, shape, body_types[body], NULL);
                for (int i = 0; i < SWEEPS; i++) {
                    tahr_sweep q = random_sweep(&p);
                    judge(&p, &q, t);
                }
                tahr_world_close(p.world);
            }
        }
    }
}

static void sweeps_of_every_pair_are_where_extents_and_points_say(void **state)
{
    tally t = {0};
    (void)state;
    dice.state = 4;
    every_pair(1, SCENES, &t);
    assert_true(t.sweeps >= 20000 && t.hits > 4000 && t.misses > 2000 && t.overlaps > 500);
    expect_none_wrong(&t);
}

/* Sizes of a millionth of a metre to ten kilometres: everything grows with it, the allowance too. */
static void sweeps_are_as_exact_for_the_smallest_and_the_largest(void **state)
{
    static const double scales[] = {4e-5, 1e-3, 30, 5e3};
    (void)state;
    dice.state = 9;
    for (size_t i = 0; i < sizeof scales / sizeof scales[0]; i++) {
        tally t = {0};
        every_pair(scales[i], 1, &t);
        assert_true(t.hits > 200);
        expect_none_wrong(&t);
    }
}

static tahr_hit ask(tahr_world *world, const tahr_sweep *q, uint32_t *count)
{
    tahr_hit hit = {0};
    *count = 0;
    assert_int_equal(tahr_world_sweep(world, q, &hit, 1, count), TAHR_OK);
    return hit;
}

/* Where a graze makes the time uncertain the gap is not; 1e-9 of the size for each of the two. */
static int alike(const tahr_sweep *q, const tahr_hit *a, const tahr_hit *b)
{
    double slope = fabs(dot(q->motion, a->normal)) + fabs(dot(q->motion, b->normal));
    if (a->start_overlap || b->start_overlap) return a->start_overlap && b->start_overlap && a->depth == b->depth;
    return fabs(a->fraction - b->fraction) * slope <= 4e-9 || fabs(a->fraction - b->fraction) < 1e-9;
}

#ifdef TAHR_HAVE_CCD
static void all_settings_answer_alike(void **state)
{
    static const tahr_ccd_desc settings[] = {
        {sizeof(tahr_ccd_desc), TAHR_CCD_SWEEP_ADVANCE, 0, 0, {0}},
        {sizeof(tahr_ccd_desc), TAHR_CCD_SWEEP_BISECTION, TAHR_CCD_BOOLEAN_GJK, 0, {0}},
        {sizeof(tahr_ccd_desc), TAHR_CCD_SWEEP_BISECTION, TAHR_CCD_BOOLEAN_MPR, 0, {0}},
        {sizeof(tahr_ccd_desc), TAHR_CCD_SWEEP_BISECTION, TAHR_CCD_BOOLEAN_GJK, 3, {0}},
        {sizeof(tahr_ccd_desc), TAHR_CCD_SWEEP_BISECTION, TAHR_CCD_BOOLEAN_MPR, 3, {0}},
    };
    enum { COUNT = sizeof settings / sizeof settings[0] };
    tahr_world *worlds[COUNT];
    int hits = 0, differ[COUNT] = {0};
    pair p = {.scale = 1};
    (void)state;
    for (uint32_t i = 0; i < SHAPES * BODIES * 2; i++) {
        for (int k = 0; k < COUNT; k++) {
            dice.state = 1000 + i;
            open_pair(&p, 1 + i % SHAPES, body_types[i / SHAPES % BODIES], &settings[k]);
            worlds[k] = p.world;
        }
        for (int n = 0; n < SWEEPS; n++) {
            tahr_sweep q = random_sweep(&p);
            uint32_t found, other;
            tahr_hit a = ask(worlds[0], &q, &found), b;
            hits += (int)found;
            for (int k = 1; k < COUNT; k++) {
                b = ask(worlds[k], &q, &other);
                differ[k] += found != other || (found && !alike(&q, &a, &b));
            }
        }
        for (int k = 0; k < COUNT; k++)
            tahr_world_close(worlds[k]);
    }
    assert_true(hits > 800);
    for (int k = 1; k < COUNT; k++)
        assert_int_equal(differ[k], 0);
}

static void settings_out_of_range_are_refused(void **state)
{
    const tahr_ccd_desc good = {.struct_size = sizeof good};
    tahr_ccd_desc bad[6] = {good, good, good, good, good, good};
    const tahr_status status[6] = {TAHR_E_ARGUMENT, TAHR_E_ARGUMENT,    TAHR_E_ARGUMENT,
                                   TAHR_E_ARGUMENT, TAHR_E_STRUCT_SIZE, TAHR_OK};
    (void)state;
    bad[0].sweep = 3;
    bad[1].boolean = 3;
    bad[2].max_iterations = 10001;
    bad[3].reserved[2] = 1;
    bad[4].struct_size = 4;
    for (int i = 0; i < 6; i++) {
        tahr_world *world = NULL;
        tahr_world_desc desc;
        tahr_world_desc_init(&desc, sizeof desc);
        desc.options = &bad[i];
        assert_int_equal(tahr_world_open(tahr_backend_v1_ccd(), &desc, &world), status[i]);
        assert_true((world != NULL) == (status[i] == TAHR_OK));
        tahr_world_close(world);
    }
}

/* --- What must not happen on odd input --- */
#endif

static void hulls_without_a_volume_are_refused(void **state)
{
    static const double flat[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0.5, 0.5, 0};
    static const double line[] = {0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4};
    static const double point[15] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
    static const double wild[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, NAN, 1, 1, 1};
    static const double far[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1e300, 1, 1, 1};
    const double *const vertices[] = {flat, line, point, wild, far};
    (void)state;
    for (size_t i = 0; i < sizeof vertices / sizeof vertices[0]; i++) {
        tahr_world *world = NULL;
        tahr_world_desc desc;
        tahr_body_desc body;
        tahr_body_desc_init(&body, sizeof body, TAHR_BODY_HULL);
        body.vertices = vertices[i];
        body.vertex_count = 5;
        tahr_world_desc_init(&desc, sizeof desc);
        desc.bodies = &body;
        desc.body_count = 1;
        assert_int_equal(tahr_world_open(backend, &desc, &world), TAHR_E_GEOMETRY);
        assert_null(world);
    }
}

/* Straight down from h above a body at the origin whose top is level at `top`, at gaps of 0 and an ulp to either side,
 * near the origin and a thousand kilometres from it. */
static void exact_touching_is_decided_by_direction(void **state)
{
    const tahr_vec3 places[] = {{0, 0, 0}, {1e6, -1e6, 0}};
    static const uint32_t flat[] = {TAHR_BODY_CYLINDER, TAHR_BODY_BOX};
    (void)state;
    for (int i = 0; i < 2 * 2 * 3 * 3; i++) {
        static const uint32_t shapes[3] = {TAHR_SHAPE_CYLINDER, TAHR_SHAPE_CONE, TAHR_SHAPE_ELLIPSOID};
        tahr_vec3 at = places[i % 2];
        uint32_t shape = shapes[i / 12], count;
        int wide = shape == TAHR_SHAPE_ELLIPSOID;
        tahr_body_desc body;
        tahr_world_desc desc;
        tahr_world *world = NULL;
        tahr_body_desc_init(&body, sizeof body, flat[i / 2 % 2]);
        body.pose.position = at;
        body.radius = 1;
        body.half_height = 0.5;
        body.half_extents = (tahr_vec3){1, 1, 0.5};
        tahr_world_desc_init(&desc, sizeof desc);
        desc.bodies = &body;
        desc.body_count = 1;
        assert_int_equal(tahr_world_open(backend, &desc, &world), TAHR_OK);
        tahr_sweep q = {.shape = {shape, 0, wide ? 0 : 0.25, 0.5, wide ? 0.25 : 0, wide ? 0.25 : 0},
                        .up = {0, 0, 1},
                        .orientation = {0, 0, 0, 1},
                        .mask = 0xFFFFFFFFu,
                        .ignore_body = TAHR_NO_BODY};
        q.position = (tahr_vec3){at.x + 0.125, at.y, at.z + 1 + (i / 4 % 3 - 1) * 2.220446049250313e-16};
        q.motion = (tahr_vec3){0, 0, -1};
        tahr_hit hit = ask(world, &q, &count);
        assert_true(count == 1 && hit.fraction < 1e-9 && hit.normal.z > 1 - 1e-9 && hit.depth < 1e-9);
        q.motion = (tahr_vec3){0, 0, 1};
        hit = ask(world, &q, &count);
        assert_true(count == 0 || (hit.start_overlap && hit.depth < 1e-9));
        q.position.z += 1e-6; /* a micrometre of air: parallel motion is free */
        q.motion = (tahr_vec3){0.5, 0.25, 0};
        ask(world, &q, &count);
        assert_int_equal(count, 0);
        tahr_world_close(world);
    }
}

/* Centres, axes and all the same: there is a way out, and it is one. */
static void concentric_shapes_leave_each_other(void **state)
{
    pair p = {.scale = 1};
    (void)state;
    dice.state = 12;
    for (uint32_t i = 0; i < SHAPES * BODIES; i++) {
        uint32_t count;
        open_pair(&p, 1 + i % SHAPES, body_types[i / SHAPES], NULL);
        tahr_sweep q = random_sweep(&p);
        q.position = (tahr_vec3){(double)p.body.at.x, (double)p.body.at.y, (double)p.body.at.z};
        tahr_hit hit = ask(p.world, &q, &count);
        if (body_types[i / SHAPES] != TAHR_BODY_MESH) { /* whose centre is no point of it */
            assert_true(count == 1 && hit.start_overlap && hit.depth > 0);
            solid_place(&p.character, q.position, q.orientation);
            solid_real way = solid_way(&p.character, (tahr_vec3){0, 0, 0}, &p.body, hit.normal);
            assert_true(fabsl(way - hit.depth) < 1e-9L);
        }
        tahr_world_close(p.world);
    }
}

/* A triangle of a hundred metres by a hair, and one as thin as a mesh keeps. */
static void slivers_are_met_where_they_are(void **state)
{
    static const double widths[] = {1e-3, 1e-6, 2e-8};
    static const uint32_t indices[] = {0, 1, 2};
    (void)state;
    for (int i = 0; i < 3 * 2; i++) {
        const double vertices[] = {-50, 0, 0, 50, 0, 0, 0, widths[i % 3], 0};
        tahr_body_desc body;
        tahr_world_desc desc;
        tahr_world *world = NULL;
        uint32_t count;
        tahr_body_desc_init(&body, sizeof body, TAHR_BODY_MESH);
        body.vertices = vertices;
        body.indices = indices;
        body.vertex_count = 3;
        body.triangle_count = 1;
        body.flags = TAHR_BODY_TWO_SIDED;
        tahr_world_desc_init(&desc, sizeof desc);
        desc.bodies = &body;
        desc.body_count = 1;
        assert_int_equal(tahr_world_open(backend, &desc, &world), TAHR_OK);
        tahr_sweep q = {.shape = {i < 3 ? TAHR_SHAPE_CYLINDER : TAHR_SHAPE_CONE, 0, 0.25, 0.5, 0, 0},
                        .position = {3, 0, 1.51},
                        .up = {0, 0, 1},
                        .orientation = {0, 0, 0, 1},
                        .motion = {0, 0, -2},
                        .margin = 0.01,
                        .mask = 0xFFFFFFFFu,
                        .ignore_body = TAHR_NO_BODY};
        tahr_hit hit = ask(world, &q, &count);
        assert_true(count == 1 && hit.blocking && fabs(hit.fraction - 0.5) < 1e-8 && hit.normal.z > 1 - 1e-9);
        tahr_world_close(world);
    }
}

#ifdef TAHR_HAVE_FCL
/* Fewer: what is decided by distance is the same code as with libccd, what is found is not. Its answers are off by a
 * nanometre at most whatever the size, so that a millimetre is the smallest that a millionth can be asked of. */
static void fcl_finds_every_pair_where_extents_and_points_say(void **state)
{
    static const double scales[] = {1e-3, 30, 5e3};
    tally t = {0};
    (void)state;
    dice.state = 5;
    every_pair(1, 5, &t);
    assert_true(t.sweeps >= 5600 && t.hits > 1000 && t.misses > 500 && t.overlaps > 125);
    expect_none_wrong(&t);
    for (size_t i = 0; i < sizeof scales / sizeof scales[0]; i++) {
        t = (tally){0};
        every_pair(scales[i], 1, &t);
        assert_true(t.hits > 200);
        expect_none_wrong(&t);
    }
}

static int ask_fcl(void **state)
{
    (void)state;
    backend = tahr_backend_v1_fcl();
    return 0;
}
#endif

#ifdef TAHR_HAVE_CCD
static int ask_ccd(void **state)
{
    (void)state;
    backend = tahr_backend_v1_ccd();
    return 0;
}
#endif

int main(void)
{
    int failed = 0;
#ifdef TAHR_HAVE_CCD
    const struct CMUnitTest of_ccd[] = {
        cmocka_unit_test(sweeps_are_as_exact_for_the_smallest_and_the_largest),
        cmocka_unit_test(all_settings_answer_alike),
        cmocka_unit_test(settings_out_of_range_are_refused),
        cmocka_unit_test(hulls_without_a_volume_are_refused),
        cmocka_unit_test(exact_touching_is_decided_by_direction),
        cmocka_unit_test(concentric_shapes_leave_each_other),
        cmocka_unit_test(slivers_are_met_where_they_are),
        cmocka_unit_test(sweeps_of_every_pair_are_where_extents_and_points_say),
    };
    failed += cmocka_run_group_tests(of_ccd, ask_ccd, NULL);
#endif
#ifdef TAHR_HAVE_FCL
    const struct CMUnitTest of_fcl[] = {
        cmocka_unit_test(hulls_without_a_volume_are_refused),
        cmocka_unit_test(exact_touching_is_decided_by_direction),
        cmocka_unit_test(concentric_shapes_leave_each_other),
        cmocka_unit_test(slivers_are_met_where_they_are),
        cmocka_unit_test(fcl_finds_every_pair_where_extents_and_points_say),
    };
    failed += cmocka_run_group_tests(of_fcl, ask_fcl, NULL);
#endif
    return failed;
}
#endif
