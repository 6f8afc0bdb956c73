/* SPDX-License-Identifier: MIT
 * test_sweep_truth.c: sweeps and contacts of every backend against the stored quad-precision truth.
 * What is scored is the backward error: how far from the margin the shape really is where the answer stops it (a graze
 * has no stable time of impact, but always a stable gap), and the angle between the answer's normal and the nearest of
 * the directions that are closest there. Hit or miss counts only beyond tau, where truth is no matter of rounding. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <tahr/native.h>
#ifdef TAHR_HAVE_CCD
#include <tahr/ccd.h>
#endif
#ifdef TAHR_HAVE_FCL
#include <tahr/fcl.h>
#endif

#include "truth_file.h"

#ifndef TAHR_SOURCE_DIR
#define TAHR_SOURCE_DIR "."
#endif

enum { MAX_CASES = 512, MAX_COMPLAINTS = 4, MAX_CONTACTS = 256 };

typedef struct subject {
    const char *name;
    const tahr_backend *backend;
    const void *options;
    double (*gap_limit)(const truth_case *c, const truth_mesh *mesh);
    double normal_limit; /* degrees */
} subject;

typedef struct score {
    double gaps[MAX_CASES], contacts[MAX_CASES];
    int gap_count, contact_count, cases, hits, misses, false_hits, others, complaints;
    double worst_normal, worst_contact_normal, worst_ratio;
    const char *family;
    const subject *subject;
} score;

static const char *const families[] = {
    "generic",    "dyadic",      "lattice",     "feature",  "grazing",   "long",    "sliver",
    "tiny",       "huge",        "far_1e3",     "far_1e6",  "touching",  "overlap", "mesh_flat",
    "mesh_hills", "mesh_stairs", "mesh_corner", "mesh_fan", "mesh_soup",
};

static double length_of(tahr_vec3 v)
{
    return sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

/* 1e-9 m for extents to 100 m, in proportion beyond (53 bits of 100 m are 1e-14 m; the rest is conditioning). */
static double limit_double(const truth_case *c, const truth_mesh *mesh)
{
    double extent = length_of(c->query.motion);

    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const double *v = &mesh->vertices[i * 3];
        tahr_vec3 d = {v[0] - c->query.position.x, v[1] - c->query.position.y, v[2] - c->query.position.z};
        if (length_of(d) > extent) extent = length_of(d);
    }
    return 1e-9 * (extent > 100 ? extent / 100 : 1);
}

/* 2e-6 m for motions to a metre, a millionth of the motion beyond, at most a tenth of a millimetre. */
static double limit_float(const truth_case *c, const truth_mesh *mesh)
{
    double length = length_of(c->query.motion);

    (void)mesh;
    return length <= 1 ? 2e-6 : length * 1e-6 < 2e-6 ? 2e-6 : length > 100 ? 1e-4 : length * 1e-6;
}

#if defined(TAHR_HAVE_CCD) || defined(TAHR_HAVE_FCL)
/* 1e-4 of the shape's largest extent. */
static double limit_library(const truth_case *c, const truth_mesh *mesh)
{
    const tahr_shape *s = &c->query.shape;
    double size = s->half_height;

    (void)mesh;
    if (s->half_x > size) size = s->half_x;
    if (s->half_y > size) size = s->half_y;
    return 1e-4 * 2 * size;
}
#endif

static double tau_of(const score *s, const truth_case *c, const truth_mesh *mesh)
{
    double limit = s->subject->gap_limit(c, mesh);
    return limit > 1e-6 ? limit : 1e-6;
}

/* Slivers: a degree, for rounding alone tilts them. */
static double normal_limit(const score *s)
{
    return s->subject->normal_limit < 1 && !strcmp(s->family, "sliver") ? 1 : s->subject->normal_limit;
}

static void complain(score *s, const truth_case *c, const char *what, double got, double limit)
{
    s->others++;
    if (s->complaints++ < MAX_COMPLAINTS)
        print_message("    %s: truth/%s.txt line %d: %s: %.3g, allowed %.3g\n", s->subject->name, s->family, c->line,
                      what, got, limit);
}

static void check(score *s, const truth_case *c, const char *what, double got, double limit)
{
    if (!(got <= limit)) complain(s, c, what, got, limit);
}

