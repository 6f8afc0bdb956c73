/* SPDX-License-Identifier: MIT
 * selftest_filter.c: cases: who is there: masks, the body to ignore, sensors; bodies that are placed anew. */
#include <string.h>

#include "selftest.h"

static double low_of(const tahr__lab *lab)
{
    return tahr__lab_reach(lab, tahr__lab_toward(lab, 0, -1));
}

static void expect_body(tahr__lab *lab, const tahr_sweep *q, uint32_t body, const char *expected)
{
    tahr_hit hit;
    if (tahr__lab_ask(lab, q, &hit)) {
        uint32_t met = hit.blocking ? hit.body : TAHR_NO_BODY;
        tahr__lab_check(lab, met == body, expected, "%s: body %u at fraction %.9g", lab->shape_name, met, hit.fraction);
    }
}

/* Three floors, one below the other, of masks 1, 2 and 4. */
static int floors(tahr__lab *lab)
{
    for (int i = 0; i < 3; i++) {
        tahr__lab_block(lab, -4, -2 * i - 1, 4, -2 * i)->mask = 1u << i;
    }
    return tahr__lab_open(lab);
}

static void mask(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        tahr_contact c[4];
        tahr_status status;
        if (!floors(lab)) {
            return;
        }
        tahr_sweep q = tahr__lab_sweep(lab, 0, low_of(lab) + 1, 0, -8), on = q;
        expect_body(lab, &q, 0, "all bits: the first floor, body 0");
        q.mask = 6;
        expect_body(lab, &q, 1, "mask 6: the floor of mask 2, body 1");
        q.mask = 4;
        expect_body(lab, &q, 2, "mask 4: the floor of mask 4, body 2");
        q.mask = 8;
        expect_body(lab, &q, TAHR_NO_BODY, "mask 8: nothing");
        on.position = tahr__lab_at(lab, 0, low_of(lab) + 0.005);
        on.mask = 6;
        if (lab->claims & TAHR_CAP_CONTACTS) {
            uint32_t n = tahr__lab_touch(lab, &on, 0.01, 0, c, 4, &status);
            tahr__lab_check(lab, n == 0, "contacts, mask 6 on the floor of mask 1: none", "%u", n);
        }
    }
}

static void ray_mask(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        if (!floors(lab)) {
            return;
        }
        for (uint32_t i = 0; i < 4; i++) {
            tahr_hit hit;
            uint32_t count = 0;
            tahr_ray q = {tahr__lab_at(lab, 0, 1), tahr__lab_along(lab, 0, -8), 7u & ~((1u << i) - 1), TAHR_NO_BODY};
            memset(&hit, 0, sizeof hit);
            tahr_status status = tahr_world_ray(lab->world, &q, &hit, &count);
            tahr__lab_check(lab, status >= 0 && (i < 3 ? count == 1 && hit.body == i : count == 0),
                            "a ray meets the first floor of its mask", "mask %u: %u hits, body %u", q.mask, count,
                            hit.body);
            q.mask = 7;
            q.ignore_body = 0;
            status = tahr_world_ray(lab->world, &q, &hit, &count);
            tahr__lab_check(lab, status >= 0 && count == 1 && hit.body == 1, "a ray that ignores body 0: body 1",
                            "%u hits, body %u", count, hit.body);
        }
    }
}

static void ignore_body(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        tahr_contact c[4];
        tahr_status status;
        if (!floors(lab)) {
            return;
        }
        tahr_sweep q = tahr__lab_sweep(lab, 0, low_of(lab) + 1, 0, -8), on = q;
        q.ignore_body = 0;
        expect_body(lab, &q, 1, "ignoring body 0: body 1");
        q.ignore_body = 1;
        expect_body(lab, &q, 0, "ignoring body 1: body 0");
        q.ignore_body = 12345;
        expect_body(lab, &q, 0, "ignoring a body that there is not: body 0");
        on.position = tahr__lab_at(lab, 0, low_of(lab) + 0.005);
        on.ignore_body = 0;
        if (lab->claims & TAHR_CAP_CONTACTS) {
            uint32_t n = tahr__lab_touch(lab, &on, 0.01, 0, c, 4, &status);
            tahr__lab_check(lab, n == 0, "contacts that ignore the floor: none", "%u", n);
        }
    }
}

