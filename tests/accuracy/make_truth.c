/* SPDX-License-Identifier: MIT
 * make_truth.c: makes the stored truth of sweeps and contacts, in quad precision, one text file per family.
 *
 *   gcc -std=gnu11 -O2 -ffp-contract=off tests/accuracy/make_truth.c -lm -o make_truth
 *   ./make_truth tests/accuracy/truth
 *
 * Time of impact needs no case analysis: along a translation the distance of two convex sets is a convex function, so
 * golden section finds its minimum and bisection the first crossing of rho = radius + margin before it. A second method
 * that shares only vector arithmetic (quad_entry.h: faces, edge cylinders and vertex spheres of the Minkowski sum, in
 * closed form) must agree on hit or miss and within 1e-9 m of gap on every case, or the program fails at once.
 * Inputs are doubles and are taken as exact. Deterministic: the same files on every run. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "quad_entry.h"
#include "truth_plane.h"
#include "truth_solid.h"

enum { FREE, HIT, OVERLAP };

typedef struct {
    int status;
    double start_gap, fraction, min_gap;
    dvec start_normal, normal;
} answer;

/* About 2000 cases in all. aspect 0: any shape; else longest side over height lies between aspect / 100 and aspect. */
static const family families[] = {
    {"generic", 48, MIXED, EXACT, 0.3, 4, 0, 0, 4},        {"dyadic", 44, MIXED, DYADIC, 0.3, 4, 0, 0, 4},
    {"lattice", 44, ANYWHERE, LATTICE, 2, 2, 0, 0, 2},     {"feature", 40, AIMED, DYADIC, 0.5, 3, 0, 0, 1},
    {"grazing", 40, GRAZING, EXACT, 0.5, 3, 0, 0, 2},      {"long", 20, MIXED, DYADIC, 0.5, 3, 0, 0, 100},
    {"sliver", 32, MIXED, FINE, 1, 3, 1e6, 0, 1},          {"tiny", 20, MIXED, FINE, 0.01, 0.01, 0, 0, 1},
    {"huge", 24, MIXED, DYADIC, 1000, 1000, 0, 0, 4},      {"far_1e3", 20, MIXED, DYADIC, 0.3, 4, 0, 1e3, 1},
    {"far_1e6", 20, MIXED, DYADIC, 0.3, 4, 0, 1e6, 1},     {"touching", 32, TOUCHING, DYADIC, 0.5, 3, 0, 0, 1},
    {"overlap", 24, OVERLAPPING, DYADIC, 0.5, 3, 0, 0, 1},
};

static nearest nearest_at(core k, const triangle *t, vec motion, real time)
{
    k.centre = vadd(k.centre, vmul(motion, time));
    return core_triangle(&k, t);
}

/* Time of the smallest distance. 80 steps leave 2e-17 of the motion; the distance is flat there, so its error is the
 * square of that. */
static real golden_minimum(const core *k, const triangle *t, vec motion)
{
    const real ratio = (root(5) - 1) / 2;
    real lo = 0, hi = 1, a = hi - ratio, b = lo + ratio;
    real fa = nearest_at(*k, t, motion, a).squared, fb = nearest_at(*k, t, motion, b).squared;

    for (int i = 0; i < 80; i++) {
        if (fa <= fb) {
            hi = b, b = a, fb = fa, a = hi - ratio * (hi - lo);
            fa = nearest_at(*k, t, motion, a).squared;
        } else {
            lo = a, a = b, fa = fb, b = lo + ratio * (hi - lo);
            fb = nearest_at(*k, t, motion, b).squared;
        }
    }
    a = (lo + hi) / 2;
    if (nearest_at(*k, t, motion, 0).squared <= nearest_at(*k, t, motion, a).squared) a = 0;
    if (nearest_at(*k, t, motion, 1).squared <= nearest_at(*k, t, motion, a).squared) a = 1;
    return a;
}

