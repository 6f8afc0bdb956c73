/* SPDX-License-Identifier: MIT
 * selftest_sweep.c: cases: where a sweep begins, stops and does not stop at a flat face. */
#include <float.h>

#include "selftest.h"

/* Unit normals of faces: floor, slopes of 30 and 60 degrees, walls, ceilings. */
static const double faces[][2] = {
    {0, 1},  {-0.5, 0.86602540378443864676}, {0.86602540378443864676, 0.5}, {1, 0}, {-1, 0},
    {0, -1}, {0.5, -0.86602540378443864676}};
enum { FACES = sizeof faces / sizeof faces[0] };

/* A face with the shape that far in front of it (scene units; negative: inside); opens. Returns the place. */
static int face(tahr__lab *lab, const double normal[2], double gap, double place[2])
{
    double away = tahr__lab_reach(lab, tahr__lab_toward(lab, -normal[0], -normal[1])) / lab->scale + gap;
    place[0] = normal[0] * away;
    place[1] = normal[1] * away;
    if (lab->world) {
        return 1;
    }
    tahr__lab_plane(lab, normal[0], normal[1]);
    return tahr__lab_open(lab);
}

static void overlap_at_start(tahr__lab *lab)
{
    static const double depths[] = {0.2, 0.05, 0.001};
    static const double motions[][2] = {{0, 0}, {1, 0}, {0, -1}, {0, 1}};
    double p[2];
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        for (int i = 0; i < 12 && face(lab, faces[0], -depths[i / 4], p); i++) {
            const double *m = motions[i % 4];
            tahr_sweep q = tahr__lab_sweep(lab, p[0], p[1], m[0], m[1]);
            lab->number = depths[i / 4];
            tahr__lab_overlaps(lab, &q, depths[i / 4], tahr__lab_up(lab), "in the floor, motion or none");
        }
    }
}

/* One of the other faces each: what only knows up fails here. */
static void overlap_with_walls(tahr__lab *lab)
{
    double p[2];
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        for (int i = 1; i < FACES; i++) {
            tahr__lab_clear(lab);
            if (!face(lab, faces[i], -0.05, p)) {
                return;
            }
            tahr_sweep q = tahr__lab_sweep(lab, p[0], p[1], 0, 0);
            lab->number = i;
            tahr__lab_overlaps(lab, &q, 0.05, tahr__lab_toward(lab, faces[i][0], faces[i][1]), "in face");
        }
    }
}

/* From d0 in front of a floor (n = up) or a wall: straight in, in on a slant, along, away on a slant, away. */
static void rest_before(tahr__lab *lab, const double n[2], double d0)
{
    double p[2], way = max_of(0, d0 - lab->margin), tu = n[1], tv = -n[0];
    vec3 normal = tahr__lab_toward(lab, n[0], n[1]);
    if (!face(lab, n, d0, p)) {
        return;
    }
    tahr_sweep in = tahr__lab_sweep(lab, p[0], p[1], -0.5 * n[0], -0.5 * n[1]);
    tahr_sweep slant = tahr__lab_sweep(lab, p[0], p[1], 0.5 * (tu - n[0]), 0.5 * (tv - n[1]));
    tahr_sweep along = tahr__lab_sweep(lab, p[0], p[1], 3 * tu, 3 * tv);
    tahr_sweep rise = tahr__lab_sweep(lab, p[0], p[1], 0.5 * tu + 0.01 * n[0], 0.5 * tv + 0.01 * n[1]);
    tahr_sweep still = tahr__lab_sweep(lab, p[0], p[1], 0, 0);
    tahr_sweep out = tahr__lab_sweep(lab, p[0], p[1], 0.5 * n[0], 0.5 * n[1]);
    tahr__lab_stops(lab, &in, way / 0.5, normal, "straight at a face from");
    tahr__lab_stops(lab, &slant, way / 0.5, normal, "on a slant at a face from");
    tahr__lab_free(lab, &along, "along at");
    tahr__lab_free(lab, &rise, "away on a slant from");
    tahr__lab_free(lab, &out, "away from");
    tahr__lab_free(lab, &still, "no motion at");
}

static void rest_at(tahr__lab *lab, double d0)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        lab->number = d0;
        rest_before(lab, faces[0], d0);
        tahr__lab_clear(lab);
        rest_before(lab, faces[3], d0);
    }
}

static void touch(tahr__lab *lab)
{
    double p[2];
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        if (!face(lab, faces[0], 0, p)) {
            return;
        }
        tahr_sweep down = tahr__lab_sweep(lab, p[0], p[1], 0, -0.5), up = tahr__lab_sweep(lab, p[0], p[1], 0.2, 0.5);
        tahr_hit hit;
        up.flags = TAHR_SWEEP_LEAVE_OVERLAP; /* it may be 1e-17 deep */
        tahr__lab_free(lab, &up, "up from touching");
        if (!tahr__lab_ask(lab, &down, &hit)) {
            return;
        }
        tahr__lab_check(lab,
                        hit.blocking && hit.fraction == 0 && hit.depth <= tahr__lab_slack(lab) &&
                            tahr__lab_same_direction(lab, hit.normal, tahr__lab_up(lab)),
                        "touching the floor and going down: blocked at 0, normal up",
                        "%s: blocking %u, fraction %.9g, depth %.3g, normal (%.4f, %.4f, %.4f)", lab->shape_name,
                        hit.blocking, hit.fraction, hit.depth, hit.normal.x, hit.normal.y, hit.normal.z);
    }
}