static void only_body(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        for (int i = 0; i < 3; i++) {
            tahr__lab_block(lab, -4, -2 * i - 1, 4, -2 * i)->flags = TAHR_BODY_MOVABLE;
        }
        if (!tahr__lab_open(lab)) {
            return;
        }
        tahr_sweep q = tahr__lab_sweep(lab, 0, low_of(lab) + 1, 0, -8);
        q.flags = TAHR_SWEEP_ONLY_BODY;
        q.ignore_body = 2;
        expect_body(lab, &q, 2, "ONLY_BODY 2: body 2, through the others");
        q.ignore_body = 0;
        expect_body(lab, &q, 0, "ONLY_BODY 0: body 0");
    }
}

/* Sensors of 0.2 m at heights 3, 2 and 1 (bodies 2, 1, 0), a floor (body 3), a sensor below it (body 4). */
static int tower(tahr__lab *lab)
{
    for (int i = 0; i < 3; i++) {
        tahr__lab_block(lab, -4, i + 1, 4, i + 1.2)->flags = TAHR_BODY_SENSOR;
    }
    tahr__lab_block(lab, -4, -1, 4, 0);
    tahr__lab_block(lab, -4, -3, 4, -2)->flags = TAHR_BODY_SENSOR;
    return tahr__lab_open(lab);
}

static void sensors_let_pass(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        if (!tower(lab)) {
            return;
        }
        tahr_hit hit;
        tahr_sweep q = tahr__lab_sweep(lab, 0, low_of(lab) + 4, 0, -8);
        expect_body(lab, &q, 3, "room for one: the floor behind the sensors, body 3");
        tahr__lab_stops(lab, &q, 3.99 / 8, tahr__lab_up(lab), "behind sensors");
        if (lab->claims & TAHR_CAP_RAY) {
            int met = tahr__lab_ray(lab, tahr__lab_at(lab, 0, 4), tahr__lab_along(lab, 0, -8), &hit);
            tahr__lab_check(lab, met && hit.body == 3, "a ray passes sensors: the floor, body 3", "met %d, body %u",
                            met, hit.body);
        }
    }
}

static void sensors_in_order(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        tahr_hit h[8];
        tahr_status status;
        if (!tower(lab)) {
            return;
        }
        tahr_sweep q = tahr__lab_sweep(lab, 0, low_of(lab) + 4, 0, -8);
        uint32_t n = tahr__lab_ask_all(lab, &q, h, 8, &status);
        int good = n == 4 && status == TAHR_OK;
        for (uint32_t i = 0; good && i < 4; i++) { /* 2, 1, 0, then the floor; not the one below */
            double top = i < 3 ? 3.2 - i : 0;
            good = h[i].body == (i < 3 ? 2 - i : 3) && h[i].sensor == (i < 3) && h[i].blocking == (i == 3) &&
                   fabs(h[i].fraction - (4 - top - 0.01) / 8) * 8 <= 2 * tahr__lab_slack(lab);
        }
        tahr__lab_check(lab, good, "sensors 2, 1, 0 where they are met, then floor 3, and nothing behind it",
                        "%s: %u answers, bodies %u %u %u %u, the first at %.9g", lab->shape_name, n, h[0].body,
                        h[1].body, h[2].body, h[3].body, h[0].fraction);
        n = tahr__lab_ask_all(lab, &q, h, 2, &status);
        tahr__lab_check(lab, n == 2 && status == TAHR_TRUNCATED && h[0].body == 2 && h[1].body == 3 && h[1].blocking,
                        "room for two: the first sensor and the floor, TAHR_TRUNCATED",
                        "%s: %u answers, bodies %u %u, %s", lab->shape_name, n, h[0].body, h[1].body,
                        tahr_status_name(status));
    }
}