/* Triangles that no point of the sweep can be near, by centres and radii in double with a centimetre to spare. */
static int out_of_reach(const query *q, const triangle *t, double rho)
{
    dvec a = narrow(t->v[0]), b = narrow(t->v[1]), c = narrow(t->v[2]);
    dvec middle = scaled(add(add(a, b), c), 1.0 / 3), d = sub(q->position, middle);
    double reach = 0;

    for (int i = 0; i < 3; i++) {
        dvec e = sub(narrow(t->v[i]), middle);
        if (dot(e, e) > reach) reach = dot(e, e);
    }
    reach = sqrt(reach) + sqrt(dot(q->motion, q->motion)) + rho + q->half_height + q->half_x + q->half_y + 0.01;
    return dot(d, d) > reach * reach;
}

static void solve_start(const query *q, const mesh *m, answer *out, vec *gap)
{
    core k = core_of(q);
    nearest best = {-1, {0, 0, 0}, {0, 0, 0}};
    int inside = m->solid;

    for (int i = 0; i < m->triangle_count; i++) {
        triangle t = triangle_of(m, i);
        vec n = vcross(vsub(t.v[1], t.v[0]), vsub(t.v[2], t.v[0]));
        if (vdot(n, vsub(k.centre, t.v[0])) > 0) inside = 0;
        nearest d = core_triangle(&k, &t);
        if (best.squared < 0 || d.squared < best.squared) best = d;
    }
    if (inside) best.squared = 0;
    real distance = root(best.squared);
    out->start_gap = (double)(distance - q->radius);
    *gap = best.gap;
    out->start_normal = distance > 0 ? narrow(vmul(best.gap, 1 / distance)) : (dvec){0, 0, 0};
}

/* First method. The surface as a whole is the smallest of its triangles' distances. */
static real solve_motion(const query *q, const mesh *m, answer *out)
{
    core k = core_of(q);
    vec motion = wide(q->motion), gap = {0, 0, 0};
    real rho = (real)q->radius + q->margin, first = 2, smallest = -1;

    for (int i = 0; i < m->triangle_count; i++) {
        triangle t = triangle_of(m, i);
        if (out_of_reach(q, &t, (double)rho)) continue;
        real hi = golden_minimum(&k, &t, motion), lo = 0, least = nearest_at(k, &t, motion, hi).squared;
        if (smallest < 0 || least < smallest) smallest = least;
        if (least > rho * rho) continue;
        for (int step = 0; step < 90; step++) {
            real mid = (lo + hi) / 2;
            if (nearest_at(k, &t, motion, mid).squared > rho * rho)
                lo = mid;
            else
                hi = mid;
        }
        if (hi < first) {
            first = hi;
            gap = nearest_at(k, &t, motion, hi).gap;
        }
    }
    out->min_gap = smallest < 0 ? out->start_gap - q->margin : (double)(root(smallest) - rho);
    out->status = first <= 1 ? HIT : FREE;
    out->fraction = first <= 1 ? (double)first : 1;
    out->normal = first <= 1 ? narrow(vmul(gap, 1 / root(vdot(gap, gap)))) : (dvec){0, 0, 0};
    return first;
}

static const char *family_name;
static int case_number;

static void fail(const char *what, const query *q, double a, double b)
{
    fprintf(stderr, "make_truth: %s, case %d: the two methods differ: %s: %a against %a (position %a %a %a)\n",
            family_name, case_number, what, a, b, q->position.x, q->position.y, q->position.z);
    exit(1);
}

