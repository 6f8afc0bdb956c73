/* SPDX-License-Identifier: MIT
 * selftest_place.c: cases: far from the origin, tiny and huge; and each shape that is claimed, against all faces. */
#include "selftest.h"

/* Floor, wall, a slope and a graze at that size and place. Coordinates there are rounded to an ulp, which the exact
 * fractions do not know of: it is far below any tolerance. */
static void at_place(tahr__lab *lab, double factor, double u, double v)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        tahr__lab_resize(lab, factor, tahr__lab_toward(lab, u, v));
        double low = tahr__lab_reach(lab, tahr__lab_toward(lab, 0, -1)) / factor;
        double wide = tahr__lab_reach(lab, tahr__lab_toward(lab, 1, 0)) / factor;
        tahr__lab_block(lab, -6, -2, 4, 0);
        tahr__lab_block(lab, 4, -2, 6, 6);
        if (!tahr__lab_open(lab)) {
            return;
        }
        lab->number = u != 0 ? u : factor;
        tahr_sweep down = tahr__lab_sweep(lab, 0.3, low + 0.5, 0.2, -1),
                   wall = tahr__lab_sweep(lab, 0, low + 0.1, 8, 0);
        tahr_sweep along = tahr__lab_sweep(lab, -3, low + 0.011, 4, 0),
                   up = tahr__lab_sweep(lab, -3, low + 0.005, 1, 1);
        tahr_sweep inside = tahr__lab_sweep(lab, -2, low - 0.05, 0.1, 0);
        tahr_sweep graze = tahr__lab_sweep(lab, -3, low + 0.02, 3, -0.03); /* 0.57 degrees */
        tahr__lab_stops(lab, &down, 0.49, tahr__lab_up(lab), "floor at");
        tahr__lab_stops(lab, &wall, (4 - wide - 0.01) / 8, tahr__lab_toward(lab, -1, 0), "wall at");
        tahr__lab_stops(lab, &graze, 1.0 / 3, tahr__lab_up(lab), "graze at");
        tahr__lab_free(lab, &along, "along at");
        tahr__lab_free(lab, &up, "up at");
        tahr__lab_overlaps(lab, &inside, 0.05 * factor, tahr__lab_up(lab), "overlap at");
    }
}

static void far_1e4(tahr__lab *lab)
{
    at_place(lab, 1, 10000.3, -10000.7);
}

static void far_1e6(tahr__lab *lab)
{
    at_place(lab, 1, -1000000.3, 1000000.7);
}

static void tiny(tahr__lab *lab)
{
    at_place(lab, 1e-2, 0, 0);
}

static void tiny_1e3(tahr__lab *lab)
{
    at_place(lab, 1e-3, 0, 0);
}

static void huge_1e3(tahr__lab *lab)
{
    at_place(lab, 1e3, 0, 0);
}

/* Onto and away from planes of many directions, and overlapping them: the extent of every shape has a closed form. */
static void against_planes(tahr__lab *lab, uint32_t capability)
{
    static const double normals[][2] = {
        {0, 1},       {1, 0},       {-1, 0},     {0, -1},     {-0.5, 0.86602540378443864676},
        {0.28, 0.96}, {0.96, 0.28}, {0.8, -0.6}, {-0.6, -0.8}};
    for (uint32_t at = 0; tahr__lab_next(lab, &at, capability);) {
        for (size_t i = 0; i < sizeof normals / sizeof normals[0] && lab_goes_on(lab); i++) {
            const double *n = normals[i];
            double away = tahr__lab_reach(lab, tahr__lab_toward(lab, -n[0], -n[1]));
            tahr__lab_clear(lab);
            tahr__lab_plane(lab, n[0], n[1]);
            if (!tahr__lab_open(lab)) {
                return;
            }
            const vec3 normal = tahr__lab_toward(lab, n[0], n[1]);
            double over = away + 0.5, on = away + 0.01, in = away - 0.03;
            tahr_sweep q =
                tahr__lab_sweep(lab, n[0] * over, n[1] * over, -2 * n[0] + 0.3 * n[1], -2 * n[1] - 0.3 * n[0]);
            tahr_sweep off = tahr__lab_sweep(lab, n[0] * on, n[1] * on, n[0] + n[1], n[1] - n[0]);
            tahr_sweep inside = tahr__lab_sweep(lab, n[0] * in, n[1] * in, 0, 0);
            lab->number = n[0];
            tahr__lab_stops(lab, &q, 0.49 / 2, normal, "onto a plane whose normal has u");
            tahr__lab_free(lab, &off, "off a plane whose normal has u");
            tahr__lab_overlaps(lab, &inside, 0.03, normal, "in a plane whose normal has u");
        }
    }
}

