/* SPDX-License-Identifier: MIT
 * test_box2d_truth.c: 20 000 random sweeps and contacts in the plane against an independent answer: in long double, the
 * distance of the origin from the convex hull of all differences of corners. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "box2d_rig.h"

#include <tahr/box2d.h>

#ifndef TAHR_HAVE_BOX2D
int main(void)
{
    puts("SKIP: unit_engines_box2d_truth: built without Box2D");
    return 77;
}
#else
#include "oracle.h"

enum { QUERIES = 20000, MOST = 4 * 16 };

typedef struct point {
    long double x, y;
} point;

/* Corners and a radius, in the world. */
typedef struct outline {
    int count;
    long double radius;
    point corner[16];
} outline;

/* The differences of all corners of two outlines, as a convex ring. */
typedef struct ring {
    int count;
    point corner[MOST];
} ring;

static oracle_random dice = {20260};
static uint32_t engines[2];
static int engine_count;

static double uniform(double low, double high)
{
    return oracle_uniform(&dice, low, high);
}

static long double cross(point a, point b, point c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/* Gift wrapping: from the leftmost corner always to the one that has all others on its left. */
static void wrap(const point *all, int count, ring *out)
{
    int first = 0, at;
    for (int i = 1; i < count; i++) {
        first = all[i].x < all[first].x || (all[i].x == all[first].x && all[i].y < all[first].y) ? i : first;
    }
    out->count = 0;
    at = first;
    do {
        int next = -1;
        out->corner[out->count++] = all[at];
        for (int i = 0; i < count; i++) {
            if (all[i].x == all[at].x && all[i].y == all[at].y) {
                continue;
            }
            if (next < 0 || cross(all[at], all[next], all[i]) < 0 ||
                (cross(all[at], all[next], all[i]) == 0 &&
                 hypotl(all[i].x - all[at].x, all[i].y - all[at].y) >
                     hypotl(all[next].x - all[at].x, all[next].y - all[at].y))) {
                next = i;
            }
        }
        at = next;
    } while (at >= 0 && out->count < MOST && (all[at].x != all[first].x || all[at].y != all[first].y));
}

static long double to_edge(point p, point a, point b, point *nearest)
{
    long double dx = b.x - a.x, dy = b.y - a.y, size = dx * dx + dy * dy;
    long double t = size > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / size : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    nearest->x = a.x + t * dx;
    nearest->y = a.y + t * dy;
    return hypotl(p.x - nearest->x, p.y - nearest->y);
}

/* Signed distance of p, and the nearest point of the border. */
static long double to_ring(const ring *r, point p, point *nearest)
{
    long double best = INFINITY;
    int inside = r->count > 2;
    for (int i = 0; i < r->count; i++) {
        point a = r->corner[i], b = r->corner[(i + 1) % r->count], at;
        long double d = to_edge(p, a, b, &at);
        inside = inside && cross(a, b, p) > 0;
        if (d < best) {
            best = d;
            *nearest = at;
        }
    }
    return inside ? -best : best;
}

typedef struct trial {
    tahr_body_desc body;
    double vertices[12][3];
    outline piece, shape;
    tahr_sweep query;
    ring ring;
    long double radius;       /* of both */
    long double least, where; /* the smallest distance on the way, and at which fraction */
} trial;

/* Everything near this place. */
static double place_x, place_y;

static void turn_body(trial *t, double angle, int axis_in_plane)
{
    tahr_quat *q = &t->body.pose.orientation;
    *q = (tahr_quat){0, 0, sin(angle / 2), cos(angle / 2)};
    if (axis_in_plane) { /* z to y first, by -90 degrees about x */
        double h = sqrt(0.5);
        *q = (tahr_quat){-h * cos(angle / 2), -h * sin(angle / 2), h * sin(angle / 2), h * cos(angle / 2)};
    }
}

static void add_corner(trial *t, double angle, double x, double y)
{
    point *p = &t->piece.corner[t->piece.count++];
    long double c = cosl(angle), s = sinl(angle);
    p->x = t->body.pose.position.x + c * x - s * y;
    p->y = t->body.pose.position.y + s * x + c * y;
}

static void make_hull(trial *t, double angle, int count)
{
    for (int i = 0; i < count; i++) {
        t->vertices[i][0] = uniform(-1, 1);
        t->vertices[i][1] = uniform(-1, 1);
        t->vertices[i][2] = uniform(-1, 1); /* does not count */
        add_corner(t, angle, t->vertices[i][0], t->vertices[i][1]);
    }
    t->body.vertices = t->vertices[0];
    t->body.vertex_count = (uint32_t)count;
}

static void make_body(trial *t)
{
    const uint32_t kinds[] = {TAHR_BODY_BOX, TAHR_BODY_SPHERE, TAHR_BODY_CAPSULE, TAHR_BODY_HULL, TAHR_BODY_CHAIN};
    uint32_t kind = kinds[oracle_below(&dice, 5)];
    double angle = oracle_below(&dice, 4) ? uniform(-3, 3) : 0, a = uniform(0.05, 1.5), b = uniform(0.05, 1.5);
    assert_int_equal(tahr_body_desc_init(&t->body, sizeof t->body, kind), TAHR_OK);
    t->body.pose.position = (tahr_vec3){place_x + uniform(-1, 1), place_y + uniform(-1, 1), uniform(-5, 5)};
    t->piece.count = 0;
    t->piece.radius = 0;
    turn_body(t, angle, kind == TAHR_BODY_CAPSULE);
    if (kind == TAHR_BODY_BOX) {
        t->body.half_extents = (tahr_vec3){a, b, 1};
        for (int i = 0; i < 4; i++) {
            add_corner(t, angle, i & 1 ? a : -a, i & 2 ? b : -b);
        }
    } else if (kind == TAHR_BODY_SPHERE || kind == TAHR_BODY_CAPSULE) {
        t->body.radius = a;
        t->body.half_height = a + b;
        t->piece.radius = a;
        b = kind == TAHR_BODY_SPHERE ? 0 : t->body.half_height - a;
        add_corner(t, angle, 0, b);
        add_corner(t, angle, 0, -b);
    } else {
        make_hull(t, angle, kind == TAHR_BODY_CHAIN ? 2 : 4 + (int)oracle_below(&dice, 9));
        t->body.flags = kind == TAHR_BODY_CHAIN ? (uint32_t)TAHR_BODY_TWO_SIDED : 0;
    }
}

static void make_shape(trial *t)
{
    tahr_sweep *q = &t->query;
    double angle = oracle_below(&dice, 3) ? uniform(-3, 3) : 0, radius = uniform(0.1, 0.5),
           half = radius + uniform(0, 1);
    double wide = uniform(0.1, 0.6), ux = sin(angle), uy = cos(angle);
    memset(q, 0, sizeof *q);
    q->shape.type = 1 + oracle_below(&dice, 3);
    q->up = (tahr_vec3){ux, uy, 0};
    q->position = (tahr_vec3){place_x + uniform(-4, 4), place_y + uniform(-4, 4), 7};
    t->shape.count = 0;
    t->shape.radius = q->shape.type == TAHR_SHAPE_BOX ? 0 : radius;
    half = q->shape.type == TAHR_SHAPE_SPHERE ? radius : half;
    q->shape.radius = (double)t->shape.radius;
    q->shape.half_height = half;
    q->shape.half_x = q->shape.half_y = q->shape.type == TAHR_SHAPE_BOX ? wide : 0;
    for (int i = 0; i < 4; i++) {
        long double across = q->shape.type == TAHR_SHAPE_BOX ? (i & 1 ? wide : -wide) : 0;
        long double along = (i & 2 ? 1 : -1) * (half - t->shape.radius);
        point *p = &t->shape.corner[t->shape.count++];
        p->x = q->position.x + along * ux + across * uy;
        p->y = q->position.y + along * uy - across * ux;
    }
    /* z is up: a turn by -90 degrees about x, then by -angle about z */
    double h = sqrt(0.5), c = cos(-angle / 2), s = sin(-angle / 2);
    q->orientation = (tahr_quat){-h * c, -h * s, h * s, h * c};
}

static void make_trial(trial *t)
{
    point all[MOST] = {{0, 0}};
    int n = 0;
    place_x = oracle_below(&dice, 4) ? 0 : 1e6 + 0.3;
    place_y = oracle_below(&dice, 4) ? 0 : -3e5 - 0.7;
    make_body(t);
    make_shape(t);
    double goal_x = place_x + uniform(-2, 2), goal_y = place_y + uniform(-2, 2), far = uniform(0.2, 2);
    t->query.motion.x = (goal_x - t->query.position.x) * far;
    t->query.motion.y = (goal_y - t->query.position.y) * far;
    t->query.margin = oracle_below(&dice, 3) ? 0.01 : 0;
    t->query.mask = 0xFFFFFFFFu;
    t->query.ignore_body = TAHR_NO_BODY;
    t->radius = t->shape.radius + t->piece.radius;
    for (int i = 0; i < t->piece.count; i++) {
        for (int k = 0; k < t->shape.count; k++) {
            all[n].x = t->piece.corner[i].x - t->shape.corner[k].x;
            all[n++].y = t->piece.corner[i].y - t->shape.corner[k].y;
        }
    }
    wrap(all, n, &t->ring);
}

static long double distance_at(const trial *t, long double fraction, point *away)
{
    point p = {fraction * t->query.motion.x, fraction * t->query.motion.y}, nearest = {0, 0};
    long double d = to_ring(&t->ring, p, &nearest);
    away->x = d > 0 ? p.x - nearest.x : nearest.x - p.x;
    away->y = d > 0 ? p.y - nearest.y : nearest.y - p.y;
    return d - t->radius;
}

/* Convex, so by thirds. */
static void find_least(trial *t)
{
    long double a = 0, b = 1;
    point away;
    for (int i = 0; i < 60; i++) {
        long double p = a + (b - a) / 3, q = b - (b - a) / 3;
        if (distance_at(t, p, &away) < distance_at(t, q, &away)) {
            b = q;
        } else {
            a = p;
        }
    }
    t->where = (a + b) / 2;
    t->least = distance_at(t, t->where, &away);
}

typedef struct tally {
    int hits, overlaps, missed, false_hits;
    double depth, normal, contact; /* worst errors: m, degrees, m */
    double gaps[QUERIES];          /* m */
    int gap_count;
} tally;

static double angle_to(tahr_vec3 n, point away)
{
    long double size = hypotl(away.x, away.y);
    return (double)(fabsl(n.x * away.y - n.y * away.x) / size) * 57.3;
}

static void judge_sweep(const trial *t, tahr_world *world, tally *sum)
{
    tahr_hit hit;
    uint32_t count = 0;
    point away;
    long double start = distance_at(t, 0, &away), gap;
    assert_int_equal(tahr_world_sweep(world, &t->query, &hit, 1, &count), TAHR_OK);
    if (start < -1e-9) {
        assert_int_equal(count, 1);
        assert_int_equal(hit.start_overlap, 1);
        sum->overlaps++;
        sum->depth = fmax(sum->depth, fabs((double)(hit.depth + start)));
        return;
    }
    if (count == 0) {
        sum->missed += t->least < t->query.margin - 1e-6 && start > t->query.margin;
        return;
    }
    sum->hits++;
    sum->false_hits += t->least > t->query.margin + 1e-6;
    gap = distance_at(t, hit.fraction, &away);
    if (hit.fraction > 0) {
        sum->gaps[sum->gap_count++] = fabs((double)(gap - t->query.margin));
        sum->false_hits += hit.fraction > t->where + 1e-6;
    }
    if (gap + t->radius > 1e-4) {
        sum->normal = fmax(sum->normal, angle_to(hit.normal, away));
    }
    assert_true(hit.point.z == 7 && hit.normal.z == 0);
}

static void judge_contacts(const trial *t, tahr_world *world, tally *sum)
{
    tahr_contact contact;
    uint32_t count = 0;
    point away;
    tahr_contact_query q = {.shape = t->query.shape,
                            .position = t->query.position,
                            .up = t->query.up,
                            .orientation = t->query.orientation,
                            .margin = 20,
                            .mask = 0xFFFFFFFFu,
                            .ignore_body = TAHR_NO_BODY};
    assert_int_equal(tahr_world_contacts(world, &q, &contact, 1, &count), TAHR_OK);
    assert_int_equal(count, 1);
    sum->contact = fmax(sum->contact, fabs((double)(contact.distance - distance_at(t, 0, &away))));
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* A row of the table that tests/accuracy prints for the backends of space. Returns the worst gap. */
static double print_row(uint32_t engine, tally *s)
{
    static const double LIMIT = 2e-9; /* m */
    qsort(s->gaps, (size_t)s->gap_count, sizeof s->gaps[0], by_size);
    double worst = s->gaps[s->gap_count - 1], part = fmax(fmax(worst, s->depth), s->contact) / LIMIT;
    print_message("%-14s %-12s %5d %5d %9.1e %9.1e %6d %6d %8.1e %9.1e %9.1e %6.3f\n",
                  engine == TAHR_BOX2D_2 ? "box2d 2.4" : "box2d 3", "plane", QUERIES, s->hits,
                  s->gaps[(int)(0.99 * (s->gap_count - 1))], worst, s->missed, s->false_hits, s->normal, s->contact,
                  s->depth, part);
    return worst;
}

static void twenty_thousand_sweeps_are_within_a_nanometre_of_the_truth(void **unused)
{
    static tally sums[2];
    (void)unused;
    for (int i = 0; i < QUERIES; i++) {
        trial t;
        fake_log log = {0};
        make_trial(&t);
        find_least(&t);
        for (int e = 0; e < engine_count; e++) {
            tahr_world *world = box2d_open(engines[e], &t.body, 1, &log);
            judge_sweep(&t, world, &sums[e]);
            judge_contacts(&t, world, &sums[e]);
            tahr_world_close(world);
        }
    }
    print_message("%-14s %-12s %5s %5s %9s %9s %6s %6s %8s %9s %9s %6s\n", "backend", "family", "cases", "hits",
                  "gap p99 m", "gap max m", "missed", "false", "normal", "contact m", "depth m", "of lim");
    for (int e = 0; e < engine_count; e++) {
        tally *s = &sums[e];
        double gap = print_row(engines[e], s);
        assert_true(s->hits > 6000 && s->overlaps > 1000);
        assert_int_equal(s->missed + s->false_hits, 0);
        assert_true(gap <= 2e-9 && s->depth <= 2e-9 && s->contact <= 2e-9 && s->normal <= 0.1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(twenty_thousand_sweeps_are_within_a_nanometre_of_the_truth),
    };
    engine_count = box2d_engines(engines);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
#endif
