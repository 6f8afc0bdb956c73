/* SPDX-License-Identifier: MIT
 * truth_set.c: loads the stored truth and judges answers by the long double distance of tests/accuracy. */
#include "truth_set.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../accuracy/truth_file.h"

#ifndef TAHR_SOURCE_DIR
#define TAHR_SOURCE_DIR "."
#endif

enum { MAX_FAMILIES = 20, LINE = 65536 };
enum { ROUND, BOXES };

/* degrees: what the design allows the weakest backend (the strongest: 0.1) */
static const double WORST_NORMAL = 2;

struct chart_truth_set {
    truth_mesh *meshes;
    truth_case *cases;
    uint32_t *mesh_of;
    uint32_t mesh_count, count, capacity;
};

static const struct {
    const char *name;
    int shapes;
    const char *families[MAX_FAMILIES];
} SETS[CHART_TRUTH_SETS] = {
    {"triangles", ROUND, {"generic", "dyadic", "lattice", "feature", "grazing", "long", "overlap", "touching"}},
    {"meshes", ROUND, {"mesh_flat", "mesh_hills", "mesh_stairs", "mesh_corner", "mesh_fan", "mesh_soup"}},
    {"hard", ROUND, {"sliver", "tiny", "huge", "far_1e3", "far_1e6"}},
    {"boxes",
     BOXES,
     {"generic", "dyadic", "lattice", "feature", "grazing", "long", "touching", "mesh_flat", "mesh_hills",
      "mesh_stairs", "mesh_corner", "mesh_fan", "mesh_soup"}},
};

const char *chart_truth_name(int set)
{
    return SETS[set].name;
}

/* Room for one more mesh and one more case. */
static int grow(chart_truth_set *s)
{
    if (s->count < s->capacity && s->mesh_count < s->capacity) return 1;
    uint32_t capacity = s->capacity ? 2 * s->capacity : 256;
    truth_mesh *meshes = realloc(s->meshes, capacity * sizeof *meshes);
    s->meshes = meshes ? meshes : s->meshes;
    truth_case *cases = realloc(s->cases, capacity * sizeof *cases);
    s->cases = cases ? cases : s->cases;
    uint32_t *mesh_of = realloc(s->mesh_of, capacity * sizeof *mesh_of);
    s->mesh_of = mesh_of ? mesh_of : s->mesh_of;
    if (!meshes || !cases || !mesh_of) return 0;
    s->capacity = capacity;
    return 1;
}

/* What of a family is taken: of one kind of shape every stride-th case. */
typedef struct part {
    const char *family;
    int shapes;
    uint32_t stride;
} part;

static int read_family(chart_truth_set *s, const part *p, char *why)
{
    static char line[LINE];
    char path[1024];
    uint32_t seen = 0;
    snprintf(path, sizeof path, "%s/tests/accuracy/truth/%s.txt", TAHR_SOURCE_DIR, p->family);
    FILE *file = fopen(path, "r");
    if (!file) {
        snprintf(why, 256, "tests/accuracy/truth/%s.txt cannot be read", p->family);
        return 0;
    }
    int ok = 1;
    for (int number = 1; ok && fgets(line, sizeof line, file); number++) {
        ok = grow(s);
        if (!ok) {
            snprintf(why, 256, "out of memory");
        } else if (line[0] == 'm') {
            truth_read_mesh(line + 1, &s->meshes[s->mesh_count++]);
        } else if (line[0] == 'c') {
            truth_case *c = &s->cases[s->count];
            truth_read_case(line + 1, number, c);
            if ((c->query.shape.type == TAHR_SHAPE_BOX) != (p->shapes == BOXES) || seen++ % p->stride) continue;
            s->mesh_of[s->count++] = s->mesh_count - 1;
        }
    }
    fclose(file);
    return ok;
}

chart_truth_set *chart_truth_load(int set, uint32_t stride, char *why)
{
    chart_truth_set *s = calloc(1, sizeof *s);
    int ok = s != NULL;
    if (!ok) snprintf(why, 256, "out of memory");
    for (int i = 0; ok && i < MAX_FAMILIES && SETS[set].families[i]; i++) {
        ok = read_family(s, &(part){SETS[set].families[i], SETS[set].shapes, stride}, why);
    }
    if (!ok) {
        chart_truth_free(s);
        return NULL;
    }
    return s;
}

void chart_truth_free(chart_truth_set *s)
{
    if (!s) return;
    free(s->meshes);
    free(s->cases);
    free(s->mesh_of);
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

void chart_truth_body(const chart_truth_set *s, uint32_t i, tahr_body_desc *body, int *same)
{
    const truth_mesh *mesh = &s->meshes[s->mesh_of[i]];
    tahr_body_desc_init(body, sizeof *body, TAHR_BODY_MESH);
    body->flags = TAHR_BODY_TWO_SIDED;
    body->vertices = mesh->vertices;
    body->indices = mesh->indices;
    body->vertex_count = mesh->vertex_count;
    body->triangle_count = mesh->triangle_count;
    *same = i > 0 && s->mesh_of[i] == s->mesh_of[i - 1];
}

static double tolerance(const truth_case *c)
{
    tahr_vec3 m = c->query.motion;
    double way = sqrt(m.x * m.x + m.y * m.y + m.z * m.z);
    return way <= 1 ? 1e-6 : way > 100 ? 1e-4 : 1e-6 * way;
}

/* How far off the margin the answer stops the shape. What began nearer than its margin, and approaches, stops there. */
static double gap_error(const truth_mesh *mesh, const truth_case *c, const tahr_hit *hit, double *angle)
{
    nearest distances[TRUTH_MAX_TRIANGLES];
    double wanted = c->start_gap < c->query.margin ? c->start_gap : c->query.margin;
    double gap = (double)truth_distances(mesh, &c->query, hit->fraction, distances) - c->query.shape.radius;
    *angle = truth_normal_error(mesh, distances, 2 * tolerance(c), hit->normal);
    if (c->status == TRUTH_OVERLAP) return fabs(-hit->depth - c->start_gap);
    return fabs(gap - wanted);
}

chart_verdict chart_truth_judge(const chart_truth_set *s, uint32_t i, tahr_status status, const tahr_hit *hit,
                                uint32_t count, double *error)
{
    const truth_case *c = &s->cases[i];
    double tau = tolerance(c);
    *error = NAN;
    if (status < 0 || (count > 0 && (hit->unknown || !(hit->fraction >= 0 && hit->fraction <= 1)))) {
        return CHART_GAVE_UP;
    }
    if (count == 0) {
        int missed = c->status == TRUTH_OVERLAP ? c->start_gap < -tau : c->status == TRUTH_HIT && c->min_gap < -tau;
        return missed ? CHART_MISSED : CHART_FREE;
    }
    if (c->status == TRUTH_FREE) {
        return c->start_gap <= c->query.margin || c->min_gap > tau ? CHART_FALSE_HIT : CHART_FREE;
    }
    if (hit->start_overlap != (c->status == TRUTH_OVERLAP)) {
        if (fabs(c->start_gap) <= tau) return CHART_FREE;
        return hit->start_overlap ? CHART_FALSE_HIT : CHART_MISSED;
    }
    double angle;
    *error = gap_error(&s->meshes[s->mesh_of[i]], c, hit, &angle);
    if (!isfinite(*error)) return CHART_GAVE_UP;
    return angle <= WORST_NORMAL ? CHART_HIT : CHART_WRONG_NORMAL;
}