/* Second method: entry into the patches of the grown triangles, and the distance to them. */
static void verify(const query *q, const mesh *m, const answer *a, real first)
{
    core k = core_of(q);
    vec centre = wide(q->position), motion = wide(q->motion);
    real rho = (real)q->radius + q->margin, entry = 2, squared = -1;
    patch patches[MAX_PATCHES];

    for (int i = 0; i < m->triangle_count; i++) {
        triangle t = triangle_of(m, i);
        int count = grow_triangle(patches, &k, &t);
        for (int j = 0; j < count; j++) {
            real d = patch_distance_squared(centre, &patches[j]);
            if (squared < 0 || d < squared) squared = d;
            if (first >= 0) enter_patch(&entry, centre, motion, &patches[j], rho);
        }
    }
    if (fabs((double)(root(squared) - q->radius) - a->start_gap) > 1e-9)
        fail("start", q, (double)root(squared), a->start_gap);
    if (first < 0 || fabs(a->min_gap) < 1e-9) return;
    if ((entry <= 1) != (first <= 1)) fail("hit or miss", q, (double)entry, (double)first);
    if (entry > 1) return;
    squared = -1;
    for (int i = 0; i < m->triangle_count; i++) {
        triangle t = triangle_of(m, i);
        real d = nearest_at(k, &t, motion, entry).squared;
        if (squared < 0 || d < squared) squared = d;
    }
    if (fabs((double)(root(squared) - rho)) > 1e-9) fail("gap", q, (double)root(squared), (double)rho);
}

static int solve(const query *q, const mesh *m, answer *out)
{
    vec gap;
    real first = -1;

    memset(out, 0, sizeof *out);
    solve_start(q, m, out, &gap);
    if (out->start_gap + q->radius < 1e-3) return 0; /* the core touches: no unique way out */
    out->min_gap = out->start_gap - q->margin;
    out->normal = out->start_normal;
    if (out->start_gap < 0) {
        out->status = OVERLAP;
    } else if (out->start_gap <= q->margin) {
        /* Flatter than this is parallel: the frame of a turned box is no better than the doubles of its quaternion. */
        real flat = (real)1e-12 * root(vdot(gap, gap)) * root(vdot(wide(q->motion), wide(q->motion)));
        int approaches = vdot(gap, wide(q->motion)) < -flat;
        out->status = approaches ? HIT : FREE;
        out->fraction = approaches ? 0 : 1;
    } else {
        first = solve_motion(q, m, out);
    }
    verify(q, m, out, first);
    return 1;
}

static FILE *open_file(const char *folder, const char *name)
{
    char path[1024];
    FILE *out;

    family_name = name;
    case_number = 0;
    snprintf(path, sizeof path, "%s/%s.txt", folder, name);
    out = fopen(path, "w");
    if (!out) {
        perror(path);
        exit(1);
    }
    fprintf(
        out,
        "# Truth in quad precision, family \"%s\". Made by tests/accuracy/make_truth.c:\n"
        "#   gcc -std=gnu11 -O2 -ffp-contract=off tests/accuracy/make_truth.c -lm -o make_truth; ./make_truth "
        "tests/accuracy/truth\n"
        "# m: vertices triangles, then x y z of each vertex, then three indices of each triangle (two-sided body)\n"
        "# s: a convex solid, as m; b: half extents, centre, orientation x y z w of a box, then as s\n"
        "# l: an outline drawn out along z, 1 if it is a ring, then as m: its corners at -z, then those at z\n"
        "# c: a case on the last of these: shape radius half_height half_x half_y, position, up, orientation x y z w, "
        "motion,\n"
        "#    margin, status (0 free, 1 hit, 2 overlap at the start), signed start distance, start normal, fraction,\n"
        "#    smallest distance along the whole motion minus margin (upper bound if nothing is in reach), normal at "
        "the hit\n",
        name);
    return out;
}

static void put(FILE *out, dvec v)
{
    fprintf(out, " %a %a %a", v.x, v.y, v.z);
}

/* Normals are scored to a tenth of a degree: single precision holds them and keeps the files small. */
static void put_normal(FILE *out, dvec v)
{
    put(out, (dvec){(float)v.x, (float)v.y, (float)v.z});
}