static void score_hit(score *s, const truth_mesh *mesh, const truth_case *c, const tahr_hit *hit)
{
    nearest distances[TRUTH_MAX_TRIANGLES];
    double limit = s->subject->gap_limit(c, mesh), angle, expected, gap;
    tahr_sweep at_point = {.shape = {.type = TAHR_SHAPE_SPHERE}, .position = hit->point};

    gap = (double)truth_distances(mesh, &c->query, hit->fraction, distances) - c->query.shape.radius;
    expected = c->status == TRUTH_OVERLAP || c->start_gap < c->query.margin ? c->start_gap : c->query.margin;
    if (c->status == TRUTH_OVERLAP) gap = -hit->depth;
    angle = truth_normal_error(mesh, distances, 2 * limit, hit->normal);
    s->gaps[s->gap_count++] = fabs(gap - expected);
    if (fabs(gap - expected) / limit > s->worst_ratio) s->worst_ratio = fabs(gap - expected) / limit;
    if (angle > s->worst_normal) s->worst_normal = angle;
    check(s, c, gap < expected ? "late by" : "early by", fabs(gap - expected), limit);
    check(s, c, "angle of the normal", angle, normal_limit(s));
    check(s, c, "error of hit.distance", fabs(hit->distance - gap), limit);
    check(s, c, "length of the surface normal", fabs(length_of(hit->surface_normal) - 1), 1e-6);
    check(s, c, "distance of point from surface", (double)truth_distances(mesh, &at_point, 0, distances), limit);
}

static void score_sweep(score *s, tahr_world *world, const truth_mesh *mesh, const truth_case *c)
{
    tahr_hit hit = {0};
    uint32_t count = 0;
    tahr_status status = tahr_world_sweep(world, &c->query, &hit, 1, &count);
    double tau = tau_of(s, c, mesh);
    int resting = c->start_gap <= c->query.margin;

    s->cases++;
    if (status != TAHR_OK) {
        complain(s, c, "status", status, TAHR_OK);
    } else if (count == 0) {
        if (c->status == TRUTH_OVERLAP ? c->start_gap < -tau : c->status == TRUTH_HIT && c->min_gap < -tau) {
            s->misses++;
            complain(s, c, "missed, smallest distance over margin", c->min_gap, -tau);
        }
    } else if (hit.unknown) {
        complain(s, c, "unknown", hit.fraction, 0);
    } else if (c->status == TRUTH_FREE) {
        if (resting || c->min_gap > tau) {
            s->false_hits++;
            complain(s, c, "false hit, smallest distance over margin", c->min_gap, tau);
        }
    } else if (hit.start_overlap != (c->status == TRUTH_OVERLAP)) {
        if (fabs(c->start_gap) > tau) complain(s, c, "start_overlap", hit.start_overlap, c->status == TRUTH_OVERLAP);
    } else {
        s->hits++;
        score_hit(s, mesh, c, &hit);
    }
}

/* The nearest contact is the signed distance of the whole surface. */
static void score_contacts(score *s, tahr_world *world, const truth_mesh *mesh, const truth_case *c)
{
    static const double reach = 8; /* m: what a character may ask about */
    const tahr_sweep *q = &c->query;
    tahr_contact_query query = {.shape = q->shape,
                                .position = q->position,
                                .up = q->up,
                                .orientation = q->orientation,
                                .mask = q->mask,
                                .ignore_body = TAHR_NO_BODY};
    tahr_contact contacts[MAX_CONTACTS] = {{0}};
    nearest distances[TRUTH_MAX_TRIANGLES];
    truth_case still = *c;
    uint32_t count = 0;
    tahr_status status;

    if (c->start_gap > reach) return;
    query.margin = (c->start_gap > 0 ? c->start_gap : 0) + 0.01;
    status = tahr_world_contacts(world, &query, contacts, MAX_CONTACTS, &count);
    if (status != TAHR_OK || count == 0) {
        complain(s, c, "contacts: status or none", status, TAHR_OK);
        return;
    }
    still.query.motion = (tahr_vec3){0, 0, 0};
    double limit = s->subject->gap_limit(&still, mesh), error = fabs(contacts[0].distance - c->start_gap), angle;
    truth_distances(mesh, q, 0, distances);
    angle = truth_normal_error(mesh, distances, 2 * limit, contacts[0].normal);
    s->contacts[s->contact_count++] = error;
    if (error / limit > s->worst_ratio) s->worst_ratio = error / limit;
    if (angle > s->worst_contact_normal) s->worst_contact_normal = angle;
    check(s, c, "contact distance", error, limit);
    check(s, c, "angle of the contact normal", angle, normal_limit(s));
    for (uint32_t i = 1; i < count; i++)
        check(s, c, "contacts in order", contacts[i - 1].distance, contacts[i].distance);
}

