/* SPDX-License-Identifier: MIT
 * subject.c: opening a trial's scene on every backend of this build. */
#include "subject.h"

#include "engine.h"
#include "liar.h"
#include "mutant.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <tahr/backend.h>
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

enum { ON_NATIVE, ON_CCD, ON_FCL, ON_BOX2D, ON_CALLBACKS, ON_ONE_CALLBACK, ON_LIAR, ON_MUTANT };

static const uint32_t BOTH = IN_SPACE | IN_PLANE, ALL = (1u << KEEPS_COUNT) - 1;

#define PLANAR_ONLY "a world of two dimensions"

/* sweep-only: what is near and not overlapped it cannot tell, so nobody comes to rest between faces too steep to stand
 * on. gap: 1e-9 m is what native's README promises, and of the others, as the own core distance decides what their
 * engines find. */
const subject SUBJECTS[] = {
    {"native", BOTH, "", ALL, 0, 0, 0, 1e-9, ON_NATIVE, 0},
#ifdef TAHR_HAVE_CCD
    {"ccd", BOTH, "", ALL, 0, 0, 0, 1e-9, ON_CCD, 0},
#endif
#ifdef TAHR_HAVE_FCL
    {"fcl", BOTH, "", ALL, 0, 0, 0, 1e-9, ON_FCL, 0},
#endif
#ifdef TAHR_HAVE_BOX2D
    {"box2d", IN_PLANE, PLANAR_ONLY, ALL, 0, 0, 0, 1e-9, ON_BOX2D, TAHR_BOX2D_NEWEST},
#ifdef TAHR_HAVE_BOX2D_2
    {"box2d-2", IN_PLANE, PLANAR_ONLY, ALL, 0, 0, 0, 1e-9, ON_BOX2D, TAHR_BOX2D_2},
#endif
#endif
    {"callbacks", BOTH, "", ALL, 0, 0, 0, 1e-9, ON_CALLBACKS, 0},
    {"sweep-only", BOTH, "", ALL & ~(uint32_t)KEEPS_REST, 0, 0, 0, 1e-9, ON_ONE_CALLBACK, 0},
    {"liar-numbers", BOTH, "", KEEPS_SANE, LIE_NOT_NUMBERS, 0, 0, 0, ON_LIAR, 0},
    {"liar-late", BOTH, "", KEEPS_SANE, LIE_LATE, 0, 0, 0, ON_LIAR, 0},
    {"liar-false", BOTH, "", KEEPS_SANE, LIE_FALSE, 0, 0, 0, ON_LIAR, 0},
    {"liar-normals", BOTH, "", KEEPS_SANE, LIE_NORMALS, 0, 0, 0, ON_LIAR, 0},
    {"liar-garbage", BOTH, "", KEEPS_SANE, LIE_GARBAGE, 0, 0, 0, ON_LIAR, 0},
    {.name = NULL},
};

int subject_count(void)
{
    return (int)(sizeof SUBJECTS / sizeof SUBJECTS[0]) - 1;
}

const subject *subject_named(const char *name)
{
    for (const subject *s = SUBJECTS; s->name; s++) {
        if (strcmp(s->name, name) == 0) return s;
    }
    return NULL;
}

subject subject_mutant(uint32_t which)
{
    return (subject){mutant_name(which), BOTH, "", ALL, 0, which, 1, 1e-9, ON_MUTANT, 0};
}