static void put_mesh(FILE *out, const mesh *m)
{
    fprintf(out, "%s", m->is_box ? "b" : m->solid ? "s" : m->chain ? "l" : "m");
    if (m->chain) fprintf(out, " %d", m->chain - 1);
    if (m->is_box) {
        put(out, (dvec){m->half[0], m->half[1], m->half[2]});
        put(out, m->centre);
        fprintf(out, " %a %a %a %a", m->quat[0], m->quat[1], m->quat[2], m->quat[3]);
    }
    fprintf(out, " %d %d", m->vertex_count, m->triangle_count);
    for (int i = 0; i < m->vertex_count; i++)
        put(out, m->vertices[i]);
    for (int i = 0; i < m->triangle_count; i++)
        fprintf(out, " %d %d %d", m->triangles[i][0], m->triangles[i][1], m->triangles[i][2]);
    fputc('\n', out);
}

static void put_case(FILE *out, const query *q, const answer *a)
{
    fprintf(out, "c %d %a %a %a %a", q->type, q->radius, q->half_height, q->half_x, q->half_y);
    put(out, q->position);
    put(out, q->up);
    fprintf(out, " %a %a %a %a", q->quat[0], q->quat[1], q->quat[2], q->quat[3]);
    put(out, q->motion);
    fprintf(out, " %a %d %a", q->margin, a->status, a->start_gap);
    put_normal(out, a->start_normal);
    fprintf(out, " %a %a", a->fraction, a->min_gap);
    put_normal(out, a->normal);
    fputc('\n', out);
    case_number++;
}

static void shift(mesh *m, query *q, double offset)
{
    dvec o = {offset, -offset, offset / 2};

    for (int i = 0; i < m->vertex_count; i++)
        m->vertices[i] = add(m->vertices[i], o);
    q->position = add(q->position, o);
}

static int make_family(const char *folder, const family *f)
{
    FILE *out = open_file(folder, f->name);
    int cases = 0;

    for (int kind = 0; kind < KINDS; kind++) {
        if (kind >= BOX && f->placement == OVERLAPPING) continue; /* a box is all core */
        for (int i = 0; i < f->per_kind;) {
            mesh m = {.vertex_count = 0};
            query q;
            answer a;
            make_triangle(&m, f);
            make_shape(&q, kind, f->rounding);
            if (f->placement == TOUCHING && q.margin == 0) q.margin = 0x1p-7;
            place(&q, &m, f, i);
            shift(&m, &q, f->offset);
            if (!solve(&q, &m, &a) ||
                (a.start_gap <= q.margin) != (f->placement == TOUCHING || f->placement == OVERLAPPING))
                continue;
            put_mesh(out, &m);
            put_case(out, &q, &a);
            cases++, i++;
        }
    }
    fclose(out);
    return cases;
}

static int make_mesh_family(const char *folder, const char *name, void (*build)(mesh *), int per_kind)
{
    static const family aimed = {"", 0, MIXED, DYADIC, 2, 2, 0, 0, 2};
    FILE *out = open_file(folder, name);
    mesh m = {.vertex_count = 0};
    int cases = 0;

    if (build)
        build(&m);
    else
        grid(&m, 4, 0.5, strcmp(name, "mesh_flat") ? 0.5 : 0);
    put_mesh(out, &m);
    for (int kind = 0; kind < KINDS; kind++) {
        int resting = !strcmp(name, "mesh_flat");
        if (resting && kind == BOX_TILTED) continue;
        for (int i = 0; i < per_kind;) {
            query q;
            answer a;
            make_shape(&q, kind, resting && kind == CAPSULE_TILTED ? LATTICE : DYADIC);
            if (resting)
                place_resting(&q, i);
            else
                place(&q, &m, &aimed, i);
            vec gap;
            solve_start(&q, &m, &a, &gap);
            if ((!resting && a.start_gap <= q.margin) || !solve(&q, &m, &a)) continue;
            put_case(out, &q, &a);
            cases++, i++;
        }
    }
    fclose(out);
    return cases;
}

