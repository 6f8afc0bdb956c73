/* SPDX-License-Identifier: MIT
 * selftest_ask.c: the questions and claims of the conformance kit. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "answer.h"
#include "selftest.h"

static const char *const materials[TAHR__MATERIALS] = {"boxes", "a mesh", "a chain"};

/* Notes the first failure, or else the last success. */
static int note(tahr__lab *lab, int good, const char *expected, const char *actual)
{
    if (lab->verdict == TAHR_SELFTEST_FAIL) {
        return good;
    }
    lab->verdict = good ? TAHR_SELFTEST_PASS : TAHR_SELFTEST_FAIL;
    lab->checks++;
    snprintf(lab->expected, sizeof lab->expected, "%s", expected);
    snprintf(lab->actual, sizeof lab->actual, "%s", actual);
    return good;
}

int tahr__lab_check(tahr__lab *lab, int good, const char *expected, const char *format, ...)
{
    char actual[sizeof lab->actual];
    va_list list;
    va_start(list, format);
    vsnprintf(actual, sizeof actual, format, list);
    va_end(list);
    return note(lab, good, expected, actual);
}

void tahr__lab_lacks(tahr__lab *lab, const char *what)
{
    if (lab->checks == 0 && lab_goes_on(lab)) {
        lab->verdict = TAHR_SELFTEST_NOT_SUPPORTED;
        snprintf(lab->expected, sizeof lab->expected, "%s", "a capability that is claimed");
        snprintf(lab->actual, sizeof lab->actual, "%s", what);
    }
}

int tahr__lab_same_direction(const tahr__lab *lab, vec3 a, vec3 b)
{
    double angle = lab->desc->angle_tolerance > 0 ? lab->desc->angle_tolerance : 0.03490658503988659; /* 2 degrees */
    double chord = length(sub(a, b)); /* of two unit vectors, 2 sin(angle / 2): a little less than the angle */
    return chord <= angle;
}

tahr_sweep tahr__lab_sweep(const tahr__lab *lab, double u, double v, double mu, double mv)
{
    tahr_sweep q = {.shape = lab->shape,
                    .position = tahr__lab_at(lab, u, v),
                    .up = tahr__lab_up(lab),
                    .orientation = tahr__lab_upright(lab),
                    .motion = tahr__lab_along(lab, mu, mv),
                    .margin = lab->margin,
                    .mask = 0xFFFFFFFFu,
                    .ignore_body = TAHR_NO_BODY};
    return q;
}

uint32_t tahr__lab_ask_all(tahr__lab *lab, const tahr_sweep *query, tahr_hit *hits, uint32_t capacity,
                           tahr_status *status)
{
    uint32_t count = 0;
    lab->message[0] = 0;
    memset(hits, 0, capacity * sizeof hits[0]);
    *status = answer_sweep(lab->world, &lab->context, query, hits, capacity, &count);
    if (*status < 0) {
        tahr__lab_check(lab, 0, "a valid answer", "%s: %s", tahr_status_name(*status), lab->message);
        return 0;
    }
    return count;
}

int tahr__lab_ask(tahr__lab *lab, const tahr_sweep *query, tahr_hit *hit)
{
    tahr_status status;
    uint32_t count = tahr__lab_ask_all(lab, query, hit, 1, &status);
    if (count == 0) {
        memset(hit, 0, sizeof *hit);
        hit->fraction = 1;
        hit->body = TAHR_NO_BODY;
    }
    return status >= 0;
}

uint32_t tahr__lab_touch(tahr__lab *lab, const tahr_sweep *at, double margin, uint32_t flags, tahr_contact *contacts,
                         uint32_t capacity, tahr_status *status)
{
    uint32_t count = 0;
    tahr_contact_query query = {.shape = at->shape,
                                .position = at->position,
                                .up = at->up,
                                .orientation = at->orientation,
                                .margin = margin,
                                .mask = at->mask,
                                .ignore_body = at->ignore_body,
                                .flags = flags};
    lab->message[0] = 0;
    *status = tahr__answer_contacts(lab->world, &lab->context, &query, contacts, capacity, &count);
    if (*status < 0) {
        tahr__lab_check(lab, 0, "a valid answer", "%s: %s", tahr_status_name(*status), lab->message);
        return 0;
    }
    return count;
}

