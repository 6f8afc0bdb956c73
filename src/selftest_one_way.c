/* SPDX-License-Identifier: MIT
 * selftest_one_way.c: cases: bodies that are there only for who comes from above. */
#include "selftest.h"

static double low_of(const tahr__lab *lab)
{
    return tahr__lab_reach(lab, tahr__lab_toward(lab, 0, -1));
}

static int platform(tahr__lab *lab)
{
    tahr__lab_block(lab, -3, -0.2, 3, 0)->flags = TAHR_BODY_ONE_WAY;
    tahr__lab_block(lab, -6, -4, 6, -3);
    return tahr__lab_open(lab);
}

static void from_above(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        if (!platform(lab)) {
            return;
        }
        tahr_sweep down = tahr__lab_sweep(lab, 0, low_of(lab) + 1, 0.3, -4),
                   on = tahr__lab_sweep(lab, 0, low_of(lab) + 0.01, 1, 0);
        tahr_sweep rest = tahr__lab_sweep(lab, 0, low_of(lab) + 0.005, 0, -1);
        tahr__lab_stops(lab, &down, 0.99 / 4, tahr__lab_up(lab), "onto a one-way body");
        tahr__lab_stops(lab, &rest, 0, tahr__lab_up(lab), "down, standing on a one-way body");
        tahr__lab_free(lab, &on, "along a one-way body");
        down.flags = TAHR_SWEEP_PASS;
        tahr__lab_stops(lab, &down, 3.99 / 4, tahr__lab_up(lab), "PASS: through a one-way body, onto the floor below");
    }
}

static void from_below(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        double high = tahr__lab_reach(lab, tahr__lab_up(lab));
        if (!platform(lab)) {
            return;
        }
        tahr_sweep up = tahr__lab_sweep(lab, 0, -0.2 - high - 0.5, 0, 4),
                   near = tahr__lab_sweep(lab, 0, -0.2 - high - 0.005, 0, 1);
        tahr__lab_free(lab, &up, "up through a one-way body");
        tahr__lab_free(lab, &near, "up from just below a one-way body");
        up.flags = TAHR_SWEEP_WHOLE;
        tahr__lab_stops(lab, &up, 0.49 / 4, tahr__lab_toward(lab, 0, -1), "WHOLE: up at a one-way body");
    }
}

static void from_the_side(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        if (!platform(lab)) {
            return;
        }
        tahr_sweep side = tahr__lab_sweep(lab, -5, -0.1, 8, 0);
        tahr__lab_free(lab, &side, "through the side of a one-way body");
    }
}

/* Who overlaps it is inside of nothing, whatever the motion; the floor below is still there. */
static void from_inside(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        tahr_contact c[4];
        tahr_status status;
        if (!platform(lab)) {
            return;
        }
        tahr_sweep still = tahr__lab_sweep(lab, 0, low_of(lab) - 0.05, 0, 0),
                   down = tahr__lab_sweep(lab, 0, low_of(lab) - 0.05, 0, -4);
        tahr__lab_free(lab, &still, "no motion inside a one-way body");
        tahr__lab_stops(lab, &down, 2.94 / 4, tahr__lab_up(lab), "down out of a one-way body, onto the floor below");
        if (lab->claims & TAHR_CAP_CONTACTS) {
            uint32_t n = tahr__lab_touch(lab, &still, 0.01, 0, c, 4, &status);
            tahr__lab_check(lab, n == 0, "contacts inside a one-way body: none", "%s: %u", lab->shape_name, n);
        }
    }
}

static void dropping(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        tahr_contact c[4];
        tahr_status status;
        if (!platform(lab)) {
            return;
        }
        tahr_sweep near = tahr__lab_sweep(lab, 0, low_of(lab) + 0.012, 0, -2),
                   high = tahr__lab_sweep(lab, 0, low_of(lab) + 0.5, 0, -2);
        near.flags = high.flags = TAHR_SWEEP_DROP;
        tahr__lab_free(lab, &near, "DROP from within two margins of a one-way body");
        tahr__lab_stops(lab, &high, 0.49 / 2, tahr__lab_up(lab), "DROP from higher above");
        if (lab->claims & TAHR_CAP_CONTACTS) {
            uint32_t n = tahr__lab_touch(lab, &near, 0.02, 0, c, 4, &status);
            uint32_t none = tahr__lab_touch(lab, &near, 0.02, TAHR_CONTACTS_DROP, c, 4, &status);
            tahr__lab_check(lab, n >= 1 && none == 0, "contacts on a one-way body: some, with DROP none",
                            "%s: %u and %u", lab->shape_name, n, none);
        }
    }
}

/* A ray knows no up: what it meets within 60 degrees of the normal is there. */
static void rays(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        tahr_hit hit;
        if (!platform(lab)) {
            return;
        }
        int down = tahr__lab_ray(lab, tahr__lab_at(lab, 0, 1), tahr__lab_along(lab, 1, -2), &hit);
        int flat = tahr__lab_ray(lab, tahr__lab_at(lab, -2, 0.5), tahr__lab_along(lab, 4, -1), &hit);
        tahr__lab_check(lab, down && !flat, "rays at a one-way body: met at 27 degrees from its normal, not at 76",
                        "%d and %d", down, flat);
    }
}

static const tahr__lab_case cases[] = {
    {"one_way_from_above", TAHR_CAP_ONE_WAY, from_above},
    {"one_way_from_below", TAHR_CAP_ONE_WAY, from_below},
    {"one_way_from_the_side", TAHR_CAP_ONE_WAY, from_the_side},
    {"one_way_from_inside", TAHR_CAP_ONE_WAY, from_inside},
    {"one_way_drop", TAHR_CAP_ONE_WAY, dropping},
    {"one_way_rays", TAHR_CAP_ONE_WAY | TAHR_CAP_RAY, rays},
};

const tahr__lab_theme tahr__lab_one_way = {cases, sizeof cases / sizeof cases[0]};
