/* SPDX-License-Identifier: MIT
 * selftest.c: the conformance kit: runs the cases and reports them. */
#include <stdlib.h>
#include <string.h>

#include "backend_check.h"
#include "message.h"
#include "selftest.h"
#include "sized.h"

static const tahr__lab_theme *const themes[] = {
    &tahr__lab_sweeps,  &tahr__lab_edges,  &tahr__lab_places, &tahr__lab_shapes,  &tahr__lab_bodies,
    &tahr__lab_answers, &tahr__lab_random, &tahr__lab_walks,  &tahr__lab_filters, &tahr__lab_one_way};
enum { THEMES = sizeof themes / sizeof themes[0] };

static int is_chosen(const tahr_selftest_desc *desc, const char *name)
{
    return !desc->only || strncmp(name, desc->only, strlen(desc->only)) == 0;
}

/* Returns 1 if it failed. */
static uint32_t run_case(tahr__lab *lab, const tahr__lab_case *c)
{
    lab->verdict = TAHR_SELFTEST_PASS;
    lab->checks = 0;
    lab->number = 0;
    lab->expected[0] = lab->actual[0] = lab->message[0] = 0;
    memset(&lab->shape, 0, sizeof lab->shape);
    lab->shape_name = "no shape";
    lab->material = 0;
    if (c->needs & ~lab->claims) {
        tahr__lab_lacks(lab, tahr__capability_name(c->needs & ~lab->claims));
    } else {
        tahr__lab_clear(lab);
        c->run(lab);
        tahr__lab_clear(lab);
    }
    tahr_selftest_result result = {
        .name = c->name, .verdict = lab->verdict, .expected = lab->expected, .actual = lab->actual};
    if (lab->desc->report) {
        lab->desc->report(lab->desc->user, &result);
    }
    return lab->verdict == TAHR_SELFTEST_FAIL;
}

static const char *bad_field(const tahr_selftest_desc *desc)
{
    const uint32_t known = (TAHR_CAP_SENSORS << 1) - 1;
    if (desc->capabilities & ~known) {
        return "desc.capabilities";
    }
    if (!(desc->gap_tolerance >= 0 && desc->gap_tolerance <= 0.1)) {
        return "desc.gap_tolerance";
    }
    return desc->angle_tolerance >= 0 && desc->angle_tolerance <= 0.5 ? NULL : "desc.angle_tolerance";
}

static uint32_t count_chosen(const tahr_selftest_desc *desc)
{
    uint32_t count = 0;
    for (size_t t = 0; t < THEMES; t++) {
        for (size_t i = 0; i < themes[t]->count; i++) {
            count += (uint32_t)is_chosen(desc, themes[t]->cases[i].name);
        }
    }
    return count;
}

static tahr_status check_arguments(const tahr_backend *backend, const tahr_selftest_desc *desc)
{
    static const char function[] = "tahr_backend_selftest";
    if (!desc) {
        return TAHR_E_NULL;
    }
    tahr_status status = tahr__sized_check(desc, sizeof *desc);
    if (status < 0) {
        return status;
    }
    if (!backend && !desc->open) {
        return tahr__complain(desc->log, TAHR_E_NULL, function, "backend", "is NULL, and so is desc.open");
    }
    status = backend ? tahr__backend_check(backend, desc->log, function, NULL) : TAHR_OK;
    if (status < 0) {
        return status;
    }
    if (backend && desc->open) {
        return tahr__complain(desc->log, TAHR_E_ARGUMENT, function, "backend",
                              "must be NULL: desc.open opens the worlds");
    }
    if (backend && desc->capabilities) {
        return tahr__complain(desc->log, TAHR_E_ARGUMENT, function, "desc.capabilities",
                              "must be 0: the backend has its own");
    }
    const char *bad = bad_field(desc);
    if (bad) {
        return tahr__complain(desc->log, TAHR_E_ARGUMENT, function, bad, "is out of range");
    }
    return count_chosen(desc) ? TAHR_OK
                              : tahr__complain(desc->log, TAHR_E_ARGUMENT, function, "desc.only",
                                               "is not how the name of any case begins");
}

tahr_status tahr_backend_selftest(const tahr_backend *backend, const tahr_selftest_desc *desc, uint32_t *failed)
{
    uint32_t failures = 0;
    tahr_status status = check_arguments(backend, desc);
    if (status < 0) {
        return status;
    }
    tahr__lab *lab = calloc(1, sizeof *lab);
    if (!lab) {
        return TAHR_E_MEMORY;
    }
    lab->backend = backend;
    lab->desc = desc;
    lab->claims = backend ? backend->capabilities : desc->capabilities;
    lab->planar = (lab->claims & TAHR_CAP_PLANAR) != 0;
    for (size_t t = 0; t < THEMES; t++) {
        for (size_t i = 0; i < themes[t]->count; i++) {
            if (is_chosen(desc, themes[t]->cases[i].name)) {
                failures += run_case(lab, &themes[t]->cases[i]);
            }
        }
    }
    free(lab);
    if (failed) {
        *failed = failures;
    }
    return TAHR_OK;
}
