/* SPDX-License-Identifier: MIT
 * fuzz_engines.c: the same scene on native and on every other engine of this build: the same answers within
 * the contract. Three of four scenes are of three dimensions, the others of two: those native has drawn out into space.
 * Where two engines stop at different fractions, each is judged by the distance that the other measures there: at a
 * graze the fraction may be far off and do no harm. */
#include "flat.h"
#include "target.h"

#include <math.h>
#include <string.h>
#include <tahr/box2d.h>
#include <tahr/ccd.h>
#include <tahr/fcl.h>
#include <tahr/native.h>

enum { MOST_QUERIES = 24, SAMPLES = 8, MOST_CONTACTS = 8 };

/* m: gaps may differ by 1e-4 of the size of the shape, and the corners of scenes lie within some metres. */
static const double SLACK = 1e-4;

static const tahr_backend *engine(int i)
{
    switch (i) {
    case 0: return tahr_backend_v1_native();
#ifdef TAHR_HAVE_CCD
    case 1: return tahr_backend_v1_ccd();
#endif
#ifdef TAHR_HAVE_FCL
    case 2: return tahr_backend_v1_fcl();
#endif
    default: return NULL;
    }
}

static double length(tahr_vec3 v)
{
    return sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

static tahr_vec3 along(const tahr_sweep *q, double t)
{
    return (tahr_vec3){q->position.x + q->motion.x * t, q->position.y + q->motion.y * t,
                       q->position.z + q->motion.z * t};
}

/* Signed distance to the nearest surface, or reach where nothing is that near. */
static double nearest(tahr_world *world, const tahr_sweep *q, double t, double reach)
{
    tahr_contact c[MOST_CONTACTS];
    uint32_t count = 0;
    tahr_contact_query near = {.shape = q->shape,
                               .position = along(q, t),
                               .up = q->up,
                               .orientation = q->orientation,
                               .margin = reach,
                               .mask = q->mask,
                               .ignore_body = q->ignore_body};
    tahr_status status = tahr_world_contacts(world, &near, c, MOST_CONTACTS, &count);
    FUZZ_CHECK(status >= 0, "contacts: %s", tahr_status_name(status));
    return count ? c[0].distance : reach;
}

/* Nowhere nearer than the margin on the way, or than it was at the start, measured by the other engine; and at the
 * margin at the end, if blocked. */
static void judge(tahr_world *judge_world, const tahr_sweep *q, double start, const tahr_hit *h, const char *who)
{
    double end = h->fraction, way = length(q->motion), nearer = fmin(q->margin, start);
    for (int i = 1; i <= SAMPLES; i++) {
        double d = nearest(judge_world, q, end * i / SAMPLES, 2 * q->margin + 2 * SLACK);
        FUZZ_CHECK(d >= nearer - SLACK,
                   "%s passes %.9g m from something (margin %g, start %.9g) at %d/8 of fraction %.9g of %g m", who, d,
                   q->margin, start, i, end, way);
    }
    if (!h->blocking) return;
    double d = nearest(judge_world, q, end, 2 * q->margin + 2 * SLACK);
    FUZZ_CHECK(d <= q->margin + SLACK, "%s stops %.9g m from anything (margin %g), at fraction %.9g of %g m", who, d,
               q->margin, end, way);
    if (h->start_overlap) return; /* by less than the slack: whatever the motion */
    double against = h->normal.x * q->motion.x + h->normal.y * q->motion.y + h->normal.z * q->motion.z;
    FUZZ_CHECK(against < 0, "%s is blocked by a normal along the motion: %g", who, against);
}

static int ask(tahr_world *world, const tahr_sweep *q, tahr_hit *h)
{
    uint32_t count = 0;
    memset(h, 0, sizeof *h);
    h->fraction = 1;
    tahr_status status = tahr_world_sweep(world, q, h, 1, &count);
    FUZZ_CHECK(status >= 0, "sweep: %s", tahr_status_name(status));
    if (!count) memset(h, 0, sizeof *h);
    if (!count) h->fraction = 1;
    return status != TAHR_UNKNOWN;
}

static void compare(tahr_world *a, tahr_world *b, const tahr_sweep *q, const char *who)
{
    tahr_hit h, other;
    double start = nearest(a, q, 0, 1), there = nearest(b, q, 0, 1);
    /* Inside of things, which way is out, and how far, is a matter of method; that it is inside is not. */
    if (start < -SLACK || there < -SLACK) {
        FUZZ_CHECK(start < SLACK && there < SLACK, "%s: %.9g m at the start, native %.9g", who, there, start);
        return;
    }
    FUZZ_CHECK(fabs(start - there) <= SLACK, "%s: %.9g m at the start, native %.9g", who, there, start);
    if (!ask(a, q, &h) || !ask(b, q, &other)) return;
    judge(b, q, start, &h, "native");
    judge(a, q, start, &other, who);
}

static tahr_shape shape_of(bytes *b)
{
    static const tahr_shape shapes[] = {{TAHR_SHAPE_CAPSULE, 0, 0.35, 0.9, 0, 0},
                                        {TAHR_SHAPE_SPHERE, 0, 0.4, 0.4, 0, 0},
                                        {TAHR_SHAPE_BOX, 0, 0, 0.9, 0.3, 0.25},
                                        {TAHR_SHAPE_CAPSULE, 0, 0.5, 0.5, 0, 0}};
    return shapes[bytes_below(b, 4)];
}

static tahr_sweep sweep_of(const scene *s, bytes *b)
{
    static const double margins[] = {0.01, 0.001, 0.05, 0.01};
    tahr_sweep q = {.shape = shape_of(b),
                    .up = {0, 0, 1},
                    .orientation = {0, 0, 0, 1},
                    .mask = 0xFFFFFFFFu,
                    .ignore_body = TAHR_NO_BODY};
    q.margin = margins[bytes_below(b, 4)];
    q.position = scene_point(s, b);
    q.position.z += bytes_between(b, 0, 2.55);
    tahr_vec3 to = scene_point(s, b);
    q.motion = (tahr_vec3){to.x - q.position.x, to.y - q.position.y, to.z - q.position.z};
    return q;
}

/* What all engines are asked. */
typedef struct questions {
    tahr_sweep sweeps[MOST_QUERIES];
    int count;
} questions;

static void questions_read(questions *q, const scene *s, bytes *b)
{
    q->count = 0;
    while (q->count < MOST_QUERIES && bytes_left(b) > 0)
        q->sweeps[q->count++] = sweep_of(s, b);
}

static void compare_all(tahr_world *native, tahr_world *other, const questions *q, const char *who)
{
    for (int k = 0; native && other && k < q->count; k++)
        compare(native, other, &q->sweeps[k], who);
    tahr_world_close(other);
}

static void try_space(bytes *b)
{
    static scene s;
    questions q;
    /* Two-sided: who is behind a one-sided face is beside nothing for one engine and inside for another. */
    scene_read(&s, b, SCENE_TWO_SIDED | SCENE_NEAR);
    questions_read(&q, &s, b);
    tahr_world *native = scene_open(&s, engine(0), NULL);
    for (int i = 1; native && i < 3; i++) {
        tahr_world *world = engine(i) ? scene_open(&s, engine(i), NULL) : NULL;
        compare_all(native, world, &q, world ? tahr_world_backend_name(world) : "nobody");
    }
    tahr_world_close(native);
}

#ifdef TAHR_HAVE_BOX2D
static void try_plane(bytes *b)
{
    static flat f;
    questions q;
    flat_read(&f, b);
    questions_read(&q, &f.plane, b);
    for (int k = 0; k < q.count; k++)
        q.sweeps[k] = flat_sweep(&q.sweeps[k]);
    tahr_world *native = scene_open(&f.space, engine(0), NULL);
    const tahr_box2d_desc three = {.struct_size = sizeof three, .engine = TAHR_BOX2D_3};
    compare_all(native, scene_open(&f.plane, tahr_backend_v1_box2d(), &three), &q, "box2d 3");
    const tahr_box2d_desc two = {.struct_size = sizeof two, .engine = TAHR_BOX2D_2};
    compare_all(native, scene_open(&f.plane, tahr_backend_v1_box2d(), &two), &q, "box2d 2.4");
    tahr_world_close(native);
}
#endif

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    bytes b = {data, data + size};
#ifdef TAHR_HAVE_BOX2D
    if (size > 0 && data[0] % 4 == 2) {
        bytes_u8(&b);
        try_plane(&b);
        return 0;
    }
#endif
    try_space(&b);
    return 0;
}