static tahr_world *open_world(const subject *who, const truth_mesh *mesh)
{
    tahr_body_desc body;
    tahr_world_desc desc;
    tahr_world *world = NULL;

    assert_int_equal(tahr_body_desc_init(&body, sizeof body, TAHR_BODY_MESH), TAHR_OK);
    assert_int_equal(tahr_world_desc_init(&desc, sizeof desc), TAHR_OK);
    body.flags = TAHR_BODY_TWO_SIDED;
    body.vertices = mesh->vertices;
    body.indices = mesh->indices;
    body.vertex_count = mesh->vertex_count;
    body.triangle_count = mesh->triangle_count;
    desc.bodies = &body;
    desc.body_count = 1;
    desc.options = who->options;
    assert_int_equal(tahr_world_open(who->backend, &desc, &world), TAHR_OK);
    return world;
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double quantile(double *values, int count, double q)
{
    if (count == 0) return 0;
    qsort(values, (size_t)count, sizeof *values, by_size);
    return values[(int)(q * (count - 1))];
}

static void print_row(score *s)
{
    print_message("%-14s %-12s %5d %5d %9.1e %9.1e %6d %6d %8.1e %9.1e %8.1e %6.3f\n", s->subject->name, s->family,
                  s->cases, s->hits, quantile(s->gaps, s->gap_count, 0.99), quantile(s->gaps, s->gap_count, 1),
                  s->misses, s->false_hits, s->worst_normal, quantile(s->contacts, s->contact_count, 1),
                  s->worst_contact_normal, s->worst_ratio);
}

static int run_family(const subject *who, const char *family)
{
    static char line[65536];
    char path[1024];
    truth_mesh mesh = {.vertex_count = 0};
    tahr_world *world = NULL;
    score s = {.family = family, .subject = who};
    FILE *file;

    snprintf(path, sizeof path, "%s/tests/accuracy/truth/%s.txt", TAHR_SOURCE_DIR, family);
    file = fopen(path, "r");
    if (!file) fail_msg("cannot read %s", path);
    for (int number = 1; fgets(line, sizeof line, file); number++) {
        truth_case c;
        if (line[0] == 'm') {
            tahr_world_close(world);
            truth_read_mesh(line + 1, &mesh);
            world = open_world(who, &mesh);
        } else if (line[0] == 'c') {
            assert_true(s.cases < MAX_CASES);
            truth_read_case(line + 1, number, &c);
            score_sweep(&s, world, &mesh, &c);
            score_contacts(&s, world, &mesh, &c);
        }
    }
    fclose(file);
    tahr_world_close(world);
    print_row(&s);
    return s.others + (s.cases == 0);
}

static void backend_agrees_with_truth(void **state)
{
    const subject *who = *state;
    int failed = 0;

    print_message("%-14s %-12s %5s %5s %9s %9s %6s %6s %8s %9s %8s %6s\n", "backend", "family", "cases", "hits",
                  "gap p99 m", "gap max m", "missed", "false", "normal", "contact m", "normal", "of lim");
    for (size_t i = 0; i < sizeof families / sizeof *families; i++)
        failed += run_family(who, families[i]);
    assert_int_equal(failed, 0);
}

int main(void)
{
    static const tahr_native_desc in_float = {.struct_size = sizeof in_float, .precision = TAHR_NATIVE_FLOAT};
    static const tahr_native_desc in_double = {.struct_size = sizeof in_double, .precision = TAHR_NATIVE_DOUBLE};
    subject native_float = {"native float", tahr_backend_v1_native(), &in_float, limit_float, 0.1};
    subject native_double = {"native double", tahr_backend_v1_native(), &in_double, limit_double, 0.1};
#ifdef TAHR_HAVE_CCD
    static const tahr_ccd_desc by_gjk = {sizeof by_gjk, TAHR_CCD_SWEEP_BISECTION, TAHR_CCD_BOOLEAN_GJK, 0, {0}};
    static const tahr_ccd_desc by_mpr = {sizeof by_mpr, TAHR_CCD_SWEEP_BISECTION, TAHR_CCD_BOOLEAN_MPR, 0, {0}};
#endif
    const struct CMUnitTest tests[] = {
        {"native_float_agrees_with_truth", backend_agrees_with_truth, NULL, NULL, &native_float},
        {"native_double_agrees_with_truth", backend_agrees_with_truth, NULL, NULL, &native_double},
#ifdef TAHR_HAVE_CCD
        {"ccd_agrees_with_truth", backend_agrees_with_truth, NULL, NULL,
         &(subject){"ccd", tahr_backend_v1_ccd(), NULL, limit_library, 2}},
        {"ccd_by_gjk_agrees_with_truth", backend_agrees_with_truth, NULL, NULL,
         &(subject){"ccd by GJK", tahr_backend_v1_ccd(), &by_gjk, limit_library, 2}},
        {"ccd_by_mpr_agrees_with_truth", backend_agrees_with_truth, NULL, NULL,
         &(subject){"ccd by MPR", tahr_backend_v1_ccd(), &by_mpr, limit_library, 2}},
#endif
#ifdef TAHR_HAVE_FCL
        {"fcl_agrees_with_truth", backend_agrees_with_truth, NULL, NULL,
         &(subject){"fcl", tahr_backend_v1_fcl(), NULL, limit_library, 2}},
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
