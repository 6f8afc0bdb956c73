/* SPDX-License-Identifier: MIT
 * test_sweep_truth.c: sweeps and contacts of every backend against the stored quad-precision truth, scored backward
 * (score.h): how far from the margin the shape really is where the answer stops it, and how far its normal lies outside
 * of the cone of those that are right there. Hit or miss counts only beyond tau, where truth is no matter of rounding.
 * The solver that finds truth on the spot must find the stored one again. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>
#include <tahr/native.h>
#ifdef TAHR_HAVE_CCD
#include <tahr/ccd.h>
#endif
#ifdef TAHR_HAVE_FCL
#include <tahr/fcl.h>
#endif
#ifdef TAHR_HAVE_BOX2D
#include <tahr/box2d.h>
#endif

#include "truth_file.h"

enum { MAX_COMPLAINTS = 4, MAX_CONTACTS = 256 };

/* m: what a character may ask about in a contact query. */
static const double CONTACT_REACH = 8;

typedef struct subject {
    const char *name;
    const tahr_backend *backend;
    const void *options;
    double (*gap_limit)(const truth_case *c, const truth_body *body);
    double normal_limit; /* degrees */
    int planar;          /* 1: a backend of two dimensions */
} subject;

/* One family on one backend. */
typedef struct trial {
    const subject *subject;
    const char *family;
    tahr_world *world;
    score_sweeps sweeps;
    score_stat contacts;
    double worst_contact_normal, worst_ratio;
    int complaints;
} trial;

