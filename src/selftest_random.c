/* SPDX-License-Identifier: MIT
 * selftest_random.c: cases: many sweeps among blocks, against a distance in closed form. An upright sphere, capsule or
 * box and an upright block: across up and along it the gaps are independent, so their distance is a root of squares. */
#include "selftest.h"

enum { BLOCKS = 12, QUERIES = 300, SAMPLES = 24 };

typedef struct block {
    vec3 low, high;
} block;

/* The same numbers everywhere (splitmix64). */
static double next(uint64_t *state, double low, double high)
{
    uint64_t z = *state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return low + (high - low) * ((double)((z ^ (z >> 31)) >> 11) / 9007199254740992.0);
}

/* Gap between an interval of half width half around x, and [low, high]; negative where they overlap. */
static double gap(double x, double half, double low, double high)
{
    return max_of(low - (x + half), (x - half) - high);
}

/* Signed in the sense that anything negative is an overlap. */
static double distance(const tahr__lab *lab, vec3 at, const block *b)
{
    const tahr_shape *s = &lab->shape;
    double x = s->half_x, y = s->half_y, up = s->half_height - s->radius; /* of the core */
    double gx = gap(at.x, x, b->low.x, b->high.x), gy, gz;
    if (lab->planar) {
        gy = gap(at.y, up, b->low.y, b->high.y);
        gz = -1e9;
    } else {
        gy = gap(at.y, y, b->low.y, b->high.y);
        gz = gap(at.z, up, b->low.z, b->high.z);
    }
    if (gx <= 0 && gy <= 0 && gz <= 0) {
        return max_of(max_of(gx, gy), gz) - s->radius;
    }
    return length(vec(max_of(gx, 0), max_of(gy, 0), max_of(gz, 0))) - s->radius;
}

static double nearest(const tahr__lab *lab, vec3 at, const block *blocks)
{
    double least = 1e9;
    for (int i = 0; i < BLOCKS; i++) {
        least = min_of(least, distance(lab, at, &blocks[i]));
    }
    return least;
}

static int build(tahr__lab *lab, block *blocks, uint64_t *dice)
{
    for (int i = 0; i < BLOCKS; i++) {
        block *b = &blocks[i];
        for (int axis = 0; axis < 3; axis++) {
            double middle = next(dice, -4, 4), half = next(dice, 0.1, 1.2);
            double *low = axis == 0 ? &b->low.x : (axis == 1 ? &b->low.y : &b->low.z);
            double *high = axis == 0 ? &b->high.x : (axis == 1 ? &b->high.y : &b->high.z);
            *low = middle - half;
            *high = middle + half;
        }
        if (lab->planar) {
            tahr__lab_block(lab, b->low.x, b->low.y, b->high.x, b->high.y);
        } else {
            tahr__lab_block3(lab, b->low, b->high);
        }
    }
    return tahr__lab_open(lab);
}

/* One sweep: nowhere on its way nearer than the margin, stopped only at it. */
static void judge(tahr__lab *lab, const tahr_sweep *q, const block *blocks)
{
    tahr_hit hit;
    double slack = tahr__lab_slack(lab), least = 1e9;
    if (!tahr__lab_ask(lab, q, &hit)) {
        return;
    }
    for (int i = 0; i <= SAMPLES; i++) {
        least = min_of(least, nearest(lab, add_scaled(q->position, q->motion, hit.fraction * i / SAMPLES), blocks));
    }
    tahr__lab_check(lab, least >= q->margin - slack, "nowhere nearer than the margin of 0.01 m on the way",
                    "%s: %.9g m, in sweep %g", lab->shape_name, least, lab->number);
    if (hit.blocking && tahr__lab_check(lab, hit.body < BLOCKS, "one of 12 bodies", "body %u", hit.body)) {
        const block *met = &blocks[hit.body];
        const vec3 end = add_scaled(q->position, q->motion, hit.fraction);
        double there = distance(lab, end, met);
        tahr__lab_check(lab, fabs(there - q->margin) <= slack && dot(hit.normal, q->motion) < 0,
                        "stopped at the margin of 0.01 m from the body named, against the motion",
                        "%s: %.9g m, in sweep %g", lab->shape_name, there, lab->number);
        /* Along the contact normal the distance grows as fast as one goes. */
        double more = distance(lab, add_scaled(end, hit.normal, 0.01), met) - there;
        tahr__lab_check(lab, more >= 0.01 - 1e-4 - slack, "the normal leads away: 1 cm along it, 1 cm farther",
                        "%s: %.9g m farther, in sweep %g", lab->shape_name, more, lab->number);
    }
}

static void random_sweeps(tahr__lab *lab)
{
    block blocks[BLOCKS];
    uint64_t dice = 20260901;
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        if (!build(lab, blocks, &dice)) {
            return;
        }
        for (int i = 0; i < QUERIES && lab_goes_on(lab); i++) {
            vec3 from = vec(next(&dice, -6, 6), next(&dice, -6, 6), next(&dice, -6, 6));
            vec3 to = vec(next(&dice, -6, 6), next(&dice, -6, 6), next(&dice, -6, 6));
            from.z = lab->planar ? 0 : from.z;
            to.z = lab->planar ? 0 : to.z;
            tahr_sweep q = tahr__lab_sweep(lab, 0, 0, 0, 0);
            q.position = from;
            q.motion = sub(to, from);
            lab->number = i;
            if (nearest(lab, from, blocks) > q.margin + 1e-6) {
                judge(lab, &q, blocks);
            }
        }
    }
}

/* Contacts say how near the nearest is, and name it; what they report is all there. */
static void random_contacts(tahr__lab *lab)
{
    block blocks[BLOCKS];
    uint64_t dice = 20260902;
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        if (!build(lab, blocks, &dice)) {
            return;
        }
        for (int i = 0; i < QUERIES && lab_goes_on(lab); i++) {
            tahr_contact c[16];
            tahr_status status;
            tahr_sweep q = tahr__lab_sweep(lab, 0, 0, 0, 0);
            q.position = vec(next(&dice, -5, 5), next(&dice, -5, 5), lab->planar ? 0 : next(&dice, -5, 5));
            double truth = nearest(lab, q.position, blocks);
            if (truth <= 1e-6 || fabs(truth - 0.3) <= 2 * tahr__lab_slack(lab)) {
                continue;
            }
            uint32_t n = tahr__lab_touch(lab, &q, 0.3, 0, c, 16, &status);
            int good = truth > 0.3
                           ? n == 0
                           : n > 0 && fabs(c[0].distance - truth) <= tahr__lab_slack(lab) && c[0].body < BLOCKS &&
                                 fabs(distance(lab, q.position, &blocks[c[0].body]) - truth) <= tahr__lab_slack(lab);
            tahr__lab_check(lab, good, "contacts within 0.3 m: the nearest block at its distance, or none",
                            "%s: %u contacts, %.9g instead of %.9g, at place %d", lab->shape_name, n,
                            n ? c[0].distance : 0, truth, i);
            for (uint32_t k = 1; k < n; k++) {
                tahr__lab_check(lab, c[k - 1].distance <= c[k].distance, "contacts by distance", "%s: %.9g before %.9g",
                                lab->shape_name, c[k - 1].distance, c[k].distance);
            }
        }
    }
}

static const tahr__lab_case cases[] = {
    {"random_sweeps_among_blocks", 0, random_sweeps},
    {"random_contacts_among_blocks", TAHR_CAP_CONTACTS, random_contacts},
};

const tahr__lab_theme tahr__lab_random = {cases, sizeof cases / sizeof cases[0]};