/* Four cases on each solid. */
static const struct solids {
    family family;
    int kind;
} solids[] = {
    {{"convex_hull", 24, MIXED, DYADIC, 2, 2, 0, 0, 2}, SOLID_HULL},
    {{"convex_exact", 12, MIXED, EXACT, 2, 2, 0, 0, 4}, SOLID_HULL},
    {{"convex_box", 24, MIXED, DYADIC, 2, 2, 0, 0, 2}, SOLID_BOX},
    {{"convex_sharp", 16, MIXED, FINE, 2, 2, 0, 0, 2}, SOLID_SHARP},
    {{"convex_grazing", 16, GRAZING, FINE, 2, 2, 0, 0, 2}, SOLID_HULL},
    {{"convex_touching", 16, TOUCHING, DYADIC, 2, 2, 0, 0, 1}, SOLID_BOX},
    {{"convex_overlap", 16, OVERLAPPING, DYADIC, 2, 2, 0, 0, 1}, SOLID_HULL},
};

static int make_solid_family(const char *folder, const struct solids *s)
{
    const family *f = &s->family;
    FILE *out = open_file(folder, f->name);
    int cases = 0;

    for (int kind = 0; kind < KINDS; kind++) {
        mesh m;
        if (kind >= BOX && f->placement == OVERLAPPING) continue;
        for (int i = 0, tries = 0; i < f->per_kind; tries++) {
            query q;
            answer a;
            if (i % 4 == 0 && (i == 0 || tries > 0)) make_solid(&m, s->kind, f->size_max, f->rounding, i / 4);
            make_shape(&q, kind, f->rounding);
            if (f->placement == TOUCHING && q.margin == 0) q.margin = 0x1p-7;
            place(&q, &m, f, i);
            if (!solve(&q, &m, &a) ||
                (a.start_gap <= q.margin) != (f->placement == TOUCHING || f->placement == OVERLAPPING))
                continue;
            if (i % 4 == 0) put_mesh(out, &m);
            put_case(out, &q, &a);
            cases++, i++, tries = 0;
        }
    }
    fclose(out);
    return cases;
}

/* Three cases on each outline. */
static int make_plane_family(const char *folder, const char *name, int solid, int per_kind)
{
    FILE *out = open_file(folder, name);
    int cases = 0;

    for (int kind = 0; kind < KINDS; kind++) {
        mesh m;
        for (int i = 0, tries = 0; i < per_kind; tries++) {
            query q;
            answer a;
            if (i % 3 == 0 && (i == 0 || tries > 0)) {
                if (solid)
                    make_polygon(&m);
                else
                    make_chain(&m, below(2));
            }
            make_flat_shape(&q, kind);
            place_flat(&q, &m, i);
            if (!solve(&q, &m, &a) || a.start_gap <= q.margin) continue;
            if (i % 3 == 0) put_mesh(out, &m);
            put_case(out, &q, &a);
            cases++, i++, tries = 0;
        }
    }
    fclose(out);
    return cases;
}

int main(int count, char **arguments)
{
    const char *folder = count > 1 ? arguments[1] : ".";
    int cases = 0;

    for (size_t i = 0; i < sizeof families / sizeof *families; i++) {
        seed = 1000 + i;
        cases += make_family(folder, &families[i]);
        printf("%-10s %d\n", families[i].name, cases);
        fflush(stdout);
    }
    seed = 1;
    cases += make_mesh_family(folder, "mesh_flat", NULL, 20);
    cases += make_mesh_family(folder, "mesh_hills", NULL, 12);
    cases += make_mesh_family(folder, "mesh_stairs", stairs, 12);
    cases += make_mesh_family(folder, "mesh_corner", corner, 16);
    cases += make_mesh_family(folder, "mesh_fan", fan, 12);
    cases += make_mesh_family(folder, "mesh_soup", soup, 12);
    for (size_t i = 0; i < sizeof solids / sizeof *solids; i++) {
        seed = 2000 + i;
        cases += make_solid_family(folder, &solids[i]);
        printf("%-15s %d\n", solids[i].family.name, cases);
        fflush(stdout);
    }
    seed = 3000;
    cases += make_plane_family(folder, "plane_chain", 0, 36);
    cases += make_plane_family(folder, "plane_hull", 1, 36);
    printf("%d cases, both methods agree\n", cases);
    return 0;
}