static uint32_t divisor(uint32_t a, uint32_t b)
{
    while (b > 0) {
        uint32_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

subject subject_judged(const char *liar)
{
    subject s = *subject_named(liar);
    s.keeps = ALL;
    s.judged = 1;
    s.gap = 1e-9;
    return s;
}

/* A line goes to engines of two dimensions as a chain, whose front is on the right hand: from its other end. */
static void chain_of(const trial_body *b, double *vertices, tahr_body_desc *desc)
{
    for (int i = 0; i < b->outline_count; i++) {
        const double *p = b->outline[b->outline_count - 1 - i];
        vertices[3 * i] = p[0];
        vertices[3 * i + 1] = p[1];
        vertices[3 * i + 2] = 0;
    }
    desc->type = TAHR_BODY_CHAIN;
    desc->vertices = vertices;
    desc->vertex_count = (uint32_t)b->outline_count;
}

enum { TRIAL_HEIGHTS = 24 * 24 };

static void heights_of(const trial_body *b, double *heights, tahr_body_desc *desc)
{
    for (uint32_t i = 0; i < b->mesh.vertex_count && i < TRIAL_HEIGHTS; i++) {
        const double z = b->mesh.vertices[3 * i + 2];
        heights[i] = z == TRIAL_HOLE ? NAN : z;
    }
    desc->heights = heights;
}

/* The triangles of a trial's meshes, by the names that they have there, in some order. */
static tahr_status gather(void *user, const tahr_bounds *box, uint32_t mask, tahr_gather *out)
{
    const gathered *g = user;
    uint32_t total = 0;
    (void)box, (void)mask;
    for (uint32_t i = 0; i < g->trial->body_count; i++)
        total += g->trial->bodies[i].mesh.triangle_count;
    /* A stride without a common divisor visits all of them. */
    uint32_t stride = g->order ? 1 + g->order % (total > 1 ? total : 1) : 1;
    while (divisor(stride, total) > 1)
        stride++;
    for (uint32_t n = 0; n < total; n++) {
        uint32_t k = (uint32_t)((uint64_t)n * stride % total), i = 0;
        for (; k >= g->trial->bodies[i].mesh.triangle_count; i++)
            k -= g->trial->bodies[i].mesh.triangle_count;
        const trial_body *b = &g->trial->bodies[i];
        if (b->desc.type != TAHR_BODY_MESH) continue;
        tahr_triangle t = {.body = g->trial->body_count + i, .feature = k, .flags = b->desc.flags};
        for (int c = 0; c < 3; c++) {
            const double *v = b->mesh.vertices + 3 * (size_t)b->mesh.indices[3 * (size_t)k + (size_t)c];
            t.corners[c] = (tahr_vec3){v[0], v[1], v[2]};
        }
        if (!out->add(out, &t)) break;
    }
    return TAHR_OK;
}

static void complain(void *user, int32_t level, const char *message)
{
    (void)user, (void)level;
    printf("    %s\n", message);
}

/* How a scene is opened: on a backend, or on one of the two engines behind callbacks. */
typedef struct opening {
    const tahr_backend *backend; /* NULL: callbacks */
    const void *options;
    int planar;
    int callbacks; /* ON_CALLBACKS, ON_ONE_CALLBACK */
} opening;

static tahr_status open_on(const opening *how, const trial *t, opened *o)
{
    const tahr_native_desc *native = how->options;
    int left_out = how->backend == tahr_backend_v1_native() && native->gather != NULL;
    static double chains[TRIAL_BODIES][3 * TRIAL_OUTLINE]; /* read while opening only, and cells run one at a time */
    static double heights[TRIAL_HEIGHTS];                  /* of one field a trial */
    tahr_body_desc bodies[TRIAL_BODIES];
    tahr_world_desc desc;
    uint32_t count = 0;
    for (uint32_t i = 0; i < t->body_count; i++) {
        const trial_body *b = &t->bodies[i];
        tahr_body_desc *to = &bodies[count];
        if (left_out && b->desc.type == TAHR_BODY_MESH) continue;
        *to = b->desc;
        if (how->planar && b->outline_count > 0) {
            chain_of(b, chains[i], to);
        } else if (b->desc.type == TAHR_BODY_HEIGHTS) {
            heights_of(b, heights, to);
        } else if (b->desc.type == TAHR_BODY_MESH || b->desc.type == TAHR_BODY_HULL) {
            int mesh = b->desc.type == TAHR_BODY_MESH;
            to->vertices = b->mesh.vertices;
            to->vertex_count = b->mesh.vertex_count;
            to->indices = mesh ? b->mesh.indices : NULL;
            to->triangle_count = mesh ? b->mesh.triangle_count : 0;
        }
        count++;
    }
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bodies;
    desc.body_count = count;
    desc.options = how->options;
    desc.log = o->log.write ? &o->log : NULL;
    if (how->callbacks == ON_CALLBACKS) return engine_open(NULL, &desc, &o->world);
    if (how->callbacks == ON_ONE_CALLBACK) return engine_open_sweep_only(NULL, &desc, &o->world);
    return tahr_world_open(how->backend, &desc, &o->world);
}

static tahr_status open_world(const subject_request *r, opened *o)
{
    const subject *s = r->subject;
    const tahr_native_desc native = {.struct_size = sizeof native,
                                     .no_cache = (r->without & WITHOUT_CACHE) != 0,
                                     .no_simd = (r->without & WITHOUT_LANES) != 0,
                                     .no_vicinity = (r->without & WITHOUT_SHORT_WAYS) != 0,
                                     .no_capsule_ends = (r->without & WITHOUT_SHORT_WAYS) != 0,
                                     .gather = r->without & GATHERED ? gather : NULL,
                                     .gather_user = &o->gathered};
    const liar_desc liar = {sizeof liar, s->lie, r->seed};
    const mutant_desc mutant = {sizeof mutant, s->mutant};
    opening how = {NULL, NULL, 0, 0};
#ifdef TAHR_HAVE_BOX2D
    const tahr_box2d_desc box2d = {.struct_size = sizeof box2d, .engine = s->engine};
    if (s->kind == ON_BOX2D) how = (opening){tahr_backend_v1_box2d(), &box2d, 1, 0};
#endif
#ifdef TAHR_HAVE_CCD
    if (s->kind == ON_CCD) how.backend = tahr_backend_v1_ccd();
#endif
#ifdef TAHR_HAVE_FCL
    if (s->kind == ON_FCL) how.backend = tahr_backend_v1_fcl();
#endif
    if (s->kind == ON_NATIVE) how = (opening){tahr_backend_v1_native(), &native, 0, 0};
    if (s->kind == ON_LIAR) how = (opening){liar_backend(), &liar, 0, 0};
    if (s->kind == ON_MUTANT) how = (opening){mutant_backend(), &mutant, 0, 0};
    if (!how.backend) how.callbacks = s->kind;
    return open_on(&how, r->trial, o);
}

static uint32_t able(const tahr_backend *b)
{
    return b->capabilities | (b->fluid ? (uint32_t)NEEDS_FLUIDS : 0u);
}

uint32_t subject_capabilities(const subject *s)
{
    const uint32_t native = able(tahr_backend_v1_native());
    switch (s->kind) {
#ifdef TAHR_HAVE_BOX2D
    case ON_BOX2D: return able(tahr_backend_v1_box2d());
#endif
#ifdef TAHR_HAVE_CCD
    case ON_CCD: return able(tahr_backend_v1_ccd());
#endif
#ifdef TAHR_HAVE_FCL
    case ON_FCL: return able(tahr_backend_v1_fcl());
#endif
    case ON_LIAR: return able(liar_backend());
    case ON_MUTANT: return able(mutant_backend());
    case ON_ONE_CALLBACK: return native & ~(uint32_t)(TAHR_CAP_SENSORS | TAHR_CAP_ONE_WAY | NEEDS_FLUIDS);
    default: return native; /* itself, or the engine behind callbacks */
    }
}

tahr_status subject_open(const subject_request *r, opened *o)
{
    tahr_config config = r->trial->config;
    memset(o, 0, sizeof *o);
    o->subject = r->subject;
    o->gathered = (gathered){r->trial, r->without / ORDERED_BY};
    o->log.write = r->loud ? complain : NULL;
    tahr_status status = open_world(r, o);
    if (r->without & WITHOUT_CACHED_FLOOR) config.cached_floor = 0;
    if (r->without & WITHOUT_SLEEP) config.sleep = 0;
    if (r->without & WITHOUT_SHORT_WAYS) config.short_ways = config.barred_steps = 0;
    if (status >= 0) {
        tahr_world *inside = engine_inside(o->world);
        o->bodies = inside ? inside : o->world;
        status = tahr_mover_create(o->world, &config, &o->mover);
    }
    if (status < 0) subject_close(o);
    return status;
}

void subject_close(opened *o)
{
    tahr_mover_destroy(o->mover);
    if (o->world) engine_close(NULL, o->world);
    memset(o, 0, sizeof *o);
}

tahr_status subject_move(opened *o, const tahr_body_pose *poses, uint32_t count, double dt)
{
    tahr_status status = tahr_world_move(o->bodies, poses, count, dt);
    if (status >= 0 && o->bodies != o->world) status = tahr_world_touch(o->world);
    return status;
}