int tahr__lab_ray(tahr__lab *lab, vec3 from, vec3 motion, tahr_hit *hit)
{
    uint32_t count = 0;
    tahr_ray query = {.origin = from, .motion = motion, .mask = 0xFFFFFFFFu, .ignore_body = TAHR_NO_BODY};
    lab->message[0] = 0;
    memset(hit, 0, sizeof *hit);
    tahr_status status = tahr__answer_ray(lab->world, &lab->context, &query, hit, &count);
    if (!tahr__lab_check(lab, status >= 0, "a valid answer", "%s: %s", tahr_status_name(status), lab->message)) {
        return 0;
    }
    hit->blocking = hit->blocking && count == 1;
    return hit->blocking != 0;
}

/* "capsule on boxes, 1 degree (0.01): free" */
static void situation(const tahr__lab *lab, const char *what, const char *claim, char *text, size_t size)
{
    snprintf(text, size, "%s, %s, %s (%.9g): %s", lab->shape_name, materials[lab->material], what, lab->number, claim);
}

static void describe(const tahr_hit *h, char *text, size_t size)
{
    if (h->unknown) {
        snprintf(text, size, "unknown at fraction %.9g", h->fraction);
    } else if (h->start_overlap) {
        snprintf(text, size, "start overlap, depth %.9g m, normal (%.4f, %.4f, %.4f), fraction %.3g", h->depth,
                 h->normal.x, h->normal.y, h->normal.z, h->fraction);
    } else if (h->blocking || h->sensor) {
        snprintf(text, size, "%s at fraction %.9g, normal (%.4f, %.4f, %.4f), body %u",
                 h->sensor ? "sensor" : "blocked", h->fraction, h->normal.x, h->normal.y, h->normal.z, h->body);
    } else {
        snprintf(text, size, "free");
    }
}

void tahr__lab_free(tahr__lab *lab, const tahr_sweep *query, const char *what)
{
    tahr_hit hit;
    char expected[sizeof lab->expected], actual[sizeof lab->actual];
    if (!tahr__lab_ask(lab, query, &hit)) {
        return;
    }
    situation(lab, what, "free", expected, sizeof expected);
    describe(&hit, actual, sizeof actual);
    note(lab, !hit.blocking && !hit.start_overlap && !hit.unknown, expected, actual);
}

/* A hit is judged by the distance it is off along its normal: at a graze the fraction may be off by much more, and does
 * no harm. */
void tahr__lab_stops(tahr__lab *lab, const tahr_sweep *query, double fraction, vec3 normal, const char *what)
{
    tahr_hit hit;
    char claim[128], expected[sizeof lab->expected], actual[sizeof lab->actual];
    if (!tahr__lab_ask(lab, query, &hit)) {
        return;
    }
    double off = (hit.fraction - fraction) * -dot(query->motion, normal);
    /* Numbers of 1e6 m have an ulp of 1e-10 m, and the fraction is one of a motion of 1e2 sizes at most. */
    int good = hit.blocking && !hit.start_overlap && !hit.unknown && fabs(off) <= tahr__lab_slack(lab) &&
               tahr__lab_same_direction(lab, hit.normal, normal) && dot(hit.normal, query->motion) < 0;
    snprintf(claim, sizeof claim, "blocked at fraction %.9g, normal (%.4f, %.4f, %.4f)", fraction, normal.x, normal.y,
             normal.z);
    situation(lab, what, claim, expected, sizeof expected);
    describe(&hit, actual, sizeof actual);
    note(lab, good, expected, actual);
}

void tahr__lab_overlaps(tahr__lab *lab, const tahr_sweep *query, double depth, vec3 normal, const char *what)
{
    tahr_hit hit;
    char claim[128], expected[sizeof lab->expected], actual[sizeof lab->actual];
    if (!tahr__lab_ask(lab, query, &hit)) {
        return;
    }
    int good = hit.start_overlap && hit.fraction == 0 && fabs(hit.depth - depth) <= tahr__lab_slack(lab) &&
               tahr__lab_same_direction(lab, hit.normal, normal) &&
               fabs(hit.distance + hit.depth) <= tahr__lab_slack(lab);
    snprintf(claim, sizeof claim, "start overlap, depth %.9g m, normal (%.4f, %.4f, %.4f)", depth, normal.x, normal.y,
             normal.z);
    situation(lab, what, claim, expected, sizeof expected);
    describe(&hit, actual, sizeof actual);
    note(lab, good, expected, actual);
}
