/* SPDX-License-Identifier: MIT
 * truth_set.c: keeps the stored truth in memory, and judges answers by the score of tests/accuracy. */
#include "truth_set.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "truth_file.h"

enum { MAX_FAMILIES = 24 };
enum { ROUND, BOXES, ALL };

/* degrees: what the design allows the weakest backend (the strongest: 0.1) */
static const double WORST_NORMAL = 2;

struct chart_truth_set {
    truth_body **bodies; /* one by one: they point into themselves */
    truth_case *cases;
    uint32_t *body_of;
    uint32_t body_count, count, capacity;
    uint32_t stride, seen;
    int shapes, failed;
};

static const struct {
    const char *name;
    int shapes;
    const char *families[MAX_FAMILIES];
} SETS[CHART_TRUTH_SETS] = {
    {"triangles", ROUND, {"generic", "dyadic", "lattice", "feature", "grazing", "long", "overlap", "touching"}},
    {"meshes", ROUND, {"mesh_flat", "mesh_hills", "mesh_stairs", "mesh_corner", "mesh_fan", "mesh_soup"}},
    {"convex",
     ROUND,
     {"convex_hull", "convex_box", "convex_exact", "convex_grazing", "convex_touching", "convex_overlap"}},
    {"hard", ROUND, {"sliver", "tiny", "huge", "far_1e3", "far_1e6", "convex_sharp"}},
    {"boxes",
     BOXES,
     {"generic", "dyadic", "lattice", "feature", "grazing", "long", "touching", "mesh_flat", "mesh_hills",
      "mesh_stairs", "mesh_corner", "mesh_fan", "mesh_soup", "convex_hull", "convex_box", "convex_exact",
      "convex_grazing", "convex_touching"}},
    {"outlines", ALL, {"plane_chain", "plane_hull"}},
};

const char *chart_truth_name(int set)
{
    return SETS[set].name;
}

/* Room for one more body and one more case. */
static int grow(chart_truth_set *s)
{
    if (s->count < s->capacity && s->body_count < s->capacity) return 1;
    uint32_t capacity = s->capacity ? 2 * s->capacity : 256;
    truth_body **bodies = realloc(s->bodies, capacity * sizeof *bodies);
    s->bodies = bodies ? bodies : s->bodies;
    truth_case *cases = realloc(s->cases, capacity * sizeof *cases);
    s->cases = cases ? cases : s->cases;
    uint32_t *body_of = realloc(s->body_of, capacity * sizeof *body_of);
    s->body_of = body_of ? body_of : s->body_of;
    if (!bodies || !cases || !body_of) return 0;
    s->capacity = capacity;
    return 1;
}

static truth_body *copy_of(const truth_body *body)
{
    truth_body *copy = malloc(sizeof *copy);
    if (!copy) return NULL;
    *copy = *body;
    copy->judged.vertices = copy->vertices;
    copy->judged.indices = copy->indices;
    if (copy->desc.vertices) copy->desc.vertices = copy->vertices;
    if (copy->desc.indices) copy->desc.indices = copy->indices;
    if (copy->flat.vertices) copy->flat.vertices = copy->vertices;
    if (copy->flat.indices) copy->flat.indices = copy->indices;
    return copy;
}

static void keep(void *user, const truth_body *body, int is_new, const truth_case *c)
{
    chart_truth_set *s = user;
    s->failed = s->failed || !grow(s);
    if (s->failed) return;
    if (is_new || s->body_count == 0) {
        s->bodies[s->body_count] = copy_of(body);
        s->failed = s->bodies[s->body_count] == NULL;
        if (s->failed) return;
        s->body_count++;
    }
    if (s->shapes != ALL && (c->query.shape.type == TAHR_SHAPE_BOX) != (s->shapes == BOXES)) return;
    if (s->seen++ % s->stride) return;
    s->cases[s->count] = *c;
    s->body_of[s->count++] = s->body_count - 1;
}

chart_truth_set *chart_truth_load(int set, uint32_t stride)
{
    chart_truth_set *s = calloc(1, sizeof *s);
    if (!s) return NULL;
    s->stride = stride;
    s->shapes = SETS[set].shapes;
    for (int i = 0; i < MAX_FAMILIES && SETS[set].families[i]; i++) {
        truth_each(SETS[set].families[i], keep, s);
    }
    if (!s->failed) return s;
    chart_truth_free(s);
    return NULL;
}

void chart_truth_free(chart_truth_set *s)
{
    if (!s) return;
    for (uint32_t i = 0; i < s->body_count; i++) {
        free(s->bodies[i]);
    }
    free(s->bodies);
    free(s->cases);
    free(s->body_of);
    free(s);
}

uint32_t chart_truth_count(const chart_truth_set *s)
{
    return s->count;
}

const tahr_sweep *chart_truth_sweep(const chart_truth_set *s, uint32_t i)
{
    return &s->cases[i].query;
}

int chart_truth_planar(int set)
{
    return SETS[set].shapes == ALL;
}

const tahr_body_desc *chart_truth_body(const chart_truth_set *s, uint32_t i, int planar, int *same)
{
    const truth_body *body = s->bodies[s->body_of[i]];
    *same = i > 0 && s->body_of[i] == s->body_of[i - 1];
    return planar ? &body->flat : &body->desc;
}

static double tolerance(const truth_case *c)
{
    tahr_vec3 m = c->query.motion;
    double way = sqrt(m.x * m.x + m.y * m.y + m.z * m.z);
    return way <= 1 ? 1e-6 : way > 100 ? 1e-4 : 1e-6 * way;
}

static chart_verdict failed(const score_answer *a, const truth_case *c, uint32_t count)
{
    switch (a->failure) {
    case SCORE_MISS: return a->beyond > tolerance(c) ? CHART_MISSED : CHART_FREE;
    case SCORE_FALSE_HIT: return a->beyond > tolerance(c) ? CHART_FALSE_HIT : CHART_FREE;
    case SCORE_START: return a->beyond <= tolerance(c) ? CHART_FREE : count ? CHART_FALSE_HIT : CHART_MISSED;
    default: return CHART_GAVE_UP;
    }
}

chart_verdict chart_truth_judge(const chart_truth_set *s, uint32_t i, tahr_status status, const tahr_hit *hit,
                                uint32_t count, double *error)
{
    const truth_case *c = &s->cases[i];
    const score_scene scene = {&s->bodies[s->body_of[i]]->judged, 1};
    score_answer a = score_sweep(&scene, &c->query, &c->truth, status, hit, count, 2 * tolerance(c));
    *error = fabs(a.gap_error);
    if (a.failure != SCORE_FINE) return failed(&a, c, count);
    if (!a.measured) return CHART_FREE;
    return a.normal_error <= WORST_NORMAL ? CHART_HIT : CHART_WRONG_NORMAL;
}