static double length_of(tahr_vec3 v)
{
    return sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

/* 1e-9 m for extents to 100 m, in proportion beyond (53 bits of 100 m are 1e-14 m; the rest is conditioning). */
static double limit_native(const truth_case *c, const truth_body *body)
{
    double extent = length_of(c->query.motion);

    for (uint32_t i = 0; i < body->judged.vertex_count; i++) {
        const double *v = &body->vertices[i * 3];
        tahr_vec3 d = {v[0] - c->query.position.x, v[1] - c->query.position.y, v[2] - c->query.position.z};
        extent = fmax(extent, length_of(d));
    }
    return 1e-9 * fmax(extent / 100, 1);
}

#if defined(TAHR_HAVE_CCD) || defined(TAHR_HAVE_FCL)
/* 1e-4 of the shape's largest extent. */
static double limit_library(const truth_case *c, const truth_body *body)
{
    const tahr_shape *s = &c->query.shape;

    (void)body;
    return 1e-4 * 2 * fmax(s->half_height, fmax(s->half_x, s->half_y));
}
#endif

#ifdef TAHR_HAVE_BOX2D
/* 1e-3 of the shape's largest extent. */
static double limit_box2d(const truth_case *c, const truth_body *body)
{
    const tahr_shape *s = &c->query.shape;

    (void)body;
    return 1e-3 * 2 * fmax(s->half_height, s->half_x);
}
#endif

/* Slivers: a degree, for rounding alone tilts them. */
static double normal_limit(const trial *t)
{
    return t->subject->normal_limit < 1 && !strcmp(t->family, "sliver") ? 1 : t->subject->normal_limit;
}

static void complain(trial *t, const truth_case *c, const char *what, double got, double limit)
{
    if (t->complaints++ < MAX_COMPLAINTS) {
        print_message("    %s: truth/%s.txt line %d: %s: %.3g, allowed %.3g\n", t->subject->name, t->family, c->line,
                      what, got, limit);
    }
}

static void check(trial *t, const truth_case *c, const char *what, double got, double limit)
{
    if (!(got <= limit)) {
        complain(t, c, what, got, limit);
    }
}

static void try_sweep(trial *t, const truth_body *body, const truth_case *c)
{
    const score_scene scene = {&body->judged, 1};
    double limit = t->subject->gap_limit(c, body);
    tahr_hit hit = {0};
    uint32_t count = 0;
    tahr_status status = tahr_world_sweep(t->world, &c->query, &hit, 1, &count);
    score_answer a = score_sweep(&scene, &c->query, &c->truth, status, &hit, count, 2 * limit);

    score_sweeps_add(&t->sweeps, &a);
    if (a.failure != SCORE_FINE) { /* hit or miss is asked for no more sharply than the gap */
        int counts = a.failure == SCORE_MISS || a.failure == SCORE_FALSE_HIT || a.failure == SCORE_START;
        check(t, c, score_failure_name(a.failure), counts ? a.beyond : INFINITY, fmax(limit, SCORE_TAU[0]));
        return;
    }
    if (!a.measured) {
        return;
    }
    t->worst_ratio = fmax(t->worst_ratio, fabs(a.gap_error) / limit);
    check(t, c, a.gap_error < 0 ? "late by" : "early by", fabs(a.gap_error), limit);
    check(t, c, "angle of the normal", a.normal_error, normal_limit(t));
    check(t, c, "error of hit.distance", a.distance_error, limit);
    check(t, c, "distance of point from surface", a.point_error, limit);
    check(t, c, "length of the surface normal", fabs(length_of(hit.surface_normal) - 1), 1e-6);
}

/* The nearest contact is the signed distance of the whole surface. */
static void try_contacts(trial *t, const truth_body *body, const truth_case *c)
{
    const score_scene scene = {&body->judged, 1};
    const tahr_sweep *q = &c->query;
    double gap = c->truth.start_gap;
    tahr_contact_query query = {.shape = q->shape,
                                .position = q->position,
                                .up = q->up,
                                .orientation = q->orientation,
                                .margin = (gap > 0 ? gap : 0) + 0.01,
                                .mask = q->mask,
                                .ignore_body = TAHR_NO_BODY};
    tahr_contact contacts[MAX_CONTACTS] = {{0}};
    uint32_t count = 0;

    if (gap > CONTACT_REACH) {
        return;
    }
    tahr_status status = tahr_world_contacts(t->world, &query, contacts, MAX_CONTACTS, &count);
    if (status != TAHR_OK || count == 0) {
        complain(t, c, "contacts: status or none", status, TAHR_OK);
        return;
    }
    truth_case still = *c;
    still.query.motion = (tahr_vec3){0, 0, 0};
    double limit = t->subject->gap_limit(&still, body), error = fabs(contacts[0].distance - gap);
    double angle = score_normal_error(&scene, q, 0, 2 * limit, contacts[0].normal);
    score_stat_add(&t->contacts, error);
    t->worst_ratio = fmax(t->worst_ratio, error / limit);
    t->worst_contact_normal = fmax(t->worst_contact_normal, angle);
    check(t, c, "contact distance", error, limit);
    check(t, c, "angle of the contact normal", angle, normal_limit(t));
    for (uint32_t i = 1; i < count; i++) {
        check(t, c, "contacts in order", contacts[i - 1].distance, contacts[i].distance);
    }
}

static void open_world(trial *t, const truth_body *body)
{
    tahr_world_desc desc;

    tahr_world_close(t->world);
    t->world = NULL;
    assert_int_equal(tahr_world_desc_init(&desc, sizeof desc), TAHR_OK);
    desc.bodies = t->subject->planar ? &body->flat : &body->desc;
    desc.body_count = 1;
    desc.options = t->subject->options;
    assert_int_equal(tahr_world_open(t->subject->backend, &desc, &t->world), TAHR_OK);
}

static void try_case(void *user, const truth_body *body, int is_new, const truth_case *c)
{
    trial *t = user;

    if (is_new) {
        open_world(t, body);
    }
    try_sweep(t, body, c);
    try_contacts(t, body, c);
}

static int try_family(const subject *who, const char *family)
{
    trial t = {.subject = who, .family = family};
    score_sweeps *s = &t.sweeps;
    int cases = truth_each(family, try_case, &t);

    tahr_world_close(t.world);
    print_message("%-14s %-15s %5d %5u %9.1e %9.1e %6u %6u %8.1e %9.1e %8.1e %6.3f\n", who->name, family, cases,
                  s->gap.count, score_stat_quantile(&s->gap, 0.99), s->gap.max, s->misses[0], s->false_hits[0],
                  s->normal.max, t.contacts.max, t.worst_contact_normal, t.worst_ratio);
    score_sweeps_free(s);
    score_stat_free(&t.contacts);
    return t.complaints + (cases == 0);
}

static void backend_agrees_with_truth(void **state)
{
    const subject *who = *state;
    const char *const *families = who->planar ? TRUTH_PLANE_FAMILIES : TRUTH_FAMILIES;
    int failed = 0;

    print_message("%-14s %-15s %5s %5s %9s %9s %6s %6s %8s %9s %8s %6s\n", "backend", "family", "cases", "hits",
                  "gap p99 m", "gap max m", "missed", "false", "normal", "contact m", "normal", "of lim");
    for (size_t i = 0; families[i]; i++) {
        failed += try_family(who, families[i]);
    }
    assert_int_equal(failed, 0);
}

/* Of what is grazed within a tau both answers are right. */
static void solve_again(void *user, const truth_body *body, int is_new, const truth_case *c)
{
    const score_scene scene = {&body->judged, 1};
    int *judged = user;
    score_truth t;
    (void)is_new;

    if (!score_solve(&scene, &c->query, &t)) {
        return; /* counted below */
    }
    ++*judged;
    assert_true(fabs(t.start_gap - c->truth.start_gap) < 1e-12);
    if (fabs(c->truth.min_gap) < 1e-9) {
        return;
    }
    assert_int_equal(t.status, c->truth.status);
    if (t.status == SCORE_HIT) {
        double there = score_distance(&scene, &c->query, t.fraction, INFINITY);
        double stored = score_distance(&scene, &c->query, c->truth.fraction, INFINITY);
        assert_true(fabs(there - stored) < 1e-12);
    }
}

static void solving_on_the_spot_finds_the_stored_truth(void **state)
{
    static const char *const some[] = {"dyadic", "grazing", "mesh_flat", "convex_touching"};
    (void)state;

    for (size_t i = 0; i < sizeof some / sizeof *some; i++) {
        int judged = 0, cases = truth_each(some[i], solve_again, &judged);
        print_message("%s: %d of %d\n", some[i], judged, cases);
        assert_true(cases > 0 && judged == cases);
    }
}

/* The stored truth given as the answer, every seventh hit left out and every free sweep stopped half-way. */
typedef struct liar {
    score_sweeps right, wrong;
    uint32_t hits, dropped, made_up;
} liar;

static tahr_hit told(const truth_body *body, const truth_case *c)
{
    const score_scene scene = {&body->judged, 1};
    const score_truth *t = &c->truth;
    tahr_hit hit = {.blocking = 1, .fraction = t->fraction, .normal = t->normal, .surface_normal = t->normal};

    hit.start_overlap = t->status == SCORE_OVERLAP;
    hit.depth = hit.start_overlap ? -t->start_gap : 0;
    hit.distance = score_distance(&scene, &c->query, t->fraction, INFINITY);
    hit.point = (tahr_vec3){body->vertices[0], body->vertices[1], body->vertices[2]}; /* one of the surface */
    return hit;
}

static void tell(void *user, const truth_body *body, int is_new, const truth_case *c)
{
    const score_scene scene = {&body->judged, 1};
    liar *l = user;
    tahr_hit hit = told(body, c);
    int is_hit = c->truth.status == SCORE_HIT, is_deep = fabs(c->truth.min_gap) > SCORE_TAU[0];
    score_answer a = score_sweep(&scene, &c->query, &c->truth, TAHR_OK, &hit, c->truth.status != SCORE_FREE, 1e-9);
    (void)is_new;

    score_sweeps_add(&l->right, &a);
    int drops = is_hit && is_deep && ++l->hits % 7 == 0, makes_up = c->truth.status == SCORE_FREE && is_deep;
    l->dropped += (uint32_t)drops;
    l->made_up += (uint32_t)makes_up;
    a = score_sweep(&scene, &c->query, &c->truth, TAHR_OK, &hit, drops ? 0 : c->truth.status != SCORE_FREE || makes_up,
                    1e-9);
    score_sweeps_add(&l->wrong, &a);
}

static void truth_itself_is_right_and_lies_are_counted(void **state)
{
    (void)state;

    for (size_t i = 0; TRUTH_FAMILIES[i]; i++) {
        liar l = {.hits = 0};
        truth_each(TRUTH_FAMILIES[i], tell, &l);
        for (int k = 0; k < SCORE_FAILURES; k++) {
            assert_int_equal(l.right.failures[k], 0);
        }
        assert_true(l.right.gap.max < 1e-9 * (strcmp(TRUTH_FAMILIES[i], "far_1e6") ? 1 : 10));
        assert_true(l.right.normal.max < 1e-3); /* degrees: they are stored in single precision */
        assert_int_equal(l.wrong.misses[0], l.dropped);
        assert_int_equal(l.wrong.false_hits[0], l.made_up);
        score_sweeps_free(&l.right);
        score_sweeps_free(&l.wrong);
    }
}

int main(void)
{
    subject native = {"native", tahr_backend_v1_native(), NULL, limit_native, 0.1, 0};
#ifdef TAHR_HAVE_CCD
    static const tahr_ccd_desc by_gjk = {sizeof by_gjk, TAHR_CCD_SWEEP_BISECTION, TAHR_CCD_BOOLEAN_GJK, 0, {0}};
    static const tahr_ccd_desc by_mpr = {sizeof by_mpr, TAHR_CCD_SWEEP_BISECTION, TAHR_CCD_BOOLEAN_MPR, 0, {0}};
#endif
#ifdef TAHR_HAVE_BOX2D_2
    static const tahr_box2d_desc engine_2 = {.struct_size = sizeof engine_2, .engine = TAHR_BOX2D_2};
#endif
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solving_on_the_spot_finds_the_stored_truth),
        cmocka_unit_test(truth_itself_is_right_and_lies_are_counted),
        {"native_agrees_with_truth", backend_agrees_with_truth, NULL, NULL, &native},
#ifdef TAHR_HAVE_CCD
        {"ccd_agrees_with_truth", backend_agrees_with_truth, NULL, NULL,
         &(subject){"ccd", tahr_backend_v1_ccd(), NULL, limit_library, 2, 0}},
        {"ccd_by_gjk_agrees_with_truth", backend_agrees_with_truth, NULL, NULL,
         &(subject){"ccd by GJK", tahr_backend_v1_ccd(), &by_gjk, limit_library, 2, 0}},
        {"ccd_by_mpr_agrees_with_truth", backend_agrees_with_truth, NULL, NULL,
         &(subject){"ccd by MPR", tahr_backend_v1_ccd(), &by_mpr, limit_library, 2, 0}},
#endif
#ifdef TAHR_HAVE_FCL
        {"fcl_agrees_with_truth", backend_agrees_with_truth, NULL, NULL,
         &(subject){"fcl", tahr_backend_v1_fcl(), NULL, limit_library, 2, 0}},
#endif
#ifdef TAHR_HAVE_BOX2D
        {"newest_box2d_agrees_with_truth", backend_agrees_with_truth, NULL, NULL,
         &(subject){"box2d newest", tahr_backend_v1_box2d(), NULL, limit_box2d, 2, 1}},
#endif
#ifdef TAHR_HAVE_BOX2D_2
        {"box2d_2_agrees_with_truth", backend_agrees_with_truth, NULL, NULL,
         &(subject){"box2d 2.4", tahr_backend_v1_box2d(), &engine_2, limit_box2d, 2, 1}},
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