static void sphere(tahr__lab *lab)
{
    against_planes(lab, TAHR_CAP_SPHERE);
}

static void capsule(tahr__lab *lab)
{
    against_planes(lab, TAHR_CAP_CAPSULE);
}

static void box(tahr__lab *lab)
{
    against_planes(lab, TAHR_CAP_BOX);
}

static void cylinder(tahr__lab *lab)
{
    against_planes(lab, TAHR_CAP_CYLINDER);
}

static void cone(tahr__lab *lab)
{
    against_planes(lab, TAHR_CAP_CONE);
}

static void ellipsoid(tahr__lab *lab)
{
    against_planes(lab, TAHR_CAP_ELLIPSOID);
}

static void hull(tahr__lab *lab)
{
    against_planes(lab, TAHR_CAP_HULL);
}

/* A box keeps the yaw of its orientation: a quarter turn swaps its half widths, an eighth shows its corner. */
static void box_turns(tahr__lab *lab)
{
    if (lab->planar) {
        tahr__lab_lacks(lab, "a third dimension");
        return;
    }
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR_CAP_BOX);) {
        const double half_sqrt2 = 0.70710678118654752440, eighth_sine = 0.38268343236508977173,
                     eighth_cosine = 0.92387953251128675613;
        tahr_quat quarter = {0, 0, half_sqrt2, half_sqrt2}, eighth = {0, 0, eighth_sine, eighth_cosine};
        double x = lab->shape.half_x, y = lab->shape.half_y;
        tahr__lab_block(lab, 4, -2, 6, 6);
        if (!tahr__lab_open(lab)) {
            return;
        }
        tahr_sweep q = tahr__lab_sweep(lab, 0, 1, 8, 0);
        tahr__lab_stops(lab, &q, (3.99 - x) / 8, vec(-1, 0, 0), "not turned");
        q.orientation = quarter;
        tahr__lab_stops(lab, &q, (3.99 - y) / 8, vec(-1, 0, 0), "turned by 90 degrees");
        q.orientation = eighth;
        tahr__lab_stops(lab, &q, (3.99 - (x + y) * half_sqrt2) / 8, vec(-1, 0, 0), "turned by 45 degrees");
    }
}

/* Another up: the same scene, lying on its side. */
static void lying_up(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        const vec3 up = tahr__lab_toward(lab, 1, 0);
        tahr__lab_plane(lab, 0, 1);
        if (!tahr__lab_open(lab)) {
            return;
        }
        double wide = lab->shape.radius > 0 ? lab->shape.radius : lab->shape.half_x;
        tahr_sweep q = tahr__lab_sweep(lab, 0, wide + 0.5, 0, -1);
        q.up = up; /* what was level, the lab's u, turns down */
        q.orientation = quat_multiply(quat_between(tahr__lab_up(lab), up), q.orientation);
        tahr__lab_stops(lab, &q, 0.49, tahr__lab_up(lab), "lying down");
    }
}

static const tahr__lab_case places[] = {
    {"far_origin_1e4", 0, far_1e4},   {"far_origin_1e6", 0, far_1e6},  {"tiny_scale_1e-2", 0, tiny},
    {"tiny_scale_1e-3", 0, tiny_1e3}, {"huge_scale_1e3", 0, huge_1e3},
};
const tahr__lab_theme tahr__lab_places = {places, sizeof places / sizeof places[0]};

static const tahr__lab_case shapes[] = {
    {"shape_sphere", TAHR_CAP_SPHERE, sphere},
    {"shape_capsule", TAHR_CAP_CAPSULE, capsule},
    {"shape_box", TAHR_CAP_BOX, box},
    {"shape_box_turned", TAHR_CAP_BOX, box_turns},
    {"shape_cylinder", TAHR_CAP_CYLINDER, cylinder},
    {"shape_cone", TAHR_CAP_CONE, cone},
    {"shape_ellipsoid", TAHR_CAP_ELLIPSOID, ellipsoid},
    {"shape_hull", TAHR_CAP_HULL, hull},
    {"shape_lying", 0, lying_up},
};
const tahr__lab_theme tahr__lab_shapes = {shapes, sizeof shapes / sizeof shapes[0]};