static void only_sensors(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        tahr_hit h[8];
        tahr_status status;
        if (!tower(lab)) {
            return;
        }
        tahr_sweep q = tahr__lab_sweep(lab, 0, low_of(lab) + 4, 0, -8);
        q.flags = TAHR_SWEEP_SENSORS;
        uint32_t n = tahr__lab_ask_all(lab, &q, h, 8, &status);
        int good = n == 4;
        for (uint32_t i = 0; i < n; i++) {
            good = good && h[i].sensor && !h[i].blocking;
        }
        tahr__lab_check(lab, good && h[3].body == 4, "SENSORS: 2, 1, 0 and 4, through the floor; nothing blocks",
                        "%s: %u answers, the last body %u", lab->shape_name, n, n ? h[n - 1].body : TAHR_NO_BODY);
        tahr_sweep still = tahr__lab_sweep(lab, 0, 1.1, 0, 0);
        still.flags = TAHR_SWEEP_SENSORS;
        still.margin = 0;
        if (lab->material == TAHR__OF_BOXES) { /* others are met at their surface: inside of one is inside of nothing */
            n = tahr__lab_ask_all(lab, &still, h, 8, &status);
            int inside = 0;
            for (uint32_t i = 0; i < n; i++) {
                inside |= h[i].body == 0 && h[i].start_overlap && h[i].fraction == 0;
            }
            tahr__lab_check(lab, inside, "SENSORS without a motion: what it is inside of, body 0, overlapping",
                            "%s: %u answers", lab->shape_name, n);
        }
    }
}

static void sensor_contacts(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        tahr_contact c[4];
        tahr_status status;
        if (!tower(lab)) {
            return;
        }
        tahr_sweep on = tahr__lab_sweep(lab, 0, low_of(lab) + 3.205, 0, 0);
        uint32_t all = tahr__lab_touch(lab, &on, 0.01, 0, c, 4, &status);
        int marked = all >= 1;
        for (uint32_t i = 0; i < all; i++) {
            marked = marked && c[i].sensor == 1 && c[i].body == 2;
        }
        uint32_t solid = tahr__lab_touch(lab, &on, 0.01, TAHR_CONTACTS_SOLID, c, 4, &status);
        tahr__lab_check(lab, marked && solid == 0, "contacts on a sensor: it, marked as one; with SOLID none",
                        "%s: %u (marked: %d) and %u", lab->shape_name, all, marked, solid);
    }
}

/* What is at -2 is met there by rays and contacts too, and nothing is left where it was. */
static void placed_is_felt(tahr__lab *lab)
{
    tahr_hit hit;
    tahr_contact c[4];
    tahr_status status;
    if (lab->claims & TAHR_CAP_RAY) {
        int met = tahr__lab_ray(lab, tahr__lab_at(lab, 0, 1), tahr__lab_along(lab, 0, -4), &hit);
        tahr__lab_check(lab, met && fabs(hit.fraction - 0.75) * 4 <= tahr__lab_slack(lab),
                        "a ray onto it 2 m lower: fraction 0.75", "met %d, fraction %.9g", met, hit.fraction);
    }
    if (lab->claims & TAHR_CAP_CONTACTS) {
        tahr_sweep here = tahr__lab_sweep(lab, 0, low_of(lab) + 0.005, 0, 0),
                   there = tahr__lab_sweep(lab, 0, low_of(lab) - 1.995, 0, 0);
        uint32_t none = tahr__lab_touch(lab, &here, 0.01, 0, c, 4, &status);
        uint32_t some = tahr__lab_touch(lab, &there, 0.01, 0, c, 4, &status);
        tahr__lab_check(lab, none == 0 && some >= 1, "contacts: none where it was, some where it is", "%s: %u and %u",
                        lab->shape_name, none, some);
    }
}

