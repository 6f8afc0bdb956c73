/* SPDX-License-Identifier: MIT
 * subject.c: the table of backends and of their settings that answers may depend on or that cost something. */
#include "subject.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "row.h"

#ifdef TAHR_HAVE_CCD
#include <tahr/ccd.h>
#endif
#ifdef TAHR_HAVE_FCL
#include <tahr/fcl.h>
#endif

enum { MAX_SUBJECTS = 64 };

static chart_subject subjects[MAX_SUBJECTS];
static uint32_t subject_count;

static chart_subject *add(const char *curve, const char *setting, const char *role, const tahr_backend *(*get)(void))
{
    chart_subject *s = &subjects[subject_count++];
    *s = (chart_subject){.curve = curve, .setting = setting, .role = role, .value = NAN, .get = get};
    return s;
}

static void set_options(chart_subject *s, const void *options, size_t size)
{
    if (size > sizeof s->options) abort();
    memcpy(&s->options, options, size);
}

static void add_native(void)
{
    static const struct {
        const char *setting, *role;
        uint32_t no_simd, no_cache;
    } table[] = {
        {"native", CHART_DEFAULT, 0, 0}, {"native; no_simd", CHART_OFF, 1, 0}, {"native; no_cache", CHART_OFF, 0, 1}};
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        tahr_native_desc desc = {
            .struct_size = sizeof desc, .no_simd = table[i].no_simd, .no_cache = table[i].no_cache};
        set_options(add("native", table[i].setting, table[i].role, tahr_backend_v1_native), &desc, sizeof desc);
    }
}

#ifdef TAHR_HAVE_CCD
/* All that libccd itself can do: by default it is not asked. */
static void add_ccd_bisection(const char *curve, const char *const settings[], uint32_t boolean)
{
    static const uint32_t iterations[] = {2, 8, 100};
    for (uint32_t i = 0; i < 3; i++) {
        tahr_ccd_desc desc = {.struct_size = sizeof desc,
                              .sweep = TAHR_CCD_SWEEP_BISECTION,
                              .boolean = boolean,
                              .max_iterations = iterations[i]};
        chart_subject *s = add(curve, settings[i], CHART_ONLY, tahr_backend_v1_ccd);
        set_options(s, &desc, sizeof desc);
        s->value = iterations[i];
        s->slow = 1;
    }
}

static void add_ccd(void)
{
    static const char *const gjk[] = {"ccd GJK; 2 iterations", "ccd GJK; 8 iterations", "ccd GJK; 100 iterations"};
    static const char *const mpr[] = {"ccd MPR; 2 iterations", "ccd MPR; 8 iterations", "ccd MPR; 100 iterations"};
    add("ccd advance", "ccd advance", CHART_DEFAULT, tahr_backend_v1_ccd)->slow = 1;
    add_ccd_bisection("ccd GJK", gjk, TAHR_CCD_BOOLEAN_GJK);
    add_ccd_bisection("ccd MPR", mpr, TAHR_CCD_BOOLEAN_MPR);
}
#endif

#ifdef TAHR_HAVE_FCL
static void add_fcl(void)
{
    static const struct {
        const char *curve, *setting, *role;
        uint32_t volumes, search;
    } table[] = {{"fcl descend", "fcl AABB; descend", CHART_DEFAULT, TAHR_FCL_AABB, TAHR_FCL_DESCEND},
                 {"fcl descend", "fcl OBBRSS; descend", CHART_KNOB, TAHR_FCL_OBBRSS, TAHR_FCL_DESCEND},
                 {"fcl collide", "fcl AABB; collide", CHART_KNOB, TAHR_FCL_AABB, TAHR_FCL_COLLIDE},
                 {"fcl collide", "fcl OBBRSS; collide", CHART_KNOB, TAHR_FCL_OBBRSS, TAHR_FCL_COLLIDE}};
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        tahr_fcl_desc desc = {.struct_size = sizeof desc, .volumes = table[i].volumes, .search = table[i].search};
        chart_subject *s = add(table[i].curve, table[i].setting, table[i].role, tahr_backend_v1_fcl);
        set_options(s, &desc, sizeof desc);
        s->slow = 1;
    }
}
#endif

#ifdef TAHR_HAVE_BOX2D
static void add_box2d(const char *name, uint32_t engine)
{
    tahr_box2d_desc desc = {.struct_size = sizeof desc, .engine = engine};
    chart_subject *s = add(name, name, CHART_ONLY, tahr_backend_v1_box2d);
    set_options(s, &desc, sizeof desc);
    s->planar = 1;
}
#endif

static void make_table(void)
{
    add_native();
#ifdef TAHR_HAVE_CCD
    add_ccd();
#endif
#ifdef TAHR_HAVE_FCL
    add_fcl();
#endif
#ifdef TAHR_HAVE_BOX2D
    add_box2d("box2d", TAHR_BOX2D_NEWEST);
#ifdef TAHR_HAVE_BOX2D_2
    add_box2d("box2d 2.4", TAHR_BOX2D_2);
#endif
#endif
}

const chart_subject *chart_subject_at(uint32_t index)
{
    if (subject_count == 0) make_table();
    return index < subject_count ? &subjects[index] : NULL;
}

const void *chart_subject_options(const chart_subject *s)
{
    return s->options.words[0] ? &s->options : NULL;
}

static void *host_alloc(void *user, size_t size, size_t alignment)
{
    (void)user;
    return aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

static void host_free(void *user, void *memory, size_t size, size_t alignment)
{
    (void)user, (void)size, (void)alignment;
    free(memory);
}

static void host_log(void *user, int32_t level, const char *message)
{
    (void)user;
    if (level == TAHR_LOG_ERROR) fprintf(stderr, "%s\n", message);
}

tahr_status chart_subject_open(const chart_subject *s, const tahr_body_desc *bodies, uint32_t count, void **self)
{
    static const tahr_host host = {sizeof host, TAHR_ABI, {NULL, host_alloc, host_free}, {NULL, host_log}};
    tahr_world_desc desc;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bodies;
    desc.body_count = count;
    desc.options = chart_subject_options(s);
    return s->get()->open(&host, &desc, self);
}

int chart_subject_cache(const chart_subject *s, void *self, tahr_query_context *context)
{
    const tahr_backend *backend = s->get();
    size_t size = backend->cache_size ? backend->cache_size(self) : 0;
    context->cache = NULL;
    if (size == 0) return 1;
    size = (size + 63) / 64 * 64;
    context->cache = aligned_alloc(64, size);
    if (!context->cache) return 0;
    memset(context->cache, 0, size);
    return 1;
}