static void rest_at_margin(tahr__lab *lab)
{
    rest_at(lab, 0.01);
}

static void rest_one_ulp_farther(tahr__lab *lab)
{
    rest_at(lab, 0.01 * (1 + DBL_EPSILON));
}

static void rest_one_ulp_closer(tahr__lab *lab)
{
    rest_at(lab, 0.01 * (1 - DBL_EPSILON));
}

static void rest_a_micrometre_around(tahr__lab *lab)
{
    rest_at(lab, 0.01 + 1e-6);
    rest_at(lab, 0.01 - 1e-6);
}

static void rest_a_millimetre_around(tahr__lab *lab)
{
    rest_at(lab, 0.01 + 1e-3);
    rest_at(lab, 0.01 - 1e-3);
}

/* From several distances onto every face, straight and slanted. */
static void stop(tahr__lab *lab, double margin)
{
    static const double gaps[] = {0.05, 1, 7};
    double p[2];
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        for (int i = 0; i < 3 * FACES; i++) {
            const double *n = faces[i / 3];
            if (i % 3 == 0) {
                tahr__lab_clear(lab);
                lab->margin = margin;
            }
            if (!face(lab, n, gaps[i % 3], p)) {
                return;
            }
            double mu = -10 * n[0] + 2 * n[1], mv = -10 * n[1] - 2 * n[0];
            tahr_sweep q = tahr__lab_sweep(lab, p[0], p[1], mu, mv);
            lab->number = gaps[i % 3];
            tahr__lab_stops(lab, &q, (gaps[i % 3] - margin) / 10, tahr__lab_toward(lab, n[0], n[1]), "from a distance");
        }
    }
}

static void stops_at_margin(tahr__lab *lab)
{
    stop(lab, 0.01);
}

static void stops_without_margin(tahr__lab *lab)
{
    stop(lab, 0);
}

/* A motion that ends a little before, and one that ends a little later. */
static void free_when_short(tahr__lab *lab)
{
    double p[2];
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        double slack = 2 * tahr__lab_slack(lab);
        if (!face(lab, faces[0], 0.5, p)) {
            return;
        }
        tahr_sweep before = tahr__lab_sweep(lab, p[0], p[1], 0.3, -(0.49 - slack));
        tahr_sweep after = tahr__lab_sweep(lab, p[0], p[1], 0.3, -(0.49 + slack));
        lab->number = slack;
        tahr__lab_free(lab, &before, "ends before the margin by");
        tahr__lab_stops(lab, &after, 0.49 / (0.49 + slack), tahr__lab_up(lab), "ends behind the margin by");
    }
}

/* sine: of the angle to the floor. 0.01 m above the margin to begin with: at 0.1 degrees that is 5.7 m of way. */
static void graze(tahr__lab *lab, double sine)
{
    double p[2], cosine = sqrt(1 - sine * sine), way = 0.01 / sine;
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        if (!face(lab, faces[0], 0.02, p)) {
            return;
        }
        tahr_sweep meets = tahr__lab_sweep(lab, p[0] - 5, p[1], 1.2 * way * cosine, -1.2 * way * sine);
        tahr_sweep short_of = tahr__lab_sweep(lab, p[0] - 5, p[1], 0.95 * way * cosine, -0.95 * way * sine);
        lab->number = sine;
        tahr__lab_stops(lab, &meets, 1 / 1.2, tahr__lab_up(lab), "a graze with the sine");
        tahr__lab_free(lab, &short_of, "a graze that ends above, with the sine");
    }
}

static void grazing_at_a_degree(tahr__lab *lab)
{
    graze(lab, 0.01745240643728351282);
}

static void grazing_at_a_tenth_of_a_degree(tahr__lab *lab)
{
    graze(lab, 0.00174532836589830883);
}

static void separating_is_free(tahr__lab *lab)
{
    /* Directions away: straight, 45 degrees, 1, 0.1 and 0.001 degrees. */
    static const double ways[][2] = {{0, 1}, {1, 1}, {5, 0.0873}, {-5, 0.00873}, {5, 0.0000873}};
    static const double gaps[] = {1e-6, 1e-3, 5e-3, 0.01, 0.02};
    double p[2];
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        for (int i = 0; i < 25 && face(lab, faces[0], gaps[i / 5], p); i++) {
            tahr_sweep q = tahr__lab_sweep(lab, p[0], p[1], ways[i % 5][0], ways[i % 5][1]);
            lab->number = gaps[i / 5];
            tahr__lab_free(lab, &q, "away from a floor at");
        }
    }
}