/* A floor that is lowered and put back. */
static void placed(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        tahr_hit first, back;
        tahr_body_desc *body = tahr__lab_block(lab, -4, -1, 4, 0);
        body->flags = TAHR_BODY_MOVABLE;
        tahr_body_pose home = {0, 0, body->pose}, lower = home, turned = home;
        tahr_body_desc *other = tahr__lab_block(lab, 20, -1, 24, 0);
        other->flags = TAHR_BODY_MOVABLE;
        tahr_body_pose both[2] = {home, {1, 0, other->pose}};
        if (!tahr__lab_open(lab)) {
            return;
        }
        both[1].pose.position = sub(both[1].pose.position, tahr__lab_along(lab, 0, 3));
        tahr_sweep beside = tahr__lab_sweep(lab, 22, low_of(lab) + 1, 0, -8);
        lower.pose.position = sub(home.pose.position, tahr__lab_along(lab, 0, 2));
        turned.pose.orientation = lab->planar ? (tahr_quat){0, 0, 0.70710678118654752440, 0.70710678118654752440}
                                              : (tahr_quat){0, 0.70710678118654752440, 0, 0.70710678118654752440};
        tahr_sweep q = tahr__lab_sweep(lab, 0, low_of(lab) + 1, 0, -8);
        tahr_sweep off = tahr__lab_sweep(lab, 1.5, low_of(lab) + 5, 0, -8);
        if (!tahr__lab_ask(lab, &q, &first)) {
            return;
        }
        if (tahr_world_set(lab->world, &lower, 1) == TAHR_E_UNSUPPORTED) {
            lab->checks = 0;
            tahr__lab_lacks(lab, "the slot place");
            return;
        }
        tahr__lab_stops(lab, &q, 2.99 / 8, tahr__lab_up(lab), "onto a floor that was placed 2 m lower");
        placed_is_felt(lab);
        tahr_world_set(lab->world, &turned, 1);
        /* A quarter turn about its own origin: what was 8 m wide and 1 m thick is upright. */
        double top = lab->material == TAHR__OF_BOXES ? -0.5 + 4 : 4;
        lab->number = top;
        if (lab->material == TAHR__OF_BOXES) {
            tahr_sweep on = tahr__lab_sweep(lab, 0, top + low_of(lab) + 1, 0, -8);
            tahr__lab_stops(lab, &on, 0.99 / 8, tahr__lab_up(lab), "onto it turned upright, as high as");
            tahr__lab_free(lab, &off, "beside it turned upright, as high as");
        }
        tahr_world_set(lab->world, both, 2);
        tahr__lab_stops(lab, &beside, 3.99 / 8, tahr__lab_up(lab), "onto the second of two floors placed at once");
        if (!tahr__lab_ask(lab, &q, &back)) {
            return;
        }
        tahr__lab_check(lab, memcmp(&first, &back, sizeof back) == 0, "put back: the same bits as before",
                        "%s: fraction %.17g instead of %.17g", lab->shape_name, back.fraction, first.fraction);
    }
}

/* Surfaces hand back what the user wrote on them. */
static void surface_data(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        tahr_hit hit;
        tahr_body_desc *body = tahr__lab_block(lab, -4, -1, 4, 0);
        body->surface = 77;
        body->walkable_rule = TAHR_WALKABLE_DECREASE;
        body->walkable_angle = 0.25;
        if (!tahr__lab_open(lab)) {
            return;
        }
        tahr_sweep q = tahr__lab_sweep(lab, 0, low_of(lab) + 1, 0, -8);
        if (tahr__lab_ask(lab, &q, &hit)) {
            tahr__lab_check(
                lab, hit.surface == 77 && hit.walkable_rule == TAHR_WALKABLE_DECREASE && hit.walkable_angle == 0.25,
                "surface 77, walkable rule DECREASE, angle 0.25", "%u, rule %u, angle %.9g", hit.surface,
                hit.walkable_rule, hit.walkable_angle);
        }
    }
}

static const tahr__lab_case cases[] = {
    {"mask", 0, mask},
    {"mask_of_rays", TAHR_CAP_RAY, ray_mask},
    {"ignore_body", 0, ignore_body},
    {"only_body", 0, only_body},
    {"surface_data", 0, surface_data},
    {"sensors_let_pass", TAHR_CAP_SENSORS, sensors_let_pass},
    {"sensors_in_order_and_truncated", TAHR_CAP_SENSORS, sensors_in_order},
    {"sensors_only", TAHR_CAP_SENSORS, only_sensors},
    {"sensors_in_contacts", TAHR_CAP_SENSORS | TAHR_CAP_CONTACTS, sensor_contacts},
    {"placed_body", 0, placed},
};

const tahr__lab_theme tahr__lab_filters = {cases, sizeof cases / sizeof cases[0]};