/* Eight gaps to every decade from a micrometre to 0.1 m: engines stop early within a slop of their own, often between 1
 * and 10 mm. A short way and a long one. */
static void parallel_is_free(tahr__lab *lab)
{
    enum { GAPS = 41 };
    const double eighth = 1.3335214321633240257; /* 10 to the power of 1/8 */
    double p[2];
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        double gap = 1e-6;
        for (int i = 0; i < GAPS && face(lab, faces[0], gap, p); i++, gap *= eighth) {
            tahr_sweep near = tahr__lab_sweep(lab, p[0] - 4, p[1], 0.1, 0);
            tahr_sweep far = tahr__lab_sweep(lab, p[0] - 4, p[1], 9, 0);
            lab->number = gap;
            tahr__lab_free(lab, &near, "0.1 m along a floor at");
            tahr__lab_free(lab, &far, "9 m along a floor at");
        }
    }
}

static void parallel_to_a_wall_is_free(tahr__lab *lab)
{
    static const double gaps[] = {1e-6, 1e-4, 1e-3, 0.01, 0.1};
    double p[2];
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        for (int i = 0; i < 10 && face(lab, faces[3], gaps[i / 2], p); i++) {
            tahr_sweep q = tahr__lab_sweep(lab, p[0], p[1], 0, i % 2 ? 5 : -5);
            lab->number = gaps[i / 2];
            tahr__lab_free(lab, &q, "up and down a wall at");
        }
    }
}

static void leaves_overlap(tahr__lab *lab)
{
    double p[2];
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        if (!face(lab, faces[0], -0.05, p)) {
            return;
        }
        tahr_sweep out = tahr__lab_sweep(lab, p[0], p[1], 0.5, 0.5),
                   deeper = tahr__lab_sweep(lab, p[0], p[1], 0.5, -0.5);
        tahr_hit hit;
        out.flags = deeper.flags = TAHR_SWEEP_LEAVE_OVERLAP;
        lab->number = 0.05;
        tahr__lab_free(lab, &out, "LEAVE_OVERLAP, out of");
        if (!tahr__lab_ask(lab, &deeper, &hit)) {
            return;
        }
        tahr__lab_check(lab, (hit.blocking || hit.start_overlap) && hit.fraction == 0,
                        "LEAVE_OVERLAP and a motion deeper in: blocked at 0", "%s: blocking %u, fraction %.9g",
                        lab->shape_name, hit.blocking, hit.fraction);
    }
}

static void distance_is_said(tahr__lab *lab)
{
    double p[2];
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        tahr_hit far, near;
        if (!face(lab, faces[0], 0.5, p)) {
            return;
        }
        tahr_sweep q = tahr__lab_sweep(lab, p[0], p[1], 0, -1), closer = q;
        closer.position = sub(q.position, tahr__lab_along(lab, 0, 0.496));
        if (!tahr__lab_ask(lab, &q, &far) || !tahr__lab_ask(lab, &closer, &near)) {
            return;
        }
        tahr__lab_check(lab,
                        fabs(far.distance - 0.01) <= tahr__lab_slack(lab) &&
                            fabs(near.distance - 0.004) <= tahr__lab_slack(lab),
                        "distance: the margin (0.01) of an ordinary hit, 0.004 where it began so close",
                        "%s: %.9g and %.9g", lab->shape_name, far.distance, near.distance);
        double height = dot(sub(far.point, lab->origin), tahr__lab_up(lab));
        tahr__lab_check(lab, fabs(height) <= tahr__lab_slack(lab), "point: on the surface, height 0", "%s: height %.9g",
                        lab->shape_name, height);
    }
}

static const tahr__lab_case cases[] = {
    {"overlap_at_start", 0, overlap_at_start},
    {"overlap_with_walls_and_slopes", 0, overlap_with_walls},
    {"touch", 0, touch},
    {"rest_at_margin", 0, rest_at_margin},
    {"rest_at_margin_plus_one_ulp", 0, rest_one_ulp_farther},
    {"rest_at_margin_minus_one_ulp", 0, rest_one_ulp_closer},
    {"rest_1e-6_around_margin", 0, rest_a_micrometre_around},
    {"rest_1e-3_around_margin", 0, rest_a_millimetre_around},
    {"stops_at_margin", 0, stops_at_margin},
    {"stops_without_margin", 0, stops_without_margin},
    {"stops_only_within_the_motion", 0, free_when_short},
    {"stop_distance_and_point", 0, distance_is_said},
    {"grazing_1_degree", 0, grazing_at_a_degree},
    {"grazing_0.1_degree", 0, grazing_at_a_tenth_of_a_degree},
    {"separating_motion_is_free", 0, separating_is_free},
    {"parallel_motion_is_free", 0, parallel_is_free},
    {"parallel_to_a_wall_is_free", 0, parallel_to_a_wall_is_free},
    {"leave_overlap", 0, leaves_overlap},
};

const tahr__lab_theme tahr__lab_sweeps = {cases, sizeof cases / sizeof cases[0]};
